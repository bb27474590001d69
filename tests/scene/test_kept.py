"""Areas of which most stays where it is: that stands still, and only the difference moves."""

from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
import shapely
from shapely import affinity

from shapetween.base.arrays import Points
from shapetween.boolean.area import filled_area
from shapetween.geometry.bezier import evaluate, flatten, line_curves
from shapetween.geometry.polygon import polygon_area
from shapetween.model.drawing import Drawing
from shapetween.model.outline import Outline
from shapetween.pipeline import Options, Prepared, prepare
from shapetween.scene.items import items_of
from shapetween.scene.kept.appearing import HalfPlaneClip, Telescoped
from shapetween.scene.kept.badges import Bitten, badges_of
from shapetween.scene.kept.drawings import kept_drawings
from shapetween.scene.kept.holes import holes_in_turn
from shapetween.scene.kept.outlines import outline_tracks
from shapetween.scene.kept.pieces import Piece
from shapetween.scene.kept.shared_arcs import snapped
from shapetween.scene.kept.strips import Strip, Tip
from shapetween.scene.kept.symmetry import Reflection
from shapetween.svg.read.reader import read_svg
from tests.drawings import ring, square
from tests.scene.strokes import arc

PAGE = "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 100 100'>"
T = np.linspace(0, 1, 9)

BOX = shapely.box(20, 20, 80, 80)
SLASH = shapely.LineString([(12, 12), (88, 88)]).buffer(4)
CROSSED = BOX.difference(SLASH.buffer(6))


def path(area: shapely.Geometry, fill: str = "#000", digits: int = 12) -> str:
    """A path of polygons, all their rings by the even-odd rule."""
    lines = [line for part in shapely.get_parts(area) for line in shapely.get_rings(part)]
    data = "".join(
        "M" + " ".join(f"{x:.{digits}g},{y:.{digits}g}" for x, y in line.coords[:-1]) + "Z"
        for line in lines
    )
    return f"<path d='{data}' fill='{fill}' fill-rule='evenodd'/>"


def prepared(first: str, second: str, options: Options | None = None) -> Prepared:
    one, other = (read_svg(f"{PAGE}{d}</svg>".encode(), "x") for d in (first, second))
    return prepare(one, other, options)


def drawn(frame: Drawing) -> shapely.Geometry:
    """All that is seen of a frame."""
    seen = []
    for shape in frame.shapes:
        if shape.style.opacity > 0.05:
            lines = [np.append(flatten(r.curves, 24), r.curves[-1:, 3], 0) for r in shape.rings]
            lines = [line for line in lines if np.ptp(line, axis=0).max() > 1e-6]
            seen.append(filled_area(lines, shape.style.fill_rule))
    return shapely.union_all(seen)


def frames(first: str, second: str, times: Points = T) -> list[shapely.Geometry]:
    return [drawn(frame) for frame in prepared(first, second).movement.at(times)]


def off(one: shapely.Geometry, other: shapely.Geometry) -> float:
    return float(one.symmetric_difference(other).area)


@pytest.mark.parametrize("elements", ["one", "several"])
def test_a_slash_comes_along_its_length_and_the_body_stands_still(elements: str) -> None:
    after = path(CROSSED) + path(SLASH)
    if elements == "one":
        after = path(shapely.MultiPolygon([*CROSSED.geoms, SLASH]))
    found = frames(path(BOX), after)
    kept = BOX.difference(SLASH.buffer(6.01))
    for t, area in zip(T, found, strict=True):
        assert kept.difference(area).area < 0.01
        assert area.difference(BOX.union(SLASH)).area < 5e-2
        # Before the tip there is no gap yet, behind it there is no more of it to come; the end of
        # each gap is as slanting as where it began, by its width at 45 degrees.
        tip = 12 - 4 / np.sqrt(2) + t * (76 + 8 / np.sqrt(2))
        behind = shapely.Polygon([(0, 0), (2 * tip - 13, 0), (0, 2 * tip - 13)])
        before = shapely.Polygon([(100, 100), (2 * tip - 87, 100), (100, 2 * tip - 87)])
        whole = shapely.union(CROSSED, SLASH)
        # What is drawn is half a hundredth narrower until all of it is there, and nowhere wider.
        slim = 0 if t == 1 else 7e-3 * SLASH.intersection(behind).area
        assert area.intersection(behind).difference(whole).area < 0.05
        assert off(area.intersection(behind), whole.intersection(behind)) < 0.05 + slim
        if 2 * tip - 87 < 100:
            assert off(area.intersection(before), BOX.intersection(before)) < 0.05


def test_both_ends_are_the_drawings_themselves_and_back_is_the_same() -> None:
    after = path(CROSSED) + path(SLASH)
    forth, back = frames(path(BOX), after), frames(after, path(BOX))
    assert off(forth[0], BOX) < 0.01
    assert off(forth[-1], CROSSED.union(SLASH)) < 0.03
    for one, other in zip(forth, back[::-1], strict=True):
        assert off(one, other) < 1e-2


def test_a_slash_that_hangs_on_the_body_by_one_side_is_drawn_too() -> None:
    band = SLASH.buffer(6).difference(SLASH)
    gap = shapely.get_parts(band.difference(shapely.LineString([(0, 0), (100, 100)]).buffer(0.01)))
    one_side = max(gap.tolist(), key=lambda part: part.centroid.x)
    after = BOX.union(SLASH).difference(one_side)
    for area in frames(path(BOX), path(after)):
        assert after.intersection(BOX).difference(area).area < 0.05
        assert area.difference(BOX.union(SLASH)).area < 0.05


