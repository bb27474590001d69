"""Samples of two matched contours that may become nodes of their mesh.

.. [DP73] D. Douglas, T. Peucker, "Algorithms for the reduction of the number of points required to
   represent a digitized line", Cartographica 10(2), 1973.
"""

import heapq
from collections.abc import Iterator
from itertools import pairwise

import numpy as np

from shapetween.base.arrays import Floats, Index, Mask, Points
from shapetween.mesh.contour import rounded

__all__ = ["candidate_nodes", "far_sample", "opposite_feet", "simplified"]

#: Share of the candidates that outline the shapes; the rest face them across limbs. More, and
#: limbs have no ribs to be meshed across with; fewer, and bends are cut short.
OUTLINING = 0.62

#: How much further from its chord a corner counts than any other sample, so that nodes lie on
#: corners; much larger, and small corners win over large curves.
CORNER_BONUS = 1.25

#: Nearest a foot may come to another candidate, in mean distances between candidates. Smaller,
#: and feet crowd where candidates are already; larger, and thin limbs lose their ribs.
FOOT_CLEARANCE = 0.45

#: Radius of discs as large as any that matter, where a shape has an area of 1.
FAR = 1e3


def far_sample(points: Points) -> int:
    """Sample furthest from the middle in both contours together: a place both can agree on.

    It does not depend on where the samples start, nor on the turn of either contour.
    """
    step = np.sqrt(((np.roll(points, -1, axis=1) - points) ** 2).sum(-1))
    weight = step + np.roll(step, 1, axis=1)
    middle = (points * weight[..., None]).sum(axis=1) / weight.sum(axis=1)[:, None]
    return int(np.argmax(rounded(((points - middle[:, None]) ** 2).sum(axis=(0, -1)))))


def _splits(ends: tuple[int, int]) -> bool:
    """Whether there are samples between two."""
    return ends[1] - ends[0] > 1


def _furthest(
    curve: Floats, weight: Floats, first: Index, last: Index
) -> Iterator[tuple[float, int]]:
    """How far the furthest sample of each of many spans is from its chord, and which it is.

    Parameters
    ----------
    curve : (D, N) float64
        Samples in D dimensions.
    weight : (N,) float64
        How much each sample's distance counts.
    first, last : (S,) intp
        Ends of the spans, with at least one sample strictly between them.
    """
    inside = last - first - 1
    begin = np.cumsum(inside) - inside
    span = np.repeat(np.arange(len(first)), inside)
    sample = np.arange(len(span)) + (first + 1 - begin)[span]
    start = curve.take(first, axis=1)
    along = curve.take(last, axis=1) - start
    size = (along**2).sum(axis=0)
    offset = curve.take(sample, axis=1) - start.take(span, axis=1)
    share = (offset * (along / np.where(size > 0, size, 1.0)).take(span, axis=1)).sum(axis=0)
    offset -= np.minimum(np.maximum(share, 0.0), 1.0) * along.take(span, axis=1)
    score = rounded(np.sqrt((offset**2).sum(axis=0)) * weight[sample])
    best = np.maximum.reduceat(score, begin)
    reached = np.flatnonzero(score == best[span])
    earliest = reached[np.searchsorted(span[reached], np.arange(len(first)))]
    return zip(best.tolist(), sample[earliest].tolist(), strict=True)


