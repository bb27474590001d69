"""Carrying an outline's own curves along with the mesh nodes that lie on it.

Between two neighbouring nodes the outline is a chord and an offset from it. The chord's ends move
with the mesh. The offset turns as the chord turns, and is otherwise changed only by the affine
map that best takes one shape onto the other, so that no thin face and no distant vanishing line
can throw it outwards. What it is at the start fades into what it is at the end.
"""

import numpy as np

from shapetween.base.arrays import Complex, Curves, Floats, Index, Mask, Points
from shapetween.geometry.bezier import end_tangents
from shapetween.geometry.linearmaps import LinearMaps, as_complex, as_points
from shapetween.geometry.polygon import cross
from shapetween.geometry.rotation import polar, rotations
from shapetween.outline.matched import Pieces

__all__ = ["Carrier", "Joints", "affine_between"]

#: Joints that turn by less than this at both ends, in radians, are kept smooth on the way.
SMOOTH_KINK = np.deg2rad(20.0)

#: An excess kink is removed whole up to the first angle, in radians, and left alone from the second
#: on, where turning the handles would make a loop.
REMOVED, LEFT_ALONE = np.deg2rad(90.0), np.deg2rad(150.0)

#: Kink, in radians, past which a handle that grows from nothing turns no tip. Beyond it the two
#: curves of a tip cross, seen from near.
SHARPEST = np.deg2rad(165.0)

#: Ratio of the shorter to the longer handle of a joint up to which the longer one takes less of its
#: turn, the shorter one the more: as a handle shrinks to nothing its direction may swing right
#: round, and with the same ratio at all times the longer one would run after it in an instant.
#: Smaller, and it does run; larger, and handles that say where the outline goes are turned alone.
SHORT = 0.1

#: Share of its length that a curve's handles may lie off its chord and the curve count as a line.
STRAIGHT = 1e-3

#: Distance of a handle from its end, as a share of the curve's extent, up to which it lies there
#: and says nothing of the curve's direction.
COINCIDENT = 1e-9

#: Curves of all frames that are worked on at once; more cost memory and are no quicker.
AT_ONCE = 25_000

#: Greatest ratio of stretches of the affine map that offsets follow; past it the fit between two
#: unlike shapes says more about their outlines' places than about a common deformation.
MAX_STRETCH = 3.0

#: Residual of an affine fit, as a share of the target's size, up to which it is taken as exact.
EXACT_FIT = 1e-3

#: Share of their extent that points may lie off one line and still say nothing of what happens
#: across it.
FLAT = 1e-6


def affine_between(source: Points, target: Points) -> tuple[Floats, Floats]:
    """Rotation angle and stretch of the affine map that best takes matched points on each other.

    Parameters
    ----------
    source, target : (N, 2) float64

    Returns
    -------
    angle : () float64
    stretch : (2, 2) float64
        Symmetric, positive definite. Where the best affine map turns the plane over, or stretches
        one way far more than the other without fitting, or the points hardly match one way, or
        lie on one line, that of the best similarity.

    Notes
    -----
    Each set is made round, its second moments those of a disc, and the round sets are turned onto
    each other. Least squares would not do: the map back is then not the inverse of the map forth.
    """
    p, q = source - source.mean(axis=0), target - target.mean(axis=0)
    (round_p, spread_p, axes_p), (round_q, spread_q, axes_q) = (
        np.linalg.svd(points, full_matrices=False) for points in (p, q)
    )
    if all(spread[1] > FLAT * spread[0] for spread in (spread_p, spread_q)):
        left, alike, right = np.linalg.svd(round_q.T @ round_p)
        linear = (axes_q.T * spread_q) @ left @ right @ (axes_p.T / spread_p).T
        d = np.linalg.svd(linear, compute_uv=False)
        even = all(values[0] <= MAX_STRETCH * values[1] for values in (d, alike))
        exact = np.linalg.norm(p @ linear.T - q) < EXACT_FIT * np.linalg.norm(q)
        if np.linalg.det(linear) > 0 and (even or exact):
            return polar(linear)
    turn = np.arctan2(cross(p, q).sum(), (p * q).sum())
    return np.asarray(turn), np.linalg.norm(q) / np.linalg.norm(p) * np.eye(2)


