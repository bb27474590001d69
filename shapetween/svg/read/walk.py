"""A document's shapes in the order they are painted, each with all that its ancestors say.

The walk keeps its own stack, so that no depth of elements is beyond it.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from xml.etree.ElementTree import Element

import numpy as np

from shapetween.base.arrays import Affine
from shapetween.geometry.affine import IDENTITY, compose, mapped, mean_scale
from shapetween.model.drawing import Box
from shapetween.svg.read.colours import parse_paint
from shapetween.svg.read.csstransform import TRANSFORMS, css_transform
from shapetween.svg.read.document import Document
from shapetween.svg.read.frames import Frame, Layer, Placed
from shapetween.svg.read.placing import (
    FLOWED,
    GROUPS,
    LOST_ELEMENTS,
    chosen,
    conditions_met,
    font_size,
    shifted,
    used,
    viewport_opened,
)
from shapetween.svg.read.rings import bounds
from shapetween.svg.read.shapes import SHAPES
from shapetween.svg.read.style import Properties
from shapetween.svg.read.subpaths import subpaths_of
from shapetween.svg.read.transform import parse_transform
from shapetween.svg.read.units import number
from shapetween.svg.read.xml import label, local_name

__all__ = ["entered", "object_box", "walk"]


#: Properties that change what is seen and are not carried, and what to write in their place.
UNDRAWN = {
    "offset-path": "place the shape with a transform instead",
    "mask-border": "draw it as a mask element instead",
    "mask-border-source": "draw it as a mask element instead",
}


@dataclass(frozen=True, slots=True, eq=False)
class _Visit:
    element: Element
    frame: Frame
    depth: int
    used_by: Element | None = None


def walk(
    document: Document,
    start: Element,
    frame: Frame,
    used_by: Element | None = None,
    *,
    quiet: bool = False,
) -> Iterator[Placed]:
    """Everything drawn by an element and what it holds.

    Parameters
    ----------
    document : Document
    start : Element
        Its own transform and style are applied; the outermost ``svg`` opens no viewport.
    frame : Frame
        What holds outside it.
    used_by : Element, optional
        The ``use`` that draws it.
    quiet : bool
        Whether nothing is said of what is left out, because it is said elsewhere.

    Raises
    ------
    BudgetError
    """
    pending = [_Visit(start, frame, 0, used_by)]
    while pending:
        visit = pending.pop()
        element = visit.element
        if visit.frame.uses:
            document.spend("use_copies")
        document.limits.check("nesting", visit.depth, document.name)
        tag = local_name(element)
        if tag not in SHAPES and tag not in GROUPS and tag not in LOST_ELEMENTS:
            if tag == "flowRoot" and not quiet and "".join(element.itertext()).strip():
                document.losses.add(FLOWED)
            continue
        if tag == "symbol" and visit.used_by is None:
            continue
        properties = document.cascade.properties(element, visit.frame.properties)
        if properties.get("display") == "none" or not conditions_met(element):
            continue
        picture = tag == "image" and document.pictures is not None
        text = tag == "text" and document.fonts is not None
        if tag in LOST_ELEMENTS and not picture and not text:
            if properties.get("visibility", "visible") == "visible" and not quiet:
                document.losses.add(LOST_ELEMENTS[tag])
            continue
        inner = entered(document, element, properties, visit.frame)
        if inner is None:
            continue
        if tag in SHAPES or picture or text:
            yield Placed(element, tag, inner)
        else:
            pending.extend(reversed(_inside(document, visit, inner)))


def _inside(document: Document, visit: _Visit, inner: Frame) -> list[_Visit]:
    """What is drawn within a group or by a ``use``, in order."""
    element, tag = visit.element, local_name(visit.element)
    if tag == "use":
        target = used(document, element, inner)
        if target is None:
            return []
        moved = shifted(element, inner)
        named = label(element) if local_name(target) in SHAPES else ""
        within = replace(moved, uses=(*inner.uses, target), name=inner.name or named)
        return [_Visit(target, within, visit.depth + 1, used_by=element)]
    if tag in ("svg", "symbol") and element is not document.root:
        opened = viewport_opened(element, tag, inner, visit.used_by)
        if opened is None:
            return []
        inner = opened
    children = [chosen(element)] if tag == "switch" else list(element)
    return [_Visit(child, inner, visit.depth + 1) for child in children if child is not None]


def object_box(document: Document, element: Element, frame: Frame) -> Box | None:
    """The box around what an element draws, in its own coordinates and without strokes.

    Parameters
    ----------
    document : Document
    element : Element
    frame : Frame
        Its own; where it lies does not matter.

    Returns
    -------
    Box or None
        None if it draws nothing.
    """
    key = element, frame.viewport
    if key not in document.boxes:
        document.boxes[key] = None  # what draws itself has none
        tag = local_name(element)
        local = replace(frame, matrix=IDENTITY, layers=())
        if tag in SHAPES or tag in ("image", "text"):
            document.boxes[key] = _drawn_box(document, Placed(element, tag, local))
        else:
            boxes = []
            for visit in _inside(document, _Visit(element, local, 0), local):
                for placed in walk(document, visit.element, visit.frame, visit.used_by, quiet=True):
                    box = _drawn_box(document, placed)
                    if box is not None:
                        right, bottom = box.x + box.width, box.y + box.height
                        corners = [[box.x, box.y], [right, box.y], [right, bottom], [box.x, bottom]]
                        boxes.append(mapped(np.array(corners), placed.frame.matrix))
            if boxes:
                points = np.concatenate(boxes)
                low, high = points.min(axis=0), points.max(axis=0)
                document.boxes[key] = Box(*low.tolist(), *(high - low).tolist())
    return document.boxes[key]


def _drawn_box(document: Document, placed: Placed) -> Box | None:
    subpaths = subpaths_of(document, placed)
    return bounds(subpaths) if subpaths else None


def entered(
    document: Document, element: Element, properties: Properties, outer: Frame
) -> Frame | None:
    """The frame inside an element, after its transform; None if nothing inside it is seen.

    Parameters
    ----------
    document : Document
    element : Element
    properties : Properties
        The element's computed properties.
    outer : Frame
    """
    matrix = outer.matrix
    viewport = outer.viewport
    size = font_size(properties, outer)
    if size != viewport.font_size:
        viewport = replace(viewport, font_size=size)
    step = _transform(document, element, properties, replace(outer, viewport=viewport))
    if step is not None:
        matrix = compose(matrix, step)
        if not np.isfinite(matrix).all() or mean_scale(matrix) == 0:
            return None
    opacity = number(properties.get("opacity"))
    opacity = 1.0 if opacity is None else min(1.0, max(0.0, opacity))
    if opacity == 0:
        return None
    frame = replace(outer, matrix=matrix, properties=properties, viewport=viewport)
    layer = Layer(
        element,
        frame,
        opacity,
        properties.get("mix-blend-mode", "normal"),
        properties.get("isolation", "auto") == "isolate",
        properties.get("filter", "none"),
        _named(document, properties.get("mask", "none"), "mask"),
        _clip(document, properties.get("clip-path", "none")),
        properties.get("mask-mode", "match-source").strip().lower(),
    )
    for name, instead in UNDRAWN.items():
        if properties.get(name, "none").strip().lower() not in ("none", "auto", "initial"):
            document.losses.add(f"the property {name} was left out; {instead}", label(element))
    return replace(frame, layers=(*frame.layers, layer)) if layer.has_effect else frame


def _clip(document: Document, text: str) -> Element | str | None:
    """The clip path that an element names, or the shape that it gives."""
    if text.lower() == "none":
        return None
    if parse_paint(text) is None:
        return text
    return _named(document, text, "clipPath")


def _named(document: Document, text: str, tag: str) -> Element | None:
    """The element of a kind that a property names; None if there is none, as if it said nothing."""
    if text.lower() == "none":
        return None
    value = parse_paint(text)
    if value is None:
        document.losses.add(f"a {tag} made by style was left out; draw it as a {tag} element")
        return None
    target = document.ids.get(value.reference)
    return target if target is not None and local_name(target) == tag else None


def _transform(
    document: Document, element: Element, properties: Properties, frame: Frame
) -> Affine | None:
    """All that moves an element; None if nothing does."""
    attribute = None
    own = element.get("transform", "")
    if own.strip() and "transform" not in properties:
        attribute = parse_transform(own)
        if attribute is None:
            document.losses.add("a malformed transform was left out", label(element))
    if attribute is None and not any(name in properties for name in TRANSFORMS):
        return None
    if element is document.root:
        return css_transform(
            properties, attribute, frame.viewport, document.shown, ("center", "center")
        )
    box = Box(0.0, 0.0, frame.viewport.width, frame.viewport.height)
    name = properties.get("transform-box", "view-box")
    if name != "view-box":
        box = object_box(document, element, replace(frame, properties=properties)) or box
        stroke = frame.viewport.length(properties.get("stroke-width", "1"), frame.viewport.diagonal)
        if name in ("stroke-box", "border-box") and properties.get("stroke", "none") != "none":
            wide = stroke or 0.0
            box = Box(box.x - wide / 2, box.y - wide / 2, box.width + wide, box.height + wide)
    return css_transform(properties, attribute, frame.viewport, box)
