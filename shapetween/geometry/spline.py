"""Smooth curves through values at even places, as weights that serve for any values.

.. [dB01] C. de Boor, *A Practical Guide to Splines*, revised edition, 2001, chapter IV.
"""

from functools import lru_cache

import numpy as np

from shapetween.base.arrays import Floats

__all__ = ["spline_weights"]


def spline_weights(count: int, t: Floats) -> Floats:
    """Weights of values at even places in [0, 1] in the cubic spline through them.

    Parameters
    ----------
    count : int
        Number of values, at least 4.
    t : (F,) float64
        Places in [0, 1] at which the spline is asked for.

    Returns
    -------
    (F, count) float64
        Each row adds up to 1.

    Notes
    -----
    The spline has two continuous derivatives and no knot at the second and last but one place
    ("not a knot", [dB01]_), so that cubics come out exactly.

    Examples
    --------
    >>> even = np.linspace(0, 1, 6)
    >>> print(spline_weights(6, np.array([0.3])) @ even**3)
    [0.027]
    """
    place = t * (count - 1)
    first = np.clip(np.floor(place), 0, count - 2).astype(np.intp)
    right = place - first
    left = 1 - right
    rows, bends = np.arange(len(t)), _bends(count)
    weights = ((left**3 - left) / 6)[:, None] * bends[first]
    weights += ((right**3 - right) / 6)[:, None] * bends[first + 1]
    weights[rows, first] += left
    weights[rows, first + 1] += right
    return weights


@lru_cache(maxsize=8)
def _bends(count: int) -> Floats:
    """Matrix from values to the second derivatives of their spline, (count, count)."""
    own = np.arange(1, count - 1)
    matrix, right = np.zeros((count, count)), np.zeros((count, count))
    for shift, inner, value in ((-1, 1.0, 6.0), (0, 4.0, -12.0), (1, 1.0, 6.0)):
        matrix[own, own + shift], right[own, own + shift] = inner, value
    matrix[0, :3] = matrix[-1, -3:] = 1.0, -2.0, 1.0
    return np.asarray(np.linalg.solve(matrix, right), dtype=np.float64)
