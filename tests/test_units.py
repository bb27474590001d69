"""A drawing moves alike in any unit: as metres or as micrometres, the same picture."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from shapetween.base.arrays import Curves
from shapetween.model.drawing import Box, Drawing
from shapetween.pipeline import prepare
from shapetween.svg.read.reader import read_svg
from tests.ties import TIES, svg

ROOT = Path(__file__).resolve().parents[1]
CORPUS = ROOT.parent / "shared/corpus"

#: Pairs of the gallery of all kinds.
PAIRS = ("hammer:wrench", "hand-closed:hand-open", "letter-o:letter-c", "key:lock", "run:walk")

#: Kinds of the corpus, and every how manieth pair of each is taken; those that once differed among
#: them.
EVERY = {
    "icons": 4,
    "strokes": 1,
    "holes": 4,
    "silhouette": 9,
    "multipart": 11,
    "emoji": 12,
    "articulated": 9,
    "styled": 6,
    "labelled": 11,
    "structure": 5,
    "large": 3,
}

#: Those that once differed beyond these: crossing curves that all but touch, a straight side's
#: corners, knots that are one, and a run that goes all round.
DIFFERED = ("dev-styled-09", "dev-hostile-15", "emoji-14", "emoji-06")

TIMES = np.array([0.0, 0.3, 0.5, 1.0])


def read(path: Path) -> Drawing:
    return read_svg(path.read_bytes(), path.name)


def scaled(drawing: Drawing, unit: float) -> Drawing:
    larger = drawing.transformed(np.array([[unit, 0.0, 0.0], [0.0, unit, 0.0]]))
    x, y, width, height = (
        unit * side
        for side in (drawing.box.x, drawing.box.y, drawing.box.width, drawing.box.height)
    )
    return replace(larger, box=Box(x, y, width, height))


def frames(first: Drawing, second: Drawing, unit: float) -> list[Curves]:
    parts = prepare(scaled(first, unit), scaled(second, unit)).movement.parts
    return [part.curves(TIMES) / unit for part in parts]


def assert_alike(first: Drawing, second: Drawing) -> None:
    usual = frames(first, second, 1.0)
    size = max(first.box.width, first.box.height)
    for unit in (1e-6, 1e6):
        found = frames(first, second, unit)
        assert [part.shape for part in found] == [part.shape for part in usual], unit
        for part, other in zip(found, usual, strict=True):
            assert np.abs(part - other).max() < 1e-6 * size, unit


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("names", PAIRS)
def test_a_pair_moves_alike_in_any_unit(names: str) -> None:
    first, second = (read(ROOT / f"gallery/inputs/{name}.svg") for name in names.split(":"))
    assert_alike(first, second)


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("names", TIES, ids=":".join)
def test_what_has_equal_parts_moves_alike_in_any_unit(names: tuple[str, str]) -> None:
    assert_alike(*(read_svg(svg(name), name) for name in names))


def corpus_pairs() -> list[tuple[str, str]]:
    if not CORPUS.exists():
        return []
    rows = json.loads((CORPUS / "pairs.json").read_text("utf-8"))
    kinds = {kind: [row for row in rows if row["category"] == kind] for kind in EVERY}
    taken = [row for kind, own in kinds.items() for row in own[:: EVERY[kind]]]
    taken += [row for row in rows if row["id"] in DIFFERED and row not in taken]
    return [(row["a"], row["b"]) for row in taken]


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize(
    "names", corpus_pairs() or [pytest.param(None, marks=pytest.mark.skip("there is no corpus"))]
)
def test_a_pair_of_the_corpus_moves_alike_in_any_unit(names: tuple[str, str]) -> None:
    assert_alike(*(read(CORPUS / name) for name in names))