def test_coordinates_off_by_rounding_are_one_outline_and_exact_at_both_ends() -> None:
    disc = shapely.Point(50, 50).buffer(30, quad_segs=4)
    moved = shapely.transform(disc, lambda p: p + 0.05 * np.sin(p[:, ::-1]))
    after = shapely.difference(moved, SLASH.buffer(6))
    found = frames(path(disc), path(after) + path(SLASH))
    assert off(found[0], disc) < 0.01
    assert off(found[-1], after.union(SLASH)) < 1e-2
    assert len(shapely.get_parts(found[1])) <= 2  # no shreds along the outline


def test_a_new_hole_opens_round_its_middle() -> None:
    hole = shapely.Point(55, 45).buffer(12)
    for t, area in zip(T, frames(path(BOX), path(BOX.difference(hole))), strict=True):
        gap = BOX.difference(area)
        if t > 0.2:
            assert gap.area > 1
            assert gap.centroid.distance(hole.centroid) < 0.1
            assert gap.difference(hole.buffer(0.01)).area < 0.01
        assert area.difference(BOX).area < 0.01


def test_a_hole_slides_and_stays_a_disc() -> None:
    """As the knob of a switch: it does not close here and open there."""
    pill = shapely.LineString([(30, 50), (70, 50)]).buffer(20)
    left, right = (shapely.Point(x, 50).buffer(12) for x in (30, 70))
    for t, area in zip(
        T, frames(path(pill.difference(left)), path(pill.difference(right))), strict=True
    ):
        (gap,) = [v for v in shapely.get_parts(pill.difference(area)) if v.area > 1e-3]
        assert gap.area == pytest.approx(left.area, rel=0.01)
        assert gap.centroid.x == pytest.approx(30 + 40 * t, abs=0.1)


def test_a_hole_that_is_a_stroke_bends_as_a_line_at_constant_width() -> None:
    """A mouth that turns from a smile to a frown, knocked out of the face."""
    mouths = [
        "M33 45A18 18 0 0 0 67 45 2.5 2.5 0 0 0 62.3 43.3"
        " 13 13 0 0 1 37.7 43.3 2.5 2.5 0 0 0 33 45Z",
        "M33 63A18 18 0 0 1 67 63 2.5 2.5 0 0 1 62.3 64.7"
        " 13 13 0 0 0 37.7 64.7 2.5 2.5 0 0 1 33 63Z",
    ]
    face = "M10 50A40 40 0 1 1 90 50A40 40 0 1 1 10 50Z"
    first, second = (f"<path d='{face}{mouth}' fill-rule='evenodd'/>" for mouth in mouths)
    found = frames(first, second)
    whole = shapely.Point(50, 50).buffer(39, quad_segs=32)
    start = whole.difference(found[0])
    for area in found:
        mouth = whole.difference(area)
        around = 2 * mouth.area / mouth.length
        assert around == pytest.approx(2 * start.area / start.length, rel=0.06)
        mirrored = shapely.transform(mouth, lambda p: np.column_stack([100 - p[:, 0], p[:, 1]]))
        assert off(mouth, mirrored) < 0.03 * mouth.area


def test_an_arm_slides_into_the_body_with_its_end_as_it_is() -> None:
    body = shapely.box(20, 50, 80, 80)
    arm = shapely.LineString([(50, 55), (50, 25)]).buffer(5)
    for t, area in zip(T[1:-1], frames(path(body.union(arm)), path(body))[1:-1], strict=True):
        out = area.difference(body)
        top = 20 + 30 * t
        assert out.bounds[1] == pytest.approx(top, abs=0.3)
        if top < 44:
            assert out.intersection(shapely.box(0, 0, 100, top + 5)).area == pytest.approx(
                np.pi * 25 / 2, rel=0.03
            )


def test_a_corner_is_cut_by_a_line_that_moves_straight() -> None:
    cut = BOX.difference(shapely.Polygon([(60, 20), (80, 20), (80, 40)]))
    for area in frames(path(BOX), path(cut))[1:-1]:
        assert len(shapely.get_coordinates(area.simplify(0.05))) == 6


def test_a_notch_is_drawn_in_by_the_outline_itself() -> None:
    notched = BOX.difference(shapely.box(40, 35, 80, 50))
    for area in frames(path(BOX), path(notched)):
        assert notched.buffer(-1e-3).difference(area).area < 1e-2
        assert area.geom_type == "Polygon"


def test_what_has_moved_is_no_kept_area() -> None:
    """A shackle that turns: what is left of it must not be clipped, and come elsewhere."""
    body = shapely.box(20, 50, 80, 90)
    bow = shapely.LineString([(35, 55), (35, 30), (65, 30), (65, 55)]).buffer(4)
    turned = shapely.LineString([(65, 55), (65, 30), (95, 30), (95, 45)]).buffer(4)
    scene = prepared(path(body.union(bow)), path(body.union(turned))).scene
    assert scene is None or all(role.reason != "kept" for role in scene.roles.pairs)


def test_edges_that_move_do_so_as_wholes() -> None:
    wider = shapely.Polygon([(14, 20), (86, 20), (80, 80), (20, 80)])
    for area in frames(path(BOX), path(wider)):
        assert off(area, area.convex_hull) < 4


def test_another_colour_in_between_keeps_areas_apart() -> None:
    sheet = path(shapely.box(25, 25, 75, 75), "#f00")
    after = path(CROSSED) + sheet + path(SLASH)
    roles = prepared(path(BOX) + sheet, after).scene
    assert roles is not None
    assert all(role.reason != "kept" for role in roles.roles.pairs)


