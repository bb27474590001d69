"""Chromium, driven to show SVG documents at chosen moments."""

import io
import shutil
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image

Picture = NDArray[np.int16]
"""Red, green, blue of every pixel, (H, W, 3), from 0 to 255."""

ARGUMENTS = ["--no-sandbox", "--disable-gpu", "--disable-background-networking"]


#: Width and height of a picture in pixels.
SIZE = 200

#: Puts each document into a frame, so that ids and style sheets are its own, at its moment.
SHOW = """([documents, seconds]) => documents.forEach((text, k) => {
    const frame = document.createElement("iframe");
    document.body.append(frame);
    const parsed = new DOMParser().parseFromString(text, "image/svg+xml").documentElement;
    if (parsed.localName !== "svg") throw new Error("not an SVG document: " + text.slice(0, 200));
    const inside = frame.contentDocument;
    const svg = inside.importNode(parsed, true);
    inside.body.style.margin = 0;
    inside.body.append(svg);
    svg.pauseAnimations();
    svg.setCurrentTime(seconds[k]);
})"""


@contextmanager
def chromium() -> Iterator["Browser"]:
    """Start Chromium; skips the test where there is none."""
    playwright = pytest.importorskip("playwright.sync_api", reason="playwright is not installed")
    program = shutil.which("chromium") or shutil.which("google-chrome")
    if program is None:
        pytest.skip("no Chromium on this machine")
    with playwright.sync_playwright() as driver:
        browser = driver.chromium.launch(executable_path=program, args=ARGUMENTS)
        try:
            yield Browser(browser.new_page())
        finally:
            browser.close()


class Browser:
    """One page, on which SVG documents are shown side by side, each in a frame of its own."""

    def __init__(self, page: Any) -> None:
        self.page = page

    def reduce_motion(self, reduced: bool) -> None:
        """Say whether the reader has asked for less motion."""
        self.page.emulate_media(reduced_motion="reduce" if reduced else "no-preference")

    def pictures(self, documents: Sequence[str], seconds: Sequence[float]) -> list[Picture]:
        """What each of the documents shows at its moment, as (SIZE, SIZE, 3)."""
        self.page.set_viewport_size({"width": SIZE * len(documents), "height": SIZE})
        self.page.set_content(
            f"<style>body{{margin:0;display:flex}}iframe{{border:0;width:{SIZE}px;height:{SIZE}px}}"
            "</style>"
        )
        self.page.evaluate(SHOW, [list(documents), list(seconds)])
        image = Image.open(io.BytesIO(self.page.screenshot())).convert("RGB")
        return np.split(np.asarray(image, np.int16), len(documents), axis=1)


def difference(a: Picture, b: Picture) -> float:
    """Share of pixels that differ by more than an edge may, moved by a quarter of a pixel."""
    return float((np.abs(a - b).max(axis=-1) > 80).mean())
