"""A document's shapes in the order they are painted, each with all that its ancestors say.

The walk keeps its own stack, so that no depth of elements is beyond it.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from xml.etree.ElementTree import Element

import numpy as np

from shapetween.base.arrays import Affine, Points
from shapetween.model.drawing import Box
from shapetween.svg.read.colours import parse_paint
from shapetween.svg.read.document import Document, href, label
from shapetween.svg.read.shapes import SHAPES
from shapetween.svg.read.style import Properties
from shapetween.svg.read.transform import affine, apply, compose, mean_scale, parse_transform
from shapetween.svg.read.units import Viewport, number
from shapetween.svg.read.viewbox import fit, parse_view_box
from shapetween.svg.read.xml import local_name

__all__ = ["KEPT", "Clip", "Frame", "Placed", "entered", "walk"]

GROUPS = frozenset({"g", "a", "svg", "switch", "use", "symbol"})
#: How what only pictures can show is kept.
KEPT = "written as .webp, .png, .gif or .mp4 it is kept"
#: What is left out, by element, in the words of the warning.
LOST_ELEMENTS = {
    "text": "text was left out; convert it to paths to keep it",
    "image": f"an image was left out; {KEPT}",
    "foreignObject": "a foreign object was left out",
}
#: What is not applied, by property.
LOST_PROPERTIES = {
    "mask": "a mask was left out: what it hides is shown",
    "filter": "a filter effect was left out",
}
LOST_MARKERS = "markers on a line were left out"

#: Languages a viewer is taken to ask for, in ``systemLanguage``.
LANGUAGE = "en"


@dataclass(frozen=True, slots=True, eq=False)
class Clip:
    """A region outside which nothing is painted.

    Attributes
    ----------
    frame : Frame
        Of the element that is clipped, with all its transforms.
    element : Element or None
        The ``clipPath``, or None where `corners` are given.
    clipped : Element
        The element that is clipped.
    corners : (4, 2) float64 or None
        The edge of a nested viewport, in the drawing's user units.
    """

    frame: "Frame"
    clipped: Element
    element: Element | None = None
    corners: Points | None = None


@dataclass(frozen=True, slots=True, eq=False)
class Frame:
    """What holds for everything inside an element.

    Attributes
    ----------
    matrix : (2, 3) float64
        From local coordinates to the drawing's user units.
    properties : Mapping
        The element's computed properties.
    viewport : Viewport
    pixel : float
        Size of a CSS pixel in the drawing's user units, for strokes that do not scale.
    opacity : float
        Product of all group opacities outside.
    translucent : tuple of Element
        The groups that had one.
    clips : tuple of Clip
    uses : tuple of Element
        What the ``use`` elements outside draw.
    name : str
        What a shape drawn by ``use`` is called; empty outside of any.
    """

    matrix: Affine
    properties: Properties
    viewport: Viewport
    pixel: float = 1.0
    opacity: float = 1.0
    translucent: tuple[Element, ...] = ()
    clips: tuple[Clip, ...] = ()
    uses: tuple[Element, ...] = ()
    name: str = ""


@dataclass(frozen=True, slots=True, eq=False)
class Placed:
    """A shape's element, and the frame of its own coordinates."""

    element: Element
    tag: str
    frame: Frame

    @property
    def name(self) -> str:
        """What the shape is called: as the ``use`` that draws it, else by itself."""
        return self.frame.name or label(self.element)

    @property
    def values(self) -> Properties:
        """Attributes, overridden by properties."""
        return {**dict(self.element.items()), **self.frame.properties}


@dataclass(frozen=True, slots=True, eq=False)
class _Visit:
    element: Element
    frame: Frame
    depth: int
    used_by: Element | None = None