def test_what_is_matched_by_the_user_is_no_part_of_a_kept_area() -> None:
    first = path(BOX).replace("<path", "<path id='box'")
    second = path(CROSSED) + path(SLASH).replace("<path", "<path id='bar'")
    scene = prepared(first, second, Options(matches=(("box", "bar"),))).scene
    assert scene is not None
    assert all(role.reason != "kept" for role in scene.roles.pairs)


@pytest.mark.parametrize("behind", [False, True])
def test_a_half_plane_leaves_exactly_what_is_on_one_side_of_the_line(behind: bool) -> None:
    disc = arc((50, 50), 20, 0, 4)
    ahead = np.array([0.6, 0.8])
    track = HalfPlaneClip((disc,), ahead, (40.0, 110.0), behind)
    curves = track.curves(T)
    assert curves.shape[1] == sum(track.counts)
    across = np.array([-0.8, 0.6])
    for t, frame in zip(T, curves, strict=True):
        tip, side = (40 + 70 * t) * ahead, -1 if behind else 1
        half = shapely.Polygon(
            [
                tip + 500 * across,
                tip - 500 * across,
                tip - 500 * across + side * 500 * ahead,
                tip + 500 * across + side * 500 * ahead,
            ]
        )
        expected = shapely.Polygon(flatten(disc.curves, 48)).intersection(half).area
        found = abs(shapely.Polygon(flatten(frame, 48)).area)
        assert found == pytest.approx(expected, abs=0.1)
    np.testing.assert_array_equal(curves[:, :, 3], np.roll(curves[:, :, 0], -1, axis=1))
    gone = track.curves(np.array([0.0 if behind else 1.0]))
    np.testing.assert_array_equal(np.ptp(gone, axis=(1, 2)), 0)


@pytest.mark.parametrize("comes", [False, True])
def test_what_a_bar_covers_is_all_still_until_it_does_and_then_stays_under_it(comes: bool) -> None:
    """So that it takes one moment of the movement, however many pieces there are."""
    bar = shapely.LineString([(20, 50), (80, 50)]).buffer(10, 64)
    pieces = [ring([(x, 40), (x + 9, 40), (x + 14, 60), (x, 60)]) for x in (20, 40, 60)]
    tip = Tip(np.array([[20.0, 50.0], [80.0, 50.0]]), 10.0, (0.1, 0.9), comes)
    track = tip.under(tuple(pieces))
    times = np.linspace(0, 1, 49)
    frames = track.curves(times if comes else 1 - times)
    np.testing.assert_array_equal(frames[-1], np.concatenate([p.curves for p in pieces]))
    covers = tip.curves(times if comes else 1 - times)
    first = int(np.flatnonzero(np.abs(covers - covers[-1]).max(axis=(1, 2, 3)) < 1e-9)[0])
    assert 0.85 < times[first] < 0.95
    for frame in frames[: first + 1]:
        for own in np.split(frame, 3):
            assert np.ptp(own, axis=(0, 1)).max() == 0
    for frame in frames[first:]:
        assert all(bar.buffer(1e-3).covers(shapely.Point(p)) for p in frame.reshape(-1, 2))
    speeds = np.diff(frames[first:], axis=0)
    np.testing.assert_allclose(speeds, np.broadcast_to(speeds[0], speeds.shape), atol=1e-9)


@pytest.mark.parametrize("behind", [False, True])
@pytest.mark.parametrize("ends", [(10.0, 90.0), (90.0, 10.0)])
def test_a_strip_is_shortened_along_the_bar_and_is_gone_at_last(
    behind: bool, ends: tuple[float, float]
) -> None:
    """Its sides stay where they are, its far end does, and it moves evenly but for the last."""
    strip = ring([(20, 0), (60, 0), (75, 12), (24, 12)])
    track = Strip((strip,), np.array([1.0, 0.0]), ends, behind)
    full = 1.0 if behind == (ends[0] < ends[1]) else 0.0
    whole, gone = track.curves(np.array([full, 1 - full]))
    np.testing.assert_allclose(whole, strip.curves, atol=1e-12)
    assert np.ptp(gone, axis=(0, 1)).max() == 0
    areas = []
    for frame in track.curves(np.linspace(0, 1, 65)):
        shape = shapely.Polygon(flatten(frame, 8))
        assert shape.difference(shapely.Polygon(flatten(strip.curves, 8)).buffer(1e-6)).area < 1e-3
        areas.append(shape.area)
        if shape.area > 30:
            low, high = frame[..., 1].min(), frame[..., 1].max()
            assert (low, high) == pytest.approx((0, 12), abs=1e-6)
            far = frame[..., 0].min() if behind else frame[..., 0].max()
            assert far == pytest.approx(20 if behind else 75, abs=1e-6)
    steps = np.diff(areas if full == 1.0 else areas[::-1])
    assert (steps >= -1e-9).all()
    assert np.median(steps[steps > 1]) == pytest.approx(steps.max(), rel=0.15)


def test_what_slides_never_goes_below_its_foot() -> None:
    track = Telescoped((square(40, 20, 20),), np.array([0.0, -1.0]), -40.0, 20.0, comes=False)
    np.testing.assert_allclose(track.curves(T)[..., 1].max(axis=(1, 2)), 40)
    np.testing.assert_allclose(track.curves(T)[..., 1].min(axis=(1, 2)), 20 + 20 * T)


def test_shared_arcs_end_where_outlines_part() -> None:
    first = square(0, 0, 60)
    second = ring([(0, 0), (60, 0), (60, 20), (50, 30), (60, 40), (60, 60), (0, 60)])
    found = snapped([first], [second], 0.2)
    (arc,) = found.arcs
    ends = arc.pieces.target[[0, -1], [0, 3]]
    np.testing.assert_allclose(ends, [(60, 40), (60, 20)], atol=1e-6)
    assert found.shared[1][0] == pytest.approx(60 + 60 + 60 + 20 + 20, abs=1e-3)


