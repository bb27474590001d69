"""Cubic Bezier curves, many at a time.

A stack of curves has shape (N, 4, 2): start, two handles, end.

.. [Far02] G. Farin, *Curves and Surfaces for CAGD*, 5th ed., 2002.
"""

import numpy as np

from shapetween.base.arrays import Curves, Floats, Index, Points, row_lengths

__all__ = [
    "bernstein",
    "combined",
    "curve_lengths",
    "derivatives",
    "end_tangents",
    "evaluate",
    "flatten",
    "line_curves",
    "signed_area",
    "sub_curves",
    "velocity_weights",
]

#: Gauss-Legendre nodes a curve's length is integrated with; fewer misjudge hooks and cusps.
LENGTH_NODES = 16

_THIRDS = np.linspace(0.0, 1.0, 4)[:, None]


def line_curves(start: Points, end: Points) -> Curves:
    """Straight lines as cubics with handles at the thirds, (..., 4, 2)."""
    start, end = np.asarray(start)[..., None, :], np.asarray(end)[..., None, :]
    return np.asarray((1 - _THIRDS) * start + _THIRDS * end)


def evaluate(curves: Curves, t: Floats) -> Points:
    """Points of every curve at every parameter.

    Parameters
    ----------
    curves : (..., 4, 2) float64
    t : (K,) or (..., K) float64
        The same for all curves, or each curve's own.

    Returns
    -------
    (..., K, 2) float64
    """
    return combined(bernstein(t), curves)


def bernstein(t: Floats, axis: int = -1) -> Floats:
    """Weights of the four control points, on an axis of their own, at parameters (...)."""
    s = 1 - t
    return _beside((s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t), axis)


def combined(weights: Floats, points: Points) -> Points:
    """Sums of weighted points, (..., K, M) and (..., M, 2) to (..., K, 2).

    Notes
    -----
    The product of matrices, added up in one order. A matrix library adds in whichever order suits
    the processor, and outlines would then differ in their last bit from one machine to the next.
    Coordinates come first meanwhile: numpy starts anew for each row of a short last axis.
    """
    last = points.ndim - 1
    rows = points.transpose(last, *range(last))
    total = weights[..., 0] * rows[..., None, 0]
    for k in range(1, weights.shape[-1]):
        total += weights[..., k] * rows[..., None, k]
    return np.ascontiguousarray(total.transpose(*range(1, total.ndim), 0))


def derivatives(curves: Curves, t: Floats) -> Points:
    """Velocities of every curve, with parameters and shapes as for `evaluate`."""
    return combined(velocity_weights(t), 3 * np.diff(curves, axis=-2))


def velocity_weights(t: Floats, axis: int = -1) -> Floats:
    """Weights of thrice the steps between control points, as `bernstein` has those of points."""
    s = 1 - t
    return _beside((s * s, 2 * s * t, t * t), axis)


def _beside(weights: tuple[Floats, ...], axis: int) -> Floats:
    """Weights on an axis of their own; what ``np.stack`` does, without its checks."""
    shape = weights[0].shape
    place = axis % (len(shape) + 1)
    found = np.zeros((*shape[:place], len(weights), *shape[place:]))
    rows = found.transpose(place, *range(place), *range(place + 1, found.ndim))
    for k, weight in enumerate(weights):
        rows[k] = weight
    return found


