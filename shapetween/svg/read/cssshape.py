"""Clips that style gives as shapes: ``circle()``, ``inset()``, ``polygon()`` and their kin.

.. [SHP] *CSS Shapes Module Level 1*, section 3. .. [MSK] *CSS Masking Module Level 1*, section 5.1.
"""

import math
from collections.abc import Sequence
from typing import Any, TypeVar

import numpy as np
import tinycss2

from shapetween.geometry.bezier import line_curves
from shapetween.model.drawing import Box
from shapetween.model.paint import FillRule
from shapetween.svg.read.document import Document
from shapetween.svg.read.frames import Layer
from shapetween.svg.read.pathdata import Subpath, parse_path_data
from shapetween.svg.read.shapes import basic_shape
from shapetween.svg.read.units import Viewport
from shapetween.svg.read.walk import object_box

__all__ = ["css_shape"]

#: Points of a polygon that are read.
MOST_POINTS = 10_000

_BOXES = frozenset(
    {"border-box", "padding-box", "content-box", "margin-box", "fill-box", "stroke-box", "view-box"}
)
_T = TypeVar("_T")

_CORNERS = {(x, y) for x in ("left", "right") for y in ("top", "bottom")}
_WORDS = {"left": 0.0, "top": 0.0, "center": 0.5, "right": 1.0, "bottom": 1.0}


def css_shape(
    document: Document, text: str, layer: Layer
) -> tuple[tuple[Subpath, ...], FillRule] | None:
    """A ``clip-path`` that is a basic shape or a box, in the element's own coordinates.

    Returns
    -------
    subpaths and fill rule, or None
        None if it is malformed, or a shape that this reader does not know.
    """
    tokens = [
        token
        for token in tinycss2.parse_component_value_list(text, skip_comments=True)
        if token.type != "whitespace"
    ]
    names = [t.lower_value for t in tokens if t.type == "ident" and t.lower_value in _BOXES]
    functions = [token for token in tokens if token.type == "function"]
    if len(names) > 1 or len(functions) > 1 or len(names) + len(functions) != len(tokens):
        return None
    viewport = layer.frame.viewport
    box = _reference(document, layer, names[0] if names else "border-box")
    if not functions:
        return _rect(box.x, box.y, box.width, box.height, [], viewport, box), "nonzero"
    token = functions[0]
    parts = _split(token.arguments)
    rule: FillRule = "nonzero"
    if token.lower_name in ("polygon", "path") and len(parts) > 1 and len(parts[0]) == 1:
        word = parts[0][0].serialize().lower()
        if word in ("nonzero", "evenodd"):
            rule = "evenodd" if word == "evenodd" else "nonzero"
            parts = parts[1:]
    build = _SHAPES.get(token.lower_name)
    found = build(parts, box, viewport, document.limits.path_commands) if build else None
    return None if found is None else (found, rule)


def _reference(document: Document, layer: Layer, name: str) -> Box:
    """The box that a shape is placed in ([MSK]_: without one of CSS's own boxes, SVG's)."""
    viewport = layer.frame.viewport
    if name == "view-box":
        return Box(0.0, 0.0, viewport.width, viewport.height)
    box = object_box(document, layer.element, layer.frame) or Box(0.0, 0.0, 0.0, 0.0)
    if name in ("fill-box", "content-box", "padding-box"):
        return box
    properties = layer.frame.properties
    width = 0.0
    if properties.get("stroke", "none") != "none":
        width = viewport.length(properties.get("stroke-width", "1"), viewport.diagonal) or 0.0
    return Box(box.x - width / 2, box.y - width / 2, box.width + width, box.height + width)


def _split(tokens: Sequence[Any]) -> list[list[Any]]:
    parts: list[list[Any]] = [[]]
    for token in tokens:
        if token.type == "literal" and token.value == ",":
            parts.append([])
        elif token.type not in ("whitespace", "comment"):
            parts[-1].append(token)
    return parts


def _lengths(tokens: Sequence[Any], of: Sequence[float], viewport: Viewport) -> list[float] | None:
    """Lengths, of which percentages are of one of some sizes each."""
    values = []
    for token, size in zip(tokens, of, strict=False):
        value = viewport.length(token.serialize(), size)
        if value is None:
            return None
        values.append(value)
    return values


