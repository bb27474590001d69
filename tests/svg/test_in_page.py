"""What the page around a drawing says of it stays the page's to say."""

import xml.etree.ElementTree as ET

import numpy as np
import pytest

import shapetween as st
from shapetween.model.drawing import Drawing
from shapetween.model.paint import Colour
from shapetween.svg.read.reader import read_svg
from shapetween.svg.write.sequence import frame_svg
from tests.smil import SVG

ROOT = (
    'xmlns="http://www.w3.org/2000/svg" width="24" height="2em" viewBox="0 0 24 24" fill="none" '
    'stroke="currentColor" stroke-width="2" class="icon" role="img" aria-label="lock" '
    'aria-labelledby="t" preserveAspectRatio="xMinYMin slice"'
)
LOCK = '<rect x="4" y="11" width="16" height="10"/>'
OPEN = '<rect x="3" y="9" width="18" height="12"/>'


def icon(content: str, root: str = ROOT) -> Drawing:
    return read_svg(f"<svg {root}>{content}</svg>".encode(), "icon.svg")


def painted(first: str, last: str, attribute: str = "fill") -> str | None:
    """What the only path of an animated file is painted with."""
    text = st.morph(icon(first), icon(last), folds="allow").svg()
    paths = [path for path in ET.fromstring(text).iter(f"{SVG}path") if len(path)]
    (path,) = paths
    return path.get(attribute)


def test_the_root_keeps_its_size_and_what_it_is_to_the_page() -> None:
    found = st.morph(icon(LOCK), icon(OPEN, ROOT.replace("lock", "open")), folds="allow")
    for text in (found.svg(), frame_svg(found.at(0.5)), found.svg(loop="repeat", keyframes=3)):
        root = ET.fromstring(text)
        assert root.get("width") == "24"
        assert root.get("height") == "2em"
        assert root.get("class") == "icon"
        assert root.get("role") == "img"
        assert root.get("aria-label") == "lock"
        assert root.get("preserveAspectRatio") == "xMinYMin slice"
        assert root.get("aria-labelledby") is None, "it may name what is not there"


def test_the_page_colours_what_both_drawings_leave_to_it() -> None:
    found = st.morph(icon(LOCK), icon(OPEN), folds="allow")
    for text in (found.svg(), found.svg(loop="alternate"), frame_svg(found.at(0.5))):
        strokes = {p.get("stroke") for p in ET.fromstring(text).iter(f"{SVG}path")}
        assert strokes == {"currentColor"}
        assert '"stroke" dur' not in text


SHAPE = '<path style="{}" d="M1 1H{}V9H1Z"/>'


@pytest.mark.parametrize(
    ("first", "last", "expected"),
    [
        ("fill:currentColor", "fill:currentColor", "currentColor"),
        ("fill:var(--tint, #f00)", "fill:var(--tint, #f00)", "var(--tint, #f00)"),
        ("color:var(--ink,#00f);fill:currentColor", "fill:var(--ink,#00f)", "var(--ink,#00f)"),
        ("fill:currentColor", "fill:#000", "#000"),
        ("fill:var(--tint, #f00)", "fill:var(--other, #f00)", "#f00"),
        ("color:#0f0;fill:currentColor", "color:#0f0;fill:currentColor", "#0f0"),
        ("--tint:#0f0;fill:var(--tint,#f00)", "--tint:#0f0;fill:var(--tint,#f00)", "#0f0"),
    ],
)
def test_only_what_both_leave_to_the_page_stays_its(first: str, last: str, expected: str) -> None:
    both = SHAPE.format(f"stroke:none;{first}", 9), SHAPE.format(f"stroke:none;{last}", 15)
    assert painted(*both) == expected


def test_a_set_property_hides_what_was_inherited() -> None:
    shapes = (
        '<g style="fill:var(--a,#f00);stroke:none"><path d="M1 1H9V9H1Z"/>'
        '<path fill="#00f" d="M1 11H9V19H1Z"/><path style="fill:inherit" d="M11 1H19V9H11Z"/></g>'
    )
    fills = [shape.style.fill for shape in icon(shapes).shapes]
    assert fills == [
        Colour(1, 0, 0, reference="var(--a,#f00)"),
        Colour(0, 0, 1),
        Colour(1, 0, 0, reference="var(--a,#f00)"),
    ]


def test_pictures_are_in_the_colours_the_file_falls_back_to() -> None:
    pytest.importorskip("resvg_py")
    from shapetween.raster.film import Film

    shape = SHAPE.format("stroke:none;fill:var(--tint, #f00)", 23)
    found = st.morph(icon(shape), icon(shape), folds="allow")
    film = Film.of(found.movements, np.array([0.0, 1.0]), size=(24, 24))
    frame = next(film.frames())
    assert frame[5, 5].tolist() == [255, 0, 0, 255]
