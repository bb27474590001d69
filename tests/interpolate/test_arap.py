"""Triangles as rigid as possible: as published, and fair."""

from collections.abc import Callable

import numpy as np
import pytest

from shapetween.base.arrays import Floats, Index, Points
from shapetween.base.errors import DegenerateQuadError
from shapetween.geometry.polygon import polygon_area
from shapetween.geometry.rotation import linear_between, polar
from shapetween.interpolate.arap import AlexaArap, Arap
from shapetween.interpolate.faces import mesh_edges, shared_edges, split_quads
from shapetween.interpolate.refine import refined
from shapetween.mesh.pair import MeshPair
from tests.strategies import grid, rotation

Method = type[Arap] | type[AlexaArap]
Gradient = Callable[[Points, Index], Floats]


def bent(angle: float = 1.1) -> MeshPair:
    vertices, quads = grid(4, 2)
    vertices = vertices + 0.1 * np.sin(5 * vertices[:, ::-1])
    target = vertices @ rotation(angle).T + 0.25 * np.sin(1.3 * vertices[:, ::-1])
    return MeshPair(vertices, target, quads)


def finite_gradient(points: Points, triangles: Index) -> Floats:
    """Gradient operator (T, 2, V) by differences of barycentric coordinates: an own way to it."""
    result = np.zeros((len(triangles), 2, len(points)))
    for k, face in enumerate(triangles):
        corners = np.column_stack([points[face], np.ones(3)])
        result[k][:, face] = np.linalg.inv(corners)[:2]
    return result


def igl_gradient(points: Points, triangles: Index) -> Floats:
    igl = pytest.importorskip("igl", reason="libigl is not installed")
    solid = np.column_stack([points, np.zeros(len(points))])
    operator = igl.grad(solid, triangles.astype(np.int64)).toarray()
    return np.asarray(operator.reshape(3, len(triangles), -1)[:2].transpose(1, 0, 2))


@pytest.mark.parametrize("gradient", [finite_gradient, igl_gradient])
@pytest.mark.parametrize("method", [Arap, AlexaArap])
def test_vertices_have_the_least_energy(method: Method, gradient: Gradient) -> None:
    """Against a dense least squares solution over other gradient operators."""
    pair, t = bent(), np.array([0.3, 0.8])
    whole = pair if method is AlexaArap else refined(pair)
    triangles = split_quads(whole)
    ends = [gradient(points, triangles) for points in (whole.source, whole.target)]
    matrices = np.swapaxes(ends[0] @ whole.target, 1, 2)
    wanted = linear_between(*polar(matrices), t)
    areas = [polygon_area(points[triangles]) for points in (whole.source, whole.target)]
    if method is AlexaArap:
        areas = [np.ones(len(triangles)), np.zeros(len(triangles))]
    seen = [wanted, wanted @ np.linalg.inv(matrices)]
    for frame, got in enumerate(method(pair).vertices(t)):
        rows, right = [], []
        for operator, area, jacobians in zip(ends, areas, seen, strict=True):
            root = np.sqrt(area)[:, None, None]
            rows.append((root * operator).reshape(-1, len(whole.source)))
            right.append((root * np.swapaxes(jacobians[frame], 1, 2)).reshape(-1, 2))
        best = np.linalg.lstsq(np.concatenate(rows), np.concatenate(right), rcond=None)[0]
        own = best[: len(got)]
        np.testing.assert_allclose(got - got.mean(axis=0), own - own.mean(axis=0), atol=1e-9)


def strip(count: int, degrees: float) -> MeshPair:
    """A straight strip of unit height, and the same bent into an arc past itself."""
    x = np.linspace(0, 12, count + 1)
    vertices = np.concatenate([np.stack([x, 0 * x], axis=1), np.stack([x, 0 * x + 1], axis=1)])
    first = np.arange(count)
    quads = np.stack([first, first + 1, first + count + 2, first + count + 1], axis=1)
    angle = np.linspace(0, np.deg2rad(degrees), count + 1)
    radius = 3 - np.array([0.0, 1.0])[:, None] + 0.1 * angle
    arcs = [np.stack([r * np.sin(angle), 3 - r * np.cos(angle)], axis=1) for r in radius]
    return MeshPair(vertices, np.concatenate(arcs), quads)


def longest(method: Method) -> float:
    """Longest edge of the unrolling strip, as a share of its longest at the ends."""
    frames = method(strip(24, 300)).vertices(np.linspace(0, 1, 21))
    lengths = np.linalg.norm(np.diff(frames[:, :25], axis=1), axis=-1)
    return float(lengths.max() / lengths[[0, -1]].max())


def test_a_strip_past_half_a_turn_unrolls_where_angles_are_coherent() -> None:
    """As published it tears, which is why the fair method exists."""
    assert longest(Arap) < 1.05
    assert longest(AlexaArap) > 1.1


def test_the_better_diagonal_is_taken() -> None:
    """The same one in both directions, and the only one where the quad is not convex."""
    kite = np.array([[0.0, 0.0], [4.0, 0.3], [8.0, 0.0], [4.0, 3.0]])
    quad = np.arange(4)[None]
    for a, b in ((kite, kite + 1), (kite * 2, kite)):
        triangles = split_quads(MeshPair(a, b, quad))
        assert {tuple(sorted(t)) for t in triangles.tolist()} == {(0, 1, 3), (1, 2, 3)}
    bow = MeshPair(grid(1, 1)[0], grid(1, 1)[0], quad)
    with pytest.raises(DegenerateQuadError, match="quad 0: no diagonal"):
        split_quads(bow)


def test_shared_edges_count_through_all_faces() -> None:
    quads, triangles = np.array([[0, 1, 4, 3]]), np.array([[1, 2, 4], [2, 5, 4]])
    assert shared_edges([quads, triangles]).tolist() == [[0, 1], [1, 2]]


def test_a_finer_mesh_covers_the_same_and_conforms() -> None:
    vertices, quads = grid(3, 2)
    vertices = vertices + 0.1 * np.sin(5 * vertices[:, ::-1])
    dart = vertices.copy()
    dart[5] += [0.7, 0.8]  # the quad before it is convex at one end only
    pair = MeshPair(vertices, dart, quads[:-1], quads[-1][[[0, 1, 2], [0, 2, 3]]])
    finer = refined(pair)
    np.testing.assert_array_equal(finer.source[:12], vertices)
    assert len(finer.quads) == 4 * 4
    assert len(finer.triangles) == 4 * 4
    for whole, parts in ((pair.source, finer.source), (pair.target, finer.target)):
        areas = [
            sum(polygon_area(points[f]).sum() for f in (mesh.quads, mesh.triangles))
            for points, mesh in ((whole, pair), (parts, finer))
        ]
        assert areas[0] == pytest.approx(areas[1])
    rims = [mesh_edges([m.quads, m.triangles]) for m in (pair, finer)]
    assert (rims[1][1] == 1).sum() == 2 * (rims[0][1] == 1).sum()
    assert rims[1][1].max() == 2
