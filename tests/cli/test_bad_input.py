"""What cannot be done is said in one line, with exit code 2, and nothing is written."""

import errno
import json
from pathlib import Path

import pytest

from shapetween.base.errors import OptionError
from tests.cli.commands import SQUARE, Command, svg

BOMB = (
    '<!DOCTYPE svg [<!ENTITY a "aaaaaaaaaa">'
    + "".join(f'<!ENTITY {b} "{f"&{a};" * 10}">' for a, b in zip("abcdefg", "bcdefgh", strict=True))
    + ']><svg xmlns="http://www.w3.org/2000/svg"><title>&h;</title></svg>'
)
EXTERNAL = (
    '<!DOCTYPE svg [<!ENTITY a SYSTEM "secret.txt">]>'
    '<svg xmlns="http://www.w3.org/2000/svg"><title>&a;</title></svg>'
)

#: A first drawing, and what the error says of it besides its name.
DRAWINGS = {
    "empty": ("", "empty"),
    "not-xml": ("a picture of a cat", "expected an SVG drawing"),
    "cut-off": (svg(SQUARE)[:-7], "line 1"),
    "another-kind-of-xml": ("<html><body/></html>", "svg"),
    "no-shape": (svg(""), "nothing that can be drawn; expected shapes with a fill"),
    "foreign-only": (svg("<foreignObject/>"), "foreign object"),
    "zero-area": (svg('<path d="M0 0 L5 5 L9 9Z"/>'), ""),
    "one-point": (svg('<path d="M5 5Z"/>'), "nothing that can be drawn"),
    "not-a-number": (svg('<path d="M0 0L NaN 3Z"/>'), "NaN"),
    "entity-bomb": (BOMB, "entit"),
    "external-entity": (EXTERNAL, "entit"),
}


def assert_refused(run: Command, line: str, *says: str) -> None:
    result = run(line)
    assert result.code == 2
    assert result.err.startswith("shapetween: error: ")
    assert result.err.count("\n") == 1
    assert len(result.err) < 500
    for text in says:
        assert text in result.err
    assert not result.made
    assert not result.out


@pytest.mark.parametrize("name", DRAWINGS)
@pytest.mark.parametrize("side", ["first", "second"])
def test_drawings_that_cannot_be_used(run: Command, tmp_path: Path, name: str, side: str) -> None:
    content, says = DRAWINGS[name]
    (tmp_path / "bad.svg").write_text(content, "utf-8")
    (tmp_path / "secret.txt").write_text("the secret", "utf-8")
    pair = "bad.svg b.svg" if side == "first" else "b.svg bad.svg"
    assert_refused(run, f"morph {pair}", "bad.svg", says)


