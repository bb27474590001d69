"""Files that people reported as drawn wrong: first and last frame as Chromium draws the file."""

import re
from pathlib import Path

import pytest

import shapetween as st
from shapetween.svg.write.sequence import frame_svg
from tests.browser import Browser, difference

pytestmark = pytest.mark.browser

FILES = Path(__file__).resolve().parents[1] / "data" / "files"
NAMES = sorted(path.name.removesuffix("-a.svg") for path in FILES.glob("*-a.svg"))

#: What cannot be drawn the same, and a word of the warning that says so.
TOLD = {"figma-angular": "foreign object", "animated-input": "animated"}

#: Share of pixels that may differ.
NEAR = 0.01


def test_there_are_files() -> None:
    assert len(NAMES) > 20


def sizeless(text: str) -> str:
    """A document without the size of its page, so that it is drawn as large as its frame."""
    return re.sub(
        r"<svg[^>]*>", lambda m: re.sub(r" (?:width|height)=\S+?\"", "", m[0]), text, count=1
    )


@pytest.mark.parametrize("name", NAMES)
def test_ends_are_drawn_as_the_files_are(name: str, browser: Browser) -> None:
    files = [FILES / f"{name}-{side}.svg" for side in "ab"]
    moved = st.morph(*files)
    if name in TOLD:
        assert any(TOLD[name] in warning for warning in moved.warnings)
        return
    movement = moved.svg(duration=2.0)
    texts = [*(path.read_text() for path in files), *map(frame_svg, moved.frames(2))]
    documents = [sizeless(text) for text in (*texts, movement, movement)]
    a, b, first, last, start, end = browser.pictures(documents, [0, 0, 0, 0, 0, 2])
    assert difference(a, first) <= NEAR
    assert difference(b, last) <= NEAR
    assert difference(a, start) <= NEAR
    assert difference(b, end) <= NEAR
    if "false-alarm" in name:
        assert not any(word in w for w in moved.warnings for word in ("mask", "filter", "clip"))
