import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from shapetween.base.arrays import Index, Points
from shapetween.deform.untangle import Untangler, _newton
from shapetween.geometry.linearmaps import as_complex
from shapetween.geometry.polygon import polygon_area
from tests.strategies import grid


def _square(count: int) -> tuple[Points, Index, np.ndarray]:
    points, quads = grid(count, count)
    triangles = np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
    border = ((points == 0) | (points == count)).any(axis=1)
    return points, triangles, border


@settings(max_examples=20)
@given(st.integers(0, 10**6))
def test_vertices_thrown_about_come_back_in_order(seed: int) -> None:
    points, triangles, border = _square(6)
    thrown = points + np.where(
        border[:, None], 0, np.random.default_rng(seed).normal(0, 3, (49, 2))
    )
    placed, turned = Untangler.of(points, triangles, border).untangle(thrown)
    assert turned == 0
    assert (polygon_area(placed[triangles]) > 0).all()
    np.testing.assert_array_equal(placed[border], points[border])


def test_harmonic_places_are_affine_where_the_border_is() -> None:
    points, triangles, border = _square(5)
    image = points @ np.array([[1.0, 0.7], [-0.2, 2.0]]) + [3.0, 4.0]
    placed = Untangler.of(points, triangles, border).harmonic(np.where(border[:, None], image, 0))
    np.testing.assert_allclose(placed, image, atol=1e-12)


def test_an_impossible_border_ends_with_the_count() -> None:
    points, triangles, border = _square(4)
    turned_over = np.where(border[:, None], points * [-1.0, 1.0], points)
    placed, turned = Untangler.of(points, triangles, border).untangle(turned_over)
    assert turned == (polygon_area(placed[triangles]) <= 0).sum() > 0


@pytest.mark.parametrize("seed", range(4))
def test_rounding_does_not_grow_where_a_mesh_resists(seed: int) -> None:
    points, triangles, border = _square(10)
    rest = 10 * (points / 10) ** 5  # with triangles far smaller than others
    random = np.random.default_rng(seed)
    crumpled = np.where(border[:, None], rest + random.normal(0, 0.7, rest.shape), rest)
    untangler = Untangler.of(rest, triangles, border)
    start = untangler.harmonic(crumpled)
    noise = 1e-13 * random.normal(size=points.shape)
    ends = [untangler.untangle(one, patient=True)[0] for one in (start, start + noise)]
    np.testing.assert_allclose(ends[0], ends[1], rtol=0, atol=1e-10)


def test_newton_matrices_are_derivatives() -> None:
    """Against finite differences where no eigenvalue is raised: a map that is almost rigid."""
    rest = np.array([[0.0, 0.0], [1.0, 0.0], [0.3, 0.9]])
    untangler = Untangler.of(rest, np.array([[0, 1, 2]]), np.zeros(3, dtype=bool))
    turn = np.array([[0.8, -0.6], [0.6, 0.8]]) @ np.array([[1.05, 0.02], [0.0, 0.97]])
    x0 = (rest @ turn.T).ravel()

    def newton(x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        forces, blocks = _newton(
            untangler._state(as_complex(x.reshape(3, 2))), 0.1, untangler.shape_gradients
        )
        return forces[0], blocks[0]

    def energy(x: np.ndarray) -> float:
        edges = np.diff(x.reshape(3, 2), axis=0).T
        j = edges @ np.linalg.inv(np.diff(rest, axis=0).T)
        d = np.linalg.det(j)
        return float(((j**2).sum() + 1 + d**2) / (d + np.sqrt(d**2 + 0.01)))

    step = 1e-6 * np.eye(6)
    slope = [(energy(x0 + s) - energy(x0 - s)) / 2e-6 for s in step]
    forces, hessian = newton(x0)
    np.testing.assert_allclose(forces, slope, atol=1e-7)
    differences = [(newton(x0 + s)[0] - newton(x0 - s)[0]) / 2e-6 for s in step]
    assert np.linalg.eigvalsh(hessian).min() > -1e-12
    np.testing.assert_allclose(hessian, differences, atol=1e-5)
