"""A picture of matched meshes, for a person to see what goes where and what to change.

Both shapes stand side by side, every quad in the same colour and with the same number in both.
The numbers are those of a mesh file; the axes, and what a pointer resting on a node is told, are
in each file's own units, as ``--pin`` wants them.
"""

import math
import xml.etree.ElementTree as ET
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from shapetween.base.arrays import Floats, Index, Points
from shapetween.mesh.pair import MeshPair
from shapetween.model.blend import from_oklab
from shapetween.model.drawing import Box
from shapetween.model.outline import Outline
from shapetween.svg.write.elements import colour_text, document, text_of
from shapetween.svg.write.numbers import decimals_for, number, path_data

__all__ = ["MeshView", "mesh_svg"]

#: Lengths of the picture, in its own units, which are pixels at its natural size.
PANEL, MARGIN, GUTTER, HEAD, FOOT = 620.0, 44.0, 56.0, 64.0, 40.0

#: Room around the shapes, as a share of their larger side; labels need it.
PADDING = 0.07

#: Decimals of lengths in the picture.
PIXEL_DECIMALS = 2

#: Width of a letter of a title, and width and height of a node's number a digit, about.
LETTER, DIGIT = 9.6, (5.4, 9.0)

#: Where a node's number may stand: turns from the side it would best be on, and distances.
LABEL_TURNS = np.radians([0, 40, -40, 80, -80, 125, -125, 180])
LABEL_DISTANCES = np.array([9.5, 16.0, 23.0])

#: About how many grid lines across the larger side.
GRID_LINES = 10

#: Turn from one quad's hue to the next: the golden angle, so that near numbers differ most.
HUE_TURN = math.pi * (3 - math.sqrt(5))

#: OKLab lightness that quads take in turn, and their chroma: light enough for dark numbers.
LIGHTNESSES, CHROMA = (0.86, 0.79, 0.91), 0.105

INK, FAINT, GRID, INSIDE = "#1d2430", "#6b7482", "#e6e9ee", "#f1f3f6"

STYLE = (
    "text{font-family:system-ui,'Segoe UI','DejaVu Sans',sans-serif;fill:#1d2430}"
    ".face{stroke:#fff;stroke-width:1.2;stroke-linejoin:round}"
    ".number{font-weight:600;text-anchor:middle}"
    ".node{fill:#fff;stroke:#1d2430;stroke-width:1.1}"
    ".label{font-size:8.5px;fill:#39424f;text-anchor:middle;"
    "paint-order:stroke;stroke:#fff;stroke-width:2.4px;stroke-linejoin:round}"
    ".tick{font-size:10px;fill:#6b7482}"
    "g.at:hover .node{fill:#ffd23f;stroke-width:2}g.at:hover .label{font-size:12px}"
)


@dataclass(frozen=True, slots=True, eq=False)
class MeshView:
    """One mesh to draw.

    Attributes
    ----------
    name : str
        Of its shape, empty if it has none.
    source, target : Outline
        The outlines, each in its own file's units.
    pair : MeshPair
        Vertices in the same units.
    nodes : (N,) intp
        Vertices that are matched places on the outlines; others lie inside.
    """

    name: str
    source: Outline
    target: Outline
    pair: MeshPair
    nodes: Index


@dataclass(frozen=True, slots=True, eq=False)
class _Panel:
    """Where one of the two shapes is drawn, and how its units become the picture's."""

    left: float
    low: Points
    high: Points

    @property
    def scale(self) -> float:
        return PANEL / float((self.high - self.low).max())

    @property
    def size(self) -> Points:
        return (self.high - self.low) * self.scale

    def place(self, points: Points) -> Points:
        """From the file's units to the picture's."""
        return np.asarray((points - self.low) * self.scale + (self.left, HEAD))


def mesh_svg(views: Sequence[MeshView], names: tuple[str, str]) -> str:
    """Draw meshes side by side.

    Parameters
    ----------
    views : sequence of MeshView
        At least one.
    names : (str, str)
        What the two files are called.
    """
    sources = [(view.source, view.pair.source) for view in views]
    targets = [(view.target, view.pair.target) for view in views]
    left = _panel(sources, MARGIN)
    right = _panel(targets, MARGIN + float(left.size[0]) + GUTTER + MARGIN)
    width = right.left + float(right.size[0]) + MARGIN
    height = HEAD + float(max(left.size[1], right.size[1])) + FOOT

    root = document(Box(0, 0, math.ceil(width), math.ceil(height)), f"{names[0]} to {names[1]}")
    root.set("width", str(math.ceil(width)))
    root.set("height", str(math.ceil(height)))
    ET.SubElement(root, "style").text = STYLE
    root.append(_hatching())
    ET.SubElement(root, "rect", {"width": "100%", "height": "100%", "fill": "#fff"})
    for panel, shapes, name in ((left, sources, names[0]), (right, targets, names[1])):
        _draw_frame(root, panel, name)
        for outline, _ in shapes:
            _draw_outline(root, panel, outline, {"fill": INSIDE})
        first = 0
        for view, (outline, vertices) in zip(views, shapes, strict=True):
            _draw_faces(root, panel, view, vertices, first)
            first += len(view.pair.quads) + len(view.pair.triangles)
            line = {"fill": "none", "stroke": INK, "stroke-width": "1.6"}
            _draw_outline(root, panel, outline, line | {"pointer-events": "none"})
        for view, (_, vertices) in zip(views, shapes, strict=True):
            _draw_nodes(root, panel, view, vertices)
    _draw_caption(root, views)
    return text_of(root)


