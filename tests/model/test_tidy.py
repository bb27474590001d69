"""However an outline was cut up, tidied it is the same few curves."""

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from shapetween.base.arrays import Curves
from shapetween.geometry.bezier import flatten, line_curves, sub_curves
from shapetween.model.outline import Outline
from shapetween.model.tidy import tidy
from tests.match.shapes import disc, polygon, rounded, star
from tests.movements import circle


def split(curves: Curves, index: int, t: float) -> Curves:
    """One curve cut in two."""
    one = curves[index : index + 1]
    zero, at, end = np.zeros(1), np.full(1, t), np.ones(1)
    first, second = sub_curves(one, zero, at), sub_curves(one, at, end)
    second[:, 0] = first[:, 3]
    first[:, 0], second[:, 3] = one[:, 0], one[:, 3]
    return np.concatenate([curves[:index], first, second, curves[index + 1 :]])


cuts = st.lists(st.tuples(st.floats(0, 0.999), st.floats(0.05, 0.95)), min_size=1, max_size=8)


@settings(max_examples=40)
@example(0, [(0.0, 0.125), (0.0, 0.125), (0.0, 0.0625), (0.0, 0.0625)], 0, False)
@given(st.integers(0, 20), cuts, st.integers(-3, 6), st.booleans())
def test_cut_curves_are_joined_again(
    seed: int, places: list[tuple[float, float]], size: int, curved: bool
) -> None:
    """At any places, again and again, of any size: as many curves, and the same ones."""
    points = star(seed) * 10.0**size
    whole = rounded(points) if curved else polygon(points)
    curves = whole.curves
    for where, t in places:
        curves = split(curves, int(where * len(curves)), t)
    found = tidy(Outline(curves))
    assert len(found.curves) == len(whole.curves)
    first = int(np.abs(found.curves[:, 0] - whole.curves[0, 0]).sum(axis=1).argmin())
    again = np.roll(found.curves, -first, axis=0)
    np.testing.assert_allclose(again, whole.curves, atol=1e-5 * np.ptp(points))


@given(st.integers(0, 20), st.booleans())
def test_what_is_tidy_stays_as_it_is(seed: int, curved: bool) -> None:
    whole = rounded(star(seed)) if curved else polygon(star(seed))
    np.testing.assert_array_equal(tidy(whole).curves, whole.curves)


def test_a_start_in_the_middle_of_a_curve_is_joined_over() -> None:
    curves = np.roll(split(disc().curves, 0, 0.4), -1, axis=0)
    assert len(tidy(Outline(curves)).curves) == 4


@pytest.mark.parametrize("gap", [1e-9, 1e-5])
def test_tiny_closing_lines_go(gap: float) -> None:
    """What editors leave between a rounded end and the start."""
    curves = circle(np.zeros(2), 1.0)
    end = curves[0, 0] + [0, -gap]
    curves[-1, 3] = end
    drawn = Outline(np.concatenate([curves, line_curves(end, curves[0, 0])[None]]))
    found = tidy(drawn)
    assert len(found.curves) == 4
    np.testing.assert_allclose(flatten(found.curves, 8), flatten(disc().curves, 8), atol=3e-4)


def test_small_but_visible_curves_stay() -> None:
    """A hundredth of the size is a detail, not a rounded digit."""
    notch = np.array([[0, 0], [1, 0], [1, 1], [0.51, 1], [0.505, 0.99], [0.5, 1], [0, 1]])
    assert len(tidy(polygon(notch)).curves) == 7


def test_corners_and_kinks_are_not_joined_over() -> None:
    bent = np.array([[0, 0], [0.5, 0.002], [1, 0], [1, 1], [0, 1]])
    assert len(tidy(polygon(bent)).curves) == 5


def test_curves_of_the_same_tangent_but_another_bend_are_not_joined() -> None:
    """A semicircle and a half ellipse meet smoothly."""
    curves = circle(np.zeros(2), 1.0)
    curves[1:3, :, 0] *= 2
    found = tidy(Outline(curves))
    assert len(found.curves) == 4


@pytest.mark.parametrize("count", [1, 2])
def test_as_few_as_one_curve_can_be_tidied(count: int) -> None:
    drop = Outline(np.array([[[0.0, 0.0], [2.0, -2.0], [2.0, 2.0], [0.0, 0.0]]]))
    curves = drop.curves if count == 1 else split(drop.curves, 0, 0.5)
    assert tidy(Outline(curves)).area == pytest.approx(drop.area)


def test_a_step_back_goes() -> None:
    """A closing line that runs past its start by a rounded digit encloses nothing."""
    corners = np.array(
        [[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [5.0, 10.0], [5.01, 10.0], [0.0, 10.0]]
    )
    ring = tidy(Outline(line_curves(corners, np.roll(corners, -1, axis=0))))
    np.testing.assert_array_equal(ring.curves[:, 0], corners[[0, 1, 2, 5]])


def test_a_spike_stays() -> None:
    corners = np.array(
        [[0.0, 0.0], [10.0, 0.0], [14.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0]]
    )
    ring = Outline(line_curves(corners, np.roll(corners, -1, axis=0)))
    assert tidy(ring).box.max() == 14.0
