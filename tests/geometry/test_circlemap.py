"""Maps of the circle: back and forth, round and round, and bent."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from shapetween.base.arrays import Floats
from shapetween.base.errors import ShapeError
from shapetween.geometry.circlemap import CircleMap, turn, wrapped

#: Numbers well apart, so that no map is steeper than a few thousand.
steps = st.lists(st.integers(1, 60), min_size=2, max_size=12)
X = np.linspace(-3, 3, 601)


@st.composite
def maps(draw: st.DrawFn) -> CircleMap:
    x = np.cumsum([0, *draw(steps)], dtype=np.float64)
    size = len(x) - 1
    y = np.cumsum([0, *draw(st.lists(st.integers(1, 60), min_size=size, max_size=size))])
    x0, y0 = draw(st.floats(-0.9, 0.9)), draw(st.floats(-0.9, 0.9))
    return CircleMap(x / x[-1] + x0, y / y[-1] + y0)


def test_turn_and_wrapped_stay_in_their_halves_of_the_circle() -> None:
    values = np.array([-1.0, -0.25, 0.0, 0.5, 0.75, 1.0, 2.25, -1e-30])
    np.testing.assert_allclose(turn(values), [0, 0.75, 0, 0.5, 0.75, 0, 0.25, 0])
    np.testing.assert_allclose(wrapped(values), [0, -0.25, 0, -0.5, -0.25, 0, 0.25, 0], atol=1e-15)
    assert (turn(values) < 1).all()


@given(maps())
def test_a_turn_further_on_is_a_turn_further_on(circle: CircleMap) -> None:
    np.testing.assert_allclose(circle(X + 1), circle(X) + 1, atol=1e-12)
    assert (np.diff(circle(X)) > 0).all()
    np.testing.assert_allclose(circle(circle.x), circle.y, atol=1e-12)


@given(maps())
def test_the_inverse_goes_back(circle: CircleMap) -> None:
    np.testing.assert_allclose(circle.inverse()(circle(X)), X, atol=1e-10)
    np.testing.assert_allclose(circle(circle.inverse()(X)), X, atol=1e-10)


@given(maps(), st.lists(st.floats(0, 0.99), min_size=1, max_size=5, unique=True), st.floats(-9, 9))
def test_bent_takes_what_was_at_one_place_to_another(
    circle: CircleMap, places: list[float], twist: float
) -> None:
    """A move of the parameter by less than half the gaps keeps the order, so it is a map again."""
    old = np.sort(np.round(places, 2))
    old = old[np.append(True, np.diff(old) > 0.005)]
    gaps = np.append(old[1:], old[0] + 1) - old
    new = old + 0.4 * np.sin(twist * np.arange(len(old))) * min(gaps.min(), 0.4)
    bent = circle.bent(old, new)
    np.testing.assert_allclose(wrapped(bent(new) - circle(old)), 0, atol=1e-9)
    assert (np.diff(bent(X)) > 0).all()
    np.testing.assert_allclose(bent(X + 1), bent(X) + 1, atol=1e-12)


def test_bent_by_nothing_is_the_same() -> None:
    circle = CircleMap(np.array([0.0, 0.5, 1.0]), np.array([0.1, 0.4, 1.1]))
    nothing: Floats = np.zeros(0)
    assert circle.bent(nothing, nothing) is circle
    places = np.array([0.2, 0.7])
    np.testing.assert_allclose(circle.bent(places, places)(X), circle(X), atol=1e-12)


@pytest.mark.parametrize(
    ("x", "y"),
    [
        ([0.0, 0.6, 0.6, 1.0], [0.0, 0.3, 0.6, 1.0]),
        ([0.0, 0.5, 1.0], [0.0, 0.7, 0.9]),
        ([0.0, 1.0], [0.0, 0.5, 1.0]),
        ([0.0], [0.0]),
    ],
    ids=["flat", "no-turn", "uneven", "one-knot"],
)
def test_knots_that_are_no_map_are_refused(x: list[float], y: list[float]) -> None:
    with pytest.raises(ShapeError):
        CircleMap(np.array(x), np.array(y))


def test_a_knot_that_is_the_first_one_a_turn_later_is_the_first_one() -> None:
    """Places read from a file miss a knot by the last digit; the turn still closes."""
    circle = CircleMap(np.array([0.1, 0.6, 1.1]), np.array([0.2, 0.7, 1.2]))
    near = circle.bent(np.array([0.1 - 1e-14, 0.5]), np.array([0.1, 0.55]))
    assert near(np.array([0.1]))[0] == pytest.approx(0.2, abs=1e-9)
