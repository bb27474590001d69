"""Rotations of the plane: polar decomposition, in-between linear maps, angles without jumps.

.. [AM92] K. Shoemake, T. Duff, "Matrix animation and polar decomposition", GI 1992.
.. [CS03] J. Choi, A. Szymczak, "On coherent rotation angles for as-rigid-as-possible shape
   interpolation", CCCG 2003.
"""

import numpy as np

from shapetween.arrays import Floats, Index

__all__ = ["coherent_angles", "linear_between", "polar", "rotations"]


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


def coherent_angles(angles: Floats, neighbours: Index, weights: Floats) -> Floats:
    """Add whole turns so that neighbours differ by as little as they can.

    Parameters
    ----------
    angles : (N,) float64
        Each known up to whole turns.
    neighbours : (E, 2) intp
        Pairs of faces that meet.
    weights : (N,) float64
        Positive; how much a face counts when the turns of a component are fixed.

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
    turn = 2 * np.pi
    count = len(angles)
    result = np.array(angles, dtype=np.float64)
    first, second = neighbours.T
    step = np.remainder(angles[second] - angles[first] + np.pi, turn) - np.pi
    parent = np.arange(count)
    # Difference of each face to the root of its tree, kept up to date as trees join (Kruskal).
    offset = np.zeros(count)
    members: list[list[int]] = [[i] for i in range(count)]
    for edge in np.argsort(np.abs(step), kind="stable").tolist():
        i, j = int(first[edge]), int(second[edge])
        root, other = int(parent[i]), int(parent[j])
        if root == other:
            continue
        shift = offset[i] + step[edge] - offset[j]
        if len(members[root]) < len(members[other]):
            root, other, shift = other, root, -shift
        moved = members[other]
        offset[moved] += shift
        parent[moved] = root
        members[root] += moved
        members[other] = []
    for root, faces in enumerate(members):
        if not faces:
            continue
        result[faces] = angles[root] + offset[faces]
        mean = np.average(result[faces], weights=weights[faces])
        # 1e-9 is far above rounding and far below any turn that shows.
        result[faces] -= turn * np.ceil((mean - np.pi) / turn - 1e-9)
    return result
