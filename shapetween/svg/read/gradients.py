"""Gradients of a document, resolved to the drawing's own units.

.. [SVG2] *Scalable Vector Graphics 2*, chapter 14.
"""

from collections.abc import Mapping
from dataclasses import replace
from itertools import pairwise
from typing import Literal
from xml.etree.ElementTree import Element

import numpy as np

from shapetween.base.arrays import Affine
from shapetween.geometry.affine import affine, compose
from shapetween.model.drawing import Box
from shapetween.model.paint import Colour, Gradient, Paint, Stop
from shapetween.model.srgb import linear_to_srgb, srgb_to_linear
from shapetween.svg.read.colours import parse_paint
from shapetween.svg.read.csstransform import css_transform
from shapetween.svg.read.document import Document
from shapetween.svg.read.style import Properties
from shapetween.svg.read.transform import parse_transform
from shapetween.svg.read.units import Viewport, number
from shapetween.svg.read.xml import local_name

__all__ = ["GRADIENTS", "colour_of", "gradient", "is_in_box", "with_alpha"]

GRADIENTS = frozenset({"linearGradient", "radialGradient"})

#: Gradients that refer to gradients; more is taken for a circle.
MOST_REFERENCES = 16

#: Stops of a gradient that are read; more cannot be told apart.
MOST_STOPS = 100

#: Parts in which a way through linear light is written. Fewer and its bend is seen as bands.
LIGHT_STEPS = 8

_BLACK = Colour()


def with_alpha(colour: Colour, share: float) -> Colour:
    """A colour with its alpha multiplied."""
    return replace(colour, alpha=colour.alpha * share)


def colour_of(properties: Properties, name: str) -> Colour:
    """A property that holds a colour, black by default."""
    value = parse_paint(properties.get(name, "black"))
    colour = value.colour if value else None
    if isinstance(colour, str):  # currentcolor
        return _BLACK if name == "color" else colour_of(properties, "color")
    return colour or _BLACK


def gradient(
    document: Document,
    element: Element,
    box: Box,
    matrix: Affine,
    viewport: Viewport,
    alpha: float,
) -> Paint:
    """What a gradient element paints a certain shape with.

    Parameters
    ----------
    document : Document
    element : Element
    box : Box
        The shape's own bounding box, in its local coordinates and without its stroke.
    matrix : (2, 3) float64
        From those to the drawing's user units.
    viewport : Viewport
    alpha : float
        ``fill-opacity`` or ``stroke-opacity``.

    Returns
    -------
    Gradient, Colour or None
        A colour where the gradient is only one, None where it paints nothing.
    """
    chain = _chain(document, element)
    stops = _stops(document, chain, alpha)
    if not stops:
        return None
    values: dict[str, str] = {}
    for link in reversed(chain):
        values.update(link.items())
    style = document.style(element)

    in_box = is_in_box(document, element)
    if in_box:
        if box.width <= 0 or box.height <= 0:
            return None
        matrix = compose(matrix, affine(box.width, 0, 0, box.height, box.x, box.y))
        viewport = Viewport(1.0, 1.0)
    if len(stops) == 1:
        return stops[0].colour
    turned: Affine | None
    if "transform" in style:  # as CSS; the attribute is called gradientTransform
        whole = Box(0.0, 0.0, viewport.width, viewport.height)
        turned = css_transform(style, None, viewport, whole)
    else:
        turned = parse_transform(values.get("gradientTransform", ""))
    if turned is not None:
        matrix = compose(matrix, turned)
    (a, c, e), (b, d, f) = matrix.tolist()
    if a * d == b * c:
        return stops[-1].colour

    kind: Literal["linear", "radial"] = "linear"
    if local_name(element) == "radialGradient":
        kind = "radial"
        points = _radial(values, viewport)
        flat = points[2] <= 0
        inner = _length(values, "fr", "0%", viewport, viewport.diagonal)
        if inner > 0 and not flat:
            if inner >= points[2]:
                document.losses.add("a gradient whose fr is not less than its r was left out")
                return None
            if values.get("spreadMethod", "pad").strip() != "pad":
                document.losses.add("a repeated gradient was drawn as if its fr were 0")
            else:
                points, stops = _from_apex(points, stops, inner)
    else:
        points = _linear(values, viewport)
        flat = points[:2] == points[2:]
    if flat:
        return stops[-1].colour
    if style.get("color-interpolation") == "linearrgb":
        stops = _through_light(stops)
    spread = values.get("spreadMethod", "pad").strip()
    return Gradient(
        kind,
        points,
        (a, b, c, d, e, f),
        stops,
        "reflect" if spread == "reflect" else "repeat" if spread == "repeat" else "pad",
    )


