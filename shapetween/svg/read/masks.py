"""Masks: those that show or hide all of what lies in an area as regions, all others as shapes.

.. [MSK] *CSS Masking Module Level 1*, sections 6 and 7.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from xml.etree.ElementTree import Element

import numpy as np

from shapetween.base.arrays import Points
from shapetween.boolean.area import filled_area
from shapetween.boolean.chords import chords_of
from shapetween.geometry.affine import affine, compose, mapped
from shapetween.model.drawing import Box, Shape
from shapetween.model.outline import Outline
from shapetween.model.paint import Colour, FillRule, Gradient, Mask, Paint, Stroke
from shapetween.svg.read.clip import CLIP_WORK, Clipper, Region
from shapetween.svg.read.document import Document
from shapetween.svg.read.frames import Layer, Placed
from shapetween.svg.read.stroked import stroke_rings
from shapetween.svg.read.walk import object_box, walk
from shapetween.svg.read.xml import label, local_name

__all__ = ["Masker"]

#: Masks within masks; more is taken for a circle.
MOST_NESTED = 8

#: How far from all or nothing a brightness may be and count as it: less than a screen shows.
SURE = 1 / 512

#: What the components of a colour count for its brightness ([MSK]_, section 7.9.1).
LUMINANCE = np.array([0.2125, 0.7154, 0.0721])

Painted = Callable[[Iterable[Placed]], list[Shape]]

_Layer = tuple[tuple[Outline, ...], FillRule, bool]


class Masker:
    """Reads the masks of one document.

    Parameters
    ----------
    document : Document
    clipper : Clipper
    painted : callable
        The shapes that placed elements paint, with all that is done to them.
    """

    def __init__(self, document: Document, clipper: Clipper, painted: Painted) -> None:
        self._document = document
        self._clipper = clipper
        self._painted = painted
        self._found: dict[object, Region | Mask | None] = {}
        self._within: list[Element] = []

    def of(self, layer: Layer) -> Region | Mask | None:
        """What a layer's mask shows; None if it has none, or one that was left out."""
        element = layer.mask
        if element is None:
            return None
        in_box = [
            element.get(name, default).strip() != "userSpaceOnUse"
            for name, default in (("maskUnits", ""), ("maskContentUnits", "userSpaceOnUse"))
        ]
        box = object_box(self._document, layer.element, layer.frame) if any(in_box) else None
        if any(in_box) and box is None:
            box = Box(0.0, 0.0, 0.0, 0.0)
        key = (element, layer.frame.matrix.tobytes(), box, layer.mask_mode)
        if key not in self._found:
            if element in self._within or len(self._within) >= MOST_NESTED:
                self._document.losses.add("a mask that masks itself was left out")
                return None
            self._within.append(element)
            try:
                self._found[key] = self._read(layer, element, box, *in_box)
            finally:
                self._within.pop()
        return self._found[key]

    def _read(
        self, layer: Layer, element: Element, box: Box | None, region_in_box: bool, in_box: bool
    ) -> Region | Mask | None:
        properties = self._document.style(element)
        corners = mapped(
            _corners(element, layer, box if region_in_box else None), layer.frame.matrix
        )
        frame = replace(layer.frame, properties=properties, layers=(), uses=(), name="")
        if in_box:
            assert box is not None  # it was looked up for this
            if box.width <= 0 or box.height <= 0:
                return None
            step = affine(box.width, 0, 0, box.height, box.x, box.y)
            viewport = replace(frame.viewport, width=1.0, height=1.0)
            frame = replace(frame, matrix=compose(frame.matrix, step), viewport=viewport)
        edge = Layer(element, frame, clip=corners)
        frame = replace(frame, layers=(edge,))
        placed = (
            each
            for child in element
            if local_name(child)
            for each in walk(self._document, child, frame)
        )
        shapes = self._painted(placed)
        kind = layer.mask_mode
        if kind == "match-source":
            kind = properties.get("mask-type", "luminance")
        if kind == "luminance" and properties.get("color-interpolation") == "linearrgb":
            what = "the brightness of a mask that asks for linearRGB was taken as sRGB"
            self._document.losses.add(what, label(element))
        if kind == "alpha":
            shapes = [_whitened(shape) for shape in shapes]
        region = self._area(shapes)
        if region is not None:
            return region
        return Mask(tuple(shapes))

    def _area(self, shapes: Sequence[Shape]) -> Region | None:
        """The area that shapes and their strokes show, if they show or hide all of it."""
        import shapely

        layers: list[_Layer] = []
        for shape in shapes:
            own = _layers(shape)
            if own is None:
                return None
            layers += own
        area = shapely.Polygon()
        edges = []
        for rings, rule, level in layers:
            chords = chords_of([ring.close() for ring in rings])
            self._document.spend("clip_points", len(chords.ends) + CLIP_WORK)
            shown = filled_area(chords.polylines, rule)
            if shown is None:
                return None
            area = area.union(shown) if level else area.difference(shown)
            edges.append(chords)
        return Region(area, tuple(edges))


