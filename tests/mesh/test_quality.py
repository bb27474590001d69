import numpy as np
from hypothesis import given

from shapetween.base.arrays import Points
from shapetween.geometry.polygon import corner_sines, polygon_area
from shapetween.mesh.quality import face_figures
from tests.strategies import convex_quads, rotation


def homography(source: Points, target: Points) -> Points:
    """From the eight linear equations of four corners, h33 = 1."""
    rows, right = [], []
    for (x, y), (u, v) in zip(source, target, strict=True):
        rows += [[x, y, 1, 0, 0, 0, -u * x, -u * y], [0, 0, 0, x, y, 1, -v * x, -v * y]]
        right += [u, v]
    return np.append(np.linalg.solve(np.array(rows), np.array(right)), 1.0).reshape(3, 3)


def unit(quad: Points) -> Points:
    centred = quad - quad.mean(axis=0)
    return np.asarray(centred / np.sqrt(polygon_area(centred)))


@given(convex_quads(), convex_quads())
def test_perspective_is_that_of_the_homography(p: Points, q: Points) -> None:
    p, q = unit(p), unit(q)
    w = np.column_stack([p, np.ones(4)]) @ homography(p, q)[2]
    np.testing.assert_allclose(face_figures(np.stack([p, q])).perspective, w.max() / w.min(), 1e-6)


@given(convex_quads(), convex_quads())
def test_sine_and_area_are_those_of_the_corners(p: Points, q: Points) -> None:
    figures = face_figures(np.stack([p, q]))
    np.testing.assert_allclose(figures.sine, corner_sines(np.stack([p, q])).min(), rtol=1e-6)
    np.testing.assert_allclose(figures.area, polygon_area(np.stack([p, q])).mean(), rtol=1e-6)


def test_a_rigid_motion_has_no_misfit() -> None:
    quad = np.array([[0.0, 0.0], [2, 0], [3, 2], [-1, 1]])
    moved = np.stack([quad, quad @ rotation(2.0).T + 7])
    np.testing.assert_allclose(face_figures(moved).misfit, 0, atol=1e-12)
    assert face_figures(np.stack([quad, quad * [1.0, 1.5]])).misfit > 0.1


def test_faces_that_are_not_convex_are_told() -> None:
    bow_tie = np.array([[0.0, 0.0], [1, 1], [1, 0], [0, 1]])
    dart = np.array([[0.0, 0.0], [2, 0], [0.5, 0.5], [0, 2]])
    square = np.array([[0.0, 0.0], [1, 0], [1, 1], [0, 1]])
    for bad in (bow_tie, dart, square[::-1]):
        figures = face_figures(np.stack([square, bad]))
        assert figures.sine < 0
        assert not figures.usable
        assert figures.perspective == np.inf
    assert face_figures(np.stack([square, square])).usable
