"""What a person expects of small pairs that once went wrong, each a test of its kind."""

from functools import lru_cache
from pathlib import Path

import numpy as np
import pytest
import shapely
import shapely.affinity

import shapetween as st
from shapetween.api import Morph
from shapetween.base.arrays import Points
from shapetween.geometry.bezier import flatten
from shapetween.model.drawing import Drawing, Shape
from shapetween.model.paint import Colour
from shapetween.scene.movement import SceneMovement

DATA = Path(__file__).resolve().parents[1] / "data" / "scene"
T = np.linspace(0, 1, 13)
STILL = 1e-6


@lru_cache
def morph(name: str) -> Morph:
    return st.morph(DATA / f"{name}.a.svg", DATA / f"{name}.b.svg")


def scene(name: str) -> SceneMovement:
    found = morph(name).prepared.scene
    assert found is not None
    return found


def frames(name: str, times: Points = T) -> tuple[Drawing, ...]:
    return morph(name).prepared.movement.at(times)


def seen(shape: Shape) -> shapely.Geometry:
    """What a shape covers."""
    style = shape.style
    parts = []
    for ring in shape.rings:
        points = np.concatenate([flatten(ring.curves, 12), ring.curves[-1:, 3]])
        if style.fill is not None:
            parts.append(shapely.make_valid(shapely.Polygon(points)))
        elif style.stroke is not None:
            parts.append(shapely.LineString(points).buffer(style.stroke.width / 2))
    if style.fill is None:
        return shapely.union_all(parts)
    whole = shapely.Polygon()
    for part in parts:
        whole = whole.symmetric_difference(part)
    return whole


def drawn(frame: Drawing, least: float = 0.05) -> shapely.Geometry:
    """Everything that can be seen."""
    return shapely.union_all([seen(s) for s in frame.shapes if s.style.opacity > least])


def like_mirror(geometry: shapely.Geometry, axis: float, *, level: bool = False) -> float:
    """Share that a geometry has in common with its mirror image."""
    matrix = [1, 0, 0, -1, 0, 2 * axis] if level else [-1, 0, 0, 1, 2 * axis, 0]
    image = shapely.affinity.affine_transform(geometry, matrix)
    return float(geometry.intersection(image).area / geometry.union(image).area)


def partners(name: str) -> dict[int, int]:
    return {role.first: role.second for role in scene(name).roles.pairs}


def moves(name: str, *, least: float) -> list[float]:
    """How far each part that is always seen goes, of those larger than some size."""
    found = []
    for part in morph(name).prepared.movement.parts:
        if part.style(0.0).opacity and part.style(1.0).opacity:
            curves = part.curves(T)
            if np.ptp(curves[0].reshape(-1, 2), axis=0).max() >= least:
                found.append(float(np.abs(curves - curves[0]).max()))
    return found


@pytest.mark.parametrize(
    ("name", "count"),
    [
        ("lock-body-bends-shackle-kinks", 1),
        ("plus-minus-shrinks-to-one-end", 1),
        ("wifi-identical-arc-not-paired", 2),
        ("unchanged-shape-dented-filled", 2),
        ("unchanged-shape-dented-line", 1),
        ("bell-off-slash-made-of-bell", 2),
    ],
)
def test_what_is_the_same_in_both_stands_still(name: str, count: int) -> None:
    box = morph(name).prepared.movement.box
    still = [move for move in moves(name, least=0.0) if move < 0.01 * box.width]
    assert len(still) >= count
    exact = [move for move in still if move < STILL * box.width]
    assert len(exact) >= count - (name.startswith("bell"))


@pytest.mark.parametrize(
    "name",
    ["bell-off-slash-made-of-bell", "unchanged-shape-dented-line", "wifi-identical-arc-not-paired"],
)
def test_a_slash_is_drawn_along_its_length(name: str) -> None:
    found = scene(name)
    slash = max(found.roles.appearing, key=lambda k: found.scenes[1].items[k].length)
    part = next(
        p
        for p in morph(name).prepared.movement.parts
        if p.style(0.0).opacity == 0
        and p.style(1.0).opacity == 1
        and np.allclose(p.curves(np.ones(1))[0], found.scenes[1].items[slash].outer.curves)
    )
    start = part.curves(np.array([0.62, 0.75, 0.9]))
    lengths = np.ptp(start.reshape(3, -1, 2), axis=1).max(axis=1)
    assert (np.diff(lengths) > 0).all()
    np.testing.assert_allclose(start[:, 0, 0], np.tile(start[0, 0, 0], (3, 1)))


@pytest.mark.parametrize("name", ["paint-ignored-bars-to-pie", "bars-to-pie-with-ids"])
def test_a_colour_that_both_have_once_is_evidence(name: str) -> None:
    found = scene(name)
    assert len(found.roles.pairs) == 5
    for role in found.roles.pairs:
        one, other = found.scenes[0].items[role.first], found.scenes[1].items[role.second]
        assert one.style.fill == other.style.fill


