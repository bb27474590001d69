import numpy as np

from shapetween.geometry.polygon import polygon_area
from shapetween.meshing.candidates import candidate_nodes, far_sample, opposite_feet, simplified
from shapetween.meshing.contour import Contours
from shapetween.meshing.quality import face_figures
from shapetween.meshing.slide import slid
from tests.meshing.pairs import matched, regular

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
