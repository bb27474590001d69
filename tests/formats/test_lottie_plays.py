"""Lottie in its own web player."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from shapetween.formats.lottie.writer import lottie_json
from shapetween.formats.options import WriteOptions
from shapetween.formats.table import Segments
from shapetween.model.movement import Movement
from shapetween.model.paint import Style
from shapetween.svg.write.sequence import frame_svg
from tests.browser import Browser, difference
from tests.movements import sample_chain, sample_movement
from tests.paints import EVERY
from tests.players import lottie_pictures

pytestmark = pytest.mark.browser

QUARTERS = (0.0, 0.25, 0.5, 0.75, 1.0)

STRAY = 3e-4


def assert_shows(
    browser: Browser, lottie_web: Path, animation: Any, frames: list[float], svgs: list[str]
) -> None:
    shots = lottie_pictures(browser, lottie_web, json.dumps(animation), frames)
    wanted = browser.pictures(svgs, [0.0] * len(svgs))
    for shot, frame, number in zip(shots, wanted, frames, strict=True):
        assert difference(shot, frame) <= STRAY, f"another picture at frame {number}"
        assert np.abs(shot - frame).mean() < 0.4, f"other colours at frame {number}"


def frames_at(movement: Movement, times: tuple[float, ...]) -> list[str]:
    return [frame_svg(drawing) for drawing in movement.at(np.array(times))]


@pytest.mark.parametrize(("first", "last"), EVERY)
def test_paint_is_as_the_frames_show_it(
    browser: Browser, lottie_web: Path, first: Style, last: Style
) -> None:
    movement = sample_movement(first, last)
    animation, _ = lottie_json(Segments((movement,)), WriteOptions())
    frames = [120 * t for t in QUARTERS]
    assert_shows(browser, lottie_web, animation, frames, frames_at(movement, QUARTERS))


def test_there_and_back_with_rests(browser: Browser, lottie_web: Path) -> None:
    movement = sample_movement()
    options = WriteOptions(loop="alternate", hold=0.5)
    animation, _ = lottie_json(Segments((movement,)), options)
    shown = (0.0, 0.5, 1.0, 1.0, 0.5, 0.0)
    frames = [18.0, 90.0, 156.0, 170.0, 240.0, 299.9]
    assert_shows(browser, lottie_web, animation, frames, frames_at(movement, shown))


def test_chains(browser: Browser, lottie_web: Path) -> None:
    legs = sample_chain()
    options = WriteOptions(duration=1.0, hold=0.5, loop="repeat")
    animation, _ = lottie_json(Segments(legs, closed=True), options)
    shown = ((0, 0.0), (0, 0.5), (0, 1.0), (1, 0.5), (2, 0.5), (2, 1.0))
    svgs = [frame_svg(legs[leg].at(np.array([t]))[0]) for leg, t in shown]
    assert_shows(browser, lottie_web, animation, [12.0, 60.0, 105.0, 150.0, 240.0, 269.9], svgs)
