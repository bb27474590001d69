"""What is even about an axis at both ends, and matched so, stays even on the way."""

from dataclasses import dataclass

import numpy as np

from shapetween.base.arrays import Complex, Floats, Index
from shapetween.deform.keyed import KeyedMotion
from shapetween.deform.schedule import CHECKED_TIMES
from shapetween.geometry.bezier import flatten
from shapetween.geometry.linearmaps import as_complex
from shapetween.match.costs import Prepared, prepare
from shapetween.match.lopsided import nearly_even_about
from shapetween.match.symmetry import Axes
from shapetween.model.outline import Outline
from shapetween.outline.body import Carried
from shapetween.outline.pushing import pushed

__all__ = ["evened"]

#: Chords that a curve is looked at with. Fewer miss where on a bend an image is; more cost time.
CHORDS = 4

#: Distance, as a share of the drawing's longer side, of a node's mirror image from what it is
#: matched with, at both ends, up to which it is even; at twice that it is by itself. Larger
#: bends what is on one side alone; smaller leaves hand-drawn hearts uneven.
SAME_PLACE = 0.05

#: Power of the time with which what is uneven at an end fades. Smaller is seen half-way; larger
#: makes nodes rush along the outline at both ends.
FADING = 3

#: Share of the nodes that are even, some in part, from which on the drawing is. Less takes
#: lopsided ones for even; more leaves what has a tuft on one side.
NEARLY_ALL = 0.75


@dataclass(frozen=True, slots=True)
class _Line:
    """A line that an outline is even about: an axis, or one about which it is nearly so.

    Attributes
    ----------
    angle : float
        Radians.
    through : complex or None
        A point that it goes through; None for an axis, which has as much on either side.
    """

    angle: float
    through: complex | None = None

    def image(self, points: Complex) -> Complex:
        """Mirror images of places of the outline, its outermost among them."""
        across = 1j * np.exp(1j * self.angle)
        middle = self.through
        if middle is None:
            aside = (points * across.conjugate()).real
            middle = across * (aside.max() + aside.min()) / 2
        return np.asarray(middle + np.exp(2j * self.angle) * (points - middle).conj())


def evened(body: Carried) -> Carried:
    """The body with both sides of its axis moving alike, unless more crosses then."""
    motion, rings = body.path, body.nodes.rings
    outer = [ring for ring in rings if not ring.hole]
    if not isinstance(motion, KeyedMotion) or len(outer) != 1 or outer[0].coarse:
        return body
    if outer[0].matching.affine is not None:
        return body
    turn = outer[0].matching.turn
    lines = _lines(outer[0].source, outer[0].target, turn)
    if not lines:
        return body
    t = np.linspace(0, 1, CHECKED_TIMES)
    moving = motion.nodes(t)
    nodes = as_complex(moving)
    curves = body.nodes.curves(moving, t)
    places = np.stack([as_complex(flatten(frame, CHORDS)) for frame in curves])
    following = _following(body.counts)
    found = _partners(nodes, places, following, lines)
    if found is None:
        return body
    chord, share, weight, first, second = found
    aside = (second - first - turn + np.pi / 2) % np.pi - np.pi / 2
    angles = first + t * (turn + aside)
    partners = (1 - share) * places[:, chord] + share * places[:, following[chord]]
    gap = _mirrored(nodes, partners, angles, weight) - nodes
    time = t[:, None]
    # At the ends what is uneven lies along the outlines and is not seen.
    gap -= (1 - time) ** FADING * gap[:1] + time**FADING * gap[-1:]
    moved = pushed(body, motion, weight * gap / 2)
    return moved if moved.crossing <= body.crossing else body


def _following(counts: tuple[int, ...]) -> Index:
    """The next of every place on its ring."""
    rings, first = [], 0
    for count in counts:
        rings.append(first + (np.arange(CHORDS * count) + 1) % (CHORDS * count))
        first += CHORDS * count
    return np.concatenate(rings)


