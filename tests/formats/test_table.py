"""The one way in which a movement becomes a file."""

from importlib import import_module
from pathlib import Path

import pytest

import shapetween as st
from shapetween.base.errors import OptionError
from shapetween.formats.table import FRAMES, WRITERS
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
