"""The cheapest way to cut a polygon into quads and triangles by chords between its corners.

Corners are numbered 0 to n - 1 along the polygon. A link is a pair ``i < j`` that may bound a
face: a *side*, which lies on the outline and may skip corners between i and j, or a *chord* with
faces on both sides of it. F[i, j] is the least cost of all that lies between i and j::

    inner[i, j] = min over faces (i, k, l, j) and (i, k, j) of  face + F of each further link
    F[i, j]     = min(side[i, j], chord[i, j] + inner[i, j])

so that the search chooses the corners along with the faces.
"""

from dataclasses import dataclass

import numpy as np

from shapetween.arrays import Floats, Index, Mask

__all__ = ["Dissection", "dissect", "linked_faces"]


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


def linked_faces(links: Mask, lids: Mask) -> tuple[Index, Index]:
    """All triangles and all chains of three links whose ends may be joined.

    Parameters
    ----------
    links, lids : (n, n) bool
        Pairs ``i < j`` that may be a face's side away from, and towards, the polygon's end.

    Returns
    -------
    triangles : (T, 3) intp
    chains : (C, 3) intp
        i, k, l with links i-k and k-l: beginnings of quads, to be sifted and then given to
        `completed_quads`.
    """
    links = np.triu(links, 1)
    first, middle = np.nonzero(links)
    degree = links.sum(axis=1)
    begin = np.cumsum(degree) - degree
    group, nth = _expand(degree[middle])
    chains = np.stack([first[group], middle[group], middle[begin[middle[group]] + nth]], axis=1)
    return chains[lids[chains[:, 0], chains[:, 2]]], chains


def completed_quads(chains: Index, links: Mask, lids: Mask) -> Index:
    """Quads i, k, l, j of chains i, k, l with a link l-j and a lid i-j, (Q, 4)."""
    links = np.triu(links, 1)
    degree = links.sum(axis=1)
    begin = np.cumsum(degree) - degree
    last = np.nonzero(links)[1]
    group, nth = _expand(degree[chains[:, 2]])
    end = last[begin[chains[group, 2]] + nth]
    kept = lids[chains[group, 0], end]
    return np.concatenate([chains[group[kept]], end[kept, None]], axis=1)


class _Group:
    """Faces of one kind, sorted by the pair of their first and last corner."""

    def __init__(self, faces: Index, costs: Floats, count: int) -> None:
        self.count = count
        length = faces[:, -1] - faces[:, 0]
        order = np.lexsort((faces[:, 0], length))
        self.faces, self.costs = faces[order], costs[order]
        self.links = self.faces[:, :-1] * count + self.faces[:, 1:]
        key = length[order] * count + self.faces[:, 0]
        self.starts = np.flatnonzero(np.diff(key, prepend=-1))
        self.keys = key[self.starts]
        self.ends = np.append(self.starts[1:], len(key))
        self.by_length = np.searchsorted(self.keys, np.arange(count + 1) * count)

    def lower(self, length: int, least: Floats, inner: Floats) -> None:
        """Lower inner[i, i + length] to the cheapest face of this kind."""
        low, high = self.by_length[length], self.by_length[length + 1]
        if low == high:
            return
        span = slice(self.starts[low], self.ends[high - 1])
        total = self.costs[span] + least[self.links[span]].sum(axis=1)
        best = np.minimum.reduceat(total, self.starts[low:high] - span.start)
        first = self.keys[low:high] - length * self.count
        np.minimum.at(inner, (first, first + length), best)

    def cheapest(self, first: int, last: int, least: Floats) -> tuple[float, Index]:
        """Cost and corners of the cheapest face with these two ends."""
        key = (last - first) * self.count + first
        at = int(np.searchsorted(self.keys, key))
        if at == len(self.keys) or self.keys[at] != key:
            return np.inf, self.faces[:0]
        span = slice(self.starts[at], self.ends[at])
        total = self.costs[span] + least[self.links[span]].sum(axis=1)
        best = int(np.argmin(total))
        return float(total[best]), self.faces[span][best]


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
    least = np.triu(sides, 1)
    least[np.tril_indices(count)] = np.inf
    inner = np.full((count, count), np.inf)
    groups = [_Group(faces, costs, count) for faces, costs in (quads, triangles) if len(faces)]
    flat = least.reshape(-1)
    for length in range(1, count):
        for group in groups:
            group.lower(length, flat, inner)
        first = np.arange(count - length)
        last = first + length
        least[first, last] = np.minimum(
            least[first, last], chords[first, last] + inner[first, last]
        )

    root = closing + inner[:, -1]
    start = int(np.argmin(root))
    chosen: dict[int, list[Index]] = {4: [], 3: []}
    if not np.isfinite(root[start]):
        return Dissection(np.zeros((0, 4), np.intp), np.zeros((0, 3), np.intp), np.inf)
    stack = [(start, count - 1)]
    while stack:
        ends = stack.pop()
        _, face = min((g.cheapest(*ends, flat) for g in groups), key=lambda found: found[0])
        chosen[len(face)].append(face)
        for i, j in zip(face[:-1].tolist(), face[1:].tolist(), strict=True):
            if chords[i, j] + inner[i, j] < sides[i, j]:
                stack.append((i, j))
    return Dissection(
        np.array(chosen[4], dtype=np.intp).reshape(-1, 4),
        np.array(chosen[3], dtype=np.intp).reshape(-1, 3),
        float(root[start]),
    )
