"""Weights of a spline, against scipy's own."""

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

from shapetween.geometry.spline import spline_weights

T = np.linspace(0, 1, 53)


@pytest.mark.parametrize("count", [4, 5, 21])
def test_it_is_the_spline_without_knots_next_to_the_ends(count: int) -> None:
    even = np.linspace(0, 1, count)
    values = np.random.default_rng(count).normal(size=(count, 3))
    want = CubicSpline(even, values, bc_type="not-a-knot")(T)
    np.testing.assert_allclose(spline_weights(count, T) @ values, want, atol=1e-12)


def test_at_its_places_a_value_is_itself() -> None:
    np.testing.assert_allclose(spline_weights(9, np.linspace(0, 1, 9)), np.eye(9), atol=1e-14)
