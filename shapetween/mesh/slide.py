"""Nodes slid along their outlines until the faces round them are as good as they can be."""

import numpy as np

from shapetween.base.arrays import Floats, Index
from shapetween.mesh.contour import Contours, arc_waste
from shapetween.mesh.prices import quad_prices, side_prices, triangle_prices
from shapetween.mesh.quality import face_figures

__all__ = ["slid"]

#: Moves tried, as shares of the outline. More and longer ones cost time and change little.
STEPS = np.array([1, 2, 4, 8, 16]) / 512

#: Most sweeps over all nodes. Few meshes need more than ten.
SWEEPS = 20

#: Least gain a node is moved for, in quads; smaller gains cost sweeps and cannot be seen.
LEAST_GAIN = 0.01


def slid(contours: Contours, pull: Floats, nodes: Index, quads: Index, triangles: Index) -> Index:
    """Move nodes along both contours at once, order kept.

    Parameters
    ----------
    contours : Contours
    pull : (N,) float64
        Price it is worth for a node to be on each sample.
    nodes : (n,) intp
        Increasing samples.
    quads, triangles : (Q, 4), (T, 3) intp
        Faces over the nodes' numbers.

    Returns
    -------
    (n,) intp
        The same nodes' samples; cyclically increasing, though the first may have gone past 0.

    Notes
    -----
    A sweep prices all moves of all nodes at once and makes the best ones that share no face.
    """
    total, count = len(contours), len(nodes)
    steps = np.unique(np.round(STEPS * total).astype(np.intp))
    steps = np.concatenate([[0], np.stack([-steps, steps], axis=1).ravel()])
    together = np.eye(count, dtype=bool)
    for faces in (quads, triangles):
        together[faces[:, :, None], faces[:, None, :]] = True
    nodes = nodes.copy()
    price = np.zeros((count, len(steps)))
    stale = np.ones(count, dtype=bool)  # nodes whose prices a move has changed
    for _ in range(SWEEPS):
        places = (nodes[:, None] + steps) % total
        here, tried = nodes[stale, None], places[stale]
        before = nodes[np.flatnonzero(stale) - 1][:, None]
        after = nodes[(np.flatnonzero(stale) + 1) % count][:, None]
        ends = np.stack(np.broadcast_arrays(before, tried, after))
        to, on = side_prices(arc_waste(contours, ends[:2], ends[1:]))
        price[stale] = to + on - pull[tried]
        for faces, prices in ((quads, quad_prices), (triangles, triangle_prices)):
            face, corner = np.nonzero(stale[faces])
            if not len(face):
                continue
            moved = faces[face, corner]
            samples = np.repeat(nodes[faces[face]][:, None], len(steps), axis=1)  # (M, steps, K)
            samples[np.arange(len(face)), :, corner] = places[moved]
            figures = face_figures(contours.points.take(samples, axis=1))
            np.add.at(price, moved, prices(figures))
        blocked = (steps <= -((here - before) % total)) | (steps >= (after - here) % total)
        price[stale] = np.where(blocked, np.inf, price[stale])

        best = price.argmin(axis=1)
        gain = price[:, 0] - price.min(axis=1)
        free = gain > LEAST_GAIN
        if not free.any():
            break
        stale[:] = False
        for node in np.argsort(-gain, kind="stable").tolist():
            if free[node]:
                nodes[node] = places[node, best[node]]
                free &= ~together[node]
                stale |= together[node]
    return nodes
