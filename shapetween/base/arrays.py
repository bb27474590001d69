"""Array types and the conventions that every module keeps.

Coordinates are in user units, x to the right and y down, as SVG has them; a ring with a positive
signed area runs clockwise as drawn. Points have their two coordinates on the last axis, stacks
come first: ``(V, 2)`` vertices, ``(Q, 4, 2)`` quads, ``(F, V, 2)`` vertices in F frames. Matrices
act on column vectors. Angles are radians, positive from the x axis towards the y axis. Time runs
from 0, the source, to 1, the target. Tolerances are shares of a size, never absolute.
"""

from collections.abc import Sequence
from typing import Any, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from shapetween.base.errors import ShapeError

__all__ = [
    "Affine",
    "Complex",
    "Curves",
    "Floats",
    "Index",
    "Mask",
    "Points",
    "Quads",
    "frozen",
    "row_lengths",
    "row_sums",
    "side_by_side",
    "times",
]

Floats = NDArray[np.float64]
"""Real numbers, any shape."""
Points = NDArray[np.float64]
"""Points, (..., 2)."""
Complex = NDArray[np.complex128]
"""Points or vectors of the plane as complex numbers x + iy, any shape."""
Quads = NDArray[np.float64]
"""Corners of quads, (..., 4, 2)."""
Curves = NDArray[np.float64]
"""Control points of cubic Bezier curves, (..., 4, 2)."""
Affine = NDArray[np.float64]
"""Affine maps [[a, c, e], [b, d, f]], (2, 3)."""
Index = NDArray[np.intp]
"""Indices, any shape."""
Mask = NDArray[np.bool_]
"""Truth values, any shape."""


ItemT = TypeVar("ItemT", bound=np.generic)
NumberT = TypeVar("NumberT", np.float64, np.complex128)


def side_by_side(stacks: Sequence[Curves]) -> Curves:
    """Stacks (F, N, 4, 2) of curves as one, (F, sum of N, 4, 2); the only one is not copied."""
    return stacks[0] if len(stacks) == 1 else np.concatenate(stacks, axis=1)


def row_sums(values: NDArray[NumberT]) -> NDArray[NumberT]:
    """Sums along a short last axis, (..., K) to (...), K from 1 to 3.

    What ``values.sum(axis=-1)`` gives, to the bit, and up to fifty times as quick: numpy starts
    anew for each row.
    """
    total = values[..., 0]
    for k in range(1, values.shape[-1]):
        total = total + values[..., k]
    return np.asarray(total)


def row_lengths(vectors: Points) -> Floats:
    """Lengths of vectors (..., 2), as ``np.linalg.norm`` gives them along the last axis."""
    return np.asarray(np.sqrt(row_sums(vectors * vectors)))


def frozen(
    values: ArrayLike, dtype: type[ItemT], *, last: tuple[int, ...] = (), ndim: int | None = None
) -> NDArray[Any]:
    """Copy `values` into a read-only array, checking its shape.

    Parameters
    ----------
    values : array_like
    dtype : type
        Type of the copy's items.
    last : tuple of int
        What the last axes must measure, ``(4, 2)`` for quads.
    ndim : int, optional
        Number of axes required; by default one more than `last` has.

    Raises
    ------
    ShapeError
        If the shape differs or a number is not finite.
    """
    array = np.array(values, dtype=dtype)
    if array.size == 0 and last:
        array = array.reshape(0, *last)
    wanted = len(last) + 1 if ndim is None else ndim
    if array.ndim != wanted or array.shape[array.ndim - len(last) :] != last:
        axes = ", ".join(["..."] * (wanted > len(last)) + [str(n) for n in last])
        raise ShapeError(f"expected an array of shape ({axes}), got {array.shape}")
    if array.dtype.kind == "f" and not np.isfinite(array).all():
        raise ShapeError("an array holds a number that is not finite")
    array.setflags(write=False)
    return array


def times(t: ArrayLike) -> Floats:
    """Times as a one-dimensional array, checked to lie in [0, 1].

    Raises
    ------
    ShapeError
        If a time is outside [0, 1] or not a number.
    """
    array = np.atleast_1d(np.asarray(t, dtype=np.float64))
    if array.ndim != 1 or not ((array >= 0) & (array <= 1)).all():
        raise ShapeError("times must be numbers from 0 to 1, in one list")
    return array
