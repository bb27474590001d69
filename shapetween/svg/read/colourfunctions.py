"""Colours made from colours: ``color-mix()`` and relative colours.

.. [Col4] *CSS Color Module Level 4*. .. [Col5] *CSS Color Module Level 5*, sections 3 and 4.
"""

import math
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import tinycss2

from shapetween.model.paint import Colour
from shapetween.svg.read.calc import calculated
from shapetween.svg.read.colourspaces import HUES, SPACES, from_space, in_space

__all__ = ["calculated_arguments", "mixed", "relative"]

#: The components of colour functions by name, and what each counts for where it stands alone.
CHANNELS: dict[str, tuple[str, str, float]] = {
    "rgb": ("srgb", "rgb", 255.0),
    "rgba": ("srgb", "rgb", 255.0),
    "hsl": ("hsl", "hsl", 1.0),
    "hsla": ("hsl", "hsl", 1.0),
    "hwb": ("hwb", "hwb", 1.0),
    "lab": ("lab", "lab", 1.0),
    "lch": ("lch", "lch", 1.0),
    "oklab": ("oklab", "lab", 1.0),
    "oklch": ("oklch", "lch", 1.0),
}
#: What 100% is of each component.
WHOLE: dict[str, tuple[float, float, float]] = {
    "rgb": (255.0, 255.0, 255.0),
    "rgba": (255.0, 255.0, 255.0),
    "hsl": (360.0, 100.0, 100.0),
    "hsla": (360.0, 100.0, 100.0),
    "hwb": (360.0, 100.0, 100.0),
    "lab": (100.0, 125.0, 125.0),
    "lch": (100.0, 150.0, 360.0),
    "oklab": (1.0, 0.4, 0.4),
    "oklch": (1.0, 0.4, 360.0),
}
_ANGLES = {"": 1.0, "deg": 1.0, "grad": 0.9, "turn": 360.0, "rad": 180 / math.pi}

Parse = Callable[[Any], Colour | None]


def mixed(arguments: Sequence[Any], parse: Parse) -> Colour | None:
    """A ``color-mix()``; None if it is malformed ([Col5]_, section 3).

    Parameters
    ----------
    arguments : sequence of tokens
    parse : callable
        What a token is as a colour.
    """
    parts = _split(arguments)
    space, longer = "oklab", "shorter"
    if parts and parts[0] and _word(parts[0][0]) == "in":
        words = [_word(token) for token in parts.pop(0)[1:]]
        space = words[0] if words else ""
        if len(words) == 3 and words[2] == "hue":
            longer = words[1]
    if space not in SPACES or len(parts) != 2:
        return None
    colours, shares = [], []
    for part in parts:
        share = [token for token in part if token.type == "percentage"]
        rest = [token for token in part if token.type != "percentage"]
        colour = parse(rest[0]) if len(rest) == 1 and len(share) <= 1 else None
        if colour is None or (share and not 0 <= share[0].value <= 100):
            return None
        colours.append(colour)
        shares.append(share[0].value / 100 if share else None)
    first, second = shares
    if first is None and second is None:
        first = second = 0.5
    elif first is None and second is not None:
        first = 1 - second
    elif second is None and first is not None:
        second = 1 - first
    assert first is not None
    assert second is not None
    total = first + second
    if total == 0:
        return None
    return _between(colours[0], colours[1], second / total, space, longer, min(1.0, total))


def _between(a: Colour, b: Colour, share: float, space: str, longer: str, kept: float) -> Colour:
    """The colour at a share of the way from one to another in a space."""
    one, two = (in_space(space, np.array([c.red, c.green, c.blue])) for c in (a, b))
    one, two = np.where(np.isnan(one), two, one), np.where(np.isnan(two), one, two)
    alpha = (1 - share) * a.alpha + share * b.alpha
    weights = np.array([(1 - share) * a.alpha, share * b.alpha])
    weights = weights / weights.sum() if weights.sum() > 0 else np.array([1 - share, share])
    mix = weights[0] * one + weights[1] * two
    if space in HUES:
        at = HUES[space]
        start = one[at] % 360
        mix[at] = start + share * _turn(two[at] % 360 - start, longer)
    return _colour(from_space(space, mix), alpha * kept)


