"""The cheapest strictly monotone path through a table of costs.

Every move goes forward in both directions, so one row of the table is one array operation over
all starts and columns.
"""

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from shapetween.arrays import Floats, Index

__all__ = ["Paths", "cyclic_paths", "open_path"]

#: Steps along (source, target), in stations. Slopes from 1/5 to 5; (2, 3) beside (1, 2) lets a
#: slope of 1.5 be even.
MOVES = ((1, 1), (1, 2), (2, 1), (2, 3), (3, 2), (1, 3), (3, 1), (1, 5), (5, 1))

#: Price of every station by which a move favours one outline; less invites needless slips.
SKEW_PRICE = 0.1


class Paths:
    """The cheapest path from each start, found at once; traced when asked for.

    Attributes
    ----------
    starts : (S,) intp
        Columns the paths start in.
    costs : (S,) float64
        Cost of each path a row.
    """

    def __init__(self, prices: Floats, starts: Index, width: int) -> None:
        """Run the table.

        Parameters
        ----------
        prices : (M, rows + 1, columns) float64
            Price of each of `MOVES` where it ends.
        starts : (S,) intp
        width : int
            Columns of a path; it ends in column ``start + width`` of the last row.
        """
        rows = prices.shape[1] - 1
        windows = sliding_window_view(prices, width + 1, axis=2)
        self.starts = starts
        self._windows = windows
        table = np.full((rows + 1, len(starts), width + 1), np.inf)
        table[0, :, 0] = 0.0
        for i in range(1, rows + 1):
            row = table[i]
            for (di, dj), price in zip(MOVES, windows[:, i], strict=True):
                if di <= i:
                    reached = table[i - di, :, : width + 1 - dj] + price[starts, dj:]
                    np.minimum(row[:, dj:], reached, out=row[:, dj:])
        self._table = table
        self.costs = table[rows, :, width] / rows

    def trace(self, which: int) -> tuple[Index, Index]:
        """Nodes of the path from ``starts[which]``: rows and columns, both from 0."""
        table = self._table[:, which]
        i, j = table.shape[0] - 1, table.shape[1] - 1
        nodes = [(i, j)]
        while i > 0:
            for move, (di, dj) in enumerate(MOVES):
                if di > i or dj > j:
                    continue
                price = self._windows[move, i, self.starts[which], j]
                if table[i - di, j - dj] + price == table[i, j]:
                    i, j = i - di, j - dj
                    break
            else:
                raise AssertionError("no move leads here")
            nodes.append((i, j))
        rows, columns = np.array(nodes[::-1], dtype=np.intp).T
        return rows, columns


def cyclic_paths(cost: Floats, every: int) -> Paths:
    """Cheapest closed paths through the costs of two rings of n stations each, (n, n).

    They start at station 0 of the first ring and at each `every`-th of the second.
    """
    count = len(cost)
    prices = _prices(cost)
    around = np.concatenate([prices, prices[:, :1]], axis=1)
    around = np.concatenate([around, around, around[:, :, :1]], axis=2)
    return Paths(around, np.arange(0, count, every), count)


def open_path(cost: Floats) -> tuple[Index, Index]:
    """Cheapest path from the first to the last cell of (n + 1, m + 1) costs.

    Infinite costs bar a cell.
    """
    paths = Paths(_prices(cost), np.zeros(1, dtype=np.intp), cost.shape[1] - 1)
    return paths.trace(0)


def _prices(cost: Floats) -> Floats:
    """Price of each move where it ends: the mean cost on its way times its length, and skew."""
    prices = []
    for di, dj in MOVES:
        steps = max(di, dj)
        way = [np.roll(cost, (q * di // steps, q * dj // steps), (0, 1)) for q in range(steps)]
        prices.append((di + dj) / 2 * np.mean(way, axis=0) + SKEW_PRICE * abs(di - dj))
    return np.stack(prices)
