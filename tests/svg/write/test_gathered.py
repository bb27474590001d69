"""Neighbours of one paint are one path where that is shorter, and look as they did."""

import xml.etree.ElementTree as ET
from dataclasses import replace
from typing import Literal

import numpy as np
import pytest

from shapetween.model.drawing import Box
from shapetween.model.movement import Movement
from shapetween.model.paint import Colour, Stroke, Style
from shapetween.model.part import Part
from shapetween.svg.write.smil import smil_svg
from tests.movements import circle, formula_part, spin
from tests.smil import SVG, curves_of, path_at

BOX = Box(0, 0, 100, 100)
INK, RED = Style(Colour(0, 0, 0)), Style(Colour(1, 0, 0))


def dot(x: float, style: Style = INK, name: str = "", turns: float = 0.3) -> Part:
    """A disc that turns, and goes down a little."""
    return formula_part(
        circle(np.array([x, 30.0]), 6.0) * [1.0, 1.3], spin(turns, (3.0, 20.0)), style, style, name
    )


def paths(parts: tuple[Part, ...], keyframes: Literal["auto"] | int = "auto") -> list[ET.Element]:
    text = smil_svg(Movement(parts, BOX), duration=1.0, keyframes=keyframes)
    return [path for path in ET.fromstring(text).iter(f"{SVG}path") if len(path)]


def test_what_moves_alike_is_one_path_that_moves_as_all_do() -> None:
    parts = tuple(dot(x) for x in (15.0, 40.0, 65.0))
    (path,) = paths(parts)
    for t in np.linspace(0, 0.999, 40):
        shown = curves_of(path_at(path, t))
        for part, (curves, closed) in zip(parts, shown, strict=True):
            exact = part.curves(np.array([t]))[0]
            assert closed
            # Either way round.
            away = min(np.abs(curves - each).max() for each in (exact, exact[::-1, ::-1]))
            assert away < 0.04


def test_keyframes_asked_for_leave_every_part_a_path() -> None:
    assert len(paths((dot(15.0), dot(40.0)), keyframes=5)) == 2


LINE = Style(None, Stroke(Colour(0, 0, 0), 2.0))


@pytest.mark.parametrize(
    "other",
    [
        pytest.param(dot(40.0, name="eye"), id="a name"),
        pytest.param(dot(40.0, RED), id="paint"),
        pytest.param(dot(22.0), id="where they touch"),
        pytest.param(dot(40.0, replace(INK, opacity=0.5)), id="opacity"),
        pytest.param(dot(40.0, replace(INK, fill_rule="evenodd")), id="rule"),
    ],
)
def test_what_is_not_the_same_keeps_its_path(other: Part) -> None:
    assert len(paths((dot(15.0), dot(65.0)))) == 1
    assert len(paths((dot(15.0), other))) == 2


def test_lines_touch_where_their_width_does() -> None:
    wide = replace(LINE, stroke=Stroke(Colour(0, 0, 0), 12.0))
    assert len(paths((dot(15.0, LINE), dot(40.0, LINE)))) == 1
    assert len(paths((dot(15.0, wide), dot(40.0, wide)))) == 2


def test_dashes_start_where_their_line_does() -> None:
    dashed = Style(None, Stroke(Colour(0, 0, 0), 2.0, dashes=(3.0, 1.0)))
    assert len(paths((dot(15.0, dashed), dot(40.0, dashed)))) == 2


def test_what_takes_easings_of_its_own_keeps_its_path_where_that_is_shorter() -> None:
    parts = (dot(15.0), dot(40.0, turns=-1.3), dot(65.0, turns=0.9))
    assert len(paths(parts)) == 3
