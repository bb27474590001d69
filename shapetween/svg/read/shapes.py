"""Basic shapes as subpaths.

Each starts and runs as SVG 2, chapter 10, says, so that it equals the path it stands for.
"""

from collections.abc import Callable, Mapping

import numpy as np

from shapetween.base.arrays import Curves, Points
from shapetween.geometry.bezier import line_curves
from shapetween.svg.read.arcs import ARC_HANDLE
from shapetween.svg.read.pathdata import PathData, Subpath, parse_path_data
from shapetween.svg.read.units import Viewport, numbers

__all__ = ["GEOMETRY", "SHAPES", "basic_shape"]

#: Attributes that say where a shape is, all of which style sheets may set too.
GEOMETRY = frozenset({"x", "y", "width", "height", "cx", "cy", "r", "rx", "ry", "d"})


def basic_shape(tag: str, values: Mapping[str, str], viewport: Viewport, most: int) -> PathData:
    """What a ``path`` or a basic shape draws.

    Parameters
    ----------
    tag : str
        A key of `SHAPES`.
    values : Mapping
        Attributes, and the properties that override them.
    viewport : Viewport
        What percentages are of.
    most : int
        Drawing commands after which to stop, as in `parse_path_data`.
    """
    return SHAPES[tag](values, viewport, most)


def _path(values: Mapping[str, str], viewport: Viewport, most: int) -> PathData:
    return parse_path_data(values.get("d", ""), most)


def _rect(values: Mapping[str, str], viewport: Viewport, most: int) -> PathData:
    x = viewport.length(values.get("x"), viewport.width) or 0.0
    y = viewport.length(values.get("y"), viewport.height) or 0.0
    width = viewport.length(values.get("width"), viewport.width) or 0.0
    height = viewport.length(values.get("height"), viewport.height) or 0.0
    if width <= 0 or height <= 0:
        return PathData((), 0)
    rx, ry = _radii(values, viewport)
    rx, ry = min(rx, width / 2), min(ry, height / 2)
    right, bottom = x + width, y + height
    if rx == 0 or ry == 0:
        return _polygon_of(np.array([[x, y], [right, y], [right, bottom], [x, bottom]]), True)
    corners = [
        (x + rx, y),
        (right - rx, y),
        (right, y + ry),
        (right, bottom - ry),
        (right - rx, bottom),
        (x + rx, bottom),
        (x, bottom - ry),
        (x, y + ry),
    ]
    # A rounded side is a line and a quarter; the line has no length where the radius is half.
    points = np.array([*corners, corners[0]])
    hidden = np.array([[right, y], [right, bottom], [x, bottom], [x, y]])
    pieces = []
    for i, corner in enumerate(hidden):
        first, last, after = points[2 * i], points[2 * i + 1], points[2 * i + 2]
        if (first != last).any():
            pieces.append(line_curves(first[None], last[None]))
        pieces.append(_quarter(last, corner, after))
    return _closed(np.concatenate(pieces))


def _radii(values: Mapping[str, str], viewport: Viewport) -> tuple[float, float]:
    """Both radii of a rect or an ellipse; one that is missing equals the other."""
    rx = viewport.length(values.get("rx"), viewport.width)
    ry = viewport.length(values.get("ry"), viewport.height)
    rx = None if rx is not None and rx < 0 else rx
    ry = None if ry is not None and ry < 0 else ry
    first = rx if rx is not None else ry
    second = ry if ry is not None else rx
    return first or 0.0, second or 0.0


def _circle(values: Mapping[str, str], viewport: Viewport, most: int) -> PathData:
    radius = viewport.length(values.get("r"), viewport.diagonal) or 0.0
    return _ellipse_of(values, viewport, radius, radius)


def _ellipse(values: Mapping[str, str], viewport: Viewport, most: int) -> PathData:
    return _ellipse_of(values, viewport, *_radii(values, viewport))


def _ellipse_of(values: Mapping[str, str], viewport: Viewport, rx: float, ry: float) -> PathData:
    if rx <= 0 or ry <= 0:
        return PathData((), 0)
    centre = np.array(
        [
            viewport.length(values.get("cx"), viewport.width) or 0.0,
            viewport.length(values.get("cy"), viewport.height) or 0.0,
        ]
    )
    ends = centre + np.array([[rx, 0], [0, ry], [-rx, 0], [0, -ry], [rx, 0]])
    corners = centre + np.array([[rx, ry], [-rx, ry], [-rx, -ry], [rx, -ry]])
    return _closed(np.concatenate([_quarter(ends[i], corners[i], ends[i + 1]) for i in range(4)]))


def _quarter(start: Points, corner: Points, end: Points) -> Curves:
    """A quarter of an ellipse between two points, tangent to the lines to a corner."""
    handles = [start + ARC_HANDLE * (corner - start), end + ARC_HANDLE * (corner - end)]
    return np.stack([start, *handles, end])[None]


def _line(values: Mapping[str, str], viewport: Viewport, most: int) -> PathData:
    ends = [
        [
            viewport.length(values.get(f"x{i}"), viewport.width) or 0.0,
            viewport.length(values.get(f"y{i}"), viewport.height) or 0.0,
        ]
        for i in (1, 2)
    ]
    return _polygon_of(np.array(ends), False)


def _polyline(values: Mapping[str, str], viewport: Viewport, most: int) -> PathData:
    return _points(values, most, closed=False)


def _polygon(values: Mapping[str, str], viewport: Viewport, most: int) -> PathData:
    return _points(values, most, closed=True)


def _points(values: Mapping[str, str], most: int, closed: bool) -> PathData:
    found, rest = numbers(values.get("points", ""), 2 * most + 2)
    points = np.array(found[: len(found) // 2 * 2]).reshape(-1, 2)
    problem = ""
    if (rest and len(points) <= most) or len(found) % 2:
        problem = f"its points are sound up to number {len(points) * 2}"
    return _polygon_of(points, closed, problem)


def _polygon_of(points: Points, closed: bool, problem: str = "") -> PathData:
    if len(points) < 2:
        return PathData((), len(points), problem)
    if closed and (points[0] != points[-1]).any():
        points = np.concatenate([points, points[:1]])
    subpath = Subpath(line_curves(points[:-1], points[1:]), points[0], closed)
    return PathData((subpath,), len(points), problem)


def _closed(curves: Curves) -> PathData:
    return PathData((Subpath(curves, curves[0, 0], True),), len(curves))


SHAPES: dict[str, Callable[[Mapping[str, str], Viewport, int], PathData]] = {
    "path": _path,
    "rect": _rect,
    "circle": _circle,
    "ellipse": _ellipse,
    "line": _line,
    "polyline": _polyline,
    "polygon": _polygon,
}
