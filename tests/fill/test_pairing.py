"""Which shape becomes which: by name, by what the user says, else by place and looks."""

from collections.abc import Iterable
from itertools import combinations, permutations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from shapetween.fill.pairing import Pairing, Thing, pair_shapes, pair_things
from shapetween.model.drawing import Shape
from shapetween.model.paint import Colour, Gradient, Stop
from tests.drawings import area, line, square

RED, BLUE = Colour(1, 0, 0), Colour(0, 0, 1)


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


def paired(first: list[Shape], second: list[Shape]) -> tuple[tuple[int, int], ...]:
    return pair_shapes(first, second, 140, []).pairs


def test_names_win_over_places() -> None:
    left, right = square(0, 0, 20), square(60, 0, 20)
    first = [area(left, name="sun"), area(right, name="moon")]
    second = [area(left, name="moon"), area(right, name="sun")]
    assert paired(first, second) == pairs((0, 1), (1, 0))
    unnamed = [area(left), area(right)]
    assert paired(unnamed, unnamed) == pairs((0, 0), (1, 1))
    assert paired(first, unnamed) == pairs((0, 0), (1, 1))


@pytest.mark.parametrize("first", ["path4", "Layer_1"])
def test_names_that_editors_give_only_help(first: str) -> None:
    left, right = square(0, 0, 3), square(90, 0, 3)
    one = [area(left, name=first), area(right, name="Vector")]
    other = [area(left, name="Vector"), area(right, name=first)]
    assert paired(one, other) == pairs((0, 0), (1, 1))
    near = square(0.2, 0, 3)
    halves = [area(left, name=first), area(near, name="Vector")]
    turned = [area(left, name="Vector"), area(near, name=first)]
    assert paired(halves, turned) == pairs((0, 1), (1, 0))


def test_a_name_that_stands_twice_says_nothing() -> None:
    left, right = square(0, 0, 20), square(60, 0, 20)
    first = [area(left, name="leaf"), area(right, name="leaf")]
    second = [area(right, name="leaf"), area(left, name="stem")]
    assert paired(first, second) == pairs((0, 1), (1, 0))


def test_what_the_user_says_wins_over_names() -> None:
    left, right = square(0, 0, 20), square(60, 0, 20)
    shapes = [area(left, name="sun"), area(right, name="moon")]
    assert pair_shapes(shapes, shapes, 140, [(0, 1)]).pairs == pairs((0, 1), (1, 0))


def test_colour_tells_where_place_does_not() -> None:
    here, there = square(40, 40, 20), square(43, 40, 20)
    # Among many shapes two neighbours in the paint order are almost at one place in it.
    others = [area(square(0, 4 * k, 3), name=f"other-{k}") for k in range(9)]
    first = [area(here, colour=RED), area(there, colour=BLUE), *others]
    second = [area(here, colour=BLUE), area(there, colour=RED), *others]
    assert paired(first, second)[:2] == pairs((0, 1), (1, 0))
    stops = tuple(Stop(k / 2, RED) for k in range(3))
    gradient = Gradient("linear", (0, 0, 1, 0), (1, 0, 0, 1, 0, 0), stops)
    blended = [second[0], area(there, colour=gradient), *others]
    assert paired(first, blended)[:2] == pairs((0, 1), (1, 0))


def test_lines_become_lines_and_areas_areas() -> None:
    stroke, filled = line((40, 40), (60, 60)), area(square(40, 40, 20))
    assert paired([stroke, filled], [filled, stroke]) == pairs((0, 1), (1, 0))


def test_twins_keep_their_paint_order() -> None:
    twin = area(square(40, 40, 20))
    assert paired([twin] * 3, [twin] * 3) == pairs((0, 0), (1, 1), (2, 2))


def test_as_many_in_one_paint_all_have_partners() -> None:
    first = [area(square(10 * k, 10, 6), colour=RED) for k in range(4)]
    second = [area(square(10 * k, 45, 6), colour=RED) for k in range(4)]
    assert paired(first, second) == pairs((0, 0), (1, 1), (2, 2), (3, 3))
    assert len(paired(first[:3], second)) < 3
