"""Figures of movements whose figures are known."""

from collections.abc import Callable

import numpy as np
import pytest

from shapetween.base.arrays import Curves, Floats, Mask, Points
from shapetween.compare import Comparison, compare
from shapetween.compare.measures import TIMES
from shapetween.geometry.bezier import line_curves
from shapetween.model.drawing import Box, Drawing, Shape
from shapetween.model.outline import Outline
from shapetween.model.paint import Colour, Style

LETTER = np.array(
    [[0, 0], [6, 0], [6, 2], [2, 2], [2, 3], [5, 3], [5, 5], [2, 5], [2, 9], [0, 9]], np.float64
)


def drawing(ring: Points, scale: float = 1.0) -> Drawing:
    """A drawing of one polygon, all of it enlarged."""
    outline = Outline(line_curves(ring * scale, np.roll(ring, -1, axis=0) * scale), True)
    box = Box(-20 * scale, -20 * scale, 60 * scale, 60 * scale)
    return Drawing((Shape((outline,), Style(fill=Colour(0, 0, 0))),), box)


def turned(points: Points, degrees: float, size: float = 1.0) -> Points:
    c, s = np.cos(np.deg2rad(degrees)), np.sin(np.deg2rad(degrees))
    return np.asarray(points @ np.array([[c, s], [-s, c]]) * size + (3.0, -2.0))


def test_a_turn_distorts_nothing_but_by_straight_lines() -> None:
    result = compare(drawing(LETTER), drawing(turned(LETTER, 90)))
    for key, figures in result.figures.items():
        if key == "linear":
            # Half way a square turned by a right angle is smaller by the square root of 2.
            np.testing.assert_allclose(figures.area.min(), 0.5, atol=1e-6)
            np.testing.assert_allclose(figures.whole["area_off"], 0.5, atol=1e-6)
            np.testing.assert_allclose(figures.whole["distortion"], 0, atol=1e-6)
            continue
        np.testing.assert_allclose(figures.area, 1, atol=2e-3, err_msg=key)
        np.testing.assert_allclose(figures.perimeter, 1, atol=2e-3, err_msg=key)
        np.testing.assert_allclose(figures.distortion, 0, atol=2e-3, err_msg=key)


def test_growth_is_straight_in_perimeter_and_bends_nothing() -> None:
    result = compare(drawing(LETTER), drawing(turned(LETTER, 0, 2.0)))
    figures = result.figures["projective"]
    np.testing.assert_allclose(figures.perimeter, (1 + TIMES) / 2, atol=1e-6)
    np.testing.assert_allclose(figures.area, ((1 + TIMES) / 2) ** 2, atol=1e-6)
    np.testing.assert_allclose(figures.whole["perimeter_off"], 0, atol=1e-6)
    np.testing.assert_allclose(figures.whole["area_off"], 1 / 16, atol=1e-6)
    np.testing.assert_allclose(figures.whole["worst_distortion"], 0, atol=1e-6)


def test_straight_lines_travel_as_far_as_their_ends_are_apart() -> None:
    shifted = LETTER + np.array([5.0, 12.0])
    figures = compare(drawing(LETTER), drawing(shifted)).figures["linear"]
    diagonal = float(np.linalg.norm(np.ptp(np.concatenate([LETTER, shifted]), axis=0)))
    np.testing.assert_allclose(figures.whole["travel"], 13 / diagonal, rtol=1e-6)
    np.testing.assert_allclose(figures.whole["jerk"], 0, atol=1e-6)


def test_figures_have_no_unit() -> None:
    scale = 1e-3
    bent = LETTER * (1.0, 1.3) + np.where(LETTER[:, :1] > 4, (0.0, 2.0), (0.0, 0.0))
    usual = compare(drawing(LETTER), drawing(bent))
    scaled = compare(drawing(LETTER, scale), drawing(bent, scale))
    for key, figures in usual.figures.items():
        for name, value in figures.whole.items():
            other = scaled.figures[key].whole[name]
            assert other == pytest.approx(value, rel=2e-2, abs=2e-3), (key, name)


def test_crossing_is_seen_where_the_outlines_cross(tools: Comparison) -> None:
    """Counted anew, by testing all pairs of sides of the drawn polygons for crossing."""
    (body,) = next(v for v in tools.variants if v.key == "linear").bodies
    simple = simple_by_sides(body.curves)
    np.testing.assert_array_equal(tools.figures["linear"].crossing, ~simple)
    assert 0 < tools.figures["linear"].whole["self_crossing"] < 0.5


def simple_by_sides(curves: Callable[[Floats], Curves]) -> Mask:
    t = np.arange(8)[:, None] / 8
    weights = np.concatenate([(1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t**2 * (1 - t), t**3], axis=1)
    polygons = (weights @ curves(TIMES)).reshape(len(TIMES), -1, 2)
    starts, ends = polygons, np.roll(polygons, -1, axis=1)
    # On which side of the line through side j the ends of side i lie, (F, j, i).
    first, second = sides(starts, ends, starts), sides(starts, ends, ends)
    apart = first * second < 0
    return np.asarray(~(apart & apart.swapaxes(1, 2)).any(axis=(1, 2)))


def sides(starts: Points, ends: Points, points: Points) -> Floats:
    edge = (ends - starts)[:, :, None]
    offset = points[:, None] - starts[:, :, None]
    return np.sign(edge[..., 0] * offset[..., 1] - edge[..., 1] * offset[..., 0])
