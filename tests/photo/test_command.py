"""The command line, on pictures that are drawn here."""

import json
import sys
from pathlib import Path

import numpy as np
import pytest

from shapetween.cli.main import main

Image = pytest.importorskip("PIL.Image")

BOARD_A = [[5.0, 6.0], [40.0, 3.0], [37.0, 30.0], [8.0, 25.0]]
BOARD_B = [[20.0, 15.0], [58.0, 20.0], [60.0, 44.0], [23.0, 40.0]]


@pytest.fixture
def place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with two pictures, quads, a mesh and drawings over the pictures."""
    rng = np.random.default_rng(2)
    for name in "ab":
        pixels = rng.integers(0, 256, (48, 64, 3), dtype=np.uint8)
        Image.fromarray(pixels).save(tmp_path / f"{name}.png")
    quads = {"quads": [{"id": "board", "a": BOARD_A, "b": BOARD_B}]}
    (tmp_path / "q.json").write_text(json.dumps(quads))
    square = [[0, 0], [64, 0], [64, 48], [0, 48]]
    mesh = {"source": [*square, [30, 20]], "target": [*square, [36, 28]], "triangles": []}
    mesh["triangles"] = [[k, (k + 1) % 4, 4] for k in range(4)]
    (tmp_path / "m.json").write_text(json.dumps(mesh))
    for name, corners in (("a", BOARD_A), ("b", BOARD_B)):
        points = " ".join(f"{x},{y}" for x, y in corners)
        (tmp_path / f"{name}.svg").write_text(
            '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 64 48">'
            f'<polygon id="board" points="{points}"/></svg>'
        )
    monkeypatch.chdir(tmp_path)
    return tmp_path


def run(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], line: str
) -> tuple[int, str]:
    """Exit code, and what was said on the error stream."""
    monkeypatch.setattr(sys, "argv", ["shapetween", *line.split()])
    with pytest.raises(SystemExit) as caught:
        main()
    code = caught.value.code
    assert isinstance(code, int)
    return code, capsys.readouterr().err


@pytest.mark.parametrize(
    "line",
    [
        "image a.png b.png --quads q.json -o out.webp --frames 5",
        "image a.png b.png --quads q.json -o out.png --frames 5 --loop alternate",
        "image a.png b.png --quads q.json -o out.gif --duration 0.2 --fps 20",
        "image a.png b.png --quads q.json -o out --frames 3 --size 32x40 --background #204060",
        "image a.png a.png --quads q.json -o out --frames 3 --background keep",
        "image a.png b.png --quads q.json -o out --frames 3 --background b.png --easing linear",
        "image a.png b.png --quads a.svg --quads b.svg -o out --frames 3",
        "image a.png b.png --mesh m.json -o out --frames 3 --method linear",
        "image a.png b.png --outlines a.svg b.svg -o out --frames 3",
        "mesh q.json --over a.png -o out.png",
        "mesh m.json --over a.png --over b.png -o out.png",
        "mesh a.svg b.svg --over a.png --over b.png -o out.png",
    ],
)
def test_what_works(
    place: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    line: str,
) -> None:
    assert run(monkeypatch, capsys, line) == (0, "")
    out = place / line.split("-o ")[1].split()[0]
    assert list(out.iterdir()) if out.is_dir() else out.stat().st_size > 100


def test_quads_from_drawings_are_those_from_json(
    place: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    for name, quads in (("json", "--quads q.json"), ("svg", "--quads a.svg --quads b.svg")):
        run(monkeypatch, capsys, f"image a.png b.png {quads} -o {name} --frames 3")
    for k in range(3):
        one, other = (place / name / f"frame_000{k}.png" for name in ("json", "svg"))
        assert one.read_bytes() == other.read_bytes()


def test_the_ends_are_the_pictures(
    place: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    run(monkeypatch, capsys, "image a.png b.png --quads q.json -o out --frames 4")
    for frame, picture in (("frame_0000", "a"), ("frame_0003", "b")):
        found, expected = place / "out" / f"{frame}.png", place / f"{picture}.png"
        with Image.open(found) as one, Image.open(expected) as other:
            assert (np.array(one) == np.array(other)).all()


def test_the_report(
    place: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    line = "image a.png b.png --quads q.json -o out --frames 3 --report r.json -q"
    run(monkeypatch, capsys, line)
    report = json.loads((place / "r.json").read_text())
    assert report["size"] == [64, 48]
    assert report["meshes"][0]["quads"] == 1
    assert report["meshes"][0]["slip"] == 0


def test_quads_outside_are_warned_of(
    place: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    beyond = [[x - 30, y] for x, y in BOARD_A]
    (place / "q.json").write_text(json.dumps({"quads": [{"id": "x", "a": beyond, "b": BOARD_B}]}))
    code, said = run(monkeypatch, capsys, "image a.png b.png --quads q.json -o out --frames 3")
    assert code == 0
    assert said == (
        "shapetween: warning: quad 'x' reaches beyond picture A; nothing is shown there\n"
    )


@pytest.mark.parametrize(
    ("line", "complaint"),
    [
        ("image a.png b.png", "expected one of --quads, --mesh or --outlines"),
        ("image a.png b.png --quads q.json --mesh m.json", "expected one of --quads"),
        ("image a.png none.png --quads q.json", "none.png: there is no such file"),
        ("image a.png q.json --quads q.json", "q.json: is not a picture"),
        ("image a.png b.png --quads none.json", "none.json: there is no such file"),
        ("image a.png b.png --quads m.json", "m.json: expected {"),
        ("image a.png b.png --quads a.svg", "expected one JSON, or two SVGs"),
        ("image a.png b.png --mesh q.json", "q.json: has no source"),
        ("image a.png b.png --quads q.json -o out.avi", "out.avi: expected an ending of"),
        ("image a.png b.png --quads q.json -o a.png", "a.png: is an input"),
        ("image a.png b.png --quads q.json -o no/out.png", "there is no folder"),
        ("image a.png b.png --quads q.json --size 0x3", "is neither WIDTHxHEIGHT"),
        ("image a.png b.png --quads q.json --size 99999x99999", "megapixels"),
        (
            "image a.png b.png --quads q.json --max-megapixels 0.001",
            "at most 0.001 megapixels",
        ),
        (
            "image a.png b.png --quads q.json --background mauv",
            "expected fill, dissolve, keep, a colour",
        ),
        ("image a.png b.png --quads q.json --easing jump", "easing 'jump'"),
        ("image a.png b.png --quads q.json --method arp", "did you mean arap?"),
        ("image a.png b.png --quads q.json --frames 3 --fps 2 --duration 9", "at most two"),
        ("image a.png b.png --quads q.json --fps 240 --duration 3600", "864000 frames"),
        ("mesh q.json", "Missing argument 'B'"),
        ("mesh q.json b.svg --over a.png", "--over: expected quads or a mesh in one JSON"),
        ("mesh q.json --over a.png -o out.svg", "out.svg: with --over the mesh is drawn as .png"),
    ],
)
def test_what_is_refused(
    place: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    line: str,
    complaint: str,
) -> None:
    before = sorted(place.iterdir())
    code, said = run(monkeypatch, capsys, line)
    assert code == 2
    assert said.startswith("shapetween: error: ")
    assert said.count("\n") == 1
    assert complaint in said
    assert sorted(place.iterdir()) == before
