"""The one way in which a movement becomes a file."""

from importlib import import_module
from pathlib import Path

import pytest

import shapetween as st
from shapetween.base.errors import OptionError
from shapetween.formats.options import WriteOptions
from shapetween.formats.table import FEATURES, FRAMES, WRITERS, formats_table
from shapetween.svg.read.reader import read_svg
from tests.drawings import area, drawing, square


@pytest.fixture(scope="module")
def moved() -> st.Morph:
    return st.morph(drawing(area(square(10, 10, 40))), drawing(area(square(30, 30, 40))))


def test_every_writer_is_where_the_table_says() -> None:
    for writer in (*WRITERS.values(), *FRAMES.values()):
        module, name = writer.home.split(":")
        assert callable(getattr(import_module(module), name))


def test_what_cannot_be_written_is_refused_and_nothing_is(moved: st.Morph, tmp_path: Path) -> None:
    with pytest.raises(OptionError, match=r"out\.doc: a movement is written as \.svg, \.webp, "):
        moved.write(tmp_path / "out.doc")
    with pytest.raises(OptionError, match="fps: changes nothing in an animated SVG"):
        moved.write(tmp_path / "out.svg", fps=3)
    with pytest.raises(OptionError, match="keyframes: changes nothing in moving pictures"):
        moved.write(tmp_path / "out.gif", keyframes=3)
    with pytest.raises(OptionError, match="speed: is no option"):
        moved.write(tmp_path / "out.gif", speed=3)
    assert not list(tmp_path.iterdir())


#: What a file of an ending begins with.
BEGINNINGS = {
    ".svg": b"<svg ",
    ".json": b'{"v":"5.7.0"',
    ".lottie": b"PK",
    ".css": b"/* ",
    ".xml": b"<animated-vector ",
    ".mjs": b"// Made with shapetween",
    ".html": b"<!DOCTYPE html>",
}


@pytest.mark.parametrize("ending", BEGINNINGS)
def test_every_ending_has_its_own_format(moved: st.Morph, tmp_path: Path, ending: str) -> None:
    place = tmp_path / f"out{ending}"
    moved.write(place)
    assert place.read_bytes().startswith(BEGINNINGS[ending])


ROOT = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100">'

SHADE = '<linearGradient id="g"><stop stop-color="{a}"/><stop offset="1" stop-color="{b}"/>'
MASK = f"""<defs>{SHADE.format(a="#fff", b="#222")}</linearGradient><mask id="m">
<rect width="100" height="100" fill="url(#g)"/></mask></defs>"""
BLUR = '<defs><filter id="f"><feGaussianBlur stdDeviation="2"/></filter></defs>'

#: Of every feature a drawing that has it; "M" is a place that moves.
DRAWN = {
    "several parts": '<path fill="#f00" d="M10 10HMV50H10Z"/><path fill="#00f" d="M60 60H90V90Z"/>',
    "lines": '<path fill="none" stroke="#000" stroke-width="4" d="M10 10LM 60"/>',
    "dashes": '<path fill="none" stroke="#000" stroke-dasharray="9 4" d="M10 10LM 60"/>',
    "gradients that change": f"<defs>{SHADE.format(a='#f00', b='#00M')}</linearGradient></defs>"
    '<path fill="url(#g)" d="M10 10HMV50H10Z"/>',
    "opacity of a group": '<g opacity=".5"><path d="M10 10HMV50H10Z"/>'
    '<path fill="#c00" d="M20 20HMV90H20Z"/></g>',
    "masks": f'{MASK}<g mask="url(#m)"><path d="M10 10HMV50H10Z"/></g>',
    "filters": f'{BLUR}<path filter="url(#f)" d="M10 10HMV50H10Z"/>',
    "blending": '<path style="mix-blend-mode:multiply" d="M10 10HMV50H10Z"/>',
    "the page's own colour": '<path fill="currentColor" d="M10 10HMV50H10Z"/>',
}


@pytest.mark.parametrize("ending", WRITERS)
@pytest.mark.parametrize("feature", DRAWN)
def test_what_a_format_does_not_keep_is_told_of_or_refused(ending: str, feature: str) -> None:
    bodies = [DRAWN[feature].replace("M 60", f"{x} 60") for x in (45, 85)]
    bodies = [b.replace("HM", f"H{x}").replace("#00M", f"#00{x}"[:4]) for b, x in
              zip(bodies, (45, 85), strict=True)]  # fmt: skip
    first, last = (read_svg(f"{ROOT}{body}</svg>".encode(), "a") for body in bodies)
    morph = st.morph(first, last)
    writer = WRITERS[ending]
    try:
        told = bool(morph.written(writer, WriteOptions()).warnings)
    except OptionError:
        told = True
    assert told != (feature in writer.keeps)


def test_the_readme_has_the_table() -> None:
    assert set(DRAWN) == set(FEATURES[:-1])
    assert all((FEATURES[-1] in writer.keeps) == writer.pictures for writer in WRITERS.values())
    assert formats_table() in (Path(__file__).parents[2] / "README.md").read_text("utf-8")