class Carrier:
    """The curves of one ring, prepared to follow the nodes on it.

    Parameters
    ----------
    pieces : Pieces
        The two outlines, cut at every node.
    nodes : (n,) float64
        Places of the nodes in the common parameter, increasing; each starts a piece.
    source, target : (n, 2) float64
        The nodes at both ends.
    ordered : bool
        Whether the pieces of each span are in one order along both its chords, and are to stay so.
        Then the outline follows a similarity at most, and is squeezed where its chord is.

    Attributes
    ----------
    pieces : Pieces
    """

    def __init__(
        self,
        pieces: Pieces,
        nodes: Floats,
        source: Points,
        target: Points,
        *,
        ordered: bool = False,
    ) -> None:
        count = len(nodes)
        self.pieces = pieces
        self._span: Index = np.searchsorted(nodes, pieces.w, side="right") - 1
        self._span = np.where(self._span < 0, count - 1, self._span)
        begin, end = nodes[self._span], np.roll(nodes, -1)[self._span]
        length = np.where(end > begin, end - begin, end - begin + 1)
        first = pieces.w - begin
        first = np.where(first < 0, first + 1, first) / length
        following = np.roll(first, -1)
        last = np.where(np.roll(self._span, -1) == self._span, following, 1.0)
        third = np.linspace(0.0, 1.0, 4)
        self._share = first[:, None] + (last - first)[:, None] * third  # (P, 4)
        self._spans = np.bincount(self._span, minlength=count)
        ends = as_complex(source), as_complex(target)
        self._chords = _chords(ends[0]), _chords(ends[1])
        self._offsets = (
            as_complex(pieces.source) - self._along(ends[0]),
            as_complex(pieces.target) - self._along(ends[1]),
        )
        self._ordered = ordered
        angle, stretch = affine_between(source, target)
        if ordered:
            stretch = np.sqrt(np.linalg.det(stretch)) * np.eye(2)
        self._angle, self._affine = angle, LinearMaps.of(rotations(angle) @ stretch)
        self._joints = Joints.of(pieces.source, pieces.target)

    def _along(self, nodes: Complex) -> Complex:
        """Points of the chords at each control point's share of the span, (..., P, 4)."""
        step = _chords(nodes)[..., self._span, None]
        return np.asarray(nodes[..., self._span, None] + self._share * step)

    @property
    def count(self) -> int:
        """Number of curves."""
        return len(self._span)

    def curves(self, nodes: Points, t: Floats) -> Curves:
        """Control points at the times (F,).

        Parameters
        ----------
        nodes : (F, n, 2) float64
            Where the mesh puts the nodes.

        Returns
        -------
        (F, P, 4, 2) float64
            Exactly the pieces' own at 0 and 1.
        """
        places = as_complex(nodes)
        forth = self._affine.between(self._angle, t)[:, None]  # (F, 1)
        linears = forth, forth.after(self._affine.inverse())
        chord = _chords(places)  # (F, n)
        chords = [linear(rest) for linear, rest in zip(linears, self._chords, strict=True)]
        # Offsets grow as the chords do on the whole, beside what the affine map says.
        sizes = [np.abs(expected) for expected in chords]  # (F, n)
        length, time = np.abs(chord), t[:, None]
        wanted = (1 - time) * sizes[0] + time * sizes[1]
        grown = (length @ self._spans / (wanted @ self._spans))[:, None]
        moved = []
        for linear, expected, weight in zip(
            linears, chords, ((1 - time) * grown, time * grown), strict=True
        ):
            moved.append(linear.turned(weight * _direction(chord * expected.conj())))
        if self._ordered:
            squeezed = _squeezed(chord, np.maximum(1 - length / (grown * wanted), 0.0))
            moved = [squeezed.after(local) for local in moved]
        result = np.zeros((len(t), self.count, 4, 2))
        # So few frames at once that what is on the way needs little memory.
        few = 1 + min(len(t), len(t) * self.count // AT_ONCE)
        for frames in np.array_split(np.arange(len(t)), few):
            some = self._along(places[frames])
            for local, offset in zip(moved, self._offsets, strict=True):
                some += local[frames][:, self._span, None](offset)
            some[:, :, 3] = np.roll(some[:, :, 0], -1, axis=1)  # equal but for rounding
            self._joints.smooth(some, t[frames])
            result[frames] = as_points(some)
        result[t == 0] = self.pieces.source
        result[t == 1] = self.pieces.target
        return result


def _chords(nodes: Complex) -> Complex:
    """From each node to the next, (..., n)."""
    return np.asarray(np.roll(nodes, -1, axis=-1) - nodes)


def _direction(vectors: Complex) -> Complex:
    """Vectors of length 1 in the same direction; 1 where there is none."""
    size = np.abs(vectors)
    unit = np.where(size > 0, vectors, 1.0) / np.where(size > 0, size, 1.0)
    return np.asarray(unit, dtype=np.complex128)


def _squeezed(along: Complex, shares: Floats) -> LinearMaps:
    """Maps that take a share of the length along vectors away, and nothing across."""
    stretch = shares / 2 * _direction(along) ** 2
    kept = (1 - shares / 2).astype(np.complex128)
    return LinearMaps(kept, np.asarray(-stretch, dtype=np.complex128))


class Joints:
    """Joints whose handles are turned on the way, and what each handle may do.

    Those that are smooth at both ends stay so. Where a handle has no length at one end, it grows
    from there in the direction of the other end alone; it is kept from turning the tip over.
    """

    def __init__(self, index: Index, kinks: Floats, shares: Floats, slack: Mask) -> None:
        self._before, self._after = index
        self._kinks = kinks
        self._shares = shares
        self._slack = slack

    @classmethod
    def of(cls, source: Curves, target: Curves, *, closed: bool = True) -> "Joints":
        """The joints of two runs of curves that become each other, (P, 4, 2) each."""
        both = np.stack([source, target])
        leaving, reaching = (np.stack(x) for x in zip(*map(end_tangents, both), strict=True))
        kinks = _angle(reaching, np.roll(leaving, -1, axis=1))
        line = _straight(source) & _straight(target)
        # A piece that is a point at one end has no direction there to go on from.
        point = (both == both[:, :, :1]).all(axis=(2, 3)).any(axis=0)
        smooth = (np.abs(kinks) < SMOOTH_KINK).all(axis=0) & ~(line & np.roll(line, -1))
        folded = _folded(both[:, :, ::-1]), np.roll(_folded(both), -1, axis=1)
        slack = np.stack([side[0] | side[1] for side in folded])
        before = np.flatnonzero((smooth | slack.any(axis=0)) & ~point & ~np.roll(point, -1))
        before = before if closed else before[before < len(source) - 1]
        after = (before + 1) % len(source)
        slack = slack[:, before] & ~smooth[before]
        # A side that is straight at both ends stays so: the handle across the joint does it all.
        # So does one without a length of its own.
        free = np.where(slack.any(axis=0), slack, np.stack([~line[before], ~line[after]]))
        shares = free / np.maximum(free.sum(axis=0), 1)
        return cls(np.stack([before, after]), kinks[:, before], shares, slack[0] | slack[1])

    def smooth(self, curves: Complex, t: Floats) -> None:
        """Turn handles about their joints, in place, until the kink is the ends' own mean.

        With a handle that grows from nothing, it only comes within the first angle of that.
        Nothing leaps where handles turn evenly.
        """
        if not len(self._before):
            return
        reaching = -_leaving(curves[:, self._before, ::-1])
        leaving = _leaving(curves[:, self._after])
        wanted = (1 - t)[:, None] * self._kinks[0] + t[:, None] * self._kinks[1]
        excess = np.angle(leaving * reaching.conj() * np.exp(-1j * wanted))
        fade = np.clip((LEFT_ALONE - np.abs(excess)) / (LEFT_ALONE - REMOVED), 0.0, 1.0)
        room = np.clip(SHARPEST - np.abs(wanted), 0.0, REMOVED)
        # Past that it comes back, to nothing at half a turn, where either way round is as far: no
        # handle may leap from one to the other. And one handle alone is turned there.
        back = room * (np.pi - np.abs(excess)) / (np.pi - room)
        alone = np.clip(np.abs(excess) / REMOVED - 1.0, 0.0, 1.0) * (self._shares > 0).all(axis=0)
        over = excess - np.copysign(np.minimum(np.abs(excess), back), excess)
        excess = np.where(self._slack, over, excess * fade * fade * (3 - 2 * fade))
        shares = self._shares[0] + alone * self._shares[1], (1 - alone) * self._shares[1]
        handles = (self._before, 3, 2), (self._after, 0, 1)
        arms = [curves[:, piece, k] - curves[:, piece, end] for piece, end, k in handles]
        turns = self._by_length(shares, (np.abs(arms[0]), np.abs(arms[1])))
        for (piece, end, k), arm, turn in zip(handles, arms, (turns[0], -turns[1]), strict=True):
            curves[:, piece, k] = curves[:, piece, end] + np.exp(1j * turn * excess) * arm

    def _by_length(
        self, shares: tuple[Floats, Floats], lengths: tuple[Floats, Floats]
    ) -> tuple[Floats, Floats]:
        """What each handle turns by where one of the two is far shorter, shares of the excess."""
        both = (self._shares > 0).all(axis=0)
        left = []
        for share, own, other in zip(shares, lengths, lengths[::-1], strict=True):
            long = (SHORT * own > other) & both
            kept = np.divide(other, SHORT * own, out=np.ones_like(own), where=long)
            left.append(share * (1 - kept))
        return shares[0] - left[0] + left[1], shares[1] - left[1] + left[0]


def _folded(curves: Curves) -> Mask:
    """Which curves begin with a handle that lies on their start, (...,)."""
    offsets = np.abs(as_complex(curves)[..., 1:] - as_complex(curves)[..., :1])
    return np.asarray(offsets[..., 0] <= COINCIDENT * offsets.max(axis=-1))


def _leaving(curves: Complex) -> Complex:
    """Offset from each curve's start of the first control point away from it, (...,)."""
    offsets = curves[..., 1:] - curves[..., :1]
    size = np.abs(offsets)
    largest = np.maximum(np.maximum(size[..., 0], size[..., 1]), size[..., 2])
    away = size > COINCIDENT * largest[..., None]
    return np.asarray(np.take_along_axis(offsets, away.argmax(axis=-1)[..., None], axis=-1)[..., 0])


def _angle(first: Points, second: Points) -> Floats:
    return np.asarray(np.arctan2(cross(first, second), (first * second).sum(-1)))


def _straight(curves: Curves) -> Index:
    """Which curves are straight lines, (P,)."""
    chord = curves[:, 3] - curves[:, 0]
    off = np.abs(cross(curves[:, 1:3] - curves[:, :1], chord[:, None])).max(axis=1)
    return np.asarray(off <= STRAIGHT * (chord**2).sum(-1))
