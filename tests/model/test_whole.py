"""The motion of a shape as a whole, against known maps, and the gradients that follow it."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from shapetween.base.arrays import Affine, Points
from shapetween.geometry.affine import mapped
from shapetween.geometry.bezier import line_curves
from shapetween.model.blend import blend
from shapetween.model.drawing import Box, Drawing, Shape
from shapetween.model.gradients import in_normal_form, moved_style
from shapetween.model.outline import Outline
from shapetween.model.paint import Colour, Gradient, Stop, Stroke, Style
from shapetween.model.whole import MOTION_TIMES, WholeMotion
from shapetween.pipeline import prepare

STOPS = (Stop(0.0, Colour(1, 0, 0)), Stop(1.0, Colour(0, 0, 1)))
ACROSS = Gradient("linear", (1.0, 0.0, 6.0, 1.0), (1, 0, 0, 1, 0, 0), STOPS)
ROUND = Gradient("radial", (3.0, 1.0, 4.0, 3.0, 1.5), (1, 0, 0, 1, 0, 0), STOPS)
EL = np.array([[0.0, 0.0], [6.0, 0.0], [6.0, 2.0], [2.0, 2.0], [2.0, 5.0], [0.0, 5.0]])
BOX = Box(-20.0, -20.0, 40.0, 40.0)


def turned(angle: float, size: float = 1.0, shift: tuple[float, float] = (0.0, 0.0)) -> Affine:
    cos, sin = size * math.cos(angle), size * math.sin(angle)
    return np.array([[cos, -sin, shift[0]], [sin, cos, shift[1]]])


def drawing(points: Points, style: Style) -> Drawing:
    outline = Outline(line_curves(points, np.roll(points, -1, axis=0)), True)
    return Drawing((Shape((outline,), style, "it"),), BOX)


def numbers(paint: object) -> list[float]:
    assert isinstance(paint, Gradient)
    normal = in_normal_form(paint)
    return [*normal.points, *normal.matrix]


@given(st.floats(-6, 6), st.floats(0.2, 5), st.floats(-0.5, 0.5))
def test_affine_motions_are_followed_exactly(angle: float, size: float, skew: float) -> None:
    places = []
    for t in MOTION_TIMES:
        matrix = turned(t * angle, 1 + t * (size - 1), (3 * t, -t))
        matrix[:, :2] = matrix[:, :2] @ [[1, t * skew], [0, 1]]
        places.append(mapped(EL, matrix))
    found = WholeMotion.of(np.stack(places), np.arange(1.0, 7.0))
    assert found is not None
    assert found.turn == pytest.approx(angle, abs=0.6)  # shearing turns a little too
    for t, place in zip(MOTION_TIMES.tolist(), places, strict=True):
        assert mapped(EL, found.at(t)) == pytest.approx(place, abs=1e-9)
    assert mapped(places[-1], found.back) == pytest.approx(EL, abs=1e-9)


def test_bodies_that_bend_are_followed_by_turning_only() -> None:
    """A bar that rolls up into a circle: the best affine map would flatten it."""
    s = np.linspace(-1, 1, 41)
    bends = MOTION_TIMES[:, None] * math.pi + 1e-9
    rolled = np.stack([np.sin(bends * s) / bends, (1 - np.cos(bends * s)) / bends], axis=2)
    strip = np.concatenate([rolled, rolled * 0.9], axis=1)
    found = WholeMotion.of(strip, np.ones(82))
    assert found is not None
    for t in MOTION_TIMES.tolist():
        (a, b, _), (c, d, _) = found.at(t).tolist()
        assert (a, b) == pytest.approx((d, -c), abs=1e-9)
        assert math.hypot(a, b) > 0.3


@pytest.mark.parametrize("points", [EL, EL * [1, 0]], ids=["area", "line"])
def test_what_vanishes_has_no_motion(points: Points) -> None:
    shrunk = (1 - MOTION_TIMES)[:, None, None] * points
    assert WholeMotion.of(shrunk, np.ones(6)) is None
    assert WholeMotion.of(np.repeat(points[None], 17, axis=0), np.zeros(6)) is None


@pytest.mark.parametrize("paint", [ACROSS, ROUND], ids=["linear", "radial"])
@pytest.mark.parametrize(("angle", "stroked"), [(2.1, False), (-3.0, False), (0.7, True)])
def test_a_gradient_rides_on_its_shape(paint: Gradient, angle: float, stroked: bool) -> None:
    """If B is A moved, turned and enlarged, gradient and all, so is every frame."""
    style = Style(None, Stroke(paint, 0.5)) if stroked else Style(paint)
    matrix = turned(angle, 1.7, (4.0, -3.0))
    a = drawing(EL, style)
    b = drawing(mapped(EL, matrix), moved_style(style, matrix))
    movement = prepare(a, b).movement
    for t in (0.0, 0.3, 0.5, 0.71, 1.0):
        first, shape = (drawn.shapes[0] for drawn in movement.at(np.array([0.0, t])))
        start, place = (each.rings[0].curves[:, 0] for each in (first, shape))
        # The map that takes the first frame's corners to this one's says where the gradient is.
        found = np.linalg.lstsq(np.c_[start, np.ones(len(start))], place, rcond=None)[0].T
        shown = shape.style.stroke.paint if shape.style.stroke else shape.style.fill
        wanted = moved_style(Style(paint), np.asarray(found, np.float64)).fill
        assert numbers(shown) == pytest.approx(numbers(wanted), abs=2e-3)


def test_a_gradient_that_becomes_a_colour_rides_too() -> None:
    matrix = turned(2.0, 1.0, (4.0, -3.0))
    a, b = drawing(EL, Style(ACROSS)), drawing(mapped(EL, matrix), Style(Colour(0, 1, 0)))
    halfway = prepare(a, b).movement.at(np.array([0.5]))[0].shapes[0].style.fill
    x1, y1, x2, y2 = numbers(halfway)[:4]
    assert math.atan2(y2 - y1, x2 - x1) == pytest.approx(1.0 + math.atan2(1, 5), abs=1e-3)


def test_light_from_above_stays_above_while_a_shape_turns_over() -> None:
    down = Style(Gradient("linear", (0, -5, 0, 5), (1, 0, 0, 1, 0, 0), STOPS))
    half_turn = np.stack([mapped(EL, turned(t * math.pi)) for t in MOTION_TIMES])
    motion = WholeMotion.of(half_turn, np.ones(6))
    for t in (0.25, 0.5, 0.75):
        x1, y1, x2, y2 = numbers(blend(down, down, t, motion).fill)[:4]
        assert x2 - x1 == pytest.approx(0, abs=1e-3)
        assert y2 - y1 > 0


def test_gradients_come_into_the_frame_with_their_drawing() -> None:
    """B's view box is twice as large as A's, so all of B is drawn at half its size."""
    a = drawing(EL, Style(ACROSS))
    large = moved_style(Style(ACROSS), turned(0.0, 2.0))
    b = drawing(2 * EL, large)
    b = Drawing(b.shapes, Box(-40.0, -40.0, 80.0, 80.0))
    for drawn in prepare(a, b).movement.at(np.array([0.0, 0.5, 1.0])):
        assert numbers(drawn.shapes[0].style.fill) == pytest.approx(numbers(ACROSS), abs=1e-9)


def test_a_gradient_shrinks_with_a_shape_that_leaves() -> None:
    body = np.array([[0.0, 0.0], [6.0, 0.0], [7.0, 4.0], [3.0, 5.0], [-1.0, 4.0]])  # no stroke
    here, away = drawing(body, Style(ACROSS)).shapes[0], drawing(body + 12, Style()).shapes[0]
    both = Drawing((here, Shape(away.rings, away.style, "other")), BOX)
    movement = prepare(both, Drawing((both.shapes[1],), BOX)).movement
    first, drawn = (drawing.shapes[0] for drawing in movement.at(np.array([0.0, 0.2])))
    start, place = (shape.rings[0].curves[:, 0] for shape in (first, drawn))
    found = np.linalg.lstsq(np.c_[start, np.ones(len(start))], place, rcond=None)[0].T
    assert np.sqrt(np.linalg.det(found[:, :2])) < 0.95
    wanted = moved_style(Style(ACROSS), np.asarray(found, np.float64)).fill
    assert numbers(drawn.style.fill) == pytest.approx(numbers(wanted), abs=0.02)
