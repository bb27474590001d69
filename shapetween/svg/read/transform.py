"""Transform lists, and the affine maps that they name."""

import re
from collections.abc import Callable
from functools import lru_cache
from math import cos, isfinite, radians, sin, tan

import numpy as np

from shapetween.base.arrays import Affine
from shapetween.geometry.affine import IDENTITY, affine, compose

__all__ = ["NUMBER", "parse_transform"]

#: A number as SVG and CSS write it. Atomic: what follows never makes it end earlier.
NUMBER = r"(?>[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)"

#: Functions of one list that are read; more were not written by anybody.
MOST_FUNCTIONS = 1000

# Possessive, and matched from where the last one ended: white space is run through once.
_FUNCTION = re.compile(r"\s*+(?:,\s*+)?+([A-Za-z]++)\s*+\(([^()]*+)\)", re.ASCII)
_ARGUMENT = re.compile(rf"\s*+(?:,\s*+)?+({NUMBER})", re.ASCII)


def _rotate(degrees: float, x: float = 0.0, y: float = 0.0) -> Affine:
    c, s = cos(radians(degrees)), sin(radians(degrees))
    return affine(c, s, -s, c, x - c * x + s * y, y - s * x - c * y)


#: Name -> least and greatest number of arguments, and the map they make.
_FUNCTIONS: dict[str, tuple[int, int, Callable[..., Affine]]] = {
    "matrix": (6, 6, affine),
    "translate": (1, 2, lambda x, y=0.0: affine(1, 0, 0, 1, x, y)),
    "scale": (1, 2, lambda x, y=None: affine(x, 0, 0, x if y is None else y, 0, 0)),
    "rotate": (1, 3, _rotate),
    "skewX": (1, 1, lambda x: affine(1, 0, tan(radians(x)), 1, 0, 0)),
    "skewY": (1, 1, lambda y: affine(1, tan(radians(y)), 0, 1, 0, 0)),
}


@lru_cache(maxsize=1024)
def parse_transform(text: str) -> Affine | None:
    """Parse a transform list as an attribute has it: in user units and degrees, without units.

    Returns
    -------
    (2, 3) float64 or None
        None if the list is malformed, for which browsers take no transform at all.
    """
    if text.strip() in ("", "none"):
        return IDENTITY
    matrix = IDENTITY
    count = position = 0
    while (found := _FUNCTION.match(text, position)) is not None:
        if count == MOST_FUNCTIONS:
            return None
        count, position = count + 1, found.end()
        step = _function(found[1], found[2])
        if step is None:
            return None
        with np.errstate(all="ignore"):
            matrix = compose(matrix, step)
    if text[position:].strip() or not np.isfinite(matrix).all():
        return None
    return matrix


def _function(name: str, text: str) -> Affine | None:
    if name not in _FUNCTIONS:
        return None
    least, most, build = _FUNCTIONS[name]
    values = []
    position = 0
    while (found := _ARGUMENT.match(text, position)) is not None:
        position = found.end()
        values.append(float(found[1]))
    if not all(map(isfinite, values)):
        return None
    if text[position:].strip() or not least <= len(values) <= most:
        return None
    if name == "rotate" and len(values) == 2:
        return None
    return build(*values)
