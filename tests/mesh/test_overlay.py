import numpy as np
import pytest
import shapely

from shapetween.base.arrays import Points
from shapetween.base.errors import OutlineError
from shapetween.geometry.polygon import corner_sines
from shapetween.mesh.overlay import overlay
from shapetween.mesh.repair import mesh_polygon, simple_nodes
from shapetween.mesh.simple import inner_diagonals
from tests.mesh.pairs import untangled

#: Two darts, reflex at neighbouring corners: neither diagonal is inside both.
DARTS = np.array(
    [
        [[0.0, 0.0], [3, 0], [1, 1], [0, 3]],
        [[0.0, 3.0], [0, 0], [3, 0], [1, 1]],
    ]
)


def test_two_darts_become_four_triangles_about_one_vertex() -> None:
    faces, inner = overlay(DARTS)
    assert sorted(sorted(face) for face in faces) == [[0, 1, 4], [0, 3, 4], [1, 2, 4], [2, 3, 4]]
    np.testing.assert_allclose(inner, [[[0.5, 0.5]], [[0.5, 0.5]]])


def without_common_diagonal(seed: int) -> Points:
    rng = np.random.default_rng(seed)
    while True:
        count = int(rng.integers(4, 8))
        rings = np.stack([untangled(rng, count), untangled(rng, count)])
        if not (inner_diagonals(rings[0]) & inner_diagonals(rings[1])).any():
            return rings


@pytest.mark.parametrize("seed", range(10))
def test_faces_are_convex_and_cover_both(seed: int) -> None:
    rings = without_common_diagonal(seed)
    faces, inner = overlay(rings)
    points = np.concatenate([rings, inner], axis=1)
    edges = [(a, b) for face in faces for a, b in zip(face, face[1:] + face[:1], strict=True)]
    assert len(edges) == len(set(edges))
    outer = {edge for edge in edges if edge[::-1] not in edges}
    assert outer == {(k, (k + 1) % rings.shape[1]) for k in range(rings.shape[1])}
    for shape in points:
        assert all(corner_sines(shape[face]).min() > 0 for face in faces)
        areas = [shapely.Polygon(shape[face]).area for face in faces]
        assert sum(areas) == pytest.approx(shapely.Polygon(shape[: rings.shape[1]]).area)


@pytest.mark.parametrize("seed", range(10))
def test_any_polygon_on_its_own_corners_is_meshed(seed: int) -> None:
    rng = np.random.default_rng(seed)
    rings = np.stack([untangled(rng, 14), untangled(rng, 14)])
    faces = mesh_polygon(rings)
    for shape, ring in zip(faces.points, rings, strict=True):
        covered = 0.0
        for face in (faces.quads, faces.triangles):
            assert corner_sines(shape[face]).min(initial=1.0) > 0
            covered += sum(shapely.Polygon(corners).area for corners in shape[face])
        assert covered == pytest.approx(shapely.Polygon(ring).area)


def test_nodes_are_added_until_their_polygon_is_simple() -> None:
    turn = np.linspace(0, 1.9 * np.pi, 60)
    along = np.stack([np.cos(turn), np.sin(turn)], axis=1)
    ring = np.concatenate([along, 0.8 * along[::-1]])
    points = np.stack([ring, ring])
    few = np.array([0, 20, 40, 100, 110])
    nodes = simple_nodes(points, few)
    assert set(few) < set(nodes)
    assert shapely.Polygon(ring[nodes]).is_valid


def test_crossing_samples_are_refused() -> None:
    eight = np.array([[0.0, 0.0], [3, 3], [3, 0], [0, 2]])
    with pytest.raises(OutlineError, match="crosses"):
        simple_nodes(np.stack([eight, eight]), np.arange(4))
