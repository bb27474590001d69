"""Style sheets move one shape as the movement does."""

import re
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from shapetween.base.errors import OptionError
from shapetween.formats.css import css
from shapetween.formats.options import WriteOptions
from shapetween.formats.table import Segments
from shapetween.model.drawing import Box
from shapetween.model.movement import Movement
from shapetween.model.paint import Stroke, Style
from shapetween.svg.write.sequence import frame_svg
from tests.browser import SIZE, Browser, difference
from tests.movements import circle, formula_part, sample_chain, sample_movement, spin
from tests.paints import BLUE, RED, STRIPES
from tests.players import css_pictures

BOX = Box(0, 0, 100, 100)


def one(first: Style | None = None, last: Style | None = None) -> Movement:
    """The ellipse of the sample, alone."""
    whole = sample_movement(first, last)
    return Movement(whole.parts[1:], whole.box)


def written(*movements: Movement, closed: bool = False, **options: Any) -> str:
    made = css(Segments(movements, closed), WriteOptions(**options))
    assert isinstance(made.content, str)
    return made.content


BODIES = {
    "path": '<div class="morph"></div>',
    "shape": '<div class="morph" style="width:100%"></div>',
    "d": '<svg viewBox="0 0 100 100"><path class="morph"/></svg>',
}


@pytest.mark.browser
@pytest.mark.parametrize("form", ["path", "shape", "d"])
@pytest.mark.parametrize(
    ("options", "seconds", "shown"),
    [
        ({}, (0, 0.5, 1, 1.5, 2, 9), (0, 0.25, 0.5, 0.75, 1, 1)),
        ({"loop": "alternate", "hold": 0.4}, (0.3, 1.4, 2.5, 2.7, 3.8, 5), (0, 0.5, 1, 1, 0.5, 0)),
        ({"loop": "repeat", "hold": 0.4}, (0.3, 1.4, 2.5, 3.1), (0, 0.5, 1, 0)),
    ],
)
def test_it_plays_as_the_frames_show_it(
    browser: Browser,
    form: str,
    options: dict[str, Any],
    seconds: tuple[float, ...],
    shown: tuple[float, ...],
) -> None:
    movement = one(Style(RED), Style(replace(BLUE, alpha=0.5)))
    sized = options | ({"size": (SIZE,)} if form != "d" else {})
    sheet = written(movement, css=form, **sized)
    shots = css_pictures(browser, sheet, "morph", seconds, BODIES[form])
    frames = [frame_svg(drawing) for drawing in movement.at(np.array(shown, float))]
    for shot, frame in zip(shots, browser.pictures(frames, [0.0] * len(frames)), strict=True):
        assert difference(shot, frame) <= 3e-4
        assert np.abs(shot - frame).mean() < 0.4


@pytest.mark.browser
def test_chains_change_their_structure_between_two_legs(browser: Browser) -> None:
    legs = list(sample_chain())
    legs[1] = Movement(legs[1].parts[:1], BOX)
    sheet = written(*legs, closed=True, duration=1.0, hold=0.5, loop="repeat", size=(SIZE,))
    seconds = (0.2, 1.0, 1.7, 2.5, 4.0, 4.8)
    shown = ((0, 0.0), (0, 0.5), (0, 1.0), (1, 0.5), (2, 0.5), (0, 0.0))
    frames = [frame_svg(legs[leg].at(np.array([t]))[0]) for leg, t in shown]
    shots = css_pictures(browser, sheet, "morph", seconds, BODIES["path"])
    for shot, frame in zip(shots, browser.pictures(frames, [0.0] * len(frames)), strict=True):
        assert difference(shot, frame) <= 3e-4


@pytest.mark.browser
def test_parts_of_one_colour_are_united_whichever_way_they_run(browser: Browser) -> None:
    ring = circle(np.array([40.0, 50.0]), 25.0)
    other = circle(np.array([60.0, 50.0]), 25.0)[::-1, ::-1]
    movement = Movement((formula_part(ring, spin(0.1)), formula_part(other, spin(0.1))), BOX)
    shots = css_pictures(browser, written(movement, size=(SIZE,)), "morph", (1.0,), BODIES["path"])
    frame = frame_svg(movement.at(np.array([0.5]))[0])
    assert difference(shots[0], browser.pictures([frame], [0.0])[0]) <= 3e-4


@pytest.mark.browser
def test_less_motion_is_the_first_drawing(browser: Browser) -> None:
    movement = one()
    browser.reduce_motion(True)
    try:
        shot = css_pictures(
            browser, written(movement, size=(SIZE,)), "morph", (1.0,), BODIES["path"]
        )[0]
    finally:
        browser.reduce_motion(False)
    frame = frame_svg(movement.at(np.zeros(1))[0])
    assert difference(shot, browser.pictures([frame], [0.0])[0]) <= 3e-4


def test_what_a_clip_path_cannot_be_is_refused() -> None:
    with pytest.raises(OptionError, match="2 of different paint"):
        written(sample_movement())
    line = Style(RED, Stroke(BLUE))
    with pytest.raises(OptionError, match="here is one with a line"):
        written(one(line, line))
    with pytest.raises(OptionError, match="here are 0 "):
        written(one(Style(None), Style(None)))


def test_a_gradient_is_told_of() -> None:
    made = css(Segments((one(Style(STRIPES), Style(STRIPES)),)), WriteOptions())
    assert made.warnings == ("a gradient becomes one colour in .css; set a background of your own",)


def test_a_file_s_name_is_the_class() -> None:
    made = css(Segments((one(),), name="3 cats & dogs"), WriteOptions())
    assert isinstance(made.content, str)
    assert "@keyframes morph-3-cats-dogs{" in made.content


def test_keyframes_are_counted() -> None:
    assert written(one(Style(RED), Style(RED)), keyframes=7).count("clip-path") == 7 + 1


def test_a_page_may_set_a_colour_of_its_own_where_none_changes() -> None:
    still = written(one(Style(RED), Style(RED)))
    assert still.count("background-color") == 1
    assert "opacity" not in still
    assert "background-color" not in still.partition("@keyframes")[2]
    changes = written(one(Style(RED), Style(BLUE)))
    assert changes.partition("@keyframes")[2].count("background-color") >= 2
    faint = written(one(Style(RED, opacity=0.5), Style(RED, opacity=0.5)))
    assert faint.count("opacity:.5") == 1
    legs = one(Style(RED), Style(RED)), one(Style(RED, opacity=0.5), Style(RED, opacity=0.5))
    chained = written(*legs)
    assert {"opacity:1", "opacity:.5"} <= set(re.findall(r"opacity:[.\d]+", chained))
