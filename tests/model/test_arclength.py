import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from shapetween.base.arrays import Curves, Points
from shapetween.base.errors import OutlineError
from shapetween.geometry.bezier import evaluate, line_curves, sub_curves
from shapetween.model.arclength import ArcLength
from shapetween.model.outline import Outline


def wild_ring(seed: int, count: int = 8) -> Outline:
    """Curves with hooks, loops, handles of no length, a cusp and a curve of no length."""
    rng = np.random.default_rng(seed)
    ends = rng.normal(size=(count, 2))
    following = np.roll(ends, -1, axis=0)
    handles = rng.normal(size=(2, count, 2))
    curves = np.stack([ends, ends + handles[0], following + handles[1], following], axis=1)
    curves[1, 1] = curves[1, 0]
    curves[2, 1] = curves[2, 2] = curves[2, 0] + (0.5, 0.5)
    cusp = curves[3, 0] + [[0.0, 0.0], [1.0, 1.0], [0.0, 1.0], [1.0, 0.0]]
    curves[3], curves[4, 0] = cusp, cusp[3]
    return Outline(np.insert(curves, 5, curves[5, 0], axis=0))


def square() -> Outline:
    corners = np.array([[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]])
    return Outline(line_curves(corners, np.roll(corners, -1, axis=0)))


def dense(curves: Curves) -> Points:
    return evaluate(curves, np.linspace(0.0, 1.0, 20001)).reshape(-1, 2)


def test_length_against_chords() -> None:
    outline = wild_ring(1)
    # Chords fall short by the square of their size, so two counts of them give the limit.
    fine, coarse = (
        sum(
            np.linalg.norm(
                np.diff(evaluate(c[None], np.linspace(0, 1, n))[0], axis=0), axis=1
            ).sum()
            for c in outline.curves
        )
        for n in (80001, 40001)
    )
    assert ArcLength(outline).length == pytest.approx((4 * fine - coarse) / 3, rel=1e-9)


def test_circle() -> None:
    # Four cubics with handles of this size are a circle to 3e-4 of the radius.
    k = 0.5522847498
    arc = np.array([[1.0, 0.0], [1.0, k], [k, 1.0], [0.0, 1.0]])
    turn = np.array([[0.0, 1.0], [-1.0, 0.0]])
    curves = np.stack([arc @ np.linalg.matrix_power(turn, i) for i in range(4)])
    curves[:-1, 3], curves[-1, 3] = curves[1:, 0], curves[0, 0]
    arcs = ArcLength(Outline(curves))
    assert arcs.length == pytest.approx(2 * np.pi, rel=3e-4)
    np.testing.assert_allclose(arcs.joints, np.arange(4) / 4, atol=1e-15)


@settings(max_examples=25)
@given(st.integers(0, 10**6), st.sampled_from([1e-3, 1.0, 1e6]))
def test_places_round_trip(seed: int, unit: float) -> None:
    outline = wild_ring(seed).transformed(np.array([[unit, 0, 5 * unit], [0, unit, -3 * unit]]))
    arcs = ArcLength(outline)
    places = np.random.default_rng(seed).random(40)
    curve, t = arcs.locate(places)
    np.testing.assert_allclose(arcs.fraction(curve, t), places, atol=1e-13)
    _, distance = arcs.nearest(arcs.point(places))
    np.testing.assert_allclose(distance, 0.0, atol=1e-12 * arcs.length)


def test_fractions_measure_the_way_between() -> None:
    outline = wild_ring(4)
    arcs = ArcLength(outline)
    part = sub_curves(outline.curves[6:7], np.array([0.2]), np.array([0.7]))
    length = np.linalg.norm(np.diff(dense(part), axis=0), axis=1).sum()
    low, high = arcs.fraction(6, [0.2, 0.7])
    assert (high - low) * arcs.length == pytest.approx(length, rel=1e-7)


@settings(max_examples=25)
@given(st.integers(0, 10**6))
def test_nearest_against_samples(seed: int) -> None:
    outline = wild_ring(seed)
    arcs = ArcLength(outline)
    points = np.random.default_rng(seed).normal(size=(5, 2)) * 2
    fraction, distance = arcs.nearest(points)
    np.testing.assert_allclose(np.linalg.norm(arcs.point(fraction) - points, axis=1), distance)
    sampled = np.linalg.norm(dense(outline.curves) - points[:, None], axis=-1).min(axis=1)
    assert (distance <= sampled + 1e-12).all()


def test_joints_belong_to_the_curve_that_starts() -> None:
    outline = wild_ring(2)
    arcs = ArcLength(outline)
    curve, t = arcs.locate(arcs.joints)
    np.testing.assert_array_equal(curve, [0, 1, 2, 3, 4, 6, 6, 7, 8])
    np.testing.assert_array_equal(t, 0.0)
    np.testing.assert_allclose(arcs.fraction(np.arange(8), 1.0), arcs.joints[1:], atol=1e-11)


def test_closed_outlines_wrap_and_open_ones_end() -> None:
    closed = square()
    ends = ArcLength(closed).point([-0.25, 0.75, 1.75])
    np.testing.assert_allclose(ends, [[0.0, 4.0]] * 3, atol=1e-14)
    rest = ArcLength(Outline(closed.curves[:2], closed=False))
    np.testing.assert_allclose(rest.point([-1.0, 0.5, 2.0]), [[0, 0], [4, 0], [4, 4]], atol=1e-14)


def test_tangents() -> None:
    arcs = ArcLength(square())
    np.testing.assert_allclose(
        arcs.tangent([[0.1, 0.3], [0.6, 0.8]]), [[[1, 0], [0, 1]], [[-1, 0], [0, -1]]], atol=1e-15
    )


def test_a_point_has_no_length() -> None:
    with pytest.raises(OutlineError, match="single point"):
        ArcLength(Outline(np.ones((1, 4, 2))))
