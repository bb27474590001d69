"""Affine maps of the plane, (2, 3): [[a, c, e], [b, d, f]].

Points are mapped number by number, never by a matrix product: equal points stay equal to the last
bit wherever they stand, so that curves that met still meet, and processors round alike.
"""

from math import sqrt

import numpy as np

from shapetween.base.arrays import Affine, Points

__all__ = ["IDENTITY", "affine", "compose", "inverted", "mapped", "mean_scale", "stretch"]


def affine(a: float, b: float, c: float, d: float, e: float, f: float) -> Affine:
    """The map with the six numbers in the order in which SVG's ``matrix()`` has them."""
    return np.array([[a, c, e], [b, d, f]], dtype=np.float64)


IDENTITY = affine(1, 0, 0, 1, 0, 0)


def mapped(points: Points, matrix: Affine) -> Points:
    """Points (..., 2) under an affine map (2, 3)."""
    return np.asarray(
        points[..., :1] * matrix[:, 0] + points[..., 1:] * matrix[:, 1] + matrix[:, 2]
    )


def compose(outer: Affine, inner: Affine) -> Affine:
    """The map that does `inner` first, then `outer`."""
    product = outer[:, :1] * inner[:1] + outer[:, 1:2] * inner[1:]
    product[:, 2] += outer[:, 2]
    return np.asarray(product)


def inverted(matrix: Affine) -> Affine:
    """The affine map back.

    Raises
    ------
    numpy.linalg.LinAlgError
        If the map takes the plane to a line or a point.
    """
    linear = np.linalg.inv(matrix[:, :2])
    return np.column_stack([linear, -linear @ matrix[:, 2]])


def mean_scale(matrix: Affine) -> float:
    """Square root of the factor by which areas grow."""
    (a, c, _), (b, d, _) = matrix.tolist()
    return sqrt(abs(a * d - b * c))


def stretch(matrix: Affine) -> float:
    """Greatest over least factor by which lengths grow: 1 for a similarity."""
    greatest, least = np.linalg.svd(matrix[:, :2], compute_uv=False)
    return float(greatest / least) if least > 0 else float("inf")
