"""What a browser plays of whole drawings, against the frames of the same moments."""

import json
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from shapetween.model.drawing import Drawing
from shapetween.pipeline import Options, prepare
from shapetween.svg.read.reader import read_svg
from shapetween.svg.write.sequence import frame_svg
from shapetween.svg.write.smil import smil_svg
from tests.browser import Browser, difference

pytestmark = pytest.mark.browser

#: Ends, and moments that are no keyframes.
MOMENTS = (0.0, 0.13, 0.4, 0.61, 0.87, 1.0)

#: Share of pixels that may differ by more than an edge does: between keyframes a thin line may lie
#: half a pixel beside its place.
STRAY = 5e-4

#: Mean difference of a colour, of 255: between keyframes a browser blends it in another space.
TINT = 0.6

DEFS = """
<linearGradient id="g"><stop stop-color="#fc0"/>
<stop offset="1" stop-color="#c06"/></linearGradient>
<radialGradient id="r" cx=".4" cy=".4"><stop stop-color="#fff"/>
<stop offset="1" stop-color="#048" stop-opacity=".6"/></radialGradient>
"""

#: Pairs of drawings in a box of 100 by 100.
DRAWN = {
    "gradients": (
        '<rect x="10" y="20" width="60" height="50" fill="url(#g)"/>',
        '<circle cx="55" cy="55" r="35" fill="url(#r)"/>',
    ),
    "opacity": (
        '<g opacity=".5"><path d="M10 10H60V60H10Z" fill="#06c"/></g>'
        '<path d="M40 40H90V90H40Z" fill="#f00" fill-opacity=".6"/>',
        '<g opacity=".8"><circle cx="35" cy="60" r="28" fill="#0a0"/></g>'
        '<path d="M50 10L95 50L50 70Z" fill="#fa0" fill-opacity=".3"/>',
    ),
    "holes": (
        '<path fill-rule="evenodd" fill="#284" d="M5 5H95V95H5ZM20 20H45V45H20ZM60 55H80V80H60Z"/>',
        '<path fill="#842" d="M50 5A45 45 0 0 1 50 95A45 45 0 0 1 50 5Z M50 30A20 20 0 0 0 50 70'
        'A20 20 0 0 0 50 30Z"/>',
    ),
    "strokes": (
        '<path d="M10 80Q30 10 50 50T90 20" fill="none" stroke="#036" stroke-width="4"/>'
        '<circle cx="30" cy="25" r="12" fill="#fd6" stroke="#a30" stroke-width="3"/>',
        '<path d="M10 20L50 85L90 30" fill="none" stroke="#c03" stroke-width="10" '
        'stroke-linejoin="round" stroke-linecap="round"/>'
        '<rect x="60" y="60" width="28" height="24" fill="#6df" stroke="#222" stroke-width="1.5"/>',
    ),
    "crossing": (
        '<path fill="#609" d="M50 5L79 95L2 38H98L21 95Z"/>',
        '<path fill="#906" fill-rule="evenodd" d="M50 5L79 95L2 38H98L21 95Z"/>',
    ),
}

#: Pairs of the corpus: with holes, in colours, with gradients, with strokes, of many pieces.
REAL = (
    "dev-holes-05",
    "dev-holes-10",
    "dev-styled-06",
    "dev-styled-08",
    "dev-styled-13",
    "dev-strokes-04",
    "dev-strokes-10",
    "dev-multipart-08",
)


def check_played(browser: Browser, first: Drawing, last: Drawing) -> None:
    """Check that the animated file shows at every moment what the frame of that moment does."""
    movement = prepare(first, last, Options(folds="allow")).movement
    animated = smil_svg(movement, duration=1.0)
    frames = [frame_svg(drawing) for drawing in movement.at(np.array(MOMENTS))]
    shots = browser.pictures([animated] * len(MOMENTS) + frames, [*MOMENTS, *[0.0] * len(MOMENTS)])
    played, still = shots[: len(MOMENTS)], shots[len(MOMENTS) :]
    for one, other, t in zip(played, still, MOMENTS, strict=True):
        assert difference(one, other) <= STRAY, f"another picture at t = {t}"
        assert np.abs(one - other).mean() <= TINT, f"other colours at t = {t}"
    moved = [difference(one, other) for one, other in pairwise(played)]
    assert max(moved) > 20 * STRAY, "the check would not see a difference"


@pytest.mark.parametrize("name", DRAWN)
def test_drawings_play_as_their_frames(browser: Browser, name: str) -> None:
    root = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100">'
    first, last = (
        read_svg(f"{root}<defs>{DEFS}</defs>{body}</svg>".encode(), name) for body in DRAWN[name]
    )
    check_played(browser, first, last)


@pytest.mark.parametrize("pair", REAL)
def test_real_pairs_play_as_their_frames(browser: Browser, corpus: Path, pair: str) -> None:
    listed = json.loads((corpus / "pairs.json").read_text("utf-8"))
    (found,) = (entry for entry in listed if entry["id"] == pair)
    read = (read_svg((corpus / found[side]).read_bytes(), found[side]) for side in "ab")
    # As large as the window, not as the page that an icon is for.
    first, last = (replace(drawing, page=()) for drawing in read)
    check_played(browser, first, last)
