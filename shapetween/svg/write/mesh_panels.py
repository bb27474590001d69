"""Both shapes of a pair side by side, every quad in the same colour and with the same number.

The numbers are those of a mesh file; the axes, and what a pointer resting on a node is told, are
in each file's own units, as ``--pin`` wants them.
"""

import math
import xml.etree.ElementTree as ET
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from shapetween.base.arrays import Index, Points
from shapetween.mesh.pair import MeshPair
from shapetween.model.drawing import Box
from shapetween.model.outline import Outline
from shapetween.svg.write.numbers import decimals_for, number
from shapetween.svg.write.panels import (
    FAINT,
    FOOT,
    HEAD,
    INK,
    INSIDE,
    MARGIN,
    Panel,
    colour,
    draw_frame,
    draw_outline,
    panels,
    px,
    text_at,
)

__all__ = ["MESH_STYLE", "MeshView", "draw_meshes", "hatching"]

MESH_STYLE = (
    ".face{stroke:#fff;stroke-width:1.2;stroke-linejoin:round}"
    ".number{font-weight:600;text-anchor:middle}"
    ".node{fill:#fff;stroke:#1d2430;stroke-width:1.1}"
    ".label{font-size:8.5px;fill:#39424f;text-anchor:middle;"
    "paint-order:stroke;stroke:#fff;stroke-width:2.4px;stroke-linejoin:round}"
    ".tick{font-size:10px;fill:#6b7482}"
    "g.at:hover .node{fill:#ffd23f;stroke-width:2}g.at:hover .label{font-size:12px}"
)

#: Width and height of a node's number a digit, about.
DIGIT = (5.4, 9.0)

#: Where a node's number may stand: turns from the side it would best be on, and distances.
LABEL_TURNS = np.radians([0, 40, -40, 80, -80, 125, -125, 180])
LABEL_DISTANCES = np.array([9.5, 16.0, 23.0])


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


def draw_meshes(
    root: ET.Element, views: Sequence[MeshView], names: tuple[str, str], top: float
) -> tuple[float, float]:
    """Draw meshes side by side, and say how far to the right and down the picture then reaches.

    Parameters
    ----------
    root : Element
        The picture.
    views : sequence of MeshView
        At least one.
    names : (str, str)
        What the two files are called.
    top : float
        Where they begin.
    """
    sources = [(view.source, view.pair.source) for view in views]
    targets = [(view.target, view.pair.target) for view in views]
    both = [
        [points for outline, own in side for points in (outline.box, own)]
        for side in (sources, targets)
    ]
    left, right = panels(both[0], both[1], top)
    for panel, shapes, name in ((left, sources, names[0]), (right, targets, names[1])):
        draw_frame(root, panel, name)
        for outline, _ in shapes:
            draw_outline(root, panel, [outline], {"fill": INSIDE})
        first = 0
        for view, (outline, vertices) in zip(views, shapes, strict=True):
            _draw_faces(root, panel, view, vertices, first)
            first += len(view.pair.quads) + len(view.pair.triangles)
            line = {"fill": "none", "stroke": INK, "stroke-width": "1.6"}
            draw_outline(root, panel, [outline], line | {"pointer-events": "none"})
        for view, (_, vertices) in zip(views, shapes, strict=True):
            _draw_nodes(root, panel, view, vertices)
    bottom = top + HEAD + float(max(left.size[1], right.size[1])) + FOOT
    _draw_caption(root, views, math.ceil(bottom) - 14)
    return right.left + float(right.size[0]) + MARGIN, bottom


def _draw_faces(
    root: ET.Element, panel: Panel, view: MeshView, vertices: Points, first: int
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
            d = "M" + "L".join(f"{px(x)} {px(y)}" for x, y in corners.tolist()) + "Z"
            attributes = {"class": "face", "d": d, "fill": colour(start + k)}
            shown = ET.SubElement(group, "path", attributes)
            title = ", ".join(map(str, face))
            ET.SubElement(shown, "title").text = f"{kind} {k}: nodes {title}"
            if kind == "triangle":
                hatched = {"d": d, "fill": "url(#hatching)", "pointer-events": "none"}
                ET.SubElement(group, "path", hatched)
            x, y = corners.mean(axis=0).tolist()
            size = float(np.clip(0.8 * _inradius(corners), 6, 15))
            text_at(numbers, x, y + 0.36 * size, str(k), {"font-size": px(size)})


def _inradius(corners: Points) -> float:
    """Distance from the mean of a face's corners to the nearest of its sides' lines."""
    sides = np.roll(corners, -1, axis=0) - corners
    offsets = corners.mean(axis=0) - corners
    heights = np.abs(sides[:, 0] * offsets[:, 1] - sides[:, 1] * offsets[:, 0])
    lengths = np.linalg.norm(sides, axis=1)
    return float((heights / np.where(lengths > 0, lengths, 1.0)).min())


def _draw_nodes(root: ET.Element, panel: Panel, view: MeshView, vertices: Points) -> None:
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
        dot = {"class": "node", "cx": px(x), "cy": px(y), "r": "2.8" if on_outline else "1.8"}
        ET.SubElement(at, "circle", dot)
        lx, ly = labels[node].tolist()
        text_at(at, lx, ly + 3, str(node), {"class": "label"})


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


def _draw_caption(root: ET.Element, views: Sequence[MeshView], y: float) -> None:
    quads = sum(len(view.pair.quads) for view in views)
    triangles = sum(len(view.pair.triangles) for view in views)
    nodes = sum(len(view.nodes) for view in views)
    parts = [
        f"{count} {word}{'' if count == 1 else 's'}"
        for count, word in ((quads, "quad"), (triangles, "triangle"), (nodes, "matched node"))
        if count
    ]
    text = " · ".join(parts) + ". Point at a node for its --pin."
    text_at(root, MARGIN, y, text, {"font-size": "12", "style": f"fill:{FAINT}"})


def hatching() -> ET.Element:
    """White stripes, by which triangles are told from quads."""
    defs = ET.Element("defs")
    size = {"width": "7", "height": "7", "patternUnits": "userSpaceOnUse"}
    pattern = ET.SubElement(
        defs, "pattern", {"id": "hatching", **size, "patternTransform": "rotate(45)"}
    )
    ET.SubElement(pattern, "rect", {"width": "3", "height": "7", "fill": "#fff", "opacity": ".55"})
    return defs