def _lines(source: Outline, target: Outline, turn: float) -> list[tuple[_Line, _Line]]:
    """Lines that both outlines are even about, as pairs that may be one."""
    first, second = prepare(source), prepare(target)
    axes = first.axes.beside(second.axes), second.axes.beside(first.axes)
    known = [side.present for side in axes]
    if all(known):
        directions = [_directions(side, other) for side, other in (axes, axes[::-1])]
        return [(_Line(float(a)), _Line(float(b))) for a in directions[0] for b in directions[1]]
    found = []
    if known[0]:
        for angle in _directions(axes[0], axes[0]).tolist():
            line = _nearly(second, angle + turn)
            found += [(_Line(angle), line)] if line else []
    if known[1]:
        for angle in _directions(axes[1], axes[1]).tolist():
            line = _nearly(first, angle - turn)
            found += [(line, _Line(angle))] if line else []
    return found


def _nearly(prepared: Prepared, angle: float) -> _Line | None:
    """The line in a direction that an outline is nearly even about."""
    aside = nearly_even_about(prepared, angle)
    if aside is None:
        return None
    samples = prepared.samples
    across = 1j * np.exp(1j * angle)
    first = complex(*samples.arcs.point(np.array([samples.start % 1.0]))[0])
    centre = first - complex(*samples.points[0]) * samples.size
    return _Line(angle, centre + across * aside * samples.size)


def _partners(
    nodes: Complex, places: Complex, following: Index, lines: list[tuple[_Line, _Line]]
) -> tuple[Index, Floats, Floats, float, float] | None:
    """Where each node's mirror image is, at both ends alike; None if they are not even.

    Returns
    -------
    chord : (N,) intp
        The place from which a chord leads there.
    share : (N,) float64
        How far along it.
    weight : (N,) float64
        How even each node is, from 0 to 1.
    first, second : float
        Angles of the axis at both ends.
    """
    best, least = None, np.inf
    ends = np.stack([nodes[0], nodes[-1]]), np.stack([places[0], places[-1]])
    size = np.maximum(np.ptp(ends[1].real, axis=1), np.ptp(ends[1].imag, axis=1))[:, None]
    there = ends[1] / size
    way = there[:, following] - there
    square = np.maximum((np.abs(way) ** 2).sum(axis=0), np.finfo(float).tiny)
    for pair in lines:
        image = (
            np.stack([line.image(points) for line, points in zip(pair, ends[0], strict=True)])
            / size
        )
        offset = image[:, :, None] - there[:, None]
        share = (offset * way[:, None].conj()).real.sum(axis=0) / square
        share = np.clip(share, 0.0, 1.0)
        far = np.abs(offset - share * way[:, None]).max(axis=0)
        nearest = far.argmin(axis=1)
        weight = np.clip(2 - far.min(axis=1) / SAME_PLACE, 0.0, 1.0)
        # What is nearly even by its area may have most of its nodes in what is not.
        exact = all(line.through is None for line in pair)
        even = weight.mean() >= NEARLY_ALL if exact else weight.any()
        first, second = (line.angle for line in pair)
        # Of several axes the one that the eye sees first: upright, or level.
        aslant = float(np.abs(np.sin(2 * np.array([first, second]))).sum())
        if even and aslant < least - 1e-6:
            along = share[np.arange(len(nearest)), nearest]
            best, least = (nearest, along, weight, first, second), aslant
    return best


def _directions(axes: Axes, other: Axes) -> Floats:
    """Angles of the axes, each once; of a disc those of the other outline."""
    known = axes.directions if axes.around is None else other.directions
    return np.asarray(np.unique(np.round(known % np.pi, 6)))


def _mirrored(nodes: Complex, partners: Complex, angles: Floats, weight: Floats) -> Complex:
    """Partners mirrored about the axis through the middle of both at each time, (F, N)."""
    middle = ((nodes + partners) @ (weight / weight.sum()))[:, None] / 2
    return np.asarray(middle + np.exp(2j * angles)[:, None] * (partners - middle).conj())
