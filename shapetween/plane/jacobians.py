"""Jacobians of piecewise affine maps: one 2 x 2 matrix a triangle, and its way through time.

A Jacobian is split as ``J = R(angle) S`` with S symmetric [SD92]_ and moves as
``R(t angle) ((1 - t) I + t S)`` [ACOL00]_, its determinant corrected. The angle of a single matrix
is known only up to whole turns; neighbours must agree, or what lies between them tears.

.. [SD92] K. Shoemake, T. Duff, *Matrix animation and polar decomposition*, Graphics Interface 1992.
.. [ACOL00] M. Alexa, D. Cohen-Or, D. Levin, *As-rigid-as-possible shape interpolation*,
   SIGGRAPH 2000.
"""

import numpy as np

from shapetween.arrays import Floats, Index, Mask, Points
from shapetween.geometry.rotation import rotations
from shapetween.plane.triangulate import triangle_edges

__all__ = [
    "AREA_EXPONENT",
    "gradients",
    "jacobians",
    "polar_angles",
    "polar_path",
    "spread_angles",
]

#: How far the area of a triangle is drawn to the straight path of its square root. 1 keeps areas
#: and thins limbs whose stretch turns; 0 keeps lengths and lets areas sag.
AREA_EXPONENT = 1.0

#: What a step through the outside costs, in radians, when angles spread over the triangles. Less
#: and angles leak from limb to limb through the gap between them.
OUTSIDE_COST = 10.0


def gradients(corners: Points) -> tuple[Floats, Floats]:
    """Gradients of the three linear hat functions, and signed areas.

    Parameters
    ----------
    corners : (T, 3, 2) float64
        Triangles, none of area zero.

    Returns
    -------
    hats : (T, 3, 2) float64
        With values y at the corners, ``J = sum_k y_k hats_k^T`` is the Jacobian.
    areas : (T,) float64
    """
    opposite = np.roll(corners, 1, axis=1) - np.roll(corners, -1, axis=1)
    first = corners[:, 1] - corners[:, 0]
    second = corners[:, 2] - corners[:, 0]
    twice = first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]
    turned = np.stack([-opposite[..., 1], opposite[..., 0]], axis=-1)
    return turned / twice[:, None, None], twice / 2


def jacobians(hats: Floats, corners: Points) -> Floats:
    """Jacobians of the affine maps that take the corners of triangles to given points.

    Parameters
    ----------
    hats : (T, 3, 2) float64
        From `gradients`.
    corners : (..., T, 3, 2) float64

    Returns
    -------
    (..., T, 2, 2) float64
    """
    return np.asarray(np.swapaxes(corners, -1, -2) @ hats)


def polar_angles(matrices: Floats) -> Floats:
    """Angle in (-pi, pi] of the rotation nearest to each matrix, (...,) for (..., 2, 2)."""
    m = matrices
    return np.asarray(np.arctan2(m[..., 1, 0] - m[..., 0, 1], m[..., 0, 0] + m[..., 1, 1]))


def polar_path(matrices: Floats, angles: Floats, t: Floats) -> Floats:
    """Matrices on their way from the identity.

    Parameters
    ----------
    matrices : (T, 2, 2) float64
        Of positive determinant.
    angles : (T,) float64
        Their angles, whole turns included.
    t : (F,) float64

    Returns
    -------
    (F, T, 2, 2) float64
        The identity at 0 and `matrices` at 1. The path backwards, from the inverse, is the same.

    Notes
    -----
    [ACOL00]_, equation (7), times a factor that brings the square root of the determinant to its
    straight path as far as `AREA_EXPONENT` says.
    """
    stretch = rotations(-angles) @ matrices
    time = t[:, None, None, None]
    blend = (1 - time) * np.eye(2) + time * stretch
    straight = (1 - t)[:, None] + t[:, None] * np.sqrt(np.linalg.det(matrices))
    factor = (straight / np.sqrt(np.linalg.det(blend))) ** AREA_EXPONENT
    return np.asarray(factor[..., None, None] * (rotations(t[:, None] * angles) @ blend))


def spread_angles(
    matrices: Floats, triangles: Index, weights: Floats, inside: Mask, sound: Mask
) -> Floats:
    """Angles of Jacobians with whole turns chosen so that neighbours agree.

    They spread over a spanning tree of least total difference, through the inside before the
    outside. Their mean over the inside is as near to zero as whole turns allow.

    Parameters
    ----------
    matrices : (T, 2, 2) float64
    triangles : (T, 3) intp
    weights : (T,) float64
        What each triangle counts in the mean.
    inside : (T,) bool
    sound : (T,) bool
        Triangles whose matrix has a positive determinant; others are passed through last.

    Returns
    -------
    (T,) float64
    """
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import breadth_first_order, minimum_spanning_tree

    angles = polar_angles(matrices)
    sides = triangle_edges(triangles)[1]
    i, j = sides[sides[:, 1] >= 0].T
    differ = np.abs(_wrapped(angles[j] - angles[i]))
    cost = 1e-6 + differ + OUTSIDE_COST * (~(inside[i] & inside[j]) + 2 * ~(sound[i] & sound[j]))
    graph = coo_array((cost, (i, j)), shape=(len(angles), len(angles))).tocsr()
    root = int(np.argmax(inside & sound))
    order, before = breadth_first_order(minimum_spanning_tree(graph), root, directed=False)
    result = angles.copy()
    for k in order[1:]:
        known = result[before[k]]
        result[k] = known + _wrapped(angles[k] - known)
    counted = weights * (inside & sound)
    if counted.sum() > 0:
        result -= 2 * np.pi * np.round(counted @ result / counted.sum() / (2 * np.pi))
    return result


def _wrapped(angles: Floats) -> Floats:
    """The same directions in [-pi, pi)."""
    return np.asarray((angles + np.pi) % (2 * np.pi) - np.pi)