@pytest.mark.parametrize(
    ("line", "says"),
    [
        ("morph none.svg b.svg", "none.svg: there is no such file"),
        ("morph a.svg .", ".: is a folder"),
        # Options that no drawing has any use for.
        ("morph a.svg b.svg --easing bouncy", "ease-in-out"),
        ("morph a.svg b.svg --method projektive", "did you mean projective"),
        ("morph a.svg b.svg --fit veiw", "did you mean view"),
        ("morph a.svg b.svg --folds zzz", "expected prevent, allow"),
        ("morph a.svg b.svg --loop forever", "--loop"),
        ("morph a.svg b.svg --quads 0", "--quads"),
        ("morph a.svg b.svg --quads many", "--quads"),
        ("morph a.svg b.svg --keyframes 1", "from 2 to 1000"),
        ("morph a.svg b.svg --keyframes 99999999", "from 2 to 1000"),
        ("morph a.svg b.svg --quads 2.5", "whole number from 1 to 10000"),
        ("morph a.svg b.svg --duration 0", "--duration"),
        ("morph a.svg b.svg --duration nan", "duration"),
        ("morph a.svg b.svg --duration inf", "duration"),
        ("morph a.svg b.svg --hold -1", "--hold"),
        ("morph a.svg b.svg --hold nan", "--hold"),
        ("morph a.svg b.svg -o x.gif --fps nan", "--fps': 'nan' is not a number from 0.01 to 240"),
        ("image a.png b.png --quads q.json --duration nan", "--duration"),
        ("image a.png b.png --quads q.json --max-megapixels nan", "--max-megapixels"),
        ("morph a.svg b.svg --precision -1", "--precision"),
        ("frames a.svg b.svg --frames 1", "--frames"),
        # Pins.
        ("morph a.svg b.svg --pin 1,1", "AX,AY:BX,BY"),
        ("morph a.svg b.svg --pin 1,1:2,x", "AX,AY:BX,BY"),
        ("morph a.svg b.svg --pin 1:1,2,2", "AX,AY:BX,BY"),
        ("morph a.svg b.svg --pin 1,1:nan,2", "finite"),
        ("morph a.svg b.svg --pin 5,5:10,2", "pin 1 (5,5"),
        ("morph a.svg b.svg --pin 1,1:2,2 --pin 99,1:2,2", "pin 2 (99,1"),
        # Places to write to.
        ("morph a.svg b.svg -o a.svg", "a.svg: is an input"),
        ("morph a.svg b.svg -o ./b.svg", "b.svg: is an input"),
        ("morph a.svg b.svg -o out.svg --report a.svg", "a.svg: is an input"),
        ("morph a.svg b.svg -o out.svg --report out.svg", "is written twice"),
        ("morph a.svg b.svg -o no/out.svg", "there is no folder"),
        (f"morph a.svg b.svg -o {'x' * 300}.svg", "file name too long"),
        ("morph a.svg b.svg -o .", "is a folder"),
        ("morph a.svg b.svg -o . --report report.json", "is a folder"),
        ("morph a.svg b.svg -o out.svg --report no/report.json", "there is no folder"),
        ("morph a.svg b.svg -o out.svg --report .", "is a folder"),
        ("morph a.svg b.svg -o out.mov", "out.mov: a movement is written as .svg, .webp"),
        ("morph a.svg b.svg -o -", "a movement is written as .svg"),
        ("frames a.svg b.svg -o a.svg", "a.svg: frames are written into a folder"),
        ("frames a.svg b.svg -o out.svg", "out.svg: frames are written into a folder"),
        ("mesh a.svg b.svg -o mesh.png", ".svg or .json"),
        ("gallery -o a.svg", "a.svg: is a file; expected a folder"),
        # Options that contradict each other, or would change nothing.
        ("morph a.svg b.svg -q -v", "--quiet and --verbose"),
        (
            "morph a.svg b.svg -o x.gif --keyframes 4",
            "keyframes: changes nothing in moving",
        ),
        (
            "morph a.svg b.svg -o x.gif --precision 4",
            "precision: changes nothing in moving",
        ),
        (
            "frames a.svg b.svg --png --precision 4",
            "precision: changes nothing in frames",
        ),
        ("mesh a.svg b.svg --over a.png --report x.json", "--report: changes nothing"),
        ("mesh q.json --over a.png --pin 1,1:1,1", "--pin: changes nothing"),
        # Meshes.
        ("morph a.svg b.svg --mesh none.json", "none.json: there is no such file"),
        ("morph a.svg b.svg --mesh a.svg", "a.svg: line 1, column 1: not JSON"),
        ("mesh a.svg b.svg --mesh a.svg -o a.svg", "a.svg: is an input"),
    ],
)
def test_command_lines_that_cannot_be_done(run: Command, line: str, says: str) -> None:
    assert_refused(run, line, says)


SOUND = {
    "source": [[1, 1], [9, 1], [9, 9], [1, 9]],
    "target": [[2, 2], [18, 2], [10, 17], [6, 9.5]],
    "triangles": [[0, 1, 3], [1, 2, 3]],
}
QUADS = {key: SOUND[key] for key in ("source", "target")}

