"""The page of a batch shows every pair, sifts them, and plays what is seen."""

from pathlib import Path
from typing import Any

import pytest

from shapetween.batch.page import page_html
from tests.browser import chromium

DRAWING = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9"><path d="M1 1h7v7z"/></svg>'


def entry(name: str, *confidences: str, warnings: tuple[str, ...] = ()) -> dict[str, Any]:
    rings = [{"matching": {"confidence": confidence}} for confidence in confidences]
    return {
        "a": f"in/{name}.svg",
        "b": "in/b.svg",
        "out": f"{name} 1.svg",
        "status": "done",
        "error": "",
        "report": {"rings": rings, "warnings": list(warnings)},
    }


FAILED = {"a": "in/<c>.svg", "b": "in/b.svg", "out": "c.svg", "status": "failed", "error": "a & b"}

ENTRIES = [
    entry("ant", "sure", "unsure", warnings=("<lost>", "two")),
    entry("bee", "sure", "sure"),
    entry("cow"),
    FAILED,
]


def test_what_it_tells_is_text() -> None:
    text = page_html(ENTRIES, "a < b")
    assert "<h1>a &lt; b</h1><p>4 pairs, of which 1 failed</p>" in text
    assert "&lt;c&gt; to b" in text
    assert "a &amp; b" in text
    assert "<li>&lt;lost&gt;</li>" in text
    assert 'data-src="ant%201.svg"' in text


def test_a_pair_is_as_sure_as_its_least_sure_ring() -> None:
    text = page_html(ENTRIES, "all")
    assert text.count('<article class="unsure">') == 1
    assert text.count('<article class="sure">') == 1
    assert text.count('<article class="">') == 1
    assert '<option value="likely">' not in text


@pytest.mark.browser
def test_it_sifts_and_plays_what_is_seen(tmp_path: Path) -> None:
    many = [entry(f"dog {k}", "likely") for k in range(60)]
    (tmp_path / "index.html").write_text(page_html([*ENTRIES, *many], "all"), "utf-8")
    for made in (*ENTRIES, *many):
        (tmp_path / str(made["out"])).write_text(DRAWING, "utf-8")
    with chromium() as browser:
        page = browser.page
        wrong: list[str] = []
        page.on("pageerror", lambda error: wrong.append(str(error)))
        page.set_viewport_size({"width": 700, "height": 600})
        page.goto((tmp_path / "index.html").as_uri())
        page.wait_for_function("document.querySelector('img').naturalWidth > 0", timeout=10_000)
        playing = "document.querySelectorAll('img[src]').length"
        assert 0 < page.evaluate(playing) < 30

        def shown() -> str:
            return str(page.locator("output").inner_text())

        assert shown() == "64 of 64"
        page.locator("input[type=search]").fill("to DOG")
        assert shown() == "60 of 64"
        page.locator("input[type=search]").fill("")
        page.locator("select").select_option("sure")
        assert shown() == "1 of 64"
        page.locator("select").select_option("")
        page.locator("input[type=checkbox]").check()
        assert shown() == "2 of 64"
        page.locator("input[type=checkbox]").uncheck()
        page.evaluate("scrollTo(0, 1e6)")
        gone = "!document.querySelector('img').hasAttribute('src')"
        page.wait_for_function(gone, timeout=10_000)
        page.set_viewport_size({"width": 360, "height": 600})
        assert page.evaluate("document.documentElement.scrollWidth") <= 360
        assert not wrong
