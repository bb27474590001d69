"""The outline of a stroke while its line moves.

Each end's own outline is carried by the line's frame: places along it, at the same distances from
it. So both ends are drawn exactly as they are, and between them the stroke keeps its width.
"""

from collections.abc import Sequence
from dataclasses import dataclass, fields

import numpy as np

from shapetween.base.arrays import Curves, Floats, Index, Mask, Points
from shapetween.geometry.bezier import curve_lengths, end_tangents, signed_area
from shapetween.geometry.polygon import cross
from shapetween.geometry.rotation import rotations
from shapetween.model.outline import Outline
from shapetween.scene.strokes.frame import CAP, JOIN, SMOOTH, WALL, StrokeFrame
from shapetween.scene.strokes.walk import Walk, cut_alike, walk_of

__all__ = ["StrokeOutline", "stroke_outline"]

#: Least share of a line's pace that the inner side of a bend keeps.
LEAST_PACE = 0.1

#: Turn of a corner, radians, below which its join keeps the form it has.
LEAST_TURN = np.deg2rad(10.0)

#: Share of the square of its length by which an outline may enclose more or less than it does: some
#: thousandths of a slim stroke's. Larger and a stroke is seen filled; smaller and rounding counts.
SPILLED = 1e-5

#: Reach of a handle, in paces of the line, from which on it keeps its length: beside a bit of line
#: that is nearly a point it says nothing of the pace. Larger, and it shoots across the drawing as
#: the bit grows; smaller, and the inner sides of bends are no longer even.
MOST_PACES = 4.0

#: Greatest ratio by which a join widens as its corner does.
WIDENED = 3.0


@dataclass(frozen=True, slots=True, eq=False)
class _Bound:
    """Pieces of one ring in the coordinates of a line's frame.

    For each of the P pieces and its two ends: where the frame stands and what the end and its
    handle are in it.
    """

    kind: Index  # (P,) WALL, JOIN or CAP
    curve: Index  # (P,)
    side: Index  # (P,)
    place: Floats  # (P, 2) along the wall, between the corners' mitre lines
    aside: Floats  # (P, 2) distance off the line
    rest: Points  # (P, 2, 2) what is left of the point, along and across
    handle: Points  # (P, 2, 2) in share of the pace, or as it is, and across
    steady: Mask  # (P, 2) whether it is as it is

    def only(self, kept: Mask) -> "_Bound":
        """Some of the pieces."""
        return _Bound(*(getattr(self, field.name)[kept] for field in fields(self)))

    def drawn(self, frame: StrokeFrame, turns: Floats, scale: Floats) -> Curves:
        """The pieces on a line at other times, (F, P, 4, 2).

        Parameters
        ----------
        frame : StrokeFrame
            Of curves (F, N, 4, 2).
        turns : (N,) float64
            Of the line that the pieces were bound to.
        scale : (F,) float64
            What distances off the line are multiplied by.
        """
        kind = np.repeat(self.kind, 2)
        curve, side = np.repeat(self.curve, 2), np.repeat(self.side, 2)
        grown = scale[:, None]
        aside = self.aside.ravel() * grown
        rest, handle = self.rest.reshape(-1, 2), self.handle.reshape(-1, 2)
        t, pace_shear = _slid(frame, kind, curve, side, self.place.ravel(), aside)
        points, along, across, speed, bend = frame.frames(curve, t)
        pace = speed * (1 - bend * aside) + pace_shear
        pace = np.maximum(pace, LEAST_PACE * speed)
        spin = self._spin(frame, turns)
        turned = kind == JOIN
        if turned.any():
            along = np.where(turned[:, None], spin[0], along)
            across = np.where(turned[:, None], spin[1], across)
        paced = (kind == WALL) & ~self.steady.ravel()
        pace = np.where(paced, pace, np.where(turned, spin[2] * grown, grown))
        at = points + (aside + rest[:, 1] * grown)[..., None] * across
        at = at + (rest[:, 0] * grown)[..., None] * along
        reach = (handle[:, 0] * pace)[..., None] * along
        reach = reach + (handle[:, 1] * grown)[..., None] * across
        ends = at.reshape(len(scale), -1, 2, 2)
        handles = ends + reach.reshape(len(scale), -1, 2, 2)
        return np.stack([ends[:, :, 0], handles[:, :, 0], handles[:, :, 1], ends[:, :, 1]], axis=2)

    def _spin(self, frame: StrokeFrame, turns: Floats) -> tuple[Points, Points, Floats]:
        """Frames of joins' ends: the corner's middle, turned by their own share of its turn.

        Returns
        -------
        along, across : (F, 2 P, 2) float64
        widened : (F, 2 P) float64
            How much wider the corner is than it was.
        """
        curve = np.repeat(self.curve, 2)
        now = frame.turns[:, curve]
        was = turns[curve]
        steady = np.abs(was) < LEAST_TURN
        ratio = np.where(steady, 1.0, now / np.where(steady, 1.0, was))
        ratio = np.clip(ratio, -WIDENED, WIDENED)
        leaving = end_tangents(frame.curves[:, curve])[0]
        # From the curve after the corner back to its middle, and on by the place's own share.
        angle = -now / 2 + self.place.ravel() * (ratio - 1)
        turn = rotations(angle)
        along = (turn @ leaving[..., None])[..., 0]
        return along, np.stack([-along[..., 1], along[..., 0]], axis=-1), np.abs(ratio)


