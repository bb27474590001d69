"""``shapetween compare`` from the command line."""

import json
from pathlib import Path

import pytest

from shapetween.interpolate import METHODS
from tests.cli.commands import Command


@pytest.mark.parametrize(
    ("out", "start"), [("out.html", "<!DOCTYPE html>"), ("out.svg", "<svg "), ("out.json", "{")]
)
def test_the_ending_says_what_is_written(run: Command, out: str, start: str) -> None:
    done = run(f"compare a.svg b.svg -o {out}")
    assert (done.code, done.out) == (0, f"wrote {out}\n")
    assert done.made == {out}
    assert Path(out).read_text("utf-8").startswith(start)


def test_without_a_name_it_is_a_page_named_after_both(run: Command) -> None:
    assert run("compare a.svg b.svg -q").made == {"a-to-b-compared.html"}


def test_the_figures_are_those_of_every_method(run: Command) -> None:
    run("compare a.svg b.svg -o out.json --report report.json")
    figures = json.loads(Path("out.json").read_text("utf-8"))
    assert list(figures["variants"]) == ["guarded-projective", *METHODS]
    assert len(figures["times"]) == len(figures["variants"]["arap"]["over_time"]["area"])
    assert json.loads(Path("report.json").read_text("utf-8"))["method"] == "projective"


def test_without_the_guard_only_the_methods_are_shown(run: Command) -> None:
    run("compare a.svg b.svg -o out.json --folds allow --method arap")
    assert list(json.loads(Path("out.json").read_text("utf-8"))["variants"]) == list(METHODS)


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ("compare a.svg b.svg -o out.png", "written as .html, .htm, .svg or .json"),
        ("compare a.svg b.svg --method projectiv", "did you mean projective?"),
        ("compare a.svg missing.svg", "missing.svg"),
        ("compare a.svg b.svg -o a.svg", "is an input"),
    ],
)
def test_what_cannot_be_done_is_one_line(run: Command, line: str, message: str) -> None:
    done = run(line)
    assert done.code == 2
    assert message in done.err
    assert done.err.count("\n") == 1
    assert not done.made
