"""Outputs that cannot be, and options that have no sense: one line, exit code 2, nothing written.

Every line names what is wrong and what was expected or would do instead.
"""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from tests.cli.commands import SQUARE, TRIANGLE, Command, listing, svg
from tests.cli.test_bad_input import assert_refused

ROOT = Path(__file__).resolve().parents[2]

#: Drawings that some formats have no place for, by name.
DRAWINGS = {
    "line.svg": '<path d="M1 1L9 9" fill="none" stroke="#000"/>',
    "bent.svg": '<path d="M1 9L5 1L9 9" fill="none" stroke="#000"/>',
    "two.svg": f'{SQUARE}<path fill="#00f" d="M1 1H5V5H1Z"/>',
    "other.svg": '<path fill="#080" d="M2 2H9V9H2Z"/><path fill="#f0f" d="M3 3H5V5H3Z"/>',
}

#: Options after `morph a.svg b.svg`, unless the line starts with a command; and what is said.
REFUSED = (
    # How long.
    ("--duration 0 -o o.svg", "from 0.001 to 86400"),
    ("--duration 1e9 -o o.mjs", "from 0.001 to 86400"),
    ("--duration inf -o o.json", "from 0.001 to 86400"),
    ("--duration two -o o.css", "'two' is not a number"),
    ("--hold -1 -o o.xml", "from 0 to 86400"),
    ("--hold nan -o o.html", "from 0 to 86400"),
    # How.
    ("--easing bouncy -o o.json", "expected linear, ease"),
    ("--easing cubic-bezier(2,0,1,1) -o o.svg", "x1 and x2 from 0 to 1"),
    ("--easing cubic-bezier(0,0,1) -o o.lottie", "expected linear, ease"),
    ("--easing cubic-bezier(0,90,1,1) -o o.svg", "expected to stay"),
    ("--easing spring(1,2) -o o.mjs", "spring(mass,stiffness,damping)"),
    ("--easing spring(1,0,1) -o o.mjs", "spring"),
    ("--easing spring(0,1,1) -o o.mjs", "spring"),
    ("--easing linear(0.5) -o o.css", "linear(0, .3 20%, 1)"),
    ("--easing linear(0.2,1) -o o.css", "expected it to run from 0 to 1"),
    ("--loop forever -o o.svg", "did you mean repeat?"),
    ("--easing-over all -o o.svg", "expected leg, chain"),
    ("--stagger -2 -o o.svg", "from 0 to 3600"),
    ("--stagger-by left -o o.svg", "changes nothing without stagger"),
    ("--stagger 1 --stagger-by size -o o.svg", "expected order, distance, left"),
    ("--start wish -o o.svg", "expected load, click, hover, seen, scroll, drag"),
    ("--css clip -o o.css", "expected path, shape, d"),
    # How fine and how large.
    ("--keyframes 1 -o o.json", "from 2 to 1000"),
    ("--keyframes some -o o.xml", "neither 'auto' nor a number"),
    ("--precision -1 -o o.mjs", "whole number from 0 to 12"),
    ("--precision 2.5 -o o.css", "whole number from 0 to 12"),
    ("--size 0 -o o.webp", "such as 1280x720"),
    ("--size 3x3x3 -o o.gif", "such as 1280x720"),
    ("--size wide -o o.css", "such as 1280x720"),
    ("--fps 0 -o o.webp", "from 0.01 to 240"),
    ("--background lilac-ish -o o.html", "expected a colour such as #fff"),
    # What a format has no use for.
    ("--loop repeat -o o.xml", "loop: changes nothing in an Android vector drawable"),
    ("--start click -o o.json", "start: changes nothing in a Lottie animation"),
    ("--start hover -o o.css", "start: changes nothing in a style sheet"),
    ("--start click -o o.xml", "start: changes nothing in an Android vector drawable"),
    ("--start click -o o.gif", "start: changes nothing in moving pictures"),
    ("--keyframes 9 -o o.mjs", "keyframes: changes nothing in a JavaScript module"),
    ("--keyframes 9 -o o.html", "keyframes: changes nothing in a page"),
    ("--keyframes 9 -o o.gif", "keyframes: changes nothing in moving pictures"),
    ("--precision 3 -o o.mp4", "precision: changes nothing in moving pictures"),
    ("--css d -o o.svg", "css: changes nothing in an animated SVG; it is for .css"),
    ("--fps 30 -o o.svg", "fps: changes nothing in an animated SVG"),
    ("--fps 30 -o o.lottie", "fps: changes nothing in a packed Lottie animation"),
    ("--size 300 -o o.json", "size: changes nothing in a Lottie animation"),
    ("--background #fff -o o.svg", "background: changes nothing in an animated SVG"),
    # What an SVG without a script cannot wait for.
    ("--start scroll -o o.svg", "scroll"),
    ("--start drag -o o.svg", "drag"),
    ("--start seen -o o.svg", "seen"),
    # What there is no format for, or no place.
    ("-o o.riv", "a movement is written as .svg, .webp"),
    ("-o o.pdf", "a movement is written as .svg, .webp"),
    ("-o o", "a movement is written as .svg, .webp"),
    ("-o no/o.json", "there is no folder"),
    ("-o a.svg", "is an input"),
    ("-o o.mjs --report o.mjs", "is written twice"),
    # What a format cannot hold.
    ("morph line.svg bent.svg -o o.css", "one with a line; expected -o OUT.svg or OUT.mjs"),
    ("morph two.svg other.svg -o o.css", "expected -o OUT.svg or OUT.mjs"),
    ("morph two.svg other.svg line.svg -o o.css", "expected -o OUT.svg or OUT.mjs"),
)


