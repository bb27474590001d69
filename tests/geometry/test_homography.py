"""Homographies of quads: corners, lines and crossings are kept, and Jacobians are slopes."""

import numpy as np
import pytest
from hypothesis import given

from shapetween.base.arrays import Floats, Quads
from shapetween.geometry.homography import (
    apply_homography,
    homogeneous_weights,
    homography_jacobians,
    quad_homographies,
    triangle_affinities,
)
from shapetween.geometry.polygon import diagonal_crossings, rms_radius
from tests.strategies import affine_maps, convex_quads


@given(convex_quads(), convex_quads())
def test_corners_and_crossings_of_diagonals_go_to_each_other(p: Quads, q: Quads) -> None:
    matrix = quad_homographies(p, q)
    size = float(rms_radius(q))
    np.testing.assert_allclose(apply_homography(matrix, p), q, atol=1e-8 * size)
    crossing = apply_homography(matrix, diagonal_crossings(p)[None])[0]
    np.testing.assert_allclose(crossing, diagonal_crossings(q), atol=1e-7 * size)
    assert (homogeneous_weights(matrix, p) > 0).all()
    assert matrix[2] @ [*p.mean(axis=0), 1] == pytest.approx(1)


@given(convex_quads(), convex_quads())
def test_back_is_the_inverse(p: Quads, q: Quads) -> None:
    product = quad_homographies(q, p) @ quad_homographies(p, q)
    points = p.mean(axis=0) + 0.3 * (p - p.mean(axis=0))
    close = 1e-6 * float(rms_radius(p))
    np.testing.assert_allclose(apply_homography(product, points), points, atol=close)


@given(convex_quads(), affine_maps())
def test_an_affine_image_has_an_affine_homography(p: Quads, matrix: Floats) -> None:
    q = p @ matrix[:, :2].T + matrix[:, 2]
    found = quad_homographies(p, q)
    scale = float(np.abs(matrix).max() + rms_radius(q) / rms_radius(p))
    np.testing.assert_allclose(found[:2, :2], matrix[:, :2], atol=1e-7 * scale)
    weights = homogeneous_weights(found, p)
    np.testing.assert_allclose(weights, 1, atol=1e-8)


@given(convex_quads(), convex_quads())
def test_jacobians_are_the_slopes(p: Quads, q: Quads) -> None:
    matrix = quad_homographies(p, q)
    place = p.mean(axis=0)
    step = 1e-5 * rms_radius(p)
    near = place + step * np.array([[1, 0], [-1, 0], [0, 1], [0, -1]])
    image = apply_homography(matrix, near)
    slopes = np.stack([image[0] - image[1], image[2] - image[3]], axis=-1) / (2 * step)
    found = homography_jacobians(matrix, place[None])[0]
    np.testing.assert_allclose(found, slopes, atol=1e-5 * np.abs(slopes).max())
    weight = homogeneous_weights(matrix, place[None])[0]
    assert np.linalg.det(found) == pytest.approx(np.linalg.det(matrix) / weight**3, rel=1e-6)


def test_many_at_a_time_are_each_alone() -> None:
    rng = np.random.default_rng(5)
    square = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
    p, q = (square + rng.uniform(-0.2, 0.2, (3, 5, 4, 2)) for _ in range(2))
    stacked = quad_homographies(p, q)
    assert stacked.shape == (3, 5, 3, 3)
    np.testing.assert_allclose(stacked[1, 2], quad_homographies(p[1, 2], q[1, 2]), atol=1e-12)


@given(affine_maps())
def test_triangles_tell_their_affine_map(matrix: Floats) -> None:
    triangle = np.array([[[1.0, 2.0], [4.0, 2.5], [2.0, 5.0]]])
    image = triangle @ matrix[:, :2].T + matrix[:, 2]
    np.testing.assert_allclose(triangle_affinities(triangle, image)[0], matrix[:, :2], atol=1e-10)
