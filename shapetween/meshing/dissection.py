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

from shapetween.arrays import Floats, Index, Mask

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


def _expand(counts: Index) -> tuple[Index, Index]:
    """Which group every member is of, and its place in it, for groups of given sizes."""
    group = np.repeat(np.arange(len(counts)), counts)
    return group, np.arange(len(group)) - np.repeat(np.cumsum(counts) - counts, counts)


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
    links = np.triu(links, 1)
    first, middle = np.nonzero(links)
    degree = links.sum(axis=1)
    begin = np.cumsum(degree) - degree
    group, nth = _expand(degree[middle])
    at = middle[group]
    return np.stack([first[group], at, middle[begin[at] + nth]])


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
    first, nth = _expand(starts[link])
    second = begin[link][first] + nth
    kept = lids[chains[0][first], chains[2][second]]
    return first[kept], second[kept]


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
    faces, costs, starts, keys = _by_ends(quads, triangles, count)
    links = faces[:-1] * count + faces[1:]  # (3, F)
    ends = np.append(starts[1:], len(costs))
    by_length = np.searchsorted(keys, np.arange(count + 1) * count).tolist()

    least = np.triu(sides, 1)
    least[np.tril_indices(count, -1)] = np.inf  # and 0 from a corner to itself
    inner = np.full((count, count), np.inf)
    flat_least, flat_inner, flat_chords = least.ravel(), inner.ravel(), chords.ravel()
    for length in range(1, count):
        diagonal = slice(length, (count - length) * count, count + 1)  # all i, i + length
        low, high = by_length[length], by_length[length + 1]
        if low < high:
            span = slice(starts[low], ends[high - 1])
            total = costs[span].copy()
            for link in links[:, span]:
                total += flat_least[link]
            first = keys[low:high] - length * count
            flat_inner[first * (count + 1) + length] = np.minimum.reduceat(
                total, starts[low:high] - span.start
            )
        within = flat_chords[diagonal] + flat_inner[diagonal]
        flat_least[diagonal] = np.minimum(flat_least[diagonal], within)

    root = closing + inner[:, -1]
    start = int(np.argmin(root))
    if not np.isfinite(root[start]):
        return Dissection(np.zeros((0, 4), np.intp), np.zeros((0, 3), np.intp), np.inf)
    chosen = []
    stack = [(start, count - 1)]
    while stack:
        i, j = stack.pop()
        at = int(np.searchsorted(keys, (j - i) * count + i))
        span = slice(starts[at], ends[at])
        total = costs[span] + flat_least[links[:, span]].sum(axis=0)
        face = faces[:, span.start + int(np.argmin(total))]
        chosen.append(face)
        stack += [
            link for link in pairwise(face.tolist()) if chords[link] + inner[link] < sides[link]
        ]
    found = np.array(chosen)
    three = found[:, 1] == found[:, 2]
    return Dissection(found[~three], found[three][:, [0, 1, 3]], float(root[start]))


def _by_ends(
    quads: tuple[Index, Floats], triangles: tuple[Index, Floats], count: int
) -> tuple[Index, Floats, Index, Index]:
    """Faces sorted by the distance of their first and last corner, and then by the first.

    Returns
    -------
    faces : (4, F) intp
        Triangles have their second corner twice.
    costs : (F,) float64
    starts, keys : (E,) intp
        Where faces with other ends begin, and (j - i) * count + i of these ends i, j.
    """
    faces = np.concatenate([quads[0], triangles[0][:, [0, 1, 1, 2]]]).T
    key = (faces[3] - faces[0]) * count + faces[0]
    # Numbers of two bytes are sorted by counting, ten times quicker.
    order = np.argsort(key.astype(np.min_scalar_type(count * count)), kind="stable")
    key = key[order]
    starts = np.flatnonzero(np.diff(key, prepend=-1))
    return (
        faces.take(order, axis=1),
        np.concatenate([quads[1], triangles[1]])[order],
        starts,
        key[starts],
    )