def _polygon(
    parts: list[list[Any]], box: Box, viewport: Viewport, most: int
) -> tuple[Subpath, ...] | None:
    if len(parts) > MOST_POINTS:
        return None
    points = []
    for part in parts:
        place = _lengths(part, (box.width, box.height), viewport) if len(part) == 2 else None
        if place is None:
            return None
        points.append([box.x + place[0], box.y + place[1]])
    if len(points) < 3:
        return None
    ring = np.array([*points, points[0]])
    return (Subpath(line_curves(ring[:-1], ring[1:]), ring[0], True),)


def _path(
    parts: list[list[Any]], box: Box, viewport: Viewport, most: int
) -> tuple[Subpath, ...] | None:
    if len(parts) != 1 or len(parts[0]) != 1 or parts[0][0].type != "string":
        return None
    moved = parse_path_data(parts[0][0].value, most).subpaths
    shift = np.array([box.x, box.y])
    return tuple(Subpath(sub.curves + shift, sub.start + shift, sub.closed) for sub in moved)


def _round(
    parts: list[list[Any]], box: Box, viewport: Viewport, most: int
) -> tuple[Subpath, ...] | None:
    """``circle()`` or ``ellipse()``; a circle is an ellipse with one radius."""
    if len(parts) != 1:
        return None
    words = [token.serialize().lower() for token in parts[0]]
    at = words.index("at") if "at" in words else len(words)
    sizes = words[:at]
    centre = _place(words[at + 1 :] if at < len(words) else ["center"], box, viewport)
    if centre is None or len(sizes) > 2:
        return None
    cx, cy = centre
    sides = [(abs(cx - box.x), abs(box.x + box.width - cx))]
    sides.append((abs(cy - box.y), abs(box.y + box.height - cy)))
    whole = [math.hypot(box.width, box.height) / math.sqrt(2)]
    if len(sizes) == 2:
        whole = [box.width, box.height]
    radii = []
    for k, size in enumerate(sizes or ["closest-side"]):
        near = sides[k] if len(sizes) == 2 else (*sides[0], *sides[1])
        if size == "closest-side":
            radii.append(min(near))
        elif size == "farthest-side":
            radii.append(max(near))
        else:
            length = viewport.length(size, whole[min(k, len(whole) - 1)])
            if length is None or length < 0:
                return None
            radii.append(length)
    values = {"cx": f"{cx!r}", "cy": f"{cy!r}", "rx": f"{radii[0]!r}", "ry": f"{radii[-1]!r}"}
    return basic_shape("ellipse", values, viewport, most).subpaths


def _ellipse(
    parts: list[list[Any]], box: Box, viewport: Viewport, most: int
) -> tuple[Subpath, ...] | None:
    """``ellipse()``, whose default radii differ."""
    words = [token.serialize().lower() for token in parts[0]] if len(parts) == 1 else []
    if not words or words[0] == "at":
        closest = tinycss2.parse_component_value_list("closest-side closest-side")
        parts = [[token for token in closest if token.type == "ident"] + parts[0]]
    return _round(parts, box, viewport, most)


def _place(words: list[str], box: Box, viewport: Viewport) -> tuple[float, float] | None:
    """A position of one or two words, or of two edges and how far each is from there."""
    if len(words) == 4 and words[0] in _WORDS and words[2] in _WORDS:
        if words[0] in ("top", "bottom"):
            words = words[2:] + words[:2]
        (edge, one), (other, two) = words[:2], words[2:]
        across, down = viewport.length(one, box.width), viewport.length(two, box.height)
        if across is None or down is None or (edge, other) not in _CORNERS:
            return None
        x = box.x + (across if edge == "left" else box.width - across)
        y = box.y + (down if other == "top" else box.height - down)
        return x, y
    if len(words) == 1:
        words = ["center", *words] if words[0] in ("top", "bottom") else [*words, "center"]
    if len(words) != 2:
        return None
    if words[0] in ("top", "bottom") or words[1] in ("left", "right"):
        words = words[::-1]
    found = []
    for word, start, size in zip(words, (box.x, box.y), (box.width, box.height), strict=True):
        offset = _WORDS[word] * size if word in _WORDS else viewport.length(word, size)
        if offset is None:
            return None
        found.append(start + offset)
    return found[0], found[1]


def _edges(tokens: list[Any]) -> tuple[list[Any], list[Any]]:
    """What stands before ``round``, and after it."""
    words = [token.serialize().lower() for token in tokens]
    at = words.index("round") if "round" in words else len(words)
    return tokens[:at], tokens[at + 1 :]


