"""What prices are worth against each other: the sentences that stand beside the constants."""

import numpy as np
import pytest

from shapetween.mesh.prices import QUAD_PRICE, quad_prices, side_prices, triangle_prices
from shapetween.mesh.quality import FaceFigures


def figures(
    sine: float = 0.9, perspective: float = 1.0, area: float = 0.1, misfit: float = 0.0
) -> FaceFigures:
    return FaceFigures(*(np.array([value]) for value in (sine, perspective, area, misfit)))


def price(**values: float) -> float:
    return float(quad_prices(figures(**values))[0])


def test_a_sound_quad_costs_only_itself() -> None:
    assert price() == pytest.approx(QUAD_PRICE)
    assert price(sine=0.61) == price()  # a round corner is free


def test_a_perspective_of_four_costs_a_quad() -> None:
    assert price(perspective=4.0) - price() == pytest.approx(QUAD_PRICE, rel=0.1)


def test_two_quads_alike_are_cheaper_than_one_that_shears() -> None:
    assert 2 * price() < price(misfit=0.6) < 3 * price()


def test_a_needle_of_a_quad_costs_several() -> None:
    assert 3.5 * QUAD_PRICE < price(sine=0.13) - price() < 4 * QUAD_PRICE


def test_what_no_quad_covers_costs_more_than_many_quads() -> None:
    hundredth = float(side_prices(np.array([[0.01], [0.01]]))[0])
    assert 3 * QUAD_PRICE < hundredth < 4 * QUAD_PRICE
    assert price(perspective=7.0) > price(perspective=5.9) + 18.0  # it does not move well
    alone = price(perspective=6.01, area=0.0) - price(perspective=5.99, area=0.0)
    assert 2.5 * QUAD_PRICE < alone < 3.5 * QUAD_PRICE
    triangle = float(triangle_prices(figures(area=0.01))[0])
    assert 6 * QUAD_PRICE < triangle < 7 * QUAD_PRICE


def test_what_has_to_be_cut_anew_is_the_last_resort() -> None:
    assert 25 < price(sine=0.04, area=0.0) - price(sine=0.06, area=0.0) < 35
    assert 3 < price(sine=-0.95, area=0.0) - price(sine=0.04, area=0.0) < 5  # the more bent
