"""Insides of faces: homographies and triangles, against differences and closed forms."""

import numpy as np
import pytest
from hypothesis import given, settings

from shapetween.base.arrays import Points
from shapetween.geometry.homography import apply_homography, quad_homographies
from shapetween.geometry.polygon import diagonal_crossings, polygon_area
from shapetween.interpolate.inside import Inside, Interior, quad_places
from shapetween.mesh.pair import MeshPair
from tests.strategies import convex_quads, grid, rotation

ONE = np.arange(4)[None]
KINDS: list[Interior] = ["homography", "triangles"]


@settings(max_examples=40)
@given(p=convex_quads(), q=convex_quads())
def test_jacobians_are_differences_of_points(p: Points, q: Points) -> None:
    pair = MeshPair(p, q, ONE)
    inside = Inside.of(pair, "homography")
    got = inside.jacobians(q[None], 3)[0][0]
    places, _ = quad_places(p[None], 3)
    step = 1e-6 * np.ptp(p, axis=0).max()
    for axis, offset in enumerate(step * np.eye(2)):
        ahead, behind = (inside.points(q[None], places + s * offset)[0, 0] for s in (1, -1))
        slope = (ahead - behind) / (2 * step)
        np.testing.assert_allclose(got[:, :, axis], slope, atol=1e-5 * np.abs(got).max())


@given(p=convex_quads())
def test_areas_of_the_places_add_up(p: Points) -> None:
    _, areas = quad_places(p[None], 4)
    np.testing.assert_allclose(areas.sum(), abs(polygon_area(p)), rtol=1e-12)


@pytest.mark.parametrize("kind", KINDS)
def test_affine_movement_carries_affinely(kind: Interior) -> None:
    vertices, quads = grid(2, 2)
    matrix = rotation(0.4) @ np.diag([2.0, 0.5])
    moved = vertices @ matrix.T + [3.0, 1.0]
    inside = Inside.of(MeshPair(vertices, moved, quads[1:], np.array([[0, 1, 4]])), kind)
    places, _ = quad_places(vertices[quads[1:]], 3)
    frames = np.stack([vertices, moved])
    carried = inside.points(frames, places)
    np.testing.assert_allclose(carried[0], places, atol=1e-12)
    np.testing.assert_allclose(carried[1], places @ matrix.T + [3.0, 1.0], atol=1e-12)
    jacobians, areas = inside.jacobians(frames, 2)
    np.testing.assert_allclose(
        jacobians[1], np.broadcast_to(matrix, jacobians[1].shape), atol=1e-12
    )
    assert areas.sum() == pytest.approx(3.5)
    np.testing.assert_allclose(inside.least_weights(frames), 1.0)


def test_triangles_carry_by_the_triangle_that_holds_the_point() -> None:
    square, target = grid(1, 1)[0][[0, 1, 3, 2]], np.array([[0.0, 0], [1, 0], [3, 3], [0, 1]])
    inside = Inside.of(MeshPair(square, target, ONE), "triangles")
    # Split from corner 1 to 3, along which the two halves agree.
    assert {tuple(t) for t in inside.triangles.tolist()} == {(1, 2, 3), (1, 3, 0)}
    got = inside.points(target[None], np.array([[[0.5, 0.5], [0.2, 0.2], [0.8, 0.8]]]))[0, 0]
    np.testing.assert_allclose(got, [[0.5, 0.5], [0.2, 0.2], [2.0, 2.0]], atol=1e-12)


@given(p=convex_quads(), q=convex_quads())
def test_homographies_take_the_crossing_of_the_diagonals_along(p: Points, q: Points) -> None:
    got = apply_homography(quad_homographies(p, q), diagonal_crossings(p)[None])[0]
    np.testing.assert_allclose(got, diagonal_crossings(q), atol=1e-7 * np.abs(q).max())


def test_least_weight_is_the_ratio_along_the_steepest_quad() -> None:
    square, target = grid(1, 1)[0][[0, 1, 3, 2]], np.array([[0.0, 0], [4, 0], [3, 2], [1, 2]])
    inside = Inside.of(MeshPair(square, target, ONE), "homography")
    # Parallel sides of 4 and 2: w differs by their ratio.
    np.testing.assert_allclose(inside.least_weights(np.stack([square, target])), [1.0, 0.5])
