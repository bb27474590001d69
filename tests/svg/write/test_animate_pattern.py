"""Patterns in what is written: exact at both ends, kept where both have them, else covered."""

import re

import numpy as np
import pytest

from shapetween.model.movement import Movement
from shapetween.pipeline import prepare
from shapetween.svg.read.reader import read_svg
from shapetween.svg.write.sequence import frame_svg
from shapetween.svg.write.smil import smil_svg
from tests.browser import chromium, difference

STRIPES = (
    '<pattern id="p" width="8" height="8" patternUnits="userSpaceOnUse" '
    'patternTransform="rotate(30)"><path d="M0 0H4V8H0Z" fill="#d33"/></pattern>'
)
DOTS = (
    '<pattern id="p" width=".25" height=".25"><circle cx="4" cy="4" r="3" fill="#36c"/></pattern>'
)


def text(pattern: str, fill: str, place: int) -> str:
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100">{pattern}'
        f'<circle cx="{place}" cy="50" r="30" fill="{fill}" stroke="#000" stroke-width="4"/></svg>'
    )


PAIRS = {
    "still": (text(STRIPES, "url(#p)", 40), text(STRIPES, "url(#p)", 60)),
    "kept": (text(DOTS, "url(#p)", 40), text(DOTS, "url(#p)", 60)),
    "left": (text(STRIPES, "url(#p)", 40), text("", "#393", 60)),
    "come": (text("", "#393", 40), text(DOTS, "url(#p)", 60)),
    "changed": (text(STRIPES, "url(#p)", 40), text(DOTS, "url(#p)", 60)),
}


def movement_of(name: str) -> Movement:
    a, b = (read_svg(each.encode(), "it") for each in PAIRS[name])
    return prepare(a, b).movement


def test_a_pattern_that_both_have_goes_along() -> None:
    assert "patternTransform" not in re.sub("<pattern [^>]*>", "", smil_svg(movement_of("still")))
    found = smil_svg(movement_of("kept"))
    moving = found[found.index('class="shapetween-moving"') :]
    assert moving.count("<path") == 1
    assert 'attributeName="fill"' not in found
    assert 'attributeName="patternTransform" type="translate"' in found
    # As far as the circle.
    assert re.search(r'type="translate"[^>]*values="10 20;([^"]*;)?30 20"', found)


@pytest.mark.parametrize(("name", "paths"), [("left", 2), ("come", 2), ("changed", 3)])
def test_a_pattern_that_is_left_lies_under_what_comes(name: str, paths: int) -> None:
    found = smil_svg(movement_of(name))
    moving = found[found.index('class="shapetween-moving"') :]
    assert moving.count("<path") == paths
    assert found.count("<pattern") >= paths - 1


@pytest.mark.browser
def test_ends_and_frames_are_as_chromium_draws_the_files() -> None:
    with chromium() as browser:
        for name, pair in PAIRS.items():
            movement = movement_of(name)
            animated = smil_svg(movement)
            at_ends = [frame_svg(drawing) for drawing in movement.at(np.array([0.0, 1.0]))]
            shown = browser.pictures([*pair, *at_ends, animated, animated], [0, 0, 0, 0, 0, 2])
            for k, side in enumerate((0, 1, 0, 1)):
                assert difference(shown[side], shown[2 + k]) <= 0.01, (name, k)
