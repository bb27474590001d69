"""Nodes: the kept ones, and as few others as keep both polygons near their outlines."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from shapetween.base.arrays import Points
from shapetween.geometry.polygon import polygon_area
from shapetween.outline.nodes import outline_nodes
from tests.mesh.pairs import regular, star
from tests.strategies import rotation

KEPT = np.array([0, 200])


def off(points: Points, nodes: np.ndarray[tuple[int], np.dtype[np.intp]]) -> float:
    """Greatest distance of a sample from the chord of its span, by the root of the area."""
    worst = 0.0
    for a, b in zip(nodes, [*nodes[1:], nodes[0] + len(points)], strict=True):
        start, chord = points[a], points[b % len(points)] - points[a]
        for k in range(a + 1, b):
            offset = points[k % len(points)] - start
            share = np.clip(offset @ chord / max(chord @ chord, 1e-300), 0, 1)
            worst = max(worst, float(np.linalg.norm(offset - share * chord)))
    return worst / float(np.sqrt(abs(polygon_area(points))))


def dense(corners: Points, count: int = 400) -> Points:
    closed = np.concatenate([corners, corners[:1]])
    places = np.arange(count) / count * len(corners)
    return np.stack([np.interp(places, np.arange(len(closed)), closed[:, k]) for k in (0, 1)], 1)


@settings(max_examples=30)
@given(st.floats(0.002, 0.1), st.floats(0.2, 2), st.integers(3, 11), st.floats(0.1, 100))
def test_both_polygons_stay_near(tolerance: float, span: float, tips: int, size: float) -> None:
    source, target = size * dense(star(tips)), dense(regular(5))
    nodes = outline_nodes(source, target, KEPT, tolerance=tolerance, span=span)
    assert (np.diff(nodes) > 0).all()
    assert set(KEPT) <= set(nodes.tolist())
    for points in (source, target):
        assert off(points, nodes) <= tolerance * (1 + 1e-9)
        chords = np.linalg.norm(points[np.roll(nodes, -1)] - points[nodes], axis=1)
        neighbours = np.diff(np.append(nodes, nodes[0] + 400)) < 2
        assert ((chords <= span * np.sqrt(abs(polygon_area(points)))) | neighbours).all()


def test_straight_sides_need_no_nodes() -> None:
    square = dense(regular(4))
    nodes = outline_nodes(square, square, KEPT, tolerance=1e-6, span=10.0)
    assert nodes.tolist() == [0, 100, 200, 300]


@pytest.mark.parametrize("finer", [0.03, 0.012, 0.005])
def test_finer_is_more(finer: float) -> None:
    disc = regular(400)
    coarse = outline_nodes(disc, disc, KEPT, tolerance=0.1, span=10.0)
    assert len(outline_nodes(disc, disc, KEPT, tolerance=finer, span=10.0)) > len(coarse)


@pytest.mark.parametrize("unit", [1e-6, 1 / 3, 0.7, 1e6])
def test_of_samples_as_far_away_the_first_is_taken_in_any_unit(unit: float) -> None:
    """A side beside the chord from which all of its samples are equally far."""
    side = np.linspace(0, 1, 12, endpoint=False)
    corners = np.array([[0.0, 0.0], [0.31, 0.0], [0.31, 0.2], [0.77, 0.2], [0.77, 0.0], [1.1, 0.0]])
    corners = np.concatenate([corners, [[1.1, -0.9], [0.0, -0.9]]])
    following = np.roll(corners, -1, axis=0)
    points = (corners[:, None] + side[:, None] * (following - corners)[:, None]).reshape(-1, 2)
    turned = points @ rotation(0.7).T + 0.3
    kept = np.array([0, 60, 72, 84])
    found = [
        outline_nodes(u * points, u * turned, kept, tolerance=0.05, span=9.0) for u in (1.0, unit)
    ]
    np.testing.assert_array_equal(found[0], found[1])
    assert 24 in found[0]
