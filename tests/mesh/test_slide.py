import numpy as np
import pytest

from shapetween.base.arrays import Floats, Index, Points
from shapetween.geometry.polygon import polygon_area
from shapetween.mesh.candidates import (
    CORNER_BONUS,
    candidate_nodes,
    far_sample,
    opposite_feet,
    simplified,
)
from shapetween.mesh.contour import Contours
from shapetween.mesh.quality import face_figures
from shapetween.mesh.slide import slid
from tests.mesh.pairs import matched, regular, spiral

LIMB = np.array([[0.0, 0.0], [6, 0], [6, 1], [0, 1]])


def contours() -> tuple[Contours, np.typing.NDArray[np.bool_]]:
    source, target, corners = matched(LIMB, LIMB, 280)
    points = np.stack([source, target]) / np.sqrt(polygon_area(LIMB))
    return Contours.of(points), corners


def test_a_slanted_rung_is_set_upright() -> None:
    shape, corners = contours()
    ends = np.flatnonzero(corners)
    length = ends[1] - ends[0]
    low, high = ends[0] + length // 4, ends[2] + length // 4  # a quarter from opposite ends
    nodes = np.sort(np.append(ends, [low, high]))
    quads = np.array([[0, 1, 4, 5], [1, 2, 3, 4]])
    moved = slid(shape, np.where(corners, 0.5, 0.0), nodes, quads, np.zeros((0, 3), np.intp))
    assert set(ends) < set(moved)
    assert (np.diff(moved) > 0).all()
    before, after = (face_figures(shape.points[:, n[quads]]) for n in (nodes, moved))
    assert before.sine.min() < 0.4
    assert after.sine.min() > 0.55


def test_nodes_at_rest_stay() -> None:
    shape, corners = contours()
    ends = np.flatnonzero(corners)
    quads = np.array([[0, 1, 2, 3]])
    moved = slid(shape, np.where(corners, 0.5, 0.0), ends, quads, np.zeros((0, 3), np.intp))
    np.testing.assert_array_equal(moved, ends)


def test_corners_come_first_when_outlines_are_simplified() -> None:
    shape, corners = contours()
    assert set(simplified(shape.points, corners, 4)) == set(np.flatnonzero(corners))
    assert corners[far_sample(shape.points)]


def simplified_step_by_step(points: Points, weight: Floats, chosen: list[int], count: int) -> Index:
    """One sample at a time, all distances measured anew."""
    curve = np.concatenate([points[0], points[1]], axis=1)
    while len(chosen) < count:
        ring = sorted(chosen)
        best = (-1.0, -1)
        for first, last in zip(ring, [*ring[1:], ring[0] + len(curve)], strict=True):
            start, along = curve[first], curve[last % len(curve)] - curve[first]
            for sample in range(first + 1, last):
                offset = curve[sample % len(curve)] - start
                share = np.clip(offset @ along / max(along @ along, 1e-30), 0, 1)
                far = np.linalg.norm(offset - share * along) * weight[sample % len(curve)]
                best = max(best, (far, sample))
        chosen = [*chosen, best[1] % len(curve)]
    return np.array(chosen)


@pytest.mark.parametrize("kept", [None, [3, 40, 41, 90]])
def test_outlines_are_simplified_furthest_sample_first(kept: list[int] | None) -> None:
    source, target, corners = matched(spiral(), spiral(1.5), 120)
    points = np.stack([source, target])
    points += np.random.default_rng(0).normal(0, 1e-3, points.shape)  # no two are as far
    chosen = [far_sample(points)] if kept is None else kept
    weight = np.where(corners, CORNER_BONUS, 1.0)
    found = simplified(points, corners, 30, None if kept is None else np.array(kept))
    np.testing.assert_array_equal(found, simplified_step_by_step(points, weight, chosen, 30))


def test_all_samples_are_chosen_where_more_are_asked_for() -> None:
    source, target, corners = matched(LIMB, LIMB, 20)
    found = simplified(np.stack([source, target]), corners, 1000)
    np.testing.assert_array_equal(np.sort(found), np.arange(len(source)))


def test_feet_lie_straight_across_a_limb() -> None:
    shape, corners = contours()
    ends = np.flatnonzero(corners)
    middle = np.array([(ends[0] + ends[1]) // 2])
    feet, radii = opposite_feet(shape.points, middle)
    for points, foot, radius in zip(shape.points, feet[:, 0], radii[:, 0], strict=True):
        across = points[foot] - points[middle[0]]
        assert abs(across[0]) < 0.02
        np.testing.assert_allclose(across[1], 1 / np.sqrt(polygon_area(LIMB)))
        np.testing.assert_allclose(radius, across[1] / 2, rtol=1e-3)


def test_there_are_as_many_candidates_as_asked_for() -> None:
    shape, corners = contours()
    disc = regular(300) / np.sqrt(np.pi)
    for points, marks in ((shape.points, corners), (np.stack([disc, disc]), np.zeros(300, bool))):
        nodes = candidate_nodes(points, marks, 20)
        assert len(set(nodes.tolist())) == len(nodes) == 20
        assert nodes[0] == far_sample(points)


def test_candidates_keep_the_nodes_they_are_given() -> None:
    shape, corners = contours()
    kept = np.array([7, 50, 121])
    nodes = candidate_nodes(shape.points, corners, 24, kept)
    np.testing.assert_array_equal(nodes[:3], kept)
