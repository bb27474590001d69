"""The page plays by itself, and does what its controls say."""

import io
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from shapetween.formats.options import WriteOptions
from shapetween.formats.player.writer import html
from shapetween.formats.table import Segments
from shapetween.model.movement import Movement
from shapetween.svg.write.sequence import frame_svg
from tests.browser import SIZE, Browser, Picture, difference
from tests.movements import sample_chain, sample_movement

#: The page's stage alone, as large as the pictures that it is held against.
ALONE = "#stage{width:200px!important;border:0!important;border-radius:0!important}"


def written(*movements: Movement, warnings: tuple[str, ...] = (), **options: Any) -> str:
    segments = Segments(movements or (sample_movement(),), name="one", warnings=warnings)
    made = html(segments, WriteOptions(**options))
    assert isinstance(made.content, str)
    return made.content


def test_it_fetches_nothing() -> None:
    text = written()
    assert "http://www.w3.org/2000/svg" in text
    assert text.count("http") == 1
    assert " src=" not in text
    assert "import" not in text.split("<script")[1].replace("important", "")


def test_what_it_tells_is_text() -> None:
    text = written(warnings=("<b> & </script>\n two",))
    assert "<li>&lt;b&gt; &amp; &lt;/script&gt; two</li>" in text
    assert text.count("</script>") == 1
    assert "<h1>Ring &amp; ellipse</h1>" in text


def show(browser: Browser, text: str, folder: Path) -> list[str]:
    """Open the page; what goes wrong in it is put into the list."""
    (folder / "page.html").write_text(text, "utf-8")
    page = browser.page
    wrong: list[str] = []
    page.on("pageerror", lambda error: wrong.append(str(error)))
    page.set_viewport_size({"width": 700, "height": 900})
    page.goto((folder / "page.html").as_uri())
    page.add_style_tag(content=ALONE)
    return wrong


def stage(browser: Browser) -> Picture:
    browser.page.wait_for_timeout(60)
    data = browser.page.locator("#stage").screenshot()
    image = Image.open(io.BytesIO(data)).convert("RGB")
    assert image.size == (SIZE, SIZE)
    return np.asarray(image, np.int16)


def seek(browser: Browser, share: float) -> None:
    browser.page.evaluate(
        """share => {
            const seek = document.getElementById("seek");
            seek.value = share;
            seek.dispatchEvent(new Event("input"));
        }""",
        share,
    )


@pytest.mark.browser
@pytest.mark.parametrize("loop", ["once", "repeat", "alternate"])
def test_its_time_is_moved_by_hand(browser: Browser, tmp_path: Path, loop: str) -> None:
    movement = sample_movement()
    wrong = show(browser, written(movement, loop=loop), tmp_path)
    shares = (0.0, 0.5, 0.75, 1.0)
    frames = [frame_svg(drawing) for drawing in movement.at(np.array(shares))]
    shots = []
    for share in shares:
        seek(browser, share)
        shots.append(stage(browser))
    for shot, frame in zip(shots, browser.pictures(frames, [0.0] * 4), strict=True):
        assert difference(shot, frame) <= 3e-4
    assert not wrong


@pytest.mark.browser
def test_its_controls_do_what_they_say(browser: Browser, tmp_path: Path) -> None:
    wrong = show(browser, written(*sample_chain(), duration=0.3), tmp_path)
    page = browser.page
    page.wait_for_function("document.getElementById('seek').value == 1", timeout=10_000)
    assert page.locator("#play").inner_text() == "Play"
    end = stage(browser)
    page.locator(".drawings button").nth(1).click()
    second = stage(browser)
    assert difference(end, second) > 0.01
    assert float(page.locator("#seek").input_value()) == pytest.approx(1 / 3, abs=1e-3)
    page.keyboard.press("ArrowRight")
    assert difference(second, stage(browser)) > 0
    page.locator("#loop").select_option("alternate")
    page.locator("#speed").select_option("0.25")
    page.locator("#play").click()
    page.wait_for_function("document.getElementById('play').textContent == 'Pause'")
    page.locator("#paper").select_option("#000")
    page.wait_for_timeout(60)
    assert (
        page.locator("#stage").evaluate("e => getComputedStyle(e).backgroundColor")
        == "rgb(0, 0, 0)"
    )
    before = page.evaluate("getComputedStyle(document.body).backgroundColor")
    page.locator("#theme").click()
    assert page.evaluate("getComputedStyle(document.body).backgroundColor") != before
    assert not wrong


@pytest.mark.browser
def test_it_fits_a_phone(browser: Browser, tmp_path: Path) -> None:
    wrong = show(browser, written(*sample_chain()), tmp_path)
    browser.page.set_viewport_size({"width": 360, "height": 700})
    wide = browser.page.evaluate("document.documentElement.scrollWidth")
    assert wide <= 360
    assert not wrong