def walk(document: Document, start: Element, frame: Frame) -> Iterator[Placed]:
    """Everything drawn by an element and what it holds.

    Parameters
    ----------
    document : Document
    start : Element
        Its own transform and style are applied; the outermost ``svg`` opens no viewport.
    frame : Frame
        What holds outside it.

    Raises
    ------
    BudgetError
    """
    pending = [_Visit(start, frame, 0)]
    while pending:
        visit = pending.pop()
        element = visit.element
        if visit.frame.uses:
            document.spend("use_copies")
        document.limits.check("nesting", visit.depth, document.name)
        tag = local_name(element)
        if tag not in SHAPES and tag not in GROUPS and tag not in LOST_ELEMENTS:
            continue
        if tag == "symbol" and visit.used_by is None:
            continue
        properties = document.cascade.properties(element, visit.frame.properties)
        if properties.get("display") == "none" or not _conditions_met(element):
            continue
        picture = tag == "image" and document.pictures is not None
        if tag in LOST_ELEMENTS and not picture:
            if properties.get("visibility", "visible") == "visible":
                document.losses.add(LOST_ELEMENTS[tag])
            continue
        inner = entered(document, element, properties, visit.frame)
        if inner is None:
            continue
        if tag in SHAPES or picture:
            yield Placed(element, tag, inner)
        elif tag == "use":
            target = _used(document, element, inner)
            if target is not None:
                shifted = _shifted(element, inner)
                named = label(element) if local_name(target) in SHAPES else ""
                inside = replace(shifted, uses=(*inner.uses, target), name=inner.name or named)
                pending.append(_Visit(target, inside, visit.depth + 1, used_by=element))
        else:
            if tag in ("svg", "symbol") and element is not document.root:
                opened = _viewport_opened(element, tag, inner, visit.used_by)
                if opened is None:
                    continue
                inner = opened
            children = [_chosen(element)] if tag == "switch" else list(element)
            pending.extend(
                _Visit(child, inner, visit.depth + 1)
                for child in reversed(children)
                if child is not None
            )


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
    font_size = _font_size(properties, outer)
    if font_size != viewport.font_size:
        viewport = replace(viewport, font_size=font_size)
    own = properties.get("transform")
    if own:
        step = parse_transform(own)
        if step is None:
            document.losses.add("a malformed transform was left out")
        else:
            matrix = compose(matrix, _about_origin(step, properties, viewport))
            if not np.isfinite(matrix).all() or mean_scale(matrix) == 0:
                return None
    opacity = number(properties.get("opacity"))
    opacity = 1.0 if opacity is None else min(1.0, max(0.0, opacity))
    if opacity == 0:
        return None
    for name, text in LOST_PROPERTIES.items():
        if properties.get(name, "none") != "none":
            document.losses.add(text)
    if properties.get("mix-blend-mode", "normal") != "normal":
        document.losses.add("a blend mode was left out")
    frame = replace(
        outer,
        matrix=matrix,
        properties=properties,
        viewport=viewport,
        opacity=outer.opacity * opacity,
        translucent=(*outer.translucent, element) if opacity < 1 else outer.translucent,
    )
    clip = _clip_of(document, element, frame)
    return frame if clip is None else replace(frame, clips=(*frame.clips, clip))


def _clip_of(document: Document, element: Element, frame: Frame) -> Clip | None:
    """The clip path that an element names."""
    text = frame.properties.get("clip-path", "none")
    if text == "none":
        return None
    value = parse_paint(text)
    if value is None:
        document.losses.add("a clip path given as a CSS shape was left out")
        return None
    target = document.ids.get(value.reference)
    if target is None or local_name(target) != "clipPath":
        return None  # as if there were none
    return Clip(frame, element, element=target)


def _font_size(properties: Properties, outer: Frame) -> float:
    text = properties.get("font-size")
    if text is None or text == outer.properties.get("font-size"):
        return outer.viewport.font_size
    size = outer.viewport.length(text, outer.viewport.font_size)
    return outer.viewport.font_size if size is None or size <= 0 else size


def _about_origin(step: Affine, properties: Properties, viewport: Viewport) -> Affine:
    """A transform about its ``transform-origin``."""
    words = {"left": "0%", "top": "0%", "center": "50%", "right": "100%", "bottom": "100%"}
    parts = properties.get("transform-origin", "").replace(",", " ").split()[:2]
    if not parts:
        return step
    if parts[0] in ("top", "bottom"):
        parts = ["center", *parts] if len(parts) == 1 else parts[::-1]
    x = viewport.length(words.get(parts[0], parts[0]), viewport.width)
    y = viewport.length(
        words.get(parts[-1], parts[-1]) if len(parts) > 1 else "50%", viewport.height
    )
    if x is None or y is None:
        return step
    return compose(compose(affine(1, 0, 0, 1, x, y), step), affine(1, 0, 0, 1, -x, -y))


def _conditions_met(element: Element) -> bool:
    """Conditional processing attributes (SVG 2, section 5.8)."""
    if element.get("requiredExtensions", "").strip():
        return False
    languages = element.get("systemLanguage")
    return languages is None or any(
        language.strip().lower().split("-")[0] == LANGUAGE for language in languages.split(",")
    )


def _chosen(switch: Element) -> Element | None:
    """The first child of a ``switch`` that may be drawn."""
    drawn = GROUPS | SHAPES.keys() | LOST_ELEMENTS.keys()
    return next(
        (child for child in switch if local_name(child) in drawn and _conditions_met(child)), None
    )


def _used(document: Document, use: Element, frame: Frame) -> Element | None:
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


def _shifted(use: Element, frame: Frame) -> Frame:
    """The frame of what a ``use`` draws, moved by its x and y."""
    values = {**dict(use.items()), **frame.properties}
    x = frame.viewport.length(values.get("x"), frame.viewport.width) or 0.0
    y = frame.viewport.length(values.get("y"), frame.viewport.height) or 0.0
    return replace(frame, matrix=compose(frame.matrix, affine(1, 0, 0, 1, x, y)))


def _viewport_opened(
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
    clips = frame.clips
    if frame.properties.get("overflow", "hidden") not in ("visible", "auto"):
        right, bottom = into.x + into.width, into.y + into.height
        local = np.array([[into.x, into.y], [right, into.y], [right, bottom], [into.x, bottom]])
        clips = (*clips, Clip(frame, element, corners=apply(frame.matrix, local)))
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
        clips=clips,
    )
