"""Strokes as areas: as wide as drawn, with their caps, and with the hole of a closed line."""

from dataclasses import replace
from typing import Literal

import numpy as np
import pytest

from shapetween.fill.regions import regions_of
from shapetween.fill.stroking import outlined
from shapetween.model.drawing import Shape
from shapetween.model.outline import Outline
from shapetween.model.paint import Colour, Stroke, Style
from tests.drawings import line
from tests.movements import circle


def covered(shape: Shape) -> float:
    found, _ = regions_of(shape, "stroke")
    return sum(r.area - sum(h.area for h in r.holes) for r in found)


@pytest.mark.parametrize(("cap", "extra"), [("butt", 0.0), ("square", 16.0), ("round", 4 * np.pi)])
def test_caps(cap: Literal["butt", "round", "square"], extra: float) -> None:
    drawn = line((0, 0), (30, 0), width=4)
    stroke = Stroke(Colour(1, 0, 0), 4, cap)
    shape = outlined(replace(drawn, style=Style(None, stroke, 0.5)))
    assert covered(shape) == pytest.approx(120 + extra, rel=2e-3)
    assert shape.style.fill == Colour(1, 0, 0)
    assert shape.style.stroke is None
    assert shape.style.opacity == 0.5
    assert shape.name == drawn.name


def test_a_closed_line_is_a_ring_with_a_hole() -> None:
    disc = Shape((Outline(circle(np.zeros(2), 10.0)),), Style(None, Stroke(Colour(), 2)))
    shape = outlined(disc)
    assert [ring.closed for ring in shape.rings] == [True, True]
    assert covered(shape) == pytest.approx(np.pi * (11**2 - 9**2), rel=1e-2)


def test_lines_that_cross_are_one_area() -> None:
    cross = Shape(
        (*line((-10, 0), (10, 0)).rings, *line((0, -10), (0, 10)).rings),
        Style(None, Stroke(Colour(), 2)),
    )
    shape = outlined(cross)
    assert len(shape.rings) == 1
    assert covered(shape) == pytest.approx(40 + 40 - 4)


def test_a_shape_without_a_stroke_stays_as_it_is() -> None:
    shape = Shape(line((0, 0), (1, 1)).rings, Style(None))
    assert outlined(shape) is shape
