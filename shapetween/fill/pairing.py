"""Which of several things becomes which: pieces of one shape, and holes."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from shapetween.base.arrays import Floats, Points
from shapetween.geometry.assignment import cheapest_pairs

__all__ = ["Pairing", "Thing", "pair_things"]

#: What a move by the own size and a factor e in size cost. Distance counts most: what stays near
#: its place is seen as the same thing.
DISTANCE, SIZE = 1.0, 0.35

#: What a factor e in the ratio of width to height costs, and the least share of its size that a
#: thing is wide or high: a line's own width.
ASPECT, SLIM = 0.12, 0.1

#: Share of the drawing that a move is counted against beside the own size: how far a curve may go.
REACH = 0.15

#: What leaving one without a partner costs, and what a pair as large as the drawing saves beside
#: that. More, and unlike ones far apart become each other; less, and everything comes and goes.
LEFT, LARGE = 1.2, 0.6


@dataclass(frozen=True, slots=True, eq=False)
class Thing:
    """What a piece or hole is judged by.

    Attributes
    ----------
    centre : (2,) float64
    size : float
        A length: the root of its area, or of its box.
    aspect : float
        Logarithm of how much wider than high it is.
    """

    centre: Points
    size: float
    aspect: float = 0.0

    @classmethod
    def of(cls, points: Points) -> "Thing":
        """What a box about points (N, 2) is judged by."""
        low, high = points.min(axis=0), points.max(axis=0)
        width, height = (high - low).tolist()
        size = float(np.hypot(width, height))
        least = SLIM * size or 1.0
        return cls((low + high) / 2, size, math.log(max(width, least) / max(height, least)))


@dataclass(frozen=True, slots=True)
class Pairing:
    """Indices of what belongs together, and of what is left over on either side."""

    pairs: tuple[tuple[int, int], ...]
    first_only: tuple[int, ...]
    second_only: tuple[int, ...]


def pair_things(
    first: Sequence[Thing],
    second: Sequence[Thing],
    scale: float,
    fixed: Sequence[tuple[int, int]] = (),
    left: float = LEFT,
) -> Pairing:
    """Match what belongs together, at the least total cost of pairs and of what is left alone.

    At least one pair is made if both sides have anything.

    Parameters
    ----------
    first, second : sequence of Thing
    scale : float
        Length against which distances are measured.
    fixed : sequence of (int, int)
        Pairs that are fixed.
    left : float
        Cost of leaving one thing alone.
    """
    rows = [i for i in range(len(first)) if i not in {a for a, _ in fixed}]
    columns = [j for j in range(len(second)) if j not in {b for _, b in fixed}]
    pairs = list(fixed)
    if rows and columns:
        cost = _costs(first, second, scale)
        pairs += _cheapest(cost, rows, columns, left)
    pairs.sort()
    return Pairing(
        tuple(pairs),
        tuple(i for i in range(len(first)) if i not in {a for a, _ in pairs}),
        tuple(j for j in range(len(second)) if j not in {b for _, b in pairs}),
    )


def _costs(first: Sequence[Thing], second: Sequence[Thing], scale: float) -> Floats:
    """Cost of every pair by place and size, (len(first), len(second))."""
    sides = first, second
    centres = [np.array([t.centre for t in side]) for side in sides]
    sizes = [np.maximum([t.size for t in side], 1e-12 * scale) for side in sides]
    aspects = [np.array([t.aspect for t in side]) for side in sides]
    away = np.linalg.norm(centres[0][:, None] - centres[1], axis=-1)
    own = (sizes[0][:, None] + sizes[1]) / 2
    cost = DISTANCE * away / (own + REACH * scale)
    cost += ASPECT * np.abs(aspects[0][:, None] - aspects[1])
    cost += SIZE * np.abs(np.log(sizes[0][:, None] / sizes[1]))
    cost -= LARGE * np.minimum(np.minimum(sizes[0][:, None], sizes[1]) / scale, 1.0)
    return np.asarray(cost)


def _cheapest(
    every: Floats, rows: list[int], columns: list[int], left: float
) -> list[tuple[int, int]]:
    """Pairs of some rows and columns of the costs, as long as they cost less than to be alone."""
    if len(rows) == len(columns) == 1:
        return [(rows[0], columns[0])]
    cost = every[np.ix_(rows, columns)]
    # Every thing may also be left alone: a partner of its own for each, at that price.
    height, width = cost.shape
    table = np.full((height + width, height + width), np.inf)
    table[:height, :width] = cost
    table[np.arange(height), width + np.arange(height)] = left
    table[height + np.arange(width), np.arange(width)] = left
    table[height:, width:] = 0.0
    found = zip(*(k.tolist() for k in cheapest_pairs(table)), strict=True)
    chosen = [(i, j) for i, j in found if i < height and j < width]
    if not chosen:
        chosen = [divmod(int(cost.argmin()), width)]
    return [(rows[i], columns[j]) for i, j in chosen]
