"""Boards that go over into each other in perspective, with all that is drawn on them."""

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np
import pytest

import shapetween as st
from shapetween.base.arrays import Points
from shapetween.geometry.bezier import evaluate
from shapetween.interpolate.base import Tween
from shapetween.interpolate.methods import tween
from shapetween.mesh.pair import MeshPair
from shapetween.model.drawing import Drawing, Shape
from shapetween.model.outline import Outline
from shapetween.model.paint import Colour
from shapetween.scene.boards import boards_between, find
from shapetween.scene.boards.quads import corners_of
from shapetween.scene.items import items_of
from shapetween.scene.motion.projected import pieces_between
from tests.drawings import area, drawing, line, ring, square
from tests.movements import circle

LIGHT, DARK, WOOD = Colour(0.95, 0.89, 0.76), Colour(0.66, 0.44, 0.25), Colour(0.36, 0.23, 0.12)

FLAT = np.array([[10.0, 10], [90, 10], [90, 90], [10, 90]])
STEEP = np.array([[32.0, 20], [68, 20], [96, 84], [4, 84]])
OBLIQUE = np.array([[20.0, 50], [50, 12], [85, 48], [54, 92]])


def onto(corners: Points) -> Callable[[Points], Points]:
    """The homography that takes the unit square to a quad, by the linear system of its entries."""
    unit = np.array([[0.0, 0], [1, 0], [1, 1], [0, 1]])
    rows, right = [], []
    for (x, y), (u, v) in zip(unit, corners, strict=True):
        rows += [[x, y, 1, 0, 0, 0, -u * x, -u * y], [0, 0, 0, x, y, 1, -v * x, -v * y]]
        right += [u, v]
    matrix = np.append(np.linalg.solve(np.array(rows), np.array(right)), 1.0).reshape(3, 3)

    def mapped(points: Points) -> Points:
        image = np.column_stack([points, np.ones(len(points))]) @ matrix.T
        return np.asarray(image[:, :2] / image[:, 2:])

    return mapped


def tile(x: float, y: float, side: float) -> Points:
    return np.array([[x, y], [x + side, y], [x + side, y + side], [x, y + side]])


def tiles(corners: Points, count: int = 4) -> list[Shape]:
    """Squares of two colours on a quad."""
    to = onto(corners)
    side = 1 / count
    return [
        area(ring(to(tile(i * side, j * side, side))), colour=(LIGHT, DARK)[(i + j) % 2])
        for i in range(count)
        for j in range(count)
    ]


def board(corners: Points, count: int = 4) -> Drawing:
    """A quad with squares of two colours."""
    return drawing(
        area(ring(corners), colour=WOOD), *tiles(onto(corners)(tile(0.05, 0.05, 0.9)), count)
    )


def corners_at(frame: Drawing) -> list[Points]:
    """Starts of all shapes' curves."""
    return [np.concatenate([r.curves[:, 0] for r in shape.rings]) for shape in frame.shapes]


@pytest.mark.parametrize("method", ["projective", "projective-2007", "arap", "linear"])
@pytest.mark.parametrize("target", [STEEP, OBLIQUE])
def test_all_of_a_board_lies_on_it_at_every_time(method: str, target: Points) -> None:
    moved = st.morph(board(FLAT), board(target), method=method)
    assert not moved.warnings
    for t in (0.0, 0.2, 0.5, 0.9, 1.0):
        frame = moved.at(t)
        assert len(frame.shapes) == 17
        whole, *rest = corners_at(frame)
        assert len(whole) == 4
        inner = onto(onto(whole)(tile(0.05, 0.05, 0.9)))
        got = np.concatenate(rest)
        # Any order, from any corner: each tile's corner has its place on the board.
        grid = np.stack(np.meshgrid(np.arange(5), np.arange(5)), axis=-1).reshape(-1, 2) / 4
        apart = np.linalg.norm(got[:, None] - inner(grid), axis=-1).min(axis=1)
        assert apart.max() < 1e-6


