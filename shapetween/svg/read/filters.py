"""The ``filter`` property to filters that can be written anew.

.. [FE] *Filter Effects Module Level 1*.
"""

from collections.abc import Callable, Sequence
from typing import Any
from xml.etree.ElementTree import Element

import numpy as np
import tinycss2

from shapetween.base.arrays import Affine
from shapetween.geometry.affine import IDENTITY, mapped, mean_scale, stretch
from shapetween.model.drawing import Box
from shapetween.model.paint import Colour, Filter, Primitive
from shapetween.svg.read.colours import parse_paint, reference_of
from shapetween.svg.read.document import Document
from shapetween.svg.read.frames import Layer
from shapetween.svg.read.gradients import colour_of
from shapetween.svg.read.units import number
from shapetween.svg.read.xml import label, local_name

__all__ = ["filters_of"]

#: Most primitives of one filter, filters of one property and parts of one primitive that are read;
#: drawings have a dozen. Fewer cut those short; more let a small file ask for hours of filtering.
MOST_PRIMITIVES = 200

#: Characters of an attribute that are read: tables of component transfers have some hundred.
MOST_CHARACTERS = 4000

#: Greatest over least scale, and shear, up to which lengths are scaled evenly: rounding.
EVEN = 1e-9

#: What is told where a limit is passed.
CUT_SHORT = "a filter of too many effects was cut short"
TOO_LONG = "an attribute of a filter effect that is too long was left out"

_SHARED = frozenset({"in", "result", "x", "y", "width", "height"})
#: Primitives with their own attributes.
PRIMITIVES: dict[str, frozenset[str]] = {
    "feBlend": frozenset({"in2", "mode"}),
    "feColorMatrix": frozenset({"type", "values"}),
    "feComponentTransfer": frozenset(),
    "feComposite": frozenset({"in2", "operator", "k1", "k2", "k3", "k4"}),
    "feConvolveMatrix": frozenset(
        {"order", "kernelMatrix", "divisor", "bias", "targetX", "targetY", "edgeMode"}
        | {"kernelUnitLength", "preserveAlpha"}
    ),
    "feDiffuseLighting": frozenset({"surfaceScale", "diffuseConstant", "kernelUnitLength"}),
    "feDisplacementMap": frozenset({"in2", "scale", "xChannelSelector", "yChannelSelector"}),
    "feDropShadow": frozenset({"dx", "dy", "stdDeviation"}),
    "feFlood": frozenset(),
    "feGaussianBlur": frozenset({"stdDeviation", "edgeMode"}),
    "feMerge": frozenset(),
    "feMorphology": frozenset({"operator", "radius"}),
    "feOffset": frozenset({"dx", "dy"}),
    "feSpecularLighting": frozenset(
        {"surfaceScale", "specularConstant", "specularExponent", "kernelUnitLength"}
    ),
    "feTile": frozenset(),
    "feTurbulence": frozenset({"baseFrequency", "numOctaves", "seed", "stitchTiles", "type"}),
}
_TRANSFER = frozenset({"type", "tableValues", "slope", "intercept", "amplitude", "exponent"})
#: What primitives hold, with its attributes.
PARTS: dict[str, frozenset[str]] = {
    "feMergeNode": frozenset({"in"}),
    "feFuncR": _TRANSFER | {"offset"},
    "feFuncG": _TRANSFER | {"offset"},
    "feFuncB": _TRANSFER | {"offset"},
    "feFuncA": _TRANSFER | {"offset"},
    "feDistantLight": frozenset({"azimuth", "elevation"}),
    "fePointLight": frozenset({"x", "y", "z"}),
    "feSpotLight": frozenset({"x", "y", "z", "pointsAtX", "pointsAtY", "pointsAtZ"})
    | {"specularExponent", "limitingConeAngle"},
}
#: Colours of primitives, with their opacity.
COLOURS = {
    "feFlood": ("flood-color", "flood-opacity"),
    "feDropShadow": ("flood-color", "flood-opacity"),
    "feDiffuseLighting": ("lighting-color", ""),
    "feSpecularLighting": ("lighting-color", ""),
}
#: Lengths by which primitives move or reach; they grow with the drawing. All others that a filter
#: holds would have to be moved too.
LENGTHS = {
    "feGaussianBlur": ("stdDeviation",),
    "feOffset": ("dx", "dy"),
    "feDropShadow": ("dx", "dy", "stdDeviation"),
    "feMorphology": ("radius",),
    "feDisplacementMap": ("scale",),
}
#: Primitives that are the same wherever they are, so that only their region has to be moved.
PLACELESS = frozenset(
    {"feBlend", "feColorMatrix", "feComponentTransfer", "feComposite", "feFlood", "feMerge"}
    | LENGTHS.keys()
)

