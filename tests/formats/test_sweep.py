"""Every format plays real pairs as their frames: all of the gallery, thirty of the corpus.

A sample of them runs always; all do where SHAPETWEEN_SWEEP is set, and how far each format was off
is written down in the file that it names.
"""

import json
import os
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, Literal

import numpy as np
import pytest

from shapetween.base.errors import OptionError
from shapetween.formats.options import WriteOptions
from shapetween.formats.table import WRITERS, Segments
from shapetween.model.movement import Movement
from shapetween.pipeline import Options, prepare
from shapetween.svg.read.reader import read_svg
from shapetween.svg.write.sequence import frame_svg
from tests.benchmarks.sizes import pairs as gallery_pairs
from tests.browser import Browser, Picture, difference
from tests.conftest import CORPUS
from tests.formats.test_android import at
from tests.formats.test_player import seek, show, stage
from tests.players import css_pictures, lottie_pictures, module_pictures, resvg_pictures

pytestmark = pytest.mark.browser

QUARTERS = (0.0, 0.25, 0.5, 0.75, 1.0)

#: And back again, in seconds, and the movement's times then.
BACK = ((1.25, 0.75), (1.5, 0.5), (1.75, 0.25), (2.0, 0.0))

#: Share of pixels that may differ by more than an edge does: a line may lie half a pixel beside its
#: place between keyframes.
STRAY = 3e-3

#: The same of Android, whose times are whole milliseconds: of a second's movement each may be half
#: a thousandth off.
STRAY_ANDROID = 6e-3

#: How many of all pairs run without being asked for: one in so many.
SAMPLED = 9

ALL = os.environ.get("SHAPETWEEN_SWEEP", "")

#: Pairs of the corpus by category, of which one in so many is taken.
CATEGORIES = {
    "articulated": 8, "emoji": 9, "holes": 4, "icons": 7, "labelled": 11, "multipart": 5,
    "silhouette": 8, "strokes": 3, "structure": 6, "styled": 4,
}  # fmt: skip


def real_pairs() -> dict[str, tuple[Path, Path]]:
    """All pairs of the sweep by name."""
    found = {f"{a.stem}-to-{b.stem}": (a, b) for a, b in gallery_pairs()}
    if (CORPUS / "pairs.json").is_file():
        listed = json.loads((CORPUS / "pairs.json").read_text("utf-8"))
        for category, stride in CATEGORIES.items():
            own = [pair for pair in listed if pair["category"] == category]
            for pair in own[::stride]:
                found[pair["id"]] = (CORPUS / pair["a"], CORPUS / pair["b"])
    return found


PAIRS = real_pairs()


def played(
    browser: Browser, lottie_web: Path, folder: Path, ending: str, loop: str, movement: Movement
) -> tuple[list[Picture], bool]:
    """What a format shows at the quarters, and back; and whether it has told of a loss."""
    seconds = [*QUARTERS, *(second for second, _ in BACK if loop == "alternate")]
    size: dict[str, Any] = {"size": (200,)} if ending == ".css" else {}
    options = WriteOptions(duration=1.0, loop=loop, **size)  # type: ignore[arg-type]
    made = WRITERS[ending].write(Segments((movement,), name="sweep"), options)
    text = str(made.content)
    # A colour that the page may choose is what it is by itself, here as there.
    told = any(not warning.startswith("the page's own colour") for warning in made.warnings)
    # What goes on for ever starts over at its end.
    before = [min(second, 2 - 1e-3) for second in seconds]
    shows: dict[str, Callable[[], Sequence[Picture]]] = {
        ".svg": lambda: browser.pictures([text] * len(seconds), before),
        ".mjs": lambda: module_pictures(browser, text, before),
        ".json": lambda: lottie_pictures(browser, lottie_web, text, [60 * s for s in before]),
        ".css": lambda: css_pictures(browser, text, "sweep", before, '<div class="sweep"></div>'),
        ".xml": lambda: resvg_pictures([at(text, 1000 * second) for second in seconds]),
        ".html": lambda: _sought(browser, text, folder, seconds),
    }
    return list(shows[ending]()), told


def _sought(browser: Browser, text: str, folder: Path, seconds: Sequence[float]) -> list[Picture]:
    """What the page shows where its slider is."""
    wrong = show(browser, text, folder)
    shots = []
    for second in seconds[: len(QUARTERS)]:
        seek(browser, second)
        shots.append(stage(browser))
    assert not wrong
    return shots


CASES = [
    pytest.param(name, marks=[] if ALL or k % SAMPLED == 0 else pytest.mark.skip("sampled"))
    for k, name in enumerate(PAIRS)
]


@pytest.mark.parametrize("name", CASES)
def test_every_format_shows_the_frames(
    browser: Browser, lottie_web: Path, tmp_path: Path, name: str
) -> None:
    read = (read_svg(place.read_bytes(), place.name) for place in PAIRS[name])
    # As large as the window, not as the page that an icon is for; and square.
    first, last = (replace(drawing, page=()) for drawing in read)
    side = max(first.box.width, first.box.height)
    first = replace(first, box=replace(first.box, width=side, height=side))
    movement = prepare(first, last, Options(folds="allow")).movement
    times = np.array([*QUARTERS, *(time for _, time in BACK)])
    frames = [frame_svg(drawing) for drawing in movement.at(times)]
    wanted = browser.pictures(frames, [0.0] * len(frames))
    drawn = resvg_pictures(frames)
    found: dict[str, float | str] = {}
    for ending in (".svg", ".mjs", ".json", ".css", ".xml", ".html"):
        loops: tuple[Literal["once", "alternate"], ...] = ("once", "alternate")
        for loop in loops[:1] if ending in (".xml", ".html") else loops:
            try:
                shots, told = played(browser, lottie_web, tmp_path, ending, loop, movement)
            except OptionError as error:
                found[f"{ending} {loop}"] = f"refused: {error}"
                continue
            targets = drawn if ending == ".xml" else wanted
            off = [difference(shot, target) for shot, target in zip(shots, targets, strict=False)]
            found[f"{ending} {loop}"] = max(off) if not told else f"told, {max(off):.4f}"
    if ALL:
        with Path(ALL).open("a", encoding="utf-8") as kept:
            kept.write(json.dumps({"pair": name, **found}) + "\n")
    worse = {
        key: off
        for key, off in found.items()
        if isinstance(off, float) and off > (STRAY_ANDROID if ".xml" in key else STRAY)
    }
    assert not worse