def test_both_ends_are_the_drawings() -> None:
    first, second = board(FLAT), board(OBLIQUE)
    moved = st.morph(first, second)
    for drawn, frame in ((first, moved.at(0)), (second, moved.at(1))):
        for own, shape in zip(drawn.shapes, frame.shapes, strict=True):
            here = {tuple(p) for p in np.round(shape.rings[0].curves[:, 0], 9)}
            assert {tuple(p) for p in np.round(own.rings[0].curves[:, 0], 9)} == here
            assert own.style.fill == shape.style.fill


def test_colours_say_which_way_a_board_turns() -> None:
    """By -40 degrees it would turn less, but to the other colours."""
    angle = np.deg2rad(50.0)
    rotation = np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
    turned = (FLAT - 50) @ rotation * 0.6 + 50
    corners = corners_at(st.morph(board(FLAT), board(turned)).at(0.5))[0] - 50
    ahead = np.rad2deg(np.arctan2(*(corners[1] - corners[0])[::-1]))
    assert float(np.mod(ahead, 180.0)) == pytest.approx(25.0, abs=0.1)


def test_tiles_without_a_board_move_as_one() -> None:
    moved = st.morph(drawing(*tiles(FLAT)), drawing(*tiles(STEEP)))
    frame = np.concatenate(corners_at(moved.at(0.5)))
    places = np.unique(np.round(frame, 6), axis=0)
    assert len(places) == 25  # corners that tiles share stay shared


def die(*faces: tuple[Points, int]) -> Drawing:
    """Quads with dots on them."""
    spots = {1: [(0.5, 0.5)], 2: [(0.25, 0.25), (0.75, 0.75)]}
    spots[4] = [(x, y) for x in (0.25, 0.75) for y in (0.25, 0.75)]
    spots[6] = [(x, y) for x in (0.25, 0.75) for y in (0.2, 0.5, 0.8)]
    shapes = []
    for n, (corners, count) in enumerate(faces):
        shapes.append(area(ring(corners), colour=Colour(0.9 - 0.1 * n, 0.9 - 0.1 * n, 0.8)))
        origin, ahead, down = corners[0], corners[1] - corners[0], corners[3] - corners[0]
        for x, y in spots[count]:
            dot = circle(np.array([x, y]), 0.1) @ np.stack([ahead, down]) + origin
            shapes.append(area(Outline(dot), colour=Colour(0.1, 0.1, 0.1)))
    return drawing(*shapes)


def faces(ridge: float, counts: tuple[int, int] = (4, 2)) -> Drawing:
    """Two faces of a die that meet in an upright edge."""
    left = np.array([[10.0, 30], [ridge, 45], [ridge, 95], [10, 70]])
    right = np.array([[ridge, 45.0], [90, 25], [90, 70], [ridge, 95]])
    left[3], right[2] = left[0] + left[2] - left[1], right[1] + right[3] - right[0]
    return die((left, counts[0]), (right, counts[1]))


def test_faces_that_share_an_edge_keep_it() -> None:
    moved = st.morph(faces(40.0), faces(65.0))
    for t in (0.1, 0.5, 0.8):
        frame = moved.at(t)
        left, right = (np.round(corners_at(frame)[k], 9) for k in (0, 5))
        shared = {tuple(p) for p in left} & {tuple(p) for p in right}
        assert len(shared) == 2


def test_dots_stay_round_on_their_face() -> None:
    moved = st.morph(faces(40.0), faces(65.0)).at(0.5)
    corners = corners_at(moved)[0]
    frame = np.stack([corners[1] - corners[0], corners[3] - corners[0]])
    for shape in moved.shapes[1:5]:
        local = (shape.rings[0].curves[:, 0] - corners[0]) @ np.linalg.inv(frame)
        radii = np.linalg.norm(local - local.mean(axis=0), axis=1)
        np.testing.assert_allclose(radii, 0.1, atol=0.004)


def test_what_only_one_board_has_comes_by_itself() -> None:
    """The faces go on as boards, and the dots that both have stay dots."""
    moved = st.morph(faces(40.0, (4, 4)), faces(65.0, (4, 4))).report()
    assert {part["reason"] for part in moved["parts"]} == {"kept"}
    more = board(STEEP)
    piece = area(Outline(circle(np.array([40.0, 60.0]), 6.0)), colour=Colour(0.8, 0.0, 0.0))
    shapes = (*more.shapes, piece)
    report = st.morph(board(FLAT), drawing(*shapes)).report()
    assert sum(part["reason"] == "kept" for part in report["parts"]) == 17
    assert [part["reason"] for part in report["parts"]][17:] == ["alone"]


