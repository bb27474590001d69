"""Command lines with more than two drawings, and with rests; of bare meshes, which is quick."""

import json
import re
from pathlib import Path

import pytest

from tests.cli.commands import Command, listing, svg

INPUTS = Path(__file__).resolve().parents[2] / "gallery" / "inputs"


def length(text: str) -> float:
    """Seconds until the last animation ends for the first time."""
    ends = []
    for element in re.findall(r"<animate[^>]*>", text):
        found = dict(re.findall(r'\b(begin|dur)="([^"]*)s"', element))
        ends.append(float(found.get("begin", 0)) + float(found["dur"]))
    return max(ends)


def test_a_chain_is_one_file_named_after_all_of_it(run: Command, tmp_path: Path) -> None:
    result = run("morph a.svg b.svg a.svg --hold 0.5 --loop repeat --folds allow")
    assert (result.code, result.out) == (0, "wrote a-to-b-to-a.svg\n")
    assert result.made == {"a-to-b-to-a.svg"}
    text = (tmp_path / "a-to-b-to-a.svg").read_text("utf-8")
    assert length(text) == 5
    assert 'viewBox="0 0 10 10"' in text
    assert text.count('attributeName="display"') == 2


@pytest.mark.parametrize(
    ("line", "seconds"),
    [
        ("a.svg b.svg --duration 1.5 --hold 0.25", "1.75"),
        ("a.svg b.svg --duration 1.5 --hold 0.25 --loop alternate", "3.5"),
        ("a.svg b.svg a.svg --duration 1.5", "3"),
        # The first drawing by another name is another drawing, and rests too.
        ("a.svg b.svg c.svg --duration 1 --hold 0.5 --loop repeat", "3.5"),
        ("a.svg b.svg c.svg --duration 1 --hold 0.5 --loop alternate", "6"),
    ],
)
def test_how_long_it_lasts(run: Command, tmp_path: Path, line: str, seconds: str) -> None:
    (tmp_path / "c.svg").write_bytes((tmp_path / "a.svg").read_bytes())
    assert run(f"morph {line} -o out.svg --folds allow").code == 0
    assert length((tmp_path / "out.svg").read_text("utf-8")) == float(seconds)


def test_no_rest_is_what_it_always_was(run: Command, tmp_path: Path) -> None:
    run("morph a.svg b.svg -o one.svg --loop alternate --folds allow")
    run("morph a.svg b.svg -o two.svg --loop alternate --hold 0 --folds allow")
    assert (tmp_path / "one.svg").read_bytes() == (tmp_path / "two.svg").read_bytes()


def test_frames_of_a_chain(run: Command, tmp_path: Path) -> None:
    result = run("frames a.svg b.svg a.svg --frames 4 --easing ease --folds allow")
    assert result.made == {f"a-to-b-to-a/frame_{k:04}.svg" for k in range(7)}
    assert run("frames a.svg b.svg -o pair --frames 4 --easing ease --folds allow").code == 0
    chain, pair = (listing(tmp_path / name) for name in ("a-to-b-to-a", "pair"))
    assert {name: chain[name] for name in pair} == pair


def test_the_report_of_a_chain(run: Command, tmp_path: Path) -> None:
    assert run("morph a.svg b.svg a.svg --report report.json --folds allow").code == 0
    report = json.loads((tmp_path / "report.json").read_text("utf-8"))
    assert set(report) == {"version", "method", "legs", "warnings", "notices", "seconds"}
    ends = [(leg["from"], leg["to"]) for leg in report["legs"]]
    assert ends == [("a.svg", "b.svg"), ("b.svg", "a.svg")]
    assert all(leg["rings"][0]["quads"] >= 1 for leg in report["legs"])


@pytest.mark.parametrize("option", ["--mesh mesh.json", "--flip b"], ids=["mesh", "flip"])
def test_what_concerns_one_pair_is_refused(run: Command, option: str) -> None:
    for command in ("morph", "frames"):
        result = run(f"{command} a.svg b.svg a.svg {option}")
        assert result.code == 2
        name = option.split()[0]
        assert result.err.startswith(f"shapetween: error: {name}: concerns one pair, and here are")
        assert result.err.count("\n") == 1
        assert not result.made


