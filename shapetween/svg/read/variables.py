"""Custom properties put in where values name them, and colours of the scheme in use.

.. [VAR] *CSS Custom Properties for Cascading Variables Module Level 1*.
"""

from collections.abc import Mapping, Sequence
from typing import Any

import tinycss2

__all__ = ["with_scheme", "with_variables"]

#: References between custom properties followed from one value; more is taken for a circle.
MOST_REFERENCES = 16

#: Characters that a value may grow to: what somebody drew has a few dozen.
MOST_CHARACTERS = 10_000

_BRACKETS = {"() block": "()", "[] block": "[]", "{} block": "{}"}


class _Missing(Exception):
    """Raised where a custom property has neither value nor fallback, or never ends."""


def with_variables(value: str, properties: Mapping[str, str]) -> str | None:
    """The value with every ``var()`` replaced, wherever in it; None if it is then invalid.

    Examples
    --------
    >>> with_variables("hsl(var(--h) 80% 50%)", {"--h": "200"})
    'hsl(200 80% 50%)'
    """
    try:
        return _replaced(
            tinycss2.parse_component_value_list(value, skip_comments=True), properties, 0
        ).strip()
    except (_Missing, RecursionError):
        return None


def is_of_the_page(value: str, properties: Mapping[str, str]) -> bool:
    """Whether a value is one ``var()`` that only the page can say, and has a fallback."""
    tokens = [
        token
        for token in tinycss2.parse_component_value_list(value, skip_comments=True)
        if token.type != "whitespace"
    ]
    if len(tokens) != 1 or tokens[0].type != "function" or tokens[0].lower_name != "var":
        return False
    inside = tinycss2.serialize(tokens[0].arguments)
    name, comma, fallback = inside.partition(",")
    return bool(comma) and name.strip() not in properties and "var(" not in fallback.lower()


def _replaced(tokens: Sequence[Any], properties: Mapping[str, str], depth: int) -> str:
    if depth > MOST_REFERENCES:
        raise _Missing
    texts: list[str] = []
    length = 0
    for token in tokens:
        if token.type == "function" and token.lower_name == "var":
            text = _value(token.arguments, properties, depth)
        elif token.type == "function":
            text = f"{token.name}({_replaced(token.arguments, properties, depth + 1)})"
        elif token.type in _BRACKETS:
            brackets = _BRACKETS[token.type]
            inner = _replaced(token.content, properties, depth + 1)
            text = f"{brackets[0]}{inner}{brackets[1]}"
        else:
            text = token.serialize()
        # Two numbers may not become one.
        if texts and texts[-1][-1:].isalnum() and text[:1].isalnum():
            text = f" {text}"
        texts.append(text)
        length += len(text)
        if length > MOST_CHARACTERS:
            raise _Missing
    return "".join(texts)


def _value(arguments: Sequence[Any], properties: Mapping[str, str], depth: int) -> str:
    """What one ``var()`` stands for."""
    comma = next(
        (k for k, t in enumerate(arguments) if t.type == "literal" and t.value == ","), None
    )
    name = tinycss2.serialize(arguments[:comma]).strip()
    text = properties.get(name)
    if text is not None and len(text) <= MOST_CHARACTERS:
        if "var(" not in text.lower():
            return text
        tokens = tinycss2.parse_component_value_list(text, skip_comments=True)
        return _replaced(tokens, properties, depth + 1)
    if comma is None:
        raise _Missing
    return _replaced(arguments[comma + 1 :], properties, depth + 1)


def with_scheme(value: str, scheme: str, colour: str) -> str:
    """A paint with what depends on its place put in.

    Parameters
    ----------
    value : str
    scheme : str
        The ``color-scheme``: of ``light-dark()`` the second is taken where that is dark alone.
    colour : str
        The ``color``, for ``currentcolor`` within functions.
    """
    dark = scheme.lower().split() in (["dark"], ["only", "dark"], ["dark", "only"])
    try:
        return _chosen(
            tinycss2.parse_component_value_list(value, skip_comments=True), dark, colour, False
        )
    except RecursionError:
        return value


def _chosen(tokens: Sequence[Any], dark: bool, colour: str, inside: bool) -> str:
    texts = []
    for token in tokens:
        if token.type == "function" and token.lower_name == "light-dark":
            parts: list[list[Any]] = [[]]
            for part in token.arguments:
                if part.type == "literal" and part.value == ",":
                    parts.append([])
                else:
                    parts[-1].append(part)
            chosen = parts[min(int(dark), len(parts) - 1)] if len(parts) == 2 else []
            texts.append(_chosen(chosen, dark, colour, inside).strip())
        elif token.type == "function":
            texts.append(f"{token.name}({_chosen(token.arguments, dark, colour, True)})")
        elif inside and token.type == "ident" and token.lower_value == "currentcolor":
            texts.append(colour)
        else:
            texts.append(token.serialize())
    return "".join(texts)