def found(first: Sequence[Shape], second: Sequence[Shape]) -> int:
    """How many items are on boards."""
    sides = [items_of(tuple(shapes), "x")[0] for shapes in (first, second)]
    return len(boards_between(sides[0], sides[1], "projective"))


def test_boards_that_are_moved_and_scaled_need_no_quad() -> None:
    small = 0.5 * FLAT + (30, 10)
    assert found(board(FLAT).shapes, board(small).shapes) == 0
    by = find.TURNED
    for leaning, count in ((0.5 * by, 0), (2 * by, 17)):
        over = small.copy()
        over[:2, 0] += 40 * np.tan(leaning)  # its sides lean, as a card's do that is pushed
        assert found(board(FLAT).shapes, board(over).shapes) == count


def test_too_little_in_common_is_no_board() -> None:
    """Two tables with other things on them do not become each other with all that."""

    def table(corners: Points, common: int, own: int) -> list[Shape]:
        to = onto(corners)
        own_side = 0.1 if corners is FLAT else 0.7
        shared = [area(ring(to(tile(0.1 + 0.12 * k, 0.45, 0.08)))) for k in range(common)]
        other = [area(ring(to(tile(0.1 + 0.12 * k, own_side, 0.04)))) for k in range(own)]
        return [area(ring(corners), colour=WOOD), *shared, *other]

    assert found(table(FLAT, 5, 3), table(STEEP, 5, 3)) == 6  # 6 of 9
    assert found(table(FLAT, 4, 4), table(STEEP, 4, 4)) == 0  # 5 of 9


@pytest.mark.parametrize(("count", "on"), [(find.FEWEST, True), (find.FEWEST - 1, False)])
def test_few_tiles_are_no_board(count: int, *, on: bool) -> None:
    some = [(0.0, 0.0), (0.6, 0.1), (0.2, 0.7), (0.7, 0.6)][:count]
    first, second = ([area(ring(onto(q)(tile(*at, 0.2)))) for at in some] for q in (FLAT, STEEP))
    assert found(first, second) == on * count


def test_what_lies_beside_its_place_is_not_on_the_board() -> None:
    for off, count in ((1.3, 17), (2.6, 16)):
        shapes = list(board(STEEP).shapes)
        near = shapes[8].rings[0].curves + np.array([off, 0.0])
        shapes[8] = replace(shapes[8], rings=(Outline(near),))
        assert found(board(FLAT).shapes, shapes) == count


def test_other_outlines_and_colours_are_not_on_the_board() -> None:
    for rounded, count in ((0.1, 17), (0.9, 16)):
        shapes = list(board(STEEP, 4).shapes)
        corners = shapes[6].rings[0].curves[:, 0]
        # A tile with one corner cut off.
        cut = np.insert(
            corners[1:], 0, corners[0] + rounded * (corners[[3, 1]] - corners[0]), axis=0
        )
        shapes[6] = replace(shapes[6], rings=(ring(cut),))
        assert found(board(FLAT).shapes, shapes) == count
    for darker, count in ((0.1, 17), (0.2, 16)):
        shapes = list(board(STEEP).shapes)
        fill = Colour(LIGHT.red - darker, LIGHT.green - darker, LIGHT.blue - darker)
        k = next(k for k, shape in enumerate(shapes) if shape.style.fill == LIGHT)
        shapes[k] = replace(shapes[k], style=replace(shapes[k].style, fill=fill))
        assert found(board(FLAT).shapes, shapes) == count


def test_the_board_is_found_among_many_quads() -> None:
    """Also where the largest quads are no boards, and there are more items than are looked at."""
    wide = [area(square(0, 92 + k, 0.5 + k / 9)) for k in range(3)]
    assert found([*wide, *board(FLAT, 9).shapes], board(STEEP, 9).shapes) == 82


