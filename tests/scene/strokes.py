"""Strokes as filled outlines, drawn by the tests' own means."""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
import shapely

from shapetween.base.arrays import Curves, Points
from shapetween.fill.regions import Region
from shapetween.geometry.bezier import evaluate, line_curves
from shapetween.model.outline import Outline

#: Handle of a quarter of a circle drawn as a cubic, as a share of its radius.
QUARTER = 4 / 3 * np.tan(np.pi / 8)


def polyline(*points: tuple[float, float]) -> Outline:
    p = np.array(points, dtype=float)
    return Outline(line_curves(p[:-1], p[1:]), closed=False)


def arc(centre: tuple[float, float], radius: float, start: float, quarters: int) -> Outline:
    """An arc of a circle by quarters, clockwise from an angle in degrees."""
    curves = []
    for k in range(quarters):
        a = np.deg2rad(start) + np.pi / 2 * np.array([k, k + 1])
        spoke = np.stack([np.cos(a), np.sin(a)], axis=1)
        along = np.stack([-spoke[:, 1], spoke[:, 0]], axis=1) * QUARTER
        handles = [spoke[0], spoke[0] + along[0], spoke[1] - along[1], spoke[1]]
        curves.append(np.array(centre) + radius * np.array(handles))
    curves = [c.copy() for c in curves]
    for one, other in pairwise(curves):
        other[0] = one[3]
    if quarters == 4:
        curves[-1][3] = curves[0][0]
    return Outline(np.array(curves), closed=quarters == 4)


def flat(curves: Curves, steps: int = 64) -> Points:
    return evaluate(curves, np.arange(steps) / steps).reshape(-1, 2)


def painted(lines: Sequence[Outline], width: float, quarter: int = 32) -> shapely.Polygon:
    """What strokes with round caps and joins paint, an independent oracle."""
    drawn = []
    for line in lines:
        points = np.concatenate([flat(line.curves), line.curves[-1:, 3]])
        drawn.append(shapely.LineString(points).buffer(width / 2, quad_segs=quarter))
    area = shapely.union_all(drawn)
    assert isinstance(area, shapely.Polygon)
    return area


def region_of(area: shapely.Polygon) -> Region:
    """A polygon's many sides as a region."""

    def ring(line: shapely.LinearRing) -> Outline:
        points = shapely.get_coordinates(line)
        outline = Outline(line_curves(points[:-1], points[1:]))
        return outline if outline.area > 0 else outline.reversed()

    return Region(ring(area.exterior), tuple(ring(hole) for hole in area.interiors))