def test_shared_ids_settle_pairs_and_stay_in_the_view() -> None:
    name = "circles-to-map-overlap"
    found = scene(name)
    for role in found.roles.pairs:
        one, other = found.scenes[0].items[role.first], found.scenes[1].items[role.second]
        assert one.name == other.name
    for frame in frames(name):
        x0, y0, x1, y1 = drawn(frame).bounds
        assert min(x0, y0) > -1
        assert max(x1, y1) < 101
    for frame in frames(name, np.array([0.5])):
        areas = [seen(shape) for shape in frame.shapes]
        assert shapely.union_all(areas).area > 0.75 * sum(area.area for area in areas)


def test_a_blob_wobbles_and_does_not_roll() -> None:
    (part,) = morph("blob-spins").prepared.movement.parts
    offsets = part.curves(T)[:, :, 0]
    offsets = (offsets - offsets.mean(axis=1, keepdims=True)) @ np.array([1, 1j])
    turns = np.angle((offsets[1:] * offsets[:-1].conj()).sum(axis=1))
    assert np.abs(turns).sum() < np.deg2rad(25)


def test_a_chart_line_keeps_its_abscissae() -> None:
    (part,) = morph("line-chart-turns-over").prepared.movement.parts
    x = part.curves(T)[..., 0]
    np.testing.assert_allclose(x, np.broadcast_to(x[0], x.shape), atol=1e-6)


def test_a_chart_line_stays_on_its_area() -> None:
    for frame in frames("chart-line-leaves-its-area"):
        area, line = frame.shapes
        border = shapely.boundary(seen(area))
        points = shapely.points(flatten(line.rings[0].curves, 8))
        assert shapely.distance(border, points).max() < 1.0  # of a line 3 wide
        x0, _, x1, _ = seen(area).bounds
        assert x0 > 4.9
        assert x1 < 95.1


def test_edges_that_both_share_stand_still() -> None:
    for frame in frames("wave-bottom-edge-lifts"):
        area = seen(frame.shapes[0])
        first = frames("wave-bottom-edge-lifts", np.zeros(1))[0]
        np.testing.assert_allclose(area.bounds[0::2], seen(first.shapes[0]).bounds[0::2], atol=1e-6)
        assert area.bounds[3] == pytest.approx(seen(first.shapes[0]).bounds[3], abs=1e-6)


@pytest.mark.parametrize(
    ("name", "level", "least"),
    [
        ("circle-square-lopsided", False, 0.99),
        ("circle-square-lopsided", True, 0.99),
        ("play-two-bars-lopsided", True, 0.97),
        ("two-paths-do-not-divide", True, 0.97),
        ("play-pause-bar-from-nothing", True, 0.85),
        ("sun-rays-stay-on-the-moon", False, 0.0),
    ],
)
def test_mirror_symmetry_is_kept(name: str, level: bool, least: float) -> None:
    for frame in frames(name):
        whole = drawn(frame)
        low, high = np.array(whole.bounds).reshape(2, 2)
        axis = float((low + high)[1 if level else 0] / 2)
        assert like_mirror(whole, axis, level=level) >= least


@pytest.mark.parametrize(
    "name", ["play-two-bars-lopsided", "two-paths-do-not-divide", "country-to-islands-as-elements"]
)
def test_one_area_divides_into_several(name: str) -> None:
    found = scene(name)
    assert not found.roles.disappearing
    assert not found.roles.appearing
    start, end = (drawn(frame).area for frame in frames(name, np.array([0.0, 1.0])))
    for frame in frames(name):
        assert 0.8 * min(start, end) < drawn(frame).area < 1.1 * max(start, end)


def test_one_closed_line_divides_into_two() -> None:
    found = scene("play-pause-bar-from-nothing")
    assert len(found.roles.pairs) == 2
    assert not found.roles.appearing


def test_a_part_that_goes_makes_no_hole() -> None:
    for frame in frames("evenodd-vanishing-part-punches-hole"):
        disc = seen(max(frame.shapes, key=lambda shape: seen(shape).area))
        assert not shapely.get_num_interior_rings(disc)
        assert disc.area > 0.97 * disc.convex_hull.area


def test_a_cross_bar_shrinks_into_the_crossing() -> None:
    found = scene("plus-minus-shrinks-to-one-end")
    (gone,) = found.roles.disappearing
    home = found.scenes[0].items[gone].outer.curves
    part = next(
        p
        for p in morph("plus-minus-shrinks-to-one-end").prepared.movement.parts
        if p.style(1.0).opacity == 0
    )
    late = part.curves(np.array([0.3]))[0].reshape(-1, 2)
    np.testing.assert_allclose(
        (late.min(axis=0) + late.max(axis=0)) / 2, home[:, [0, 3]].mean(axis=(0, 1)), atol=1e-6
    )


