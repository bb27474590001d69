"""Lottie in its own web player."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import shapetween as st
from shapetween.formats.lottie.writer import lottie_json
from shapetween.formats.options import WriteOptions
from shapetween.formats.table import Segments
from shapetween.model.movement import Movement
from shapetween.model.paint import Style
from shapetween.svg.read.reader import read_svg
from shapetween.svg.write.sequence import frame_svg
from tests.browser import Browser, difference
from tests.formats.test_lottie import assert_valid
from tests.formats.test_module_groups import DRAWN, ROOT
from tests.movements import sample_chain, sample_movement
from tests.paints import EVERY
from tests.players import lottie_pictures, thorvg_pictures

pytestmark = pytest.mark.browser

QUARTERS = (0.0, 0.25, 0.5, 0.75, 1.0)

STRAY = 3e-4


def assert_shows(
    browser: Browser,
    lottie_web: Path,
    animation: Any,
    frames: list[float],
    svgs: list[str],
    rounding: float = 0.4,
) -> None:
    shots = lottie_pictures(browser, lottie_web, json.dumps(animation), frames)
    wanted = browser.pictures(svgs, [0.0] * len(svgs))
    for shot, frame, number in zip(shots, wanted, frames, strict=True):
        assert difference(shot, frame) <= STRAY, f"another picture at frame {number}"
        assert np.abs(shot - frame).mean() < rounding, f"other colours at frame {number}"


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


#: Groups of drawings that the module's tests have; and a clip, which moves.
CLIP = (
    '<clipPath id="c"><path clip-rule="evenodd" d="M{a} 10H{b}V90H{a}ZM{c} 40V60H{b}V40Z"/>'
    '</clipPath><g clip-path="url(#c)"><circle cx="50" cy="50" r="40" fill="#06c"/>'
    '<path d="M{a} 45L90 50 10 60Z" fill="#fa0"/></g>'
)
GROUPS = {
    **{name: DRAWN[name] for name in ("mask", "mask-that-goes", "faded-together")},
    "clip": (CLIP.format(a=10, b=60, c=30), CLIP.format(a=40, b=95, c=70)),
    "clip-that-comes": (
        '<path fill="#06c" d="M5 5H70V80H5Z"/>',
        '<clipPath id="c"><circle cx="60" cy="60" r="30"/></clipPath>'
        '<g clip-path="url(#c)"><path fill="#06c" d="M25 20H95V95H25Z"/></g>',
    ),
    "two-masks": (
        DRAWN["mask"][0].replace("<g ", '<clipPath id="c"><circle cx="40" cy="40" r="38"/>'
        '</clipPath><g clip-path="url(#c)"><g ').replace("</g>", "</g></g>"),
        DRAWN["mask"][1].replace("<g ", '<clipPath id="c"><circle cx="60" cy="60" r="38"/>'
        '</clipPath><g clip-path="url(#c)"><g ').replace("</g>", "</g></g>"),
    ),
}  # fmt: skip


def grouped(name: str) -> Movement:
    first, last = (read_svg(f"{ROOT}{body}</svg>".encode(), name) for body in GROUPS[name])
    (movement,) = st.morph(first, last).movements
    return movement


@pytest.mark.parametrize("name", GROUPS)
def test_masks_are_mattes_and_groups_are_drawn_apart(
    browser: Browser, lottie_web: Path, name: str
) -> None:
    movement = grouped(name)
    svgs = frames_at(movement, QUARTERS)
    for loop in ("once", "alternate"):
        animation, told = lottie_json(Segments((movement,)), WriteOptions(loop=loop))
        assert not told
        assert_valid(animation)
        # A picture that is laid on another is rounded once more, by a step of 255 at most.
        shown = [120 * t for t in QUARTERS[:-1]]
        assert_shows(browser, lottie_web, animation, shown, svgs[:-1], 1.0)
    text = json.dumps(lottie_json(Segments((movement,)), WriteOptions())[0])
    assert ('"td": 1' in text) == ("mask" in name)
    shots = thorvg_pictures(text.encode(), [120 * t for t in QUARTERS])
    for shot, frame in zip(shots, browser.pictures(svgs, [0.0] * len(svgs)), strict=True):
        assert difference(shot, frame) <= 4 * STRAY
        assert np.abs(shot - frame).mean() < 1.2
