"""Pairs of least cost are scipy's, ties and barred pairs included."""

import numpy as np
import pytest
from scipy.optimize import linear_sum_assignment

from shapetween.geometry.assignment import FEW, cheapest_pairs


@pytest.mark.parametrize("seed", range(60))
def test_pairs_are_scipys(seed: int) -> None:
    random = np.random.default_rng(seed)
    height, width = random.integers(1, 13, 2).tolist()
    costs = random.normal(size=(height, width))
    if seed % 3 == 0:  # ties
        costs = np.round(costs)
    if seed % 3 == 1:  # as they are made for what may be left alone
        table = np.full((height + width, height + width), np.inf)
        table[:height, :width] = np.round(costs, 1)
        table[np.arange(height), width + np.arange(height)] = 0.1
        table[height + np.arange(width), np.arange(width)] = 0.1
        table[height:, width:] = 0.0
        costs = table
    found, known = cheapest_pairs(costs), linear_sum_assignment(costs)
    assert [x.tolist() for x in found] == [x.tolist() for x in known]


def test_large_tables_are_solved_too() -> None:
    costs = np.random.default_rng(3).normal(size=(50, FEW // 50 + 1))
    found, known = cheapest_pairs(costs), linear_sum_assignment(costs)
    assert [x.tolist() for x in found] == [x.tolist() for x in known]


def test_equal_costs_pair_each_with_its_own() -> None:
    assert [x.tolist() for x in cheapest_pairs(np.zeros((3, 4)))] == [[0, 1, 2], [0, 1, 2]]


def test_what_is_barred_or_no_number_is_refused() -> None:
    with pytest.raises(ValueError, match="infeasible"):
        cheapest_pairs(np.full((2, 2), np.inf))
    with pytest.raises(ValueError, match="invalid"):
        cheapest_pairs(np.array([[np.nan]]))


def test_an_empty_table_has_no_pairs() -> None:
    assert [x.tolist() for x in cheapest_pairs(np.zeros((0, 3)))] == [[], []]
