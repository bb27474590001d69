"""Shapes are made plain: filled or stroked, each line by itself, rings closed where nobody sees."""

from dataclasses import replace

import numpy as np
import pytest

from shapetween.elastic.paths import plain_shapes
from shapetween.model.drawing import Shape
from shapetween.model.outline import Outline
from shapetween.model.paint import Colour, Stroke, Style
from tests.drawings import area, line, square

ROUND = Stroke(Colour(), 2.0, cap="round", join="round")


def plain(shape: Shape, other: Shape | None = None, kept: tuple[str, ...] = ()) -> list[Shape]:
    return list(plain_shapes([shape], [other or area(square(0, 0, 5))], kept)[0])


def lines(*rings: Outline, stroke: Stroke = ROUND, name: str = "") -> Shape:
    return Shape(rings, Style(None, stroke), name)


def open_square() -> Outline:
    return Outline(square(0, 0, 10).curves, closed=False)


def test_a_filled_open_line_is_an_area_and_a_line() -> None:
    shape = replace(line((0, 0), (9, 0), (9, 9)), style=Style(Colour(), ROUND))
    filled, stroked = plain(shape)
    assert (filled.style.stroke, filled.rings[0].closed) == (None, True)
    assert (stroked.style.fill, stroked.rings[0].closed) == (None, False)


@pytest.mark.parametrize(
    ("stroke", "closed"),
    [
        (ROUND, True),
        (replace(ROUND, cap="butt"), False),
        (replace(ROUND, join="miter"), False),
        (replace(ROUND, dashes=(3.0, 1.0)), False),
    ],
)
def test_ends_that_meet_close_a_line_where_no_cap_tells(stroke: Stroke, closed: bool) -> None:
    (found,) = plain(lines(open_square(), stroke=stroke))
    assert found.rings[0].closed == closed


def test_ends_that_miss_by_a_rounded_digit_meet() -> None:
    curves = square(0, 0, 10).curves.copy()
    curves[-1, 3] += [0.01, 0]
    (found,) = plain(lines(Outline(curves, closed=False)))
    assert found.rings[0].closed
    np.testing.assert_array_equal(found.rings[0].curves[:-1], curves)
    curves[-1, 3] += [1, 0]
    assert not plain(lines(Outline(curves, closed=False)))[0].rings[0].closed


def test_lines_of_one_path_come_apart_where_both_drawings_have_lines() -> None:
    two = lines(*line((0, 0), (9, 0)).rings, *line((0, 5), (9, 5)).rings, name="pair")
    one = line((0, 0), (1, 1))
    assert [shape.name for shape in plain(two, one)] == ["pair", ""]
    assert len(plain(two)) == 1  # what becomes an area stays whole
    assert len(plain(two, one, ("pair",))) == 1
    assert len(plain(two, replace(one, name="pair"))) == 1
    faint = replace(two, style=replace(two.style, opacity=0.5))
    assert len(plain(faint, one)) == 1  # where they cross would show
