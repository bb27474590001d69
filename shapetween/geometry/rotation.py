"""Rotations of the plane: polar decomposition, in-between linear maps, angles without jumps.

.. [AM92] K. Shoemake, T. Duff, "Matrix animation and polar decomposition", GI 1992.
.. [CS03] J. Choi, A. Szymczak, "On coherent rotation angles for as-rigid-as-possible shape
   interpolation", CCCG 2003.
"""

import numpy as np

from shapetween.base.arrays import Floats, Index

__all__ = ["coherent_angles", "linear_between", "polar", "rotations"]

#: Radians added to every difference of angles, so that a graph's edge is never 0, which is none.
NO_EDGE = 1e-6


def rotations(angles: Floats) -> Floats:
    """Rotation matrices, (..., 2, 2), of angles from the x axis towards the y axis."""
    c, s = np.cos(angles), np.sin(angles)
    return np.stack([np.stack([c, -s], axis=-1), np.stack([s, c], axis=-1)], axis=-2)


def polar(matrices: Floats) -> tuple[Floats, Floats]:
    """Split linear maps A = R(angle) S into a rotation and a symmetric stretch.

    Parameters
    ----------
    matrices : (..., 2, 2) float64
        With positive determinant.

    Returns
    -------
    angles : (...,) float64
        In (-pi, pi].
    stretches : (..., 2, 2) float64
        Symmetric, positive definite.

    Notes
    -----
    Through the SVD, A = U D V^T: R = U V^T and S = V D V^T [AM92]_.
    """
    u, d, vt = np.linalg.svd(matrices)
    r = u @ vt
    angles = np.arctan2(r[..., 1, 0] - r[..., 0, 1], r[..., 0, 0] + r[..., 1, 1])
    return angles, np.swapaxes(vt, -1, -2) @ (d[..., None] * vt)


def linear_between(angles: Floats, stretches: Floats, t: Floats) -> Floats:
    """In-between linear maps R(t angle) ((1 - t) I + t S).

    Parameters
    ----------
    angles : (N,) float64
    stretches : (N, 2, 2) float64
    t : (F,) float64

    Returns
    -------
    (F, N, 2, 2) float64
    """
    time = t[:, None, None, None]
    return rotations(t[:, None] * angles) @ ((1 - time) * np.eye(2) + time * stretches)


def coherent_angles(
    angles: Floats, neighbours: Index, weights: Floats, costs: Floats | None = None
) -> Floats:
    """Add whole turns so that neighbours differ by as little as they can.

    Parameters
    ----------
    angles : (N,) float64
        Each known up to whole turns.
    neighbours : (E, 2) intp
        Pairs of faces that meet.
    weights : (N,) float64
        Not negative; how much a face counts when the turns of a component are fixed.
    costs : (E,) float64, optional
        What it costs to go from one to the other, beside the difference of their angles.

    Returns
    -------
    (N,) float64

    Notes
    -----
    [CS03]_, but along the minimum spanning tree of the absolute differences instead of any walk:
    in a mesh with holes a loop need not close, and then the seam falls where faces disagree most.
    Each component is then shifted by whole turns so that its weighted mean lies in (-pi, pi]; the
    half turn itself counts as positive, so that rounding does not choose the way round.
    """
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import (
        breadth_first_order,
        connected_components,
        minimum_spanning_tree,
    )

    turn, count = 2 * np.pi, len(angles)
    first, second = neighbours.T
    price = np.abs(_wrapped(angles[second] - angles[first])) + (0.0 if costs is None else costs)
    # An edge of price 0 would be none.
    ends = np.minimum(first, second), np.maximum(first, second)
    graph = coo_array((price + NO_EDGE, ends), shape=(count, count)).tocsr()
    tree = minimum_spanning_tree(graph).tocoo()
    members, part = connected_components(tree, directed=False)
    # One more node joins the trees of all parts to one.
    heads = np.unique(part, return_index=True)[1]
    joined = coo_array(
        (
            np.ones(tree.nnz + members),
            (
                np.concatenate([tree.row, np.full(members, count)]),
                np.concatenate([tree.col, heads]),
            ),
        ),
        shape=(count + 1, count + 1),
    )
    above = breadth_first_order(joined.tocsr(), count, directed=False)[1]
    above[heads] = heads
    above = above[:count]
    # Differences to the face above, summed up to the head by doubling the stride.
    differ, leap = _wrapped(angles - angles[above]), above
    while (leap != leap[leap]).any():
        differ, leap = differ + differ[leap], leap[leap]
    result = angles + turn * np.round((angles[leap] + differ - angles) / turn)
    total = np.bincount(part, weights, members)
    mean = np.bincount(part, weights * result, members) / np.where(total > 0, total, 1.0)
    # 1e-9 is far above rounding and far below any turn that shows.
    return np.asarray(result - turn * np.ceil((mean - np.pi) / turn - 1e-9)[part])


def _wrapped(angles: Floats) -> Floats:
    """The same directions in [-pi, pi)."""
    return np.asarray((angles + np.pi) % (2 * np.pi) - np.pi)
