"""Outlines that lie on each other, matched by where they are."""

import numpy as np
import pytest

from shapetween.attach.nearby import matched_nearby
from shapetween.attach.planes import AffinePlane
from shapetween.base.arrays import Affine
from shapetween.geometry.bezier import evaluate
from shapetween.model.outline import Outline
from tests.drawings import line
from tests.match.shapes import disc, polygon, star

STILL = AffinePlane(np.eye(2, 3), np.zeros(2))


def path(*corners: tuple[float, float]) -> Outline:
    return line(*corners).rings[0]


def plane(matrix: Affine) -> AffinePlane:
    return AffinePlane(matrix, np.zeros(2))


def apart(source: Outline, target: Outline, *, fine: bool = True) -> float:
    """Greatest distance of matched points."""
    parts = matched_nearby(source, target, STILL, fine=fine)
    points = [evaluate(c, np.linspace(0, 1, 9)) for c in (parts.source, parts.target)]
    return float(np.linalg.norm(points[0] - points[1], axis=-1).max())


@pytest.mark.parametrize("shift", [0, 3, 7])
@pytest.mark.parametrize("backwards", [False, True])
def test_the_same_ring_meets_itself_wherever_it_starts(shift: int, backwards: bool) -> None:
    ring = polygon(star(5))
    other = Outline(np.roll(ring.curves, shift, axis=0))
    size = float(np.ptp(ring.box))
    assert apart(ring, other.reversed() if backwards else other) < 0.02 * size


def test_what_the_plane_brings_onto_it_is_the_very_same() -> None:
    ring = polygon(star(5))
    matrix = np.array([[0.0, -2.0, 5.0], [2.0, 0.0, 1.0]])
    parts = matched_nearby(ring, ring.transformed(matrix), plane(matrix))
    np.testing.assert_array_equal(parts.source, ring.curves)
    np.testing.assert_array_equal(parts.target, ring.transformed(matrix).curves)


def test_a_line_the_other_way_round_is_the_same_line() -> None:
    there = path((0, 0), (10, 2), (20, 0), (25, 8))
    assert apart(there, there.reversed()) < 1e-9


def test_a_ring_is_cut_open_where_the_line_ends() -> None:
    square = polygon(np.array([[0.0, 0], [10, 0], [10, 10], [0, 10]]))
    three = path((10, 10), (0, 10), (0, 0), (10, 0))
    for source, target in ((square, three), (three, square)):
        parts = matched_nearby(source, target, STILL)
        assert not parts.closed
        cut = parts.source if source is square else parts.target
        np.testing.assert_allclose(cut[0, 0], cut[-1, 3])
        assert abs(cut[0, 0, 0] - 10) < 1.5  # on the side that the line leaves open


def test_corners_that_nearly_match_become_each_other() -> None:
    parts = matched_nearby(path((0, 0), (10, 0), (20, 5)), path((0, 0), (10, 1), (20, 5)), STILL)
    assert len(parts.source) == 2
    np.testing.assert_allclose(parts.target[0, 3], [10, 1])


def test_by_even_lengths_where_it_does_not_matter() -> None:
    assert apart(disc(), disc(), fine=False) < 0.05
    parts = matched_nearby(path((0, 0), (4, 0)), path((0, 1), (2, 1), (4, 1)), STILL, fine=False)
    np.testing.assert_allclose(parts.source[0, 3], [2, 0])


@pytest.mark.parametrize("size", [1e-3, 1e6])
def test_units_do_not_matter(size: float) -> None:
    pair = polygon(star(5)), disc()
    here = matched_nearby(*pair, STILL)
    scaled = [ring.transformed(size * np.eye(2, 3)) for ring in pair]
    there = matched_nearby(scaled[0], scaled[1], STILL)
    np.testing.assert_allclose(there.source / size, here.source, atol=1e-9)
    np.testing.assert_allclose(there.target / size, here.target, atol=1e-9)
