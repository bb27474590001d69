"""The command line of batches: tables, folders, what is said, and being interrupted."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from tests.cli.commands import SQUARE, TRIANGLE, Command, listing, svg

#: Pairs of a batch that is to be interrupted.
COUNT = 150
OUT = {"out/a-to-b.svg", "out/summary.csv", "out/summary.json"}


@pytest.fixture
def table(tmp_path: Path) -> Path:
    """A table in a folder of its own, of one pair that is above it."""
    (tmp_path / "in").mkdir()
    path = tmp_path / "in/pairs.csv"
    path.write_text("a,b\n../a.svg,../b.svg\n", "utf-8")
    return path


def test_paths_are_relative_to_the_table(run: Command, table: Path) -> None:
    result = run("batch in/pairs.csv -o out -j 1")
    assert (result.code, result.err) == (0, "")
    assert result.out == "wrote 1 pairs and their summary to out\n"
    assert result.made == OUT


def test_options_of_all_and_of_a_row(run: Command, table: Path, tmp_path: Path) -> None:
    table.write_text(
        "a,b,out,duration,pin,easing\n"
        '../a.svg,../b.svg,x.svg,3.5,"1,1:2,2 9,1:18,2",ease-in\n'
        "../a.svg,../b.svg,y.svg,,,\n",
        "utf-8",
    )
    assert run("batch in/pairs.csv -o out -j 1 --duration 7 --loop alternate").code == 0
    x, y = ((tmp_path / "out" / name).read_text("utf-8") for name in ("x.svg", "y.svg"))
    run("morph a.svg b.svg -o y.svg --duration 7 --loop alternate")
    line = "--duration 3.5 --loop alternate --easing ease-in --pin 1,1:2,2 --pin 9,1:18,2"
    run(f"morph a.svg b.svg -o x.svg {line}")
    assert x == (tmp_path / "x.svg").read_text("utf-8")
    assert y == (tmp_path / "y.svg").read_text("utf-8")


def test_the_summary_does_not_replace_the_table(run: Command, tmp_path: Path) -> None:
    (tmp_path / "summary.csv").write_text("a,b\na.svg,b.svg\n", "utf-8")
    result = run("batch summary.csv -o . -j 1")
    assert result.code == 2
    assert "summary.csv: is an input" in result.err
    assert not result.made
    assert run("batch summary.csv -o out -j 1 --folds allow").made == OUT


def test_folders(run: Command, tmp_path: Path) -> None:
    assert run("batch --all-in . -o out -j 1 --folds allow").made == OUT
    (tmp_path / "c_a.svg").write_text(svg(SQUARE), "utf-8")
    (tmp_path / "c_b.svg").write_text(svg(TRIANGLE), "utf-8")
    assert "out/c.svg" in run("batch --pairs-in . -o out -j 1 --folds allow").made


def test_a_pair_that_fails(run: Command, table: Path) -> None:
    table.write_text("a,b\n../a.svg,../b.svg\n../a.svg,none.svg\n", "utf-8")
    result = run("batch in/pairs.csv -o out -j 1")
    assert result.code == 2
    assert result.err == (
        "shapetween: error: 1 of 2 pairs failed, the first: in/none.svg: there is no such file; "
        "see out/summary.csv\n"
    )
    assert result.made == OUT


@pytest.mark.parametrize(
    ("line", "rows", "said"),
    [
        ("batch -o out", "", "expected one of PAIRS.csv, --pairs-in and --all-in"),
        ("batch in/pairs.csv --all-in . -o out", "", "expected one of PAIRS.csv"),
        ("batch in/pairs.csv", "", "'-o'"),
        ("batch none.csv -o out", "", "none.csv: there is no such file"),
        ("batch in/pairs.csv -o out -j 0", "", "'-j'"),
        ("batch in/pairs.csv -o out -j 2 --dask tcp://h:1", "", "--jobs counts processes"),
        ("batch in/pairs.csv -o out --dask here", "", "--dask: 'here' is no address such as tcp:"),
        ("batch in/pairs.csv -o out --easing swift", "", "swift"),
        ("batch in/pairs.csv -o out", "a,b,method\nx,y,arpa\n", "row 2, column method: 'arpa'"),
        ("batch in/pairs.csv -o out", "a,b,pin\nx,y,1:2\n", "row 2, column pin: '1:2' is not"),
        ("batch in/pairs.csv -o out", "a,b,easing\nx,y,swift\n", "row 2, column easing: "),
        ("batch in/pairs.csv -o out", "a,b,quads\nx,y,0\n", "row 2, column quads: '0' is not"),
        ("batch in/pairs.csv -o out", "a,b,sped\nx,y,0\n", "row 1, column sped: not known"),
    ],
)
def test_what_is_wrong_is_said_in_a_line(
    run: Command, table: Path, line: str, rows: str, said: str
) -> None:
    if rows:
        table.write_text(rows, "utf-8")
    result = run(line)
    assert (result.code, result.out, result.made) == (2, "", frozenset())
    assert result.err.count("\n") == 1
    assert said in result.err


def test_dask_is_missing_or_does_not_answer(run: Command, table: Path) -> None:
    result = run("batch in/pairs.csv -o out --dask tcp://127.0.0.1:9")
    assert result.code == 2
    assert "shapetween[cluster]" in result.err or "no cluster answers" in result.err
    assert result.err.count("\n") == 1


@pytest.mark.skipif(os.name != "posix", reason="signals to a group of processes")
def test_ctrl_c_ends_cleanly_and_resume_goes_on(run: Command, tmp_path: Path) -> None:
    for name, d in (("c", "M1 1H9"), ("d", "M1 1V9")):
        drawing = svg(f'<path fill="none" stroke="#000" d="{d}"/>')
        (tmp_path / f"{name}.svg").write_text(drawing, "utf-8")
    rows = [f"c.svg,d.svg,{k:03}.svg,{k + 1}" for k in range(COUNT)]
    (tmp_path / "pairs.csv").write_text("\n".join(["a,b,out,duration", *rows]) + "\n", "utf-8")
    assert run("batch pairs.csv -o whole -j 1").code == 0
    before = 0
    for stop in (os.killpg, os.kill, None):  # as a terminal does it, the first process alone
        batch = started("batch pairs.csv -o out -j 2 --resume")
        if stop is not None:
            deadline = time.monotonic() + 60
            while len(list(tmp_path.glob("out/*.svg"))) <= before and time.monotonic() < deadline:
                time.sleep(0.01)
            stop(batch.pid, signal.SIGINT)
        try:
            _, said = batch.communicate(timeout=60)
        finally:
            batch.kill()
        if stop is not None:
            first, *_, last = said.splitlines()
            assert "pairs done; --resume goes on" in first
            assert last == "shapetween: stopped"
        assert "Traceback" not in said
        assert batch.returncode == (0 if stop is None else 130)
        before = len(list(tmp_path.glob("out/*.svg")))
    assert listing(tmp_path / "whole") == listing(tmp_path / "out")


def started(line: str) -> "subprocess.Popen[str]":
    """A command line as a process that leads a group of its own."""
    return subprocess.Popen(
        [sys.executable, "-m", "shapetween", *line.split()],
        env={**os.environ, "PYTHONPATH": str(Path(__file__).resolve().parents[2])},
        stderr=subprocess.PIPE,
        text=True,
        # A test run in the background has Ctrl-C ignored, and its children with it.
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
        start_new_session=True,
    )


def test_a_page_of_all_pairs_is_written_where_it_is_asked_for(run: Command, table: Path) -> None:
    assert "out/index.html" not in run("batch in/pairs.csv -o out -j 1").made
    assert run("batch in/pairs.csv -o out -j 1 --resume --page").made == {"out/index.html"}
