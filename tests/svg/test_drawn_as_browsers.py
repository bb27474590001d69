"""Small files in the manner of drawing programs, each read and drawn as Chromium draws it.

The files are ours. Blending, masks, clips, style, filters, strokes, markers, text, the page.
"""

import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest

from shapetween.io.fonts import fonts_in
from shapetween.model.drawing import Drawing
from shapetween.svg.read.reader import read_svg
from shapetween.svg.write.sequence import frame_svg
from tests.browser import Browser, chromium, difference

pytestmark = pytest.mark.browser

FILES = Path(__file__).resolve().parents[1] / "data" / "drawn"
NAMES = sorted(path.stem for path in FILES.glob("*.svg"))

#: What is not drawn the same, and a word of the warning that says so.
TOLD = {
    "css-offset": "offset-path",
    "css-prop2": "@property",
    "css-scope": "@scope",
    "mask-css-image": "draw it as a mask element",
    "mask-linear": "linearRGB",
    "pat-2": "pattern",
}

#: Share of pixels that may differ.
NEAR = 0.01

#: Files shown at once.
TOGETHER = 6


@pytest.fixture(scope="module")
def browser() -> Iterator[Browser]:
    with chromium() as found:
        yield found


@cache
def drawn(name: str) -> Drawing:
    data = (FILES / f"{name}.svg").read_bytes()
    return read_svg(data, name, fonts=fonts_in(None))


def test_there_are_files() -> None:
    assert len(NAMES) > 180


@pytest.mark.parametrize("start", range(0, len(NAMES), TOGETHER))
def test_files_are_drawn_as_browsers_do(start: int, browser: Browser) -> None:
    names = [name for name in NAMES[start : start + TOGETHER] if name not in TOLD]
    documents = [
        text
        for name in names
        for text in ((FILES / f"{name}.svg").read_text("utf-8"), frame_svg(drawn(name)))
    ]
    pictures = browser.pictures(documents, [0] * len(documents))
    off = {
        name: difference(one, other)
        for name, one, other in zip(names, pictures[::2], pictures[1::2], strict=True)
    }
    assert {name: share for name, share in off.items() if share > NEAR} == {}


@pytest.mark.parametrize("name", TOLD)
def test_what_is_not_carried_is_told(name: str) -> None:
    assert any(re.search(TOLD[name], warning) for warning in drawn(name).warnings)
