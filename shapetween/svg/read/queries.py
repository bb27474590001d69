"""Whether the conditions of style sheets are met: ``@media`` and ``@supports``.

A drawing is made for a screen as large as its view box, in light colours, with a mouse.

.. [MQ4] *Media Queries Level 4*. .. [CC3] *CSS Conditional Rules Module Level 3*.
"""

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

import tinycss2

from shapetween.svg.read.units import Viewport

__all__ = ["Medium", "media_met", "supports_met"]

Leaf: TypeAlias = Callable[[Any], bool]

#: What a reader without special needs at a screen answers.
KEYWORDS = {
    "prefers-color-scheme": "light",
    "prefers-reduced-motion": "no-preference",
    "prefers-reduced-transparency": "no-preference",
    "prefers-reduced-data": "no-preference",
    "prefers-contrast": "no-preference",
    "forced-colors": "none",
    "inverted-colors": "none",
    "hover": "hover",
    "any-hover": "hover",
    "pointer": "fine",
    "any-pointer": "fine",
    "update": "fast",
    "scripting": "none",
    "display-mode": "browser",
    "color-gamut": "srgb",
    "dynamic-range": "standard",
    "overflow-block": "scroll",
    "overflow-inline": "scroll",
    "grid": "0",
    "color": "8",
    "monochrome": "0",
}
#: Those of them that ask for nothing, and so are not met without a value.
NOTHING = frozenset({"no-preference", "none", "0"})

_PLAIN = re.compile(r"([a-z-]+)(?:\s*:\s*(.+))?", re.DOTALL)
_RANGE = re.compile(r"(?:([^<>=]+)(<=?|>=?|=))?\s*([a-z-]+)\s*(?:(<=?|>=?|=)([^<>=]+))?", re.DOTALL)
_COMPARE: dict[str, Callable[[float, float], bool]] = {
    "<": lambda a, b: a < b,
    "<=": lambda a, b: a <= b,
    ">": lambda a, b: a > b,
    ">=": lambda a, b: a >= b,
    "=": lambda a, b: a == b,
}


@dataclass(frozen=True, slots=True)
class Medium:
    """What a drawing is shown on: its size in px."""

    width: float
    height: float


def media_met(prelude: str, medium: Medium) -> bool:
    """Whether a media query list is met; an empty one is ([MQ4]_, section 3)."""
    tokens = tinycss2.parse_component_value_list(prelude, skip_comments=True)
    queries = _split(tokens)
    if not any(queries):
        return True
    return any(_query_met(query, medium) for query in queries)


def _query_met(tokens: list[Any], medium: Medium) -> bool:
    words = [token.lower_value if token.type == "ident" else "" for token in tokens]
    negated = False
    if words[:1] in (["not"], ["only"]) and len(words) > 1 and words[1]:
        negated = words[0] == "not"
        tokens, words = tokens[1:], words[1:]
    if not words or not words[0] or words[0] == "not":
        return _condition(tokens, lambda token: _feature(token, medium))
    met = words[0] in ("all", "screen")
    if len(tokens) > 1:
        met = (
            met
            and words[1] == "and"
            and _condition(tokens[2:], lambda token: _feature(token, medium))
        )
    return met != negated


def supports_met(prelude: Sequence[Any], declared: Callable[[str, str], bool]) -> bool:
    """Whether a ``@supports`` condition is met ([CC3]_, section 6).

    Parameters
    ----------
    prelude : sequence of tokens
    declared : callable
        Whether a value of a property is understood.
    """

    def leaf(token: Any) -> bool:
        if token.type == "function":
            return bool(token.lower_name == "selector")
        name, colon, value = tinycss2.serialize(token.content).partition(":")
        return bool(colon) and declared(name.strip().lower(), value.strip())

    return _condition([t for t in prelude if t.type not in ("whitespace", "comment")], leaf)


def _split(tokens: Sequence[Any]) -> list[list[Any]]:
    """Tokens between commas, without white space."""
    parts: list[list[Any]] = [[]]
    for token in tokens:
        if token.type == "literal" and token.value == ",":
            parts.append([])
        elif token.type not in ("whitespace", "comment"):
            parts[-1].append(token)
    return parts


def _condition(tokens: list[Any], leaf: Leaf) -> bool:
    """``not X``, ``X and Y ...``, ``X or Y ...``; anything else is not met."""
    if not tokens:
        return False
    first = tokens[0]
    if first.type == "ident" and first.lower_value == "not":
        return len(tokens) == 2 and not _operand(tokens[1], leaf)
    if len(tokens) % 2 == 0:
        return False
    words = {token.lower_value if token.type == "ident" else "" for token in tokens[1::2]}
    values = [_operand(token, leaf) for token in tokens[::2]]
    if not words:
        return values[0]
    if words == {"and"}:
        return all(values)
    return words == {"or"} and any(values)


def _operand(token: Any, leaf: Leaf) -> bool:
    if token.type == "() block":
        inner = [t for t in token.content if t.type not in ("whitespace", "comment")]
        nested = inner and (
            inner[0].type in ("() block", "function")
            or (inner[0].type == "ident" and inner[0].lower_value == "not")
        )
        return _condition(inner, leaf) if nested else leaf(token)
    return token.type == "function" and leaf(token)


def _feature(token: Any, medium: Medium) -> bool:
    """Whether a media feature in brackets is met; one that is not known is not."""
    if token.type != "() block":
        return False
    text = tinycss2.serialize(token.content).strip().lower()
    plain = _PLAIN.fullmatch(text)
    if plain:
        name, value = plain[1], plain[2]
        if value is None:
            known = KEYWORDS.get(name)
            return _size(name, medium) is not None if known is None else known not in NOTHING
        for prefix, operator in (("min-", ">="), ("max-", "<=")):
            if name.startswith(prefix):
                return _compared(name.removeprefix(prefix), operator, value, medium)
        if name == "orientation":
            return value.strip() == ("portrait" if medium.height >= medium.width else "landscape")
        if name in KEYWORDS:
            return value.strip() == KEYWORDS[name]
        return _compared(name, "=", value, medium)
    found = _RANGE.fullmatch(text)
    if found is None:
        return False
    low, before, name, after, high = found.groups()
    turned = {"<": ">", "<=": ">=", ">": "<", ">=": "<=", "=": "="}
    met = low is None or _compared(name, turned[before], low, medium)
    return met and (high is None or _compared(name, after, high, medium))


def _size(name: str, medium: Medium) -> float | None:
    return {
        "width": medium.width,
        "height": medium.height,
        "device-width": medium.width,
        "device-height": medium.height,
        "aspect-ratio": medium.width / medium.height if medium.height else None,
        "device-aspect-ratio": medium.width / medium.height if medium.height else None,
        "resolution": 1.0,
        "color": 8.0,
        "monochrome": 0.0,
    }.get(name)


def _compared(name: str, operator: str, value: str, medium: Medium) -> bool:
    size = _size(name, medium)
    wanted: float | None
    value = value.strip()
    if name == "resolution":
        found = re.fullmatch(r"([\d.]+)(dppx|x|dpi|dpcm)", value)
        units = {"dppx": 1.0, "x": 1.0, "dpi": 1 / 96, "dpcm": 2.54 / 96}
        wanted = float(found[1]) * units[found[2]] if found else None
    elif "ratio" in name:
        top, _, bottom = value.partition("/")
        try:
            wanted = float(top) / float(bottom or 1)
        except (ValueError, ZeroDivisionError):
            wanted = None
    else:
        wanted = Viewport(medium.width, medium.height).length(value, 0.0)
    return size is not None and wanted is not None and _COMPARE[operator](size, wanted)
