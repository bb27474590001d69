import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial import ConvexHull

from shapetween.base.errors import MeshError
from shapetween.deform.layout import ring_edges
from shapetween.deform.triangulate import constrained_delaunay, split_edges, triangle_edges
from shapetween.geometry.polygon import polygon_area
from tests.deform.shapes import blob, comb


def _edge_set(edges: np.ndarray) -> set[tuple[int, int]]:
    return {(min(i, j), max(i, j)) for i, j in edges.tolist()}


@given(st.integers(0, 10**6), st.integers(5, 40))
def test_given_edges_are_in_and_the_triangles_tile_the_hull(seed: int, count: int) -> None:
    points = blob(seed, count)
    points = (points - points.mean(axis=0)) / np.ptp(points)
    edges = ring_edges([np.arange(count)])
    triangles = constrained_delaunay(points, edges)
    assert _edge_set(edges) <= _edge_set(triangle_edges(triangles)[0])
    areas = polygon_area(points[triangles])
    assert (areas > 0).all()
    assert areas.sum() == pytest.approx(ConvexHull(points).volume, rel=1e-9)


def test_triangulations_do_not_depend_on_one_library(monkeypatch: pytest.MonkeyPatch) -> None:
    """GEOS gives up on some points; what stands in for it finds the same triangles."""
    points = np.random.default_rng(3).uniform(-1, 1, (120, 2))
    edges = np.array([[0, 1]])
    expected = constrained_delaunay(points, edges)

    def lost(*_: object, **__: object) -> None:
        raise shapely.errors.GEOSException("LocateFailureException: Could not locate vertex.")

    monkeypatch.setattr(shapely, "delaunay_triangles", lost)
    found = constrained_delaunay(points, edges)
    assert set(map(frozenset, found.tolist())) == set(map(frozenset, expected.tolist()))
    assert (polygon_area(points[found]) > 0).all()


def test_an_edge_through_many_others_is_inserted() -> None:
    random = np.random.default_rng(1)
    points = np.concatenate([[[-1.0, 0.0], [1.0, 1e-3]], random.uniform(-0.9, 0.9, (200, 2))])
    triangles = constrained_delaunay(points, np.array([[0, 1]]))
    assert (0, 1) in _edge_set(triangle_edges(triangles)[0])
    assert (polygon_area(points[triangles]) > 0).all()


def test_edges_on_one_line_do_not_cross() -> None:
    points = np.array([[0.0, 0], [1, 0], [2, 0], [3, 0], [1.5, 0.1], [1.5, -0.1], [1.5, 3]])
    edges = np.array([[0, 1], [2, 3]])
    assert _edge_set(edges) <= _edge_set(triangle_edges(constrained_delaunay(points, edges))[0])


def test_crossing_edges_are_refused() -> None:
    square = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [0.4, 0.45]])
    with pytest.raises(MeshError, match="cross"):
        constrained_delaunay(square, np.array([[0, 2], [1, 3]]))


def test_points_on_a_line_are_refused() -> None:
    line = np.stack([np.arange(4.0), np.arange(4.0)], axis=1)
    with pytest.raises(MeshError, match="line"):
        constrained_delaunay(line, np.array([[0, 1]]))


def test_every_edge_knows_its_triangles() -> None:
    edges, sides = triangle_edges(np.array([[0, 1, 2], [0, 2, 3]]))
    assert edges.tolist() == [[0, 1], [0, 2], [0, 3], [1, 2], [2, 3]]
    assert sides.tolist() == [[0, -1], [0, 1], [1, -1], [0, -1], [1, -1]]


@given(st.integers(0, 2**9 - 1))
def test_split_triangles_tile_their_parents(bits: int) -> None:
    points = np.array([[0.0, 0], [2, 0], [2, 2], [0, 2], [5, 1]])
    triangles = np.array([[0, 1, 2], [0, 2, 3], [1, 4, 2]])
    edges, _ = triangle_edges(triangles)
    marked = (bits >> np.arange(len(edges))) % 2 == 1
    pieces, parent = split_edges(triangles, edges, marked, len(points))
    points = np.concatenate([points, points[edges[marked]].mean(axis=1)])
    areas = polygon_area(points[pieces])
    assert (areas > 0).all()
    sums = np.bincount(parent, areas, len(triangles))
    np.testing.assert_allclose(sums, polygon_area(points[triangles]))
    assert not _edge_set(edges[marked]) & _edge_set(triangle_edges(pieces)[0])


def test_a_comb_keeps_its_gaps_open() -> None:
    points = comb(5, 0.3)
    edges = ring_edges([np.arange(len(points))])
    assert _edge_set(edges) <= _edge_set(triangle_edges(constrained_delaunay(points, edges))[0])
