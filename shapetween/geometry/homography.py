"""Homographies between quads, many at a time.

Matrices act on column vectors (x, y, 1); a stack of them has shape (Q, 3, 3).

.. [HZ04] R. Hartley, A. Zisserman, *Multiple View Geometry*, 2nd ed., 2004.
.. [WKD07] K. H. Wong, P. Kovesi, A. Datta, "Projective Transformations for Image Transition
   Animations", ICIAP 2007.
"""

import numpy as np

from shapetween.base.arrays import Floats, Points, Quads
from shapetween.geometry.polygon import cross

__all__ = [
    "apply_homography",
    "corner_weights",
    "homogeneous_weights",
    "homography_jacobians",
    "quad_homographies",
    "triangle_affinities",
]


def quad_homographies(source: Quads, target: Quads) -> Floats:
    """Homography that takes each source quad's corners to the target's.

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
    With b_k the barycentric coordinates of the triangle of the first three corners, the homography
    is x -> sum_k w_k b_k(x) (q_k, 1), q_k the target's corners and w_k the weights of
    `corner_weights`: the closed form of the projective frame of four points ([HZ04]_, 2.3). All is
    measured from the centroid; far from the origin digits would be lost.
    """
    centre = source.mean(axis=-2, keepdims=True)
    local = source - centre
    slopes, values = _barycentric(local)
    rows = np.concatenate([slopes, values[..., None]], axis=-1)  # (..., 3 corners, 3)
    weighted = corner_weights(source, target)[..., :3, None] * rows
    corners = np.concatenate([target[..., :3, :], np.ones((*target.shape[:-2], 3, 1))], axis=-1)
    matrix = np.swapaxes(corners, -1, -2) @ weighted
    matrix = matrix / matrix[..., 2:, 2:]
    matrix[..., 2] -= (matrix[..., :2] @ np.swapaxes(centre, -1, -2))[..., 0]
    return np.asarray(matrix)


def corner_weights(source: Quads, target: Quads) -> Floats:
    """The third coordinate w that homographies give the corners of quads, the last one's 1.

    Parameters
    ----------
    source, target : (..., 4, 2) float64

    Returns
    -------
    (..., 4) float64
        All positive if and only if no point of the quad goes past infinity.
    """
    shares = [_shares(quads) for quads in (source, target)]
    ratios = shares[1] / shares[0]
    return np.concatenate([ratios, np.ones((*ratios.shape[:-1], 1))], axis=-1)


def _shares(quads: Quads) -> Floats:
    """Barycentric coordinates of the fourth corner in the triangle of the others, (..., 3)."""
    a, b, c = (quads[..., k, :] - quads[..., 3, :] for k in range(3))
    parts = np.stack([cross(b, c), cross(c, a), cross(a, b)], axis=-1)
    return np.asarray(parts / parts.sum(axis=-1, keepdims=True))


def _barycentric(quads: Quads) -> tuple[Floats, Floats]:
    """Slopes (..., 3, 2), and values (..., 3) at the origin, of the first corners' coordinates."""
    a, b, c = (quads[..., k, :] for k in range(3))
    opposite = np.stack([b - c, c - a, a - b], axis=-2)
    twice = cross(b - a, c - a)[..., None]
    slopes = np.stack([opposite[..., 1], -opposite[..., 0]], axis=-1) / twice[..., None]
    values = np.stack([cross(b, c), cross(c, a), cross(a, b)], axis=-1) / twice
    return slopes, values


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
