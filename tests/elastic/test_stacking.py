"""The order of painting serves both drawings."""

import numpy as np
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from shapetween.elastic.pairing import Pairing
from shapetween.elastic.silhouette import Areas, covered_by
from shapetween.elastic.stacking import Layer, stacked
from tests.drawings import area, line, square


def areas(*places: tuple[float, float]) -> Areas:
    return covered_by([area(square(x, y, 10)) for x, y in places])


def paired(count: int, *pairs: tuple[int, int]) -> Pairing:
    firsts, seconds = {i for i, _ in pairs}, {j for _, j in pairs}
    return Pairing(
        pairs,
        tuple(i for i in range(count) if i not in firsts),
        tuple(j for j in range(count) if j not in seconds),
    )


def test_the_first_drawings_order_where_nothing_overlaps() -> None:
    apart = areas((0, 0), (20, 0), (40, 0))
    found = stacked((apart, apart), paired(3, (0, 2), (1, 1), (2, 0)))
    assert found == [Layer(0, 2), Layer(1, 1), Layer(2, 0)]


def test_what_covers_something_at_the_end_is_painted_after_it() -> None:
    apart, heap = areas((0, 0), (20, 0)), areas((0, 0), (5, 5))
    assert stacked((apart, heap), paired(2, (0, 1), (1, 0))) == [Layer(1, 0), Layer(0, 1)]


def test_where_the_drawings_contradict_each_other_one_is_painted_twice() -> None:
    heap = covered_by([area(square(0, 0, 50)), area(square(40, 40, 20))])
    turned = covered_by([area(square(40, 40, 20)), area(square(0, 0, 50))])
    found = stacked((heap, turned), paired(2, (0, 1), (1, 0)))
    # The smaller one: above in the first half, below in the second.
    assert found == [Layer(1, 0, (0.5, 1.0)), Layer(0, 1), Layer(1, 0, (0.0, 0.5))]


def test_lines_cover_as_wide_as_they_are() -> None:
    shapes = covered_by([line((0, 0), (10, 0), width=4), area(square(3, 1, 5))])
    assert shapely.intersects(*shapes)
    assert shapes[0].area == 40


@settings(max_examples=60)
@given(st.integers(0, 10**6), st.integers(2, 7))
def test_both_ends_are_painted_as_drawn(seed: int, count: int) -> None:
    rng = np.random.default_rng(seed)
    sides = [areas(*rng.integers(0, 25, (count, 2)).tolist()) for _ in range(2)]
    order = rng.permutation(count).tolist()
    kept = int(rng.integers(0, count + 1))
    layers = stacked((sides[0], sides[1]), paired(count, *enumerate(order[:kept])))
    for end, shapes in enumerate(sides):
        shown = [(x.source, x.target)[end] for x in layers if x.shown[end] == end]
        places = {k: place for place, k in enumerate(shown) if k is not None}
        assert sorted(places) == list(range(count))
        for under in range(count):
            for over in range(under + 1, count):
                if shapes[under].intersection(shapes[over]).area > 1:
                    assert places[under] < places[over]
