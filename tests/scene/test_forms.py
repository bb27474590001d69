"""What items are recognised as, whatever their size and place."""

import numpy as np
import pytest

from shapetween.base.arrays import Curves, Floats
from shapetween.geometry.bezier import line_curves
from shapetween.geometry.rotation import rotations
from shapetween.model.drawing import Shape
from shapetween.model.outline import Outline
from shapetween.model.paint import Colour, Stroke, Style
from shapetween.scene.forms import (
    QUARTER,
    Blob,
    Dot,
    Form,
    OpenLine,
    RoundedBox,
    Segment,
    form_of,
)
from shapetween.scene.items import Item
from shapetween.scene.motion.boxes import box_blend
from shapetween.scene.places import Places
from tests.drawings import line, ring


def rounded(width: float, height: float, rx: float, ry: float, angle: float = 0.0) -> Outline:
    """A rounded rectangle about the origin, turned."""
    k = 1 - QUARTER
    curves: list[Curves] = []
    w, h = width / 2, height / 2
    for sx, sy, flip in ((1, -1, False), (1, 1, True), (-1, 1, False), (-1, -1, True)):
        a = np.array([w - rx, h])
        b = np.array([w, h - ry])
        arc = np.array([a, [w - rx * k, h], [w, h - ry * k], b]) * (sx, sy)
        curves.append(arc[::-1] if flip else arc)
    run: list[Curves] = []
    for i in range(4):
        run.append(curves[i])
        end, start = curves[i][3], curves[(i + 1) % 4][0]
        if (end != start).any():
            run.append(line_curves(end, start))
    return Outline(np.array(run) @ rotations(np.asarray(angle)).T)


def filled(outline: Outline) -> Item:
    return Item((outline,), Style())


def stroked(shape: Shape) -> Item:
    return Item(shape.rings, shape.style)


@pytest.mark.parametrize("scale", [1e-3, 1.0, 1e6])
@pytest.mark.parametrize(
    ("sides", "radii", "angle"),
    [
        ((10, 10), (5, 5), 0.0),
        ((20, 10), (10, 5), 0.4),
        ((20, 10), (2, 2), 0.0),
        ((20, 10), (2, 2), -0.7),
        ((30, 4), (2, 2), 0.3),
        ((30, 4), (1e-6, 1e-6), 0.0),
    ],
    ids=["disc", "ellipse", "rounded", "turned", "capsule", "bar"],
)
def test_rounded_boxes_are_one_family(
    sides: tuple[float, float], radii: tuple[float, float], angle: float, scale: float
) -> None:
    outline = rounded(*sides, *radii, angle).transformed(
        np.array([[scale, 0, 7 * scale], [0, scale, -3 * scale]])
    )
    form = form_of(filled(outline))
    assert isinstance(form, RoundedBox)
    np.testing.assert_allclose(form.centre, [7 * scale, -3 * scale], atol=0.05 * scale)
    np.testing.assert_allclose(np.sort(form.sides), np.sort(np.array(sides) * scale), rtol=0.02)
    np.testing.assert_allclose(form.radii / scale, radii, atol=0.3)
    assert form.round == (sides[0] == sides[1])


def straight(*ends: float) -> Curves:
    return line_curves(np.array(ends[:2]), np.array(ends[2:]))


def star() -> Outline:
    angle = np.arange(10) * np.pi / 5
    size = np.where(np.arange(10) % 2, 4.0, 10.0)
    return ring(np.stack([size * np.cos(angle), size * np.sin(angle)], axis=1))


@pytest.mark.parametrize(
    "outline",
    [ring([(0, 0), (10, 5), (0, 10)]), star(), ring([(5, 0), (10, 5), (5, 10), (0, 8)])],
    ids=["triangle", "star", "kite"],
)
def test_other_outlines_are_none(outline: Outline) -> None:
    assert isinstance(form_of(filled(outline)), Blob)


def corners_of(form: Form) -> Floats:
    assert isinstance(form, OpenLine)
    return form.corners


def test_lines_are_straight_bent_or_dots() -> None:
    assert isinstance(form_of(stroked(line((0, 0), (5, 0), (9, 0)))), Segment)
    assert isinstance(form_of(stroked(line((0, 0), (0.01, 0)))), Dot)
    # A line that runs back along itself is not straight, nor is a check mark.
    assert isinstance(form_of(stroked(line((0, 0), (9, 0), (5, 0)))), OpenLine)
    np.testing.assert_allclose(corners_of(form_of(stroked(line((0, 3), (3, 6), (9, 0))))), [1 / 3])


def test_a_rounded_corner_is_a_corner() -> None:
    arc = np.array([[10, 0], [11, 0], [12, 1], [12, 2]], dtype=float)
    curves = np.array([straight(0, 0, 10, 0), arc, straight(12, 2, 12, 9)])
    item = Item((Outline(curves, False),), Style(None, Stroke(Colour())))
    assert len(corners_of(form_of(item))) == 1


def test_a_closed_line_is_no_straight_one() -> None:
    there_and_back = Outline(np.array([straight(0, 0, 9, 0), straight(9, 0, 0, 0)]))
    item = Item((there_and_back,), Style(None, Stroke(Colour())))
    assert not isinstance(form_of(item), Segment)


@pytest.mark.parametrize("off", [-1e-12, 0.0, 1e-12])
@pytest.mark.parametrize("quarters", [0, 1])
def test_a_box_that_leans_by_half_a_right_angle_leans_one_way(off: float, quarters: int) -> None:
    angle = np.pi / 4 + quarters * np.pi / 2 + off
    form = form_of(filled(rounded(9.0, 4.0, 1.0, 1.0, angle)))
    assert isinstance(form, RoundedBox)
    assert form.angle == pytest.approx(np.pi / 4, abs=1e-6)
    np.testing.assert_allclose(form.sides, (9, 4) if quarters == 0 else (4, 9), atol=1e-6)


@pytest.mark.parametrize(("sides", "turn"), [((20, 14), 0.0), ((18, 4), np.pi / 2)])
def test_a_bar_turns_upright_and_a_screen_is_made_upright(
    sides: tuple[float, float], turn: float
) -> None:
    """A screen that turned over to be that of a telephone would leave its foot."""
    outlines = [rounded(*own, 1.0, 1.0) for own in (sides, sides[::-1])]
    boxes = [
        RoundedBox(np.zeros(2), np.array(own, dtype=float), 0.0, np.ones(2))
        for own in (sides, sides[::-1])
    ]
    track = box_blend(boxes[0], boxes[1], *map(Places, outlines))
    assert abs(track.turn) == pytest.approx(turn)


@pytest.mark.parametrize(("long", "turns"), [(2.4, True), (1.8, False)])
def test_a_wall_never_turns_over_and_a_bar_may(long: float, turns: bool) -> None:
    """Where sides differ so much, both ways: a wall's windows would turn with it."""
    sides = (46.0, 46.0 / long), (20.0, 40.0)
    outlines = [rounded(*own, 1.0, 1.0) for own in sides]
    boxes = [RoundedBox(np.zeros(2), np.array(own), 0.0, np.ones(2)) for own in sides]
    track = box_blend(boxes[0], boxes[1], *map(Places, outlines))
    assert (abs(track.turn) > 1) == turns
