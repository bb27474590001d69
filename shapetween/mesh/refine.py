"""More quads than a search finds: those that span the shape are split across."""

import numpy as np

from shapetween.base.arrays import Index
from shapetween.mesh.contour import Contours, rounded
from shapetween.mesh.quality import face_figures

__all__ = ["with_split_quads"]


def with_split_quads(contours: Contours, quads: Index, triangles: Index, wanted: int) -> Index:
    """Halve quads that have two opposite sides on the outline, the longest first.

    Parameters
    ----------
    contours : Contours
    quads, triangles : (Q, 4), (T, 3) intp
        Faces whose corners are samples.
    wanted : int
        How many quads to stop at; also where no half would move well.

    Returns
    -------
    (W, 4) intp
        Quads, corners as samples.
    """
    total = len(contours)
    while len(quads) < wanted:
        nodes = np.unique(np.concatenate([quads.ravel(), triangles.ravel()]))
        after = np.roll(nodes, -1)[np.searchsorted(nodes, quads)]
        gap = (np.roll(quads, -1, axis=1) - quads) % total
        on_outline = (after == np.roll(quads, -1, axis=1)) & (gap > 1)
        # Every quad seen from both of its pairs of sides: a-b and c-d on the outline.
        sides = np.concatenate([quads, np.roll(quads, -1, axis=1)])
        spanning = np.concatenate([on_outline[:, ::2].all(axis=1), on_outline[:, 1::2].all(axis=1)])
        a, b, c, d = sides.T
        p, q = ((first + (last - first) % total // 2) % total for first, last in ((a, b), (c, d)))
        halves = np.stack([np.stack([a, p, q, d], axis=1), np.stack([p, b, c, q], axis=1)])
        fit = spanning & face_figures(contours.points[:, halves]).usable.all(axis=0)
        if not fit.any():
            break
        along = contours.points[:, np.stack([b, c])] - contours.points[:, np.stack([a, d])]
        length = np.sqrt((along**2).sum(-1)).sum(axis=0).min(axis=0)  # of the shorter side
        best = int(np.where(fit, rounded(length), -1.0).argmax())
        others = np.delete(quads, best % len(quads), axis=0)
        quads = np.concatenate([others, halves[:, best]])
    return quads