def test_rings_that_divide_have_no_tracks_of_outlines() -> None:
    first, second = (
        [square(0, 0, 60)],
        [square(0, 0, 25), ring([(35, 0), (60, 0), (60, 60), (35, 60)])],
    )
    found = snapped(first, second, 0.2)
    assert outline_tracks(dict(enumerate(first)), dict(enumerate(second)), found.arcs, 0.2) is None


def test_a_slot_opens_round_in_its_middle_and_is_drawn_to_both_ends() -> None:
    slot = shapely.LineString([(30, 50), (70, 50)]).buffer(5)
    lengths = []
    for area in frames(path(BOX), path(BOX.difference(slot)))[3:]:
        gap = BOX.buffer(-1).difference(area)
        low, high = np.array(gap.bounds).reshape(2, 2)
        np.testing.assert_allclose([low[0] + high[0], low[1], high[1]], [100, 45, 55], atol=0.1)
        lengths.append(high[0] - low[0])
    assert np.diff(lengths)[:-2].min() > 0.5
    assert lengths[-1] == pytest.approx(50, abs=0.1)


@pytest.mark.parametrize("unit", [1e-6, 1e6])
@pytest.mark.parametrize("after", ["slash", "hole", "arm"])
def test_units_do_not_matter(unit: float, after: str) -> None:
    second = {
        "slash": [CROSSED, SLASH],
        "hole": [BOX.difference(shapely.LineString([(30, 50), (70, 50)]).buffer(5))],
        "arm": [BOX.union(shapely.LineString([(50, 30), (50, 5)]).buffer(5))],
    }[after]

    def moved(factor: float) -> list[Points]:
        page = "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 {0} {0}'>".format(100 * factor)
        sides = [
            "".join(path(shapely.transform(a, lambda p: p * factor), digits=15) for a in areas)
            for areas in ([BOX], second)
        ]
        one, other = (read_svg(f"{page}{side}</svg>".encode(), "x") for side in sides)
        movement = prepare(one, other).movement
        return [part.curves(T) / factor for part in movement.parts]

    for one, other in zip(moved(1.0), moved(unit), strict=True):
        assert one.shape == other.shape
        np.testing.assert_allclose(one, other, atol=1e-6)


@pytest.mark.parametrize("start", range(5))
def test_cutting_rings_alike_moves_nothing_wherever_they_start(start: int) -> None:
    corners = [(0.0, 0.0), (60.0, 0.0), (60.0, 20.0), (45.0, 30.0), (60.0, 60.0), (0.0, 60.0)]
    first = ring(corners[start:] + corners[:start])
    for second in (
        square(0, 0, 60),
        ring([(0, 0), (60, 0), (60, 20), (45, 30), (20, 60), (0, 60)]),
    ):
        found = snapped([first], [second], 0.2)
        assert found.arcs
        assert found.first[0].area == pytest.approx(first.area, rel=1e-9)
        assert found.exact[0].area == pytest.approx(second.area, rel=1e-9)
        assert found.second[0].area == pytest.approx(second.area, rel=1e-9)


def test_a_slash_through_several_parts_opens_all_of_them_in_time() -> None:
    parts = [shapely.box(25, 25, 45, 45), shapely.box(55, 55, 75, 75)]
    after = [p for part in parts for p in part.difference(SLASH.buffer(6)).geoms]
    found = frames("".join(map(path, parts)), "".join(map(path, [*after, SLASH])))
    for t, area in zip(T, found, strict=True):
        if t <= 0.5:
            assert parts[1].buffer(-0.1).difference(area).area < 0.01
        if t >= 0.5:
            opened = parts[0].difference(shapely.union_all([*after, SLASH])).buffer(-0.1)
            assert area.intersection(opened).area < 0.01


def test_a_tick_that_is_knocked_out_closes_before_a_cross_opens_in_its_place() -> None:
    tick = shapely.LineString([(38, 50), (47, 60), (64, 38)]).buffer(3)
    cross = shapely.MultiLineString([[(38, 38), (62, 62)], [(62, 38), (38, 62)]]).buffer(3)
    found = frames(path(BOX.difference(tick)), path(BOX.difference(cross)))
    for t, area in zip(T, found, strict=True):
        gap = BOX.buffer(-1).difference(area)
        seen = tick if t < 0.5 else cross
        assert gap.difference(seen.convex_hull.buffer(0.1)).area < 0.01
        assert (gap.area > 1) == (t != 0.5)


def test_what_comes_apart_divides_and_is_no_kept_area() -> None:
    """A gap that opens between two halves is not clipped out of them; one with a bar in it is."""
    halves = shapely.MultiPolygon([shapely.box(20, 20, 40, 80), shapely.box(60, 20, 80, 80)])
    for t, area in zip(T, frames(path(BOX), path(halves)), strict=True):
        assert off(area, BOX.difference(shapely.box(50 - 10 * t, 0, 50 + 10 * t, 100))) < 1
    beside = shapely.MultiPolygon([*halves.geoms, shapely.box(46, 5, 54, 95)])
    scene = prepared(path(BOX), path(beside)).scene
    assert scene is not None
    assert any(role.reason == "kept" for role in scene.roles.pairs)


