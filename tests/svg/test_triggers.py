"""Files that wait for a click or a pointer and go back again, in a browser, without a script."""

import numpy as np
import pytest

from shapetween.base.errors import OptionError
from shapetween.svg.write.sequence import frame_svg
from shapetween.svg.write.smil import smil_svg
from shapetween.timing.timeline import Loop
from tests.browser import SIZE, Browser, Picture, difference
from tests.movements import sample_chain, sample_movement

pytestmark = pytest.mark.browser

SHOW = """(text) => {
    document.body.innerHTML = text;
    document.body.style.margin = 0;
    document.querySelector("svg").style.display = "block";
}"""


def shown(browser: Browser) -> Picture:
    import io

    from PIL import Image

    return np.asarray(Image.open(io.BytesIO(browser.page.screenshot())).convert("RGB"), np.int16)


def open_page(browser: Browser, text: str) -> None:
    browser.page.set_viewport_size({"width": SIZE, "height": SIZE})
    browser.page.set_content("<body></body>")
    browser.page.mouse.move(-5, -5)
    browser.page.evaluate(SHOW, text)


def assert_shows(browser: Browser, frame: str) -> None:
    played = shown(browser)
    (still,) = browser.pictures([frame], [0.0])
    assert difference(played, still) <= 2e-4


@pytest.mark.parametrize("chained", [False, True])
def test_a_click_sets_it_going_and_the_next_one_brings_it_back(
    browser: Browser, chained: bool
) -> None:
    legs = sample_chain() if chained else (sample_movement(),)
    first = frame_svg(legs[0].at(np.zeros(1))[0])
    last = frame_svg(legs[-1].at(np.ones(1))[0])
    text = smil_svg(*legs, duration=0.2, start="click")
    expected = [first, last, first, last]
    for clicks, frame in enumerate(expected):
        open_page(browser, text)
        browser.page.wait_for_timeout(150)
        for _ in range(clicks):
            browser.page.mouse.click(SIZE // 2, SIZE // 2)
            browser.page.wait_for_timeout(1000)
        assert_shows(browser, frame)


def test_clicks_in_mid_way_cut_nothing_short(browser: Browser) -> None:
    movement = sample_movement()
    open_page(browser, smil_svg(movement, duration=0.6, start="click"))
    for _ in range(3):
        browser.page.mouse.click(SIZE // 2, SIZE // 2)
        browser.page.wait_for_timeout(60)
    browser.page.wait_for_timeout(1000)
    assert_shows(browser, frame_svg(movement.at(np.ones(1))[0]))


def test_a_pointer_over_it_sets_it_going_and_leaving_brings_it_back(browser: Browser) -> None:
    movement = sample_movement()
    first, last = (frame_svg(drawing) for drawing in movement.at(np.array([0.0, 1.0])))
    text = smil_svg(movement, duration=0.2, start="hover")
    for leaves, frame in ((False, last), (True, first)):
        open_page(browser, text)
        browser.page.mouse.move(SIZE // 2, SIZE // 2)
        browser.page.wait_for_timeout(700)
        browser.page.mouse.move(SIZE // 2 + 3, SIZE // 2)
        if leaves:
            browser.page.set_viewport_size({"width": 2 * SIZE, "height": SIZE})
            browser.page.evaluate(f'document.querySelector("svg").style.width = "{SIZE}px"')
            browser.page.mouse.move(SIZE + 50, SIZE // 2)
            browser.page.wait_for_timeout(700)
            browser.page.set_viewport_size({"width": SIZE, "height": SIZE})
        assert_shows(browser, frame)


@pytest.mark.parametrize("loop", ["repeat", "alternate"])
def test_what_is_played_for_ever_ends_with_the_next_click(browser: Browser, loop: Loop) -> None:
    movement = sample_movement()
    first = frame_svg(movement.at(np.zeros(1))[0])
    open_page(browser, smil_svg(movement, duration=0.3, loop=loop, start="click"))
    browser.page.mouse.click(SIZE // 2, SIZE // 2)
    browser.page.wait_for_timeout(130)
    going = shown(browser)
    browser.page.mouse.click(SIZE // 2, SIZE // 2)
    browser.page.wait_for_timeout(300)
    stopped = shown(browser)
    assert difference(going, stopped) > 0.01
    (still,) = browser.pictures([first], [0.0])
    assert difference(stopped, still) <= 2e-4


def test_what_needs_a_script_is_refused() -> None:
    with pytest.raises(OptionError, match=r"start 'seen': an SVG has no script .* \.mjs"):
        smil_svg(sample_movement(), start="seen")
