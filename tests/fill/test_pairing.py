"""Which piece of a shape becomes which, and which hole: by place and size."""

from collections.abc import Iterable
from itertools import combinations, permutations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from shapetween.fill.pairing import Pairing, Thing, pair_things


def things(*places: tuple[float, float, float]) -> list[Thing]:
    return [Thing(np.array([x, y]), size) for x, y, size in places]


def pairs(*rows: tuple[int, int]) -> tuple[tuple[int, int], ...]:
    return tuple(rows)


def test_the_nearest_of_the_same_size() -> None:
    first = things((0, 0, 1), (10, 0, 1))
    second = things((11, 0, 1), (1, 1, 1))
    assert pair_things(first, second, 20) == Pairing(pairs((0, 1), (1, 0)), (), ())


def test_what_is_left_over_is_named() -> None:
    first = things((0, 0, 1), (50, 0, 1), (10, 0, 1))
    second = things((11, 0, 1), (0, 1, 1))
    assert pair_things(first, second, 100) == Pairing(pairs((0, 1), (2, 0)), (1,), ())
    assert pair_things(second, first, 100) == Pairing(pairs((0, 2), (1, 0)), (), (1,))
    assert pair_things(first, [], 100) == Pairing((), (0, 1, 2), ())


def test_settled_pairs_stand_and_the_rest_makes_do() -> None:
    first, second = things((0, 0, 1), (9, 0, 1)), things((0, 0, 1), (9, 0, 1))
    assert pair_things(first, second, 10, fixed=[(0, 1)]).pairs == pairs((0, 1), (1, 0))
    assert pair_things(first, second[:1], 10, fixed=[(1, 0)]) == Pairing(pairs((1, 0)), (0,), ())


def test_size_tells_where_place_does_not() -> None:
    first, second = things((0, 0, 1), (1, 0, 8)), things((0, 0, 8), (1, 0, 1))
    assert pair_things(first, second, 10).pairs == pairs((0, 1), (1, 0))


def test_things_of_no_size_are_no_trouble() -> None:
    assert pair_things(things((0, 0, 0)), things((3, 0, 1)), 5).pairs == pairs((0, 0))


places = st.lists(
    st.tuples(st.integers(0, 30), st.integers(0, 30), st.integers(1, 9)),
    min_size=1,
    max_size=4,
    unique=True,
)


@settings(max_examples=50)
@given(places, places)
def test_at_the_least_cost_whatever_the_order(
    a: list[tuple[int, int, int]],
    b: list[tuple[int, int, int]],
) -> None:
    """Against every way to pair some of them and leave the rest alone."""
    found = pair_things(things(*a), things(*b), 40)

    def cost(i: int, j: int) -> float:
        (x, y, size), (u, v, other) = a[i], b[j]
        away = np.hypot(x - u, y - v) / ((size + other) / 2 + 0.15 * 40)
        return float(away + 0.35 * abs(np.log(size / other)) - 0.6 * min(size, other) / 40)

    def total(pairs: Iterable[tuple[int, int]]) -> float:
        chosen = list(pairs)
        return sum(cost(i, j) for i, j in chosen) + 1.2 * (len(a) + len(b) - 2 * len(chosen))

    least = min(
        total(zip(rows, columns, strict=True))
        for count in range(1, min(len(a), len(b)) + 1)
        for rows in combinations(range(len(a)), count)
        for columns in permutations(range(len(b)), count)
    )
    assert total(found.pairs) == pytest.approx(least)
    backwards = pair_things(things(*a[::-1]), things(*b[::-1]), 40)
    again = [(len(a) - 1 - i, len(b) - 1 - j) for i, j in backwards.pairs]
    assert total(again) == pytest.approx(least)


def test_strangers_are_left_alone_but_for_the_last_two() -> None:
    near, far = things((0, 0, 2), (100, 100, 2)), things((1, 0, 2), (100, 0, 2))
    assert pair_things(near, far, 150) == Pairing(pairs((0, 0)), (1,), (1,))
    assert pair_things(near, far, 150, left=3).pairs == pairs((0, 0), (1, 1))
    assert pair_things(near[1:], far[1:], 150).pairs == pairs((0, 0))
    assert pair_things(things((0, 0, 1), (9, 9, 1)), things((90, 90, 50)), 150).pairs
