"""Points bound to an ambient mesh: exact at both ends, whichever end they come from."""

import numpy as np
import pytest

from shapetween.base.ends import End
from shapetween.deform.locate import BoundPoints, MeshBinder, PointLocator
from shapetween.deform.mesh import AmbientMesh, ambient_mesh

SQUARE = np.array([[0.0, 0], [4, 0], [4, 4], [0, 4]])
BENT = np.array([[10.0, 1], [13, 0], [15, 6], [9, 3]])


@pytest.fixture(scope="module")
def mesh() -> AmbientMesh:
    return ambient_mesh(SQUARE, BENT)


def vertices(mesh: AmbientMesh, end: End) -> np.ndarray:
    return (mesh.source, mesh.target)[end]


@pytest.mark.parametrize("end", list(End))
def test_points_are_in_place_at_their_own_end(mesh: AmbientMesh, end: End) -> None:
    inside = np.random.default_rng(1).dirichlet(np.ones(4), 30) @ (SQUARE, BENT)[end]
    bound = MeshBinder(mesh).bind(inside, end)
    np.testing.assert_allclose(bound.at(vertices(mesh, end)[None])[0], inside, atol=1e-12)
    assert not bound.beyond.any()


def test_nodes_go_where_the_mesh_takes_them(mesh: AmbientMesh) -> None:
    binder = MeshBinder(mesh)
    there = binder.bind(SQUARE, End.SOURCE).at(mesh.target[None])[0]
    np.testing.assert_allclose(there, BENT, atol=1e-9)
    back = binder.bind(BENT, End.TARGET).at(mesh.source[None])[0]
    np.testing.assert_allclose(back, SQUARE, atol=1e-9)


@pytest.mark.parametrize("end", list(End))
def test_what_lies_far_outside_is_beyond(mesh: AmbientMesh, end: End) -> None:
    """And a handle that sticks out of the frame by a little is not."""
    points = vertices(mesh, end)
    centre = points.mean(axis=0)
    frame = points[mesh.frame]
    far, near = centre + 50 * (frame - centre), centre + 1.02 * (frame - centre)
    assert MeshBinder(mesh).bind(far, end).beyond.all()
    assert not MeshBinder(mesh).bind(near, end).beyond.any()


@pytest.mark.parametrize("end", list(End))
def test_every_point_is_found_in_its_triangle(mesh: AmbientMesh, end: End) -> None:
    """Against looking at all triangles."""
    places = vertices(mesh, end)
    low, high = places.min(axis=0), places.max(axis=0)
    points = np.random.default_rng(2).uniform(low, high, (200, 2))
    corners, weights = PointLocator(mesh, end).locate(points)
    np.testing.assert_allclose(weights.sum(axis=1), 1)
    place = np.einsum("pk,pkd->pd", weights, places[corners])
    np.testing.assert_allclose(place, points, atol=1e-9)
    valid = mesh.triangles[~mesh.inverted]
    a, b, c = np.moveaxis(places[valid], 1, 0)
    matrices = np.stack([b - a, c - a], axis=-1)
    local = np.linalg.solve(matrices, (points[:, None] - a)[..., None])[..., 0]
    best = np.minimum(local.min(axis=-1), 1 - local.sum(axis=-1)).max(axis=1)
    np.testing.assert_allclose(weights.min(axis=1), best, atol=1e-9)


def test_what_sticks_out_by_less_than_half_a_triangle_is_bound() -> None:
    weights = np.array([[1.2, 0.2, -0.4], [1.4, 0.3, -0.7]])
    assert BoundPoints(np.zeros((2, 3), np.intp), weights).beyond.tolist() == [False, True]
