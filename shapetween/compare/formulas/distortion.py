"""How much maps of the plane distort, from their Jacobians.

All but the energies are exact at every place; s1 >= s2 are the singular values of the Jacobian
there, s2 negative where it turns the plane over.
"""

import numpy as np

from shapetween.base.arrays import Floats

__all__ = [
    "arap_energy",
    "conformal_distortion",
    "excess_conformal",
    "isometric_distortion",
    "signed_stretches",
    "symmetric_dirichlet",
]


def signed_stretches(jacobians: Floats) -> tuple[Floats, Floats]:
    """Singular values s1 >= |s2| of maps (..., 2, 2), s2 with the sign of the determinant."""
    a, b = jacobians[..., 0, 0], jacobians[..., 0, 1]
    c, d = jacobians[..., 1, 0], jacobians[..., 1, 1]
    # Of a map z -> p z + q conj(z) they are |p| + |q| and |p| - |q|.
    turning = np.hypot(a + d, c - b) / 2
    mirroring = np.hypot(a - d, c + b) / 2
    return np.asarray(turning + mirroring), np.asarray(turning - mirroring)


def conformal_distortion(jacobians: Floats) -> Floats:
    """K = s1 / s2, (...,): 1 where angles are kept, infinite where the map folds."""
    large, small = signed_stretches(jacobians)
    return np.where(small > 0, large / np.where(small > 0, small, 1.0), np.inf)


def isometric_distortion(jacobians: Floats) -> Floats:
    """max(s1, 1 / s2), (...,): 1 where lengths are kept, infinite where the map folds."""
    large, small = signed_stretches(jacobians)
    return np.where(small > 0, np.maximum(large, 1 / np.where(small > 0, small, 1.0)), np.inf)


def arap_energy(jacobians: Floats, areas: Floats) -> Floats:
    """Sum areas ((s1 - 1)^2 + (s2 - 1)^2), (...,) for (..., N, 2, 2) and (N,).

    Notes
    -----
    The squared distance of each Jacobian from the nearest rotation, by area. Of the shape's size
    it has the unit of its area.
    """
    large, small = signed_stretches(jacobians)
    return np.asarray((areas * ((large - 1) ** 2 + (small - 1) ** 2)).sum(axis=-1))


def symmetric_dirichlet(jacobians: Floats, areas: Floats) -> Floats:
    """Mean of (s1^2 + s2^2 + s1^-2 + s2^-2) / 4 by area, (...,): 1 at an isometry.

    Infinite where the map folds anywhere.
    """
    large, small = signed_stretches(jacobians)
    good = small > 0
    a, b = np.where(good, large, 1.0) ** 2, np.where(good, small, 1.0) ** 2
    each = np.where(good, (a + b + 1 / a + 1 / b) / 4, np.inf)
    return np.asarray((areas * each).sum(axis=-1) / areas.sum())


def excess_conformal(jacobians: Floats, last: Floats) -> Floats:
    """max(0, K / max(1, K_1) - 1), (F, N): how far in-betweens leave the bound of the end.

    Parameters
    ----------
    jacobians : (F, N, 2, 2) float64
    last : (N, 2, 2) float64
        At t = 1, whose conformal distortion K_1 a bounded movement never exceeds.
    """
    bound = np.maximum(1.0, conformal_distortion(last))
    return np.maximum(0.0, conformal_distortion(jacobians) / bound - 1)
