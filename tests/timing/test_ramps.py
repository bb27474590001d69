"""Even movements in a row, put together where points go on as they did."""

import numpy as np

from shapetween.timing.easing import LINEAR
from shapetween.timing.ramps import together
from shapetween.timing.windows import Eased

WINDOWS = ((0.0, 0.25), (0.25, 0.5), (0.5, 1.0))


def row(*ways: tuple[int, int]) -> np.ndarray:
    return np.array(ways, np.int64)[:, None]


def joined(terms: np.ndarray, allowed: float = 4.0) -> dict[tuple[float, float], list[list[int]]]:
    easings, found = together([Eased(LINEAR, window) for window in WINDOWS], terms, allowed)
    return {easing.window: term.tolist() for easing, term in zip(easings, found, strict=True)}


def test_points_that_go_on_evenly_are_one_way() -> None:
    even, turned = row((10, 0), (10, 0), (20, 0)), row((10, 0), (10, 0), (0, 20))
    assert joined(even) == {(0.0, 1.0): [[40, 0]]}
    found = joined(np.concatenate([turned, turned], axis=1))
    assert found == {(0.0, 0.5): [[20, 0]] * 2, (0.5, 1.0): [[0, 20]] * 2}


def test_little_ways_are_part_of_the_next_that_is_not() -> None:
    assert joined(row((1, 0), (40, 0), (0, 1))) == {(0.25, 0.5): [[41, 1]]}


def test_what_is_no_fewer_stays() -> None:
    terms = np.concatenate([row((10, 0), (10, 0), (0, 20)), row((9, 0), (0, 10), (0, 20))], axis=1)
    found = joined(terms)
    assert [found[window] for window in WINDOWS] == terms.tolist()
