import numpy as np

from shapetween.geometry.polygon import corner_sines, polygon_area
from shapetween.mesh.inner import joined_triangles, smoothed
from tests.mesh.pairs import regular


def test_an_inner_vertex_moves_to_where_corners_are_wide() -> None:
    ring = regular(5)
    off = np.array([[0.7, 0.1], [-0.5, 0.4]])
    points = np.stack([np.concatenate([ring, off[:1]]), np.concatenate([ring, off[1:]])])
    fan = np.array([[k, (k + 1) % 5, 5] for k in range(5)])
    moved = smoothed(points, 5, [fan])
    np.testing.assert_array_equal(moved[:, :5], points[:, :5])
    before, after = corner_sines(points[:, fan]), corner_sines(moved[:, fan])
    assert (after.min(axis=(1, 2)) > before.min(axis=(1, 2)) + 0.2).all()
    assert np.linalg.norm(moved[:, 5], axis=-1).max() < 0.3


def test_triangles_are_joined_in_pairs_and_none_is_lost() -> None:
    ring = regular(7)
    points = np.stack([ring, ring * [2.0, 1.0]])
    fan = np.array([[0, k, k + 1] for k in range(1, 6)])
    quads, triangles = joined_triangles(points, fan)
    assert len(quads) == 2
    assert len(triangles) == 1
    assert (corner_sines(points[:, quads]) > 0).all()
    area = polygon_area(points[:, quads]).sum(axis=1) + polygon_area(points[:, triangles]).sum(1)
    np.testing.assert_allclose(area, polygon_area(points))


def test_triangles_that_make_no_convex_quad_stay() -> None:
    dart = np.array([[0.0, 0.0], [2, 0], [0.4, 0.4], [0, 2]])
    triangles = np.array([[0, 1, 2], [0, 2, 3]])
    quads, left = joined_triangles(np.stack([dart, dart]), triangles)
    assert len(quads) == 0
    np.testing.assert_array_equal(left, triangles)