def test_matches_and_matchings_of_a_leg(run: Command, tmp_path: Path) -> None:
    """What is said of a leg is what is said of it as a pair."""
    two = '<path id="p" d="M1 1h3v3h-3Z"/><path id="q" d="M5 5h4v4h-4Z"/>'
    (tmp_path / "two.svg").write_text(svg(two), "utf-8")
    (tmp_path / "other.svg").write_text(svg(two.replace("h3", "h2").replace("h4", "h3")), "utf-8")
    report = "morph two.svg other.svg two.svg --report r.json -o x.svg --match "
    assert run(report + "2/p:q --match 2/q:p --match 1/#1:#1").code == 0
    legs = json.loads((tmp_path / "r.json").read_text("utf-8"))["legs"]
    said = [
        {part["from"]["name"]: part["to"]["name"] for part in leg["parts"] if part["to"]}
        for leg in legs
    ]
    assert said == [{"p": "p", "q": "q"}, {"p": "q", "q": "p"}]
    horse, kangaroo = (INPUTS / f"{name}.svg" for name in ("horse", "kangaroo"))
    chain = f"morph {horse} {kangaroo} {horse} --folds allow --report r.json -o y.svg"
    assert run(f"{chain} --matching 2/3").code == 0
    legs = json.loads((tmp_path / "r.json").read_text("utf-8"))["legs"]
    pair = f"morph {kangaroo} {horse} --folds allow --report r.json -o y.svg"
    assert run(f"{pair} --matching 3").code == 0
    alone = json.loads((tmp_path / "r.json").read_text("utf-8"))
    assert legs[1]["rings"][0]["matching"] == alone["rings"][0]["matching"]
    assert legs[0]["rings"][0]["matching"] != alone["rings"][0]["matching"]


@pytest.mark.parametrize(
    ("option", "said"),
    [
        (
            "--match p:q",
            "--match: of which of the 2 legs? Expected it before, such as --match 1/p:q",
        ),
        ("--matching 2", "--matching: of which of the 2 legs?"),
        ("--matching 3/2", "--matching 3/...: there are 2 legs"),
        ("--matching 2/2 --matching 2/3", "--matching: 2 of leg 2; expected one"),
        ("--matching 2/x", "is not a number from 1 to 100, nor LEG/K"),
        ("--matching 2/0", "is not a number from 1 to 100, nor LEG/K"),
        ("--match 0/p:q", "is not IDA:IDB, such as tail:tail-fin, nor LEG/IDA:IDB"),
        ("--match 2/p", "is not IDA:IDB"),
    ],
)
def test_what_legs_there_are_is_said(run: Command, option: str, said: str) -> None:
    result = run(f"morph a.svg b.svg a.svg {option}")
    assert result.code == 2
    assert said in result.err
    assert result.err.count("\n") == 1
    assert not result.made


def test_no_drawing_of_a_chain_is_overwritten(run: Command) -> None:
    result = run("morph a.svg a.svg b.svg -o b.svg")
    assert result.code == 2
    assert "b.svg: is an input" in result.err
    assert not result.made


def test_matches_by_id_are_heard(run: Command) -> None:
    result = run("morph a.svg b.svg --match tail:fin")
    assert result.code == 2
    assert "match: the first drawing has no shape 'tail'" in result.err


def test_rests_in_a_batch(run: Command, tmp_path: Path) -> None:
    (tmp_path / "pairs.csv").write_text("a,b,hold\na.svg,b.svg,0.5\n", "utf-8")
    assert run("batch pairs.csv -o out -j 1 --loop alternate --folds allow").code == 0
    run("morph a.svg b.svg --hold 0.5 --loop alternate --folds allow")
    made = (tmp_path / "out/a-to-b.svg").read_bytes()
    assert made == (tmp_path / "a-to-b.svg").read_bytes()
