"""Simple polygons: which sides touch, which diagonals stay inside, and triangulations.

Everything here is strict: whatever touches, to rounding, counts as crossing. Polygons run
clockwise as drawn and have an area of about 1.
"""

import numpy as np

from shapetween.base.arrays import Floats, Index, Mask, Points
from shapetween.geometry.polygon import cross

__all__ = ["cheapest_triangulation", "inner_diagonals", "touching_sides"]

#: How far off a line a point may be, as a share of the shape's size, and still count as on it: a
#: few thousand roundings. Larger, and thin slits count as closed; smaller, and the rounding of
#: samples on a straight side is taken for a bend.
IN_LINE = 1e-12


def _strict(turns: Floats, ring: Points) -> Floats:
    """Turns (twice an area) with 0 where the points are in line."""
    return np.where(abs(turns) <= IN_LINE * np.ptp(ring, axis=0).max(), 0.0, turns)


def _products(ring: Points) -> Floats:
    """Cross products of all corners i, k, of which three add up to a turn, (n, n)."""
    x = ring - ring.mean(axis=0)
    return cross(x[:, None], x[None])


def _turns(ring: Points) -> Floats:
    """Twice the area of i, j, k for all corners, (n, n, n); 0 where they are in line."""
    product = _products(ring)
    return _strict(product[:, :, None] + product[None] - product[:, None, :], ring)


def _apart(ring: Points, i: Index, j: Index, turns: Floats, by_side: Floats) -> Mask:
    """Which of some pairs of corners do not touch the side k to k + 1, (K, n).

    Parameters
    ----------
    ring : (n, 2) float64
    i, j : (K,) intp
    turns : (K, n) float64
        Turns of i, j and every corner.
    by_side : (n, n) float64
        Turns of every side and every corner.
    """
    one_side = turns * np.roll(turns, -1, axis=1) > 0
    other = (by_side[:, i] * by_side[:, j] > 0).T
    apart = one_side | other
    following = np.roll(ring, -1, axis=0)
    for here, there in zip(ring.T, following.T, strict=True):  # boxes that do not meet
        apart |= np.minimum(here[i], here[j])[:, None] > np.maximum(here, there)
        apart |= np.maximum(here[i], here[j])[:, None] < np.minimum(here, there)
    return np.asarray(apart)


def touching_sides(ring: Points) -> Mask:
    """Which sides of a polygon touch another one, other than at a common corner, (n,)."""
    count = len(ring)
    own = np.arange(count)
    start, step = ring, np.roll(ring, -1, axis=0) - ring
    from_side = _strict(cross(step[:, None], start[None] - start[:, None]), ring)  # (side, corner)
    apart = from_side * np.roll(from_side, -1, axis=1) > 0
    end = start + step
    low, high = np.minimum(start, end), np.maximum(start, end)
    boxes = (low[:, None] > high[None]).any(axis=-1)
    apart |= apart.T | boxes | boxes.T
    apart[own, own] = apart[own, own - 1] = apart[own - 1, own] = True
    ahead = np.roll(step, -1, axis=0)
    back = (_strict(cross(step, ahead), ring) == 0) & ((step * ahead).sum(-1) <= 0)
    return np.asarray(~apart.all(axis=1) | back | np.roll(back, 1))


def inner_diagonals(ring: Points) -> Mask:
    """Which pairs of corners of a simple polygon are joined by a diagonal strictly inside, (n, n).

    Neighbours are not.
    """
    count = len(ring)
    product = _products(ring)
    own = np.arange(count)
    after, before = (own + 1) % count, own - 1
    by_side = _strict(product[own, after][:, None] + product[after] - product, ring)
    left = by_side > 0  # (corner, other): other is left of the side that leaves
    right = left[before]
    convex = by_side[before, after] > 0
    cone = np.where(convex[:, None], left & right, left | right)
    inside = np.triu(cone & cone.T, 2)
    inside[0, -1] = False
    i, j = np.nonzero(inside)
    turns = _strict(product[i, j][:, None] + product[j] - product[i], ring)
    apart = _apart(ring, i, j, turns, by_side)
    pair = np.arange(len(i))
    for k in (i, j):  # sides at either end meet the diagonal there, and no more by `cone`
        apart[pair, k] = apart[pair, before[k]] = True
    inside[i, j] = apart.all(axis=1)
    return np.asarray(inside | inside.T)


def cheapest_triangulation(ring: Points, allowed: Mask, price: Floats) -> Index:
    """Diagonals of the triangulation with the least sum of prices; of those the best shaped.

    Parameters
    ----------
    ring : (n, 2) float64
        Simple polygon.
    allowed : (n, n) bool
        Its inner diagonals.
    price : (n, n) float64
        Price of each.

    Returns
    -------
    (n - 3, 2) intp
        Pairs ``i < j``; empty if there is no triangulation.
    """
    count = len(ring)
    i, k = np.arange(count)[:, None, None], np.arange(count)[None, :, None]
    turns = _turns(ring)
    size = np.sqrt(((ring[:, None] - ring[None]) ** 2).sum(-1))
    longest = np.maximum(np.maximum(size[:, :, None], size[None]), size[:, None, :])
    # Twice the area over the longest side squared: 0 for a sliver, under 1. All triangles
    # together cost less than 1e-3, so that prices come first.
    shape = (1 - turns / np.where(longest > 0, longest, 1.0) ** 2) * (1e-3 / count)
    shape = np.where((turns > 0) & (i < k), shape, np.inf)
    link = np.where(allowed, price, np.inf)
    own = np.arange(count)
    link[own[:-1], own[1:]] = 0
    link[0, -1] = 0
    least = np.full((count, count), np.inf)
    least[own[:-1], own[1:]] = 0
    choice = np.zeros((count, count), dtype=np.intp)
    for length in range(2, count):
        first = np.arange(count - length)
        last = first + length
        middle = first[:, None] + np.arange(1, length)
        total = (
            least[first[:, None], middle]
            + least[middle, last[:, None]]
            + shape[first[:, None], middle, last[:, None]]
        )
        best = total.argmin(axis=1)
        choice[first, last] = first + 1 + best
        least[first, last] = total[first, best] + link[first, last]
    if not np.isfinite(least[0, -1]):
        return np.zeros((0, 2), dtype=np.intp)
    found, stack = [], [(0, count - 1)]
    while stack:
        a, b = stack.pop()
        apex = int(choice[a, b])
        for pair in ((a, apex), (apex, b)):
            if pair[1] - pair[0] > 1:
                found.append(pair)
                stack.append(pair)
    return np.array(sorted(found), dtype=np.intp).reshape(-1, 2)
