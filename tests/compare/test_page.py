"""The page of a comparison, as text and in a real browser."""

import re
import xml.etree.ElementTree as ET
from collections.abc import Iterator
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import pytest

from shapetween.compare import Comparison
from shapetween.compare.measures import TIMES
from tests.browser import Browser, chromium
from tests.smil import SVG

VOID = {"meta", "input", "img", "br", "link"}


class Checker(HTMLParser):
    """Collects ids and links, and sees that elements close in order."""

    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []
        self.ids: list[str] = []
        self.links: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        if tag not in VOID:
            self.open.append(tag)
        self._read(attrs)

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self._read(attrs)

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag

    def _read(self, attrs: list[tuple[str, str | None]]) -> None:
        for name, value in attrs:
            if name == "id":
                self.ids.append(value or "")
            if name in ("src", "href", "xlink:href"):
                self.links.append(value or "")


@pytest.fixture(scope="module")
def page(tools: Comparison) -> str:
    return tools.html()


def test_a_page_is_sound_and_needs_nothing_else(page: str) -> None:
    checker = Checker()
    checker.feed(page)
    assert checker.open == []
    assert len(checker.ids) == len(set(checker.ids))
    assert all(link.startswith(("data:", "#")) for link in checker.links)
    assert not re.search(r"https?://(?!www\.w3\.org/)", page)


def test_the_same_comparison_is_the_same_page(tools: Comparison, page: str) -> None:
    assert tools.html() == page


def test_every_method_has_a_panel_a_strip_and_a_row(tools: Comparison, page: str) -> None:
    count = len(tools.variants)
    assert page.count('<figure class="panel') == count
    assert page.count('<div class="strip') == count
    assert page.count('<tr><th scope="row"') == count
    # Three plots with a line each, one with a row of stripes each.
    assert page.count('<polyline class="line') == 3 * count


def test_names_of_files_cannot_break_the_page(tools: Comparison) -> None:
    nasty = Comparison(
        ("</title><script>alert(1)</script>", "b&c"), tools.morph, tools.variants, tools.figures
    )
    page = nasty.html()
    assert "<script>alert" not in page
    assert "b&amp;c" in page


def test_side_by_side_holds_every_method_once(tools: Comparison) -> None:
    text = tools.svg(duration=3.0)
    moving = [path for path in ET.fromstring(text).iter(f"{SVG}path") if len(path)]
    assert len(moving) == len(tools.variants)
    assert text.count('dur="6s"') == text.count("<animate ")
    for variant in tools.variants:
        assert f">{variant.title}</text>" in text


class Opened:
    """The page in a browser, from a file, with whatever it said."""

    def __init__(self, browser: Browser, path: Path) -> None:
        self.page = browser.page
        self.said: list[str] = []
        self.asked: list[str] = []
        self.page.on("console", lambda message: self.said.append(message.text))
        self.page.on("pageerror", lambda error: self.said.append(str(error)))
        self.page.on("request", lambda request: self.asked.append(request.url))
        self.page.goto(path.as_uri())

    def times(self) -> list[float]:
        """What time every animation shows."""
        found: list[float] = self.page.evaluate(
            "[...document.querySelectorAll('.panel svg')].map((svg) => svg.getCurrentTime())"
        )
        return found

    def value(self, script: str) -> Any:
        return self.page.evaluate(script)


@pytest.fixture(scope="module")
def opened(page: str, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Opened]:
    path = tmp_path_factory.mktemp("page") / "tools.html"
    path.write_text(page, "utf-8")
    with chromium() as browser:
        yield Opened(browser, path)


@pytest.mark.browser
def test_it_plays_at_once_in_step(opened: Opened) -> None:
    opened.page.wait_for_function("document.getElementById('time').value > 0.05")
    opened.page.keyboard.press("k")
    times = opened.times()
    assert max(times) - min(times) < 1e-6
    assert times[0] > 0


@pytest.mark.browser
@pytest.mark.parametrize("t", [0.0, 0.25, 0.7, 1.0])
def test_the_slider_moves_everything(opened: Opened, tools: Comparison, t: float) -> None:
    opened.page.locator("#time").fill(str(t))
    assert opened.times() == pytest.approx([t] * len(tools.variants), abs=1e-5)
    assert opened.value("document.getElementById('clock').textContent") == f"{t:.2f}"
    shift = opened.value("document.querySelector('.cursor').transform.baseVal[0].matrix.e")
    width = opened.value(
        "(({left, right}) => right - left)(document.querySelector('.plot').dataset)"
    )
    assert shift == pytest.approx(t * width)
    area = tools.figures["linear"].area[round(t * (len(TIMES) - 1))]
    now = opened.value("document.querySelector('[data-key=linear] .now').textContent")
    # The page rounds what was rounded for it.
    assert float(now.removeprefix("area ").split(" %")[0]) == pytest.approx(100 * area, abs=0.6)


@pytest.mark.browser
def test_keys(opened: Opened) -> None:
    press = opened.page.keyboard.press
    opened.page.locator("h1").click()
    press("Home")
    press("ArrowRight")
    assert opened.times()[0] == pytest.approx(1 / 60, abs=1e-5)
    press("Shift+ArrowRight")
    assert opened.times()[0] == pytest.approx(7 / 60, abs=1e-5)
    press("End")
    press("ArrowLeft")
    assert opened.times()[0] == pytest.approx(59 / 60, abs=1e-5)
    press("m")
    assert opened.value("getComputedStyle(document.querySelector('g.mesh')).display") == "inline"
    press(" ")
    assert opened.value("document.getElementById('play').ariaLabel") == "Pause"
    press(" ")
    assert opened.value("document.getElementById('play').ariaLabel") == "Play"


@pytest.mark.browser
@pytest.mark.parametrize("width", [320, 700, 1400])
@pytest.mark.parametrize("theme", ["light", "dark"])
def test_nothing_sticks_out_and_all_is_quiet(opened: Opened, width: int, theme: str) -> None:
    opened.page.set_viewport_size({"width": width, "height": 800})
    opened.page.emulate_media(color_scheme=theme)
    assert opened.value("document.documentElement.scrollWidth") <= width
    light = opened.value("parseInt(getComputedStyle(document.body).backgroundColor.slice(4)) > 128")
    assert light == (theme == "light")
    assert opened.said == []
    assert all(url.startswith(("file:", "data:")) for url in opened.asked)
