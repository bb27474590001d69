"""Nothing jumps: no control point runs faster than a bound over any ten thousandth of the time.

But what turns over as a card does: it is seen on its edge, never gone, and so leaps across that.
"""

import json
from pathlib import Path

import numpy as np
import pytest

from shapetween.base.arrays import Floats
from shapetween.model.movement import Movement
from shapetween.model.part import Part
from shapetween.pipeline import prepare
from shapetween.svg.read.reader import read_svg

INPUTS = Path(__file__).resolve().parents[1] / "gallery" / "inputs"

#: Thousandths of the view box that a point may run in a ten thousandth of the time: as if it ran
#: through three pictures in the whole, where no pair of the corpus has one that runs through more
#: than 2.7. A jump is a line's width at least, twenty and more; a handle that another pulls round
#: as it shrinks to nothing runs one to ten.
BOUND, SHORT = 0.3, 1e-4

#: The same where a border is cut off by another one that it is nearly parallel to: where they meet
#: runs along faster than either.
CUT_BOUND = 1.0

#: Parts of the time that are looked at; where points run farthest in, they are looked at closer.
STEPS, CLOSER = 240, 4

#: Pairs of the gallery: areas, holes, strokes, parts that come and go.
PAIRS = (
    ("man-dancing", "woman-dancing"),
    ("hand-closed", "hand-open"),
    ("deer", "giraffe"),
    ("man", "werewolf"),
    ("key", "lock"),
    ("letter-o", "letter-c"),
)

#: Pairs of the corpus: outlines with handles of hardly any length, and a tip whose handles are
#: nothing each at one end; lines that are drawn, slashes that cut, marks that come and go.
REAL = (
    "dev-silhouette-04",
    "dev-silhouette-20",
    "dev-articulated-16",
    "dev-holes-08",
    "labelled-20",
    "icons-05",
    "icons-06",
    "icons-17",
    "icons-37",
    "icons-47",
    "icons-48",
    "emoji-05",
    "emoji-40",
    "dev-multipart-06",
)

CUTS = ("icons-45", "icons-46")


def fastest(movement: Movement) -> float:
    """How far any control point runs in so short a time, in thousandths of the view box."""
    size = max(movement.box.width, movement.box.height)
    return max(_fastest(part) * 1000 / size for part in movement.parts)


def _fastest(part: Part) -> float:
    times = np.linspace(0.0, 1.0, STEPS + 1)
    runs = _runs(part, times)
    found = 0.0
    for k in np.argsort(-runs)[:CLOSER].tolist():
        low, high = float(times[k]), float(times[k + 1])
        while high - low > SHORT:
            middle = (low + high) / 2
            first, second = _runs(part, np.array([low, middle, high])).tolist()
            low, high = (low, middle) if first >= second else (middle, high)
        found = max(found, float(_runs(part, np.array([low, high]))[0]))
    return found


def _runs(part: Part, times: Floats) -> Floats:
    """The farthest that a point runs from each time to the next."""
    places = part.curves(times).reshape(len(times), -1, 2)
    return np.asarray(np.linalg.norm(np.diff(places, axis=0), axis=-1).max(axis=1))


def moved(first: Path, last: Path) -> Movement:
    a, b = (read_svg(place.read_bytes(), place.name) for place in (first, last))
    return prepare(a, b).movement


@pytest.mark.parametrize("pair", PAIRS)
def test_nothing_jumps_in_the_gallery(pair: tuple[str, str]) -> None:
    a, b = (INPUTS / f"{name}.svg" for name in pair)
    assert fastest(moved(a, b)) <= BOUND


@pytest.mark.parametrize("name", REAL + CUTS)
def test_nothing_jumps_in_the_corpus(corpus: Path, name: str) -> None:
    listed = json.loads((corpus / "pairs.json").read_text("utf-8"))
    (pair,) = (each for each in listed if each["id"] == name)
    bound = CUT_BOUND if name in CUTS else BOUND
    assert fastest(moved(corpus / pair["a"], corpus / pair["b"])) <= bound