def _slid(
    frame: StrokeFrame, kind: Index, curve: Index, side: Index, place: Floats, aside: Floats
) -> tuple[Floats, Floats]:
    """Parameters of a line's curves beside places on its walls, and what shears add to the pace."""
    count = frame.zones.count
    both = [frame.shears(np.full(count, way)) for way in (-1.0, 1.0)]
    start, end = (
        np.where(side < 0, both[0][k][..., curve], both[1][k][..., curve]) for k in (0, 1)
    )
    wall = kind == WALL
    length = np.maximum(frame.lengths[..., curve], 1e-300)
    shear = np.where(wall, (1 - place) * start + place * end, 0.0)
    t = np.clip(place + aside * shear / length, 0.0, 1.0)
    t = np.where(wall, t, np.where(kind == CAP, np.where(side > 0, 1.0, 0.0), 0.0))
    return t, np.where(wall, aside * (end - start), 0.0)


@dataclass(frozen=True, slots=True, eq=False)
class StrokeOutline:
    """Rings of a stroke that follow its line.

    Attributes
    ----------
    counts : tuple of int
        Curves of each ring, all of them closed.
    """

    counts: tuple[int, ...]
    _ends: tuple[tuple[_Bound, ...], tuple[_Bound, ...]]
    _turns: tuple[Floats, Floats]
    _closed: bool

    def curves(self, line: Curves, t: Floats, scale: Floats | None = None) -> Curves:
        """Control points while the line is at given places.

        Parameters
        ----------
        line : (F, N, 4, 2) float64
            The line's curves at the times.
        t : (F,) float64
            Times; the first end's outline is blended into the second one's by them.
        scale : (F,) float64, optional
            What the width is multiplied by, 1 without it.

        Returns
        -------
        (F, M, 4, 2) float64
            Ring after ring.
        """
        frame = StrokeFrame(line, self._closed)
        grown = np.ones(len(t)) if scale is None else scale
        rings = []
        for source, target in zip(*self._ends, strict=True):
            one = _continuous(source.drawn(frame, self._turns[0], grown), source.kind)
            other = _continuous(target.drawn(frame, self._turns[1], grown), target.kind)
            share = t[:, None, None, None]
            rings.append((1 - share) * one + share * other)
        return np.concatenate(rings, axis=1)


def _continuous(curves: Curves, kind: Index) -> Curves:
    """Pieces (F, P, 4, 2) that follow one another: what is beside a wall ends where it does."""
    before, after = curves[:, :, 3], np.roll(curves[:, :, 0], -1, axis=1)
    wall_next = np.roll(kind == WALL, -1)
    meet = np.where(((kind != WALL) & wall_next)[:, None], after, before)
    curves = curves.copy()
    for k, shift in ((3, 0), (0, 1)):
        goal = np.roll(meet, shift, axis=1)
        near = 2 if k == 3 else 1
        curves[:, :, near] += goal - curves[:, :, k]
        curves[:, :, k] = goal
    return curves