def test_holes_close_alike_before_one_opens_whose_edges_run_along_theirs() -> None:
    squares = [shapely.box(x, y, x + 8, y + 8) for y in (42, 58) for x in (30, 46, 62)]
    arms = shapely.union(shapely.box(46, 34, 54, 74), shapely.box(30, 50, 70, 58))
    found = frames(path(BOX.difference(shapely.union_all(squares))), path(BOX.difference(arms)))
    old = shapely.union_all(squares)
    for t, area in zip(T, found, strict=True):
        white = BOX.buffer(-1).difference(area)
        assert white.difference(old if t < 0.5 else arms).area < 0.05
        if t < 0.5:
            sizes = [white.intersection(square).area for square in squares]
            assert np.ptp(sizes) < 0.01
    assert BOX.difference(found[4]).area < 0.05


def test_a_slash_that_takes_a_corner_off_is_drawn_too_and_the_rest_stands_still() -> None:
    bar = shapely.LineString([(12, 12), (88, 88)]).buffer(4)
    corner = shapely.Polygon([(20, 26), (74, 80), (20, 80)])
    comb = shapely.union_all([BOX, *(shapely.box(x, 8, x + 4, 20) for x in range(36, 80, 8))])
    after = shapely.union(comb.difference(corner), bar)
    kept = shapely.intersection(comb, after)
    tips: list[float] = []
    for area in frames(path(comb), path(after)):
        assert kept.difference(area).area < 0.05
        assert area.difference(shapely.union(comb, bar)).area < 0.05
        # What is before the tip stands still: nothing is drawn along into a claw.
        tip = (9.2 + 81.7 * len(tips) / 8) * 2
        ahead = shapely.Polygon([(tip + 8, 0), (300, 0), (0, 300), (0, tip + 8)])
        assert comb.intersection(ahead).difference(area).area < 1
        tips.append(bar.difference(comb).intersection(area).area)
    assert np.diff(tips).min() > -1e-3  # but for the chords that round ends are measured by
    assert tips[0] < 0.01


@pytest.mark.parametrize("centre", [(80, 80), (74, 72), (90, 50)])
def test_a_bite_opens_round_a_badge_as_that_grows(centre: tuple[float, float]) -> None:
    place = shapely.Point(centre)
    badge, bite = place.buffer(9, 16), place.buffer(14, 16)
    before, after = path(BOX), path(BOX.difference(bite)) + path(badge)
    for first, second, times in ((before, after, T), (after, before, T[::-1])):
        for t, area in zip(times, frames(first, second), strict=True):
            size = 1 - (1 - t) ** 2
            now = [place.buffer(size * reach, 16) for reach in (9, 14)]
            expected = shapely.union(BOX.difference(now[1]), now[0])
            assert off(area, expected) < 1.6


@pytest.mark.parametrize(("left", "count"), [(0.9, 0), (1.5, 1)])
def test_more_than_what_is_left_was_not_bitten_off_by_a_badge(left: float, count: int) -> None:
    """A globe's lines are not what an arrow in its ring had bitten off."""
    disc, middle = shapely.Point(50, 50).buffer(30, 64), shapely.box(0, 0, 60, 100)
    arc, edge = (
        disc.boundary.intersection(middle),
        disc.intersection(shapely.LineString([(60, 0), (60, 100)])),
    )
    piece = Piece(disc.intersection(middle), True, shapely.line_merge(arc), edge)
    kept = affinity.translate(shapely.box(0, 0, 1, left * piece.area.area), 200, 0)
    (dot,) = read_svg(f"{PAGE}<circle cx='50' cy='50' r='19'/></svg>".encode(), "x").shapes
    laid: Any = SimpleNamespace(pieces=(piece,), kept=kept)
    assert len(badges_of(laid, (items_of((dot,), "x")[0], ()), 100.0)) == count


def test_a_body_with_a_badge_is_exact_at_both_ends() -> None:
    badge, bite = (shapely.Point(80, 80).buffer(r, 16) for r in (9, 14))
    after = shapely.union(BOX.difference(bite), badge)
    ends = frames(path(BOX), path(after), np.array([0.0, 1.0]))
    assert off(ends[0], BOX) < 0.01
    assert off(ends[1], after) < 0.01


def test_a_bite_beside_thin_walls_leaves_nothing_where_it_is_open() -> None:
    """What is bitten off goes there and back on one border, with not a hair between."""
    corner = shapely.union(shapely.box(20, 20, 30, 80), shapely.box(20, 70, 80, 80))
    corners = np.array(corner.exterior.coords)[:-1]
    ring = Outline(line_curves(corners, np.roll(corners, -1, axis=0)))
    reach = np.full(720, 90.0)
    bite = Bitten((ring.clockwise(),), np.array([24.0, 76.0]), reach, True, True)
    times = np.array([0.6, 0.8])
    for curves, size in zip(bite.curves(times), 1 - (1 - times) ** 2, strict=True):
        assert size * 90 > 60  # all of it is bitten off
        first, hole = np.split(curves[:, 0], bite.counts[:1])
        assert abs(float(polygon_area(first) + polygon_area(hole))) < 1e-6
        thirds = evaluate(curves, np.linspace(0, 1, 5)) - bite.centre
        chords = np.hypot(*np.moveaxis(thirds, -1, 0))
        assert (chords.max(axis=1) <= size * 90 * (1 + 1e-6)).all()


ARROW = [(46, 30), (54, 30), (54, 50), (66, 50), (50, 66), (34, 50), (46, 50)]


def test_an_arrow_cut_out_of_a_body_turns_there_and_all_else_stands_still() -> None:
    down = shapely.Polygon(ARROW)
    up = shapely.union(affinity.scale(down, 1, -1, origin=(50, 50)), shapely.box(46, 60, 54, 80))
    bodies = BOX.difference(down), BOX.difference(up)
    still, ever = bodies[0].intersection(bodies[1]), bodies[0].union(bodies[1])
    for area in frames(path(bodies[0]), path(bodies[1])):
        assert still.difference(area).area < 0.5
        assert area.difference(ever).area < 0.5


