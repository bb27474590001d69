"""Points on moving planes: exact at both ends, whichever end they come from."""

import numpy as np
import pytest

from shapetween.attach.planes import AffinePlane, Finder, MeshPlane
from shapetween.base.arrays import Floats, Points
from shapetween.deform.mesh import AmbientMesh, ambient_mesh
from tests.strategies import rotation

T = np.linspace(0, 1, 9)
SQUARE = np.array([[0.0, 0], [4, 0], [4, 4], [0, 4]])
BENT = np.array([[10.0, 1], [13, 0], [15, 6], [9, 3]])


class Straight:
    """Vertices that go straight."""

    def __init__(self, mesh: AmbientMesh) -> None:
        self.mesh = mesh
        self.asked = 0

    def vertices(self, t: Floats) -> Points:
        self.asked += 1
        time = t[:, None, None]
        return np.asarray((1 - time) * self.mesh.source + time * self.mesh.target)


@pytest.fixture(scope="module")
def mesh() -> AmbientMesh:
    return ambient_mesh(SQUARE, BENT)


@pytest.mark.parametrize("arrives", [False, True])
def test_points_are_at_home_at_their_own_end(mesh: AmbientMesh, arrives: bool) -> None:
    nodes = BENT if arrives else SQUARE
    inside = np.random.default_rng(1).dirichlet(np.ones(4), 30) @ nodes
    held = MeshPlane(mesh, Straight(mesh)).hold(inside, arrives)
    np.testing.assert_allclose(held.at(np.array([float(arrives)]))[0], inside, atol=1e-12)


def test_nodes_go_where_the_mesh_takes_them(mesh: AmbientMesh) -> None:
    plane = MeshPlane(mesh, Straight(mesh))
    np.testing.assert_allclose(plane.hold(SQUARE, False).at(np.ones(1))[0], BENT, atol=1e-9)
    np.testing.assert_allclose(plane.hold(BENT, True).at(np.zeros(1))[0], SQUARE, atol=1e-9)


def test_a_plane_is_solved_once_for_all_that_ride(mesh: AmbientMesh) -> None:
    path = Straight(mesh)
    plane = MeshPlane(mesh, path)
    for arrives in (False, True):
        plane.hold(SQUARE, arrives).at(T)
    assert path.asked == 1


@pytest.mark.parametrize("arrives", [False, True])
def test_what_lies_beyond_the_mesh_goes_with_the_whole(mesh: AmbientMesh, arrives: bool) -> None:
    far = np.array([[1000.0, -500.0]])
    frames = MeshPlane(mesh, Straight(mesh)).hold(far, arrives).at(T)
    np.testing.assert_allclose(frames[-1 if arrives else 0], far)
    assert np.isfinite(frames).all()
    steps = np.linalg.norm(np.diff(frames[:, 0], axis=0), axis=1)
    assert steps.max() < 2 * steps.mean()


@pytest.mark.parametrize("arrives", [False, True])
def test_every_point_is_found_in_its_triangle(mesh: AmbientMesh, arrives: bool) -> None:
    """Against looking at all triangles."""
    vertices = mesh.target if arrives else mesh.source
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    points = np.random.default_rng(2).uniform(low, high, (200, 2))
    corners, weights = Finder(mesh, arrives).find(points)
    np.testing.assert_allclose(weights.sum(axis=1), 1)
    place = np.einsum("pk,pkd->pd", weights, vertices[corners])
    np.testing.assert_allclose(place, points, atol=1e-9)
    sound = mesh.triangles[~mesh.inverted]
    a, b, c = np.moveaxis(vertices[sound], 1, 0)
    matrices = np.stack([b - a, c - a], axis=-1)
    local = np.linalg.solve(matrices, (points[:, None] - a)[..., None])[..., 0]
    best = np.minimum(local.min(axis=-1), 1 - local.sum(axis=-1)).max(axis=1)
    np.testing.assert_allclose(weights.min(axis=1), best, atol=1e-9)


def test_an_affine_plane_turns_all_it_carries() -> None:
    turn = np.column_stack([2 * rotation(np.deg2rad(80)), [7.0, -3.0]])
    plane = AffinePlane(turn, np.array([1.0, 2.0]))
    frames = plane.hold(SQUARE, False).at(T)
    np.testing.assert_allclose(frames[0], SQUARE, atol=1e-12)
    np.testing.assert_allclose(frames[-1], SQUARE @ turn[:, :2].T + turn[:, 2])
    sides = np.linalg.norm(np.diff(frames, axis=1), axis=2)
    np.testing.assert_allclose(sides, np.outer(1 + T, [4, 4, 4]))
    back = plane.hold(frames[-1], True).at(T)
    np.testing.assert_allclose(back, frames, atol=1e-9)
