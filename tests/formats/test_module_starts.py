"""What sets a module's movement going."""

import pytest

from shapetween.formats.module.writer import module_text
from shapetween.formats.options import STARTS, WriteOptions
from shapetween.formats.table import Segments
from tests.browser import Browser
from tests.movements import sample_movement

pytestmark = pytest.mark.browser

#: Shows the module in a box 1,000 px below the top of a long page.
SHOW = """async text => {
    const url = URL.createObjectURL(new Blob([text], { type: "text/javascript" }));
    const { play } = await import(url);
    window.animation = play("#box");
}"""

PAGE = "<body style='margin:0;height:3000px'><div id=box style='width:200px;height:200px;{}'></div>"


def show(browser: Browser, start: str, style: str = "") -> None:
    text = module_text(
        Segments((sample_movement(),)),
        WriteOptions(duration=0.5, start=start),  # type: ignore[arg-type]
    )
    browser.page.set_viewport_size({"width": 400, "height": 400})
    browser.page.mouse.move(300, 300)
    browser.page.set_content(PAGE.format(style))
    browser.page.evaluate("scrollTo(0, 0)")
    browser.page.evaluate(SHOW, text)


PROGRESS = "animation.effect.getComputedTiming().progress"


def state(browser: Browser) -> tuple[str, float]:
    browser.page.wait_for_timeout(100)
    told = browser.page.evaluate(f"[animation.playState, {PROGRESS}]")
    return told[0], told[1]


def assert_runs_to(browser: Browser, end: int) -> None:
    """Wait until the movement has run to an end and stopped there."""
    there = f"animation.playState == 'finished' && {PROGRESS} == {end}"
    browser.page.wait_for_function(there, timeout=10_000)


def assert_comes_to(browser: Browser, progress: float) -> None:
    near = f"Math.abs({PROGRESS} - {progress}) < 1e-6"
    browser.page.wait_for_function(near, timeout=10_000)


@pytest.mark.parametrize("start", STARTS[1:])
def test_nothing_moves_before_its_time(browser: Browser, start: str) -> None:
    show(browser, start, "position:absolute;top:1000px")
    assert state(browser) == ("paused", 0)


def test_a_click_starts_and_the_next_goes_back(browser: Browser) -> None:
    show(browser, "click")
    browser.page.mouse.click(100, 100)
    assert_runs_to(browser, 1)
    browser.page.mouse.click(100, 100)
    assert_runs_to(browser, 0)
    browser.page.mouse.click(100, 100)
    assert_runs_to(browser, 1)


def test_a_pointer_starts_and_leaving_goes_back(browser: Browser) -> None:
    show(browser, "hover")
    browser.page.mouse.move(100, 100)
    assert_runs_to(browser, 1)
    browser.page.mouse.move(300, 300)
    assert_runs_to(browser, 0)


def test_being_seen_starts(browser: Browser) -> None:
    show(browser, "seen", "position:absolute;top:1000px")
    browser.page.mouse.wheel(0, 900)
    assert_runs_to(browser, 1)


def test_scrolling_moves(browser: Browser) -> None:
    show(browser, "scroll", "position:absolute;top:1000px")
    browser.page.evaluate(
        "scrollTo(0, 900)"
    )  # its top is at 100 of 400, on its way from 400 to -200
    assert_comes_to(browser, 0.5)
    browser.page.evaluate("scrollTo(0, 2000)")
    assert_comes_to(browser, 1)


def test_dragging_moves(browser: Browser) -> None:
    show(browser, "drag")
    browser.page.mouse.move(20, 100)
    browser.page.mouse.down()
    browser.page.mouse.move(150, 100)
    assert_comes_to(browser, 0.75)
    browser.page.mouse.move(300, 100)
    assert_comes_to(browser, 1)
    browser.page.mouse.up()
    browser.page.mouse.move(20, 100)
    assert state(browser) == ("paused", 1)
