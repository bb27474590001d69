"""The page for contributors names places that exist."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
PAGE = (ROOT / "gallery/contributing.md").read_text("utf-8")

#: What a newcomer looks for, and a word that the module it is in has to hold.
QUESTIONS = {
    "CSS keyframes output": "@keyframes",
    "arcs to cubics": "arc",
    "the cost of matching": "cost",
    "the default easing": "EASING",
    "a hole without partner": "without counterpart",
    "a new interpolation method": "METHODS",
    "`mask`": "mask",
    "how many keyframes": "keyframes",
    "the untangling solve": "untangle",
    "a new measure in `compare`": "Figures",
    "`<text>`": "text",
    "which shape pairs with which": "Roles",
    "what is an eye, a mouth, a wheel": "EYE",
    "that letters of a word go in order": "letters",
    "an area and the line round it": "outline",
    "what is told of limits of counts": "Notice",
    "what is told of a file that is not read whole": "Losses",
    "what is told of one outline's movement": "Notice",
    "how what has no partner disappears": "disappear",
    "when two drawings are exchanged as wholes": "too_different",
    "the centre line of an outlined stroke": "medial",
}


def test_every_path_on_the_page_exists() -> None:
    paths = {p for p in re.findall(r"`([\w/.]+)`", PAGE) if "/" in p or p.endswith(".py")}
    assert len(paths) > 20
    places = ROOT, ROOT / "shapetween", ROOT / "shapetween/scene"
    assert not [path for path in paths if not any((place / path).exists() for place in places)]


@pytest.mark.parametrize("question", QUESTIONS)
def test_each_question_has_its_answer(question: str) -> None:
    row = re.search(rf"^\| {re.escape(question)} \| `([^`]+)` \|$", PAGE, re.MULTILINE)
    assert row
    assert QUESTIONS[question] in (ROOT / "shapetween" / row[1]).read_text("utf-8")


def test_the_glossary_is_short() -> None:
    entries = PAGE.split("## Glossary")[1].strip().splitlines()
    assert len(entries) <= 40
    assert entries == sorted(entries, key=str.casefold)


def test_every_room_and_every_module_of_the_largest_one_is_named() -> None:
    package = ROOT / "shapetween"
    rooms = {path.parent.name for path in package.glob("*/__init__.py")}
    # Commands, pages and libraries over all of this: their names say it.
    rooms -= {"base", "batch", "cli", "compare", "gallery", "inkscape", "interop", "notebook"}
    rooms -= {"photo", "studio", "truth", "geometry", "io", "boolean", "raster"}
    assert not [room for room in rooms if not re.search(rf"`{room}[`/]", PAGE)]
    listed = PAGE.split("## The modules of `scene`")[1].split("## Glossary")[0]
    found = set(re.findall(r"`(\w+(?:\.py)?)`", listed)) - {"scene"}
    modules = {path.name for path in (package / "scene").glob("*.py")} - {"__init__.py"}
    assert found == modules | {path.parent.name for path in package.glob("scene/*/__init__.py")}
