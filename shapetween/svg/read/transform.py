"""Affine maps, and the transform lists that name them.

A map is (2, 3), [[a, c, e], [b, d, f]]. Points are mapped number by number, never by a matrix
product, so that equal points stay equal to the last bit: curves that met still meet.
"""

import re
from collections.abc import Callable
from functools import lru_cache
from math import cos, isfinite, radians, sin, sqrt, tan

import numpy as np

from shapetween.base.arrays import Affine, Points

__all__ = ["IDENTITY", "affine", "apply", "compose", "mean_scale", "parse_transform", "stretch"]

#: A number as SVG and CSS write it. Atomic: what follows never makes it end earlier.
NUMBER = r"(?>[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)"

#: Functions of one list that are read; more were not written by anybody.
MOST_FUNCTIONS = 1000

_FUNCTION = re.compile(r"\s*,?\s*([A-Za-z]+)\s*\(([^()]*)\)", re.ASCII)
_ARGUMENT = re.compile(rf"\s*,?\s*({NUMBER})\s*", re.ASCII)


def affine(a: float, b: float, c: float, d: float, e: float, f: float) -> Affine:
    """The map with the six numbers in the order in which SVG's ``matrix()`` has them."""
    return np.array([[a, c, e], [b, d, f]], dtype=np.float64)


IDENTITY = affine(1, 0, 0, 1, 0, 0)


def compose(outer: Affine, inner: Affine) -> Affine:
    """The map that does `inner` first, then `outer`."""
    # Term by term: a matrix product may round otherwise on another processor.
    product = outer[:, :1] * inner[:1] + outer[:, 1:2] * inner[1:]
    product[:, 2] += outer[:, 2]
    return np.asarray(product)


def apply(matrix: Affine, points: Points) -> Points:
    """Map points (..., 2)."""
    x, y = points[..., 0], points[..., 1]
    (a, c, e), (b, d, f) = matrix.tolist()
    return np.stack([a * x + c * y + e, b * x + d * y + f], axis=-1)


def mean_scale(matrix: Affine) -> float:
    """Square root of the factor by which areas grow."""
    (a, c, _), (b, d, _) = matrix.tolist()
    return sqrt(abs(a * d - b * c))


def stretch(matrix: Affine) -> float:
    """Greatest over least factor by which lengths grow: 1 for a similarity."""
    greatest, least = np.linalg.svd(matrix[:, :2], compute_uv=False)
    return float(greatest / least) if least > 0 else float("inf")


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
    position = 0
    for count, found in enumerate(_FUNCTION.finditer(text)):
        if found.start() != position or count == MOST_FUNCTIONS:
            return None
        position = found.end()
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
    for found in _ARGUMENT.finditer(text):
        if found.start() != position:
            return None
        position = found.end()
        values.append(float(found[1]))
    if not all(map(isfinite, values)):
        return None
    if text[position:].strip() or not least <= len(values) <= most:
        return None
    if name == "rotate" and len(values) == 2:
        return None
    return build(*values)