def _panel(shapes: Sequence[tuple[Outline, Points]], left: float) -> _Panel:
    """A panel that shows all of these outlines and vertices, with room around them."""
    points = np.concatenate([p for outline, vertices in shapes for p in (outline.box, vertices)])
    low, high = points.min(axis=0), points.max(axis=0)
    room = PADDING * float((high - low).max())
    return _Panel(left, low - room, high + room)


def _draw_frame(root: ET.Element, panel: _Panel, name: str) -> None:
    """The name, a grid, and what its lines are worth."""
    group = ET.SubElement(root, "g")
    width, height = panel.size.tolist()
    letters = max(8, int(width / LETTER))
    title = name if len(name) <= letters else f"{name[: letters - 1]}…"
    _text(group, panel.left, HEAD - 34, title, {"font-size": "17", "font-weight": "600"})
    lines = []
    for axis in (0, 1):
        for value in _ticks(float(panel.low[axis]), float(panel.high[axis])):
            point = panel.low.copy()
            point[axis] = value
            x, y = panel.place(point).tolist()
            label = f"{value:.10g}"
            if axis == 0:
                lines.append(f"M{_px(x)} {_px(HEAD)}v{_px(height)}")
                attributes = {"class": "tick", "text-anchor": "middle"}
                _text(group, x, HEAD - 6, label, attributes)
            else:
                lines.append(f"M{_px(panel.left)} {_px(y)}h{_px(width)}")
                attributes = {"class": "tick", "text-anchor": "end"}
                _text(group, panel.left - 6, y + 3.5, label, attributes)
    ET.SubElement(group, "path", {"d": "".join(lines), "stroke": GRID, "fill": "none"})


def _ticks(low: float, high: float) -> Floats:
    """Round numbers between two, about as many as there is room for."""
    rough = (high - low) / GRID_LINES
    power = 10.0 ** math.floor(math.log10(rough))
    step = next(power * k for k in (1, 2, 5, 10) if power * k >= rough)
    # Adding 0 turns a -0 into 0.
    return np.asarray(np.arange(math.ceil(low / step), math.floor(high / step) + 1) * step + 0.0)


def _draw_faces(
    root: ET.Element, panel: _Panel, view: MeshView, vertices: Points, first: int
) -> None:
    """Quads and triangles in their colours, with their numbers; triangles are hatched."""
    group = ET.SubElement(root, "g")
    numbers = ET.SubElement(root, "g", {"class": "number"})
    for kind, faces, start in (
        ("quad", view.pair.quads, first),
        ("triangle", view.pair.triangles, first + len(view.pair.quads)),
    ):
        for k, (face, corners) in enumerate(
            zip(faces.tolist(), panel.place(vertices[faces]), strict=True)
        ):
            d = "M" + "L".join(f"{_px(x)} {_px(y)}" for x, y in corners.tolist()) + "Z"
            attributes = {"class": "face", "d": d, "fill": _colour(start + k)}
            shown = ET.SubElement(group, "path", attributes)
            title = ", ".join(map(str, face))
            ET.SubElement(shown, "title").text = f"{kind} {k}: nodes {title}"
            if kind == "triangle":
                hatched = {"d": d, "fill": "url(#hatching)", "pointer-events": "none"}
                ET.SubElement(group, "path", hatched)
            x, y = corners.mean(axis=0).tolist()
            size = float(np.clip(0.8 * _inradius(corners), 6, 15))
            _text(numbers, x, y + 0.36 * size, str(k), {"font-size": _px(size)})


def _colour(index: int) -> str:
    """A light colour, unlike those of the numbers before and after."""
    hue = index * HUE_TURN
    lightness = LIGHTNESSES[index % len(LIGHTNESSES)]
    lab = np.array([lightness, CHROMA * math.cos(hue), CHROMA * math.sin(hue)])
    return colour_text(from_oklab(lab))


def _inradius(corners: Points) -> float:
    """Distance from the mean of a face's corners to the nearest of its sides' lines."""
    sides = np.roll(corners, -1, axis=0) - corners
    offsets = corners.mean(axis=0) - corners
    heights = np.abs(sides[:, 0] * offsets[:, 1] - sides[:, 1] * offsets[:, 0])
    lengths = np.linalg.norm(sides, axis=1)
    return float((heights / np.where(lengths > 0, lengths, 1.0)).min())


def _draw_outline(
    root: ET.Element, panel: _Panel, outline: Outline, attributes: dict[str, str]
) -> None:
    curves = panel.place(outline.curves)
    d = path_data(curves[None], [len(curves)], [outline.closed], PIXEL_DECIMALS)[0]
    ET.SubElement(root, "path", {"d": d, **attributes})


