"""An outline without its fine detail: a polygon through some of its own points.

Coasts of ten thousand curves are as long as one cares to measure them, so nothing can be matched
by their length, and few of their points can move as nodes. Their coarse shape is matched and moved
in their stead, and the detail is carried.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from shapetween.base.arrays import Floats, Points
from shapetween.geometry.bezier import evaluate, flatten, line_curves
from shapetween.geometry.polygon import cross
from shapetween.model.arclength import ArcLength, arc_length
from shapetween.model.outline import Outline

__all__ = ["Coarse", "coarse"]

#: Points that an outline is read from at least; one of fewer curves has several chords for each.
LEAST_POINTS = 4000

#: Distance, as a share of the root of the area, by which points may be off the first polygon
#: tried, and how much larger it is for each further one. Finer detail is never seen to move.
FINEST, COARSER = 1e-3, 1.25

#: Places of a side at which its share of the outline is read. Fewer, and what is matched on the
#: outline is a little off on the polygon; more cost time.
READ = 4

#: Share of a side nearer than which a place is the corner there.
AT_CORNER = 1e-9


@dataclass(frozen=True, eq=False)
class Coarse:
    """An outline and a polygon through some of its points.

    A place on the outline is a number: which curve, plus the parameter on it.

    Attributes
    ----------
    outline : Outline
    corners : (n,) float64
        Places of the polygon's corners, increasing.
    left_out : float
        How far the outline may be off the polygon, in user units.
    """

    outline: Outline
    corners: Floats
    left_out: float

    @cached_property
    def polygon(self) -> Outline:
        """The polygon as an outline of straight lines."""
        points = self.points(self.corners)
        return Outline(line_curves(points, np.roll(points, -1, axis=0)))

    @cached_property
    def lengths(self) -> ArcLength:
        """Places on the polygon by length."""
        return arc_length(self.polygon)

    def points(self, places: Floats) -> Points:
        """Points at places, (N, 2)."""
        whole = np.floor(places)
        curves = self.outline.curves[whole.astype(np.intp) % len(self.outline.curves)]
        return np.asarray(evaluate(curves, (places - whole)[:, None])[:, 0])

    def joints(self, first: float, last: float) -> Floats:
        """Places of all joints strictly between two places, one turn being N curves."""
        return np.arange(np.floor(first) + 1, np.ceil(last))

    def lifted(self, fractions: Floats) -> Floats:
        """Places on the outline for places on its polygon.

        Parameters
        ----------
        fractions : (N,) float64
            Fractions of the polygon's length, increasing but for one step back over its start.

        Returns
        -------
        (N,) float64
            Increasing in the same way. A corner is its own place; on a side it is where the
            outline crosses the line square to the side nearest to it.
        """
        side, share = self.lengths.locate(fractions)
        late = share > 1 - AT_CORNER
        side = np.where(late, (side + 1) % len(self.corners), side)
        share = np.where(late | (share < AT_CORNER), 0.0, share)
        places = self.corners[side]
        for k in np.unique(side[share > 0]).tolist():
            on = np.flatnonzero((side == k) & (share > 0))
            on = on[np.argsort(share[on])]
            places[on] = self._across(k, share[on])
        return places

    def lowered(self, fractions: Floats) -> Floats:
        """Fractions of the polygon's length for fractions of the outline's; undoes `lifted`.

        Parameters
        ----------
        fractions : (N,) float64
            From 0 to 1.
        """
        joints = np.append(self.lengths.joints, 1.0)
        known = (joints[:-1, None] + np.diff(joints)[:, None] * np.arange(READ) / READ).ravel()
        places = self.lifted(known)
        start, count = places[0], len(self.outline.curves)
        places = np.maximum.accumulate(start + (places - start) % count)
        curve, t = arc_length(self.outline).locate(fractions % 1)
        wanted = start + (curve + t - start) % count
        ends = np.append(places, start + count), np.append(known, known[0] + 1)
        return np.asarray(np.interp(wanted, *ends) % 1)

    def _across(self, side: int, shares: Floats) -> Floats:
        """Places on the run of the outline beside one side, for rising shares of that side."""
        count = len(self.outline.curves)
        first = float(self.corners[side])
        last = float(self.corners[side + 1]) if side + 1 < len(self.corners) else count
        last += self.corners[0] if side + 1 == len(self.corners) else 0.0
        # A curve is read as four chords, so that the place is near even on a long one.
        fine = np.arange(np.floor(4 * first) + 1, np.ceil(4 * last)) / 4
        places = np.concatenate([[first], fine, [last]])
        points = self.points(places)
        chord = points[-1] - points[0]
        square = float(chord @ chord)
        along = (points - points[0]) @ chord / square
        along[-1] = 1.0
        off = cross(chord, points - points[0]) / square
        found, least = [], 0
        for share in shares.tolist():
            before, after = along[least:-1], along[least + 1 :]
            passing = np.flatnonzero((before <= share) & (after > share)) + least
            step = (share - along[passing]) / (along[passing + 1] - along[passing])
            away = np.abs(off[passing] + step * (off[passing + 1] - off[passing]))
            best = int(away.argmin())
            at = int(passing[best])
            found.append(places[at] + step[best] * (places[at + 1] - places[at]))
            least = at
        return np.asarray(found) % count


def coarse(outline: Outline, most: int) -> Coarse | None:
    """The finest polygon of at most so many corners that stays near an outline.

    Parameters
    ----------
    outline : Outline
        Closed and simple.
    most : int
        At least 4.

    Returns
    -------
    Coarse or None
        None where no such polygon is simple.
    """
    import shapely

    count = len(outline.curves)
    chords = max(1, -(-LEAST_POINTS // count))
    points = flatten(outline.curves, chords)
    rest = shapely.Polygon(points)
    tolerance = FINEST * float(np.sqrt(abs(outline.area)))
    left_out = 0.0
    while tolerance < float(np.ptp(outline.box, axis=0).max()):
        rest = shapely.simplify(rest, tolerance)
        left_out += tolerance
        if shapely.get_num_coordinates(rest) <= most + 1:
            break
        tolerance *= COARSER
    ring = shapely.get_exterior_ring(rest)
    if len(shapely.get_coordinates(ring)) < 4 or not shapely.is_simple(ring):
        return None
    return Coarse(outline, _among(shapely.get_coordinates(ring)[:-1], points) / chords, left_out)


def _among(some: Points, points: Points) -> Floats:
    """Where each of some points is among all points of a ring, increasing.

    They follow one another in the same order, but may start anywhere.
    """
    known, first = points.tolist(), some[0].tolist()
    start = at = known.index(first)
    found = []
    for wanted in some.tolist():
        while known[at % len(known)] != wanted:
            at += 1
        found.append(at % len(known))
        at += 1
    assert at <= start + len(known)
    return np.sort(np.asarray(found, dtype=np.float64))
