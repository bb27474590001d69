"""Nodes: the kept ones, and as few others as keep both polygons near their outlines."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from shapetween.base.arrays import Points
from shapetween.geometry.polygon import polygon_area
from shapetween.outline.nodes import outline_nodes
from tests.mesh.pairs import regular, star

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