def test_large_holes_that_only_one_has_are_not_closed_first() -> None:
    """A table of three cells is not all black before it is one of two."""
    outer = shapely.box(10, 10, 90, 90)
    first = outer.difference(
        shapely.union_all([shapely.box(18, 18, 82, 40), shapely.box(18, 48, 46, 82)])
    ).difference(shapely.box(54, 48, 82, 82))
    second = outer.difference(shapely.box(18, 18, 34, 82)).difference(shapely.box(42, 18, 82, 82))
    least = min(first.area, second.area)
    assert max(area.area for area in frames(path(first), path(second))) < 2 * least


def test_a_slash_through_an_outline_is_drawn_along_its_length() -> None:
    """It has little beside it to clear, and is a slash all the same."""
    frame = BOX.difference(BOX.buffer(-5, join_style="mitre"))
    gap = affinity.translate(SLASH, 4, -4)
    after = frame.difference(gap).union(SLASH)
    along = np.sqrt(0.5) * np.array([1.0, 1.0])
    for t, area in zip(T, frames(path(frame), path(after)), strict=True):
        drawn_part = area.difference(frame.buffer(0.1))
        if t in (0, 1) or drawn_part.area < 1:
            continue
        tip = float((shapely.get_coordinates(drawn_part) @ along).max())
        wanted = after.difference(frame.buffer(0.2))
        behind = [p for p in wanted.geoms if (shapely.get_coordinates(p) @ along).max() < tip - 9]
        assert all(area.intersection(p).area > 0.95 * p.area for p in behind)


def test_what_a_slash_cuts_through_thin_and_thick_falls_to_no_splinters() -> None:
    comb = shapely.union_all(
        [shapely.box(10, 46, 90, 54), *(shapely.box(x, 20, x + 14, 80) for x in (14, 43, 72))]
    )
    slash = shapely.LineString([(12, 12), (88, 88)]).buffer(4, cap_style="flat")
    after = comb.difference(affinity.translate(slash, 6, -6)).union(slash)
    ever = comb.union(after).buffer(0.3)
    for area in frames(path(comb), path(after)):
        assert area.difference(ever).area < 0.5


def test_what_a_line_clips_away_lies_on_it_no_farther_out_than_it_cuts() -> None:
    """There and back along a line encloses nothing, but is a hair to renderers."""
    corner = shapely.union(shapely.box(0, 0, 10, 60), shapely.box(0, 50, 60, 60))
    corners = np.array(corner.exterior.coords)[:-1]
    ring = Outline(line_curves(corners, np.roll(corners, -1, axis=0))).clockwise()
    ahead = np.array([1.0, -1.0]) / np.sqrt(2)
    low, high = float((corners @ ahead).min()), float((corners @ ahead).max())
    for behind in (True, False):
        clip = HalfPlaneClip((ring,), ahead, (low, high), behind)
        points = clip.curves(np.linspace(0.05, 0.95, 7)).reshape(-1, 2)
        assert points.min() > -1e-9
        assert points.max() < 60 + 1e-9


def test_wings_on_both_sides_of_a_body_are_no_slash() -> None:
    wide = shapely.Polygon([(14, 40), (86, 40), (80, 80), (20, 80)])
    for area in frames(path(BOX), path(shapely.union(shapely.box(20, 20, 80, 40), wide))):
        low, _, high, _ = area.bounds
        assert low + high == pytest.approx(100, abs=0.1)


@pytest.mark.parametrize(("flap", "alone"), [((54, 34, 90, 66), 1), ((83, 20, 99, 80), 0)])
def test_what_fills_a_notch_is_not_cut_off_the_body(
    flap: tuple[int, int, int, int], alone: int
) -> None:
    notched = shapely.box(22, 22, 80, 78).difference(shapely.box(50, 30, 80, 70))
    body = notched if alone else shapely.box(22, 22, 80, 78)
    found = prepared(path(shapely.box(14, 16, 94, 86)), path(body) + path(shapely.box(*flap)))
    assert found.scene is not None
    assert len(found.scene.roles.appearing) == alone


def test_the_tip_of_a_slash_is_round_while_it_is_drawn() -> None:
    """The body's round side, which the slash touches, is no shape for its end."""
    disc = shapely.Point(50, 50).buffer(30, 16)
    after = path(disc.difference(SLASH.buffer(6))) + path(SLASH)
    for first, second, times in ((path(disc), after, T), (after, path(disc), T[::-1])):
        for t, area in zip(T[1:-1], frames(first, second, times)[1:-1], strict=True):
            tip = 11 + t * 74
            end = shapely.Point(tip, tip).buffer(3)
            assert end.difference(area).area < 0.25 * end.area
            if t < 0.2:
                drawn_of_it = area.difference(disc.buffer(0.1))
                assert drawn_of_it.area > 0.98 * drawn_of_it.convex_hull.area