#: CSS filter functions of one amount, as the slopes and intercepts of their components.
_TRANSFERS: dict[str, Callable[[float], tuple[float, float]]] = {
    "brightness": lambda amount: (amount, 0.0),
    "contrast": lambda amount: (amount, 0.5 - 0.5 * amount),
    "invert": lambda amount: (1 - 2 * min(amount, 1.0), min(amount, 1.0)),
}


def filters_of(document: Document, layer: Layer) -> list[Filter]:
    """The filters of a layer in the order in which they are applied.

    A reference that leads nowhere is as if it were not there. What cannot be carried is told.
    """
    tokens = [
        token
        for token in tinycss2.parse_component_value_list(layer.filters, skip_comments=True)
        if token.type != "whitespace"
    ]
    filters: list[Filter] = []
    steps: list[Primitive] = []
    if len(tokens) > MOST_PRIMITIVES:
        document.losses.add(CUT_SHORT)
    for token in tokens[:MOST_PRIMITIVES]:
        reference = reference_of(token)
        if reference is not None:
            if steps:
                filters.append(_of_functions(document, layer, steps))
                steps = []
            target = document.ids.get(reference)
            found = None
            if target is not None and local_name(target) == "filter":
                found = _of_element(document, target, layer)
            if found is not None:
                filters.append(found)
            continue
        made = _of_function(token, layer)
        if made is None:
            document.losses.add("a filter effect was left out", token.serialize()[:40])
            return []
        steps += made
    if steps:
        filters.append(_of_functions(document, layer, steps))
    return filters


def _of_element(document: Document, element: Element, layer: Layer) -> Filter | None:
    """A ``filter`` element as it acts on what a layer holds."""
    primitives = []
    children = [child for child in element if local_name(child).startswith("fe")]
    if len(children) > MOST_PRIMITIVES:
        document.losses.add(CUT_SHORT, label(element))
    for child in children[:MOST_PRIMITIVES]:
        tag = local_name(child)
        if tag not in PRIMITIVES:
            document.losses.add("a filter effect was left out", f"it needs <{tag[:40]}>")
            return None
        primitives.append(_primitive(document, child, tag))
    if not primitives:  # shows nothing at all
        primitives = [Primitive("feFlood", (("flood-opacity", "0"),))]
    in_box = element.get("filterUnits", "objectBoundingBox").strip() != "userSpaceOnUse"
    box_units = element.get("primitiveUnits", "").strip() == "objectBoundingBox"
    viewport = layer.frame.viewport
    defaults = {"x": "-10%", "y": "-10%", "width": "120%", "height": "120%"}
    sizes = {"x": viewport.width, "y": viewport.height}
    sizes |= {"width": viewport.width, "height": viewport.height}
    region = []
    for name, default in defaults.items():
        of = 1.0 if in_box else sizes[name]
        value = viewport.length(element.get(name, default), of)
        fallback = viewport.length(default, of)
        region.append(value if value is not None else fallback or 0.0)
    x, y, width, height = region
    return _in_user_units(
        tuple(primitives), (x, y, width, height), in_box, box_units, layer.frame.matrix
    )


