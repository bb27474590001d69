"""Homographies between quads, many at a time.

Matrices act on column vectors (x, y, 1); a stack of them has shape (Q, 3, 3).

.. [HZ04] R. Hartley, A. Zisserman, *Multiple View Geometry*, 2nd ed., 2004, algorithm 4.2.
.. [WKD07] K. H. Wong, P. Kovesi, A. Datta, "Projective Transformations for Image Transition
   Animations", ICIAP 2007.
"""

import numpy as np

from shapetween.arrays import Floats, Points, Quads

__all__ = [
    "apply_homography",
    "homogeneous_weights",
    "homography_jacobians",
    "quad_homographies",
    "triangle_affinities",
]


def quad_homographies(source: Quads, target: Quads) -> Floats:
    """Homography that takes each source quad's corners to the target's, by the normalised DLT.

    Parameters
    ----------
    source, target : (..., 4, 2) float64
        Corners; no three of a quad on one line.

    Returns
    -------
    (..., 3, 3) float64
        Scaled so that the entry of the source centroid's weight, h3 . (centroid, 1), is 1.

    Notes
    -----
    Both quads are moved to their centroid and scaled to a mean corner distance of sqrt(2) first
    [HZ04]_; without it the solution of nearly parallel equations is mostly rounding error. In that
    frame h33 is the weight of the source's centroid, which is not 0 while no corner is mapped
    past infinity, so it is set to 1 and eight equations are solved for the rest.
    """
    p, q = _normaliser(source), _normaliser(target)
    x, y = np.moveaxis(apply_homography(p, source), -1, 0)  # (..., 4)
    u, v = np.moveaxis(apply_homography(q, target), -1, 0)
    zero, one = np.zeros_like(x), np.ones_like(x)
    rows_u = np.stack([x, y, one, zero, zero, zero, -u * x, -u * y], axis=-1)
    rows_v = np.stack([zero, zero, zero, x, y, one, -v * x, -v * y], axis=-1)
    system = np.concatenate([rows_u, rows_v], axis=-2)
    entries = np.linalg.solve(system, np.concatenate([u, v], axis=-1)[..., None])[..., 0]
    matrix = np.concatenate([entries, np.ones((*entries.shape[:-1], 1))], axis=-1)
    matrix = np.linalg.inv(q) @ matrix.reshape(*entries.shape[:-1], 3, 3) @ p
    centre = np.concatenate([source.mean(axis=-2), np.ones((*source.shape[:-2], 1))], axis=-1)
    weight = np.einsum("...j,...j->...", matrix[..., 2, :], centre)
    return np.asarray(matrix / weight[..., None, None])


def _normaliser(points: Points) -> Floats:
    centre = points.mean(axis=-2)
    spread = np.linalg.norm(points - centre[..., None, :], axis=-1).mean(axis=-1)
    scale = np.sqrt(2) / spread
    matrix = np.zeros((*points.shape[:-2], 3, 3))
    matrix[..., 0, 0] = matrix[..., 1, 1] = scale
    matrix[..., :2, 2] = -scale[..., None] * centre
    matrix[..., 2, 2] = 1.0
    return matrix


def apply_homography(matrix: Floats, points: Points) -> Points:
    """Map points: matrices (..., 3, 3) on points (..., K, 2)."""
    mapped = points @ np.swapaxes(matrix[..., :2], -1, -2) + matrix[..., None, :, 2]
    return np.asarray(mapped[..., :2] / mapped[..., 2:])


def homogeneous_weights(matrix: Floats, points: Points) -> Floats:
    """The third coordinate w of mapped points, (..., K); one sign where no point meets infinity."""
    return np.asarray(
        np.einsum("...j,...kj->...k", matrix[..., 2, :2], points) + matrix[..., 2, 2:]
    )


def homography_jacobians(matrix: Floats, points: Points) -> Floats:
    """Jacobian of each homography at points: (..., 3, 3) and (..., K, 2) to (..., K, 2, 2).

    Notes
    -----
    With y the image of x and w its third coordinate, J = (H2 - y (h31, h32)) / w, and
    det J = det H / w^3.
    """
    image = apply_homography(matrix, points)
    weights = homogeneous_weights(matrix, points)
    outer = image[..., :, None] * matrix[..., None, 2, None, :2]
    return np.asarray((matrix[..., None, :2, :2] - outer) / weights[..., None, None])


def triangle_affinities(source: Points, target: Points) -> Floats:
    """Linear part of the affine map that takes each source triangle to its target.

    Parameters
    ----------
    source, target : (T, 3, 2) float64

    Returns
    -------
    (T, 2, 2) float64
    """
    p = np.swapaxes(source[..., 1:, :] - source[..., :1, :], -1, -2)
    q = np.swapaxes(target[..., 1:, :] - target[..., :1, :], -1, -2)
    return np.asarray(q @ np.linalg.inv(p))
