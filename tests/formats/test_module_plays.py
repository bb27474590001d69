"""The JavaScript module's player in a real browser."""

from collections.abc import Sequence

import numpy as np
import pytest

from shapetween.formats.module.writer import module_text
from shapetween.formats.options import WriteOptions
from shapetween.formats.table import Segments
from shapetween.model.movement import Movement
from shapetween.model.paint import Style
from shapetween.svg.write.sequence import frame_svg
from tests.browser import Browser, Picture, difference
from tests.movements import sample_chain, sample_movement
from tests.paints import EVERY, OVALS
from tests.players import boxes, module_pictures

pytestmark = pytest.mark.browser

QUARTERS = (0.0, 0.25, 0.5, 0.75, 1.0)

#: Share of pixels that may differ by more than an edge does; tiles of a browser meet in some.
STRAY = 3e-4


def assert_alike(browser: Browser, shots: Sequence[Picture], frames: Sequence[str]) -> None:
    wanted = browser.pictures(frames, [0.0] * len(frames))
    for shot, frame in zip(shots, wanted, strict=True):
        assert difference(shot, frame) <= STRAY
        assert np.abs(shot - frame).mean() < 0.4
    assert max(difference(wanted[0], other) for other in wanted) > 10 * STRAY


def frames_at(movement: Movement, times: Sequence[float]) -> list[str]:
    return [frame_svg(drawing) for drawing in movement.at(np.array(times, float))]


@pytest.mark.parametrize(("first", "last"), EVERY + OVALS)
def test_paint_plays_as_the_frames_show_it(browser: Browser, first: Style, last: Style) -> None:
    movement = sample_movement(first, last)
    text = module_text(Segments((movement,)), WriteOptions(duration=1.0))
    shots = module_pictures(browser, text, QUARTERS)
    assert_alike(browser, shots, frames_at(movement, QUARTERS))


@pytest.mark.parametrize(
    ("loop", "seconds", "shown"),
    [
        ("once", (0, 0.4, 1.4, 2.4, 9), (0, 0, 0.5, 1, 1)),
        ("repeat", (0, 0.4, 1.4, 2.5, 2.9), (0, 0, 0.5, 1, 0)),
        ("alternate", (0.2, 1.4, 2.6, 3.8, 4.9, 6.2), (0, 0.5, 1, 0.5, 0, 0.5)),
    ],
)
def test_loops_and_rests(
    browser: Browser, loop: str, seconds: tuple[float, ...], shown: tuple[float, ...]
) -> None:
    movement = sample_movement()
    options = {"duration": 2000, "hold": 400, "loop": loop}
    text = module_text(Segments((movement,)), WriteOptions())
    shots = module_pictures(browser, text, seconds, options)
    assert_alike(browser, shots, frames_at(movement, shown))


def test_an_easing_is_that_of_each_way(browser: Browser) -> None:
    movement = sample_movement()
    options = WriteOptions(duration=1.0, easing="cubic-bezier(0,0.5,0.5,1)", loop="alternate")
    text = module_text(Segments((movement,)), options)
    shots = module_pictures(browser, text, (0.5, 1.5))
    from shapetween.timing.easing import easing_function

    time = float(easing_function(options.easing)(np.array([0.5]))[0])
    wanted = browser.pictures(frames_at(movement, (time, time)), [0.0, 0.0])
    for shot, frame in zip(shots, wanted, strict=True):
        assert difference(shot, frame) <= STRAY


def test_chains_and_their_rests(browser: Browser) -> None:
    legs = sample_chain()
    options = WriteOptions(duration=1.0, hold=0.5, loop="repeat")
    text = module_text(Segments(legs, closed=True), options)
    seconds = (0.2, 1.0, 1.7, 2.5, 4.0, 4.8)
    shown = ((0, 0.0), (0, 0.5), (0, 1.0), (1, 0.5), (2, 0.5), (0, 0.0))
    frames = [frame_svg(legs[leg].at(np.array([t]))[0]) for leg, t in shown]
    assert_alike(browser, module_pictures(browser, text, seconds), frames)


def test_the_animation_is_the_browsers_own(browser: Browser) -> None:
    text = module_text(Segments((sample_movement(),)), WriteOptions(duration=0.4))
    boxes(browser, 1)
    told = browser.page.evaluate(
        """async text => {
            const url = URL.createObjectURL(new Blob([text], { type: "text/javascript" }));
            const { play, default: d } = await import(url);
            const box = document.querySelector(".box");
            const shape = () => box.querySelectorAll("path")[1].getAttribute("d");
            const animation = play(box);
            await animation.finished;
            await new Promise(requestAnimationFrame);
            await new Promise(requestAnimationFrame);
            const end = shape() == d(1, 1);
            animation.reverse();
            await new Promise(done => setTimeout(done, 150));
            const half = shape() != d(1, 1) && shape() != d(0, 1);
            animation.reverse();
            await animation.finished;
            await new Promise(requestAnimationFrame);
            await new Promise(requestAnimationFrame);
            return [animation instanceof Animation, end, half, shape() == d(1, 1)];
        }""",
        text,
    )
    assert told == [True, True, True, True]


def test_less_motion_is_the_end_at_once(browser: Browser) -> None:
    movement = sample_movement()
    text = module_text(Segments((movement,)), WriteOptions())
    boxes(browser, 1)
    browser.reduce_motion(True)
    try:
        state = browser.page.evaluate(
            """async text => {
                const url = URL.createObjectURL(new Blob([text], { type: "text/javascript" }));
                const { play } = await import(url);
                return play(document.querySelector(".box")).playState;
            }""",
            text,
        )
    finally:
        browser.reduce_motion(False)
    assert state == "finished"