def test_curves_on_a_steep_board_follow_its_homography() -> None:
    boards = []
    turns = np.linspace(0, 2 * np.pi, 96, endpoint=False)
    around = 0.4 * np.column_stack([np.cos(turns), np.sin(turns)]) + 0.5
    for corners, disc in (
        (FLAT, Outline(circle(np.array([50.0, 50.0]), 32.0))),
        (STEEP, ring(onto(STEEP)(around))),
    ):
        boards.append(drawing(area(ring(corners), colour=WOOD), area(disc, colour=DARK)))
    frame = st.morph(*boards).at(0.7)
    # As good as the polygon that the second drawing has for a circle.
    got = evaluate(frame.shapes[1].rings[0].curves, np.linspace(0, 1, 5)).reshape(-1, 2)
    many = np.linspace(0, 2 * np.pi, 20_000)
    exact = onto(corners_at(frame)[0])(0.4 * np.column_stack([np.cos(many), np.sin(many)]) + 0.5)
    apart = np.linalg.norm(got[:, None] - exact, axis=-1).min(axis=1)
    assert apart.max() < 0.03


@pytest.mark.parametrize(("off", "corners"), [(0.6, 6), (1.2, 8)])
def test_corners_that_nearly_meet_are_one(
    off: float, corners: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Two faces that share an edge, but for what a drawing program rounds, are one mesh."""
    pairs = []

    def noted(pair: MeshPair, method: str) -> Tween:
        pairs.append(pair)
        return tween(pair, method)

    monkeypatch.setattr(find, "tween", noted)
    first, second = faces(40.0), faces(65.0)
    away = np.array([off, 0.0])
    apart = [
        replace(shape, rings=tuple(Outline(r.curves + away) for r in shape.rings))
        for shape in first.shapes[5:]
    ]
    assert found([*first.shapes[:5], *apart], second.shapes) == 8
    assert [len(pair.source) for pair in pairs] == [corners]


def test_corners_next_to_each_other_become_each_other_and_steps_are_kept() -> None:
    corners = np.array([[0.0, 0], [10, 0], [10, 10], [0, 10]])
    moved = corners + np.array([[0.1, 0.1], [-0.1, 0.1], [0.1, -0.1], [-0.1, 0.1]])
    identity = np.eye(3)
    assert len(pieces_between(ring(corners), ring(moved), identity).source) == 4
    notch = np.array([[4.0, 0], [4, 1], [5, 1], [5, 0]])
    notched = np.insert(corners, 1, notch, axis=0)
    for turned in (notched, np.roll(notched, 3, axis=0)):
        pieces = pieces_between(ring(notched), ring(turned + 0.01), identity)
        np.testing.assert_allclose(pieces.source, pieces.target, atol=0.03)
        assert len(pieces.source) == 8


def quad_item(points: Points, *, curved: float = 0.0) -> bool:
    outline = ring(points)
    curves = outline.curves.copy()
    side = curves[0, 3] - curves[0, 0]
    curves[0, 1:3] += curved * np.array([-side[1], side[0]])
    return corners_of(items_of((area(Outline(curves)),), "x")[0][0]) is not None


def test_what_is_a_quad() -> None:
    assert quad_item(FLAT)
    assert quad_item(STEEP)
    joint = np.insert(FLAT, 1, [[50.0, 10.0]], axis=0)
    assert quad_item(joint)  # a joint within a side
    assert quad_item(joint + np.array([[0, 0], [0, 0.1], [0, 0], [0, 0], [0, 0]]))
    assert not quad_item(joint + np.array([[0, 0], [0, 1.5], [0, 0], [0, 0], [0, 0]]))
    assert quad_item(FLAT, curved=1e-3)
    assert not quad_item(FLAT, curved=1e-2)
    assert not quad_item(np.array([[10.0, 10], [90, 10], [50, 30], [10, 90]]))  # not convex
    assert not quad_item(np.array([[10.0, 10], [90, 10], [52, 52], [10, 90]]))  # nearly a triangle
    assert quad_item(np.array([[10.0, 10], [90, 10], [54, 54], [10, 90]]))
    assert not quad_item(FLAT[:3])
    hole = area(ring(FLAT), square(40, 40, 10))
    assert corners_of(items_of((hole,), "x")[0][0]) is None
    stroke = items_of((line((0, 0), (9, 0), (9, 9)),), "x")[0][0]
    assert corners_of(stroke) is None
