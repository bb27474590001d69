"""One painted element to the shapes it draws, in the drawing's user units."""

import re
from dataclasses import replace

import numpy as np

from shapetween.drawing import Shape
from shapetween.outline import Outline
from shapetween.paint import Style
from shapetween.svg.document import Document
from shapetween.svg.painting import style_of
from shapetween.svg.pathdata import PathData
from shapetween.svg.rings import ring_of
from shapetween.svg.shapes import basic_shape
from shapetween.svg.units import GREATEST, number
from shapetween.svg.walk import LOST_MARKERS, Placed

__all__ = ["geometry_of", "shapes_of"]

_MARKERS = ("marker-start", "marker-mid", "marker-end")
_CSS_PATH = re.compile(r"""path\(\s*(?:(?:nonzero|evenodd)\s*,\s*)?(["'])(.*)\1\s*\)""", re.DOTALL)


def shapes_of(document: Document, placed: Placed) -> list[Shape]:
    """What a shape's element paints: nothing, a shape, or two where the stroke lies under the fill.

    Raises
    ------
    BudgetError
    """
    properties = placed.frame.properties
    if properties.get("visibility", "visible") != "visible":
        return []
    data = geometry_of(document, placed)
    if not data.subpaths:
        return []
    style = style_of(
        document, placed.frame, data.subpaths, number(placed.element.get("pathLength"))
    )
    if style.fill is None and style.stroke is None:
        return []
    if any(properties.get(name, "none") != "none" for name in _MARKERS):
        document.losses.add(LOST_MARKERS)
    layers = [style]
    if style.fill is not None and style.stroke is not None and _stroke_first(placed):
        layers = [replace(style, fill=None), replace(style, stroke=None)]
    shapes = []
    for layer in layers:
        rings = _rings(document, placed, data, layer)
        if rings:
            shapes.append(Shape(rings, layer, placed.frame.name))
    return shapes


def geometry_of(document: Document, placed: Placed) -> PathData:
    """The subpaths of a shape's element in its local coordinates; what is unsound is counted."""
    values = dict(placed.values)
    path = _CSS_PATH.fullmatch(values.get("d", "").strip())
    if path:
        values["d"] = path[2]
    most = document.limits.path_commands
    data = basic_shape(placed.tag, values, placed.frame.viewport, most)
    document.spend("path_commands", data.commands)
    if data.problem:
        name = placed.frame.name
        where = f"in {name!r}, " if name else ""
        document.losses.add(
            "a shape was drawn only as far as its data is sound", where + data.problem
        )
    return data


def _stroke_first(placed: Placed) -> bool:
    order = placed.frame.properties.get("paint-order", "normal").lower().split()
    first = next((word for word in order if word in ("fill", "stroke")), "fill")
    return first == "stroke"


def _rings(document: Document, placed: Placed, data: PathData, style: Style) -> tuple[Outline, ...]:
    stroke = style.stroke
    rings = []
    with np.errstate(all="ignore"):
        for subpath in data.subpaths:
            if not np.abs(subpath.curves).max(initial=0.0) <= GREATEST:  # or not a number
                document.losses.add("a ring with numbers out of all range was left out")
                continue
            ring = ring_of(
                subpath,
                placed.frame.matrix,
                filled=style.fill is not None,
                stroked=stroke is not None,
                dots=stroke is not None and stroke.cap != "butt",
            )
            if ring is not None:
                rings.append(ring)
    return tuple(rings)
