"""Painted areas as polygons, and back to rings.

Only what a clip path really cuts comes here. Curves become chords for shapely, which does the
cutting; afterwards every run of chords that came from one curve is that curve again, so that a cut
shape has few curves and all of them its own.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from shapetween.arrays import Curves, Index, Mask, Points
from shapetween.geometry.bezier import evaluate, line_curves, sub_curves
from shapetween.geometry.polygon import cross
from shapetween.outline import Outline
from shapetween.paint import FillRule, Stroke

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry

__all__ = ["Chords", "filled_area", "stroked_area"]

#: Chords one curve is cut into. More makes a cut more exact and slower; with 32, a quarter circle
#: is off by 0.03 % of its radius, as its cubic is.
CHORDS = 32

#: Distance of handles from a chord over its length, below which the curve is the chord.
STRAIGHT = 1e-9

#: Edges whose boxes meet, for each edge, up to which an outline that is not simple is cut where it
#: crosses itself. Drawn shapes have a handful; scribbles with more would take minutes.
MOST_MEETINGS = 12

#: Edges of which the meetings are counted.
SAMPLED_EDGES = 200

#: Points times edges whose winding is found at once; more takes memory, less takes time.
WINDING_BATCH = 4_000_000


class Chords:
    """Chords of a shape's rings, which remember the curves they came from.

    Parameters
    ----------
    rings : sequence of Outline
    """

    def __init__(self, rings: tuple[Outline, ...]) -> None:
        self._curves: Curves = np.concatenate([ring.curves for ring in rings])
        #: Every point of a bent curve's chords: which curves, and where on them.
        self._places: dict[tuple[float, float], set[tuple[int, int]]] = defaultdict(set)
        self.polylines: list[Points] = []
        points = evaluate(self._curves, np.arange(CHORDS + 1) / CHORDS)
        points[:, 0], points[:, -1] = self._curves[:, 0], self._curves[:, 3]
        bent = ~_straight(self._curves)
        first = 0
        for ring in rings:
            parts = []
            for index in range(first, first + len(ring.curves)):
                parts.append(points[index, : CHORDS if bent[index] else 1])
                if bent[index]:
                    for step, (x, y) in enumerate(points[index].tolist()):
                        self._places[x, y].add((index, step))
            first += len(ring.curves)
            self.polylines.append(np.concatenate([*parts, ring.curves[-1:, 3]]))

    @property
    def count(self) -> int:
        """Points of all polylines."""
        return sum(map(len, self.polylines))

    def rings(self, area: BaseGeometry) -> tuple[Outline, ...]:
        """Rings around an area that was cut out of this shape; its holes run the other way."""
        import shapely

        polygons = shapely.get_parts(shapely.orient_polygons(area))
        found = []
        for polygon in polygons:
            if polygon.geom_type != "Polygon":
                continue  # lines and points where areas only touch
            for ring in shapely.get_rings(polygon):
                points = shapely.get_coordinates(ring)[:-1]
                if len(points) > 2:
                    found.append(self._with_curves(points))
        return tuple(found)

    def _with_curves(self, points: Points) -> Outline:
        """A polygon's ring, with runs of one curve's chords replaced by that curve's part."""
        corners = [*map(tuple, points.tolist())]
        edges = [
            self._edge(*pair) for pair in zip(corners, [*corners[1:], corners[0]], strict=True)
        ]
        # Start where no run goes on, so that no run is broken by the start.
        start = next((i for i in range(len(edges)) if not _goes_on(edges[i - 1], edges[i])), 0)
        edges = edges[start:] + edges[:start]
        points = np.roll(points, -start, axis=0)
        bounds = [i for i in range(len(edges)) if i == 0 or not _goes_on(edges[i - 1], edges[i])]
        curves = []
        for low, high in zip(bounds, [*bounds[1:], len(edges)], strict=True):
            start_edge, end_edge = edges[low], edges[high - 1]
            ends = points[low], points[high % len(points)]
            if start_edge is None or end_edge is None:
                curves.append(line_curves(*ends))
                continue
            curve = self._curves[start_edge[0]][None]
            part = sub_curves(
                curve, *(np.array([at / CHORDS]) for at in (start_edge[1], end_edge[2]))
            )
            part[0, 0], part[0, 3] = ends
            curves.append(part[0])
        return Outline(np.stack(curves))

    def _edge(self, start: tuple[float, float], end: tuple[float, float]) -> _Edge:
        """The curve whose chord runs between two points, in either direction."""
        reached = self._places.get(end, ())
        for index, step in self._places.get(start, ()):
            for other in (step + 1, step - 1):
                if (index, other) in reached:
                    return index, step, other
        return None


