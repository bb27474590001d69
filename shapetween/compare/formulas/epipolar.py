"""Whether an in-between can be a view of the same rigid scene as the two drawings.

These measures are our own, in the spirit of Wong, Kovesi and Datta's of 2005, whose text we could
not find: two views of a rigid scene are related by a fundamental matrix, so an in-between is a
possible view only if matrices fit it to both ends. They need eight points and more that lie
neither on one plane nor, in both views, in one homography; meshes of flat figures do not qualify.

.. [HZ04] R. Hartley, A. Zisserman, *Multiple View Geometry*, 2nd ed., 2004.
"""

import numpy as np

from shapetween.base.arrays import Floats, Points
from shapetween.base.errors import ShapeError
from shapetween.geometry.polygon import rms_radius

__all__ = ["epipolar_distance", "fundamental_matrix", "transfer_error"]

#: Ratio of the second least singular value of the eight-point system to the largest, below which
#: many matrices fit: the points are of one plane. Larger refuses nearly flat scenes.
LEAST_RANK = 1e-9


def fundamental_matrix(first: Points, second: Points) -> Floats:
    """F with (x', 1) F (x, 1) = 0 for points of two views, by the normalised eight-point algorithm.

    Parameters
    ----------
    first, second : (N, 2) float64
        N >= 8.

    Returns
    -------
    (3, 3) float64
        Of rank 2 and norm 1.

    Raises
    ------
    ShapeError
        If there are fewer than eight points, or they lie on one plane.

    Notes
    -----
    [HZ04]_, algorithm 11.1.
    """
    if len(first) < 8 or len(first) != len(second):
        raise ShapeError(f"{len(first)} and {len(second)} points; eight and as many are needed")
    left, right = _normaliser(first), _normaliser(second)
    x, y = _homogeneous(first) @ left.T, _homogeneous(second) @ right.T
    _, sizes, rows = np.linalg.svd(np.einsum("ni,nj->nij", y, x).reshape(-1, 9))
    if sizes[7] < LEAST_RANK * sizes[0]:
        raise ShapeError("the points of the two views lie on one plane, which tells no views apart")
    u, d, vt = np.linalg.svd(rows[-1].reshape(3, 3))
    matrix = right.T @ (u @ np.diag([d[0], d[1], 0.0]) @ vt) @ left
    return np.asarray(matrix / np.linalg.norm(matrix))


def epipolar_distance(first: Points, second: Points) -> float:
    """Distance of points from the epipolar lines of one another, over their radius.

    0 if and only if one fundamental matrix relates all points, as two views of a rigid scene are.

    Notes
    -----
    The root of the mean of (x' F x)^2 (1 / |(F x)_12|^2 + 1 / |(F^T x')_12|^2), the symmetric
    epipolar distance of [HZ04]_ equation (11.10), over the mean root mean square radius.
    """
    matrix = fundamental_matrix(first, second)
    x, y = _homogeneous(first), _homogeneous(second)
    lines, others = x @ matrix.T, y @ matrix
    off = (y * lines).sum(axis=1) ** 2
    each = off / (lines[:, :2] ** 2).sum(axis=1) + off / (others[:, :2] ** 2).sum(axis=1)
    return float(np.sqrt(each.mean()) / np.mean([rms_radius(first), rms_radius(second)]))


def transfer_error(first: Points, between: Points, last: Points) -> float:
    """Distance of in-between points from where both ends' epipolar lines cross, over the radius.

    Parameters
    ----------
    first, between, last : (N, 2) float64
        The same points in three views.

    Notes
    -----
    [HZ04]_, section 15.1: x' = (F_01 x_0) x (F_21 x_2). Points whose two lines are nearly the
    same say nothing and are left out.
    """
    from_first = _homogeneous(first) @ fundamental_matrix(first, between).T
    from_last = _homogeneous(last) @ fundamental_matrix(last, between).T
    from_first /= np.linalg.norm(from_first[:, :2], axis=1, keepdims=True)
    from_last /= np.linalg.norm(from_last[:, :2], axis=1, keepdims=True)
    found = np.cross(from_first, from_last)
    # The sine between the lines; at 0.05, three degrees, an error of the lines counts 20 times.
    clear = np.abs(found[:, 2]) > 0.05
    if not clear.any():
        raise ShapeError("the epipolar lines from both ends are the same; the views are in a row")
    offset = found[clear, :2] / found[clear, 2:] - between[clear]
    return float(np.sqrt((offset**2).sum(axis=1).mean()) / rms_radius(between))


def _homogeneous(points: Points) -> Floats:
    return np.column_stack([points, np.ones(len(points))])


def _normaliser(points: Points) -> Floats:
    """Similarity that brings points to the mean 0 and the root mean square radius sqrt(2)."""
    scale = np.sqrt(2) / float(rms_radius(points))
    x, y = points.mean(axis=0)
    return np.array([[scale, 0.0, -scale * x], [0.0, scale, -scale * y], [0.0, 0.0, 1.0]])
