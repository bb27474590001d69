"""Arithmetic in style: ``calc()`` and its kin to numbers.

.. [CSS] *CSS Values and Units Module Level 4*, section 10.
"""

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import tinycss2

__all__ = ["calculated"]

#: Functions within functions that are followed; more were not written by anybody.
DEEPEST = 32

#: The value of a number with a unit, which is "" or "%" or a name; None if it has none.
Unit = Callable[[float, str], float | None]

_CONSTANTS = {"pi": math.pi, "e": math.e, "infinity": math.inf, "-infinity": -math.inf}
_FUNCTIONS: dict[str, tuple[int, int, Callable[..., float]]] = {
    "calc": (1, 1, lambda a: a),
    "min": (1, 1000, lambda *values: min(values)),
    "max": (1, 1000, lambda *values: max(values)),
    "clamp": (3, 3, lambda least, value, most: max(least, min(value, most))),
    "abs": (1, 1, abs),
    "sign": (1, 1, lambda a: math.copysign(1.0, a) if a else 0.0),
    "sqrt": (1, 1, math.sqrt),
    "pow": (2, 2, math.pow),
    "hypot": (1, 1000, math.hypot),
    "mod": (2, 2, lambda a, b: a - b * math.floor(a / b)),
    "rem": (2, 2, math.fmod),
    "sin": (1, 1, lambda a: math.sin(a)),
    "cos": (1, 1, lambda a: math.cos(a)),
    "tan": (1, 1, lambda a: math.tan(a)),
}


class _Malformed(Exception):
    """Raised where the text is no arithmetic."""


def calculated(text: str, unit: Unit, names: Mapping[str, float] | None = None) -> float | None:
    """The value of a mathematical function; None if it is malformed or not finite.

    Parameters
    ----------
    text : str
        A single function, number or name.
    unit : callable
    names : Mapping, optional
        Values of further names, in lower case.

    Examples
    --------
    >>> calculated("calc(50% - 2 * 3px)", lambda value, unit: value)
    44.0
    """
    known = {**_CONSTANTS, **(names or {})}
    tokens = _content(tinycss2.parse_component_value_list(text, skip_comments=True))
    if len(tokens) != 1:
        return None
    try:
        value = _atom(tokens[0], unit, known, 0)
    except (_Malformed, ArithmeticError, ValueError, RecursionError):
        return None
    return value if math.isfinite(value) else None


def _content(tokens: Sequence[Any]) -> list[Any]:
    return [token for token in tokens if token.type not in ("whitespace", "comment")]


def _sum(tokens: list[Any], unit: Unit, names: Mapping[str, float], depth: int) -> float:
    total, sign = 0.0, 1.0
    product: list[Any] = []
    for token in tokens:
        if token.type == "literal" and token.value in "+-" and product:
            total += sign * _product(product, unit, names, depth)
            sign, product = (1.0 if token.value == "+" else -1.0), []
        elif token.type in ("number", "dimension", "percentage") and product and _signed(token):
            # "2 +3" is no sum in CSS, but nothing else can be meant.
            total += sign * _product(product, unit, names, depth)
            sign, product = 1.0, [token]
        else:
            product.append(token)
    return total + sign * _product(product, unit, names, depth)


def _signed(token: Any) -> bool:
    return bool(token.representation[:1] in ("+", "-"))


def _product(tokens: list[Any], unit: Unit, names: Mapping[str, float], depth: int) -> float:
    if len(tokens) % 2 == 0:
        raise _Malformed
    value = _atom(tokens[0], unit, names, depth)
    for operator, token in zip(tokens[1::2], tokens[2::2], strict=True):
        operand = _atom(token, unit, names, depth)
        if operator.type != "literal" or operator.value not in "*/":
            raise _Malformed
        value = value * operand if operator.value == "*" else value / operand
    return value


def _atom(token: Any, unit: Unit, names: Mapping[str, float], depth: int) -> float:
    if depth > DEEPEST:
        raise _Malformed
    kind = token.type
    if kind in ("number", "dimension", "percentage"):
        name = "%" if kind == "percentage" else str(getattr(token, "lower_unit", ""))
        value = unit(float(token.value), name)
        if value is None:
            raise _Malformed
        return value
    if kind == "ident" and token.lower_value in names:
        return names[token.lower_value]
    if kind == "() block":
        return _sum(_content(token.content), unit, names, depth + 1)
    if kind == "function" and token.lower_name in _FUNCTIONS:
        least, most, compute = _FUNCTIONS[token.lower_name]
        parts: list[list[Any]] = [[]]
        for part in _content(token.arguments):
            if part.type == "literal" and part.value == ",":
                parts.append([])
            else:
                parts[-1].append(part)
        if not least <= len(parts) <= most:
            raise _Malformed
        return float(compute(*(_sum(part, unit, names, depth + 1) for part in parts)))
    raise _Malformed
