"""The SVG elements that every writer needs: document, paths, paint and gradients at rest."""

import re
import xml.etree.ElementTree as ET
import zlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from shapetween.base.arrays import Curves
from shapetween.model.drawing import Box, Shape
from shapetween.model.gradients import IDENTITY, in_normal_form
from shapetween.model.paint import Colour, Gradient, Paint, Pattern, Style
from shapetween.svg.write.numbers import decimals_for, number, path_data

__all__ = [
    "ALPHA_DECIMALS",
    "LATER",
    "POINT_NAMES",
    "ROUND",
    "GradientDefs",
    "add_pattern",
    "add_shape",
    "alpha_text",
    "as_circle",
    "colour_text",
    "document",
    "gradient_attributes",
    "named",
    "paint_attributes",
    "shape_path",
    "style_attributes",
    "text_of",
    "url_of",
]

#: Decimals of alphas, offsets and other shares of one: finer than the 1/255 of a screen.
ALPHA_DECIMALS = 4

#: Half-axes of an ellipse this near to each other, for their size, are written as a circle.
ROUND = 1e-6

#: What SVG calls the numbers of a gradient's points.
POINT_NAMES = {"linear": ("x1", "y1", "x2", "y2"), "radial": ("cx", "cy", "r", "fx", "fy")}

#: Attributes of what waits for its turn.
LATER = {"class": "shapetween-later"}

#: Stands for the start of a gradient's id until the text is known; no XML text can hold it.
_PREFIX = "\0"

_NOT_XML = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")


def document(box: Box, title: str, page: Sequence[tuple[str, str]] = ()) -> ET.Element:
    """An empty SVG document that shows `box`, with attributes for the page it is in."""
    decimals = decimals_for(box) + 3
    numbers = (number(value, decimals) for value in (box.x, box.y, box.width, box.height))
    root = ET.Element("svg", {"xmlns": "http://www.w3.org/2000/svg", "viewBox": " ".join(numbers)})
    root.attrib.update((name, _NOT_XML.sub("", value)) for name, value in page)
    if title:
        ET.SubElement(root, "title").text = _NOT_XML.sub("", title)
    return root


def text_of(root: ET.Element) -> str:
    """The document as text, ending in a line break.

    Ids are shared by all drawings that stand in one page, so what files of different contents name
    their gradients must differ: the names start with a checksum of the document itself.
    """
    ET.indent(root, " ")
    text = ET.tostring(root, encoding="unicode") + "\n"
    prefix = f"g{zlib.crc32(text.encode()):08x}"
    while f'"{prefix}' in text:
        prefix += "x"
    return text.replace(_PREFIX, prefix)


def named(names: Sequence[str]) -> list[dict[str, str]]:
    """An ``id`` for every name that can be one: no spaces, and not taken by an earlier name."""
    cleaned = [_NOT_XML.sub("", name) for name in names]
    return [
        {"id": name} if name and not re.search(r"\s", name) and name not in cleaned[:k] else {}
        for k, name in enumerate(cleaned)
    ]


def colour_text(colour: Colour) -> str:
    """The colour without its alpha, ``#rgb`` where that says it.

    Examples
    --------
    >>> colour_text(Colour(1, 0, 0.2)), colour_text(Colour(1, 0, 0.5))
    ('#f03', '#ff0080')
    """
    red, green, blue = (round(255 * part) for part in (colour.red, colour.green, colour.blue))
    text = f"{red:02x}{green:02x}{blue:02x}"
    return f"#{text[::2]}" if text[::2] == text[1::2] else f"#{text}"


def alpha_text(alpha: float) -> str:
    """A share of one."""
    return number(alpha, ALPHA_DECIMALS)