#: A mesh, and what the error says of it.
MESHES: dict[str, tuple[object, str]] = {
    "not-an-object": ([1, 2], "expected"),
    "no-target": ({"source": SOUND["source"], "quads": [[0, 1, 2, 3]]}, "target"),
    "no-such-vertex": (QUADS | {"quads": [[0, 1, 2, 4]]}, "quads"),
    # Vertex 3 lies on a straight side of the triangle.
    "not-convex": (QUADS | {"quads": [[0, 1, 2, 3]]}, "not convex at vertex 3"),
    "wrong-way-round": (QUADS | {"quads": [[3, 2, 1, 0]]}, "clockwise"),
    "not-covering": (QUADS | {"triangles": [[0, 1, 3]]}, "vertex 2 belongs to no face"),
    "off-the-outline": (
        SOUND | {"source": [[1, 1], [8, 1], [8, 8], [1, 8]]},
        "from the outline",
    ),
    "for-a-shape-that-is-not-there": ({"meshes": [SOUND | {"id": "cat"}]}, "'cat'"),
    "too-large": (SOUND | {"source": [[1, 10**400], [9, 1], [9, 9], [1, 9]]}, "source[0][1]"),
    "not-a-number": (SOUND | {"source": [[1, float("nan")], [9, 1], [9, 9], [1, 9]]}, "NaN"),
}


@pytest.mark.parametrize("name", MESHES)
def test_meshes_that_do_not_fit(run: Command, tmp_path: Path, name: str) -> None:
    content, says = MESHES[name]
    (tmp_path / "mesh.json").write_text(json.dumps(content), "utf-8")
    assert_refused(run, "morph a.svg b.svg --mesh mesh.json", "mesh.json: ", says)


def test_a_mesh_drawn_by_hand_is_taken(run: Command, tmp_path: Path) -> None:
    """The same without a fault."""
    (tmp_path / "mesh.json").write_text(json.dumps(SOUND), "utf-8")
    assert run("morph a.svg b.svg --mesh mesh.json").code == 0


def test_a_self_crossing_outline_is_drawn_anew_and_named(run: Command, tmp_path: Path) -> None:
    (tmp_path / "eight.svg").write_text(svg('<path d="M1 1L9 9V1L1 8Z"/>'), "utf-8")
    result = run("morph eight.svg b.svg")
    assert result.code == 0
    assert result.err.startswith("shapetween: warning: eight.svg: an outline crosses itself near ")
    x, y = (float(v) for v in result.err.split("near ")[1].split(";")[0].split(", "))
    assert x == pytest.approx(5, abs=0.5)
    assert y == pytest.approx(5, abs=0.5)


def test_frames_do_not_replace_what_they_are_made_of(run: Command) -> None:
    assert run("frames a.svg b.svg -o made --frames 2").code == 0
    refused = "frames made/frame_0000.svg b.svg -o made"
    assert_refused(run, refused, "made/frame_0000.svg: is an input", "expected another folder")


@pytest.mark.parametrize("line", ["morph a.svg b.svg -o out.svg", "frames a.svg b.svg -o out"])
def test_a_failed_write_leaves_the_old_output(
    run: Command, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, line: str
) -> None:
    assert run(line).code == 0

    def full(*_: object, **__: object) -> int:
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(Path, "write_text", full)
    assert_refused(run, f"{line} --easing ease --report report.json", "no space left")
    assert not list(tmp_path.glob(".*")), "a scratch folder was left"


def test_what_fails_late_writes_nothing(run: Command, monkeypatch: pytest.MonkeyPatch) -> None:
    def failing(*_: object, **__: object) -> str:
        raise OptionError("cannot go on")

    monkeypatch.setattr("shapetween.formats.svg.smil_svg", failing)
    assert_refused(run, "morph a.svg b.svg --report report.json", "cannot go on")
