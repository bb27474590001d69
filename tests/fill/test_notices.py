"""Every way around a difficulty is told, as data and as a warning."""

from collections.abc import Sequence
from types import ModuleType

import numpy as np
import pytest

from shapetween.base.errors import MeshError, OutlineError
from shapetween.base.notices import Notice
from shapetween.base.observe import unobserved
from shapetween.fill import morph
from shapetween.fill.morph import morph_fill
from shapetween.fill.settings import FillSettings
from shapetween.mesh import inner
from shapetween.model.drawing import Box, Drawing, Shape
from shapetween.model.outline import Outline
from shapetween.model.paint import Style
from shapetween.outline import body, unfold
from shapetween.pipeline import Options, prepare
from tests.drawings import ring, square

BOX = Box(0, 0, 100, 100)


def drawing(*rings: Outline) -> Drawing:
    return Drawing((Shape(rings, Style(fill_rule="evenodd"), "map"),), BOX)


def kinds(notices: Sequence[Notice]) -> list[str]:
    return [notice.kind for notice in notices]


def test_a_notice_is_one_line_and_data() -> None:
    notice = Notice("coarse", "matched coarsely", "a.svg: shape 'x'", "details go along")
    assert str(notice) == "a.svg: shape 'x': matched coarsely; details go along"
    assert notice.as_json()["kind"] == "coarse"
    assert str(Notice("other", "alone")) == "alone"


def test_a_plain_pair_has_nothing_to_tell() -> None:
    prepared = prepare(drawing(square(10, 10, 50)), drawing(square(20, 20, 60)))
    assert not prepared.notices
    assert not prepared.warnings


def test_a_bare_mesh_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    def failing(*_: object) -> None:
        raise MeshError("no mesh")

    monkeypatch.setattr(unfold, "ambient_mesh", failing)
    lean = ring([(10.0, 10), (70, 20), (60, 80), (20, 60)])
    meshed = Options(together=False)
    prepared = prepare(drawing(square(10, 10, 50)), drawing(lean), meshed)
    assert "bare-mesh" in kinds(prepared.notices)
    assert any("folding" in warning for warning in prepared.warnings)


def test_more_holes_than_are_matched_are_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(morph, "MOST_HOLES", 1)
    holes = [square(20 + 30 * k, 40, 15).reversed() for k in range(2)]
    moved = [square(22 + 30 * k, 44, 15).reversed() for k in range(2)]
    prepared = prepare(
        drawing(square(10, 10, 80), *holes),
        drawing(square(12, 10, 76), *moved),
        Options(together=False),
    )
    assert "too-many-holes" in kinds(prepared.notices)


def test_more_pieces_than_get_meshes_are_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(morph, "MOST_MESHED", 1)
    first = drawing(square(0, 0, 20), square(50, 50, 30))
    second = drawing(square(0, 5, 20), square(50, 45, 30))
    settings = FillSettings("projective", "prevent", None, np.zeros((0, 4)), [], unobserved)
    _, said = morph_fill(first.shapes[0], second.shapes[0], settings, ("a", "b"), alone=True)
    notices = {notice.kind: notice for notice in said}
    assert notices["too-many-pieces"].severity == "note"


def test_holes_that_cannot_be_matched_are_told(monkeypatch: pytest.MonkeyPatch) -> None:
    def failing(*_: object) -> None:
        raise OutlineError("too thin")

    monkeypatch.setattr(morph, "match_hole", failing)
    first = drawing(square(10, 10, 80), square(30, 30, 15).reversed())
    second = drawing(square(12, 10, 76), square(34, 30, 15).reversed())
    prepared = prepare(first, second, Options(together=False))
    assert "hole-alone" in kinds(prepared.notices)


@pytest.mark.parametrize(
    ("limit", "most", "kind"), [("MOST_TOGETHER", 1, "apart"), ("MANY_CURVES", 7, "one-setting")]
)
def test_less_care_of_many_pieces_or_curves_is_told(
    monkeypatch: pytest.MonkeyPatch, limit: str, most: int, kind: str
) -> None:
    monkeypatch.setattr(morph, limit, most)
    first = drawing(square(0, 0, 20), square(50, 50, 30))
    second = drawing(square(0, 5, 20), square(50, 45, 30))
    settings = FillSettings("projective", "prevent", None, np.zeros((0, 4)), [], unobserved)
    _, said = morph_fill(first.shapes[0], second.shapes[0], settings, ("a", "b"), alone=True)
    assert {notice.severity for notice in said if notice.kind == kind} == {"note"}


@pytest.mark.parametrize(
    ("module", "limit", "most", "says"),
    [(body, "MOST_POINTS", 8 * 8, "chords"), (inner, "MOST_VERTICES", 4, "not evened")],
)
def test_less_care_of_large_outlines_is_told(
    monkeypatch: pytest.MonkeyPatch, module: ModuleType, limit: str, most: int, says: str
) -> None:
    star = ring([(50, 5), (60, 40), (95, 50), (60, 60), (50, 95), (40, 60), (5, 50), (40, 40)])
    around = [
        (10, 10),
        (90, 10),
        (90, 90),
        (10, 90),
        (10, 30),
        (70, 30),
        (70, 70),
        (30, 70),
        (30, 50),
    ]
    back = [
        (50, 50),
        (50, 60),
        (60, 60),
        (60, 40),
        (20, 40),
        (20, 80),
        (80, 80),
        (80, 20),
        (10, 20),
    ]
    spiral = ring(around + back)
    meshed = Options(together=False)

    def told() -> list[Notice]:
        notices = prepare(drawing(star), drawing(spiral), meshed).notices
        return [each for each in notices if each.kind == "less-care"]

    assert not told()
    monkeypatch.setattr(module, limit, most)
    (notice,) = told()
    assert says in notice.message
    assert notice.severity == "note"
    assert notice.place
