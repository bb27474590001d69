"""Firefox and WebKitGTK play what Chromium plays: the frames of the same moments."""

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Literal

import numpy as np
import pytest

import shapetween as st
from shapetween.formats.module.writer import module_text
from shapetween.formats.options import WriteOptions
from shapetween.formats.table import Segments
from shapetween.model.movement import Movement
from shapetween.model.paint import Style
from shapetween.svg.write.sequence import frame_svg
from shapetween.svg.write.smil import smil_svg
from tests.browser import Browser, Picture, difference
from tests.firefox import firefox
from tests.movements import sample_chain, sample_movement
from tests.paints import EVERY, OVALS
from tests.players import module_pictures
from tests.webkit import webkit

pytestmark = pytest.mark.browser

QUARTERS = (0.0, 0.25, 0.5, 0.75, 1.0)

#: Share of pixels that may differ by more than an edge does.
STRAY = 5e-4

#: Mean difference of a colour, of 255.
TINT = 0.6

INPUTS = Path(__file__).parents[2] / "gallery" / "inputs"

#: Pairs of the gallery: one outline, one that turns, holes, parts that come and go.
PAIRS = (
    ("horse", "kangaroo"),
    ("hammer", "wrench"),
    ("key", "lock"),
    ("run", "walk"),
)


@pytest.fixture(scope="module", params=["firefox", "webkit"])
def browser(request: pytest.FixtureRequest) -> Iterator[Browser]:
    with (firefox if request.param == "firefox" else webkit)() as opened:
        yield opened


def frames_at(movement: Movement, times: Sequence[float]) -> list[str]:
    return [frame_svg(drawing) for drawing in movement.at(np.array(times, float))]


def assert_alike(browser: Browser, shots: Sequence[Picture], frames: Sequence[str]) -> None:
    wanted = browser.pictures(frames, [0.0] * len(frames))
    for shot, frame, number in zip(shots, wanted, range(len(frames)), strict=True):
        assert difference(shot, frame) <= STRAY, f"another picture at moment {number}"
        assert np.abs(shot - frame).mean() < TINT, f"other colours at moment {number}"
    moved = max(difference(wanted[0], other) for other in wanted)
    assert moved > 10 * STRAY, "the check would not see a difference"


@pytest.mark.parametrize(("first", "last"), EVERY + OVALS)
def test_paint_of_an_animated_svg(browser: Browser, first: Style, last: Style) -> None:
    movement = sample_movement(first, last)
    text = smil_svg(movement, duration=1.0)
    shots = browser.pictures([text] * len(QUARTERS), QUARTERS)
    assert_alike(browser, shots, frames_at(movement, QUARTERS))


@pytest.mark.parametrize(("first", "last"), EVERY + OVALS)
def test_paint_of_a_module(browser: Browser, first: Style, last: Style) -> None:
    movement = sample_movement(first, last)
    text = module_text(Segments((movement,)), WriteOptions(duration=1.0))
    assert_alike(browser, module_pictures(browser, text, QUARTERS), frames_at(movement, QUARTERS))


@pytest.mark.parametrize("keyframes", ["auto", 25])
def test_there_and_back_with_rests(browser: Browser, keyframes: "Literal['auto'] | int") -> None:
    movement = sample_movement()
    text = smil_svg(
        movement, duration=1.0, loop="alternate", hold=0.5, easing="linear", keyframes=keyframes
    )
    seconds, shown = (0.2, 0.75, 1.7, 2.25, 2.95), (0.0, 0.25, 1.0, 0.75, 0.05)
    shots = browser.pictures([text] * 5, seconds)
    assert_alike(browser, shots, frames_at(movement, shown))


@pytest.mark.parametrize("form", ["svg", "mjs"])
def test_chains_with_rests(browser: Browser, form: str) -> None:
    legs = sample_chain()
    options = WriteOptions(duration=1.0, hold=0.5, loop="repeat")
    seconds = (0.2, 1.0, 1.7, 2.5, 4.0)
    shown = ((0, 0.0), (0, 0.5), (0, 1.0), (1, 0.5), (2, 0.5))
    frames = [frame_svg(legs[leg].at(np.array([t]))[0]) for leg, t in shown]
    if form == "svg":
        text = smil_svg(*legs, duration=1.0, hold=0.5, loop="repeat", closed=True)
        shots = browser.pictures([text] * 5, seconds)
    else:
        shots = module_pictures(browser, module_text(Segments(legs, closed=True), options), seconds)
    assert_alike(browser, shots, frames)


@pytest.mark.parametrize("loop", ["once", "alternate"])
@pytest.mark.parametrize("pair", PAIRS, ids="-to-".join)
def test_pairs_of_the_gallery(
    browser: Browser, pair: tuple[str, str], loop: Literal["once", "alternate"]
) -> None:
    a, b = (INPUTS / f"{name}.svg" for name in pair)
    morph = st.morph(a, b)
    (movement,) = morph.movements
    # Large, and not as the page that an icon is for.
    movement = Movement(movement.parts, movement.box)
    frames = frames_at(movement, QUARTERS)
    segments, options = Segments((movement,)), WriteOptions(duration=1.0, loop=loop)
    for way in (QUARTERS, *([[2 - t for t in QUARTERS[:0:-1]]] if loop == "alternate" else [])):
        shown = frames if way == QUARTERS else frames[:0:-1]
        shots = browser.pictures([smil_svg(movement, duration=1.0, loop=loop)] * len(way), way)
        assert_alike(browser, shots, shown)
        # A module is over a little before it starts again.
        moments = [min(second, 2 - 1e-6) for second in way]
        played = module_pictures(browser, module_text(segments, options), moments)
        assert_alike(browser, played, shown)
