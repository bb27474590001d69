"""The silhouette of a drawing: what its shapes cover together, as the few pieces it is seen as."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from shapetween.base.arrays import Points
from shapetween.boolean.area import filled_area
from shapetween.geometry.bezier import flatten, line_curves
from shapetween.model.drawing import Shape
from shapetween.model.outline import Outline
from shapetween.model.paint import Gradient, Paint, Stroke, Style

if TYPE_CHECKING:
    import shapely

__all__ = ["Areas", "covered", "covered_by", "opaqueness", "silhouette"]

Areas: TypeAlias = "np.ndarray[Any, np.dtype[np.object_]]"
"""Geometries of shapely, one for each shape."""

#: Chords of a curve. A silhouette only leads what is drawn, so a coarse one will do.
CHORDS = 8

#: Chords of a quarter turn of round caps, joins and closed gaps.
QUARTER = 4

#: Width of gaps that count as covered, as a share of the drawing's diagonal: seams between shapes
#: and between the lines of an icon. Larger glues legs together, smaller leaves shreds.
GAP = 0.03

#: Distance, as a share of the diagonal, within which the silhouette's corners are straightened.
STRAIGHT = 0.002

#: Least share of the largest piece's area that a piece has, and most pieces.
LEAST_PIECE, MOST_PIECES = 0.01, 8

#: Alpha below which a shape does not make part of the silhouette: shadows and shine.
LEAST_ALPHA = 0.4

_CAPS = {"butt": "flat", "round": "round", "square": "square"}


def silhouette(shapes: Sequence[Shape], areas: Areas, box: Points) -> tuple[Outline, ...]:
    """Outer outlines of what shapes cover together, the largest first; holes are filled.

    Parameters
    ----------
    shapes : sequence of Shape
    areas : (N,) of shapely.Geometry
        What each of them covers.
    box : (2, 2) float64
        Least and greatest corner of what is shown. What lies wholly outside does not count,
        unless all does.
    """
    import shapely

    drawn = ~shapely.is_empty(areas)
    shown = drawn & shapely.intersects(areas, shapely.box(*box.ravel()))
    solid = np.array([opaqueness(shape.style) >= LEAST_ALPHA for shape in shapes])
    best = next((some for some in (shown & solid, shown, drawn) if some.any()), None)
    if best is None:
        return ()
    union = shapely.union_all(areas[best])
    left, top, right, bottom = union.bounds
    size = float(np.hypot(right - left, bottom - top))
    gap = GAP * size / 2
    whole = shapely.union_all([shapely.Polygon(p.exterior) for p in _polygons(union)])
    closed = whole.buffer(gap, quad_segs=QUARTER).buffer(-gap, quad_segs=QUARTER)
    pieces = [shapely.Polygon(p.exterior).simplify(STRAIGHT * size) for p in _polygons(closed)]
    pieces = sorted((p for p in pieces if not p.is_empty), key=lambda p: -p.area)[:MOST_PIECES]
    return tuple(_outline(p) for p in pieces if p.area >= LEAST_PIECE * pieces[0].area)


def covered_by(shapes: Sequence[Shape]) -> Areas:
    """What each of some shapes covers, (N,)."""
    return np.array([covered(shape) for shape in shapes], dtype=object)


def covered(shape: Shape) -> "shapely.Geometry":
    """What a shape's fill and stroke cover."""
    import shapely

    stroke, areas = shape.style.stroke, []
    if shape.style.fill is not None:
        loops = [_points(ring) for ring in shape.rings]
        area = filled_area(loops, shape.style.fill_rule)
        # What crosses itself too often to be cut is taken for all that it goes round.
        areas.append(_around(loops) if area is None else area)
    if stroke is not None and stroke.width > 0:
        areas += [_stroked(ring, stroke) for ring in shape.rings]
    return shapely.union_all(areas)


def opaqueness(style: Style) -> float:
    """Mean alpha of what is painted, from 0 to 1."""
    paints = [style.fill, None if style.stroke is None else style.stroke.paint]
    return style.opacity * max(_alpha(paint) for paint in paints)


def _alpha(paint: Paint) -> float:
    if paint is None:
        return 0.0
    if isinstance(paint, Gradient):
        return float(np.mean([stop.colour.alpha for stop in paint.stops])) if paint.stops else 0.0
    return paint.alpha


def _around(loops: Sequence[Points]) -> "shapely.Geometry":
    import shapely

    polygons = [shapely.Polygon(loop) for loop in loops if len(loop) > 2]
    return shapely.union_all([shapely.make_valid(polygon) for polygon in polygons])


def _stroked(ring: Outline, stroke: Stroke) -> "shapely.Geometry":
    import shapely

    points = _points(ring)
    points = np.concatenate([points, points[:1] if ring.closed else ring.curves[-1:, 3]])
    return shapely.LineString(points).buffer(
        stroke.width / 2, quad_segs=QUARTER, cap_style=_CAPS[stroke.cap]
    )


def _points(ring: Outline) -> Points:
    return flatten(ring.curves, CHORDS)


def _polygons(area: "shapely.Geometry") -> "list[shapely.Polygon]":
    import shapely

    return [p for p in shapely.get_parts(area) if p.geom_type == "Polygon" and not p.is_empty]


def _outline(polygon: "shapely.Polygon") -> Outline:
    corners = np.array(polygon.exterior.coords)[:-1]
    ring = Outline(line_curves(corners, np.roll(corners, -1, axis=0)))
    return ring if ring.area > 0 else ring.reversed()
