"""The cheapest strictly monotone path through a table of costs.

Every move goes forward in both directions, so one row of the table is filled at once, over all
starts and columns.
"""

from typing import NamedTuple

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from shapetween.base.arrays import Floats, Index
from shapetween.match.moves import MOVES, REACH, move_prices, steps_over, tilt

__all__ = [
    "OpenPath",
    "Paths",
    "cyclic_paths",
    "cyclic_prices",
    "priced_path",
    "rolled_paths",
]


class Paths:
    """The cheapest path from each start, found at once; traced when asked for.

    Attributes
    ----------
    starts : (S,) intp
        Columns the paths start in.
    costs : (S,) float64
        Cost of each path a row.
    """

    def __init__(self, prices: Floats, rows: int, starts: Index, width: int) -> None:
        """Run the table.

        Parameters
        ----------
        prices : (M, n, n) float64
            Price of each of `MOVES` where it ends; rows and columns go round and round.
        rows : int
            Rows of a path, at most n.
        starts : (S,) intp
        width : int
            Columns of a path; it ends in column ``start + width`` of the last row.
        """
        self.starts = starts
        columns = np.arange(int(starts.max()) + width + 1) % prices.shape[2]
        self._windows = sliding_window_view(prices.take(columns, axis=2), width + 1, axis=2)
        # Rows and columns of no path before the first ones, so that all moves may be looked up.
        # The starts come last: then what a move looks up in a row is one run of numbers.
        table = np.full((REACH + rows + 1, REACH + width + 1, len(starts)), np.inf)
        table[REACH, REACH] = 0.0
        _run(table, self._windows[:, :, _as_slice(starts)].transpose(1, 0, 3, 2))
        self._table = table[REACH:, REACH:]
        self.costs = self._table[rows, width] / rows

    def trace(self, which: int) -> tuple[Index, Index]:
        """Nodes of the path from ``starts[which]``: rows and columns, both from 0."""
        # Numbers are looked up one by one: quicker through a memoryview.
        table = self._table[:, :, which].data
        prices = self._windows[:, :, self.starts[which]].data
        count = self._windows.shape[1]
        i, j = self._table.shape[0] - 1, self._table.shape[1] - 1
        nodes = [(i, j)]
        while i > 0:
            for move, (di, dj) in enumerate(MOVES):
                if di > i or dj > j:
                    continue
                if table[i - di, j - dj] + prices[move, i % count, j] == table[i, j]:
                    i, j = i - di, j - dj
                    break
            else:
                raise AssertionError("no move leads here")
            nodes.append((i, j))
        rows, columns = np.array(nodes[::-1], dtype=np.intp).T
        return rows, columns


def _run(table: Floats, prices: Floats) -> None:
    """Fill the table, (R + rows + 1, R + columns, S), from the prices, (n, M, columns, S)."""
    rows, width, starts = (
        n - k for n, k in zip(table.shape, (REACH + 1, REACH + 1, 0), strict=True)
    )
    flat = table.reshape(len(table), -1)
    reached = np.zeros(prices.shape[1:])
    lines = reached.reshape(len(MOVES), -1)
    for i in range(1, rows + 1):
        # Columns within reach of both the start and the end.
        low = max(-(-i // REACH), width - REACH * (rows - i))
        high = min(i * REACH, width - -(-(rows - i) // REACH)) + 1
        np.copyto(reached[:, low:high], prices[i % len(prices), :, low:high])
        line = lines[:, low * starts : high * starts]
        for (di, dj), price in zip(MOVES, line, strict=True):
            before = flat[REACH + i - di]
            first = (REACH - dj + low) * starts
            np.add(price, before[first : first + len(price)], out=price)
        first = (REACH + low) * starts
        np.minimum.reduce(line, axis=0, out=flat[REACH + i, first : first + line.shape[1]])


def _as_slice(starts: Index) -> Index | slice:
    """The starts as a slice where they are evenly spaced: looking these up copies nothing."""
    if len(starts) == 1:
        return slice(int(starts[0]), int(starts[0]) + 1)
    steps = np.diff(starts)
    if steps[0] > 0 and (steps == steps[0]).all():
        return slice(int(starts[0]), int(starts[-1]) + 1, int(steps[0]))
    return starts


def cyclic_paths(cost: Floats, reward: Floats, fixed: Index, starts: Index) -> Paths:
    """Cheapest closed paths through the costs of two rings of n samples each.

    Parameters
    ----------
    cost, reward, fixed
        As for `cyclic_prices`.
    starts : (S,) intp
        Samples of the second ring that sample 0 of the first may be matched with.
    """
    return Paths(cyclic_prices(cost, reward, fixed), len(cost), starts, len(cost))


def rolled_paths(prices: Floats, first: int, starts: Index) -> Paths:
    """Cheapest closed paths that match a sample of the first ring with one of some others.

    Parameters
    ----------
    prices : (M, n, n) float64
        From `cyclic_prices`, with no sample fixed.
    first : int
        Sample of the first ring, the paths' row 0.
    starts : (S,) intp
        Samples of the second ring.
    """
    count = prices.shape[1]
    return Paths(np.roll(prices, -first, axis=1), count, starts, count)


def cyclic_prices(cost: Floats, reward: Floats, fixed: Index) -> Floats:
    """Price of each move where it ends, (M, n, n), through the costs of two rings.

    Parameters
    ----------
    cost : (n, n) float64
        Infinite costs bar a cell.
    reward : (n, n) float64
        Taken off the price of a move that ends in the cell.
    fixed : (k,) intp
        Samples of the first ring that must be matched with the same of the second.
    """
    count = len(cost)
    sample = np.arange(count)
    rows, columns = sample[:, None], sample
    prices = _prices(_barred(cost + tilt(rows, columns), fixed)) - reward
    if len(fixed):
        prices[steps_over(rows, columns, fixed, count)] = np.inf
    return prices


def _barred(cost: Floats, fixed: Index) -> Floats:
    """The costs with all but the fixed cells of fixed samples infinite."""
    barred = cost.copy()
    barred[fixed], barred[:, fixed] = np.inf, np.inf
    barred[fixed, fixed] = cost[fixed, fixed]
    return barred


def _prices(cost: Floats) -> Floats:
    """Price of each move round and round the costs, (n, n) to (M, n, n)."""
    count = len(cost)
    places = np.arange(-REACH, count) % count
    around = cost[np.ix_(places, places)]

    def cost_back(i: int, j: int) -> Floats:
        return around[REACH - i : REACH - i + count, REACH - j : REACH - j + count]

    return move_prices(cost_back)


class OpenPath(NamedTuple):
    """A path end to end: the samples that are matched, increasing, and its cost a row."""

    rows: Index
    columns: Index
    cost: float


def priced_path(cost: Floats, reward: Floats) -> OpenPath | None:
    """The cheapest path through the costs of two open lines of n samples each, end to end.

    Parameters
    ----------
    cost, reward : (n, n) float64
        As for `cyclic_prices`; what costs infinitely much is barred.

    Returns
    -------
    OpenPath or None
        None if all ways are barred.
    """
    sample, steps = np.arange(len(cost)), len(cost) - 1
    prices = _prices(cost + tilt(sample[:, None], sample)) - reward
    paths = Paths(prices, steps, np.zeros(1, dtype=np.intp), steps)
    if not np.isfinite(paths.costs[0]):
        return None
    return OpenPath(*paths.trace(0), float(paths.costs[0]))
