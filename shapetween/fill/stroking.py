"""A stroked line as the area that its stroke covers."""

import numpy as np

from shapetween.geometry.bezier import evaluate, line_curves
from shapetween.model.drawing import Shape
from shapetween.model.outline import Outline
from shapetween.model.paint import Style

__all__ = ["outlined"]

#: Chords of a curve, and of a quarter turn of a round cap or join.
CHORDS, QUARTER = 16, 8

_CAPS = {"butt": "flat", "round": "round", "square": "square"}
_JOINS = {"miter": "mitre", "round": "round", "bevel": "bevel"}


def outlined(shape: Shape) -> Shape:
    """A stroked shape without fill as a filled one that looks the same; dashes are closed."""
    import shapely

    stroke = shape.style.stroke
    if stroke is None:
        return shape
    areas = []
    for ring in shape.rings:
        points = evaluate(ring.curves, np.linspace(0, 1, CHORDS, endpoint=False)).reshape(-1, 2)
        points = np.concatenate([points, ring.curves[-1:, 3]])
        line = shapely.LinearRing(points[:-1]) if ring.closed else shapely.LineString(points)
        areas.append(
            line.buffer(
                stroke.width / 2,
                quad_segs=QUARTER,
                cap_style=_CAPS[stroke.cap],
                join_style=_JOINS[stroke.join],
                mitre_limit=stroke.miter_limit,
            )
        )
    rings = []
    for area in shapely.get_parts(shapely.union_all(areas)):
        for boundary in (area.exterior, *area.interiors):
            corners = np.array(boundary.coords)[:-1]
            rings.append(Outline(line_curves(corners, np.roll(corners, -1, axis=0))))
    style = Style(stroke.paint, None, shape.style.opacity, "evenodd")
    return Shape(tuple(rings), style, shape.name)