def stroke_outline(
    lines: tuple[Curves, Curves], closed: bool, rings: tuple[Sequence[Outline], Sequence[Outline]]
) -> StrokeOutline | None:
    """Bind a stroke's outlines at both ends to its line.

    Parameters
    ----------
    lines : pair of (N, 4, 2) float64
        The line at both ends, of equally many curves.
    closed : bool
        Whether it is a ring.
    rings : pair of sequences of Outline
        What is drawn at either end: one ring round an open line, two round a closed one, the
        order free.

    Returns
    -------
    StrokeOutline or None
        None if a ring does not run round the line's contour once, or is not drawn as it is: where a
        line runs beside itself, a place may be taken for another.
    """
    frames = [StrokeFrame(line, closed) for line in lines]
    walks = []
    for frame, drawn in zip(frames, rings, strict=True):
        found = [walk_of(frame, ring) for ring in drawn]
        walks.append(sorted((w for w in found if w is not None), key=lambda walk: walk.side))
    sides = [[walk.side for walk in row] for row in walks]
    if sides[0] != sides[1] or sides[0] != ([-1, 1] if closed else [-1]):
        return None
    ends: tuple[list[_Bound], list[_Bound]] = ([], [])
    for one, other in zip(*walks, strict=True):
        alike = cut_alike(one, other)
        if alike is None:
            return None
        bound = [
            _bound(frame, one.side, places, parts)
            for frame, (places, parts) in zip(frames, alike, strict=True)
        ]
        needed = ~(_needless(frames[0], bound[0]) & _needless(frames[1], bound[1]))
        for k in (0, 1):
            ends[k].append(bound[k].only(needed))
    counts = tuple(len(bound.kind) for bound in ends[0])
    turns = frames[0].turns, frames[1].turns
    outline = StrokeOutline(counts, (tuple(ends[0]), tuple(ends[1])), turns, closed)
    for line, t, own in zip(lines, (0.0, 1.0), walks, strict=True):
        if not _is_drawn(outline.curves(line[None], np.array([t]))[0], own):
            return None
    return outline


def _is_drawn(curves: Curves, walks: Sequence[Walk]) -> bool:
    """Whether pieces of rings enclose as much as the rings that they are pieces of."""
    given = np.concatenate([walk.curves for walk in walks])
    least = SPILLED * float(curve_lengths(given).sum()) ** 2
    return abs(signed_area(curves) - signed_area(given)) <= least


def _needless(frame: StrokeFrame, bound: _Bound) -> Mask:
    """Joins of smooth joints without any length."""
    size = np.abs(np.diff(bound.rest, axis=1)).max(axis=(1, 2))
    smooth = np.abs(frame.turns[bound.curve]) < SMOOTH
    return np.asarray((bound.kind == JOIN) & smooth & (size <= 1e-9 * frame.lengths.max()))


def _bound(frame: StrokeFrame, side: int, places: Floats, parts: Curves) -> _Bound:
    """Parts of a ring between places on the contour in the frame's coordinates."""
    zones = frame.zones
    middle = (places[:-1] + places[1:]) / 2
    zone = np.clip(np.floor(middle), 0, zones.total - 1).astype(int)
    kind, curve, way = (
        np.array(c, dtype=np.intp)
        for c in zip(*(zones.of(z, side) for z in zone.tolist()), strict=True)
    )
    ends = parts[:, [0, 3]].reshape(-1, 2)
    reach = (parts[:, [1, 2]] - parts[:, [0, 3]]).reshape(-1, 2)
    kinds, curves, ways = (np.repeat(c, 2) for c in (kind, curve, way))
    place, aside = frame.beside(ends, curves, ways)
    wall, join = kinds == WALL, kinds == JOIN
    place, aside = np.where(wall, place, 0.0), np.where(wall, aside, 0.0)
    t, shear = _slid(frame, kinds, curves, ways, place, aside)
    points, along, across, speed, bend = frame.frames(curves, t)
    turn = frame.turns[curves]
    middle_way = rotations(-turn / 2) @ end_tangents(frame.curves[curves])[0][..., None]
    along = np.where(join[:, None], middle_way[..., 0], along)
    across = np.where(join[:, None], np.stack([-along[:, 1], along[:, 0]], axis=1), across)
    away = ends - points
    outward = -np.sign(turn)[:, None] * across
    angle = np.arctan2(cross(outward, away), (outward * away).sum(-1))
    place = np.where(join, np.clip(angle, -np.abs(turn) / 2, np.abs(turn) / 2), place)
    away = away - aside[:, None] * across
    rest = np.stack([(away * along).sum(-1), (away * across).sum(-1)], axis=-1)
    pace = np.maximum(speed * (1 - bend * aside) + shear, LEAST_PACE * speed)
    far = (reach * along).sum(-1)
    paced = wall & (pace > 0)
    pace = np.where(paced, pace, 1.0)
    steady = paced & (np.round(np.abs(far / pace), 9) > MOST_PACES)
    pace = np.where(steady, 1.0, pace)
    handle = np.stack([far / pace, (reach * across).sum(-1)], axis=-1)
    shape = (len(kind), 2)
    return _Bound(
        kind,
        curve,
        way,
        place.reshape(shape),
        aside.reshape(shape),
        rest.reshape(*shape, 2),
        handle.reshape(*shape, 2),
        steady.reshape(shape),
    )
