"""The cheapest strictly monotone path through a table of costs.

Every move goes forward in both directions, so one row of the table is one array operation over
all starts and columns.
"""

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from shapetween.arrays import Floats, Index

__all__ = ["Paths", "cyclic_paths", "open_path"]

#: Steps along (source, target), in stations. Slopes from 1/8 to 8; (2, 3) beside (1, 2) lets a
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

#: Price of every station by which a move favours one outline; less invites needless slips.
SKEW_PRICE = 0.1

#: A slight tilt of the costs by cell number, in which no two paths are equal: symmetric shapes and
#: straight sides have equally cheap paths, between which rounding must not choose.
TILT = 1e-8


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
        self.starts = starts
        self._windows = sliding_window_view(prices, width + 1, axis=2)
        # Rows and columns of no path before the first ones, so that all moves may be looked up.
        table = np.full((REACH + rows + 1, len(starts), REACH + width + 1), np.inf)
        table[REACH, :, REACH] = 0.0
        self._table = table[REACH:, :, REACH:]
        run = _run_one if len(starts) == 1 else _run_many
        run(table, self._windows[:, :, _as_slice(starts)])
        self.costs = self._table[rows, :, width] / rows

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


def _run_many(table: Floats, windows: Floats) -> None:
    """Fill the table for many starts: an array operation for each row and move."""
    rows, _, width = (n - REACH for n in table.shape)
    reached = np.zeros((table.shape[1], width))
    for i in range(1, rows):
        row = table[REACH + i, :, REACH:]
        for (di, dj), price in zip(MOVES, windows[:, i], strict=True):
            before = table[REACH + i - di, :, REACH - dj : REACH - dj + width]
            np.add(before, price, out=reached)
            np.minimum(row, reached, out=row)


def _run_one(table: Floats, windows: Floats) -> None:
    """Fill the table for one start: all moves at once, for the rows are short."""
    rows, _, width = (n - REACH for n in table.shape)
    steps = np.array([[di * table.shape[2] + dj] for di, dj in MOVES])
    flat = table.reshape(-1)
    where = (REACH * table.shape[2] + REACH + np.arange(width)) - steps
    for i in range(1, rows):
        reached = flat[where + i * table.shape[2]] + windows[:, i, 0]
        table[REACH + i, 0, REACH:] = reached.min(axis=0)


def _as_slice(starts: Index) -> Index | slice:
    """The starts as a slice where they are evenly spaced: looking these up copies nothing."""
    if len(starts) == 1:
        return slice(int(starts[0]), int(starts[0]) + 1)
    steps = np.diff(starts)
    if steps[0] > 0 and (steps == steps[0]).all():
        return slice(int(starts[0]), int(starts[-1]) + 1, int(steps[0]))
    return starts


def cyclic_paths(cost: Floats, reward: Floats, fixed: Index, starts: Index) -> Paths:
    """Cheapest closed paths through the costs of two rings of n stations each.

    Parameters
    ----------
    cost : (n, n) float64
        Infinite costs bar a cell.
    reward : (n, n) float64
        Taken off the price of a move that ends in the cell.
    fixed : (k,) intp
        Stations of the first ring that must be matched with the same of the second.
    starts : (S,) intp
        Stations of the second ring that station 0 of the first may be matched with.
    """
    count = len(cost)
    station = np.arange(count)
    tilt = TILT * ((37 * station[:, None] + 61 * station) % 101)
    # The second ring goes on for as long as the last start's path.
    rows, columns = np.arange(count + 1) % count, np.arange(int(starts.max()) + count + 1) % count
    prices = _prices(_barred(cost + tilt, fixed), len(rows), len(columns))
    prices -= reward[np.ix_(rows, columns)]
    for (di, dj), price in zip(MOVES, prices, strict=True):
        # No move may step over a fixed station of either ring.
        price[np.isin(rows, (fixed[:, None] + np.arange(1, di)) % count)] = np.inf
        price[:, np.isin(columns, (fixed[:, None] + np.arange(1, dj)) % count)] = np.inf
    return Paths(prices, starts, count)


def _barred(cost: Floats, fixed: Index) -> Floats:
    """The costs with all but the fixed cells of fixed stations infinite."""
    barred = cost.copy()
    barred[fixed], barred[:, fixed] = np.inf, np.inf
    barred[fixed, fixed] = cost[fixed, fixed]
    return barred


def _prices(cost: Floats, rows: int, columns: int) -> Floats:
    """Price of each move where it ends: the mean cost on its way times its length, and skew.

    Both ways round and round again the costs, (n, n) to (M, rows, columns).
    """
    count = len(cost)
    around = cost[np.ix_(np.arange(-REACH, rows) % count, np.arange(-REACH, columns) % count)]
    prices = np.zeros((len(MOVES), rows, columns))
    for (di, dj), price in zip(MOVES, prices, strict=True):
        steps = max(di, dj)
        for q in range(steps):
            i, j = REACH - q * di // steps, REACH - q * dj // steps
            price += around[i : i + rows, j : j + columns]
        price *= (di + dj) / 2 / steps
        price += SKEW_PRICE * abs(di - dj)
    return prices


def open_path(cost: Floats) -> tuple[Index, Index]:
    """The cheapest path through the costs of two open lines of n stations each, end to end.

    Parameters
    ----------
    cost : (n, n) float64

    Returns
    -------
    rows, columns : (K,) intp
        Stations that are matched, both strictly increasing, from 0 to n - 1.
    """
    count = len(cost)
    station = np.arange(count)
    tilt = TILT * ((37 * station[:, None] + 61 * station) % 101)
    paths = Paths(_prices(cost + tilt, count, count), np.zeros(1, dtype=np.intp), count - 1)
    return paths.trace(0)
