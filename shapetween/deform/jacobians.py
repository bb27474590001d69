"""Jacobians of piecewise affine maps: one linear map a triangle, and its way through time.

A Jacobian is split as ``J = R(angle) S`` with S symmetric [SD92]_ and moves as
``R(t angle) ((1 - t) I + t S)`` [ACOL00]_, its determinant corrected. The angle of a single map
is known only up to whole turns; neighbours must agree, or what lies between them tears.

.. [SD92] K. Shoemake, T. Duff, *Matrix animation and polar decomposition*, Graphics Interface 1992.
.. [ACOL00] M. Alexa, D. Cohen-Or, D. Levin, *As-rigid-as-possible shape interpolation*,
   SIGGRAPH 2000.
"""

import numpy as np

from shapetween.base.arrays import Complex, Floats, Index, Mask, row_sums
from shapetween.deform.triangulate import triangle_edges
from shapetween.geometry.linearmaps import LinearMaps
from shapetween.geometry.rotation import coherent_angles

__all__ = ["AREA_EXPONENT", "gradients", "jacobians", "polar_path", "spread_angles"]

#: How far the area of a triangle is drawn to the straight path of its square root. 1 keeps areas
#: and thins limbs whose stretch turns; 0 keeps lengths and lets areas sag.
AREA_EXPONENT = 1.0

#: What a step through the outside costs, in radians, when angles spread over the triangles: a whole
#: turn. With no more than half of one, the most that a step inside costs, angles leak from limb to
#: limb through the gap between them; any more is as good.
OUTSIDE_COST = 2 * np.pi


def gradients(corners: Complex) -> tuple[Complex, Floats]:
    """Gradients of the three linear shape functions, and signed areas.

    Parameters
    ----------
    corners : (T, 3) complex128
        Triangles, none of area zero.

    Returns
    -------
    shape_gradients : (T, 3) complex128
        As vectors: `jacobians` sums them with values at the corners.
    areas : (T,) float64
    """
    a, b, c = corners.T
    twice = ((b - a).conj() * (c - a)).imag
    opposite = np.stack([c - b, a - c, b - a], axis=1)
    return 1j * opposite / twice[:, None], twice / 2


def jacobians(shape_gradients: Complex, corners: Complex) -> LinearMaps:
    """Jacobians of the affine maps that take the corners of triangles to given points.

    Parameters
    ----------
    shape_gradients : (T, 3) complex128
        From `gradients`.
    corners : (..., T, 3) complex128

    Returns
    -------
    (..., T) linear maps
    """
    half = corners / 2
    return LinearMaps(row_sums(half * shape_gradients.conj()), row_sums(half * shape_gradients))


def polar_path(maps: LinearMaps, angles: Floats, t: Floats) -> LinearMaps:
    """Linear maps on their way from the identity.

    Parameters
    ----------
    maps : (...,) linear maps
        Of positive determinant.
    angles : (...,) float64
        Their angles, whole turns included.
    t : (F,) float64

    Returns
    -------
    (F, ...) linear maps
        The identity at 0 and `maps` at 1. The path backwards, from the inverse, is the same.

    Notes
    -----
    [ACOL00]_, equation (7), times a factor that brings the square root of the determinant to its
    straight path as far as `AREA_EXPONENT` says.
    """
    blend = maps.between(angles, t)
    time = t.reshape(-1, *(1,) * maps.a.ndim)
    straight = (1 - time) + time * np.sqrt(maps.determinants)
    return blend.turned((straight / np.sqrt(blend.determinants)) ** AREA_EXPONENT)


def spread_angles(
    angles: Floats, triangles: Index, weights: Floats, inside: Mask, valid: Mask
) -> Floats:
    """Angles of Jacobians with whole turns chosen so that neighbours agree.

    They spread through the inside before the outside. Their mean over the inside is as near to
    zero as whole turns allow.

    Parameters
    ----------
    angles : (T,) float64
        Each known up to whole turns.
    triangles : (T, 3) intp
    weights : (T,) float64
        What each triangle counts in the mean.
    inside : (T,) bool
    valid : (T,) bool
        Triangles whose map has a positive determinant; others are passed through last.

    Returns
    -------
    (T,) float64
    """
    sides = triangle_edges(triangles)[1]
    sides = sides[sides[:, 1] >= 0]
    i, j = sides.T
    through = ~(inside[i] & inside[j]) + 2.0 * ~(valid[i] & valid[j])
    return coherent_angles(angles, sides, weights * (inside & valid), OUTSIDE_COST * through)