@pytest.mark.parametrize("comes", [True, False])
@pytest.mark.parametrize("jitter", [0.0, 0.1])
def test_an_empty_slash_is_cut_at_full_width_from_one_end(comes: bool, jitter: float) -> None:
    """As through an eye: not as a crack that grows wider, also if the outline is drawn anew."""
    eye = (
        shapely.Point(50, 50)
        .buffer(40, quad_segs=12)
        .difference(shapely.Point(50, 50).buffer(15, quad_segs=6))
    )
    slot = shapely.LineString([(10, 90), (90, 10)]).buffer(4, cap_style="flat")
    bump = shapely.Polygon([(15, 30), (17 - jitter, 28), (17, 30)])
    shut = eye.difference(slot)
    whole = shut.union(bump) if jitter else shut
    ends = path(eye), path(whole)
    found = frames(*(ends if comes else ends[::-1]))
    gone = [eye.difference(area).area for area in (found if comes else found[::-1])]
    assert (np.diff(gone) >= -0.1).all()
    for area in found[1:-1]:
        cut = eye.difference(area)
        assert cut.difference(slot.buffer(0.2)).area < 3
        for part in shapely.get_parts(cut.buffer(-0.2)):
            aside = shapely.get_coordinates(part) @ np.array([1, 1]) / np.sqrt(2)
            assert part.area < 1 or np.ptp(aside) > 7


def test_a_level_slot_opens_all_along_and_halves_part_as_cells() -> None:
    lid = BOX.difference(shapely.box(0, 40, 100, 46))
    middle = frames(path(BOX), path(lid))[4]
    assert middle.contains(shapely.Point(25, 30))
    cut = BOX.difference(middle)
    assert np.ptp(shapely.get_coordinates(cut)[:, 0]) > 59


@pytest.mark.parametrize("shift", [0.0, 3.0])
def test_a_body_is_cut_off_straight_before_something_grows_there(shift: float) -> None:
    """Also if all of it slides a little to make room."""
    body = shapely.Point(50, 90).buffer(36, quad_segs=12).intersection(shapely.box(0, 0, 100, 90))
    head = shapely.Point(50, 30).buffer(16, quad_segs=12)
    plus = shapely.union(shapely.box(62, 68, 92, 74), shapely.box(74, 56, 80, 86))
    cut = body.intersection(shapely.box(0, 0, 52, 100))
    after = affinity.translate(shapely.MultiPolygon([head, cut]), shift, 0)
    ends = path(shapely.MultiPolygon([head, body])), path(after) + path(plus)
    middle = shapely.MultiPolygon([head, cut])
    for t, area in zip(T, frames(*ends), strict=True):
        slid = affinity.translate(middle, t * shift, 0)
        assert slid.difference(area).area < 1
        grown = area.difference(slid.buffer(0.1))
        if t < 0.5:  # what is left of the body, up to an upright line
            below = area.intersection(shapely.box(0, 50, 120, 120))
            edge = float(shapely.get_coordinates(below)[:, 0].max())
            whole = affinity.translate(body, t * shift, 0)
            assert grown.difference(whole.buffer(0.1)).area < 1
            assert off(area, slid.union(whole.intersection(shapely.box(0, 0, edge, 100)))) < 1
        else:
            there = affinity.translate(plus, (t - 1) * shift, 0)
            assert grown.difference(there.buffer(0.05)).area < 0.1
    assert off(frames(*ends)[-1], after.union(plus)) < 0.1


def test_a_slide_that_leaves_more_on_both_sides_is_none() -> None:
    """Lines of a list that shift a little do not keep what stands beside them."""
    lines = shapely.MultiPolygon([shapely.box(30, y, 90, y + 8) for y in (20, 46, 72)])
    first = lines.union(shapely.box(5, 40, 20, 60))
    second = affinity.translate(lines, 3, 3).union(shapely.Point(12, 76).buffer(7))
    scene = prepared(path(first), path(second)).scene
    assert scene is not None
    assert all(role.reason != "kept" for role in scene.roles.pairs)


def lopsided(area: shapely.Geometry, middle: float = 50.0) -> float:
    """How much of an area is not its own mirror image about an upright axis."""
    image = affinity.scale(area, -1, 1, origin=(middle, 0))
    return off(area, image) / float(area.area)


def test_a_flap_that_opens_is_as_high_on_both_sides() -> None:
    case = shapely.box(10, 40, 90, 90)
    first = case.union(shapely.box(14, 36, 86, 40))
    second = case.union(shapely.Polygon([(10, 40), (50, 10), (90, 40)]))
    for area in frames(path(first), path(second)):
        assert lopsided(area) < 5e-3


def test_mirror_images_of_pieces_are_mates_and_move_as_such() -> None:
    nothing = shapely.LineString()
    ear, other, badge = (
        Piece(area, True, nothing, nothing)
        for area in (
            shapely.box(0, 0, 10, 20),
            shapely.box(89, 0, 100, 20),
            shapely.box(0, 60, 9, 90),
        )
    )
    axis = Reflection(0, 50.0)
    assert axis.mate(ear, [badge, other]) is other
    assert axis.mate(badge, [ear, other]) is None
    assert axis.mate(ear, [replace(other, comes=False)]) is None
    assert axis.of_way(np.array([0.6, 0.8])).tolist() == [-0.6, 0.8]
    assert axis.along(np.array([0.6, 0.8])).tolist() == [0.0, 0.8]


def test_what_lies_in_a_hole_that_closes_is_not_run_over_by_its_border() -> None:
    page = shapely.box(16, 40, 84, 84)
    day = shapely.box(58, 60, 82, 82)
    first = shapely.box(10, 10, 90, 90).difference(page).union(day)
    hands = shapely.Polygon([(47, 20), (53, 20), (53, 48), (70, 58), (66, 64), (47, 52)])
    second = shapely.Point(50, 50).buffer(42, quad_segs=4).difference(hands)
    for area in frames(path(first), path(second), np.linspace(0, 0.45, 10)):
        for hole in shapely.get_parts(area)[0].interiors:
            assert shapely.Polygon(hole).area > 0.9 * shapely.Polygon(hole).convex_hull.area


