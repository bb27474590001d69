"""``shapetween alternatives`` and ``--matching`` from the command line."""

import base64
import json
import re
from pathlib import Path

import pytest

from tests.cli.commands import Command, svg

HAND = '<path d="M2 9L1 5L2 1L3 5L4 1L5 5L6 1L7 5L6 9Z"/>'
CLAW = '<path d="M3 9L1 6L1 1L3 6L5 2L5 6L8 1L7 7L6 9Z"/>'


@pytest.fixture(autouse=True)
def drawings(run: Command) -> None:
    """Two drawings of few tips, which may become each other in many ways."""
    Path("hand.svg").write_text(svg(HAND), "utf-8")
    Path("claw.svg").write_text(svg(CLAW), "utf-8")


def test_the_page_shows_what_each_number_makes(run: Command) -> None:
    done = run("alternatives hand.svg claw.svg -o out.html --report report.json")
    assert (done.code, done.out) == (0, "wrote out.html\n")
    page = Path("out.html").read_text("utf-8")
    numbers = [int(k) for k in re.findall(r"<code>--matching (\d+)</code>", page)]
    assert numbers == [1, 2, 3, 4, 5, 6]
    assert not re.search(r"https?://(?!www\.w3\.org)", page)
    pictures = [
        base64.b64decode(data).decode("utf-8")
        for data in re.findall(r"data:image/svg\+xml;base64,([^\"]+)", page)
    ]
    assert len(set(pictures)) == len(numbers)
    run("morph hand.svg claw.svg -o third.svg --matching 3 --loop alternate --easing ease-in-out")
    assert pictures[2] == Path("third.svg").read_text("utf-8")
    (ring,) = json.loads(Path("report.json").read_text("utf-8"))["rings"]
    listed = ring["alternatives"]
    assert [entry["matching"] for entry in listed] == numbers
    assert listed[0]["cost"] == ring["matching"]["cost"]


def test_batches_take_a_number_a_row(run: Command) -> None:
    Path("pairs.csv").write_text(
        "a,b,out,matching\nhand.svg,claw.svg,one.svg,\nhand.svg,claw.svg,two.svg,2\n", "utf-8"
    )
    assert run("batch pairs.csv -o made -q").code == 0
    run("morph hand.svg claw.svg -o two.svg --matching 2")
    assert Path("made/two.svg").read_text("utf-8") == Path("two.svg").read_text("utf-8")
    assert Path("made/one.svg").read_text("utf-8") != Path("two.svg").read_text("utf-8")


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ("morph hand.svg claw.svg --matching 99", "matching: 99 is none; these outlines have"),
        ("morph hand.svg claw.svg --matching 2 --pin 2,1:1,1", "2 and pins exclude each other"),
        ("morph hand.svg claw.svg --matching 0", "--matching"),
        ("frames hand.svg claw.svg hand.svg --matching 2", "--matching: of which of the 2 legs?"),
        ("alternatives hand.svg claw.svg --matching 2", "all are shown; expected none here"),
        ("alternatives hand.svg claw.svg --pin 2,1:1,1", "pins say what becomes what"),
        ("alternatives hand.svg claw.svg -o out.svg", "written as .html or .htm"),
        ("alternatives hand.svg two.svg", "expected two drawings of one filled outline each"),
        ("morph hand.svg two.svg --matching 2", "expected drawings of one filled outline each"),
    ],
)
def test_what_cannot_be_done_is_one_line(run: Command, line: str, message: str) -> None:
    Path("two.svg").write_text(svg(HAND + '<path fill="red" d="M1 8H2V9H1Z"/>'), "utf-8")
    done = run(line)
    assert done.code == 2
    assert message in done.err
    assert done.err.count("\n") == 1
