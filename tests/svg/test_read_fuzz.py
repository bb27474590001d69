"""Mutated documents end as a drawing or as one line of error, never otherwise.

Mutations know the structure: they work on bytes, on tags, on attributes, and on the words inside
attributes, so that they get past the parser.
"""

import gzip
import random
import re
from pathlib import Path

import numpy as np
import pytest

from shapetween.base.errors import ShapetweenError
from shapetween.model.drawing import Drawing
from shapetween.svg.read.limits import Limits
from shapetween.svg.read.reader import read_svg

SEEDS = sorted((Path(__file__).parent / "data").glob("fuzz-*.svg"))

#: Mutants of each seed file, more than a thousand in all: some ten seconds.
MUTANTS = 300

#: Small budgets, so that mutants that multiply end quickly.
LIMITS = Limits(elements=2000, use_copies=500, path_commands=5000, entity_growth=2000)

WORDS = [
    *("0", "-1", "1e9", "1e-9", "1e38", "-1e308", "1e999", "NaN", "inf", "0x10", "", " ", "50%"),
    *(
        "1e",
        ".",
        "-",
        "+.5.",
        "auto",
        "none",
        "inherit",
        "currentColor",
        "url(#a)",
        "url(#",
        "url()",
    ),
    *("#a", "#b", "url(http://b)", "M0 0", "z", "A", "a1 1 0 11", "rotate(", "matrix(1 0 0 1 0 0)"),
    *(
        "scale(0)",
        "scale(1e200)",
        "rgb(",
        "#12",
        "var(--a)",
        "!important",
        "é",
        "\U0001f600",
        "&amp;",
    ),
    *("objectBoundingBox", "userSpaceOnUse", "hidden", "visible", "evenodd", "3em", "9mm", "9pc"),
    "(" * 300,
    "9" * 400,
    "M" + "1 1" * 300,
]
TAG = re.compile(r"<[^<>]*>")
ATTRIBUTE = re.compile(r'[\w:-]+="[^"]*"')
WORD = re.compile(r"[A-Za-z#%]+|-?[\d.]+")


def replaced(text: str, start: int, end: int, by: str) -> str:
    return text[:start] + by + text[end:]


def mutate_tag(text: str, rng: random.Random) -> str:
    tags = list(TAG.finditer(text))
    if not tags:
        return text
    one, other = rng.choice(tags), rng.choice(tags)
    by = rng.choice(["", one[0] * 2, other[0], one[0].replace("/", ""), f"<{rng.choice(NAMES)}>"])
    return replaced(text, one.start(), one.end(), by)


NAMES = ["g", "use", "svg", "clipPath", "linearGradient", "path", "text", "a/", "!DOCTYPE a", "?b"]


def mutate_attribute(text: str, rng: random.Random) -> str:
    found = list(ATTRIBUTE.finditer(text))
    if not found:
        return text
    one, other = rng.choice(found), rng.choice(found)
    name, value = one[0].split("=", 1)[0], other[0].split("=", 1)[1]
    by = rng.choice(["", other[0], f"{name}={value}", f'{name}="{rng.choice(WORDS)}"'])
    return replaced(text, one.start(), one.end(), by)


def mutate_word(text: str, rng: random.Random) -> str:
    found = list(ATTRIBUTE.finditer(text))
    if not found:
        return text
    attribute = rng.choice(found)
    words = list(WORD.finditer(text, attribute.start(), attribute.end()))[1:]
    if not words:
        return text
    word = rng.choice(words)
    return replaced(text, word.start(), word.end(), rng.choice(WORDS))


def mutate_span(text: str, rng: random.Random) -> str:
    start = rng.randrange(len(text) + 1)
    end = min(len(text), start + rng.randrange(40))
    return replaced(text, start, end, rng.choice([*WORDS, text[start:end] * 2, text[end:start]]))


def mutate_bytes(data: bytes, rng: random.Random) -> bytes:
    damaged = bytearray(data)
    for _ in range(rng.randrange(1, 6)):
        if damaged:
            damaged[rng.randrange(len(damaged))] = rng.randrange(256)
    return bytes(damaged[: rng.choice([len(damaged), rng.randrange(len(damaged) + 1)])])


def mutant(text: str, rng: random.Random) -> bytes:
    steps = [mutate_tag, mutate_attribute, mutate_word, mutate_word, mutate_word, mutate_span]
    for _ in range(rng.randrange(1, 6)):
        text = rng.choice(steps)(text, rng)
    data = text.encode(rng.choice(["utf-8"] * 6 + ["utf-16", "latin-1"]), errors="replace")
    if rng.random() < 0.1:
        data = gzip.compress(data)
    return mutate_bytes(data, rng) if rng.random() < 0.15 else data


def check(drawing: Drawing) -> None:
    """A drawing that every later stage can take."""
    assert drawing.shapes
    assert drawing.box.width >= 0
    assert drawing.box.height >= 0
    for shape in drawing.shapes:
        assert shape.rings
        assert shape.style.fill is not None or shape.style.stroke is not None
        for ring in shape.rings:
            assert np.isfinite(ring.curves).all()
            assert ring.closed or shape.style.stroke is not None
    assert all("\n" not in warning for warning in drawing.warnings)


@pytest.mark.parametrize("seed", SEEDS, ids=lambda path: path.stem)
def test_mutants_are_read_or_refused(seed: Path) -> None:
    text = seed.read_text()
    check(read_svg(text.encode(), seed.name, LIMITS))
    rng = random.Random(seed.name)
    drawn = 0
    messages = []
    for number in range(MUTANTS):
        data = mutant(text, rng)
        try:
            check(read_svg(data, "mutant", LIMITS))
            drawn += 1
        except ShapetweenError as error:
            messages.append(str(error))
        except Exception as error:
            raise AssertionError(f"mutant {number}: {data!r}") from error
    assert drawn > MUTANTS / 5, "mutations must get past the parser"
    assert not any("\n" in message for message in messages)


def test_there_are_seeds() -> None:
    assert len(SEEDS) >= 4
