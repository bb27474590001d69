"""Nodes slid along their outlines until the faces round them are as good as they can be."""

import numpy as np

from shapetween.arrays import Floats, Index, Mask, Points
from shapetween.meshing.contour import Contours, arc_waste
from shapetween.meshing.quality import face_figures
from shapetween.meshing.search import quad_prices, side_prices, triangle_prices

__all__ = ["slid"]

#: Moves tried, as shares of the outline. More and longer ones cost time and change little.
STEPS = np.array([1, 2, 4, 8, 16]) / 512

#: Most sweeps over all nodes. Few need more than three.
SWEEPS = 5

#: Price of taking a node off a corner of an outline.
CORNER_PRICE = 0.5


def _face_prices(corners: Points) -> Floats:
    price = quad_prices if corners.shape[-2] == 4 else triangle_prices
    return price(face_figures(corners))


def slid(contours: Contours, corners: Mask, nodes: Index, quads: Index, triangles: Index) -> Index:
    """Move nodes along both contours at once, order kept.

    Parameters
    ----------
    contours : Contours
    corners : (N,) bool
        Samples that nodes had better stay on.
    nodes : (n,) intp
        Increasing samples.
    quads, triangles : (Q, 4), (T, 3) intp
        Faces over the nodes' numbers.

    Returns
    -------
    (n,) intp
        The same nodes' samples; cyclically increasing, though the first may have gone past 0.
    """
    total, count = len(contours), len(nodes)
    steps = np.unique(np.round(STEPS * total).astype(np.intp))
    steps = np.concatenate([[0], np.stack([-steps, steps], axis=1).ravel()])
    nodes = nodes.copy()
    around = [
        [faces[(faces == node).any(axis=1)] for faces in (quads, triangles)]
        for node in range(count)
    ]
    moved = np.ones(count, dtype=bool)
    for _ in range(SWEEPS):
        stirred, moved = moved, np.zeros(count, dtype=bool)
        for node in range(count):
            touching = np.unique(np.concatenate([f.ravel() for f in around[node]]))
            if not stirred[touching].any() and not moved[touching].any():
                continue
            before, after = int(nodes[node - 1]), int(nodes[(node + 1) % count])
            back = (int(nodes[node]) - before) % total
            ahead = (after - int(nodes[node])) % total
            tried = steps[(steps > -back) & (steps < ahead)]
            places = (nodes[node] + tried) % total
            price = side_prices(arc_waste(contours, np.full_like(places, before), places))
            price += side_prices(arc_waste(contours, places, np.full_like(places, after)))
            price -= CORNER_PRICE * corners[places]
            for faces in around[node]:
                if len(faces):
                    samples = np.where(faces == node, places[:, None, None], nodes[faces])
                    price += _face_prices(contours.points[:, samples]).sum(axis=-1)
            best = int(np.argmin(price))
            if best and price[best] < price[0] - 1e-9:
                nodes[node] = places[best]
                moved[node] = True
        if not moved.any():
            break
    return nodes
