"""Where what an element holds is drawn: uses, viewports, and which children are drawn at all."""

from dataclasses import replace
from xml.etree.ElementTree import Element

import numpy as np

from shapetween.geometry.affine import affine, compose, mapped
from shapetween.model.drawing import Box
from shapetween.svg.read.document import Document, href
from shapetween.svg.read.frames import Frame, Layer
from shapetween.svg.read.shapes import SHAPES
from shapetween.svg.read.style import Properties
from shapetween.svg.read.viewbox import fit, parse_view_box
from shapetween.svg.read.xml import local_name

__all__ = [
    "FLOWED",
    "GROUPS",
    "KEPT",
    "LOST_ELEMENTS",
    "chosen",
    "conditions_met",
    "font_size",
    "shifted",
    "used",
    "viewport_opened",
]

GROUPS = frozenset({"g", "a", "svg", "switch", "use", "symbol"})
#: How what only pictures can show is kept.
KEPT = "written as .webp, .png, .gif or .mp4 it is kept"
#: What is left out, by element, in the words of the warning.
LOST_ELEMENTS = {
    "text": "text was left out; install shapetween[text], or convert it to paths, to keep it",
    "image": f"an image was left out; {KEPT}",
    "foreignObject": "a foreign object was left out",
}
#: The same of what no browser draws: Inkscape's text that flows into a shape.
FLOWED = (
    "text flowed into a shape (flowRoot) was left out, as browsers leave it out; "
    "convert it to text or to paths in Inkscape to keep it"
)
#: Sizes of fonts that have names, in px.
FONT_SIZES = {"xx-small": 9.0, "x-small": 10.0, "small": 13.0, "medium": 16.0, "large": 18.0}
FONT_SIZES |= {"x-large": 24.0, "xx-large": 32.0}
#: Languages a viewer is taken to ask for, in ``systemLanguage``.
LANGUAGE = "en"


def font_size(properties: Properties, outer: Frame) -> float:
    """The size of the font within an element, from its style and what holds outside."""
    text = properties.get("font-size")
    if text is None or text == outer.properties.get("font-size"):
        return outer.viewport.font_size
    size = FONT_SIZES.get(text.lower())
    if size is None:
        size = outer.viewport.length(text, outer.viewport.font_size)
    return outer.viewport.font_size if size is None or size <= 0 else size


def conditions_met(element: Element) -> bool:
    """Conditional processing attributes (SVG 2, section 5.8)."""
    if element.get("requiredExtensions", "").strip():
        return False
    languages = element.get("systemLanguage")
    return languages is None or any(
        language.strip().lower().split("-")[0] == LANGUAGE for language in languages.split(",")
    )


def chosen(switch: Element) -> Element | None:
    """The first child of a ``switch`` that may be drawn."""
    drawn = GROUPS | SHAPES.keys() | LOST_ELEMENTS.keys()
    return next(
        (child for child in switch if local_name(child) in drawn and conditions_met(child)), None
    )


def used(document: Document, use: Element, frame: Frame) -> Element | None:
    """What a ``use`` draws; None, with a warning, if that cannot be."""
    target = document.target(use)
    if target is None:
        if href(use):
            document.losses.add("a use element names nothing in this file and was left out")
        return None
    if target in frame.uses or document.is_within(use, target):
        document.losses.add("a use element that draws itself was left out")
        return None
    return target


def shifted(use: Element, frame: Frame) -> Frame:
    """The frame of what a ``use`` draws, moved by its x and y."""
    values = {**dict(use.items()), **frame.properties}
    x = frame.viewport.length(values.get("x"), frame.viewport.width) or 0.0
    y = frame.viewport.length(values.get("y"), frame.viewport.height) or 0.0
    return replace(frame, matrix=compose(frame.matrix, affine(1, 0, 0, 1, x, y)))


def viewport_opened(
    element: Element, tag: str, frame: Frame, used_by: Element | None
) -> Frame | None:
    """The frame inside a nested ``svg`` or a used ``symbol``; None if it has no area."""
    values = {**dict(element.items()), **frame.properties}
    if used_by is not None:
        values.update({k: v for k, v in used_by.items() if k in ("width", "height")})
    viewport = frame.viewport
    x = viewport.length(values.get("x"), viewport.width) or 0.0 if tag == "svg" else 0.0
    y = viewport.length(values.get("y"), viewport.height) or 0.0 if tag == "svg" else 0.0
    width = viewport.length(values.get("width"), viewport.width)
    height = viewport.length(values.get("height"), viewport.height)
    into = Box(
        x,
        y,
        viewport.width if width is None else width,
        viewport.height if height is None else height,
    )
    if into.width <= 0 or into.height <= 0:
        return None
    layers = frame.layers
    if frame.properties.get("overflow", "hidden") not in ("visible", "auto"):
        right, bottom = into.x + into.width, into.y + into.height
        local = np.array([[into.x, into.y], [right, into.y], [right, bottom], [into.x, bottom]])
        layers = (*layers, Layer(element, frame, clip=mapped(local, frame.matrix)))
    box = parse_view_box(element.get("viewBox"))
    if box is None:
        step = affine(1, 0, 0, 1, into.x, into.y)
        box = Box(0, 0, into.width, into.height)
    else:
        step = fit(box, into, element.attrib)
    return replace(
        frame,
        matrix=compose(frame.matrix, step),
        viewport=replace(viewport, width=box.width, height=box.height),
        layers=layers,
    )