def _four(values: list[_T]) -> list[_T]:
    """What 1 to 4 values say of four sides or corners, as CSS has it."""
    return {1: values * 4, 2: values * 2, 3: [*values, *values[1:2]], 4: values}[len(values)]


def _inset(
    parts: list[list[Any]], box: Box, viewport: Viewport, most: int
) -> tuple[Subpath, ...] | None:
    offsets, radii = _edges(parts[0]) if len(parts) == 1 else ([], [])
    if not 1 <= len(offsets) <= 4:
        return None
    sizes = (box.height, box.width, box.height, box.width)
    found = _lengths(_four(offsets), sizes, viewport)
    if found is None:
        return None
    top, right, bottom, left = found
    width, height = box.width - left - right, box.height - top - bottom
    return _rect(box.x + left, box.y + top, width, height, radii, viewport, box)


def _xywh(
    parts: list[list[Any]], box: Box, viewport: Viewport, most: int
) -> tuple[Subpath, ...] | None:
    edges, radii = _edges(parts[0]) if len(parts) == 1 else ([], [])
    sizes = (box.width, box.height, box.width, box.height)
    found = _lengths(edges, sizes, viewport) if len(edges) == 4 else None
    if found is None:
        return None
    return _rect(box.x + found[0], box.y + found[1], found[2], found[3], radii, viewport, box)


def _sides(
    parts: list[list[Any]], box: Box, viewport: Viewport, most: int
) -> tuple[Subpath, ...] | None:
    """``rect()``: the four edges, each from the top or the left."""
    edges, radii = _edges(parts[0]) if len(parts) == 1 else ([], [])
    if len(edges) != 4:
        return None
    sizes = (box.height, box.width, box.height, box.width)
    ends = (0.0, box.width, box.height, 0.0)
    found = []
    for token, size, end in zip(edges, sizes, ends, strict=True):
        text = token.serialize().lower()
        value = end if text == "auto" else viewport.length(text, size)
        if value is None:
            return None
        found.append(value)
    top, right, bottom, left = found
    return _rect(box.x + left, box.y + top, right - left, bottom - top, radii, viewport, box)


def _rect(
    x: float,
    y: float,
    width: float,
    height: float,
    radii: list[Any],
    viewport: Viewport,
    box: Box,
) -> tuple[Subpath, ...]:
    """A rectangle, its corners as round as 1 to 4 radii say, and as many down after a slash."""
    if width <= 0 or height <= 0:
        return ()
    of = Viewport(box.width, box.height, viewport.font_size, viewport.root_font_size)
    words = [token.serialize() for token in radii]
    slash = words.index("/") if "/" in words else len(words)
    rx, ry = (
        [max(of.length(word, size) or 0.0, 0.0) for word in given[:4]] or [0.0]
        for given, size in (
            (words[:slash], box.width),
            (words[slash + 1 :] or words[:slash], box.height),
        )
    )
    rx, ry = _four(rx), _four(ry)
    sums = [(rx[0] + rx[1], width), (rx[2] + rx[3], width)]
    sums += [(ry[0] + ry[3], height), (ry[1] + ry[2], height)]
    # Radii that meet are made smaller, all by the same share.
    share = min([1.0, *(side / both for both, side in sums if both > 0)])
    a, b, c, d = ((share * across, share * down) for across, down in zip(rx, ry, strict=True))
    right, bottom = x + width, y + height
    text = (
        f"M{x + a[0]!r} {y!r}H{right - b[0]!r}A{b[0]!r} {b[1]!r} 0 0 1 {right!r} {y + b[1]!r}"
        f"V{bottom - c[1]!r}A{c[0]!r} {c[1]!r} 0 0 1 {right - c[0]!r} {bottom!r}"
        f"H{x + d[0]!r}A{d[0]!r} {d[1]!r} 0 0 1 {x!r} {bottom - d[1]!r}"
        f"V{y + a[1]!r}A{a[0]!r} {a[1]!r} 0 0 1 {x + a[0]!r} {y!r}Z"
    )
    return parse_path_data(text, 100).subpaths


_SHAPES = {
    "circle": _round,
    "ellipse": _ellipse,
    "polygon": _polygon,
    "path": _path,
    "inset": _inset,
    "xywh": _xywh,
    "rect": _sides,
}
