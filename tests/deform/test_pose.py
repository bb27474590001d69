import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from shapetween.base.arrays import Floats
from shapetween.base.errors import OutlineError
from shapetween.deform.pose import Pose, affine_path
from tests.deform.shapes import blob
from tests.strategies import affine_maps, rotation


@given(affine_maps(), st.integers(0, 10**6))
def test_an_affine_image_is_reached_exactly(affine: Floats, seed: int) -> None:
    nodes = blob(seed, 12)
    nodes = (nodes - nodes.mean(axis=0)) / np.ptp(nodes)
    path = affine_path(nodes, nodes @ affine[:, :2].T)
    forth = path.at(np.array([0.3, 1.0])).matrices
    np.testing.assert_allclose(forth[1], affine[:, :2], atol=1e-9)
    back = path.reversed().at(np.array([0.7])).matrices[0]
    np.testing.assert_allclose(back @ path.matrix, forth[0], atol=1e-9)


def test_unlike_shapes_are_held_by_a_similarity() -> None:
    a, b = (p - p.mean(axis=0) for p in (blob(1, 12), blob(2, 12)))
    matrix = affine_path(a / np.ptp(a), b / np.ptp(b)).matrix
    assert matrix[0, 0] == pytest.approx(matrix[1, 1])
    assert matrix[1, 0] == pytest.approx(-matrix[0, 1])


def test_a_mirror_image_does_not_turn_the_plane_over() -> None:
    a = blob(3, 12)
    a = (a - a.mean(axis=0)) / np.ptp(a)
    assert np.linalg.det(affine_path(a, a * [-1, 1]).matrix) > 0


@pytest.mark.parametrize("sign", [1, -1])
def test_half_a_turn_goes_one_way_whatever_the_rounding(sign: int) -> None:
    a = blob(4, 12)
    a = (a - a.mean(axis=0)) / np.ptp(a)
    path = affine_path(a, a @ rotation(sign * (np.pi - 1e-13)).T)
    assert path.angle == pytest.approx(np.pi)


def test_a_shape_without_area_is_refused() -> None:
    with pytest.raises(OutlineError, match="area"):
        Pose.of(np.zeros((3, 2)), 0.0)


@pytest.mark.parametrize(("residual", "share"), [(0.0015, 0.0), (0.03, 0.58), (0.08, 1.0)])
def test_the_frame_shears_with_shapes_that_are_nearly_affine_images(
    residual: float, share: float
) -> None:
    """What rounding a matching leaves breaks no affine pair; what is unlike shears nothing."""
    a = blob(5, 24)
    a = (a - a.mean(axis=0)) / np.ptp(a)
    off = np.stack([np.sin(7 * np.arange(24.0)), np.cos(5 * np.arange(24.0))], axis=1)
    known = np.column_stack([a, np.ones(24)])
    off -= known @ np.linalg.lstsq(known, off, rcond=None)[0]  # what no affine map takes up
    off *= residual / np.sqrt((off**2).sum(axis=1).mean())
    sheared = np.array([[1.0, 0.6], [0.0, 1.1]])
    matrix = affine_path(a, a @ sheared.T + off).matrix

    def uneven(m: Floats) -> float:
        """What of a map is no similarity."""
        return float(np.hypot(m[0, 0] - m[1, 1], m[0, 1] + m[1, 0]))

    assert 1 - uneven(matrix) / uneven(sheared) == pytest.approx(share, abs=0.02)