def is_in_box(document: Document, element: Element) -> bool:
    """Whether a gradient is given in shares of the box of what it paints."""
    units = [link.get("gradientUnits") for link in _chain(document, element)]
    named = next((unit for unit in units if unit is not None), "objectBoundingBox")
    return named.strip() != "userSpaceOnUse"


def _from_apex(
    points: tuple[float, ...], stops: tuple[Stop, ...], inner: float
) -> tuple[tuple[float, ...], tuple[Stop, ...]]:
    """A radial gradient from a circle on, as the same cone of colours from its apex on."""
    cx, cy, r, fx, fy = points
    start = -inner / (r - inner)  # the share at which the circle is a point
    moved = tuple(replace(stop, offset=(stop.offset - start) / (1 - start)) for stop in stops)
    return (cx, cy, r, fx + start * (cx - fx), fy + start * (cy - fy)), moved


def _through_light(stops: tuple[Stop, ...]) -> tuple[Stop, ...]:
    """The stops with others between them where the way is straight in linear light."""
    found = list(stops[:1])
    for first, last in pairwise(stops):
        a, b = (
            srgb_to_linear(np.array([c.red, c.green, c.blue])) for c in (first.colour, last.colour)
        )
        for k in range(1, LIGHT_STEPS if last.offset > first.offset else 1):
            t = k / LIGHT_STEPS
            red, green, blue = linear_to_srgb((1 - t) * a + t * b).tolist()
            alpha = (1 - t) * first.colour.alpha + t * last.colour.alpha
            offset = (1 - t) * first.offset + t * last.offset
            found.append(Stop(offset, Colour(red, green, blue, alpha)))
        found.append(last)
    return tuple(found)


def _chain(document: Document, element: Element) -> list[Element]:
    """A gradient and those it takes its missing parts from, nearest first."""
    chain = [element]
    while len(chain) <= MOST_REFERENCES:
        following = document.target(chain[-1])
        if following is None or following in chain or local_name(following) not in GRADIENTS:
            break
        chain.append(following)
    return chain


def _stops(document: Document, chain: list[Element], alpha: float) -> tuple[Stop, ...]:
    """Stops of the first gradient in a chain that has any."""
    for link in chain:
        if (link, alpha) not in document.stops:
            document.stops[link, alpha] = _own_stops(document, link, alpha)
        if stops := document.stops[link, alpha]:
            return stops
    return ()


def _own_stops(document: Document, element: Element, alpha: float) -> tuple[Stop, ...]:
    elements = [child for child in element if local_name(child) == "stop"]
    if len(elements) > MOST_STOPS:
        document.losses.add("a gradient of too many stops was cut short")
    stops = []
    reached = 0.0
    for stop in elements[:MOST_STOPS]:
        properties = document.style(stop)
        offset = number(stop.get("offset"))
        reached = max(reached, min(1.0, max(0.0, offset or 0.0)))
        opacity = number(properties.get("stop-opacity"))
        share = 1.0 if opacity is None else min(1.0, max(0.0, opacity))
        stops.append(Stop(reached, with_alpha(colour_of(properties, "stop-color"), share * alpha)))
    return tuple(stops)


def _linear(values: Mapping[str, str], viewport: Viewport) -> tuple[float, ...]:
    return (
        _length(values, "x1", "0%", viewport, viewport.width),
        _length(values, "y1", "0%", viewport, viewport.height),
        _length(values, "x2", "100%", viewport, viewport.width),
        _length(values, "y2", "0%", viewport, viewport.height),
    )


def _radial(values: Mapping[str, str], viewport: Viewport) -> tuple[float, ...]:
    cx = _length(values, "cx", "50%", viewport, viewport.width)
    cy = _length(values, "cy", "50%", viewport, viewport.height)
    r = _length(values, "r", "50%", viewport, viewport.diagonal)
    fx, fy = (
        viewport.length(values.get("fx"), viewport.width),
        viewport.length(values.get("fy"), viewport.height),
    )
    return (cx, cy, r, cx if fx is None else fx, cy if fy is None else fy)


def _length(
    values: Mapping[str, str], name: str, default: str, viewport: Viewport, of: float
) -> float:
    value = viewport.length(values.get(name, default), of)
    if value is None:
        value = viewport.length(default, of)
    assert value is not None  # the defaults are sound
    return value
