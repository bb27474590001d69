import numpy as np
import pytest

from shapetween.deform.banded import BandPattern, BandSystem, numbered


def _dense(elements: np.ndarray, blocks: np.ndarray, count: int) -> np.ndarray:
    matrix = np.zeros((count, count))
    for corners, block in zip(elements, blocks, strict=True):
        for i, row in zip(corners, block, strict=True):
            for j, value in zip(corners, row, strict=True):
                if i >= 0 and j >= 0:
                    matrix[i, j] += value
    return matrix


@pytest.fixture
def chain() -> tuple[np.ndarray, np.ndarray]:
    random = np.random.default_rng(0)
    order = random.permutation(20)
    elements = np.stack([order[:-2], order[1:-1], order[2:]], axis=1)
    root = random.normal(size=(18, 3, 3))
    return elements, root @ np.swapaxes(root, 1, 2)


def test_a_band_holds_the_sum_of_the_blocks(chain: tuple[np.ndarray, np.ndarray]) -> None:
    elements, blocks = chain
    unknowns, free = numbered(elements, np.zeros(20, dtype=bool))
    assert (free[unknowns] == elements).all()
    pattern = BandPattern.of(unknowns, 20)
    assert pattern.height <= 4  # a chain of triples, numbered from one end to the other
    dense = _dense(unknowns, blocks, 20)
    for below, row in enumerate(pattern.band(blocks)):
        np.testing.assert_allclose(row[: 20 - below], np.diagonal(dense, -below))
    ones = np.ones((18, 3))
    np.testing.assert_allclose(pattern.vector(ones), np.bincount(unknowns.ravel()))


def test_of_vertices_with_as_many_beside_them_the_first_comes_first() -> None:
    rows = np.arange(180).reshape(60, 3)
    chains = np.concatenate([rows[:, :2], rows[:, 1:]])
    _, free = numbered(chains, np.zeros(180, dtype=bool))
    assert free[::-1].tolist() == list(range(180))


def test_a_system_with_known_points_is_solved(chain: tuple[np.ndarray, np.ndarray]) -> None:
    elements, start = chain
    elements = np.concatenate([elements, [[3, 5, -1]]])
    start = np.concatenate([start, np.ones((1, 3, 3))])
    end, fixed = 2 * start[::-1] + np.eye(3), np.arange(20) < 3
    random = np.random.default_rng(1)
    points = random.normal(size=(2, 20)) + 1j * random.normal(size=(2, 20))
    parts = random.normal(size=(2, 19, 3)) + 1j * random.normal(size=(2, 19, 3))
    t = np.array([0.0, 0.3])
    system = BandSystem.of(elements, fixed, start, end)
    solved = system.solver(t, points)(parts)
    for frame, s in enumerate(t):
        matrix = _dense(elements, (1 - s) * start + s * end, 20)
        right = np.zeros(20, dtype=np.complex128)
        for corners, part in zip(elements, parts[frame], strict=True):
            used = corners >= 0
            right[corners[used]] += part[used]
        np.testing.assert_allclose(matrix[3:] @ solved[frame], right[3:], atol=1e-9)
        np.testing.assert_array_equal(solved[frame, :3], points[frame, :3])
