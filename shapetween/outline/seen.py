"""How much of what crosses itself on the way is to be seen."""

from dataclasses import dataclass

import numpy as np

from shapetween.base.arrays import Curves, Points
from shapetween.geometry.bezier import flatten

__all__ = ["NOT_SEEN", "UNSEEN", "Seen", "seen_crossings"]

#: Width of what is wound wrongly, as a share of the drawing's longer side, up to which nobody sees
#: it: a tenth of a pixel at 1000.
UNSEEN = 1e-4

#: Chords of a curve in which it is looked at, and of all of them about, where they are so many that
#: each has fewer. More take seconds on an outline like a coast; with fewer, bends are cut short.
CHORDS, MOST_CHORDS = 8, 40_000

#: Faces whose windings are found at once, over so many segments; more cost memory.
AT_ONCE = 2_000_000


@dataclass(frozen=True, slots=True)
class Seen:
    """The worst of some frames.

    Attributes
    ----------
    area : float
        Of all that is wound wrongly, as a share of the drawing's own area.
    width : float
        Of the widest piece of it, as a share of the drawing's longer side.
    """

    area: float
    width: float

    @property
    def nothing(self) -> bool:
        """Whether it is too little to be seen."""
        return self.width <= UNSEEN


NOT_SEEN = Seen(0.0, 0.0)


def seen_crossings(curves: Curves, counts: tuple[int, ...], area: float, size: float) -> Seen:
    """What is seen of crossings in frames.

    Parameters
    ----------
    curves : (F, P, 4, 2) float64
        Curves of all rings, one ring after the other; outer ones clockwise as drawn, holes not.
    counts : tuple of int
        Number of curves of each ring.
    area, size : float
        Of the drawing, and its longer side.
    """
    worst = NOT_SEEN
    ends = np.cumsum(counts)[:-1]
    chords = min(CHORDS, -(-MOST_CHORDS // curves.shape[1]))
    for frame in curves:
        rings = [flatten(ring, chords) for ring in np.split(frame, ends)]
        wrong, width = _wound_wrongly(rings)
        worst = Seen(max(worst.area, wrong / area), max(worst.width, width / size))
    return worst


def _wound_wrongly(rings: list[Points]) -> tuple[float, float]:
    """Area of what is neither inside once nor outside, and the width of its widest piece."""
    import shapely

    closed = [np.concatenate([ring, ring[:1]]) for ring in rings]
    edges = shapely.node(shapely.multilinestrings([shapely.linestrings(ring) for ring in closed]))
    faces = shapely.get_parts(shapely.polygonize(shapely.get_parts(edges)))
    if not len(faces):
        return 0.0, 0.0
    inside = shapely.get_coordinates(shapely.point_on_surface(faces))
    winding = np.zeros(len(faces))
    segments = sum(len(ring) for ring in rings)
    for some in np.array_split(np.arange(len(faces)), 1 + len(faces) * segments // AT_ONCE):
        x, y = inside[some, :1], inside[some, 1:]
        for ring in closed:
            u, v = ring.T
            # Edges that go up past a place on its right, less those that go down there.
            above = v > y
            up = above[:, 1:].astype(np.int8) - above[:, :-1]
            side = np.diff(u) * (y - v[:-1]) - (x - u[:-1]) * np.diff(v)
            winding[some] += (up * (side * up > 0)).sum(axis=1)
    wrong = (np.abs(winding) > 0.5) & (np.abs(winding - 1) > 0.5)
    areas, lengths = shapely.area(faces)[wrong], shapely.length(faces)[wrong]
    return float(areas.sum()), float((2 * areas / lengths).max(initial=0.0))
