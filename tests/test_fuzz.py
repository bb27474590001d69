"""Damaged drawings, from the file to the frames: a movement, or one line of error."""

import random
import re

import numpy as np
import pytest

from shapetween.base.errors import ShapetweenError
from shapetween.pipeline import Options, prepare
from shapetween.svg.read.limits import Limits
from shapetween.svg.read.reader import read_svg
from shapetween.svg.write.sequence import frame_svg
from shapetween.svg.write.smil import smil_svg

HEAD = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 40 30">'
SEEDS = {
    "corners": HEAD + '<path d="M4 4H36V26H20L16 14L12 26H4Z"/></svg>',
    "curves": HEAD + '<path d="M4 15C4 2 18 2 20 10S36 4 36 16Q30 28 20 24T4 15Z"/></svg>',
    "hole": HEAD + '<path d="M2 2H30V28H2Z M8 8V20H20V8Z" fill-rule="evenodd"/></svg>',
    "pieces": HEAD
    + '<g fill="#c00"><circle cx="9" cy="9" r="6"/><path d="M20 20h9l-4 8z"/></g></svg>',
    "lines": HEAD + '<path d="M4 4L30 9L8 26" fill="none" stroke="#000" stroke-width="3"/></svg>',
}

#: Numbers that geometry stumbles over: none, equal ones, tiny, huge, and steps back.
NUMBERS = [
    "0",
    "-5",
    "4",
    "8",
    "15",
    "26",
    "36",
    "1e-7",
    "0.0001",
    "1e5",
    "-1e9",
    "40.00001",
    "1e-300",
]
LETTERS = "MLHVCSQTAZmlhvcsqtaz"

#: Small budgets, so that nothing grows large.
LIMITS = Limits(elements=200, use_copies=50, path_commands=400, entity_growth=2000)

#: Mutants of each seed. All of it takes some seconds.
MUTANTS = 6


def mutant(text: str, rng: random.Random) -> str:
    """A few numbers, letters and attributes of the drawing replaced, doubled or lost."""
    for _ in range(rng.choice([1, 1, 2, 3, 5])):
        pattern, words = rng.choice(
            [
                (r"(?<=[\d\s\-A-Za-z\"])-?\d+\.?\d*", NUMBERS),
                (r"(?<=[\"\d\s])[MLHVCSQTAZ](?=[\d\s\"])", list(LETTERS)),
                (
                    r' [a-z-]+="[^"]*"',
                    ["", ' fill="none"', ' stroke="red"', ' transform="scale(2)"'],
                ),
                (r"\s?-?\d+ \d+", ["", " 4 4", " 4 4 4 4"]),
            ]
        )
        found = list(re.finditer(pattern, text[len(HEAD) - 13 :]))
        if found:
            spot = rng.choice(found)
            start, end = (len(HEAD) - 13 + place for place in spot.span())
            text = text[:start] + rng.choice(words) + text[end:]
    return text


@pytest.mark.parametrize("name", SEEDS)
def test_mutants_move_or_are_refused(name: str) -> None:
    rng = random.Random(name)
    other = read_svg(SEEDS["corners" if name == "lines" else "hole"].encode(), "other")
    t = np.linspace(0, 1, 4)
    moved, messages = 0, list[str]()
    for number in range(MUTANTS):
        text = mutant(SEEDS[name], rng)
        try:
            drawing = read_svg(text.encode(), "mutant", LIMITS)
            pair = (drawing, other) if number % 2 else (other, drawing)
            options = Options(folds="prevent" if number % 6 == 0 else "allow")
            movement = prepare(*pair, options).movement
            frames = movement.at(t)
            texts = [frame_svg(frame) for frame in frames] + [smil_svg(movement, keyframes=3)]
            moved += 1
        except ShapetweenError as error:
            messages.append(str(error))
            continue
        except Exception as error:
            raise AssertionError(f"mutant {number}: {text}") from error
        assert not any(re.search(r"nan|inf", text, re.IGNORECASE) for text in texts)
        structures = {tuple(len(s.rings) for s in frame.shapes) for frame in frames}
        assert len(structures) == 1, text
        for frame in frames:
            for shape in frame.shapes:
                assert all(np.isfinite(ring.curves).all() for ring in shape.rings), text
    assert not any("\n" in message for message in messages)
    assert moved > MUTANTS / 3, "mutations must get past the reader"