def _turn(turn: float, way: str) -> float:
    """How far a hue runs where the other one is so many degrees on ([Col4]_, section 12.4)."""
    if way == "increasing":
        return turn + 360 if turn < 0 else turn
    if way == "decreasing":
        return turn - 360 if turn > 0 else turn
    if way == "longer":
        return turn - 360 if 0 < turn < 180 else turn + 360 if -180 < turn <= 0 else turn
    return turn - 360 if turn > 180 else turn + 360 if turn < -180 else turn


def relative(name: str, arguments: Sequence[Any], parse: Parse) -> Colour | None:
    """A colour function with ``from``; None if it is malformed ([Col5]_, section 4)."""
    tokens = [t for t in arguments if t.type not in ("whitespace", "comment")]
    origin = parse(tokens[1]) if len(tokens) > 1 else None
    if origin is None:
        return None
    tokens = tokens[2:]
    if name == "color":
        space = _word(tokens[0]) if tokens else ""
        letters, scale, whole = ("xyz" if "xyz" in space else "rgb"), 1.0, (1.0, 1.0, 1.0)
        tokens = tokens[1:]
    elif name in CHANNELS:
        space, letters, scale = CHANNELS[name]
        whole = WHOLE[name]
    else:
        return None
    if space not in SPACES or len(tokens) not in (3, 5):
        return None
    own = np.nan_to_num(in_space(space, np.array([origin.red, origin.green, origin.blue])))
    values = [float(v) for v in own * (scale if space == "srgb" else 1.0)]
    names = {**dict(zip(letters, values, strict=True)), "alpha": origin.alpha}

    given = []
    for token, all_of_it in zip(tokens[:3], whole, strict=True):
        value = _component(token, all_of_it, names)
        if value is None:
            return None
        given.append(value)
    alpha: float | None = origin.alpha
    if len(tokens) == 5:
        alpha = _component(tokens[4], 1.0, names) if tokens[3] == "/" else None
    if alpha is None:
        return None
    components = np.array(given) / (scale if space == "srgb" else 1.0)
    return _colour(from_space(space, components), alpha)


def _component(token: Any, whole: float, names: dict[str, float]) -> float | None:
    def unit(value: float, name: str) -> float | None:
        if name == "%":
            return value / 100 * whole
        return value * _ANGLES[name] if name in _ANGLES else None

    if _word(token) == "none":
        return 0.0
    return calculated(token.serialize(), unit, names)


def calculated_arguments(token: Any) -> Any:
    """A colour function's token with its calculations done, as colour parsers need it."""
    if not any(part.type == "function" for part in token.arguments):
        return token
    whole = WHOLE.get(token.lower_name, (1.0, 1.0, 1.0))
    texts, place = [], 0
    for part in token.arguments:
        if part.type == "function":
            value = _component(part, whole[min(place, 2)] if place < 3 else 1.0, {})
            texts.append(part.serialize() if value is None else f"{value:.12g}")
        else:
            texts.append(part.serialize())
        if part.type not in ("whitespace", "comment") and part not in (",", "/"):
            place += 1
    return tinycss2.parse_one_component_value(f"{token.name}({''.join(texts)})")


def _colour(srgb: Any, alpha: float) -> Colour:
    red, green, blue = np.clip(np.nan_to_num(srgb), 0.0, 1.0).tolist()
    return Colour(red, green, blue, min(1.0, max(0.0, alpha)))


def _split(tokens: Sequence[Any]) -> list[list[Any]]:
    parts: list[list[Any]] = [[]]
    for token in tokens:
        if token.type == "literal" and token.value == ",":
            parts.append([])
        elif token.type not in ("whitespace", "comment"):
            parts[-1].append(token)
    return parts


def _word(token: Any) -> str:
    return str(token.lower_value) if token.type == "ident" else ""
