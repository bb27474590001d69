"""Small contours: closed, their own curves at both ends, the same way round, turned as a whole."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from shapetween.fill.small import blend_small
from shapetween.geometry.bezier import curve_lengths
from shapetween.model.outline import Outline
from tests.drawings import line
from tests.match.shapes import disc, polygon, star
from tests.strategies import rotation

T = np.linspace(0, 1, 11)

seeds = st.integers(0, 80)


@settings(max_examples=8)
@given(seeds, seeds, st.booleans())
def test_contours_stay_closed_and_end_as_they_are(a: int, b: int, backwards: bool) -> None:
    source, target = polygon(star(a, 6)), polygon(star(b, 8))
    frames = blend_small(source, target.reversed() if backwards else target).curves(T)
    np.testing.assert_array_equal(frames[:, :, 0], np.roll(frames[:, :, 3], 1, axis=1))
    assert Outline(frames[0]).area == pytest.approx(source.area)
    assert Outline(frames[-1]).area == pytest.approx(target.area)


def test_a_contour_drawn_the_other_way_is_the_same() -> None:
    there = polygon(star(3, 6))
    for target in (there, there.reversed()):
        frames = blend_small(there, target).curves(T)
        np.testing.assert_allclose(frames, np.repeat(there.curves[None], len(T), axis=0))


def test_a_turned_contour_turns() -> None:
    """It keeps its size instead of shrinking through its middle."""
    there = polygon(np.array([[0.0, 0], [20, 0], [22, 3], [4, 4]]))
    matrix = np.column_stack([rotation(np.deg2rad(20)), [5.0, 1.0]])
    frames = blend_small(there, there.transformed(matrix)).curves(T)
    lengths = [curve_lengths(frame).sum() for frame in frames]
    np.testing.assert_allclose(lengths, lengths[0], rtol=0.05)


def test_round_contours_do_not_turn() -> None:
    assert blend_small(disc(), polygon(star(5, 9))).angle == 0


def test_contours_that_enclose_nothing_move_too() -> None:
    """There and back again, closed: it has no area to be matched by."""
    flat = Outline(line((0, 0), (10, 0), (0, 0)).rings[0].curves)
    frames = blend_small(flat, polygon(star(3))).curves(T)
    assert np.isfinite(frames).all()
    assert curve_lengths(frames[0]).sum() == pytest.approx(20)
