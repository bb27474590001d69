"""Whole drawings: what becomes which, in what order it is painted, and what stays inside what."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from shapetween.base.arrays import Curves, Floats, Mask, Points
from shapetween.base.ends import End
from shapetween.base.errors import OptionError, OutlineError
from shapetween.fill.appearing import AppearingRegion
from shapetween.fill.track import FillTrack
from shapetween.geometry.bezier import evaluate, flatten, line_curves
from shapetween.model.drawing import Drawing, Shape
from shapetween.model.outline import Outline
from shapetween.model.paint import Colour, Stroke
from shapetween.pipeline import Options, Prepared, prepare
from shapetween.svg.read.reader import read_svg
from tests.drawings import area, drawing, line, ring, square
from tests.mesh.pairs import untangled
from tests.movements import circle

T = np.linspace(0, 1, 41)
RED, GREEN, BLUE = Colour(1, 0, 0), Colour(0, 1, 0), Colour(0, 0, 1)


def disc(x: float, y: float, radius: float) -> Outline:
    return Outline(circle(np.array([x, y]), radius))


def polygon(outline: Outline) -> shapely.Polygon:
    return shapely.Polygon(flatten(outline.curves, 48))


def shown(shape: Shape) -> shapely.Polygon:
    """What a filled shape covers, by the even-odd rule."""
    found = shapely.Polygon()
    for outline in shape.rings:
        part = shapely.make_valid(polygon(outline))
        found = found.symmetric_difference(part)
    return found


def same_area(first: Shape, second: Shape) -> float:
    """What only one of two shapes covers, as a share of the second."""
    other = shown(second)
    return float(shown(first).symmetric_difference(other).area / other.area)


def structure(frame: Drawing) -> list[tuple[str, list[tuple[int, bool]]]]:
    return [(s.name, [(len(r.curves), r.closed) for r in s.rings]) for s in frame.shapes]


@pytest.fixture(scope="module")
def ring_to_frame() -> Prepared:
    """A disc with a hole off its middle becomes a tall frame with a square hole."""
    first = area(disc(30, 40, 20), disc(36, 40, 8))
    second = area(ring([(50, 20), (80, 20), (80, 90), (50, 90)]), square(58, 60, 14))
    return prepare(drawing(first), drawing(second))


@pytest.fixture(scope="module")
def many() -> Prepared:
    """Pieces, holes, lines and newcomers all at once."""
    first = drawing(
        area(disc(50, 50, 40), colour=RED, name="back"),
        area(square(20, 20, 10), square(23, 23, 4), square(40, 20, 8), colour=GREEN, name="eyes"),
        line((10, 90), (50, 95), (90, 90), name="smile"),
    )
    second = drawing(
        area(square(12, 12, 70), colour=BLUE, name="back"),
        area(disc(26, 26, 6), colour=RED, name="eyes"),
        line((10, 90), (50, 80), (90, 90), name="smile"),
        area(square(45, 2, 5), name="comes"),
        line((5, 5), (5, 95), name="post"),
    )
    return prepare(first, second)


def test_a_hole_stays_inside_its_shape(ring_to_frame: Prepared) -> None:
    (part,) = ring_to_frame.movement.parts
    assert len(part.rings) == 2
    for frame in ring_to_frame.movement.at(T[1:-1]):  # at the ends curves of no length touch
        outer, hole = (polygon(r) for r in frame.shapes[0].rings)
        assert outer.is_valid
        assert hole.is_valid
        assert outer.contains(hole)
        assert hole.area > 100


def test_holes_run_against_their_shapes(ring_to_frame: Prepared) -> None:
    """So that any fill rule shows the same."""
    for frame in ring_to_frame.movement.at(T[::8]):
        outer, hole = frame.shapes[0].rings
        assert outer.area > 0 > hole.area


def test_one_structure_throughout(many: Prepared, ring_to_frame: Prepared) -> None:
    for prepared in (many, ring_to_frame):
        frames = prepared.movement.at(T)
        assert all(structure(frame) == structure(frames[0]) for frame in frames)


def test_both_ends_are_the_drawings_in_their_paint_order(many: Prepared) -> None:
    first, last = many.movement.at(np.array([0.0, 1.0]))
    for frame in (first, last):
        names = [shape.name for shape in frame.shapes]
        assert names == ["back", "eyes", "smile", "comes", "post"]
    back, eyes, _, comes, post = first.shapes
    assert back.style.fill == RED
    assert same_area(back, area(disc(50, 50, 40))) < 1e-3
    assert shown(eyes).area == pytest.approx(64 + 100 - 16)
    assert comes.style.opacity == post.style.opacity == 0
    back, eyes, _, comes, post = last.shapes
    assert back.style.fill == BLUE
    assert same_area(eyes, area(disc(26, 26, 6))) < 1e-3
    assert same_area(comes, area(square(45, 2, 5))) < 1e-9
    assert post.style.opacity == 1


def test_parts_say_at_which_end_they_exist(many: Prepared) -> None:
    ends = [(part.name, part.only) for part in many.movement.parts]
    assert ends == [
        ("back", None),
        ("eyes", None),
        ("smile", None),
        ("comes", End.TARGET),
        ("post", End.TARGET),
    ]


def test_shapes_without_a_partner_are_not_seen_where_they_are_not(many: Prepared) -> None:
    parts = {part.name: part for part in many.movement.parts}
    for name in ("comes", "post"):
        seen = [parts[name].style(t).opacity for t in (0.0, 0.1, 0.9, 1.0)]
        assert seen[:2] == [0.0, 0.0]
        assert seen[3] == 1.0
        assert seen[2] > 0.8
    # A line is drawn along itself, in its full width.
    late = parts["post"].curves(np.array([0.75]))
    assert 5 < np.ptp(late.reshape(-1, 2), axis=0).max() < 89
    assert {parts["post"].style(t).stroke.width for t in (0.1, 0.8)} == {2.0}  # type: ignore[union-attr]


def test_newcomers_stand_above_what_they_stand_above_and_what_disappears_stays_in_place() -> None:
    shapes = [area(square(10 * k, 10, 8), name=name) for k, name in enumerate("abcde")]
    few, all_five = drawing(shapes[1], shapes[3]), drawing(*shapes)
    for first, second, gone in ((few, all_five, 0.0), (all_five, few, 1.0)):
        movement = prepare(first, second, Options(folds="allow")).movement
        for frame in movement.at(T[::10]):
            assert [shape.name for shape in frame.shapes] == list("abcde")
        (frame,) = movement.at(np.array([gone]))
        for shape in frame.shapes:
            assert shape.style.opacity == (shape.name in "bd")


def test_a_hole_that_arrives_stays_inside_the_moving_body() -> None:
    """The body goes across the page and turns; the hole that opens in it is attached to it.

    One that closes has done so at half time.
    """
    bar = ring([(10, 10), (40, 10), (40, 20), (10, 20)])
    upright = ring([(70, 40), (80, 40), (80, 80), (70, 80)])
    hole = square(72, 70, 5)
    for first, second, times in (
        (area(bar), area(upright, hole), T[1:]),
        (area(upright, hole), area(bar), T[:-1]),
    ):
        prepared = prepare(drawing(first), drawing(second))
        for t, frame in zip(times, prepared.movement.at(times), strict=True):
            outer, inner = frame.shapes[0].rings
            assert polygon(outer).contains(polygon(inner))
            assert inner.area < 0 or (times[0] == 0 and t >= 0.5)


def test_names_matched_by_the_user() -> None:
    first = drawing(area(square(10, 10, 20), name="a"), area(square(60, 60, 20), name="b"))
    second = drawing(area(square(10, 10, 20), name="c"), area(square(60, 60, 20), name="d"))
    prepared = prepare(first, second, Options(matches=(("a", "d"), ("b", "c")), folds="allow"))
    last = {s.name: s for s in prepared.movement.at(np.array([1.0]))[0].shapes}
    assert same_area(last["a"], second.shapes[1]) < 1e-9
    assert same_area(last["b"], second.shapes[0]) < 1e-9


@pytest.mark.parametrize(
    ("matches", "says"),
    [
        ((("a", "z"),), "the second drawing has no shape 'z'; it has c, d"),
        ((("z", "c"),), "the first drawing has no shape 'z'; it has a"),
        ((("a", "c"), ("a", "d")), "a shape of the first drawing is matched twice"),
    ],
)
def test_names_that_cannot_be_matched(matches: tuple[tuple[str, str], ...], says: str) -> None:
    first = drawing(area(square(10, 10, 20), name="a"))
    second = drawing(area(square(10, 10, 20), name="c"), area(square(60, 60, 20), name="d"))
    with pytest.raises(OptionError, match=f"^match: {says}"):
        prepare(first, second, Options(matches=matches))


def test_a_stroke_becomes_an_area_through_its_outline() -> None:
    stroked = line((20, 50), (80, 50), width=10)
    prepared = prepare(drawing(stroked), drawing(area(square(30, 30, 40))))
    (part,) = prepared.movement.parts
    assert part.only is None
    first, last = prepared.movement.at(np.array([0.0, 1.0]))
    assert same_area(first.shapes[0], area(ring([(20, 45), (80, 45), (80, 55), (20, 55)]))) < 1e-6
    assert same_area(last.shapes[0], area(square(30, 30, 40))) < 1e-6
    assert part.style(0.0).fill == Colour()


def test_a_filled_line_is_filled_and_stroked() -> None:
    """The area is closed and the stroke is as it was drawn: two paths."""
    corner = line((20, 20), (80, 20), (50, 80))
    painted = replace(corner, style=replace(corner.style, fill=GREEN, stroke=Stroke(RED)))
    frames = prepare(drawing(painted), drawing(painted), Options(folds="allow")).movement.at(T[:2])
    filled, stroked = frames[0].shapes
    assert (filled.style.fill, filled.style.stroke) == (GREEN, None)
    assert stroked.style.fill is None
    assert [r.closed for r in (*filled.rings, *stroked.rings)] == [True, False]


def test_where_one_side_has_more_lines_they_are_drawn() -> None:
    one = line((20, 50), (80, 50))
    two = replace(one, rings=(*line((20, 48), (80, 48)).rings, *line((20, 70), (80, 70)).rings))
    for first, second, gone in ((one, two, 0.0), (two, one, 1.0)):
        pair, lone = prepare(drawing(first), drawing(second)).movement.parts
        assert (pair.only, lone.only) == (None, End.TARGET if first is one else End.SOURCE)
        assert pair.rings == lone.rings == (1,)
        assert lone.style(gone).opacity == 0
        (some,) = lone.curves(np.array([0.5 if gone == 0 else 0.25]))
        assert 10 < np.ptp(some.reshape(-1, 2), axis=0).max() < 55


def test_what_cannot_be_used_is_said() -> None:
    flat = area(ring([(0, 0), (50, 50), (99, 99)]))
    with pytest.raises(OutlineError, match="flat: the outline encloses no area"):
        prepare(drawing(flat), drawing(area(square(0, 0, 9))), names=("flat", "b"))
    same = drawing(area(square(0, 0, 9)))
    with pytest.raises(OptionError, match="pin 1"):
        prepare(same, same, Options(pins=((50.0, 50.0, 0.0, 0.0),)))
    with pytest.raises(OptionError, match="quads: 0"):
        Options(quads=0)
    with pytest.raises(OptionError, match="finite"):
        Options(pins=((0, 0, float("inf"), 0),))


def test_warnings_of_the_drawings_are_kept_once() -> None:
    plain = drawing(area(square(10, 10, 50)))
    said = replace(plain, warnings=("text was left out", "text was left out"))
    prepared = prepare(said, plain, Options(folds="allow"), names=("a.svg", "b.svg"))
    assert prepared.warnings == ("a.svg: text was left out",)


def outline_of(points: Points) -> Shape:
    return area(ring(20 + 60 * points))


@settings(max_examples=3)
@given(st.integers(0, 10_000), st.integers(3, 9), st.integers(3, 9))
def test_any_simple_polygons(seed: int, first: int, second: int) -> None:
    """Ends exact, one structure, all numbers finite and near; the in-betweens nearly all simple."""
    rng = np.random.default_rng(seed)
    a, b = (outline_of(untangled(rng, count)) for count in (first, second))
    prepared = prepare(drawing(a), drawing(b))
    frames = prepared.movement.at(T)
    assert all(structure(frame) == structure(frames[0]) for frame in frames)
    for frame, drawn in ((frames[0], a), (frames[-1], b)):
        assert same_area(frame.shapes[0], drawn) < 1e-6
    points = np.stack(
        [evaluate(f.shapes[0].rings[0].curves, T[::8]).reshape(-1, 2) for f in frames]
    )
    assert points.min() > -60
    assert points.max() < 160
    crossing = sum(not polygon(frame.shapes[0].rings[0]).is_valid for frame in frames[1:-1])
    assert crossing == 0 or any("crosses itself" in w for w in prepared.warnings)


def test_a_hole_that_crosses_itself_while_it_closes_is_told(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """A hole without counterpart is bound to the ambient mesh; outside it stays in place."""
    first = drawing(area(square(0, 0, 30), square(10, 10, 8).reversed()))
    second = drawing(area(square(0, 0, 30).transformed(np.array([[1, 0.2, 0], [0.4, 1, 0]]))))
    assert not any("ride" in w for w in prepare(first, second).warnings)
    there = AppearingRegion.curves

    def tied(self: AppearingRegion, t: Floats, vertices: Points | None = None) -> Curves:
        curves = there(self, t, vertices)
        inner = ((t > 0) & (t < 1))[:, None, None, None]
        swapped = line_curves(curves[:, :, 0][:, [0, 2, 1, 3]], curves[:, :, 0][:, [2, 1, 3, 0]])
        return np.asarray(np.where(inner, swapped, curves))

    monkeypatch.setattr(AppearingRegion, "curves", tied)
    told = "in the shape, attached parts cross themselves on the way"
    assert told in prepare(first, second).warnings
    assert told not in prepare(first, second, Options(folds="allow")).warnings


def test_rings_that_cross_themselves_in_a_drawing_of_several_parts_are_told(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    inputs = Path(__file__).parent.parent / "gallery" / "inputs"
    drawings = [
        read_svg((inputs / f"{name}.svg").read_bytes(), name) for name in ("horse", "kangaroo")
    ]
    first, second = (
        replace(one, shapes=(*one.shapes, area(disc(one.box.x, one.box.y, 2), colour=RED)))
        for one in drawings
    )
    prepared = prepare(first, second)
    assert prepared.scene is not None
    assert not any("cross" in warning for warning in prepared.warnings)
    assert prepared.scene.areas

    def tied(self: FillTrack, t: Floats) -> Mask:
        return np.ones(len(t), dtype=bool)

    monkeypatch.setattr(FillTrack, "crossing", tied)
    told = [notice for notice in prepare(first, second).notices if notice.kind == "crossing"]
    assert [str(notice) for notice in told] == [
        f"in 1 of {len(prepared.movement.parts)} shapes, attached parts cross themselves on the way"
    ]
    allowed = prepare(first, second, Options(folds="allow")).notices
    assert not any(notice.kind == "crossing" for notice in allowed)
