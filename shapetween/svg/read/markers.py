"""Markers on lines: what they draw at a line's vertices.

.. [SVG2] *Scalable Vector Graphics 2*, section 13.7.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from xml.etree.ElementTree import Element

import numpy as np

from shapetween.base.arrays import Points
from shapetween.geometry.affine import affine, compose, mapped, mean_scale
from shapetween.geometry.bezier import end_tangents
from shapetween.model.drawing import Box
from shapetween.svg.read.colours import parse_paint
from shapetween.svg.read.document import Document
from shapetween.svg.read.frames import Layer, Placed
from shapetween.svg.read.pathdata import Subpath
from shapetween.svg.read.subpaths import subpaths_of
from shapetween.svg.read.units import Viewport, number
from shapetween.svg.read.viewbox import fit, parse_view_box
from shapetween.svg.read.walk import walk
from shapetween.svg.read.xml import local_name

__all__ = ["markers_of"]

#: Elements that may have markers.
MARKED = frozenset({"path", "line", "polyline", "polygon"})

#: Markers within markers; browsers draw none.
MOST_NESTED = 1

_ANGLES = {"": 1.0, "deg": 1.0, "grad": 0.9, "turn": 360.0, "rad": 180 / math.pi}


@dataclass(frozen=True, slots=True, eq=False)
class _Vertex:
    """A vertex of a line, with the directions in which the line reaches and leaves it."""

    place: Points
    reaching: Points | None
    leaving: Points | None

    @property
    def angle(self) -> float:
        """Of the direction halfway between both, in degrees ([SVG2]_, 13.7.4)."""
        known = [way for way in (self.reaching, self.leaving) if way is not None]
        total = sum(known, np.zeros(2))
        if not known:
            return 0.0
        if not total.any():
            total = np.array([-known[0][1], known[0][0]])
        return math.degrees(math.atan2(total[1], total[0]))


def markers_of(document: Document, placed: Placed) -> Iterator[Placed]:
    """What the markers of a shape's element draw, in paint order.

    Raises
    ------
    BudgetError
    """
    properties = placed.frame.properties
    names = {
        place: properties.get(f"marker-{place}", properties.get("marker", "none"))
        for place in ("start", "mid", "end")
    }
    if placed.tag not in MARKED or all(name.lower() == "none" for name in names.values()):
        return
    if placed.frame.context is not None or properties.get("visibility", "visible") != "visible":
        return
    markers = {place: _marker(document, name) for place, name in names.items()}
    vertices = _vertices(subpaths_of(document, placed))
    for k, vertex in enumerate(vertices):
        places = [
            place
            for place, here in (
                ("start", k == 0),
                ("mid", 0 < k < len(vertices) - 1),
                ("end", k == len(vertices) - 1),
            )
            if here
        ]
        for place in places:
            marker = markers[place]
            if marker is not None:
                yield from _drawn(document, placed, marker, vertex, at_start=place == "start")


def _marker(document: Document, text: str) -> Element | None:
    value = parse_paint(text) if text.lower() != "none" else None
    target = document.ids.get(value.reference) if value is not None else None
    return target if target is not None and local_name(target) == "marker" else None


def _vertices(subpaths: Sequence[Subpath]) -> list[_Vertex]:
    found: list[_Vertex] = []
    for subpath in subpaths:
        curves = subpath.curves
        points = [subpath.start, *curves[:, 3]]
        ways: list[Points | None] = []
        leaving: list[Points | None] = []
        for curve in curves:
            start, end = end_tangents(curve[None])
            still = not np.ptp(curve, axis=0).any()
            leaving.append(None if still else np.asarray(start[0]))
            ways.append(None if still else np.asarray(end[0]))
        if subpath.closed:
            line = subpath.start - points[-1]
            length = float(np.linalg.norm(line))
            points.append(subpath.start)
            way = line / length if length else (ways[-1] if ways else None)
            leaving.append(way)
            ways.append(way)
        count = len(points)
        for k, point in enumerate(points):
            reaching = ways[k - 1] if k > 0 else None
            after = leaving[k] if k < len(leaving) else None
            if subpath.closed and k in (0, count - 1) and ways:
                reaching, after = ways[-1], leaving[0]
            found.append(_Vertex(np.asarray(point), reaching, after))
    return found


def _drawn(
    document: Document, placed: Placed, marker: Element, vertex: _Vertex, *, at_start: bool
) -> Iterator[Placed]:
    """What one marker draws at one vertex."""
    frame = placed.frame
    viewport = frame.viewport
    document.spend("use_copies")
    width = viewport.length(frame.properties.get("stroke-width", "1"), viewport.diagonal)
    scale = 1.0 if width is None else width
    if marker.get("markerUnits", "strokeWidth").strip() == "userSpaceOnUse":
        scale = 1.0
    across = viewport.length(marker.get("markerWidth", "3"), viewport.width)
    down = viewport.length(marker.get("markerHeight", "3"), viewport.height)
    if not across or not down or across < 0 or down < 0 or scale <= 0:
        return
    orient = marker.get("orient", "0").strip()
    angle = vertex.angle
    if orient == "auto-start-reverse":
        angle += 180.0 if at_start else 0.0
    elif orient != "auto":
        angle = _angle(orient)
    c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
    x, y = vertex.place.tolist()
    matrix = compose(frame.matrix, affine(scale * c, scale * s, -scale * s, scale * c, x, y))
    view = parse_view_box(marker.get("viewBox"))
    into = Box(0.0, 0.0, across, down)
    step = fit(view, into, marker.attrib) if view is not None else affine(1, 0, 0, 1, 0, 0)
    box = view if view is not None else into
    local = Viewport(box.width, box.height, viewport.font_size, viewport.root_font_size)
    words = {"left": 0.0, "top": 0.0, "center": 0.5, "right": 1.0, "bottom": 1.0}
    reference = []
    for name, start, size in (("refX", box.x, box.width), ("refY", box.y, box.height)):
        text = marker.get(name, "0").strip()
        value = start + words[text] * size if text in words else local.length(text, size)
        reference.append(value or 0.0)
    shift = mapped(np.array(reference), step)
    origin = affine(1, 0, 0, 1, *(-shift).tolist())
    inner = compose(compose(matrix, origin), step)
    if mean_scale(inner) == 0 or not np.isfinite(inner).all():
        return
    properties = document.style(marker)
    layers = frame.layers
    if properties.get("overflow", "hidden") not in ("visible", "auto"):
        corners = np.array([[0.0, 0.0], [across, 0.0], [across, down], [0.0, down]])
        layers = (*layers, Layer(marker, frame, clip=mapped(corners, compose(matrix, origin))))
    own = frame.properties
    inside = replace(
        frame,
        matrix=inner,
        properties=properties,
        viewport=local,
        layers=layers,
        uses=(*frame.uses, marker),
        name=frame.name or placed.name,
        context=(own.get("fill", "black"), own.get("stroke", "none")),
    )
    for child in marker:
        yield from walk(document, child, inside)


def _angle(text: str) -> float:
    """A fixed angle in degrees."""
    for unit in sorted(_ANGLES, key=len, reverse=True):
        if text.endswith(unit):
            value = number(text.removesuffix(unit))
            return 0.0 if value is None else value * _ANGLES[unit]
    return 0.0
