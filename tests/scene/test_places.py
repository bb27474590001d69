"""Two outlines cut alike are made of exact parts of both, also where a span is a point."""

import numpy as np
import pytest

from shapetween.geometry.bezier import curve_lengths, evaluate, line_curves
from shapetween.model.outline import Outline
from shapetween.scene.places import Places, cut_alike, run_of
from tests.drawings import line, ring, square


def follows(curves: np.ndarray) -> bool:
    return bool((curves[1:, 0] == curves[:-1, 3]).all())


def test_pieces_are_parts_of_both_rings() -> None:
    one, other = square(0, 0, 10), ring([(0, 0), (10, 0), (5, 9)])
    pieces = cut_alike(Places(one), Places(other), np.array([0.1, 1.1]), np.array([0.0, 1.0]))
    assert pieces.closed
    for part, outline in ((pieces.source, one), (pieces.target, other)):
        assert follows(part)
        assert (part[0, 0] == part[-1, 3]).all()
        np.testing.assert_allclose(curve_lengths(part).sum(), curve_lengths(outline.curves).sum())
        for corner in outline.curves[:, 0]:
            assert (part[:, 0] == corner).all(axis=1).any()
    # Four corners, three corners and the knots.
    assert len(pieces.source) <= 8


def test_pieces_of_open_lines_keep_their_ends() -> None:
    one = line((0, 0), (10, 0)).rings[0]
    other = line((0, 0), (3, 4), (9, 0)).rings[0]
    knots = np.array([0.0, 1.0])
    pieces = cut_alike(Places(one), Places(other), knots, knots)
    assert len(pieces.source) == 2
    np.testing.assert_array_equal(pieces.source[0, 0], [0, 0])
    np.testing.assert_array_equal(pieces.source[-1, 3], [10, 0])
    np.testing.assert_array_equal(pieces.target[:, 3], [[3, 4], [9, 0]])


def test_a_span_may_be_a_point() -> None:
    one, other = square(0, 0, 10), square(20, 0, 10)
    u = np.array([0.0, 0.25, 0.25, 1.0])
    v = np.array([0.0, 0.25, 0.5, 1.0])
    pieces = cut_alike(Places(one), Places(other), u, v)
    assert follows(pieces.source)
    assert follows(pieces.target)
    lengths = curve_lengths(pieces.source), curve_lengths(pieces.target)
    np.testing.assert_allclose([length.sum() for length in lengths], 40)
    assert (lengths[0] == 0).any()


def test_a_point_has_places_too() -> None:
    dot = Outline(np.full((1, 4, 2), 3.0), False)
    other = line((0, 0), (9, 0)).rings[0]
    knots = np.array([0.0, 1.0])
    pieces = cut_alike(Places(dot), Places(other), knots, knots)
    assert (pieces.source == 3.0).all()
    np.testing.assert_array_equal(pieces.target[[0, -1], [0, 3]], [[0, 0], [9, 0]])


def test_nearest_places_lie_there() -> None:
    places = Places(square(0, 0, 10))
    shares = places.nearest(np.array([[5.0, -1.0], [11.0, 5.0], [5.0, 10.0]]))
    np.testing.assert_allclose(shares, [0.125, 0.375, 0.625], atol=1e-6)
    curve, t = places.locate(shares)
    np.testing.assert_allclose(
        evaluate(places.outline.curves[curve], t[:, None])[:, 0], places.point(shares)
    )


def test_of_so_many_curves_each_is_one_chord() -> None:
    def bulging(count: int) -> tuple[float, float]:
        points = np.stack([np.cos(a := 2 * np.pi * np.arange(count) / count), np.sin(a)], axis=1)
        curves = line_curves(points, np.roll(points, -1, axis=0))
        curves[:, 1:3] += 0.3 * points[:, None] * np.linalg.norm(points[1] - points[0])
        straight = float(np.linalg.norm(points - np.roll(points, 1, axis=0), axis=1).sum())
        return Places(Outline(curves)).length, straight

    length, straight = bulging(100)
    assert length > 1.05 * straight
    length, straight = bulging(50_000)
    assert length == pytest.approx(straight)


def test_a_run_past_the_start_of_a_ring_keeps_all_its_corners() -> None:
    """Wherever shares are counted from: a house's eaves are not lost for its walls' sake."""
    corners = np.array([[0.0, 8.0], [0.0, 0.0], [10.0, 0.0], [10.0, 8.0], [5.0, 12.0]])
    house = Places(Outline(line_curves(corners, np.roll(corners, -1, axis=0))))
    for start in (0.3, 0.65, 0.95):
        for length in (0.4, 0.7):
            once = run_of(house, start, start + length)
            again = run_of(house, start + 1, start + 1 + length)
            np.testing.assert_allclose(again.curves, once.curves, atol=1e-9)
            assert Places(once).length == pytest.approx(length * house.length, rel=1e-6)


@pytest.mark.parametrize("noise", [-1e-12, 0.0, 1e-12])
def test_what_goes_all_round_but_for_rounding_goes_all_round(noise: float) -> None:
    run = run_of(Places(square(0, 0, 10)), 0.3, 1.3 + noise)
    assert len(run.curves) == 5
    assert (np.ptp(run.curves, axis=1).max(axis=1) > 1).all()
