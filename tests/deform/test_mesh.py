import numpy as np
import pytest
from hypothesis import given, settings

from shapetween.base.arrays import Points
from shapetween.base.errors import MeshError, OutlineError, ShapeError
from shapetween.deform.layout import ring_edges
from shapetween.deform.mesh import ambient_mesh
from shapetween.deform.triangulate import triangle_edges
from shapetween.geometry.polygon import polygon_area
from tests.deform.shapes import bowed_strip, comb, pairs, ring_with_hole, two_discs


@settings(max_examples=15)
@given(pairs())
def test_the_mesh_fits_both_outlines_without_turned_triangles(pair: tuple[Points, Points]) -> None:
    source, target = pair
    mesh = ambient_mesh(source, target)
    count = len(source)
    np.testing.assert_allclose(mesh.source[:count], source, rtol=1e-12)
    np.testing.assert_allclose(mesh.target[:count], target, rtol=1e-12)
    edges = {tuple(edge) for edge in triangle_edges(mesh.triangles)[0].tolist()}
    assert {tuple(edge) for edge in np.sort(ring_edges(mesh.rings), axis=1).tolist()} <= edges
    assert not mesh.inverted.any()
    for points, nodes in ((mesh.source, source), (mesh.target, target)):
        areas = polygon_area(points[mesh.triangles])
        assert (areas > 0).all()
        assert areas[mesh.inside].sum() == pytest.approx(polygon_area(nodes), rel=1e-9)
        assert areas.sum() == pytest.approx(polygon_area(points[mesh.frame]), rel=1e-9)


@pytest.mark.parametrize("lean", [0.5, 2.0])
def test_a_comb_leans_without_turned_triangles(lean: float) -> None:
    assert not ambient_mesh(comb(6, -lean), comb(6, lean)).inverted.any()


def test_a_strip_curls_up_without_turned_triangles() -> None:
    assert not ambient_mesh(bowed_strip(0.0, 16), bowed_strip(5.0, 16)).inverted.any()


def test_a_hole_is_outside_and_parts_are_inside() -> None:
    nodes, rings = ring_with_hole(0.0)
    mesh = ambient_mesh(nodes, ring_with_hole(0.5)[0], rings)
    centres = mesh.source[mesh.triangles].mean(axis=1)
    radius = np.linalg.norm(centres, axis=1)
    assert (mesh.inside == ((radius > 0.4 * np.cos(np.pi / 16)) & (radius < 1))).all()
    nodes, rings = two_discs(0.0)
    mesh = ambient_mesh(nodes, two_discs(1.0)[0], rings)
    areas = polygon_area(mesh.source[mesh.triangles])
    assert areas[mesh.inside].sum() == pytest.approx(sum(polygon_area(nodes[r]) for r in rings))


@settings(max_examples=10)
@given(pairs())
def test_swapped_shapes_share_their_mesh(pair: tuple[Points, Points]) -> None:
    forth, back = ambient_mesh(*pair), ambient_mesh(*pair[::-1])
    np.testing.assert_array_equal(forth.triangles, back.triangles)
    np.testing.assert_allclose(forth.source, back.target, rtol=1e-9)
    np.testing.assert_allclose(forth.body.matrix @ back.body.matrix, np.eye(2), atol=1e-9)


def test_mirrored_shapes_share_their_mesh() -> None:
    hook = np.array([[0.0, 0], [3, 0], [3, 1], [1, 1], [1, 5], [0, 5]])
    mirrored = (hook * [-1, 1])[::-1]
    forth, back = ambient_mesh(hook, mirrored), ambient_mesh(mirrored, hook)
    np.testing.assert_array_equal(forth.triangles, back.triangles)


@pytest.mark.parametrize(("start", "lean"), [(4, 0.5), (11, 2.0)])
def test_rounding_in_the_nodes_does_not_grow(start: int, lean: float) -> None:
    """Many steps of untangling would make it another mesh, and backwards another movement."""
    pair = comb(6, -lean), np.roll(comb(6, lean), start, axis=0)
    random = np.random.default_rng(1)
    noisy = [points + 1e-14 * random.normal(size=points.shape) for points in pair]
    mesh, other = (ambient_mesh(a, b, refine=False) for a, b in (pair, noisy))
    np.testing.assert_allclose(mesh.source, other.source, atol=1e-12)
    np.testing.assert_allclose(mesh.target, other.target, atol=1e-12)


def test_what_cannot_be_meshed_is_said() -> None:
    square = np.array([[0.0, 0], [1, 0], [1, 1], [0, 1]])
    with pytest.raises(ShapeError, match="as many"):
        ambient_mesh(square, square[:3])
    with pytest.raises(OutlineError, match="area"):
        ambient_mesh(square, square[::-1])
    with pytest.raises(OutlineError, match="coincide"):
        ambient_mesh(square, square[[0, 0, 2, 3]])
    bent = np.insert(square, 1, [0.5, -0.2], axis=0)
    with pytest.raises(OutlineError, match="coincide"):
        ambient_mesh(np.insert(square, 1, [1e-12, 0.0], axis=0), bent)
    crossing = np.array([[0.0, 0], [2, 0], [2, 2], [1, -1], [0, 3]])
    with pytest.raises(MeshError, match="cross"):
        ambient_mesh(crossing, crossing)
