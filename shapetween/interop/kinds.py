"""Kinds of shapes: how each becomes a drawing, and how a drawing becomes one again.

shapely and matplotlib are known by what their objects have, so neither is imported for others.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from itertools import pairwise
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np

from shapetween.base.arrays import Curves, Points
from shapetween.base.errors import InputError, OptionError
from shapetween.geometry.bezier import line_curves
from shapetween.geometry.polygon import polygon_area
from shapetween.model.drawing import Box, Drawing, Shape
from shapetween.model.outline import Outline
from shapetween.model.paint import Colour, Stroke, Style

__all__ = ["Kind", "kind_of"]

#: Drawing commands of path data that are read; more are no shape, and take minutes.
MOST_COMMANDS = 200_000

#: Least area of a ring that is there, as a share of the square of the drawing's size: what opens
#: from a point has none at first.
LEAST_AREA = 1e-12

#: How areas move unless told otherwise: without paint there is no other way to come than to grow
#: from nothing.
GROWS = {"change": "grow"}

#: What shapely calls lines.
LINES = frozenset({"LineString", "LinearRing", "MultiLineString"})

#: Width of a line as a share of the drawing's size: a stroke has one. Wider, and lines that run
#: side by side are one line; far thinner, and its pins have no reach.
LINE_WIDTH = 1e-3


@dataclass(frozen=True, slots=True)
class Kind:
    """One kind of shape.

    Attributes
    ----------
    name : str
        For messages, with its article.
    drawing : callable
        From a shape to a drawing of it.
    back : callable
        From a drawing to a shape.
    y_up : bool
        Whether y usually grows upwards.
    options : dict
        How it is moved unless told otherwise.
    """

    name: str
    drawing: Callable[[Any], Drawing]
    back: Callable[[Drawing], Any]
    y_up: bool
    options: Mapping[str, Any] = field(default_factory=dict)


def kind_of(shape: object, which: str) -> Kind:
    """The kind of a shape.

    Parameters
    ----------
    shape : object
    which : str
        What messages call it.

    Raises
    ------
    OptionError
        If it is of no kind that is known.
    """
    if isinstance(shape, str) and shape.lstrip()[:1] in ("M", "m"):
        return Kind("path data", _from_path_data, _to_path_data, False, GROWS)
    if isinstance(shape, str | bytes | PathLike | Drawing):
        return Kind("a drawing", _opened, lambda drawing: drawing, False)
    if getattr(shape, "geom_type", None) in LINES:
        several = shape.geom_type == "MultiLineString"  # type: ignore[attr-defined]
        # A geometry has no paint that could fade: what has no partner is drawn, and as little as
        # can be has none.
        options = {"change": "draw", "pairing": "loose"}
        return Kind("a line", _from_lines, lambda d: _to_lines(d, several), True, options)
    if hasattr(shape, "geom_type"):
        return Kind("a geometry", _from_geometry, _to_geometry, True, GROWS)
    if hasattr(shape, "to_polygons") and hasattr(shape, "vertices"):
        return Kind("a matplotlib path", _from_mpl, _to_mpl, True, GROWS)
    try:
        points = np.asarray(shape, dtype=np.float64)
    except (TypeError, ValueError):
        points = np.zeros(0)
    if points.ndim == 2 and points.shape[1] == 2 and len(points) >= 3:
        closing = bool((points[0] == points[-1]).all())
        return Kind("an array", _from_points, lambda d: _to_points(d, closing), True)
    kinds = (
        "path data, a Polygon, a LineString or several of them, points (N, 2), a matplotlib Path, "
        "or a drawing"
    )
    raise OptionError(f"the {which} shape is a {type(shape).__name__}; expected {kinds}")


def _one_shape(rings: list[Outline]) -> Drawing:
    """A drawing of one area; rings inside others are holes."""
    corners = np.array([ring.box for ring in rings])
    low, high = corners[:, 0].min(axis=0), corners[:, 1].max(axis=0)
    box = Box(*low.tolist(), *(high - low).tolist())
    return Drawing((Shape(tuple(rings), Style(fill_rule="evenodd")),), box)


def _polygon(points: Points) -> Outline:
    """A closed outline through points; the first one may come again at the end."""
    if not np.isfinite(points).all():
        raise OptionError("a shape has a coordinate that is no finite number")
    if (points[0] == points[-1]).all():
        points = points[:-1]
    if len(points) < 3:
        raise OptionError("a shape has fewer than three corners; it encloses no area")
    return Outline(line_curves(points, np.roll(points, -1, axis=0)))


def _from_path_data(text: str) -> Drawing:
    from shapetween.svg.read.pathdata import parse_path_data

    found = parse_path_data(text, MOST_COMMANDS)
    if found.problem or found.commands > MOST_COMMANDS:
        raise InputError("path data", found.problem or "too long")
    rings = [Outline(path.curves, False).close() for path in found.subpaths if len(path.curves)]
    if not rings:
        raise InputError("path data", "draws nothing")
    return _one_shape(rings)


def _to_path_data(drawing: Drawing) -> str:
    from shapetween.svg.write.numbers import decimals_of, path_data

    decimals = decimals_of(drawing)
    words: list[str] = []
    for shape in drawing.shapes:
        curves = np.concatenate([ring.curves for ring in shape.rings])[None]
        counts = [len(ring.curves) for ring in shape.rings]
        words += path_data(curves, counts, [ring.closed for ring in shape.rings], decimals)
    return "".join(words)


def _opened(shape: Any) -> Drawing:
    from shapetween.io.files import read_bytes
    from shapetween.svg.read.reader import read_svg

    if isinstance(shape, Drawing):
        return shape
    if isinstance(shape, bytes):
        return read_svg(shape, "SVG text")
    if isinstance(shape, str) and shape.lstrip()[:1] == "<":
        return read_svg(shape.encode(), "SVG text")
    return read_svg(read_bytes(Path(shape)), str(shape))


def _from_points(points: Any) -> Drawing:
    return _one_shape([_polygon(np.asarray(points, dtype=np.float64))])


def _to_points(drawing: Drawing, closing: bool) -> Points:
    ring = max(_rings(drawing), key=lambda ring: abs(ring.area))
    points = _corners(ring)
    return np.concatenate([points, points[:1]]) if closing else points


def _from_geometry(geometry: Any) -> Drawing:
    polygons = getattr(geometry, "geoms", [geometry])
    rings: list[Outline] = []
    for polygon in polygons:
        if polygon.geom_type != "Polygon":
            raise OptionError(
                f"a {polygon.geom_type}: expected a Polygon, a LineString, or several of one kind"
            )
        if polygon.is_empty:
            raise OptionError("a polygon is empty; it encloses no area")
        lines = (polygon.exterior, *polygon.interiors)
        rings += [_polygon(np.asarray(line.coords, dtype=np.float64)[:, :2]) for line in lines]
    return _one_shape(rings)


def _to_geometry(drawing: Drawing) -> Any:
    """A Polygon, or a MultiPolygon where there are several pieces."""
    import shapely

    size = max(drawing.drawn.width, drawing.drawn.height)
    flat = [_corners(ring) for ring in _rings(drawing)]
    found = [points for points in flat if abs(polygon_area(points)) > LEAST_AREA * size**2]
    # Outer rings run one way and holes the other; the largest ring is an outer one.
    areas = [float(polygon_area(points)) for points in found]
    outward = np.sign(areas[int(np.argmax(np.abs(areas)))])
    outers = [points for points, area in zip(found, areas, strict=True) if area * outward > 0]
    holes = [points for points, area in zip(found, areas, strict=True) if area * outward < 0]
    shells = [shapely.Polygon(points) for points in outers]
    inside: list[list[Points]] = [[] for _ in shells]
    for hole in holes:
        point = shapely.Polygon(hole).representative_point()
        around = [k for k, shell in enumerate(shells) if shell.covers(point)]
        if around:
            inside[min(around, key=lambda k: shells[k].area)].append(hole)
    made = [shapely.Polygon(outer, own) for outer, own in zip(outers, inside, strict=True)]
    return made[0] if len(made) == 1 else shapely.MultiPolygon(made)


def _from_lines(geometry: Any) -> Drawing:
    """Lines of a width that is nothing beside their size."""
    outlines = []
    for line in getattr(geometry, "geoms", [geometry]):
        points = np.asarray(line.coords, dtype=np.float64)[:, :2]
        if not np.isfinite(points).all():
            raise OptionError("a line has a coordinate that is no finite number")
        points = points[np.append(True, (np.diff(points, axis=0) != 0).any(axis=1))[: len(points)]]
        if len(points) < 2:
            raise OptionError("a line is empty, or a single point")
        closed = len(points) > 3 and bool((points[0] == points[-1]).all())
        outlines.append(Outline(line_curves(points[:-1], points[1:]), closed))
    if not outlines:
        raise OptionError("a geometry of lines has none")
    ends = np.concatenate([outline.curves.reshape(-1, 2) for outline in outlines])
    low, size = ends.min(axis=0), np.ptp(ends, axis=0)
    width = LINE_WIDTH * float(size.max())
    style = Style(fill=None, stroke=Stroke(Colour(), width))
    shapes = tuple(Shape((outline,), style) for outline in outlines)
    return Drawing(shapes, Box(*low.tolist(), *np.maximum(size, width).tolist()))


def _to_lines(drawing: Drawing, several: bool) -> Any:
    """A LineString, or a MultiLineString where there are several or may be."""
    import shapely

    # What is not there yet, or no more, is not seen, but has a length: an outline may follow it.
    seen = [shape for shape in drawing.shapes if shape.style.opacity > 0]
    found = [
        shapely.LineString(np.concatenate([ring.curves[:, 0], ring.curves[-1:, 3]]))
        for shape in seen
        for ring in shape.rings
    ]
    if len(found) == 1 and not several:
        return found[0]
    return shapely.MultiLineString(found)


def _from_mpl(path: Any) -> Drawing:
    rings = []
    for points, codes in _mpl_runs(path):
        curves = _mpl_curves(points, codes)
        if len(curves):
            rings.append(Outline(curves, bool((curves[0, 0] == curves[-1, 3]).all())).close())
    if not rings:
        raise OptionError("a matplotlib path draws nothing")
    return _one_shape(rings)


def _mpl_runs(path: Any) -> list[tuple[Points, Any]]:
    """Vertices and codes from each moveto to the next."""
    vertices = np.asarray(path.vertices, dtype=np.float64)
    codes = path.codes
    if codes is None:
        codes = np.array([1] + [2] * (len(vertices) - 1))
    starts = np.flatnonzero(np.asarray(codes) == 1)
    cuts = [*starts.tolist(), len(vertices)]
    return [(vertices[i:j], codes[i:j]) for i, j in pairwise(cuts) if j - i > 1]


def _mpl_curves(points: Points, codes: Any) -> Curves:
    """The curves of one run, by matplotlib's codes: 2 a line, 3 and 4 curves, 79 a closing line."""
    curves, here, k = [], points[0], 1
    while k < len(points):
        code = int(codes[k])
        if code == 4:
            curve = np.array([here, *points[k : k + 3]])
        elif code == 3:
            control, end = points[k : k + 2]
            thirds = here + 2 / 3 * (control - here), end + 2 / 3 * (control - end)
            curve = np.array([here, *thirds, end])
        elif code in (2, 79):
            end = points[0] if code == 79 else points[k]
            curve = line_curves(here, end)
        else:
            break
        if (curve != here).any():
            curves.append(curve)
        here = curve[-1]
        k += {4: 3, 3: 2}.get(code, 1)
    return np.array(curves).reshape(-1, 4, 2)


def _to_mpl(drawing: Drawing) -> Any:
    from matplotlib.path import Path as MplPath

    vertices, codes = [], []
    for ring in _rings(drawing):
        vertices += [ring.curves[:1, 0], ring.curves[:, 1:].reshape(-1, 2), ring.curves[:1, 0]]
        codes += [1] + [4] * (3 * len(ring.curves)) + [79]
    return MplPath(np.concatenate(vertices), codes)


def _rings(drawing: Drawing) -> list[Outline]:
    return [ring for shape in drawing.shapes for ring in shape.rings]


def _corners(ring: Outline) -> Points:
    """Where a ring's curves meet: between polygons they are straight lines at all times."""
    return ring.curves[:, 0]