def _corners(element: Element, layer: Layer, box: Box | None) -> Points:
    """The corners of a mask's own region, in the coordinates of what it masks."""
    viewport = layer.frame.viewport
    values = []
    for name, default in (("x", "-10%"), ("y", "-10%"), ("width", "120%"), ("height", "120%")):
        across = name in ("x", "width")
        of = 1.0 if box is not None else viewport.width if across else viewport.height
        value = viewport.length(element.get(name, default), of)
        values.append(value if value is not None else viewport.length(default, of) or 0.0)
    x, y, width, height = values
    if box is not None:
        x, y = box.x + x * box.width, box.y + y * box.height
        width, height = width * box.width, height * box.height
    right, bottom = x + max(0.0, width), y + max(0.0, height)
    return np.array([[x, y], [right, y], [right, bottom], [x, bottom]])


def _layers(shape: Shape) -> list[_Layer] | None:
    """The rings of a mask's shape and of its stroke, their rule, and whether each shows or hides.

    None if one of them does neither.
    """
    style = shape.style
    if style.texture is not None or style.groups:
        return None
    layers: list[_Layer] = []
    paints: list[tuple[Paint, Stroke | None]] = [(style.fill, None)]
    if style.stroke is not None and style.stroke.width > 0:
        paints.append((style.stroke.paint, style.stroke))
    for paint, stroke in paints:
        if paint is None:
            continue
        level = _level(paint, style.opacity)
        rings = shape.rings if stroke is None else stroke_rings(shape.rings, stroke)
        if level is None or rings is None:
            return None
        if rings:
            layers.append((rings, style.fill_rule if stroke is None else "nonzero", level))
    return layers


def _level(paint: Paint, opacity: float) -> bool | None:
    """Whether a paint of a mask shows all that it covers, or hides it all; None if neither."""
    if not isinstance(paint, Colour) or paint.alpha * opacity < 1 - SURE:
        return None
    light = float(LUMINANCE @ np.array([paint.red, paint.green, paint.blue]))
    if light > 1 - SURE:
        return True
    return False if light < SURE else None


def _whitened(shape: Shape) -> Shape:
    """A shape that shows as much by its brightness as it did by being there."""
    style = shape.style
    stroke = style.stroke
    if stroke is not None:
        paint = _white(stroke.paint)
        assert paint is not None  # a stroke has some
        stroke = replace(stroke, paint=paint)
    return replace(shape, style=replace(style, fill=_white(style.fill), stroke=stroke))


def _white(paint: Paint) -> Paint:
    if isinstance(paint, Gradient):
        stops = tuple(
            replace(stop, colour=Colour(1.0, 1.0, 1.0, stop.colour.alpha)) for stop in paint.stops
        )
        return replace(paint, stops=stops)
    return None if paint is None else Colour(1.0, 1.0, 1.0, paint.alpha)
