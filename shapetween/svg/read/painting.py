"""Properties of a shape to the values it is painted with."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Literal, cast

import numpy as np

from shapetween.geometry.affine import mean_scale
from shapetween.geometry.bezier import curve_lengths
from shapetween.model.paint import Colour, FillRule, Paint, Pattern, Stroke, Style, Texture
from shapetween.svg.read.colours import CURRENT, parse_paint
from shapetween.svg.read.document import Document
from shapetween.svg.read.frames import Frame, Placed
from shapetween.svg.read.gradients import GRADIENTS, colour_of, gradient, is_in_box, with_alpha
from shapetween.svg.read.pathdata import Subpath
from shapetween.svg.read.patterns import pattern_of
from shapetween.svg.read.placing import KEPT
from shapetween.svg.read.rings import bounds
from shapetween.svg.read.style import Properties, page_key
from shapetween.svg.read.units import number
from shapetween.svg.read.xml import local_name
from shapetween.svg.textures import pattern_texture, picture_texture

__all__ = ["fill_rule", "picture_style", "style_of"]

#: Most numbers of a dash pattern that are read; drawings have a handful.
MOST_DASHES = 1000

#: What stands for a pattern or a picture, which is neither a colour nor a gradient.
STAND_IN = Colour(0.5, 0.5, 0.5)


def style_of(
    document: Document, frame: Frame, subpaths: Sequence[Subpath], path_length: float | None
) -> Style:
    """How a shape is painted, in the drawing's user units.

    Parameters
    ----------
    document : Document
    frame : Frame
        The shape's own.
    subpaths : sequence of Subpath
        Its geometry in local coordinates.
    path_length : float or None
        Its ``pathLength``, the unit of its dashes.
    """
    properties = frame.properties
    return Style(
        fill=_paint(document, "fill", "black", frame, subpaths),
        stroke=_stroke(document, frame, subpaths, path_length),
        crisp=properties.get("shape-rendering", "auto") in ("crispedges", "optimizespeed"),
        fill_rule=fill_rule(properties, "fill-rule"),
        texture=_fill_texture(document, frame, subpaths),
        pattern=_fill_pattern(document, frame, subpaths),
    )


def picture_style(document: Document, placed: Placed, subpaths: Sequence[Subpath]) -> Style | None:
    """How an ``image`` is painted; None, with a warning, if it cannot be had."""
    texture = picture_texture(document, placed, bounds(subpaths))
    if texture is None:
        return None
    return Style(fill=STAND_IN, texture=texture)


def _fill_texture(document: Document, frame: Frame, subpaths: Sequence[Subpath]) -> Texture | None:
    """The pattern that fills a shape, if patterns are kept."""
    value = parse_paint(frame.properties.get("fill", "black"))
    alpha = _alpha(frame, "fill")
    if document.pictures is None or value is None or not value.reference or alpha == 0:
        return None
    server = document.ids.get(value.reference)
    if server is None or local_name(server) != "pattern":
        return None
    return pattern_texture(document, value.reference, bounds(subpaths), frame, alpha)


def _fill_pattern(document: Document, frame: Frame, subpaths: Sequence[Subpath]) -> Pattern | None:
    """The pattern that fills a shape, where none is kept as a texture."""
    value = parse_paint(_in_context(frame, frame.properties.get("fill", "black")))
    alpha = _alpha(frame, "fill")
    if document.pictures is not None or value is None or not value.reference or alpha == 0:
        return None
    server = document.ids.get(value.reference)
    if server is None or local_name(server) != "pattern":
        return None
    return pattern_of(document, server, bounds(subpaths), frame, alpha)[0]


def fill_rule(properties: Properties, name: str) -> FillRule:
    """``fill-rule`` or ``clip-rule``."""
    return "evenodd" if properties.get(name, "").lower() == "evenodd" else "nonzero"


def _paint(
    document: Document, name: str, default: str, frame: Frame, subpaths: Sequence[Subpath]
) -> Paint:
    properties = frame.properties
    value = parse_paint(_in_context(frame, properties.get(name, default)))
    alpha = _alpha(frame, name)
    if value is None or alpha == 0:
        return None
    if value.reference:
        server = document.ids.get(value.reference)
        kind = "" if server is None else local_name(server)
        box = bounds(subpaths)
        flat = box.width <= 0 or box.height <= 0
        if server is not None and kind in GRADIENTS and flat and is_in_box(document, server):
            if value.colour is None:  # what has no box is not painted, as [SVG2]_ says
                return None
        elif server is not None and kind in GRADIENTS:
            paint = gradient(document, server, box, frame.matrix, frame.viewport, alpha)
            return None if isinstance(paint, Colour) and paint.alpha == 0 else paint
        if kind == "pattern":
            assert server is not None  # it has a name
            if document.pictures is not None and name == "fill":
                return with_alpha(STAND_IN, alpha)
            kept, mean = pattern_of(document, server, bounds(subpaths), frame, alpha)
            if mean.alpha == 0:
                return None
            if name == "stroke":
                document.losses.add("a pattern on a stroke was replaced by its mean colour")
            else:
                what = "is its mean colour on the way to another paint, and anywhere but in .svg"
                if kept is None:
                    what = "was replaced by a plain colour"
                document.losses.add(f"a pattern {what}; {KEPT}")
            return mean
        if value.colour is None:
            document.losses.add(f"a {name} names no gradient in this file and was left out")
    current = value.colour == CURRENT
    colour = colour_of(properties, "color") if current else value.colour
    if not isinstance(colour, Colour) or colour.alpha == 0:
        return None
    reference = properties.get(page_key("color" if current else name), "")
    if current and "color" not in properties:
        reference = "currentColor"
    return with_alpha(replace(colour, reference=reference), alpha)


def _in_context(frame: Frame, text: str) -> str:
    """A paint, or that of the line that a marker is on."""
    words = ("context-fill", "context-stroke")
    word = text.strip().lower()
    if word not in words:
        return text
    return "none" if frame.context is None else frame.context[words.index(word)]


def _alpha(frame: Frame, name: str) -> float:
    opacity = number(frame.properties.get(f"{name}-opacity"))
    return 1.0 if opacity is None else min(1.0, max(0.0, opacity))


def _stroke(
    document: Document, frame: Frame, subpaths: Sequence[Subpath], path_length: float | None
) -> Stroke | None:
    paint = _paint(document, "stroke", "none", frame, subpaths)
    if paint is None:
        return None
    properties = frame.properties
    viewport = frame.viewport
    width = viewport.length(properties.get("stroke-width", "1"), viewport.diagonal)
    width = 1.0 if width is None or width < 0 else width
    if width == 0:
        return None
    if properties.get("vector-effect") == "non-scaling-stroke":
        scale = frame.pixel
    else:
        scale = mean_scale(frame.matrix)
    cap = properties.get("stroke-linecap", "butt")
    join = properties.get("stroke-linejoin", "miter")
    limit = number(properties.get("stroke-miterlimit"))
    dashes = _dashes(document, frame)
    dash_unit = scale
    if dashes and path_length is not None and path_length > 0:
        dash_unit *= sum(map(_length, subpaths)) / path_length
    offset = viewport.length(properties.get("stroke-dashoffset"), viewport.diagonal) or 0.0
    return Stroke(
        paint=paint,
        width=width * scale,
        cap=cast(Literal["butt", "round", "square"], cap) if cap in ("round", "square") else "butt",
        join=cast(Literal["round", "bevel"], join) if join in ("round", "bevel") else "miter",
        miter_limit=4.0 if limit is None or limit < 1 else limit,
        dashes=tuple(dash * dash_unit for dash in dashes),
        dash_offset=offset * dash_unit,
    )


def _dashes(document: Document, frame: Frame) -> tuple[float, ...]:
    """The dash pattern in local units, of even count; empty for a solid line."""
    text = frame.properties.get("stroke-dasharray", "none")
    if text == "none":
        return ()
    viewport = frame.viewport
    dashes = []
    words = text.replace(",", " ").split()
    if len(words) > MOST_DASHES:
        document.losses.add("a pattern of too many dashes was cut short")
    for word in words[:MOST_DASHES]:
        dash = viewport.length(word, viewport.diagonal)
        if dash is None or dash < 0:
            return ()
        dashes.append(dash)
    if not sum(dashes):
        return ()
    return tuple(dashes * 2 if len(dashes) % 2 else dashes)


def _length(subpath: Subpath) -> float:
    """Length of a subpath with the line that closes it."""
    curves = subpath.curves
    if not len(curves):
        return 0.0
    closing = np.linalg.norm(curves[-1, 3] - subpath.start) if subpath.closed else 0.0
    return float(curve_lengths(curves).sum() + closing)