@dataclass(frozen=True, slots=True)
class GradientDefs:
    """Where a document keeps its gradients, which are numbered as they are added.

    Attributes
    ----------
    element : Element
        The document's ``<defs>``.
    decimals : int
        For their coordinates.
    box : Box
        What the document shows.
    classes : dict
        Names of classes by their style.
    in_page : bool
        Whether colours that are the page's to choose are asked of it.
    """

    decimals: int
    element: ET.Element = field(default_factory=lambda: ET.Element("defs"))
    box: Box = field(default_factory=lambda: Box(0.0, 0.0, 1.0, 1.0))
    classes: dict[str, str] = field(default_factory=dict)
    in_page: bool = True

    def reserve(self, tag: str, attributes: Mapping[str, str]) -> tuple[ET.Element, str]:
        """An empty definition, and what attributes say to use it."""
        name = f"{_PREFIX}-{len(self.element)}"
        return ET.SubElement(self.element, tag, {"id": name, **attributes}), f"url(#{name})"

    def name_of(self, part: str) -> str:
        """An id of the document's own."""
        return f"{_PREFIX}{part}"  # a hyphen would be minus where times are said

    def around(self) -> dict[str, str]:
        """A rectangle around all that is shown, and as much on every side."""
        box = self.box
        sides = (box.x - box.width, box.y - box.height, 3 * box.width, 3 * box.height)
        values = (number(value, self.decimals) for value in sides)
        return dict(zip(("x", "y", "width", "height"), values, strict=True))

    def style_class(self, style: str) -> str:
        """The name of a class with that style; `style_sheet` has them all."""
        return self.classes.setdefault(style, f"{_PREFIX}-s{len(self.classes)}")

    @property
    def style_sheet(self) -> str:
        """Rules of all classes that were asked for."""
        return "".join(f".{name}{{{style}}}" for style, name in self.classes.items())

    def add(self, gradient: Gradient) -> tuple[ET.Element, str]:
        """Write a gradient; its element, and what ``fill`` or ``stroke`` says to use it."""
        name = f"{_PREFIX}-{len(self.element)}"
        attributes = {"id": name, "gradientUnits": "userSpaceOnUse"}
        if gradient.spread != "pad":
            attributes["spreadMethod"] = gradient.spread
        attributes |= gradient_attributes(gradient, self.decimals)
        element = ET.SubElement(self.element, f"{gradient.kind}Gradient", attributes)
        for stop in gradient.stops:
            ET.SubElement(
                element,
                "stop",
                {"offset": alpha_text(stop.offset), "stop-color": colour_text(stop.colour)}
                | _unless_one("stop-opacity", stop.colour.alpha),
            )
        return element, f"url(#{name})"


def url_of(definition: ET.Element) -> str:
    """What attributes say to use a definition."""
    return f"url(#{definition.get('id')})"


def gradient_attributes(gradient: Gradient, decimals: int) -> dict[str, str]:
    """Attributes that say where a gradient lies, in its normal form; a circle needs no matrix."""
    gradient = in_normal_form(gradient)
    circle = as_circle(gradient)
    if circle is not None:
        return point_attributes(circle, decimals)
    numbers = [number(value, decimals + ALPHA_DECIMALS) for value in gradient.matrix]
    return {
        **point_attributes(gradient, decimals),
        "gradientTransform": f"matrix({' '.join(numbers)})",
    }


def as_circle(gradient: Gradient) -> Gradient | None:
    """The same gradient without a matrix, if it has none or only moves and enlarges a circle."""
    if gradient.matrix == IDENTITY:
        return gradient
    a, b, c, d, e, f = gradient.matrix
    if gradient.kind == "linear" or max(abs(b), abs(c), abs(a - d)) > ROUND * abs(a):
        return None
    cx, cy, r, fx, fy = gradient.points
    points = (e + a * cx, f + a * cy, a * r, e + a * fx, f + a * fy)
    return replace(gradient, points=points, matrix=IDENTITY)


def point_attributes(gradient: Gradient, decimals: int) -> dict[str, str]:
    """A gradient's points under their names; under a matrix they may be of any size."""
    if gradient.matrix != IDENTITY:
        decimals += ALPHA_DECIMALS
    texts = [number(value, decimals) for value in gradient.points]
    return dict(zip(POINT_NAMES[gradient.kind], texts, strict=True))


