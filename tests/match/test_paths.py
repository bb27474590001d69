"""The cheapest paths, from every start at once and through a band, against plain recursion."""

from functools import cache

import numpy as np
import pytest

from shapetween.base.arrays import Floats, Index
from shapetween.match.band import band_path
from shapetween.match.dynamic import cyclic_paths, priced_path
from shapetween.match.moves import MOVES, SKEW_PRICE, TILT

NONE = np.zeros(0, dtype=np.intp)


def table(seed: int, count: int) -> tuple[Floats, Floats]:
    """Costs and rewards."""
    rng = np.random.default_rng(seed)
    return rng.uniform(0.0, 1.0, (count, count)), rng.uniform(0.0, 0.3, (count, count))


def price(cost: Floats, reward: Floats, move: tuple[int, int], i: int, j: int) -> float:
    """What a move costs that ends in a cell: mean cost on its way times its length, and skew."""
    count, steps = len(cost), max(move)
    way = [((i - q * move[0] // steps), (j - q * move[1] // steps)) for q in range(steps)]
    costs = [
        cost[r % count, c % count] + TILT * ((37 * (r % count) + 61 * (c % count)) % 101)
        for r, c in way
    ]
    length = sum(move) / 2
    skew = SKEW_PRICE * abs(move[0] - move[1])
    return float(np.mean(costs)) * length + skew - float(reward[i % count, j % count])


def cheapest(cost: Floats, reward: Floats, start: int, fixed: Index = NONE) -> float:
    """Cost of the cheapest closed path from one start, a row."""
    count, stays = len(cost), set(fixed.tolist())
    samples = np.isin(np.arange(count), fixed)
    cost = np.where((samples[:, None] | samples) & ~np.eye(count, dtype=bool), np.inf, cost)

    @cache
    def reach(i: int, j: int) -> float:
        if (i, j) == (0, start):
            return 0.0
        best = np.inf
        for di, dj in MOVES:
            if i - di < 0 or j - dj < start:
                continue
            over = {(i - q) % count for q in range(1, di)} | {(j - q) % count for q in range(1, dj)}
            if not over & stays:
                best = min(best, reach(i - di, j - dj) + price(cost, reward, (di, dj), i, j))
        return best

    return reach(count, start + count) / count


def cost_of(cost: Floats, reward: Floats, rows: Index, columns: Index) -> float:
    """What a path costs, a row."""
    total = 0.0
    for k in range(1, len(rows)):
        move = int(rows[k] - rows[k - 1]), int(columns[k] - columns[k - 1])
        assert move in MOVES
        total += price(cost, reward, move, int(rows[k]), int(columns[k]))
    return total / len(cost)


@pytest.mark.parametrize("starts", [[0, 2, 4, 6, 8, 10], [5], [0, 1, 9]])
def test_paths_from_every_start_are_the_cheapest(starts: list[int]) -> None:
    cost, reward = table(len(starts), 12)
    paths = cyclic_paths(cost, reward, NONE, np.array(starts))
    for which, start in enumerate(starts):
        assert paths.costs[which] == pytest.approx(cheapest(cost, reward, start), rel=1e-12)
        rows, columns = paths.trace(which)
        assert (rows[0], columns[0], rows[-1], columns[-1]) == (0, 0, 12, 12)
        found = cost_of(cost, reward, rows, columns + start)
        assert found == pytest.approx(paths.costs[which], rel=1e-12)


@pytest.mark.parametrize("fixed", [[0], [0, 5], [0, 3, 8]])
def test_fixed_stations_meet(fixed: list[int]) -> None:
    cost, reward = table(7, 12)
    met = np.array(fixed)
    paths = cyclic_paths(cost, reward, met, np.zeros(1, dtype=np.intp))
    assert paths.costs[0] == pytest.approx(cheapest(cost, reward, 0, met), rel=1e-12)
    rows, columns = paths.trace(0)
    assert set(fixed) <= set(rows[rows == columns].tolist())


@pytest.mark.parametrize("fixed", [[0], [0, 9], [0, 11, 30]])
@pytest.mark.parametrize("width", [3, 8, 40])
def test_a_band_gives_the_path_that_all_cells_give_with_the_others_barred(
    fixed: list[int], width: int
) -> None:
    cost, reward = table(width, 40)
    sample, met = np.arange(40), np.array(fixed)
    gap = np.abs(sample[:, None] - sample)
    near = np.minimum(gap, 40 - gap) <= width
    rows, columns = np.nonzero(near)
    found = band_path((rows, columns), cost[near], reward[near], met, 40)
    barred = np.where(near, cost, np.inf)
    paths = cyclic_paths(barred, reward, met, np.zeros(1, dtype=np.intp))
    assert found is not None
    np.testing.assert_array_equal(found, paths.trace(0))


def test_a_band_that_breaks_off_has_no_path() -> None:
    cost, reward = table(1, 40)
    near = np.abs(np.arange(40)[:, None] - np.arange(40)) <= 2
    near[15:25] = False
    rows, columns = np.nonzero(near)
    assert band_path((rows, columns), cost[near], reward[near], np.array([0]), 40) is None


def test_open_lines_are_matched_end_to_end() -> None:
    cost = np.abs(np.arange(9)[:, None] ** 2 / 8 - np.arange(9))
    found = priced_path(cost, np.zeros_like(cost))
    assert found is not None
    rows, columns, _ = found
    assert (rows[0], columns[0], rows[-1], columns[-1]) == (0, 0, 8, 8)
    assert np.abs(columns - rows**2 / 8).max() <= 1


def test_no_move_passes_a_fixed_station_on_its_way() -> None:
    """Where the cheapest way steps from beside a fixed pair to beyond it, it has to stop there."""
    cost = np.ones((12, 12))
    # By (2, 3) from (5, 5) past (6, 6) to (7, 8) is cheaper than to stop half-way.
    for i, j in ((4, 4), (5, 5), (7, 7), (7, 8), (8, 9)):
        cost[i, j] = 0.0
    reward = np.zeros((12, 12))
    met = np.array([0, 6])
    sample = np.arange(12)
    cells = np.repeat(sample, 12), np.tile(sample, 12)
    found = band_path(cells, cost.ravel(), reward.ravel(), met, 12)
    paths = cyclic_paths(cost, reward, met, np.zeros(1, dtype=np.intp))
    for rows, columns in (found or (NONE, NONE), paths.trace(0)):
        assert (6, 6) in set(zip(rows.tolist(), columns.tolist(), strict=True))
