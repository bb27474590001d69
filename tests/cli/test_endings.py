"""Every ending is written from Python as it is by the command, byte for byte."""

from pathlib import Path

import pytest

import shapetween as st
from shapetween.formats.table import WRITERS
from tests.cli.commands import Command, listing

FILM = {"fps": 10.0, "size": (20,)}


@pytest.mark.parametrize("ending", sorted(WRITERS))
def test_python_writes_what_the_command_does(run: Command, tmp_path: Path, ending: str) -> None:
    film = "fps" in WRITERS[ending].takes
    if film:
        pytest.importorskip("resvg_py")
        pytest.importorskip("PIL.Image")
    if ending == ".mp4":
        pytest.importorskip("imageio_ffmpeg")
    said = run(f"morph a.svg b.svg -o out{ending} --duration .5 {'--fps 10 --size 20' * film}")
    assert said.code == 0, said.err
    (tmp_path / "python").mkdir()
    moved = st.morph(tmp_path / "a.svg", tmp_path / "b.svg")
    moved.write(tmp_path / f"python/out{ending}", duration=0.5, **(FILM if film else {}))
    made = listing(tmp_path / "python")
    assert made
    assert set(made) == said.made
    assert all((tmp_path / name).read_bytes() == content for name, content in made.items())