def paint_attributes(name: str, paint: Paint, gradients: GradientDefs) -> dict[str, str]:
    """Attributes for a paint, `name` being ``fill`` or ``stroke``."""
    if paint is None:
        return {name: "none"}
    if isinstance(paint, Gradient):
        return {name: gradients.add(paint)[1]}
    text = paint.reference if paint.reference and gradients.in_page else colour_text(paint)
    return {name: text} | _unless_one(f"{name}-opacity", paint.alpha)


def style_attributes(style: Style, decimals: int) -> dict[str, str]:
    """Attributes for all of a style but its paints; what SVG takes for granted is left out."""
    attributes: dict[str, str] = {}
    if style.fill_rule != "nonzero":
        attributes["fill-rule"] = style.fill_rule
    attributes |= _unless_one("opacity", style.opacity)
    if style.crisp:
        attributes["shape-rendering"] = "crispEdges"
    stroke = style.stroke
    if stroke is None:
        return attributes
    attributes["stroke-width"] = number(stroke.width, decimals)
    if stroke.cap != "butt":
        attributes["stroke-linecap"] = stroke.cap
    if stroke.join != "miter":
        attributes["stroke-linejoin"] = stroke.join
    if stroke.miter_limit != 4:
        attributes["stroke-miterlimit"] = number(stroke.miter_limit, ALPHA_DECIMALS)
    if stroke.dashes:
        attributes["stroke-dasharray"] = " ".join(number(dash, decimals) for dash in stroke.dashes)
        if stroke.dash_offset:
            attributes["stroke-dashoffset"] = number(stroke.dash_offset, decimals)
    return attributes


def add_shape(
    parent: ET.Element, shape: Shape, gradients: GradientDefs, attributes: Mapping[str, str]
) -> ET.Element:
    """Write a shape at rest as one path, with `attributes` before its own."""
    paints = paint_attributes("fill", shape.style.fill, gradients)
    if shape.style.pattern is not None:
        paints = {"fill": add_pattern(shape.style.pattern, gradients)[1]}
    if shape.style.stroke is not None:
        paints |= paint_attributes("stroke", shape.style.stroke.paint, gradients)
    return ET.SubElement(
        parent,
        "path",
        {
            **attributes,
            **paints,
            **style_attributes(shape.style, gradients.decimals),
            "d": shape_path(shape, gradients.decimals),
        },
    )


def add_pattern(pattern: Pattern, defs: GradientDefs) -> tuple[ET.Element, str]:
    """Write a pattern; its element, and what ``fill`` says to use it."""
    sides = dict(zip(("width", "height"), pattern.tile, strict=True))
    digits = defs.decimals + ALPHA_DECIMALS
    matrix = " ".join(number(value, digits) for value in pattern.matrix)
    attributes = {"patternUnits": "userSpaceOnUse", "patternTransform": f"matrix({matrix})"}
    attributes |= {name: number(value, digits) for name, value in sides.items()}
    element, url = defs.reserve("pattern", attributes)
    inner = ET.SubElement(element, "g", _unless_one("opacity", pattern.alpha))
    # A tile may be drawn in units much larger than the drawing's.
    finer = replace(defs, decimals=digits)
    for shape in pattern.shapes:
        add_shape(inner, shape, finer, {})
    return element, url


def shape_path(shape: Shape, decimals: int) -> str:
    """Path data of all rings of a shape."""
    curves: Curves = np.concatenate([ring.curves for ring in shape.rings])
    rings = [len(ring.curves) for ring in shape.rings]
    closed = [ring.closed for ring in shape.rings]
    return path_data(curves[None], rings, closed, decimals)[0]


def _unless_one(name: str, share: float) -> dict[str, str]:
    """An attribute whose value need not be written where it is 1."""
    text = alpha_text(share)
    return {} if text == "1" else {name: text}
