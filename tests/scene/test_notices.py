"""What is done with few parts, and not with many, is told; so is what is done another way."""

from pathlib import Path

import numpy as np
import pytest

import shapetween as st
from shapetween.base.errors import OutlineError
from shapetween.base.notices import Notice
from shapetween.scene import attachments, borders, features, items, likeness, limbs, movement
from shapetween.scene.cuts import lines
from shapetween.scene.kept import coinciding, drawings
from shapetween.scene.motion import choose
from shapetween.scene.strokes import outlined
from shapetween.scene.unmatched import part, presence

ICON = 'fill="none" stroke="#000" stroke-width="2"'
INPUTS = Path(__file__).resolve().parents[2] / "gallery/inputs"
SVG = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 24 24" {style}>{inner}</svg>'
DOT = '<circle cx="2" cy="2" r="1" fill="#f00"/>'
SOLID = '<path d="M3 3h18v12h-6v6h-6v-6h-6z"/>'
#: A check mark and an arrow's head, as areas.
CHECK = '<path d="M4 12l1.4-1.4L10 15.2 18.6 6.6 20 8 10 18z"/><path d="M2 21h20v1h-20z"/>'
HEAD = '<path d="M5 10l1.4-1.4L12 14.2l5.6-5.6L19 10l-7 7z"/><path d="M2 21h20v1h-20z"/>'


def told(tmp_path: Path, first: str, second: str, style: str = "") -> dict[str, Notice]:
    paths = []
    for name, inner in (("a.svg", first), ("b.svg", second)):
        paths.append(tmp_path / name)
        text = inner if inner.startswith("<svg") else SVG.format(style=style, inner=inner)
        paths[-1].write_text(text, "utf-8")
    return {notice.kind: notice for notice in st.morph(*paths).prepared.notices}


def test_icons_have_nothing_to_tell(tmp_path: Path) -> None:
    assert not told(tmp_path, CHECK, HEAD)
    assert not told(tmp_path, SOLID, SOLID + '<path fill="#fff" d="M5 5h3v3h-3z"/>')


@pytest.mark.parametrize("limit", ["MOST_AREAS", "MOST_CURVES"])
def test_areas_too_many_to_be_kept_in_part(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, limit: str
) -> None:
    monkeypatch.setattr(coinciding, limit, 0)
    notice = told(tmp_path, SOLID, SOLID + '<path d="M22 22h1v1h-1z"/>')["too-many-parts"]
    assert notice.severity == "note"
    assert "stays" in notice.message


