"""The library's front door, on a pair that is quickly moved."""

import json
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import shapetween as st
from shapetween.base.errors import InputError, OptionError
from shapetween.mesh.file import load_meshes
from tests.cli.commands import SQUARE, TRIANGLE, svg
from tests.drawings import area, drawing, line, square


@pytest.fixture(scope="module")
def pair(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Path]:
    folder = tmp_path_factory.mktemp("pair")
    for name, content in (("a", svg(SQUARE)), ("b", svg(TRIANGLE, "0 0 20 20"))):
        (folder / f"{name}.svg").write_text(content, "utf-8")
    return folder / "a.svg", folder / "b.svg"


@pytest.fixture(scope="module")
def moved(pair: tuple[Path, Path]) -> st.Morph:
    return st.morph(*pair)


def test_frames_are_the_drawings_at_even_times(moved: st.Morph) -> None:
    frames = moved.frames(5)
    assert len(frames) == 5
    for frame, t in zip(frames, np.linspace(0, 1, 5), strict=True):
        curves = moved.at(float(t)).shapes[0].rings[0].curves
        np.testing.assert_allclose(frame.shapes[0].rings[0].curves, curves, atol=1e-12)
    with pytest.raises(OptionError, match=r"t: 2\.5 is not from 0 to 1"):
        moved.at(2.5)
    with pytest.raises(OptionError, match="not from 0 to 1"):
        moved.at(float("nan"))


def test_writing(moved: st.Morph, tmp_path: Path) -> None:
    moved.write(tmp_path / "out.svg", duration=3.0, loop="repeat")
    text = (tmp_path / "out.svg").read_text("utf-8")
    assert text == moved.svg(duration=3.0, loop="repeat")
    assert text != moved.svg()
    assert "animate" in moved._repr_html_()


def test_the_correspondence_is_told_in_each_drawings_own_units(tmp_path: Path) -> None:
    """The first and the last frame have these points where the drawings have them."""
    box = '<path d="M{0} {0}H{1}V{1}H{0}Z M{2} {2}V{3}H{3}V{2}Z"/>'
    for name, content in (
        ("a", svg(box.format(1, 9, 3, 6))),
        ("b", svg(box.format(20, 160, 60, 110), "0 0 200 200")),
    ):
        (tmp_path / f"{name}.svg").write_text(content, "utf-8")
    found = st.morph(tmp_path / "a.svg", tmp_path / "b.svg").correspondence
    assert [ring.hole for ring in found] == [False, True]
    for ring, (own, other) in zip(found, (((1, 9), (20, 160)), ((3, 6), (60, 110))), strict=True):
        assert len(ring.w) == len(ring.source) == len(ring.target)
        assert (np.diff(ring.w) > 0).all()
        for points, sides in ((ring.source, own), (ring.target, other)):
            np.testing.assert_allclose(
                [points.min(axis=0), points.max(axis=0)], np.c_[sides, sides]
            )


def test_a_mesh_goes_round(pair: tuple[Path, Path], moved: st.Morph) -> None:
    ((name, mesh),) = moved.meshes
    assert name == ""
    again = st.morph(*pair, mesh=mesh)
    ((_, kept),) = again.meshes
    assert len(kept.quads) == len(mesh.quads)
    assert again.report()["rings"][0]["found"] == "given"
    assert len(json.loads(moved.mesh_json())["quads"]) == len(mesh.quads)
    assert "<svg" in moved.mesh_svg()
    with pytest.raises(OptionError, match="pin 1,1: lies on a shape whose mesh says already"):
        st.morph(*pair, mesh=mesh, pins=[(1, 1, 2, 2)])


def test_meshes_of_several_pieces_go_round() -> None:
    """Pieces of one shape share its id; each gets its own mesh back, in order."""
    inputs = Path(__file__).resolve().parents[1] / "gallery" / "inputs"
    pair = inputs / "run.svg", inputs / "walk.svg"
    moved = st.morph(*pair, together=False)
    assert len(moved.meshes) > 1
    again = st.morph(*pair, mesh=load_meshes(moved.mesh_json(), "mesh.json"))
    for (_, first), (_, second) in zip(moved.meshes, again.meshes, strict=True):
        assert len(first.quads) == len(second.quads)
    assert all(ring["found"] == "given" for ring in again.report()["rings"])


