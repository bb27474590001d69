"""Pairs of least total cost: the rectangular assignment problem.

Solved by shortest augmenting paths [Cro16]_, in the order in which scipy's implementation takes
them, so that ties come out alike whichever of the two is run.

.. [Cro16] D. F. Crouse, *On implementing 2D rectangular assignment algorithms*, 2016.
"""

import math

import numpy as np

from shapetween.base.arrays import Floats, Index

__all__ = ["cheapest_pairs"]

#: Entries of a table up to which it is solved here, in some milliseconds. Larger ones are scipy's,
#: which is compiled, but takes a fifth of a second to import.
FEW = 1500


def cheapest_pairs(costs: Floats) -> tuple[Index, Index]:
    """Rows and columns of the pairs of least total cost, as many as the table's shorter side.

    Parameters
    ----------
    costs : (N, M) float64
        Infinite where a pair is barred.

    Returns
    -------
    rows, columns : (min(N, M),) intp
        Rows rising.

    Raises
    ------
    ValueError
        If every choice has a barred pair, or a cost is no number.
    """
    if costs.size <= FEW and not (np.isnan(costs) | (costs == -np.inf)).any():
        wide = costs.shape[0] <= costs.shape[1]
        found = _assigned((costs if wide else costs.T).tolist())
        if found is not None:
            side, other = np.arange(len(found)), np.array(found, dtype=np.intp)
            if wide:
                return side, other
            order = np.argsort(other)
            return other[order], side[order]
    from scipy.optimize import linear_sum_assignment

    rows, columns = linear_sum_assignment(costs)
    return rows, columns


def _assigned(costs: list[list[float]]) -> list[int] | None:
    """The column of each row, of which there are no more than columns; None if there is none."""
    width = len(costs[0]) if costs else 0
    high, low = [0.0] * len(costs), [0.0] * width
    column_of, row_of = [-1] * len(costs), [-1] * width
    for start in range(len(costs)):
        reached = [math.inf] * width
        came = [-1] * width
        rows, columns = [start], []
        # From the last column on, so that where all cost the same each row takes its own.
        left = list(range(width - 1, -1, -1))
        row, least, end = start, 0.0, -1
        while end < 0:
            best, nearest = -1, math.inf
            own, price = costs[row], high[row]
            for place, column in enumerate(left):
                way = least + own[column] - price - low[column]
                if way < reached[column]:
                    came[column], reached[column] = row, way
                # Of those that are as near, one without a row ends the search.
                way = reached[column]
                if way < nearest or (way == nearest and row_of[column] < 0):
                    best, nearest = place, way
            least = nearest
            if least == math.inf:
                return None
            column = left[best]
            columns.append(column)
            left[best] = left[-1]
            left.pop()
            if row_of[column] < 0:
                end = column
            else:
                row = row_of[column]
                rows.append(row)
        high[start] += least
        for row in rows[1:]:
            high[row] += least - reached[column_of[row]]
        for column in columns:
            low[column] -= least - reached[column]
        while True:
            row = came[end]
            row_of[end] = row
            column_of[row], end = end, column_of[row]
            if row == start:
                break
    return column_of
