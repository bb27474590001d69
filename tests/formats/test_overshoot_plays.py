"""Springs and what else runs past the end do so in every player, as far as the frames do."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from shapetween.formats.options import WriteOptions
from shapetween.formats.table import WRITERS, Segments
from shapetween.model.drawing import Box
from shapetween.model.movement import Movement
from shapetween.model.paint import Colour, Style
from shapetween.svg.write.sequence import frame_svg
from shapetween.timing.easing import easing_function
from tests.browser import Browser, Picture, difference
from tests.formats.test_android import at
from tests.formats.test_player import seek, show, stage
from tests.movements import ellipse, formula_part, spin
from tests.players import (
    css_pictures,
    lottie_pictures,
    module_pictures,
    resvg_pictures,
    thorvg_pictures,
)

pytestmark = pytest.mark.browser

EASINGS = {
    "spring": "spring(1,100,6)",
    "back": "cubic-bezier(.5,-.6,.4,1.7)",
    "pieces": "linear(0, 1.3 40%, .8 70%, 1)",
}

#: Share of pixels that may differ by more than an edge does.
STRAY = 1e-3


def moved() -> Movement:
    """An ellipse that turns by a third and goes aside: past its end it is still in the picture."""
    red = Style(Colour(0.8, 0.0, 0.0))
    part = formula_part(ellipse((35.0, 50.0), (22.0, 9.0)), spin(1 / 3, (25.0, 0.0)), red, red)
    return Movement((part,), Box(0, 0, 100, 100))


def farthest(easing: str) -> list[float]:
    """When an easing is farthest past its end, and back before it; and both ends."""
    clock = np.linspace(0, 1, 1001)
    times = easing_function(easing)(clock)
    peak = int(times.argmax())
    assert times[peak] > 1.05
    low = int(times.argmin()) if times.min() < 0 else peak + int(times[peak:].argmin())
    assert times[low] < 0 or times[low] < times[-1] - 0.01
    return [0.0, *sorted(clock[[low, peak]].tolist()), 1.0]


def svg(browser: Browser, text: str, folder: Path, seconds: list[float]) -> list[Picture]:
    del folder
    return list(browser.pictures([text] * len(seconds), seconds))


def module(browser: Browser, text: str, folder: Path, seconds: list[float]) -> list[Picture]:
    del folder
    return list(module_pictures(browser, text, seconds))


def sheet(browser: Browser, text: str, folder: Path, seconds: list[float]) -> list[Picture]:
    del folder
    return list(css_pictures(browser, text, "morph", seconds, '<div class="morph"></div>'))


def page(browser: Browser, text: str, folder: Path, seconds: list[float]) -> list[Picture]:
    wrong = show(browser, text, folder)
    shots = []
    for second in seconds:
        seek(browser, second)
        shots.append(stage(browser))
    assert not wrong
    return shots


def android(browser: Browser, text: str, folder: Path, seconds: list[float]) -> list[Picture]:
    del browser, folder
    return list(resvg_pictures([at(text, 1000 * second) for second in seconds]))


PLAYERS: dict[str, Callable[[Browser, str, Path, list[float]], list[Picture]]] = {
    ".svg": svg, ".mjs": module, ".css": sheet, ".html": page, ".xml": android
}  # fmt: skip


def written(ending: str, easing: str, **options: Any) -> str:
    size: dict[str, Any] = {"size": (200,)} if ending == ".css" else {}
    chosen = WriteOptions(duration=1.0, easing=easing, **options, **size)
    made = WRITERS[ending].write(Segments((moved(),), name="morph"), chosen)
    assert not made.warnings
    return str(made.content)


def frames(easing: str, shares: list[float]) -> list[str]:
    times = easing_function(easing)(np.array(shares))
    return [frame_svg(drawing) for drawing in moved().at(times)]


def assert_alike(shots: list[Picture], wanted: list[Picture]) -> None:
    for shot, frame in zip(shots, wanted, strict=True):
        assert difference(shot, frame) <= STRAY
    # At the end it is elsewhere than past it.
    assert min(difference(wanted[-1], frame) for frame in wanted[1:-1]) > 4 * STRAY


@pytest.mark.parametrize("easing", EASINGS.values(), ids=EASINGS)
@pytest.mark.parametrize("ending", PLAYERS)
def test_players_run_past_the_end(
    browser: Browser, tmp_path: Path, ending: str, easing: str
) -> None:
    shares = farthest(easing)
    shots = PLAYERS[ending](browser, written(ending, easing), tmp_path, shares)
    wanted = frames(easing, shares)
    drawn = resvg_pictures(wanted) if ending == ".xml" else browser.pictures(wanted, [0.0] * 4)
    assert_alike(shots, list(drawn))


@pytest.mark.parametrize("ending", [".svg", ".mjs"])
def test_the_way_back_runs_past_the_start(browser: Browser, tmp_path: Path, ending: str) -> None:
    easing = EASINGS["spring"]
    shares = farthest(easing)[1:]
    text = written(ending, easing, loop="alternate")
    shots = PLAYERS[ending](browser, text, tmp_path, [2 - share for share in shares])
    wanted = browser.pictures(frames(easing, shares), [0.0] * len(shares))
    for shot, frame in zip(shots, wanted, strict=True):
        assert difference(shot, frame) <= STRAY


@pytest.mark.parametrize("easing", EASINGS.values(), ids=EASINGS)
def test_lottie_players_run_past_the_end(browser: Browser, lottie_web: Path, easing: str) -> None:
    text = written(".json", easing)
    # ThorVG shows whole frames.
    shares = [round(60 * share) / 60 for share in farthest(easing)]
    numbers = [60 * share for share in shares]
    assert json.loads(text)["op"] == 61
    wanted = browser.pictures(frames(easing, shares), [0.0] * 4)
    assert_alike(lottie_pictures(browser, lottie_web, text, numbers), wanted)
    assert_alike(thorvg_pictures(text.encode(), numbers), wanted)


def test_what_play_is_told_runs_past_the_end_of_a_leg_too(browser: Browser) -> None:
    """In a chain it stays in its leg; before, the next one began for a moment."""
    first = moved()
    other = Style(Colour(0.0, 0.0, 0.8))
    part = formula_part(ellipse((50.0, 50.0), (30.0, 30.0)), spin(0.2), other, other)
    legs = first, Movement((part,), first.box)
    text = str(WRITERS[".mjs"].write(Segments(legs), WriteOptions(duration=1.0)).content)
    shares = farthest(EASINGS["back"])[1:3]
    shots = module_pictures(browser, text, shares, {"easing": EASINGS["back"]})
    wanted = browser.pictures(frames(EASINGS["back"], shares), [0.0] * 2)
    for shot, frame in zip(shots, wanted, strict=True):
        assert difference(shot, frame) <= 10 * STRAY  # straight on past the end