def test_a_hole_that_touches_itself_is_an_area() -> None:
    """Curves that meet at a point may run over each other as chords."""
    whole = shapely.box(-20, -20, 20, 20)
    bow = np.array([[0, 0], [4, 4], [4, 0], [0, 4.5]], float)
    box = np.array([[8, 8], [9, 8], [9, 9], [8, 9]], float)
    found = holes_in_turn(([0], [1]), (), [bow, box], (whole, whole))
    assert found == [(0, 0), (1, 1)]
    torn = whole.difference(shapely.make_valid(shapely.Polygon(bow + 0.5)))
    assert holes_in_turn(([0], [1]), (), [bow, box], (torn, torn)) == []


def test_a_tick_in_a_disc_closes_before_a_dial_opens_and_its_hands_come_with_it() -> None:
    disc = shapely.Point(50, 50).buffer(45, quad_segs=8)
    tick = shapely.LineString([(30, 50), (45, 65), (72, 34)]).buffer(6, cap_style="flat")
    dial = shapely.Point(50, 50).buffer(34, quad_segs=8)
    hands = shapely.box(46, 28, 54, 58).union(shapely.box(34, 50, 54, 58))
    found = frames(path(disc.difference(tick)), path(disc.difference(dial).union(hands)))
    assert off(found[4], disc) < 1e-3 * disc.area
    for area in found[:4]:
        hole = disc.difference(area)
        assert 0 < hole.area <= tick.area + 0.1
        assert hole.difference(tick.envelope).area < 0.1  # it swells to nothing
    for area in found[5:]:
        hole = disc.difference(area)
        (hole,) = (part for part in shapely.get_parts(hole) if part.area > 0.1)
        assert len(hole.interiors) == 1  # with all of the hands in it


@pytest.mark.parametrize(("size", "stays"), [(0.65, True), (0.8, False), (1.0, False)])
def test_an_area_that_is_mostly_open_does_not_stay_while_that_closes(
    size: float, stays: bool
) -> None:
    plate = shapely.box(0, 0, 100, 100)
    plus = shapely.union(shapely.box(4, 28, 96, 72), shapely.box(28, 4, 72, 96))
    holes = [plus, shapely.box(10, 10, 90, 90)]
    ends = [plate.difference(affinity.scale(hole, size, size)) for hole in holes]
    files = [read_svg(f"{PAGE}{path(end)}</svg>".encode(), "x") for end in ends]
    sides = [items_of(file.shapes, "x")[0] for file in files]
    # A plate with a small sign in it is filled for a while; a frame would be a blot.
    assert bool(kept_drawings(sides[0], sides[1], ()).areas) is stays


def wheel(spokes: int) -> shapely.Geometry:
    disc = shapely.Point(50, 50).buffer(45, quad_segs=64)
    rim = disc.difference(shapely.Point(50, 50).buffer(38, quad_segs=64))
    angles = 2 * np.pi * np.arange(spokes) / spokes
    ends = 50 + 42 * np.stack([np.cos(angles), np.sin(angles)], axis=-1)
    return shapely.union_all([rim, *(shapely.LineString([(50, 50), e]).buffer(3) for e in ends)])


def test_a_ring_full_of_holes_is_exchanged_as_a_whole_and_no_ground() -> None:
    wheels = [wheel(4), wheel(6)]
    found = prepared(path(wheels[0]), path(wheels[1]))
    assert "exchanged" in {notice.kind for notice in found.notices}
    areas = [drawn(frame).area for frame in found.movement.at(T)]
    assert max(areas) <= 1.01 * max(own.area for own in wheels)


@pytest.mark.parametrize("comes", [True, False])
def test_a_tick_over_a_gap_opens_after_that_has_closed(comes: bool) -> None:
    body = shapely.box(10, 10, 90, 90)
    gap = body.difference(shapely.box(10, 34, 90, 42))
    tick = shapely.LineString([(34, 56), (46, 68), (66, 36)]).buffer(4, cap_style="flat")
    ends = path(gap), path(body.difference(tick))
    found = frames(*(ends if comes else ends[::-1]))[:: 1 if comes else -1]
    assert off(found[4], body) < 0.1
    for area in found[1:4]:  # the gap is one all along, and nothing else is open
        assert body.difference(area).difference(body.difference(gap)).area < 0.1
    for area in found[5:]:
        hole = body.difference(area)
        assert hole.difference(tick.envelope).area < 0.1
        assert len([part for part in shapely.get_parts(hole) if part.area > 0.01]) == 1


@pytest.mark.parametrize(("height", "stays"), [(24, True), (80, False)])
def test_a_line_is_no_side_of_a_frame_that_it_becomes(height: float, stays: bool) -> None:
    line = shapely.box(10, 10, 18, 90)
    # A short frame at its foot is a part that it gets.
    frame = shapely.box(10, 90 - height, 60, 90).difference(shapely.box(18, 98 - height, 52, 82))
    ends = path(line), path(frame.union(line))
    sides = [items_of(read_svg(f"{PAGE}{end}</svg>".encode(), "x").shapes, "x")[0] for end in ends]
    assert bool(kept_drawings(sides[0], sides[1], ()).areas) is stays


def test_a_pupil_does_not_close_for_the_half_of_it_that_a_slash_leaves() -> None:
    eye, pupil = shapely.box(0, 20, 100, 80), shapely.box(36, 36, 64, 64)
    slash = shapely.LineString([(10, 10), (90, 90)]).buffer(4, cap_style="flat")
    gap = shapely.LineString([(10, 2), (98, 90)]).buffer(4, cap_style="flat")
    ends = eye.difference(pupil), eye.difference(pupil).difference(gap).union(slash)
    found = frames(path(ends[0]), path(ends[1]))
    assert all(pupil.difference(area).area > 0.2 * pupil.area for area in found)
