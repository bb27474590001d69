"""Cubic Bezier curves against de Casteljau's construction and known areas and lengths."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

from shapetween.base.arrays import Curves, Points
from shapetween.geometry.bezier import (
    curve_lengths,
    end_tangents,
    evaluate,
    flatten,
    line_curves,
    signed_area,
    sub_curves,
)
from tests.movements import circle

T = np.linspace(0, 1, 9)
stacks = arrays.arrays(np.float64, (3, 4, 2), elements=st.floats(-100, 100, width=32))
shares = st.floats(0, 1)


def casteljau(curve: Points, t: float) -> Points:
    while len(curve) > 1:
        curve = (1 - t) * curve[:-1] + t * curve[1:]
    return np.asarray(curve[0])


@given(stacks)
def test_points_are_de_casteljaus(curves: Curves) -> None:
    expected = [[casteljau(curve, t) for t in T] for curve in curves]
    np.testing.assert_allclose(evaluate(curves, T), expected, atol=1e-10)


@given(stacks, shares, shares)
def test_a_part_is_the_curve_between_two_parameters(curves: Curves, a: float, b: float) -> None:
    """Backwards too, where the first parameter is the greater."""
    parts = sub_curves(curves, np.full(3, a), np.full(3, b))
    np.testing.assert_allclose(evaluate(parts, T), evaluate(curves, a + (b - a) * T), atol=1e-9)


@given(stacks)
def test_the_whole_part_is_the_curve_itself(curves: Curves) -> None:
    zero, one = np.zeros(3), np.ones(3)
    np.testing.assert_array_equal(sub_curves(curves, zero, one), curves)
    np.testing.assert_array_equal(sub_curves(curves, one, zero), curves[:, ::-1])


def test_lines_run_evenly() -> None:
    lines = line_curves(np.array([[0.0, 0.0], [1.0, 5.0]]), np.array([[3.0, 6.0], [1.0, 5.0]]))
    np.testing.assert_allclose(evaluate(lines, T)[0], T[:, None] * [3.0, 6.0], atol=1e-14)
    np.testing.assert_allclose(evaluate(lines, T)[1], np.full((9, 2), [1.0, 5.0]))


def test_a_ring_is_flattened_without_its_last_point() -> None:
    ring = circle(np.zeros(2), 1.0)
    points = flatten(ring, 3)
    assert points.shape == (12, 2)
    np.testing.assert_allclose(points[::3], ring[:, 0])
    np.testing.assert_allclose(flatten(np.stack([ring, 2 * ring]), 3)[1], 2 * points)


def test_each_curve_may_have_its_own_number_of_chords() -> None:
    ring = circle(np.zeros(2), 1.0)
    rings = np.stack([ring, 2 * ring])
    pieces = np.array([3, 1, 5, 2])
    found = flatten(rings, pieces)
    wanted = [flatten(rings[:, k : k + 1], n) for k, n in enumerate(pieces.tolist())]
    np.testing.assert_allclose(found, np.concatenate(wanted, axis=1), atol=1e-15)
    np.testing.assert_array_equal(flatten(ring, pieces), found[0])


def test_lengths() -> None:
    lines = line_curves(np.array([[0.0, 0.0]]), np.array([[3.0, 4.0]]))
    np.testing.assert_allclose(curve_lengths(lines), [5])
    np.testing.assert_allclose(curve_lengths(lines, 0.2, 0.6), [2])
    np.testing.assert_allclose(curve_lengths(circle(np.zeros(2), 1.0)), np.pi / 2, rtol=3e-4)


@given(stacks, shares)
def test_lengths_of_parts_add_up(curves: Curves, middle: float) -> None:
    whole = curve_lengths(curves)
    parts = curve_lengths(curves, 0.0, middle) + curve_lengths(curves, middle, 1.0)
    dense = evaluate(curves, np.linspace(0, 1, 2001))
    polyline = np.linalg.norm(np.diff(dense, axis=1), axis=-1).sum(axis=1)
    np.testing.assert_allclose(whole, polyline, rtol=0.02, atol=1e-6)
    np.testing.assert_allclose(parts, polyline, rtol=0.02, atol=1e-6)


def test_tangents_where_handles_rest_on_their_ends() -> None:
    curves = np.array(
        [
            [[0, 0], [1, 0], [2, 1], [2, 3]],
            [[0, 0], [0, 0], [2, 0], [2, 2]],
            [[0, 0], [0, 0], [3, 4], [3, 4]],
            [[1, 1], [1, 1], [1, 1], [1, 1]],
        ],
        dtype=np.float64,
    )
    leaving, reaching = end_tangents(curves)
    np.testing.assert_allclose(leaving, np.array([[1, 0], [1, 0], [0.6, 0.8], [0, 0]]))
    np.testing.assert_allclose(reaching, np.array([[0, 1], [0, 1], [0.6, 0.8], [0, 0]]))


def test_area_is_positive_clockwise_as_drawn() -> None:
    ring = circle(np.array([50.0, -20.0]), 2.0)
    assert signed_area(ring) == pytest.approx(4 * np.pi, rel=1e-3)
    assert signed_area(ring[::-1, ::-1]) == pytest.approx(-4 * np.pi, rel=1e-3)


@given(stacks)
def test_area_is_that_of_the_finest_polygon(curves: Curves) -> None:
    closed = curves.copy()
    closed[:, 3] = np.roll(closed[:, 0], -1, axis=0)
    points = flatten(closed, 400)
    x, y = points.T
    polygon = (x * np.roll(y, -1) - y * np.roll(x, -1)).sum() / 2
    scale = np.ptp(closed, axis=(0, 1)).max() ** 2
    assert signed_area(closed) == pytest.approx(polygon, abs=1e-4 * scale + 1e-9)