def flatten(curves: Curves, pieces: int | Index) -> Points:
    """Every curve as `pieces` chords, joined; the last point of the last curve is left out.

    Parameters
    ----------
    curves : (..., N, 4, 2) float64
    pieces : int or (N,) intp
        The same for all curves, or each curve's own.

    Returns
    -------
    (..., M, 2) float64
        The closed polygon of a ring whose curves follow one another; M is the sum of all pieces.
    """
    if isinstance(pieces, int):
        points = evaluate(curves, np.arange(pieces) / pieces)
        return points.reshape(*curves.shape[:-3], -1, 2)
    from scipy.sparse import csr_array

    curve = np.repeat(np.arange(len(pieces)), pieces)
    t = (np.arange(len(curve)) - (np.cumsum(pieces) - pieces)[curve]) / pieces[curve]
    column = 4 * curve[:, None] + np.arange(4)
    start = 4 * np.arange(len(curve) + 1)
    weights = csr_array(
        (bernstein(t).ravel(), column.ravel(), start), shape=(len(curve), 4 * len(pieces))
    )
    stacked = curves.reshape(-1, 4 * len(pieces), 2)
    points = weights @ np.swapaxes(stacked, 0, 1).reshape(4 * len(pieces), -1)
    points = np.swapaxes(points.reshape(len(curve), -1, 2), 0, 1)
    return np.ascontiguousarray(points).reshape(*curves.shape[:-3], len(curve), 2)


def sub_curves(curves: Curves, start: Floats, end: Floats) -> Curves:
    """Part of each curve between two parameters, exactly.

    Parameters
    ----------
    curves : (N, 4, 2) float64
    start, end : (N,) float64
        Parameters within the curve; ``start > end`` reverses the part.

    Returns
    -------
    (N, 4, 2) float64

    Notes
    -----
    The control points are the blossom at (s, s, s), (s, s, e), (s, e, e), (e, e, e) ([Far02]_,
    section 4.4).
    """

    def blossom(a: Floats, b: Floats, c: Floats) -> Points:
        points = curves
        for t in (a, b, c):
            weight = np.asarray(t)[:, None, None]
            points = (1 - weight) * points[:, :-1] + weight * points[:, 1:]
        return points[:, 0]

    return np.stack(
        [
            blossom(start, start, start),
            blossom(start, start, end),
            blossom(start, end, end),
            blossom(end, end, end),
        ],
        axis=1,
    )


def curve_lengths(curves: Curves, start: Floats | float = 0.0, end: Floats | float = 1.0) -> Floats:
    """Arc length of each curve between two of its parameters, (N,)."""
    nodes, weights = np.polynomial.legendre.leggauss(LENGTH_NODES)
    low, high = np.broadcast_arrays(np.asarray(start, float), np.asarray(end, float))
    low, high = np.broadcast_to(low, len(curves)), np.broadcast_to(high, len(curves))
    t = low[:, None] + (high - low)[:, None] * (nodes + 1) / 2
    speed = row_lengths(derivatives(curves, t))
    return np.asarray((speed * weights).sum(-1) * (high - low) / 2)


def end_tangents(curves: Curves) -> tuple[Points, Points]:
    """Unit directions in which each curve leaves its start and reaches its end.

    Returns
    -------
    leaving, reaching : (..., 2) float64
        Zero where a curve is a single point.

    Notes
    -----
    A handle that lies on its own end point says nothing; the next control point that does not,
    gives the direction.
    """

    def direction(points: Points) -> Points:
        offsets = points[..., 1:, :] - points[..., :1, :]
        size = row_lengths(offsets)
        scale = size.max(axis=-1, keepdims=True)
        first = np.argmax(size > 1e-9 * scale, axis=-1)
        chosen = np.take_along_axis(offsets, first[..., None, None], axis=-2)[..., 0, :]
        length = row_lengths(chosen)[..., None]
        return np.asarray(chosen / np.where(length > 0, length, 1.0))

    return direction(curves), -direction(curves[..., ::-1, :])


def signed_area(curves: Curves) -> float:
    """Area inside a closed ring of curves, positive when it runs clockwise as drawn.

    Parameters
    ----------
    curves : (N, 4, 2) float64

    Notes
    -----
    Green's theorem on the cubics' polynomials, so exact: half the sum over control point pairs of
    cross(p_i, p_j) weighted by the integral of B_i B'_j.
    """
    weights = np.array([[0, 6, 3, 1], [-6, 0, 3, 3], [-3, -3, 0, 6], [-1, -3, -6, 0]]) / 20
    local = curves - curves[:1, :1]
    x, y = local[..., 0], local[..., 1]
    return float((combined(x, weights) * y).sum())