def _primitive(document: Document, element: Element, tag: str) -> Primitive:
    own = PRIMITIVES[tag] | _SHARED
    attributes = _attributes(document, element, own)
    properties = document.style(element)
    space = properties.get("color-interpolation-filters", "linearrgb")
    if space == "srgb":
        attributes.append(("color-interpolation-filters", "sRGB"))
    if tag in COLOURS:
        name, opacity_name = COLOURS[tag]
        colour = colour_of(properties, name)
        if name == "lighting-color" and name not in properties:
            colour = Colour(1.0, 1.0, 1.0)
        attributes.append((name, _colour_text(colour)))
        if opacity_name:
            share = number(properties.get(opacity_name))
            share = 1.0 if share is None else min(1.0, max(0.0, share))
            attributes.append((opacity_name, f"{colour.alpha * share:.6g}"))
    parts = [child for child in element if local_name(child) in PARTS]
    if len(parts) > MOST_PRIMITIVES:
        document.losses.add(CUT_SHORT, label(element))
    children = tuple(
        Primitive(
            local_name(child),
            tuple(_attributes(document, child, PARTS[local_name(child)])),
        )
        for child in parts[:MOST_PRIMITIVES]
    )
    return Primitive(tag, tuple(attributes), children)


def _attributes(document: Document, element: Element, own: frozenset[str]) -> list[tuple[str, str]]:
    """Its attributes of these names; those that are too long are told."""
    found = [(name, value.strip()) for name, value in element.items() if name in own]
    read = [(name, value) for name, value in found if len(value) <= MOST_CHARACTERS]
    if len(read) < len(found):
        document.losses.add(TOO_LONG)
    return read


def _colour_text(colour: Colour) -> str:
    parts = (round(255 * part) for part in (colour.red, colour.green, colour.blue))
    return "#" + "".join(f"{part:02x}" for part in parts)


def _in_user_units(
    primitives: tuple[Primitive, ...],
    region: tuple[float, float, float, float],
    in_box: bool,
    box_units: bool,
    matrix: Affine,
) -> Filter:
    """The filter with lengths in the drawing's own units, where they can be told in them."""
    scale = mean_scale(matrix)
    (a, c, _), (b, d, _) = matrix.tolist()
    even = max(abs(a - d), abs(b), abs(c)) <= EVEN * scale and stretch(matrix) <= 1 + EVEN
    bare = all(
        p.tag in PLACELESS and not {"x", "y", "width", "height"} & dict(p.attributes).keys()
        for p in primitives
    )
    if box_units or not (even and bare):
        own = tuple(matrix.T.ravel().tolist())
        return Filter(primitives, region, in_box, box_units, own)
    if not in_box:
        x, y = mapped(np.array(region[:2]), matrix).tolist()
        region = (x, y, region[2] * scale, region[3] * scale)
    scaled = tuple(_scaled(primitive, scale) for primitive in primitives)
    return Filter(scaled, region, in_box, False, tuple(IDENTITY.T.ravel().tolist()))


def _scaled(primitive: Primitive, scale: float) -> Primitive:
    names = LENGTHS.get(primitive.tag, ())
    attributes, lengths = [], []
    for name, value in primitive.attributes:
        words = value.replace(",", " ").split()
        numbers = [n for word in words if (n := number(word)) is not None]
        if name in names and words and len(numbers) == len(words):
            lengths.append((name, tuple(n * scale for n in numbers)))
        else:
            attributes.append((name, value))
    if primitive.tag == "feDropShadow":  # lengths that nobody gave are 2
        given = {name for name, _ in primitive.attributes}
        lengths += [(name, (2 * scale,)) for name in names if name not in given]
    return Primitive(primitive.tag, tuple(attributes), primitive.children, tuple(lengths))


def _of_functions(document: Document, layer: Layer, steps: Sequence[Primitive]) -> Filter:
    """CSS filter functions, whose region has no end: what is shown, and as much around it."""
    shown = document.shown
    low = np.array([shown.x - shown.width, shown.y - shown.height])
    high = np.array([shown.x + 2 * shown.width, shown.y + 2 * shown.height])
    corners = np.array([low, [high[0], low[1]], high, [low[0], high[1]]])
    matrix = layer.frame.matrix
    linear = np.linalg.inv(matrix[:, :2])
    local = (corners - matrix[:, 2]) @ linear.T
    low, high = local.min(axis=0), local.max(axis=0)
    region = (float(low[0]), float(low[1]), *(high - low).tolist())
    return _in_user_units(tuple(steps), region, False, False, matrix)


