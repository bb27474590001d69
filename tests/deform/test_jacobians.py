import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from shapetween.base.arrays import Floats
from shapetween.deform.jacobians import gradients, jacobians, polar_path, spread_angles
from shapetween.geometry.linearmaps import LinearMaps, as_complex
from tests.strategies import affine_maps, rotation

TRIANGLE = np.array([[[0.3, 0.1], [2.0, 0.5], [0.9, 1.7]]])


@given(affine_maps())
def test_the_jacobian_of_an_affine_map_is_its_matrix(affine: Floats) -> None:
    shape_gradients, areas = gradients(as_complex(TRIANGLE))
    np.testing.assert_allclose(areas, 1.24)
    moved = as_complex(TRIANGLE @ affine[:, :2].T + affine[:, 2])
    np.testing.assert_allclose(
        jacobians(shape_gradients, moved).matrices[0], affine[:, :2], atol=1e-12
    )


@given(affine_maps(), st.floats(0, 1), st.integers(-1, 1))
def test_paths_start_at_the_identity_end_at_the_matrix_and_run_backwards(
    affine: Floats, t: float, turns: int
) -> None:
    maps = LinearMaps.of(affine[:, :2])
    angle = maps.angles + 2 * np.pi * turns
    ends = polar_path(maps, angle, np.array([0.0, 1.0])).matrices
    np.testing.assert_allclose(ends, [np.eye(2), affine[:, :2]], atol=1e-9)
    forth = polar_path(maps, angle, np.array([t])).matrices[0]
    back = polar_path(maps.inverse(), -angle, np.array([1 - t])).after(maps).matrices[0]
    np.testing.assert_allclose(forth, back, atol=1e-9)
    root = (1 - t) + t * np.sqrt(np.linalg.det(affine[:, :2]))
    np.testing.assert_allclose(np.sqrt(np.linalg.det(forth)), root)


def test_a_turn_goes_its_way_evenly() -> None:
    path = polar_path(LinearMaps.of(rotation(1.2)), np.array(1.2), np.array([0.25]))
    np.testing.assert_allclose(path.matrices[0], rotation(0.3), atol=1e-12)


def test_angles_grow_along_a_strip_past_half_a_turn() -> None:
    corners = 40
    i = np.arange(corners - 2)
    triangles = np.where((i % 2 == 0)[:, None], [0, 1, 2], [1, 0, 2]) + i[:, None]
    true = np.linspace(0, 9, len(triangles)) - 4.5
    flags = np.ones(len(triangles), dtype=bool)
    known = np.angle(np.exp(1j * true))
    spread = spread_angles(known, triangles, np.ones(len(true)), flags, flags)
    np.testing.assert_allclose(spread, true, atol=1e-12)


def test_angles_do_not_leak_through_the_outside() -> None:
    # 0 - 1 - 2 inside, 3 outside between 0 and 2: the strip turns by 4 in all.
    triangles = np.array([[0, 1, 2], [1, 3, 2], [2, 3, 4], [0, 2, 4]])
    true = np.array([-2.0, 0.0, 2.0, 3.0])
    inside = np.array([True, True, True, False])
    spread = spread_angles(true, triangles, np.ones(4), inside, np.ones(4, dtype=bool))
    np.testing.assert_allclose(spread[:3], true[:3], atol=1e-12)


def test_the_longest_way_inside_comes_before_the_shortest_outside() -> None:
    """Steps inside that turn by nearly half a turn each, and one outside that does not turn."""
    triangles = np.array([[0, 1, 2], [1, 3, 2], [2, 3, 4], [0, 2, 4]])
    true = np.array([-3.1, 0.0, 3.1, 3.1 - 2 * np.pi])
    inside = np.array([True, True, True, False])
    spread = spread_angles(true, triangles, np.ones(4), inside, np.ones(4, dtype=bool))
    np.testing.assert_allclose(spread[:3], true[:3], atol=1e-12)
