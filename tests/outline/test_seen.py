"""What is seen of crossings, against figures whose areas are known."""

import numpy as np
import pytest

from shapetween.base.arrays import Points
from shapetween.geometry.bezier import line_curves
from shapetween.outline.seen import UNSEEN, Seen, seen_crossings


def ring(*points: tuple[float, float]) -> Points:
    corners = np.array(points)
    return line_curves(corners, np.roll(corners, -1, axis=0))


def test_what_does_not_cross_is_not_seen() -> None:
    square = ring((0, 0), (4, 0), (4, 4), (0, 4))
    hole = ring((1, 1), (1, 2), (2, 2), (2, 1))
    curves = np.concatenate([square, hole])[None]
    assert seen_crossings(curves, (4, 4), 15.0, 4.0) == Seen(0.0, 0.0)


def test_a_loop_wound_the_other_way_counts_whole() -> None:
    bow = ring((0, 0), (4, 4), (4, 0), (0, 4))  # two triangles of area 4, one of them turned over
    found = seen_crossings(bow[None], (4,), 16.0, 4.0)
    assert found.area == pytest.approx(4 / 16)
    assert found.width == pytest.approx(2 * 4 / (4 + 4 * np.sqrt(2)) / 4)


def test_strands_that_overlap_count_where_they_do() -> None:
    """A U whose arms lie across each other by a strip of 0.2 by 3."""
    arms = ring((0, 0), (2.1, 0), (2.1, 3), (1.9, 3), (1.9, -1), (4, -1), (4, 4), (0, 4))
    found = seen_crossings(arms[None], (8,), 10.0, 4.0)
    assert found.area == pytest.approx(0.2 * 3 / 10)
    assert found.width == pytest.approx(2 * 0.6 / 6.4 / 4)


def test_a_hole_that_leaves_its_ring_is_seen_outside() -> None:
    square = ring((0, 0), (4, 0), (4, 4), (0, 4))
    hole = ring((3, 1), (3, 2), (5, 2), (5, 1))
    curves = np.concatenate([square, hole])[None]
    assert seen_crossings(curves, (4, 4), 15.0, 4.0).area == pytest.approx(1 / 15)


def test_the_worst_frame_counts() -> None:
    shut = ring((0, 0), (4, 0), (4, 4), (0, 4))
    bow = ring((0, 0), (4, 4), (4, 0), (0, 4))
    assert seen_crossings(np.stack([shut, bow, shut]), (4,), 16.0, 4.0).area == pytest.approx(0.25)


def test_a_tenth_of_a_pixel_is_nothing() -> None:
    assert Seen(1.0, UNSEEN).nothing
    assert not Seen(0.0, 1.01 * UNSEEN).nothing
