"""The moves a path through a table of costs is made of, and what each of them costs."""

from collections.abc import Callable

import numpy as np

from shapetween.base.arrays import Floats, Index, Mask

__all__ = ["MOVES", "REACH", "move_prices", "steps_over", "tilt"]

#: Steps along (source, target), in samples. Slopes from 1/8 to 8; (2, 3) beside (1, 2) lets a
#: slope of 1.5 be even.
MOVES = (
    (1, 1),
    (1, 2),
    (2, 1),
    (2, 3),
    (3, 2),
    (1, 3),
    (3, 1),
    (1, 5),
    (5, 1),
    (1, 8),
    (8, 1),
)

#: Longest step of a move.
REACH = max(map(max, MOVES))

#: Cells each move passes, as steps back from where it ends; where it starts is not among them.
WAYS = tuple(
    tuple((q * di // max(di, dj), q * dj // max(di, dj)) for q in range(max(di, dj)))
    for di, dj in MOVES
)

#: The ways that no other one begins with: their steps, each with the move whose way it completes.
CHAINS = tuple(
    tuple(
        (step, WAYS.index(way[: k + 1]) if way[: k + 1] in WAYS else None)
        for k, step in enumerate(way)
    )
    for way in WAYS
    if sum(other[: len(way)] == way for other in WAYS) == 1
)

#: Price of every sample by which a move favours one outline; less invites needless slips.
SKEW_PRICE = 0.1

#: A slight tilt of the costs by cell number, in which no two paths are equal: symmetric shapes and
#: straight sides have equally cheap paths, between which rounding must not choose.
TILT = 1e-8


def tilt(rows: Index, columns: Index) -> Floats:
    """What the costs of cells are tilted by."""
    return np.asarray(TILT * ((37 * rows + 61 * columns) % 101), dtype=np.float64)


def move_prices(cost_back: Callable[[int, int], Floats]) -> Floats:
    """Price of each move where it ends: the mean cost on its way times its length, and skew.

    Parameters
    ----------
    cost_back : callable
        The costs so many rows and columns before each cell where moves end, (...).

    Returns
    -------
    (M, ...) float64
    """
    shape = cost_back(0, 0).shape
    prices = np.zeros((len(MOVES), *shape))
    for chain in CHAINS:
        total = np.zeros(shape)
        for step, move in chain:
            total += cost_back(*step)
            if move is not None:
                di, dj = MOVES[move]
                np.multiply(total, (di + dj) / 2 / max(di, dj), out=prices[move])
                prices[move] += SKEW_PRICE * abs(di - dj)
    return prices


def steps_over(rows: Index, columns: Index, fixed: Index, count: int) -> Mask:
    """Which moves step over a fixed sample of either ring.

    Parameters
    ----------
    rows, columns : (...) intp
        Samples where the moves end, of shapes that broadcast.
    fixed : (k,) intp
    count : int
        Samples of a ring.

    Returns
    -------
    (M, ...) bool
    """
    over = np.zeros((REACH + 1, count), dtype=bool)  # by length of the step and where it ends
    for length in range(2, REACH + 1):
        over[length] = over[length - 1]
        over[length, (fixed + length - 1) % count] = True
    return np.stack([over[di][rows] | over[dj][columns] for di, dj in MOVES])
