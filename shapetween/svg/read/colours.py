"""Paint values as text to values: colours, ``none``, references with a fallback.

.. [Col4] *CSS Color Module Level 4*.
"""

from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
import tinycss2
import tinycss2.color4

from shapetween.model.paint import Colour
from shapetween.model.srgb import linear_to_srgb, srgb_to_linear

__all__ = ["CURRENT", "PaintValue", "parse_paint", "plain_colour"]

CURRENT = "currentcolor"

#: The context's own paint, which only markers have and this reader does not draw.
_CONTEXT = frozenset({"context-fill", "context-stroke"})

#: Linear sRGB from XYZ under D65, from XYZ under D50 after Bradford adaptation, and from linear
#: Display P3 ([Col4]_, section 18).
_TO_LINEAR_SRGB = {
    "xyz-d65": np.array(
        [
            [3.2409699419045226, -1.537383177570094, -0.4986107602930034],
            [-0.9692436362808796, 1.8759675015077202, 0.04155505740717559],
            [0.05563007969699366, -0.20397695888897652, 1.0569715142428786],
        ]
    ),
    "xyz-d50": np.array(
        [
            [3.1341359569958707, -1.6173863321612538, -0.4906619460083532],
            [-0.978795502912089, 1.9162543773958770, 0.03344273116131949],
            [0.07195537988411677, -0.2289768264158322, 1.405386058324125],
        ]
    ),
    "display-p3": np.array(
        [
            [1.2249401762805598, -0.22494017628055996, 0.0],
            [-0.04205695470968816, 1.0420569547096881, 0.0],
            [-0.019637554590334432, -0.07863604555063188, 1.0982736001409663],
        ]
    ),
}
_BY_WAY_OF = {
    "lab": "xyz-d50",
    "lch": "xyz-d50",
    "oklab": "xyz-d65",
    "oklch": "xyz-d65",
    "xyz": "xyz-d65",
    "xyz-d50": "xyz-d50",
    "xyz-d65": "xyz-d65",
}


@dataclass(frozen=True, slots=True)
class PaintValue:
    """A ``fill`` or ``stroke``, as written.

    Attributes
    ----------
    colour : Colour or "currentcolor" or None
        None for ``none``. With a reference, what is painted if it leads nowhere.
    reference : str
        Id of a gradient or pattern, else empty.
    """

    colour: Colour | str | None
    reference: str = ""


@lru_cache(maxsize=1024)
def parse_paint(text: str) -> PaintValue | None:
    """Parse a paint or a colour; None if it is neither.

    What follows a colour, as in ``#fff icc-color(...)``, is passed over.
    """
    tokens = [
        token
        for token in tinycss2.parse_component_value_list(text, skip_comments=True)
        if token.type != "whitespace"
    ]
    if not tokens:
        return None
    reference = reference_of(tokens[0])
    if reference is not None:
        fallback = _colour(tokens[1]) if len(tokens) > 1 else None
        return PaintValue(None if fallback == "invalid" else fallback, reference)
    colour = _colour(tokens[0])
    return None if colour == "invalid" else PaintValue(colour)


def reference_of(token: Any) -> str | None:
    """The id in a ``url(#id)`` token, empty if it points outside; None for other tokens."""
    if token.type == "url":
        address = token.value
    elif token.type == "function" and token.lower_name == "url":
        address = "".join(part.value for part in token.arguments if part.type == "string")
    else:
        return None
    address = address.strip()
    return address[1:] if address.startswith("#") else ""


def _colour(token: Any) -> Colour | str | None:
    """A colour, ``currentcolor``, None for ``none``, or ``invalid``."""
    if token.type == "ident" and token.lower_value in {"none", *_CONTEXT}:
        return None
    try:
        colour = tinycss2.color4.parse_color(token)
        if colour is None or colour == CURRENT:
            return colour or "invalid"
        return _srgb(colour)
    except (
        ArithmeticError,
        AttributeError,
        LookupError,
        NotImplementedError,
        TypeError,
        ValueError,
    ):
        return "invalid"  # tinycss2 trips over some malformed colour functions


def _srgb(colour: Any) -> Colour:
    """A colour of any space in sRGB, cut off where it is beyond it."""
    if colour.space == "display-p3":
        given = np.array([value or 0.0 for value in colour.coordinates])  # missing ones are 0
        components = linear_to_srgb(_TO_LINEAR_SRGB["display-p3"] @ srgb_to_linear(given))
    elif colour.space in _BY_WAY_OF:
        space = _BY_WAY_OF[colour.space]
        components = linear_to_srgb(_TO_LINEAR_SRGB[space] @ np.array(colour.to(space).coordinates))
    else:
        components = colour.to("srgb").coordinates
    red, green, blue = (min(1.0, max(0.0, float(component))) for component in components)
    return Colour(red, green, blue, colour.alpha)


def plain_colour(text: str) -> Colour | None:
    """The colour that a text names by itself, None if it is none."""
    value = parse_paint(text)
    if value is None or value.reference or not isinstance(value.colour, Colour):
        return None
    return value.colour
