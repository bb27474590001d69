"""What a shape's rings enclose, by both fill rules, against shapely's own areas."""

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from shapetween.base.arrays import Points
from shapetween.base.errors import OutlineError
from shapetween.fill.regions import Region, regions_of
from shapetween.geometry.bezier import flatten, line_curves
from shapetween.model.drawing import Shape
from shapetween.model.outline import Outline
from shapetween.model.paint import FillRule, Style
from tests.match.shapes import rounded, star
from tests.movements import circle


def ring(*corners: tuple[float, float]) -> Outline:
    points = np.array(corners, dtype=np.float64)
    return Outline(line_curves(points, np.roll(points, -1, axis=0)))


def square(x: float, y: float, side: float, *, back: bool = False) -> Outline:
    """Clockwise as drawn unless it runs back."""
    found = ring((x, y), (x + side, y), (x + side, y + side), (x, y + side))
    return found.reversed() if back else found


def regions(*rings: Outline, rule: FillRule = "nonzero") -> tuple[Region, ...]:
    return regions_of(Shape(rings, Style(fill_rule=rule)), "shape")[0]


def areas(found: tuple[Region, ...]) -> list[tuple[float, list[float]]]:
    """Area of every outer ring, with those of its holes, but for rounding."""
    return [(round(r.area, 9), sorted(round(h.area, 9) for h in r.holes)) for r in found]


def test_a_single_ring_keeps_its_curves_and_runs_clockwise() -> None:
    disc = Outline(circle(np.array([3.0, 4.0]), 2.0))
    for drawn in (disc, disc.reversed()):
        (found,) = regions(drawn)
        assert found.area == pytest.approx(disc.area)
        assert len(found.outer.curves) == 4
        assert not found.holes


@pytest.mark.parametrize("rule", ["nonzero", "evenodd"])
@pytest.mark.parametrize("back", [False, True])
def test_a_ring_within_a_ring(rule: FillRule, back: bool) -> None:
    """A hole by the even-odd rule, and by the nonzero rule if it runs the other way."""
    found = regions(square(0, 0, 10), square(3, 3, 4, back=back), rule=rule)
    hole = back or rule == "evenodd"
    assert areas(found) == [(100, [16.0] if hole else [])]
    for region in found:
        assert all(h.area > 0 for h in region.holes)


def test_an_island_in_a_hole_is_a_piece() -> None:
    rings = square(0, 0, 10), square(2, 2, 6, back=True), square(4, 4, 2)
    for rule in ("nonzero", "evenodd"):
        assert areas(regions(*rings, rule=rule)) == [(100, [36]), (4, [])]
    same_way = tuple(r if r.area > 0 else r.reversed() for r in rings)
    assert areas(regions(*same_way)) == [(100, [])]
    assert areas(regions(*same_way, rule="evenodd")) == [(100, [36]), (4, [])]


def test_pieces_keep_their_own_holes_the_largest_piece_first() -> None:
    found = regions(
        square(1, 1, 1, back=True),
        square(0, 0, 4),
        square(20, 0, 8),
        square(21, 1, 2, back=True),
        square(24, 4, 3, back=True),
    )
    assert areas(found) == [(64, [4, 9]), (16, [1])]


def test_rings_that_touch_stay_apart() -> None:
    """At a corner, along a side, and a hole that touches its outer ring from within."""
    assert areas(regions(square(0, 0, 3), square(3, 3, 2))) == [(9, []), (4, [])]
    assert areas(regions(square(0, 0, 3), square(3, 0, 2))) == [(9, []), (4, [])]
    diamond = ring((0, 5), (5, 1), (9, 5), (5, 9)).reversed()
    ((area, holes),) = areas(regions(square(0, 0, 10), diamond))
    assert (area, holes) == (100, [36])


def test_a_bow_tie_is_two_lobes() -> None:
    bow = ring((0, 0), (10, 10), (10, 0), (0, 10))
    assert bow.area == pytest.approx(0, abs=1e-12)
    for rule in ("nonzero", "evenodd"):
        found, said = regions_of(Shape((bow,), Style(fill_rule=rule)), "cat")
        assert areas(found) == [(25, [])] * 2
        assert tuple(map(str, said)) == (
            "cat: an outline crosses itself near 5, 5; what it shows was outlined anew",
        )


def test_a_loop_within_itself_is_a_hole_by_one_rule_only() -> None:
    """A ring that goes round twice, the second time inside the first."""
    twice = ring((0, 0), (9, 0), (9, 9), (0, 9), (0, 2), (7, 2), (7, 7), (2, 7), (2, -1), (0, -1))
    whole = regions(twice)
    holed = regions(twice, rule="evenodd")
    assert sum(len(r.holes) for r in whole) == 0
    difference = sum(r.area - sum(h.area for h in r.holes) for r in whole)
    difference -= sum(r.area - sum(h.area for h in r.holes) for r in holed)
    assert difference == pytest.approx(shown_area(twice, 2))