_Edge: TypeAlias = tuple[int, int, int] | None


def _goes_on(one: _Edge, other: _Edge) -> bool:
    """Whether two chords follow one another on the same curve, in the same direction."""
    return (
        one is not None
        and other is not None
        and one[0] == other[0]
        and one[2] == other[1]
        and one[2] - one[1] == other[2] - other[1]
    )


def _straight(curves: Curves) -> Mask:
    """Curves that one chord draws."""
    offsets = curves[:, 1:] - curves[:, :1]
    chord = offsets[:, 2]
    across = np.abs(cross(offsets[:, :2], chord[:, None])).max(axis=1)
    along = (offsets[:, :2] * chord[:, None]).sum(axis=-1)
    size = (chord * chord).sum(axis=-1)
    within = ((along >= 0) & (along <= size[:, None])).all(axis=1)
    return np.asarray((across <= STRAIGHT * size) & within)


def filled_area(polylines: Sequence[Points], rule: FillRule) -> BaseGeometry | None:
    """The area that rings fill together.

    Parameters
    ----------
    polylines : sequence of (N, 2) float64
        An open one is closed by a line, as a fill is.
    rule : {"nonzero", "evenodd"}

    Returns
    -------
    geometry or None
        None if the rings cross so often that cutting them would take too long.
    """
    import shapely

    closed = [np.concatenate([line, line[:1]]) for line in polylines if len(line) > 2]
    if not closed:
        return shapely.Polygon()
    if len(closed) == 1:
        polygon = shapely.Polygon(closed[0])
        if polygon.is_valid:
            return polygon
    starts = np.concatenate([line[:-1] for line in closed])
    ends = np.concatenate([line[1:] for line in closed])
    if _meetings(starts, ends) > MOST_MEETINGS:
        return None
    nodes = shapely.union_all([shapely.LineString(line) for line in closed])
    faces = shapely.get_parts(shapely.polygonize([nodes]))
    if not len(faces):
        return shapely.Polygon()
    inside = shapely.get_coordinates(shapely.point_on_surface(faces))
    turns = _windings(inside, starts, ends)
    kept = turns % 2 == 1 if rule == "evenodd" else turns != 0
    return shapely.union_all(faces[kept])


def _meetings(starts: Points, ends: Points) -> float:
    """How many edges' boxes an edge's box meets in the mean, from a sample of the edges."""
    import shapely

    least, greatest = np.minimum(starts, ends), np.maximum(starts, ends)
    boxes = shapely.box(*least.T, *greatest.T)
    sample = boxes[:: max(1, len(boxes) // SAMPLED_EDGES)]
    found = shapely.STRtree(boxes).query(sample)
    return float(found.shape[1] / len(sample))


def _windings(points: Points, starts: Points, ends: Points) -> Index:
    """How often edges run around each point, (P,): crossings of the ray to its right."""
    turns = np.zeros(len(points), dtype=np.intp)
    batch = max(1, WINDING_BATCH // len(starts))
    for first in range(0, len(points), batch):
        y = points[first : first + batch, None, 1]
        above, below = starts[:, 1] <= y, ends[:, 1] <= y
        side = cross(ends - starts, points[first : first + batch, None] - starts)
        turns[first : first + batch] = (above & ~below & (side > 0)).sum(axis=1) - (
            ~above & below & (side < 0)
        ).sum(axis=1)
    return turns


def stroked_area(
    polylines: Sequence[Points], closed: Sequence[bool], stroke: Stroke
) -> BaseGeometry | None:
    """The area that a stroke paints, its dashes left aside; None as for `filled_area`."""
    import shapely

    starts = np.concatenate([line[:-1] for line in polylines])
    ends = np.concatenate([line[1:] for line in polylines])
    if _meetings(starts, ends) > MOST_MEETINGS:
        return None
    lines = []
    for points, ring in zip(polylines, closed, strict=True):
        if (points == points[0]).all():
            lines.append(shapely.Point(points[0]))
        elif ring and len(points) > 3:
            lines.append(shapely.LinearRing(points))
        else:
            lines.append(shapely.LineString(points))
    painted = shapely.buffer(
        np.array(lines),
        stroke.width / 2,
        quad_segs=CHORDS // 2,
        cap_style={"butt": "flat"}.get(stroke.cap, stroke.cap),
        join_style={"miter": "mitre"}.get(stroke.join, stroke.join),
        mitre_limit=stroke.miter_limit,
    )
    return shapely.union_all(painted)
