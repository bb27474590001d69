"""What is even about an axis at both ends, and matched so, stays even on the way."""

import numpy as np

from shapetween.base.arrays import Complex, Floats, Index
from shapetween.deform.keyed import KeyedMotion
from shapetween.deform.schedule import CHECKED_TIMES
from shapetween.geometry.bezier import flatten
from shapetween.geometry.linearmaps import as_complex
from shapetween.match.costs import prepare
from shapetween.match.symmetry import Axes
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


def evened(body: Carried) -> Carried:
    """The body with both sides of its axis moving alike, unless more crosses then."""
    motion, rings = body.path, body.nodes.rings
    outer = [ring for ring in rings if not ring.hole]
    if not isinstance(motion, KeyedMotion) or len(outer) != 1 or outer[0].coarse:
        return body
    if outer[0].matching.affine is not None:
        return body
    known = [prepare(outline).axes for outline in (outer[0].source, outer[0].target)]
    axes = [known[0].beside(known[1]), known[1].beside(known[0])]
    if not all(len(side.directions) or side.around is not None for side in axes):
        return body
    t = np.linspace(0, 1, CHECKED_TIMES)
    vertices = motion.vertices(t)
    nodes = as_complex(vertices[:, : len(body.nodes.ends[0])])
    curves = body.nodes.curves(vertices, t)
    places = np.stack([as_complex(flatten(frame, CHORDS)) for frame in curves])
    following = _following(body.counts)
    found = _partners(nodes, places, following, axes)
    if found is None:
        return body
    chord, share, weight, first, second = found
    turn = outer[0].matching.turn
    aside = (second - first - turn + np.pi / 2) % np.pi - np.pi / 2
    angles = first + t * (turn + aside)
    partners = (1 - share) * places[:, chord] + share * places[:, following[chord]]
    gap = _mirrored(nodes, partners, angles) - nodes
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


def _partners(
    nodes: Complex, places: Complex, following: Index, axes: list[Axes]
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
    here, there = (points / size for points in ends)
    way = there[:, following] - there
    square = np.maximum((np.abs(way) ** 2).sum(axis=0), np.finfo(float).tiny)
    directions = [_directions(side, other) for side, other in (axes, axes[::-1])]
    for first in directions[0]:
        for second in directions[1]:
            image = np.stack([_image(here[0], first), _image(here[1], second)])
            offset = image[:, :, None] - there[:, None]
            share = (offset * way[:, None].conj()).real.sum(axis=0) / square
            share = np.clip(share, 0.0, 1.0)
            far = np.abs(offset - share * way[:, None]).max(axis=0)
            nearest = far.argmin(axis=1)
            weight = np.clip(2 - far.min(axis=1) / SAME_PLACE, 0.0, 1.0)
            even = weight.mean() >= NEARLY_ALL
            # Of several axes the one that the eye sees first: upright, or level.
            aslant = float(np.abs(np.sin(2 * np.array([first, second]))).sum())
            if even and aslant < least - 1e-6:
                along = share[np.arange(len(nearest)), nearest]
                best, least = (nearest, along, weight, float(first), float(second)), aslant
    return best


def _directions(axes: Axes, other: Axes) -> Floats:
    """Angles of the axes, each once; of a disc those of the other outline."""
    known = axes.directions if axes.around is None else other.directions
    return np.asarray(np.unique(np.round(known % np.pi, 6)))


def _image(points: Complex, angle: float) -> Complex:
    """Mirror images about an axis through the points' middle along the axis' own way."""
    turn = np.exp(2j * angle)
    across = 1j * np.exp(1j * angle)
    aside = (points * across.conjugate()).real
    middle = across * (aside.max() + aside.min()) / 2
    return np.asarray(middle + turn * (points - middle).conj())


def _mirrored(nodes: Complex, partners: Complex, angles: Floats) -> Complex:
    """Partners mirrored about the axis through the middle of both at each time, (F, N)."""
    middle = (nodes.mean(axis=1) + partners.mean(axis=1))[:, None] / 2
    return np.asarray(middle + np.exp(2j * angles)[:, None] * (partners - middle).conj())
