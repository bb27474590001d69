"""Lines are cut where what they lie on changes, and only there."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np
import pytest

from shapetween.attach.planes import AffinePlane
from shapetween.elastic import sharing
from shapetween.elastic.flow import Flow, Lane
from shapetween.elastic.sharing import share_lines
from shapetween.geometry.bezier import curve_lengths, evaluate
from shapetween.model.drawing import Shape
from shapetween.model.outline import Outline
from shapetween.outline.body import Carried
from tests.drawings import drawing, line, square
from tests.elastic.whole import prepare_elastic

BOX = square(0, 0, 100).curves.reshape(-1, 2)


class _Body(Carried):
    """Stands for a silhouette that rests; nothing is asked of it."""

    def __init__(self) -> None:
        pass


FLOW = Flow((Lane(AffinePlane(np.eye(2, 3), np.zeros(2)), (BOX, BOX)),), (_Body(),))


def round_line(*corners: tuple[float, float], name: str = "") -> Shape:
    shape = line(*corners, name=name)
    assert shape.style.stroke is not None
    stroke = replace(shape.style.stroke, cap="round", join="round")
    return replace(shape, style=replace(shape.style, stroke=stroke))


class Shared(NamedTuple):
    first: tuple[Shape, ...]
    second: tuple[Shape, ...]
    settled: tuple[tuple[int, int], ...]


def shared(first: list[Shape], second: list[Shape], **options: list[tuple[int, int]]) -> Shared:
    return Shared(*share_lines(first, second, FLOW, options.get("settled", [])))


def lengths(shapes: tuple[Shape, ...]) -> list[float]:
    return [round(float(sum(curve_lengths(r.curves).sum() for r in s.rings))) for s in shapes]


BACK = round_line((0, 50), (100, 50))
PARTS = [round_line((0, 51), (40, 51)), round_line((100, 49), (60, 49))]


def test_one_line_along_several_is_cut_where_they_end() -> None:
    found = shared([BACK], PARTS)
    assert len(found.first) == 3
    assert found.second == tuple(PARTS)
    assert set(found.settled) == {(0, 0), (2, 1)}
    np.testing.assert_allclose(lengths(found.first), [40, 20, 40], atol=3)


def test_the_other_way_round_too() -> None:
    found = shared(PARTS, [BACK])
    assert (found.first, len(found.second)) == (tuple(PARTS), 3)
    assert set(found.settled) == {(0, 0), (1, 2)}


def test_pieces_are_the_line() -> None:
    """Joined again they are its own curves, one after another."""
    found = shared([BACK], PARTS)
    curves = np.concatenate([shape.rings[0].curves for shape in found.first])
    np.testing.assert_array_equal(curves[1:, 0], curves[:-1, 3])
    np.testing.assert_array_equal(curves[[0, -1], [0, 3]], BACK.rings[0].curves[[0, -1], [0, 3]])


def test_a_ring_is_cut_as_well() -> None:
    ring = Shape((square(10, 10, 80),), BACK.style)
    parts = [round_line((10, 10), (90, 10), (90, 90)), round_line((90, 90), (10, 90), (10, 10))]
    found = shared([ring], parts)
    assert len(found.first) == 2
    assert not any(shape.rings[0].closed for shape in found.first)
    assert set(found.settled) == {(0, 0), (1, 1)}


@pytest.mark.parametrize(
    "second",
    [
        [round_line((0, 52), (100, 52))],
        [round_line((0, 52), (80, 52))],
        [round_line((0, 20), (40, 20)), round_line((60, 80), (100, 80))],
        [round_line((20, 30), (20, 70)), round_line((80, 30), (80, 70))],
        [round_line((0, 52), (20, 52)), round_line((50, 0), (50, 100))],
    ],
    ids=["the same", "shorter", "elsewhere", "across", "little"],
)
def test_lines_that_share_all_or_little_stay_whole(second: list[Shape]) -> None:
    found = shared([BACK], second)
    assert (found.first, found.second, found.settled) == ((BACK,), tuple(second), ())


def styled(**changes: object) -> Shape:
    assert BACK.style.stroke is not None
    return replace(BACK, style=replace(BACK.style, stroke=replace(BACK.style.stroke, **changes)))  # type: ignore[arg-type]


@pytest.mark.parametrize(
    "seen",
    [
        styled(cap="butt"),
        styled(dashes=(3.0, 2.0)),
        replace(BACK, rings=BACK.rings * 2),
        replace(BACK, style=replace(BACK.style, opacity=0.5)),
    ],
)
def test_lines_whose_cuts_would_show_stay_whole(seen: Shape) -> None:
    assert shared([seen], PARTS).first == (seen,)


def test_what_the_user_or_a_name_settles_stays_whole() -> None:
    found = shared([BACK], PARTS, settled=[(0, 1)])
    assert (found.first, found.settled) == ((BACK,), ((0, 1),))
    named = replace(BACK, name="spine")
    assert shared([named], [replace(PARTS[0], name="spine"), PARTS[1]]).first == (named,)
    assert len(shared([named], PARTS).first) == 3


def test_settled_pairs_keep_their_shapes_behind_cut_lines() -> None:
    dot = round_line((90, 90), (91, 90))
    found = shared([BACK, dot], [*PARTS, dot], settled=[(1, 2)])
    assert (3, 2) in found.settled
    assert found.first[3] is dot


def test_without_a_silhouette_nothing_is_cut() -> None:
    assert share_lines([BACK], PARTS, replace(FLOW, bodies=()), [])[0] == (BACK,)


def test_too_many_lines_are_not_looked_at(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sharing, "MOST_STATIONS", 10)
    assert shared([BACK], PARTS).first == (BACK,)


def test_points_are_no_lines() -> None:
    point = Shape((Outline(np.full((1, 4, 2), 50.0), closed=False),), BACK.style)
    assert shared([BACK, point], PARTS).first[-1] is point


def test_the_ends_of_the_movement_are_the_drawings() -> None:
    roof = round_line((10, 50), (50, 10), (90, 50))
    walls = round_line((20, 45), (20, 90), (80, 90), (80, 45))
    hut = round_line((15, 90), (15, 50), (50, 12), (85, 50), (85, 90), (15, 90))
    movement = prepare_elastic(drawing(roof, walls), drawing(hut)).movement
    assert len(movement.parts) > 2
    t = np.linspace(0, 1, 201)
    for time, shapes in ((0.0, [roof, walls]), (1.0, [hut])):
        drawn = np.concatenate(
            [
                evaluate(part.curves(np.array([time]))[0], t).reshape(-1, 2)
                for part in movement.parts
                if (stroke := part.style(time).stroke) is not None and stroke.width > 0
            ]
        )
        wanted = np.concatenate(
            [evaluate(ring.curves, t).reshape(-1, 2) for s in shapes for ring in s.rings]
        )
        away = np.linalg.norm(drawn[:, None] - wanted, axis=2)
        assert away.min(axis=1).max() < 0.5
        assert away.min(axis=0).max() < 0.5
