"""Command lines on a pair of drawings that work: what is written, and what is said."""

import errno
import json
import subprocess
import sys
from pathlib import Path

import click
import pytest

from shapetween.cli import options
from tests.cli.commands import Command, svg


def test_morph_names_its_output_after_the_pair(run: Command, tmp_path: Path) -> None:
    result = run("morph a.svg b.svg")
    assert (result.code, result.out) == (0, "wrote a-to-b.svg\n")
    assert result.made == {"a-to-b.svg"}
    text = (tmp_path / "a-to-b.svg").read_text("utf-8")
    assert "<animate" in text
    assert "script" not in text


def test_frames_and_mesh_name_theirs_too(run: Command) -> None:
    result = run("frames a.svg b.svg --frames 3")
    assert result.code == 0
    assert result.made == {f"a-to-b/frame_{k:04}.svg" for k in range(3)}
    assert run("mesh a.svg b.svg").made == {"a-to-b-mesh.svg"}


@pytest.mark.parametrize(
    "line",
    [
        "morph a.svg b.svg -o out.svg --duration 1.5 --easing ease-in-out --loop alternate",
        "morph a.svg b.svg -o out.svg --keyframes 5 --precision 2 --fit geometry --quads 4",
        "morph a.svg b.svg -o out.svg --folds allow --method linear",
        "morph a.svg b.svg -o out.svg --pin 1,1:2,2 --pin 9,1:18,2",
        "morph a.svg b.svg --out out.svg --method arap",
        "morph a.svg a.svg -o out.svg",
        "frames a.svg b.svg -o out --frames 2 --easing cubic-bezier(.2,0,.8,1)",
        "mesh a.svg b.svg -o out.svg",
    ],
)
def test_command_lines_that_work(run: Command, line: str) -> None:
    result = run(line)
    assert result.code == 0, result.err
    assert result.out == ("wrote out\n" if line.startswith("frames") else "wrote out.svg\n")
    assert result.made in ({"out.svg"}, {"out/frame_0000.svg", "out/frame_0001.svg"})


def test_the_same_bytes_twice(run: Command, tmp_path: Path) -> None:
    run("morph a.svg b.svg -o one.svg")
    run("morph a.svg b.svg -o two.svg")
    assert (tmp_path / "one.svg").read_bytes() == (tmp_path / "two.svg").read_bytes()


def test_a_report_says_how(run: Command, tmp_path: Path) -> None:
    result = run("morph a.svg b.svg --report report.json")
    assert result.made == {"a-to-b.svg", "report.json"}
    report = json.loads((tmp_path / "report.json").read_text("utf-8"))
    assert set(report) - {"seconds"} == {
        "version",
        "method",
        "rings",
        "parts",
        "riding",
        "warnings",
        "notices",
    }
    assert report["method"] == "projective"
    (ring,) = report["rings"]
    assert ring["quads"] >= 1
    assert ring["least_corner_sine"] > 0
    assert ring["self_crossing"]["found"] == 0
    assert {"read", "match", "mesh", "move", "write"} <= set(report["seconds"])
    assert all(value >= 0 for value in report["seconds"].values())


def test_verbose_says_it_and_quiet_says_nothing(run: Command, tmp_path: Path) -> None:
    loud = run("morph a.svg b.svg -v")
    assert json.loads(loud.err)["rings"]
    (tmp_path / "a.svg").write_text(svg('<path d="M1 1H9V9H1Z"/><foreignObject/>'), "utf-8")
    warned = run("morph a.svg b.svg")
    assert warned.err.startswith("shapetween: warning: a.svg: a foreign object was left out")
    assert warned.err.count("\n") == 1
    quiet = run("morph a.svg b.svg -q -o quiet.svg")
    assert (quiet.code, quiet.out, quiet.err) == (0, "", "")
    assert quiet.made == {"quiet.svg"}


def test_a_mesh_goes_round_through_its_file(run: Command, tmp_path: Path) -> None:
    """A mesh written as JSON, taken back, is the mesh: written again it has the same bytes."""
    assert run("mesh a.svg b.svg -o kept.json").code == 0
    kept = json.loads((tmp_path / "kept.json").read_text("utf-8"))
    used = run("morph a.svg b.svg --mesh kept.json -o used.svg --report report.json")
    assert used.code == 0, used.err
    report = json.loads((tmp_path / "report.json").read_text("utf-8"))
    assert report["rings"][0]["found"] == "given"
    assert report["rings"][0]["quads"] == len(kept["quads"])
    assert run("mesh a.svg b.svg --mesh kept.json -o again.json").code == 0
    again = json.loads((tmp_path / "again.json").read_text("utf-8"))
    for key in ("source", "target"):
        for here, there in zip(sorted(kept[key]), sorted(again[key]), strict=True):
            assert here == pytest.approx(there, abs=1e-6)


def test_a_mesh_is_in_each_files_own_units(run: Command, tmp_path: Path) -> None:
    run("mesh a.svg b.svg -o kept.json")
    kept = json.loads((tmp_path / "kept.json").read_text("utf-8"))
    assert max(x for point in kept["source"] for x in point) == pytest.approx(9, abs=1e-6)
    assert max(x for point in kept["target"] for x in point) == pytest.approx(18, abs=1e-6)


def test_compressed_drawings_are_read(run: Command, tmp_path: Path) -> None:
    import gzip

    (tmp_path / "c.svgz").write_bytes(gzip.compress((tmp_path / "a.svg").read_bytes()))
    assert run("morph c.svgz b.svg -o one.svg").code == 0
    run("morph a.svg b.svg -o two.svg")
    assert (tmp_path / "one.svg").read_bytes() == (tmp_path / "two.svg").read_bytes()


def test_what_is_repeated_here_without_importing_it_is_the_same() -> None:
    from shapetween.interpolate import METHODS

    assert set(options.METHOD_NAMES) == set(METHODS)


def test_a_drawing_goes_through_a_pipe(tmp_path: Path, run: Command) -> None:
    """What the shell calls ``shapetween morph a.svg b.svg -o /dev/stdout | less``."""
    root = str(Path(__file__).resolve().parents[2])
    line = [sys.executable, "-m", "shapetween", "morph", "a.svg", "b.svg", "-o", "/dev/stdout"]
    done = subprocess.run(
        line, cwd=tmp_path, env={"PYTHONPATH": root, "PATH": ""}, capture_output=True, check=True
    )
    run("morph a.svg b.svg -o file.svg")
    assert done.stdout == (tmp_path / "file.svg").read_bytes()


def test_a_full_disk_for_the_message_is_no_traceback(
    monkeypatch: pytest.MonkeyPatch, run: Command
) -> None:
    def full(text: str, err: bool = False) -> None:
        if not err:
            raise OSError(errno.ENOSPC, "No space left on device")
        sys.stderr.write(text + "\n")

    monkeypatch.setattr(click, "echo", full)
    result = run("morph a.svg b.svg -o out.svg")
    assert (result.code, set(result.made)) == (2, {"out.svg"})
    assert "out.svg is written, but standard output cannot be" in result.err


def test_without_an_error_stream(monkeypatch: pytest.MonkeyPatch, run: Command) -> None:
    """As in a program with windows that is started without any streams."""
    monkeypatch.setattr(sys, "stderr", None)
    assert run("morph a.svg b.svg -o out.svg").code == 0
