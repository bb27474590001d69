"""The cheapest closed path where all but few cells are out of the question."""

from itertools import pairwise

import numpy as np

from shapetween.base.arrays import Floats, Index
from shapetween.match.moves import MOVES, REACH, move_prices, steps_over, tilt

__all__ = ["band_path"]


def band_path(
    cells: tuple[Index, Index], cost: Floats, reward: Floats, fixed: Index, count: int
) -> tuple[Index, Index] | None:
    """Cheapest path from sample 0 of both rings round to it again.

    Parameters
    ----------
    cells : two (N,) intp
        Samples of the first and of the second ring that may be matched, sorted, sample 0 of
        both among them.
    cost, reward : (N,) float64
        As for `cyclic_paths`, of the cells.
    fixed : (k,) intp
        Samples of the first ring that must be matched with the same of the second, 0 among them.
    count : int
        Samples of each ring.

    Returns
    -------
    rows, columns : (K,) intp
        Samples that are matched, both strictly increasing, from 0 to `count`. None if no path
        keeps to the cells.
    """
    sample = np.zeros(count, dtype=bool)
    sample[fixed] = True
    fits = (cells[0] == cells[1]) | ~(sample[cells[0]] | sample[cells[1]])
    # Of sample 0 only the cell of both is left, the first one. There the path ends.
    order = np.roll(np.flatnonzero(fits), -1)
    rows, columns = cells[0][order], cells[1][order]
    # Rows and columns of no path before the first ones, so that all moves may be looked up.
    side = REACH + count + 1
    places = (REACH + rows) * side + REACH + columns
    places[-1] = side * side - 1
    costs = np.full(side * side, np.inf)
    costs[places] = cost[order] + tilt(rows, columns)
    prices = move_prices(lambda i, j: costs[places - (i * side + j)]) - reward[order]
    prices[steps_over(rows, columns, fixed, count)] = np.inf
    table = np.full(side * side, np.inf)
    table[REACH * side + REACH] = 0.0
    before = places - np.array([[di * side + dj] for di, dj in MOVES])
    ends = np.searchsorted(places, (REACH + np.arange(1, count + 2)) * side).tolist()
    for first, last in pairwise(ends):
        if first < last:
            reached = table[before[:, first:last]] + prices[:, first:last]
            table[places[first:last]] = reached.min(axis=0)
    if not np.isfinite(table[-1]):
        return None
    steps = (table[before] + prices).argmin(axis=0)
    numbers = np.zeros(side * side, dtype=np.intp)
    numbers[places] = np.arange(len(places))
    i, j = count, count
    nodes = [(i, j)]
    while i > 0:
        di, dj = MOVES[steps[numbers[(REACH + i) * side + REACH + j]]]
        i, j = i - di, j - dj
        nodes.append((i, j))
    found_rows, found_columns = np.array(nodes[::-1], dtype=np.intp).T
    return found_rows, found_columns
