"""Command lines that write movements as pictures."""

from pathlib import Path

import pytest

from tests.cli.commands import Command

pytest.importorskip("resvg_py")
Image = pytest.importorskip("PIL.Image")


@pytest.mark.parametrize("ending", ["webp", "png", "gif"])
def test_moving_pictures_by_their_ending(run: Command, tmp_path: Path, ending: str) -> None:
    result = run(
        f"morph a.svg b.svg -o out.{ending} --size 40 --duration .5 --fps 10 --loop repeat"
    )
    assert (result.code, result.out, result.err) == (0, f"wrote out.{ending}\n", "")
    with Image.open(tmp_path / f"out.{ending}") as found:
        assert found.n_frames == 5
        assert found.width == 40


def test_holding_and_going_back(run: Command, tmp_path: Path) -> None:
    line = "morph a.svg b.svg -o out.png --size 20 --duration .4 --fps 10 --hold .2"
    assert run(f"{line} --loop alternate --report r.json").made == {"out.png", "r.json"}
    with Image.open(tmp_path / "out.png") as found:
        assert found.n_frames == 3 + 2 + 3 + 2


def test_frames_as_png(run: Command, tmp_path: Path) -> None:
    result = run("frames a.svg b.svg -o out --png --size 30x20 --frames 3 --background white")
    assert result.made == {f"out/frame_{k:04}.png" for k in range(3)}
    with Image.open(tmp_path / "out" / "frame_0001.png") as found:
        assert (found.size, found.mode) == ((30, 20), "RGB")


@pytest.mark.parametrize(
    ("line", "told"),
    [
        (
            "morph a.svg b.svg --size 40",
            "size: changes nothing in an animated SVG; it is ",
        ),
        ("morph a.svg b.svg -o x.svg --fps 4", "fps: changes nothing in an animated SVG"),
        ("frames a.svg b.svg --size 40", "size: changes nothing in frames as SVG; it is for .png"),
        ("morph a.svg b.svg -o x.gif --fps 90", "GIF plays at most 50"),
        ("morph a.svg b.svg -o x.webp --background lilac-ish", "expected a colour such as #fff"),
        ("morph a.svg b.svg -o x.webp --size 99999", "expected at most 64 megapixels"),
    ],
)
def test_what_cannot_be_is_one_line(run: Command, line: str, told: str) -> None:
    result = run(line)
    assert result.code == 2
    assert told in result.err
    assert result.err.count("\n") == 1
    assert not result.made
