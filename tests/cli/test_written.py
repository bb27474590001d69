"""The command line and the library write in one way."""

import json
from pathlib import Path
from typing import Any

import pytest

import shapetween as st
from shapetween.formats.table import WRITERS
from tests.cli.commands import SQUARE, Command, svg


@pytest.mark.parametrize("ending", sorted(WRITERS))
def test_python_writes_what_the_command_line_does(
    ending: str, run: Command, tmp_path: Path
) -> None:
    """Byte for byte, by every ending."""
    if WRITERS[ending].pictures:
        pytest.importorskip("resvg_py")
    if ending == ".mp4":
        pytest.importorskip("imageio_ffmpeg")
    # What some formats name after their file is the same in two folders.
    for name in ("line", "python"):
        (tmp_path / name).mkdir()
    asked = {} if ending == ".xml" else {"loop": "repeat"}  # Android's play once
    line = f"morph a.svg b.svg -o line/out{ending} --duration .3"
    line += "".join(f" --{name} {value}" for name, value in asked.items())
    result = run(line + (" --size 32 --fps 10" if WRITERS[ending].pictures else ""))
    assert result.code == 0, result.err
    moved = st.morph(tmp_path / "a.svg", tmp_path / "b.svg", pictures=WRITERS[ending].pictures)
    more: dict[str, Any] = {"size": (32,), "fps": 10.0} if WRITERS[ending].pictures else {}
    more |= asked
    told = moved.write(tmp_path / "python" / f"out{ending}", duration=0.3, **more)
    assert told == ()
    here, there = (tmp_path / name / f"out{ending}" for name in ("python", "line"))
    assert here.read_bytes() == there.read_bytes()


def test_an_svg_waits_for_what_it_is_told_to(run: Command, tmp_path: Path) -> None:
    result = run("morph a.svg b.svg -o out.svg --start click --folds allow")
    assert result.code == 0
    assert "<img>" in result.err
    assert "click" in (tmp_path / "out.svg").read_text("utf-8")
    refused = run("morph a.svg b.svg -o seen.svg --start seen --folds allow")
    assert refused.code == 2
    assert len(refused.err.splitlines()) == 1
    assert not refused.made


def test_what_a_format_cannot_hold_is_told_and_reported(run: Command, tmp_path: Path) -> None:
    shade = '<linearGradient id="g"><stop/><stop offset="1" stop-color="red"/></linearGradient>'
    (tmp_path / "a.svg").write_text(svg(shade + SQUARE.replace("<path", '<path fill="url(#g)"')))
    done = run("morph a.svg b.svg -o out.css --report report.json")
    report = json.loads((tmp_path / "report.json").read_text("utf-8"))
    (told,) = [notice for notice in report["notices"] if notice["kind"] == "format"]
    assert told["message"] in report["warnings"]
    assert told["message"] in done.err