def _of_function(token: Any, layer: Layer) -> list[Primitive] | None:
    """One CSS filter function as primitives that work on what came before ([FE]_, section 12)."""
    if token.type != "function":
        return None
    name = token.lower_name
    arguments = [t for t in token.arguments if t.type not in ("whitespace", "comment")]
    srgb = ("color-interpolation-filters", "sRGB")
    viewport = layer.frame.viewport
    if name == "blur":
        length = viewport.length(arguments[0].serialize(), 0.0) if arguments else 0.0
        if length is None or length < 0 or len(arguments) > 1:
            return None
        return [Primitive("feGaussianBlur", (("stdDeviation", f"{length:.9g}"), srgb))]
    if name == "drop-shadow":
        return _shadow(arguments, layer)
    if name == "hue-rotate":
        from shapetween.svg.read.csstransform import transform_step

        angle = arguments[0].serialize() if arguments else "0deg"
        turn = transform_step("rotate", angle, viewport, Box(0.0, 0.0, 1.0, 1.0))
        if turn is None:
            return None
        degrees = float(np.degrees(np.arctan2(turn[1, 0], turn[0, 0])))
        values = (("type", "hueRotate"), ("values", f"{degrees:.9g}"), srgb)
        return [Primitive("feColorMatrix", values)]
    amount = number(arguments[0].serialize()) if arguments else 1.0
    if amount is None or amount < 0 or len(arguments) > 1:
        return None
    if name in _TRANSFERS:
        slope, intercept = _TRANSFERS[name](amount)
        values = (
            ("type", "linear"),
            ("slope", f"{slope:.9g}"),
            ("intercept", f"{intercept:.9g}"),
        )
        parts = tuple(Primitive(f"feFunc{letter}", values) for letter in "RGB")
        return [Primitive("feComponentTransfer", (srgb,), parts)]
    if name == "opacity":
        values = (("type", "linear"), ("slope", f"{min(amount, 1.0):.9g}"), ("intercept", "0"))
        parts = (Primitive("feFuncA", values),)
        return [Primitive("feComponentTransfer", (srgb,), parts)]
    if name in ("saturate", "grayscale"):
        share = amount if name == "saturate" else 1 - min(amount, 1.0)
        values = (("type", "saturate"), ("values", f"{share:.9g}"), srgb)
        return [Primitive("feColorMatrix", values)]
    if name == "sepia":
        sepia = np.array([[0.393, 0.769, 0.189], [0.349, 0.686, 0.168], [0.272, 0.534, 0.131]])
        share = min(amount, 1.0)
        matrix = (1 - share) * np.eye(3) + share * sepia
        rows = [*(f"{v:.6g}" for row in matrix for v in (*row, 0.0, 0.0)), "0 0 0 1 0"]
        return [Primitive("feColorMatrix", (("type", "matrix"), ("values", " ".join(rows)), srgb))]
    return None


def _shadow(arguments: Sequence[Any], layer: Layer) -> list[Primitive] | None:
    """``drop-shadow()``: two or three lengths, and a colour before or after them."""
    lengths, colours = [], []
    for token in arguments:
        length = layer.frame.viewport.length(token.serialize(), 0.0)
        if length is not None:
            lengths.append(length)
        else:
            colours.append(token.serialize())
    if not 2 <= len(lengths) <= 3 or len(colours) > 1:
        return None
    value = parse_paint(colours[0]) if colours else None
    colour = colour_of(layer.frame.properties, "color")
    if colours:
        if value is None:
            return None
        if isinstance(value.colour, Colour):
            colour = value.colour
    dx, dy, blur = [*lengths, 0.0][:3]
    return [
        Primitive(
            "feDropShadow",
            (
                ("dx", f"{dx:.9g}"),
                ("dy", f"{dy:.9g}"),
                ("stdDeviation", f"{blur:.9g}"),
                ("flood-color", _colour_text(colour)),
                ("flood-opacity", f"{colour.alpha:.6g}"),
                ("color-interpolation-filters", "sRGB"),
            ),
        )
    ]