def shown_area(drawn: Outline, least: int) -> float:
    """Area that a ring of straight lines winds around at least so often, by counting a grid."""
    points = drawn.curves[:, 0]
    cell = 0.1
    x = np.arange(points.min() - 1 + cell / 2, points.max() + 1, cell)
    spots = np.stack(np.meshgrid(x, x), axis=-1).reshape(-1, 2)
    a = points[None] - spots[:, None]
    b = np.roll(a, -1, axis=1)
    angle = np.arctan2(a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0], (a * b).sum(-1))
    winding = np.round(angle.sum(axis=1) / (2 * np.pi))
    return float((np.abs(winding) >= least).sum() * cell**2)


def test_overlapping_rings_are_united_or_cut_out() -> None:
    pair = square(0, 0, 4), square(2, 2, 4)
    assert areas(regions(*pair)) == [(28, [])]
    assert areas(regions(*pair, rule="evenodd")) == [(12, [])] * 2
    against = square(0, 0, 4), square(2, 2, 4, back=True)
    assert areas(regions(*against)) == [(12, [])] * 2


def test_a_closing_line_that_steps_back_is_no_crossing() -> None:
    """Editors round the last point; curves must stay curves all the same."""
    curves = circle(np.zeros(2), 10.0)
    end = curves[-1, 3] + [-1e-4, -1e-3]
    curves[-1, 3] = end
    drawn = Outline(np.concatenate([curves, line_curves(end, curves[0, 0])[None]]))
    found, said = regions_of(Shape((drawn,), Style()), "disc")
    assert not said
    assert len(found[0].outer.curves) <= 5


def test_spikes_go_and_bridges_to_holes_are_opened() -> None:
    """Outlines that run there and back along themselves show nothing there."""
    spiked = ring((0, 0), (8, 0), (8, 5), (20, 5), (8, 5), (8, 8), (0, 8))
    assert areas(regions(spiked)) == [(64, [])]
    inner = [(3, 3), (3, 6), (6, 6), (6, 3), (3, 3)]
    keyhole = ring((0, 0), *inner, (0, 0), (9, 0), (9, 9), (0, 9))
    assert areas(regions(keyhole)) == [(81, [9])]


def test_specks_do_not_count() -> None:
    flat = ring((0, 0), (5, 0), (10, 0))
    assert areas(regions(square(0, 0, 4), flat)) == [(16, [])]


@pytest.mark.parametrize(
    "drawn",
    [
        ring((0, 0), (5, 5), (10, 10)),
        ring((0, 0), (10, 0)),
        Outline(np.concatenate([(c := circle(np.zeros(2), 1.0)[:1]), c[:, ::-1]])),
    ],
    ids=["straight", "there-and-back", "arc-and-back"],
)
def test_nothing_enclosed_is_refused(drawn: Outline) -> None:
    with pytest.raises(OutlineError, match="cat: the outline encloses no area"):
        regions_of(Shape((drawn,), Style()), "cat")


def test_a_fill_rule_that_shows_nothing_is_refused() -> None:
    with pytest.raises(OutlineError, match="shows nothing"):
        regions(square(0, 0, 4), square(0, 0, 4), rule="evenodd")


def coast(x: float, y: float, radius: float, *, back: bool = False) -> Outline:
    """A closed line of a thousand short sides."""
    angle = np.linspace(0, 2 * np.pi, 1000, endpoint=False)
    reach = radius * (1 + 0.02 * np.sin(37 * angle))
    points = np.stack([x + reach * np.cos(angle), y + reach * np.sin(angle)], axis=1)
    found = ring(*map(tuple, points.tolist()))
    return found.reversed() if back else found


@pytest.mark.parametrize("turned", [False, True])
def test_maps_of_thousands_of_sides_go_by_their_windings(turned: bool) -> None:
    """Land, a lake, an island in it, and land that overlaps land, whichever way land runs."""
    rings = (
        coast(0, 0, 10, back=turned),
        coast(3, 0, 4, back=not turned),
        coast(3, 0, 1, back=turned),
        coast(-9, 0, 5, back=turned),
        coast(-4, -4, 2, back=turned),
    )
    land, lake, island, more, _ = (shapely.Polygon(polygon(r)) for r in rings)
    expected = land.union(more).difference(lake).area
    first, second = regions(*rings)
    assert [len(first.holes), len(second.holes)] == [1, 0]
    assert first.area - first.holes[0].area == pytest.approx(expected, rel=1e-4)
    assert second.area == pytest.approx(island.area, rel=1e-4)