def test_there_are_forty_of_them() -> None:
    assert len(REFUSED) >= 40


@pytest.mark.parametrize(("line", "says"), REFUSED, ids=[line for line, _ in REFUSED])
def test_it_is_one_line_and_nothing_is_written(
    run: Command, tmp_path: Path, line: str, says: str
) -> None:
    for name, content in DRAWINGS.items():
        (tmp_path / name).write_text(svg(content), "utf-8")
    assert TRIANGLE in (tmp_path / "b.svg").read_text("utf-8")
    command = line if line.startswith("morph ") else f"morph a.svg b.svg {line}"
    assert_refused(run, command, says)
    for name in re.findall(r"\bo(?:\.\w+)?$", line):  # where a file is, it stays
        (tmp_path / name).write_text("as it was", "utf-8")
        assert_refused(run, command, says)


@pytest.mark.parametrize(
    ("line", "says"),
    [*REFUSED[::12], ("morph a.svg none.svg -o o.svg", "none.svg: there is no such file")],
    ids=lambda value: value,
)
def test_so_it_is_in_a_process_of_its_own(tmp_path: Path, line: str, says: str) -> None:
    for name, content in {"a.svg": SQUARE, "b.svg": TRIANGLE, **DRAWINGS}.items():
        (tmp_path / name).write_text(svg(content), "utf-8")
    (tmp_path / "o.svg").write_text("as it was", "utf-8")
    before = listing(tmp_path)
    command = line if line.startswith("morph ") else f"morph a.svg b.svg {line}"
    ended = subprocess.run(
        [sys.executable, "-m", "shapetween", *command.split()],
        cwd=tmp_path,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
        capture_output=True,
        text=True,
        check=False,
        timeout=120,
    )
    assert ended.returncode == 2
    assert not ended.stdout
    assert ended.stderr.startswith("shapetween: error: ")
    assert ended.stderr.count("\n") == 1
    assert says in ended.stderr
    assert listing(tmp_path) == before


@pytest.mark.parametrize("ending", [".svg", ".json", ".lottie", ".css", ".xml", ".mjs", ".html"])
def test_what_fails_while_it_is_written_leaves_the_old_file(
    run: Command, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, ending: str
) -> None:
    (tmp_path / f"o{ending}").write_text("as it was", "utf-8")

    def failing(*_: object, **__: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(Path, "replace", failing)
    monkeypatch.setattr("os.replace", failing)
    assert_refused(run, f"morph a.svg b.svg -o o{ending}", "no space left")
    assert (tmp_path / f"o{ending}").read_text("utf-8") == "as it was"
    assert not list(tmp_path.glob(".*")), "a scratch file was left"