def test_areas_too_many_to_be_looked_for_strokes(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(outlined, "MOST_AREAS", 0)
    assert "strokes" in told(tmp_path, CHECK, HEAD)["too-many-parts"].message


@pytest.mark.parametrize(
    ("module", "limit", "says"),
    [
        (features, "MOST_ITEMS", "faces"),
        (attachments, "MOST_ENDS", "end on"),
        (likeness, "MOST_LOOKED", "scaled"),
        (likeness, "MOST_ALIKE", "scaled"),
        (drawings, "MOST_RINGS", "slide"),
        (lines, "MOST", "along each other"),
    ],
)
def test_parts_too_many_for_what_is_done_with_few(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, module: object, limit: str, says: str
) -> None:
    drawn = '<path d="M4 5h16"/><path d="M4 12h16"/><path d="M4 19h8v-3"/>'
    moved = '<path d="M4 7h16"/><path d="M4 14h12"/><path d="M4 19h8v-5"/>'
    assert not told(tmp_path, drawn, moved, ICON)
    monkeypatch.setattr(module, limit, 0)
    notice = told(tmp_path, drawn, moved, ICON)["too-many-parts"]
    assert says in notice.message
    assert notice.severity == "note"


@pytest.mark.parametrize(
    ("module", "limit", "says"),
    [
        (borders, "MOST", "common borders"),
        (limbs, "MOST_ITEMS", "on bodies"),
        (outlined, "MOST_CURVES", "curves"),
        (drawings, "MOST_AREAS", "slash"),
    ],
)
def test_areas_too_many_for_what_is_done_with_few(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, module: object, limit: str, says: str
) -> None:
    halves = '<path d="M3 3h9v18h-9z"/><path fill="#f00" d="M12 3h9v18h-9z"/>'
    if module is drawings:
        halves = halves.replace('fill="#f00" ', "")
    moved = halves.replace("M12", "M11").replace("h9v18h-9", "h8v16h-8")
    assert not told(tmp_path, halves, moved)
    monkeypatch.setattr(module, limit, 0)
    assert says in told(tmp_path, halves, moved)["too-many-parts"].message


def test_a_stroke_whose_area_does_not_follow_its_line(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(outlined, "stroke_outline", lambda *_: None)
    notice = told(tmp_path, CHECK, HEAD)["stroke-outline"]
    assert "line of one width" in str(notice)
    assert notice.severity == "warning"


def test_a_stroke_that_goes_and_whose_area_does_not_follow_its_line(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(part, "stroked_leaving", lambda *_: None)
    bar = '<path d="M2 21h20v1h-20z"/>'
    found = told(tmp_path, CHECK, CHECK.replace(bar, "") + '<path d="M3 3h3v3h-3z"/>')
    assert "it shrinks" in str(found["stroke-outline"])


def test_an_outline_without_a_mesh_moves_by_its_corners(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def failing(*_: object) -> None:
        raise OutlineError("nothing is enclosed")

    monkeypatch.setattr(choose, "elastic", failing)
    leaf, monstera = (
        (INPUTS / f"{name}.svg").read_text("utf-8").replace("</svg>", DOT + "</svg>")
        for name in ("maple-leaf", "monstera-leaf")
    )
    notice = told(tmp_path, leaf, monstera)["by-corners"]
    assert notice.message == "nothing is enclosed"
    assert "corners" in notice.instead


def test_a_pair_that_has_no_mesh_for_the_report_is_told_there(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def failing(*_: object, **__: object) -> None:
        raise OutlineError("nothing is enclosed")

    monkeypatch.setattr(movement, "morph_fill", failing)
    square = '<path d="M5 5h3v3h-3z" fill="#fff"/>'
    for name, inner in (("a", SOLID + square), ("b", SOLID.replace("v12", "v9") + square)):
        (tmp_path / f"{name}.svg").write_text(SVG.format(style="", inner=inner), "utf-8")
    morph = st.morph(tmp_path / "a.svg", tmp_path / "b.svg")
    assert "no-mesh" not in {notice.kind for notice in morph.notices}
    told = [notice for notice in morph.report()["notices"] if notice["kind"] == "no-mesh"]
    assert told[0]["message"] == "nothing is enclosed"
    assert not morph.meshes


def test_what_is_outside_is_told_where_one_area_is_left(tmp_path: Path) -> None:
    beside = '<path d="M30 2v9" stroke="#000" stroke-width="2"/>'
    notices = told(tmp_path, SOLID + beside, SOLID.replace("v12", "v9"))
    assert notices["outside"].place.endswith("a.svg")


@pytest.mark.parametrize("end", [0, 1])
def test_what_is_outside_of_the_view_does_not_move(tmp_path: Path, end: int) -> None:
    """A second drawing beside the page would come into view as the first one shrinks."""
    beside = '<path d="M-20 2h12v20h-12z"/><path d="M30 2v9" stroke="#000" stroke-width="2"/>'
    sides = [SOLID, HEAD]
    sides[end] += beside
    notice = told(tmp_path, *sides)["outside"]
    assert (notice.severity, notice.message) == ("note", "2 shapes lie outside of the view")
    assert notice.place.endswith(("a.svg", "b.svg")[end])
    parts = st.morph(tmp_path / "a.svg", tmp_path / "b.svg").movements[0].parts
    points = np.concatenate([p.curves(np.linspace(0, 1, 5)).reshape(-1, 2) for p in parts])
    assert points.min() > -1
    assert points.max() < 25
    # What reaches into the view with its stroke is seen, and so is all of a drawing without a view.
    wide = SOLID + '<path d="M-.5 2v9" stroke="#000" stroke-width="2"/>'
    assert "outside" not in told(tmp_path, wide, HEAD)
    assert "outside" not in told(tmp_path, beside, HEAD)


def test_what_large_outlines_carry_is_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(presence, "MANY_CURVES", 4)
    moved = SOLID.replace("M3 3", "M3 4")
    assert not told(tmp_path, SOLID, moved)
    notice = told(tmp_path, SOLID, moved + '<path fill="#fff" d="M5 6h3v3h-3z"/>')["too-many-parts"]
    assert "carries" in notice.message
    assert notice.severity == "note"


def test_outlines_seen_by_fewer_places_are_told(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    moved = SOLID.replace("M3 3", "M3 4")
    monkeypatch.setattr(items, "MOST_CHORDS", 8 * items.CHORDS)
    assert not told(tmp_path, SOLID + DOT, moved + DOT)
    monkeypatch.setattr(items, "MOST_CHORDS", 7 * items.CHORDS)
    notice = told(tmp_path, SOLID + DOT, moved + DOT)["too-many-parts"]
    assert "fewer places" in notice.message
    assert notice.severity == "note"