def test_drawings_are_taken_as_they_are() -> None:
    first, second = drawing(area(square(10, 10, 40))), drawing(area(square(30, 30, 40)))
    found = st.morph(first, second, folds="allow", quads=4)
    assert found.warnings == ()
    middle = found.at(0.5).shapes[0].rings[0]
    np.testing.assert_allclose(middle.box, [[20, 20], [60, 60]], atol=1e-6)


@pytest.mark.parametrize("kind", [str, str.encode, lambda text: "\ufeff\n " + text])
def test_svg_itself_is_taken_as_text_and_as_bytes(
    kind: Callable[[str], str | bytes], pair: tuple[Path, Path], moved: st.Morph
) -> None:
    texts = [kind(path.read_text("utf-8")) for path in pair]
    again = st.morph(*texts)
    assert again.svg() == moved.svg()
    assert st.morph(texts[0], pair[1], pictures=True).svg() == moved.svg()
    assert st.chain([texts[0], texts[1], texts[0]]).closed
    with pytest.raises(InputError, match="SVG text: "):
        st.morph("<svg", texts[1])
    with pytest.raises(OptionError, match="expected a list"):
        st.chain(texts[0])  # type: ignore[arg-type]


def test_what_has_no_mesh_says_so() -> None:
    lines = drawing(line((0, 0), (50, 50)))
    found = st.morph(lines, lines)
    assert found.meshes == ()
    with pytest.raises(OptionError, match="there is no mesh"):
        found.mesh_json()


def test_the_picture_of_what_has_no_mesh_shows_who_becomes_whom() -> None:
    """Each number is that of the shape in its own file, as ``--match`` takes it."""
    lines = line((0, 0), (50, 50)), line((60, 0), (60, 50))
    there, back = drawing(*lines), drawing(*lines[::-1])
    text = st.morph(there, back).mesh_svg()
    assert "#1 becomes #2" in text
    assert "#2 becomes #1" in text
    apart = st.morph(there, back, matches=[("#1", ""), ("#2", "#1"), ("", "#2")]).mesh_svg()
    assert "#1 goes alone" in apart
    assert "#2 comes alone" in apart


def test_the_picture_of_parts_is_in_each_files_own_units() -> None:
    def two(size: int) -> str:
        squares = ("#d33", 0, 0), ("#33d", 60, 40)
        form = '<path fill="{0}" d="M{1} {2}h{3}v{3}h-{3}z"/>'
        paths = [form.format(c, x * size, y * size, 30 * size) for c, x, y in squares]
        return svg("".join(paths), f"0 0 {100 * size} {100 * size}")

    text = st.morph(two(1), two(10)).mesh_svg()
    ticks = re.findall(r'class="tick"[^>]*>([^<]*)', text)
    assert "50" in ticks
    assert "500" in ticks


def test_a_file_that_is_not_there_is_named() -> None:
    with pytest.raises(InputError, match=r"none\.svg: there is no such file"):
        st.morph("none.svg", "b.svg")


@pytest.mark.parametrize(
    ("options", "says"),
    [
        ({"method": "projektive"}, "method: 'projektive' is none of"),
        ({"fit": "veiw"}, "fit: 'veiw' is none of view, geometry, none"),
        ({"folds": False}, "folds: False is none of prevent, allow"),
        ({"quads": 0}, "quads: 0"),
        ({"pins": [(1, 2)]}, r"pin: \(1, 2\) is not \(ax, ay, bx, by\)"),
        ({"pins": [((1, 2), (3, 4))]}, r"is not \(ax, ay, bx, by\)"),
        ({"pins": [(1, 2, 3, float("inf"))]}, "finite"),
    ],
)
def test_options_that_are_none_are_refused(options: dict[str, Any], says: str) -> None:
    """Where no mesh is needed too, for lines alone."""
    lines = drawing(line((0, 0), (50, 50)))
    with pytest.raises(OptionError, match=says):
        st.morph(lines, lines, **options)


def test_what_a_prompt_shows_is_short(moved: st.Morph) -> None:
    assert repr(moved) == "Morph(method='projective')"
    assert len(repr(moved.at(0.5))) < 200


def test_public_names_are_there() -> None:
    assert set(st.__all__) <= set(dir(st))
    for name in st.__all__:
        assert getattr(st, name) is not None
    with pytest.raises(AttributeError, match="no attribute 'nope'"):
        st.nope  # noqa: B018
