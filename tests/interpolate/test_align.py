"""Force equilibrium: the paper's section 5."""

import numpy as np
import pytest

from shapetween.base.arrays import Points
from shapetween.interpolate.align import Alignment, Equilibrium
from shapetween.mesh.pair import MeshPair
from tests.strategies import grid

FIGURE_3 = np.array([[0, 1, 2, 3], [1, 2, 4, 5], [2, 3, 6, 4]])


def test_matrix_of_figure_3() -> None:
    matrix = Equilibrium.of([FIGURE_3], 7).matrix.toarray()
    np.testing.assert_array_equal(matrix, [[4, -2, -2], [-2, 4, -2], [-2, -2, 4]])
    assert np.linalg.matrix_rank(matrix) == 2


def test_rank_falls_by_one_for_each_component() -> None:
    vertices, quads = grid(3, 2)
    several = np.concatenate([quads, quads + len(vertices), quads + 2 * len(vertices)])
    system = Equilibrium.of([several], 3 * len(vertices))
    assert len(np.unique(system.components)) == 3
    assert np.linalg.matrix_rank(system.matrix.toarray()) == len(several) - 3


def test_faces_touching_at_one_vertex_are_one_component() -> None:
    system = Equilibrium.of([np.array([[0, 1, 2, 3], [2, 4, 5, 6]])], 7)
    assert len(np.unique(system.components)) == 1


def loose(pair: MeshPair, seed: int) -> Points:
    rng = np.random.default_rng(seed)
    faces = [f for f in (pair.quads, pair.triangles) if len(f)]
    corners = np.concatenate([pair.source[f].reshape(-1, 2) for f in faces])
    return corners + rng.normal(0, 0.1, corners.shape)


@pytest.fixture
def mixed() -> MeshPair:
    """A strip of quads with two triangles, and a quad that touches nothing."""
    vertices, quads = grid(4, 2)
    apart = np.array([[9.0, 0.0], [10.0, 0.0], [10.0, 1.0], [9.0, 1.0]])
    points = np.concatenate([vertices, apart])
    first = quads[0]
    triangles = np.array([first[[0, 1, 2]], first[[0, 2, 3]]])
    lonely = np.arange(len(vertices), len(points))
    return MeshPair(points, points, np.concatenate([quads[1:], [lonely]]), triangles)


def test_equilibrium_and_averaging_minimise_the_joint_energy(mixed: MeshPair) -> None:
    """Against a dense least-squares solution for translations and vertices at once."""
    faces = [mixed.quads, mixed.triangles]
    corners = loose(mixed, 1)
    vertex = np.concatenate([f.ravel() for f in faces])
    face = np.repeat(np.arange(9 + 1), [4] * len(mixed.quads) + [3] * len(mixed.triangles))
    valence = np.bincount(vertex)
    count_f, count_v = face.max() + 1, len(mixed.source)
    weight = np.sqrt(valence[vertex])[:, None]
    system = np.zeros((len(vertex), count_f + count_v))
    rows = np.arange(len(vertex))
    system[rows, face] = 1
    system[rows, count_f + vertex] = -1
    best = np.linalg.lstsq(weight * system, -weight * corners, rcond=None)[0][count_f:]
    got = Alignment(mixed, np.ones(count_f)).vertices(corners[None])[0]
    # Each component is free to move as a whole: compare after removing the mean.
    for part in (np.arange(count_v - 4), np.arange(count_v - 4, count_v)):
        np.testing.assert_allclose(
            got[part] - got[part].mean(axis=0), best[part] - best[part].mean(axis=0), atol=1e-9
        )


def test_net_translation_is_zero_in_every_component(mixed: MeshPair) -> None:
    corners = loose(mixed, 2)
    weights = np.arange(1.0, 11.0)
    face = np.repeat(np.arange(10), [4] * len(mixed.quads) + [3] * len(mixed.triangles))
    got = Alignment(mixed, weights).vertices(corners[None])[0]
    faces = [mixed.quads, mixed.triangles]
    vertex = np.concatenate([f.ravel() for f in faces])
    # Averaging over a vertex moves no mean: weigh corner offsets so that each face's is its own.
    moved = got[vertex] - corners
    system = Equilibrium.of(faces, len(mixed.source))
    forces = system.forces(corners)
    translation = np.linalg.lstsq(system.matrix.toarray(), forces, rcond=None)[0]
    for part in np.unique(system.components):
        inside = system.components == part
        shift = np.average(translation[inside], axis=0, weights=weights[inside])
        translation[inside] -= shift
    wanted = np.zeros_like(got)
    np.add.at(wanted, vertex, corners + translation[face])
    wanted /= np.bincount(vertex)[:, None]
    np.testing.assert_allclose(got, wanted, atol=1e-10)
    assert np.abs(moved).max() > 0.01


def test_aligned_corners_are_left_where_they_are(mixed: MeshPair) -> None:
    faces = [mixed.quads, mixed.triangles]
    corners = np.concatenate([mixed.source[f].reshape(-1, 2) for f in faces])
    alignment = Alignment(mixed, np.ones(10))
    np.testing.assert_allclose(alignment.vertices(corners[None])[0], mixed.source, atol=1e-12)


def test_residual_measures_what_alignment_could_not_mend(mixed: MeshPair) -> None:
    faces = [mixed.quads, mixed.triangles]
    corners = np.concatenate([mixed.source[f].reshape(-1, 2) for f in faces])[None]
    alignment = Alignment(mixed, np.ones(10))
    assert alignment.residual(corners, alignment.vertices(corners))[0] < 1e-12
    rough = loose(mixed, 3)[None]
    assert alignment.residual(rough, alignment.vertices(rough))[0] > 0.01
