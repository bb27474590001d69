import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from shapetween.geometry.affine import IDENTITY, affine, compose, inverted, mapped, stretch

MAP = affine(0.3, 1.7, -2.1, 0.4, 5.0, -0.7)


def test_equal_points_stay_equal_wherever_they_stand() -> None:
    """A matrix product may sum the last rows of an array in another order than the first."""
    point = np.array([1 / 3, 2 / 7])
    for count in range(1, 40):
        moved = mapped(np.tile(point, (count, 1)), MAP)
        assert (moved == mapped(point, MAP)).all()


@given(st.lists(st.floats(-3, 3), min_size=6, max_size=6))
def test_a_map_and_its_inverse_undo_each_other(numbers: list[float]) -> None:
    matrix = affine(*numbers)
    if abs(np.linalg.det(matrix[:, :2])) < 0.1:
        return
    points = np.array([[0.0, 0.0], [3.0, -1.0], [0.5, 8.0]])
    np.testing.assert_allclose(mapped(mapped(points, matrix), inverted(matrix)), points, atol=1e-9)
    np.testing.assert_allclose(compose(inverted(matrix), matrix), IDENTITY, atol=1e-9)


def test_a_map_onto_a_line_has_no_inverse() -> None:
    with pytest.raises(np.linalg.LinAlgError):
        inverted(affine(1, 2, 2, 4, 0, 0))


def test_stretch_is_the_ratio_of_scales() -> None:
    assert stretch(affine(0, 2, -2, 0, 5, 5)) == pytest.approx(1)
    assert stretch(affine(2, 0, 0, -0.5, 0, 0)) == pytest.approx(4)