def test_crossing_outlines_keep_their_curves() -> None:
    """Two discs are cut where they meet and nowhere else: six quarters, and two that are parted."""
    discs = [Outline(circle(np.array([x, 0.0]), 2.0)) for x in (0, 2)]
    (united,) = regions(*discs)
    assert len(united.outer.curves) == 8
    lune, other = regions(*discs, rule="evenodd")
    assert [len(lune.outer.curves), len(other.outer.curves)] == [6, 6]


corners = st.lists(
    st.tuples(st.integers(0, 12), st.integers(0, 12)), min_size=3, max_size=7, unique=True
)


@settings(max_examples=40)
@given(corners, st.sampled_from(["nonzero", "evenodd"]))
def test_any_ring_shows_what_its_fill_rule_says(
    drawn: list[tuple[int, int]], rule: FillRule
) -> None:
    """Crossing or not: the regions cover exactly the points that the rule fills."""
    outline = ring(*drawn)
    points = np.array(drawn, dtype=np.float64)
    polygon = shapely.make_valid(shapely.Polygon(points))
    try:
        found = regions(outline, rule=rule)
    except OutlineError:
        assert polygon.area < 1e-6
        return
    shown = shapely.union_all([of_region(region) for region in found])
    assert shown.area == pytest.approx(sum(of_region(region).area for region in found))
    rng = np.random.default_rng(1)
    spots = rng.uniform(0, 12, (60, 2))
    a = points[None] - spots[:, None]
    b = np.roll(a, -1, axis=1)
    angle = np.arctan2(a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0], (a * b).sum(-1))
    winding = np.round(angle.sum(axis=1) / (2 * np.pi)).astype(int)
    filled = winding % 2 == 1 if rule == "evenodd" else winding != 0
    lines = shapely.LinearRing(points)
    for spot, wanted in zip(spots, filled, strict=True):
        place = shapely.Point(spot)
        if lines.distance(place) > 1e-6:
            assert shown.contains(place) == wanted


def of_region(region: Region) -> shapely.Polygon:
    holes = [polygon(hole) for hole in region.holes]
    return shapely.Polygon(polygon(region.outer), holes)


def polygon(outline: Outline) -> Points:
    return flatten(outline.curves, 8)


def test_a_slim_lens_of_two_curves_shows_nothing_and_is_no_matter() -> None:
    lens = ring((0, 0), (1, 0)).curves.copy()
    lens[0, 1:3, 1] = 1e-5
    (found,) = regions(square(0, 0, 10), Outline(lens))
    assert found.outer.area == pytest.approx(100)


def test_a_small_lens_beside_a_large_ring_is_a_piece() -> None:
    lens = ring((20, 20), (20.001, 20)).curves.copy()
    lens[0, 1:3, 1] += 3e-4
    large, small = regions(square(0, 0, 10), Outline(lens))
    assert large.area == pytest.approx(100)
    assert 0 < small.area < 1e-6


def nearly_twice(seed: int) -> tuple[Outline, ...]:
    """A flower drawn twice, the second time a little off, and another."""
    one = star(seed, 5 + seed % 9)
    rng = np.random.default_rng(seed)
    off = rng.uniform(-1, 1, one.shape) * 10.0 ** -(3 + seed % 5)
    two = one * (1 + 2e-5 * (seed % 7)) + off * (rng.random(len(one)) > 0.4)[:, None]
    return tuple(rounded(points) for points in (one, two, -one[::-1] * 0.9))


@pytest.mark.parametrize("unit", [1e-6, 3e-3, 1e6])
def test_what_crossing_rings_show_has_no_unit(unit: float) -> None:
    """Where curves all but touch, the last digit would decide where they meet."""

    def shown(unit: float) -> list[list[int]]:
        matrix = np.array([[unit, 0.0, 0.0], [0.0, unit, 0.0]])
        own = (ring.transformed(matrix) for ring in nearly_twice(118))
        found = regions(*own, rule="evenodd")
        return [[len(ring.curves) for ring in (r.outer, *r.holes)] for r in found]

    assert shown(unit) == shown(1.0)


def test_rings_that_lie_just_beside_each_other_are_outlined_anew() -> None:
    """As large as one another, but meeting nowhere: one outline drawn twice."""
    inner = square(0.00001, 0.00001, 0.99998)
    _, notices = regions_of(Shape((square(0, 0, 1), inner), Style()), "shape")
    assert [notice.kind for notice in notices] == ["outlined-anew"]
    assert regions(*nearly_twice(2), rule="evenodd")