def simplified(points: Points, corners: Mask, count: int, kept: Index | None = None) -> Index:
    """Up to `count` samples that outline both contours best, furthest first [DP73]_.

    The matched pair is one closed curve in four dimensions, and simplified as one.

    Parameters
    ----------
    points : (2, N, 2) float64
    corners : (N,) bool
        Samples to prefer.
    count : int
        At least 3.
    kept : (K,) intp, optional
        Samples to begin with; by default that of `far_sample`.

    Returns
    -------
    (M,) intp
        Those kept first; M is `count` unless there are fewer samples or more are kept.
    """
    total = points.shape[1]
    chosen = [far_sample(points)] if kept is None else kept.tolist()
    if len(chosen) >= count:
        return np.array(chosen, dtype=np.intp)
    # Gone round twice, so that every span is a slice.
    curve = np.tile(np.concatenate([points[0], points[1]], axis=-1).T, 2)
    bonus = np.tile(np.where(corners, CORNER_BONUS, 1.0), 2)
    ring = sorted(chosen)
    due = list(pairwise([*ring, ring[0] + total]))
    splits: dict[tuple[int, int], tuple[float, int]] = {}
    heap: list[tuple[float, int, int, int]] = []
    while len(chosen) < count:
        if any(_splits(ends) and ends not in splits for ends in due):
            # One call measures whatever may be due next as well.
            halves = [half for _, a, b, c in heap for half in ((a, b), (b, c))]
            new = [ends for ends in due + halves if _splits(ends) and ends not in splits]
            splits.update(zip(new, _furthest(curve, bonus, *np.array(new).T), strict=True))
        for first, last in filter(_splits, due):
            score, middle = splits[first, last]
            heapq.heappush(heap, (-score, first, middle, last))
        if not heap:
            break
        _, first, middle, last = heapq.heappop(heap)
        chosen.append(middle % total)
        due = [(first, middle), (middle, last)]
    return np.array(chosen, dtype=np.intp)


def opposite_feet(points: Points, nodes: Index) -> tuple[Index, Floats]:
    """Where the largest disc that touches a contour at a node, inside, touches it again.

    Parameters
    ----------
    points : (2, N, 2) float64
    nodes : (n,) intp

    Returns
    -------
    feet : (2, n) intp
        Samples, in each contour.
    radii : (2, n) float64
        The discs' radii.
    """
    tangent = np.roll(points, -1, axis=1) - np.roll(points, 1, axis=1)
    tangent = tangent[:, nodes]
    size = np.sqrt((tangent**2).sum(-1))
    tangent = tangent / np.where(size > 0, size, 1.0)[..., None]
    # From each node to all samples, x and y alone, (2, n, N).
    x, y = (place[:, None] - place[:, nodes, None] for place in np.moveaxis(points, -1, 0))
    inward = tangent[:, :, :1] * y - tangent[:, :, 1:] * x
    square = x * x + y * y
    ahead = inward > 1e-6 * np.sqrt(square)
    radii = np.where(ahead, square / np.where(ahead, 2 * inward, 1.0), np.inf)
    around = (nodes[:, None] + np.arange(-2, 3)) % points.shape[1]
    radii = rounded(np.minimum(radii, FAR))
    np.put_along_axis(radii, np.broadcast_to(around, (2, *around.shape)), np.inf, axis=2)
    feet = radii.argmin(axis=2)
    return feet, np.take_along_axis(radii, feet[..., None], axis=2)[..., 0]


def candidate_nodes(points: Points, corners: Mask, count: int, kept: Index | None = None) -> Index:
    """Up to `count` samples that outline the contours, and then samples across limbs from them.

    Parameters
    ----------
    points : (2, N, 2) float64
        Matched contours of area 1, clockwise as drawn.
    corners : (N,) bool
    count : int
    kept : (K,) intp, optional
        Samples that are candidates for certain, most important first.

    Returns
    -------
    (M,) intp
        Most important first.
    """
    total = points.shape[1]
    nodes = simplified(points, corners, max(4, round(OUTLINING * count)), kept)
    feet, radii = opposite_feet(points, nodes)
    clearance = FOOT_CLEARANCE * total / count
    taken = nodes.tolist()
    near = np.arange(-int(clearance), int(clearance) + 1)
    crowded = np.zeros(total, dtype=bool)
    crowded[(nodes[:, None] + near) % total] = True
    thinnest_first = np.argsort(radii, axis=None, kind="stable")
    for foot in feet.ravel()[thinnest_first].tolist():
        if not crowded[foot]:
            taken.append(foot)
            crowded[(foot + near) % total] = True
        if len(taken) >= count:
            break
    return simplified(points, corners, count, np.array(taken, dtype=np.intp))
