"""A module, and the page around it, keep masks, filters, blending and the page's own colour."""

from pathlib import Path

import numpy as np
import pytest

import shapetween as st
from shapetween.formats.module.writer import module
from shapetween.formats.options import WriteOptions
from shapetween.formats.table import WRITERS, Segments
from shapetween.model.movement import Movement
from shapetween.svg.read.reader import read_svg
from shapetween.svg.write.sequence import frame_svg
from tests.browser import Browser, difference
from tests.formats.test_player import seek, show, stage
from tests.movements import sample_movement
from tests.players import module_pictures

pytestmark = pytest.mark.browser

QUARTERS = (0.0, 0.25, 0.5, 0.75, 1.0)

ROOT = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100">'

SOFT = (
    '<linearGradient id="w"><stop stop-color="#fff"/><stop offset="1" stop-color="#fff" '
    'stop-opacity=".1"/></linearGradient><mask id="m"><rect x="{x}" width="60" height="100" '
    'fill="url(#w)"/></mask>'
)
BLUR = '<filter id="f"><feGaussianBlur stdDeviation="{s}"/></filter>'

#: Pairs of drawings, and where either has its own.
DRAWN = {
    "mask": (
        f'<defs>{SOFT.format(x=0)}</defs><g mask="url(#m)"><path fill="#06c" d="M5 5H70V80H5Z"/>'
        "</g>",
        f'<defs>{SOFT.format(x=30)}</defs><g mask="url(#m)"><path fill="#06c" d="M25 20H95V95H25Z"/'
        "></g>",
    ),
    "filter": (
        f'<defs>{BLUR.format(s=1)}</defs><g filter="url(#f)"><path d="M10 10H60V60H10Z"/></g>',
        f'<defs>{BLUR.format(s=6)}</defs><g filter="url(#f)"><path d="M30 40H90V90H30Z"/></g>',
    ),
    "filter-that-comes": (
        '<path fill="#a03" d="M10 10H60V60H10Z"/>',
        f'<defs>{BLUR.format(s=5)}</defs><g filter="url(#f)"><path fill="#a03" d="M30 40H90V90H30Z'
        '"/></g>',
    ),
    "mask-that-goes": (
        f'<defs>{SOFT.format(x=20)}</defs><g mask="url(#m)"><path fill="#06c" d="M5 5H70V80H5Z"/>'
        "</g>",
        '<path fill="#06c" d="M25 20H95V95H25Z"/>',
    ),
    "faded-together": (
        '<path fill="#fa0" d="M0 40H100V60H0Z"/><g opacity=".4"><path fill="#06c" '
        'd="M5 5H60V60H5Z"/><path fill="#c00" d="M40 40H90V90H40Z"/></g>',
        '<path fill="#fa0" d="M0 40H100V60H0Z"/><g opacity=".8"><path fill="#06c" '
        'd="M15 5H70V60H15Z"/><path fill="#c00" d="M30 40H80V90H30Z"/></g>',
    ),
    "multiplied": (
        '<path fill="#fa0" d="M0 40H100V60H0Z"/><path style="mix-blend-mode:multiply" '
        'fill="#06c" d="M5 5H60V60H5Z"/>',
        '<path fill="#fa0" d="M0 40H100V60H0Z"/><path style="mix-blend-mode:multiply" '
        'fill="#06c" d="M35 25H90V80H35Z"/>',
    ),
    "one-in-another": (
        f'<defs>{SOFT.format(x=0)}{BLUR.format(s=2)}</defs><g mask="url(#m)"><g filter="url(#f)">'
        '<path fill="#06c" d="M5 5H70V80H5Z"/></g><path fill="#c00" d="M10 60H40V95H10Z"/></g>',
        f'<defs>{SOFT.format(x=30)}{BLUR.format(s=3)}</defs><g mask="url(#m)"><g filter="url(#f)">'
        '<path fill="#06c" d="M25 20H95V95H25Z"/></g><path fill="#c00" d="M50 60H90V95H50Z"/></g>',
    ),
}


def moved(name: str) -> Movement:
    first, last = (read_svg(f"{ROOT}{body}</svg>".encode(), name) for body in DRAWN[name])
    (movement,) = st.morph(first, last).movements
    return movement


@pytest.mark.parametrize("name", DRAWN)
def test_groups_play_as_their_frames(browser: Browser, tmp_path: Path, name: str) -> None:
    movement = moved(name)
    made = module(Segments((movement,)), WriteOptions(duration=1.0))
    assert not made.warnings
    shots = module_pictures(browser, str(made.content), QUARTERS)
    frames = [frame_svg(drawing) for drawing in movement.at(np.array(QUARTERS))]
    wanted = browser.pictures(frames, [0.0] * 5)
    page = str(WRITERS[".html"].write(Segments((movement,)), WriteOptions()).content)
    assert not show(browser, page, tmp_path)
    for t, shot, frame in zip(QUARTERS, shots, wanted, strict=True):
        assert difference(shot, frame) <= 5e-4, f"another picture at {t}"
        assert np.abs(shot - frame).mean() < 0.6, f"other colours at {t}"
        seek(browser, t)
        assert np.abs(stage(browser) - frame).mean() < 0.6, f"another page at {t}"
    assert max(difference(wanted[0], other) for other in wanted) > 0.01


def test_what_has_no_groups_pays_nothing_for_them() -> None:
    plain = str(module(Segments((sample_movement(),)), WriteOptions()).content)
    assert "nests" not in plain
    assert "nests" in str(module(Segments((moved("mask"),)), WriteOptions()).content)


@pytest.mark.parametrize("ending", [".svg", ".mjs", ".html"])
def test_the_pages_own_colour_stays_its_own(ending: str) -> None:
    bodies = (
        f'<path fill="currentColor" d="M5 5H{x}V40H5Z"/><path fill="none" stroke="var(--line, red)"'
        f' stroke-width="4" d="M5 80H{x}"/>'
        for x in (40, 90)
    )
    first, last = (read_svg(f"{ROOT}{body}</svg>".encode(), "a") for body in bodies)
    segments = Segments(st.morph(first, last).movements)
    text = str(WRITERS[ending].write(segments, WriteOptions()).content)
    assert "currentColor" in text
    assert "var(--line" in text
