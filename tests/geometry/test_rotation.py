"""Rotations taken out of linear maps, put back, and kept coherent over faces."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from shapetween.base.arrays import Floats
from shapetween.geometry.rotation import coherent_angles, linear_between, polar, rotations
from tests.strategies import affine_maps, rotation

TURN = 2 * np.pi


@given(affine_maps())
def test_taken_apart_and_put_together(matrix: Floats) -> None:
    linear = matrix[:, :2]
    angle, stretch = polar(linear)
    np.testing.assert_allclose(rotations(angle) @ stretch, linear, atol=1e-10)
    np.testing.assert_allclose(stretch, stretch.T, atol=1e-12)
    assert (np.linalg.eigvalsh(stretch) > 0).all()


@pytest.mark.parametrize("degrees", [-170, -90, 0, 30, 90, 179, 180])
def test_a_turn_is_a_turn_and_no_stretch(degrees: float) -> None:
    angle, stretch = polar(3.0 * rotation(np.deg2rad(degrees)))
    assert np.rad2deg(angle) == pytest.approx(degrees)
    np.testing.assert_allclose(stretch, 3 * np.eye(2), atol=1e-12)


def test_positive_angles_turn_x_towards_y() -> None:
    np.testing.assert_allclose(rotations(np.array([np.pi / 2]))[0] @ [1, 0], [0, 1], atol=1e-15)


@given(affine_maps())
def test_between_starts_at_rest_and_ends_at_the_map(matrix: Floats) -> None:
    linear = matrix[:, :2]
    angle, stretch = (part[None] for part in map(np.asarray, polar(linear)))
    between = linear_between(angle, stretch, np.array([0.0, 0.5, 1.0]))[:, 0]
    np.testing.assert_allclose(between[0], np.eye(2))
    np.testing.assert_allclose(between[2], linear, atol=1e-10)
    half = rotation(float(angle[0]) / 2) @ (np.eye(2) + stretch[0]) / 2
    np.testing.assert_allclose(between[1], half, atol=1e-10)


@given(
    st.lists(st.floats(-1.4, 1.4), min_size=2, max_size=30),
    st.lists(st.integers(-2, 2), min_size=30, max_size=30),
)
def test_a_strip_that_bends_turns_without_a_jump(steps: list[float], turns: list[int]) -> None:
    """Whatever whole turns its angles are given with: it bends as it did, and its mean is small."""
    true = np.cumsum(steps)
    given_angles = true + TURN * np.array(turns[: len(true)])
    neighbours = np.stack([np.arange(len(true) - 1), np.arange(1, len(true))], axis=1)
    found = coherent_angles(given_angles, neighbours, np.ones(len(true)))
    np.testing.assert_allclose(np.diff(found), np.diff(true), atol=1e-9)
    whole = (found - true) / TURN
    np.testing.assert_allclose(whole, np.round(whole), atol=1e-9)
    assert -np.pi - 1e-6 < found.mean() < np.pi + 1e-6


def test_each_component_is_turned_by_itself() -> None:
    angles = np.array([3.0, -3.0, 0.1, TURN + 0.2])
    found = coherent_angles(angles, np.array([[0, 1], [2, 3]]), np.ones(4))
    np.testing.assert_allclose(found, [3.0, TURN - 3.0, 0.1, 0.2])


def test_half_a_turn_is_positive_however_it_is_rounded() -> None:
    none = np.zeros((0, 2), dtype=np.intp)
    for angle in (np.pi, -np.pi, np.pi - 1e-13, -np.pi + 1e-13):
        found = coherent_angles(np.array([angle]), none, np.ones(1))
        assert found[0] == pytest.approx(np.pi)


def test_a_ring_that_cannot_close_is_cut_where_faces_disagree_most() -> None:
    """Once round a hole the angles gain a turn; the seam falls on the largest step."""
    angles = np.array([0.0, 0.5, 1.0, 1.5, 2.0, 4.5])
    neighbours = np.array([[k, (k + 1) % 6] for k in range(6)])
    found = coherent_angles(angles, neighbours, np.ones(6))
    steps = np.diff(np.append(found, found[0]))
    assert np.abs(steps[[0, 1, 2, 3, 5]]).max() < 1.8
    assert abs(steps[4]) > 2
