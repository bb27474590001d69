"""Rings without a partner: whole at home, a point at the other end, even in size between."""

import numpy as np
import pytest

from shapetween.base.ends import End
from shapetween.fill.appearing import AppearingRegion
from shapetween.geometry.bezier import evaluate
from shapetween.model.outline import Outline
from tests.drawings import ring, square
from tests.match.shapes import polygon, star
from tests.movements import circle

T = np.linspace(0, 1, 11)


@pytest.mark.parametrize("end", list(End))
def test_whole_at_home_and_a_point_at_the_other_end(end: End) -> None:
    outline = polygon(10 * star(4))
    found = AppearingRegion.of(outline, (), end, None).curves(T)
    home, away = (found[-1], found[0]) if end is End.TARGET else (found[0], found[-1])
    np.testing.assert_array_equal(home, outline.curves)
    assert np.ptp(away.reshape(-1, 2), axis=0).max() < 1e-9
    sizes = [
        np.sqrt(abs(Outline(frame).area)) for frame in (found if end is End.TARGET else found[::-1])
    ]
    np.testing.assert_allclose(sizes, T * sizes[-1], atol=1e-6)


def test_the_point_lies_well_inside_a_crescent() -> None:
    """Its own middle does not."""
    outer, inner = circle(np.zeros(2), 10.0), circle(np.array([4.0, 0.0]), 8.0)
    crescent = ring(
        np.concatenate(
            [
                evaluate(outer[1:3], np.arange(9) / 8).reshape(-1, 2),
                evaluate(inner[1:3], np.arange(9) / 8).reshape(-1, 2)[::-1],
            ]
        )
    )
    centre = AppearingRegion.of(crescent, (), End.TARGET, None).centre
    assert np.linalg.norm(centre) < 10
    assert np.linalg.norm(centre - [4, 0]) > 8.5


def test_a_ring_of_which_nothing_is_left_closes_to_its_middle() -> None:
    """Slivers of holes are left over where crossing outlines are resolved."""
    sliver = ring(np.array([[0.0, 0.0], [10.0, 0.0], [10.0, 4.0], [10.0, 0.0]]))
    np.testing.assert_allclose(
        AppearingRegion.of(sliver, (), End.TARGET, None).centre, [5, 2], atol=5.1
    )
    assert np.isfinite(AppearingRegion.of(sliver, (), End.TARGET, None).curves(T)).all()


def test_holes_go_with_their_ring_and_run_against_it() -> None:
    outer, hole = square(0, 0, 10), square(2, 2, 3)
    found = AppearingRegion.of(outer, (hole,), End.TARGET, None)
    assert found.counts == (4, 4)
    for frame in found.curves(T[1:]):
        rings = Outline(frame[:4]), Outline(frame[4:])
        assert rings[0].area > 0 > rings[1].area
        assert abs(rings[1].area / rings[0].area) == pytest.approx(0.09)
    alone = AppearingRegion.of(hole, (), End.TARGET, None, is_hole=True)
    assert Outline(alone.curves(np.ones(1))[0]).area == pytest.approx(-9)


@pytest.mark.parametrize(
    "outline",
    [
        ring([(0, 0), (10, 10), (10, 0), (0, 10)]),
        ring([(0, 0), (8, 0), (8, 5), (20, 5), (8, 5), (8, 8), (0, 8)]),
    ],
    ids=["bow-tie", "spike"],
)
def test_outlines_that_are_not_simple_have_a_middle_too(outline: Outline) -> None:
    centre = AppearingRegion.of(outline, (), End.TARGET, None).centre
    assert (centre > 0).all()
    assert (centre < 10).all()


@pytest.mark.parametrize("unit", [1e-6, 1.0, 1e6])
def test_a_slot_closes_to_its_middle(unit: float) -> None:
    """Circles as large fit in all along it; the one at an end would be as good, but for the eye."""
    slot = polygon(unit * np.array([[0.0, 0.0], [10.0, 0.0], [10.0, 2.0], [0.0, 2.0]]))
    centre = AppearingRegion.of(slot, (), End.TARGET, None).centre
    np.testing.assert_allclose(centre, unit * np.array([5.0, 1.0]), rtol=1e-6)