def _draw_nodes(root: ET.Element, panel: _Panel, view: MeshView, vertices: Points) -> None:
    """Dots where the outlines are matched, each with its number and a pin to hold it."""
    group = ET.SubElement(root, "g")
    places = panel.place(vertices)
    labels = _label_places(places, _away_from_faces(view.pair, places))
    decimals = [_unit_decimals(points) for points in (view.pair.source, view.pair.target)]
    for node in range(len(places)):
        on_outline = node in set(view.nodes.tolist())
        x, y = places[node].tolist()
        at = ET.SubElement(group, "g", {"class": "at"})
        pin = ":".join(
            ",".join(number(value, places_after) for value in points[node].tolist())
            for points, places_after in zip(
                (view.pair.source, view.pair.target), decimals, strict=True
            )
        )
        what = f"node {node}" if on_outline else f"inner vertex {node}"
        ET.SubElement(at, "title").text = f"{what}\n--pin {pin}" if on_outline else what
        dot = {"class": "node", "cx": _px(x), "cy": _px(y), "r": "2.8" if on_outline else "1.8"}
        ET.SubElement(at, "circle", dot)
        lx, ly = labels[node].tolist()
        _text(at, lx, ly + 3, str(node), {"class": "label"})


def _away_from_faces(pair: MeshPair, places: Points) -> Points:
    """Unit directions in which each vertex has most room for a label, (V, 2)."""
    pull = np.zeros_like(places)
    for faces in (pair.quads, pair.triangles):
        corners = places[faces]
        towards = corners.mean(axis=1, keepdims=True) - corners
        length = np.linalg.norm(towards, axis=-1, keepdims=True)
        np.add.at(pull, faces, towards / np.where(length > 0, length, 1.0))
    length = np.linalg.norm(pull, axis=1, keepdims=True)
    diagonal = np.full_like(places, math.sqrt(0.5)) * (1, -1)
    return np.where(length > 0.3, -pull / np.where(length > 0, length, 1.0), diagonal)


def _label_places(places: Points, aside: Points) -> Points:
    """Middles of the nodes' numbers, each as near its best side as leaves the others legible."""
    turns = np.stack(
        [
            np.stack([np.cos(LABEL_TURNS), -np.sin(LABEL_TURNS)], -1),
            np.stack([np.sin(LABEL_TURNS), np.cos(LABEL_TURNS)], -1),
        ],
        axis=-2,
    )  # (K, 2, 2)
    labels = np.zeros_like(places)
    widths = DIGIT[0] * np.array([len(str(node)) for node in range(len(places))])
    for node, place in enumerate(places):
        directions = turns @ aside[node]
        candidates = place + (LABEL_DISTANCES[:, None, None] * directions).reshape(-1, 2)
        apart = np.abs(candidates[:, None] - labels[:node])
        room = np.stack([(widths[:node] + widths[node]) / 2, np.full(node, DIGIT[1])], axis=-1)
        hidden = (apart < room).all(axis=-1).sum(axis=1)
        dots = np.abs(candidates[:, None] - np.delete(places, node, axis=0))
        hidden += (dots < (widths[node] / 2 + 2, DIGIT[1] / 2 + 2)).all(axis=-1).sum(axis=1)
        labels[node] = candidates[hidden.argmin()]
    return labels


def _unit_decimals(points: Points) -> int:
    """Decimals a person needs to place a pin."""
    low, high = points.min(axis=0), points.max(axis=0)
    width, height = (high - low).tolist()
    return decimals_for(Box(0, 0, width, height))


def _draw_caption(root: ET.Element, views: Sequence[MeshView]) -> None:
    quads = sum(len(view.pair.quads) for view in views)
    triangles = sum(len(view.pair.triangles) for view in views)
    nodes = sum(len(view.nodes) for view in views)
    parts = [
        f"{count} {word}{'' if count == 1 else 's'}"
        for count, word in ((quads, "quad"), (triangles, "triangle"), (nodes, "matched node"))
        if count
    ]
    text = " · ".join(parts) + ". Point at a node for its --pin."
    height = float(root.attrib["height"])
    _text(root, MARGIN, height - 14, text, {"font-size": "12", "style": f"fill:{FAINT}"})


def _hatching() -> ET.Element:
    """White stripes, by which triangles are told from quads."""
    defs = ET.Element("defs")
    size = {"width": "7", "height": "7", "patternUnits": "userSpaceOnUse"}
    pattern = ET.SubElement(
        defs, "pattern", {"id": "hatching", **size, "patternTransform": "rotate(45)"}
    )
    ET.SubElement(pattern, "rect", {"width": "3", "height": "7", "fill": "#fff", "opacity": ".55"})
    return defs


def _text(
    parent: ET.Element, x: float, y: float, text: str, attributes: dict[str, str]
) -> ET.Element:
    element = ET.SubElement(parent, "text", {"x": _px(x), "y": _px(y), **attributes})
    element.text = text
    return element


def _px(value: float) -> str:
    return number(value, PIXEL_DECIMALS)
