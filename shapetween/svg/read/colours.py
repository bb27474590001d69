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
from shapetween.svg.read.colourspaces import TO_LINEAR_SRGB

__all__ = ["CURRENT", "PaintValue", "parse_paint", "plain_colour"]

CURRENT = "currentcolor"

#: The context's own paint, which only markers have and this reader does not draw.
_CONTEXT = frozenset({"context-fill", "context-stroke"})

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
        if token.type == "function":
            from shapetween.svg.read.colourfunctions import calculated_arguments

            made = _made(token)
            if made is not None:
                return made
            token = calculated_arguments(token)
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


def _made(token: Any) -> Colour | None:
    """A function that makes a colour from colours; None if it is another, or malformed."""
    from shapetween.svg.read.colourfunctions import mixed, relative

    if token.lower_name == "color-mix":
        return mixed(token.arguments, _plain)
    first = next((t for t in token.arguments if t.type not in ("whitespace", "comment")), None)
    if first is not None and first.type == "ident" and first.lower_value == "from":
        return relative(token.lower_name, token.arguments, _plain)
    return None


def _plain(token: Any) -> Colour | None:
    """A colour within another; None if it is malformed, or depends on where it is used."""
    colour = _colour(token)
    return colour if isinstance(colour, Colour) else None


def _srgb(colour: Any) -> Colour:
    """A colour of any space in sRGB, cut off where it is beyond it."""
    if colour.space == "display-p3":
        given = np.array([value or 0.0 for value in colour.coordinates])  # missing ones are 0
        components = linear_to_srgb(TO_LINEAR_SRGB["display-p3"] @ srgb_to_linear(given))
    elif colour.space in _BY_WAY_OF:
        space = _BY_WAY_OF[colour.space]
        components = linear_to_srgb(TO_LINEAR_SRGB[space] @ np.array(colour.to(space).coordinates))
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
