"""The cheapest way to cut a polygon into quads and triangles by chords between its corners.

Corners are numbered 0 to n - 1 along the polygon. A link is a pair ``i < j`` that may bound a
face: a *side*, which lies on the outline and may skip corners between i and j, or a *chord* with
faces on both sides of it. F[i, j] is the least cost of all that lies between i and j::

    inner[i, j] = min over faces (i, k, l, j) and (i, k, j) of  face + F of each further link
    F[i, j]     = min(side[i, j], chord[i, j] + inner[i, j])

so that the search chooses the corners along with the faces.
"""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from shapetween.base.arrays import Floats, Index, Mask

__all__ = ["Dissection", "dissect", "joined_chains", "linked_chains"]


@dataclass(frozen=True, slots=True, eq=False)
class Dissection:
    """Faces of the cheapest dissection.

    Attributes
    ----------
    quads : (Q, 4) intp
        Corners in increasing order.
    triangles : (T, 3) intp
    cost : float
        Infinite where there is no dissection; then there are no faces.
    """

    quads: Index
    triangles: Index
    cost: float


def linked_chains(links: Mask) -> Index:
    """All chains of two links.

    Parameters
    ----------
    links : (n, n) bool
        Pairs ``i < j`` that may be a face's side away from the polygon's end.

    Returns
    -------
    (3, C) intp
        i, k, l with links i-k and k-l, in lexicographic order.
    """
    first, middle = np.nonzero(np.triu(links, 1))
    degree = np.bincount(first, minlength=len(links))
    begin = np.cumsum(degree) - degree
    followers = degree[middle]
    second = np.repeat(begin[middle] - np.cumsum(followers) + followers, followers)
    second += np.arange(len(second))
    return np.stack([np.repeat(first, followers), np.repeat(middle, followers), middle[second]])


def joined_chains(chains: Index, lids: Mask) -> tuple[Index, Index]:
    """Chains i, k, l and k, l, j that make a quad i, k, l, j together, with a lid i-j.

    Parameters
    ----------
    chains : (3, C) intp
        Those that may be part of a quad, in lexicographic order.
    lids : (n, n) bool
        Pairs ``i < j`` that may be a face's side towards the polygon's end.

    Returns
    -------
    first, second : (Q,) intp
        Numbers of the chains, in lexicographic order of the quads.
    """
    count = len(lids)
    starts = np.bincount(chains[0] * count + chains[1], minlength=count * count)
    begin = np.cumsum(starts) - starts
    link = chains[1] * count + chains[2]
    followers = starts[link]
    second = np.repeat(begin[link] - np.cumsum(followers) + followers, followers)
    second += np.arange(len(second))
    ends = np.repeat(chains[0] * count, followers)
    ends += chains[2][second]
    kept = np.flatnonzero(lids.ravel()[ends])
    return np.repeat(np.arange(len(link)), followers)[kept], second[kept]


def dissect(
    sides: Floats,
    chords: Floats,
    closing: Floats,
    quads: tuple[Index, Floats],
    triangles: tuple[Index, Floats],
) -> Dissection:
    """Cut a polygon into the cheapest faces.

    Parameters
    ----------
    sides, chords : (n, n) float64
        Cost of a pair ``i < j`` as a side, as a chord; infinite where it may not be one.
    closing : (n,) float64
        Cost of the side from the last corner round to each corner; the last corner is always kept.
    quads, triangles : (faces, costs)
        All faces that may be used, corners increasing, (Q, 4) and (T, 3), with their costs.

    Notes
    -----
    One array operation for each distance j - i. Ties go to the first face in the given order.
    """
    count = len(sides)
    faces, costs = _as_quads(*quads, *triangles)
    links = faces[:-1] * count + faces[1:]  # (3, F)
    # Sorted by the distance of their ends, and then by the first. Numbers of two bytes are sorted
    # by counting, ten times quicker.
    key = (faces[3] - faces[0]) * count + faces[0]
    order = np.argsort(key.astype(np.min_scalar_type(count * count)), kind="stable")
    key, costs, links = key[order], costs[order], links.take(order, axis=1)
    begin = np.flatnonzero(np.diff(key, prepend=-1))  # where faces with other ends begin
    end = np.append(begin[1:], len(key))
    ends = key[begin]
    lids = ends // count + ends % count * (count + 1)  # as places in the flat arrays
    by_length = np.searchsorted(ends, np.arange(count + 1) * count).tolist()

    least = np.triu(sides, 1)
    least[np.tril_indices(count, -1)] = np.inf  # and 0 from a corner to itself
    inner = np.full((count, count), np.inf)
    flat_least, flat_inner, flat_chords = least.ravel(), inner.ravel(), chords.ravel()
    for length in range(1, count):
        low, high = by_length[length], by_length[length + 1]
        if low == high:
            continue
        start, stop = begin[low], end[high - 1]
        total = costs[start:stop].copy()
        for link in links:
            total += flat_least[link[start:stop]]
        flat_inner[lids[low:high]] = np.minimum.reduceat(total, begin[low:high] - start)
        diagonal = slice(length, (count - length) * count, count + 1)  # all i, i + length
        within = flat_chords[diagonal] + flat_inner[diagonal]
        flat_least[diagonal] = np.minimum(flat_least[diagonal], within)

    root = closing + inner[:, -1]
    first = int(np.argmin(root))
    if not np.isfinite(root[first]):
        return Dissection(np.zeros((0, 4), np.intp), np.zeros((0, 3), np.intp), np.inf)
    chosen = []
    stack = [(first, count - 1)]
    while stack:
        i, j = stack.pop()
        at = int(np.searchsorted(ends, (j - i) * count + i))
        span = slice(begin[at], end[at])
        total = costs[span] + flat_least[links[:, span]].sum(axis=0)
        face = faces[:, order[span.start + int(np.argmin(total))]]
        chosen.append(face)
        stack += [
            link for link in pairwise(face.tolist()) if chords[link] + inner[link] < sides[link]
        ]
    found = np.array(chosen)
    three = found[:, 1] == found[:, 2]
    return Dissection(found[~three], found[three][:, [0, 1, 3]], float(root[first]))


def _as_quads(
    quads: Index, quad_costs: Floats, triangles: Index, triangle_costs: Floats
) -> tuple[Index, Floats]:
    """Quads, and triangles with their second corner taken twice, (4, Q + T), and their costs."""
    faces = np.concatenate([quads.T, triangles.T[[0, 1, 1, 2]]], axis=1)
    return faces, np.concatenate([quad_costs, triangle_costs])
