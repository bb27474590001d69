"""Areas in one paint that are one area in the other drawing become one; others stay apart."""

import numpy as np
import pytest

from shapetween.base.arrays import Points
from shapetween.elastic.flow import resting_flow
from shapetween.elastic.gathering import gather_areas
from shapetween.elastic.pairing import Settled
from shapetween.elastic.silhouette import covered_by
from shapetween.model.drawing import Shape
from shapetween.model.outline import Outline
from shapetween.model.paint import Colour
from tests.drawings import area, drawing, line, ring, square
from tests.elastic.whole import prepare_elastic

RED, BLUE = Colour(1, 0, 0), Colour(0, 0, 1)


def box(x: float, y: float, width: float, height: float) -> Outline:
    return ring([(x, y), (x + width, y), (x + width, y + height), (x, y + height)])


BARS = [area(box(10, 40, 80, 20), colour=RED), area(box(40, 10, 20, 80), colour=RED)]
CORNERS = [(0, 3), (3, 3), (3, 0), (5, 0), (5, 3), (8, 3), (8, 5), (5, 5), (5, 8), (3, 8), (3, 5)]
CROSS = area(ring(10 + 10 * np.array([*CORNERS, (0, 5)], dtype=float)), colour=BLUE)
SPOTS = [area(square(x, y, 20), colour=RED) for x, y in ((10, 10), (70, 10), (40, 70))]
PAGE = area(square(0, 0, 100), colour=BLUE)


def gathered(
    first: list[Shape], second: list[Shape], settled: tuple[tuple[int, int], ...] = ()
) -> Settled:
    areas = covered_by(first), covered_by(second)
    return gather_areas(first, second, areas, resting_flow(first, second), settled)


def shown(shapes: tuple[Shape, ...]) -> float:
    return float(sum(a.area for a in covered_by(shapes)))


def test_two_bars_are_a_cross() -> None:
    first, second, settled = gathered([PAGE, *BARS], [PAGE, CROSS])
    assert (len(first), second, settled) == (2, (PAGE, CROSS), ((1, 1),))
    (outline,) = first[1].rings
    assert len(outline.curves) == 12
    assert shown(first[1:]) == pytest.approx(2800)
    assert first[1].style.fill == RED


def test_the_other_way_round_too() -> None:
    first, second, settled = gathered([CROSS], BARS)
    assert (first, len(second), settled) == ((CROSS,), 1, ((0, 0),))


def test_spots_are_one_path_if_the_other_drawing_has_them_so() -> None:
    path = area(*(r for s in SPOTS for r in s.rings), colour=RED)
    first, _, settled = gathered([PAGE, *SPOTS], [PAGE, path])
    assert (len(first), len(first[1].rings), settled) == (2, 3, ((1, 1),))


def test_holes_stay() -> None:
    holed = area(box(10, 40, 80, 20), box(15, 45, 10, 10), colour=RED)
    (whole,), _, _ = gathered([holed, BARS[1]], [CROSS])
    assert len(whole.rings) == 2
    assert shown((whole,)) == pytest.approx(2700)


@pytest.mark.parametrize(
    ("first", "second"),
    [
        ([BARS[0], area(box(40, 10, 20, 80), colour=BLUE)], [CROSS]),
        (BARS, BARS),
        (SPOTS[:2], [area(square(5, 5, 90), colour=RED)]),
        ([*BARS, area(square(45, 45, 5), colour=RED)], [BARS[0]]),
        ([BARS[0], area(box(30, 0, 30, 100), colour=BLUE), BARS[1]], [CROSS, PAGE]),
        ([BARS[0], line((0, 0), (9, 9))], [CROSS]),
    ],
    ids=["two paints", "two and two", "far larger", "one is enough", "one between", "a line"],
)
def test_what_is_not_one_stays_apart(first: list[Shape], second: list[Shape]) -> None:
    assert gathered(first, second) == (tuple(first), tuple(second), ())


def test_what_is_settled_or_named_stays_apart() -> None:
    assert gathered(BARS, [CROSS], ((0, 0),))[0] == tuple(BARS)
    beam = Shape(BARS[0].rings, BARS[0].style, "beam")
    assert gathered([beam, BARS[1]], [Shape(CROSS.rings, CROSS.style, "beam")])[2] == ()


def test_settled_pairs_are_found_again() -> None:
    dot = area(square(2, 2, 4), colour=BLUE)
    _, _, settled = gathered([*BARS, dot], [dot, CROSS], ((2, 0),))
    assert set(settled) == {(1, 0), (0, 1)}


def test_a_cross_of_bars_keeps_its_arms_all_the_way() -> None:
    page = area(square(0, 0, 100), colour=BLUE)
    slim = [area(box(5, 44, 90, 12), colour=RED), area(box(44, 5, 12, 90), colour=RED)]
    parts = prepare_elastic(drawing(page, *slim), drawing(page, CROSS)).movement.parts
    assert len(parts) == 2
    for t in (0.25, 0.5, 0.75):
        frame: Points = parts[1].curves(np.array([t]))[0]
        wide = 12 + 8 * t
        assert abs(Outline(frame).area) == pytest.approx(wide * (180 - 20 * t - wide), rel=0.1)