def test_a_plus_becomes_an_x_by_half_a_right_angle() -> None:
    for part in morph("plus-x-turns-135-by-file-order").prepared.movement.parts:
        ways = part.curves(T)[:, 0]
        along = (ways[:, 3] - ways[:, 0]) @ np.array([1, 1j])
        turn = float(np.abs(np.angle(along[1:] / along[:-1])).sum())
        assert turn == pytest.approx(np.pi / 4, abs=1e-3)


@pytest.mark.parametrize("name", ["turned-180-not-rigid", "turned-180-not-seen"])
def test_a_drawing_upside_down_turns_as_one(name: str) -> None:
    areas = [sum(seen(shape).area for shape in frame.shapes) for frame in frames(name)]
    assert min(areas) > 0.97 * min(areas[0], areas[-1])
    assert max(areas) < 1.03 * max(areas[0], areas[-1])
    frame = scene(name).frame
    assert frame is not None
    assert abs(frame.turn) == pytest.approx(np.pi, abs=0.05)


def test_rays_shrink_before_the_moon_is_there() -> None:
    name = "sun-rays-stay-on-the-moon"
    assert len(scene(name).roles.disappearing) == 8
    for frame in frames(name, np.array([0.5, 0.75])):
        visible = [shape for shape in frame.shapes if shape.style.opacity > 0.1]
        assert len(visible) == 1


def test_rays_shrink_in_place_while_the_tick_is_drawn() -> None:
    name = "loader-rays-pushed-out-of-view"
    for frame in frames(name):
        x0, y0, x1, y1 = drawn(frame).bounds
        assert min(x0, y0) > -0.5
        assert max(x1, y1) < 24.5
        assert drawn(frame).area > 3


def test_a_mouth_s_line_stays_in_its_lips() -> None:
    for frame in frames("mouth-line-sticks-out"):
        lips = [seen(s) for s in frame.shapes if s.style.fill is not None]
        for shape in frame.shapes:
            if shape.style.fill is None and shape.style.opacity > 0.3:
                outside = seen(shape).difference(shapely.union_all(lips).buffer(1.5))
                assert outside.area < 0.02 * max(area.area for area in lips)


def test_dots_become_lines() -> None:
    name = "dots-to-menu-hollow"
    assert len(scene(name).roles.pairs) == 3
    for frame in frames(name):
        holes = [
            shapely.Polygon(hole).area
            for shape in frame.shapes
            for part in shapely.get_parts(seen(shape))
            for hole in part.interiors
        ]
        # A dot's ring meets itself in its middle, all but what its chords leave open.
        assert max(holes, default=0.0) < 1e-4


def test_a_ring_opens_to_a_check_mark() -> None:
    found = scene("info-to-check-jagged")
    (role,) = found.roles.pairs
    assert found.scenes[0].items[role.first].closed
    assert not found.scenes[1].items[role.second].closed


def test_a_sheet_is_no_part_of_the_drawing() -> None:
    found = scene("white-sheet-becomes-shape")
    (role,) = found.roles.pairs
    assert found.scenes[0].items[role.first].style.fill != Colour(1, 1, 1)
    for part in morph("white-sheet-becomes-shape").prepared.movement.parts:
        if part.style(0.0).fill == Colour(1, 1, 1):
            curves = part.curves(T)
            np.testing.assert_array_equal(curves, np.broadcast_to(curves[0], curves.shape))


def test_the_fill_of_a_flat_line_is_not_seen() -> None:
    for frame in frames("stroke-only-line-grows-black"):
        for shape in frame.shapes:
            if shape.style.opacity > 0.05:
                assert shape.style.fill != Colour()


def test_dashes_are_kept_at_their_end() -> None:
    first, last = frames("dashes-lost-to-fill", np.array([0.0, 1.0]))
    assert any(s.style.stroke and s.style.stroke.dashes for s in first.shapes)
    assert all(s.style.fill is not None for s in last.shapes if s.style.opacity)


def test_a_letter_becomes_another_within_the_view() -> None:
    for frame in frames("letter-W-to-R-leaves-view"):
        assert drawn(frame).is_valid


def test_lines_can_be_pinned() -> None:
    paths = DATA / "pin-refused-on-lines.a.svg", DATA / "pin-refused-on-lines.b.svg"
    moved = st.morph(*paths, pins=[(4, 6, 6, 6)])
    ends = {
        tuple(np.round(part.curves(np.zeros(1))[0, k[0], k[1]], 3)): np.round(
            part.curves(np.ones(1))[0, k[0], k[1]], 3
        )
        for part in moved.prepared.movement.parts
        for k in ((0, 0), (-1, 3))
        if part.style(1.0).opacity and part.style(0.0).opacity
    }
    np.testing.assert_allclose(ends[4.0, 6.0], [6, 6])
