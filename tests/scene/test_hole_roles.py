"""Holes become each other by place, size and role."""

import numpy as np
import shapely
from shapely import affinity

from shapetween.geometry.bezier import flatten
from shapetween.model.outline import Outline
from shapetween.model.paint import Colour, Style
from shapetween.scene.items import Item
from shapetween.scene.motion.holes import Opening, hole_tracks
from shapetween.scene.motion.tracks import Blend
from shapetween.scene.places import Pieces
from tests.drawings import ring, square
from tests.scene.strokes import arc

INK = Style(fill=Colour())


def plate(*holes: Outline) -> Item:
    return Item((square(0, 0, 100), *holes), INK)


def disc(x: float, y: float, radius: float) -> Outline:
    return arc((x, y), radius, 0, 4)


def still() -> Blend:
    whole = plate().outer.curves
    return Blend(Pieces(whole, whole, True), np.zeros((2, 2)))


def becomes(first: Item, second: Item) -> list[tuple[tuple[float, ...], tuple[float, ...]]]:
    """Middles of each hole at both ends."""
    outer = Blend(Pieces(first.outer.curves, second.outer.curves, True), np.zeros((2, 2)))
    found = []
    for track in hole_tracks(first, second, outer):
        ends = track.curves(np.array([0.0, 1.0]))[:, :, 0]
        middles = (ends.min(axis=1) + ends.max(axis=1)) / 2
        found.append(tuple(tuple(np.round(m, 3).tolist()) for m in middles))
    return sorted(found)  # type: ignore[arg-type]


def test_the_only_round_hole_is_the_eye_wherever_it_is() -> None:
    slot = ring([(60, 60), (90, 60), (90, 66), (60, 66)])
    first, second = plate(disc(20, 20, 5), slot), plate(disc(75, 35, 5))
    assert ((20.0, 20.0), (75.0, 35.0)) in becomes(first, second)


def test_large_holes_become_large_ones_where_both_are_near() -> None:
    small, large = square(28, 33, 4), square(21, 51, 18)
    other_large, other_small = square(58, 41, 18), square(40, 48, 4)
    pairs = becomes(plate(small, large), plate(other_large, other_small))
    assert ((30.0, 35.0), (42.0, 50.0)) in pairs
    assert ((30.0, 60.0), (67.0, 50.0)) in pairs


def test_holes_far_apart_open_and_close() -> None:
    first, second = plate(square(5, 5, 8)), plate(square(85, 85, 8))
    assert len(becomes(first, second)) == 2


def plus(x: float, y: float, reach: float) -> Outline:
    own = reach / 3
    corners = [(own, reach), (own, own), (reach, own)]
    turned = [(a, b) for a, b in corners]
    for _ in range(3):
        corners = [(b, -a) for a, b in corners]
        turned += corners
    return ring([(x + a, y + b) for a, b in turned]).clockwise()


def seen(first: Item, second: Item) -> list[tuple[float, float]]:
    """From when until when each lone hole is seen."""
    outer = Blend(Pieces(first.outer.curves, second.outer.curves, True), np.zeros((2, 2)))
    times = np.linspace(0, 1, 41)
    found = []
    for track in hole_tracks(first, second, outer):
        if isinstance(track, Opening):
            sizes = np.ptp(track.curves(times), axis=(1, 2)).max(axis=1)
            there = times[sizes > 1e-9]
            found.append((float(there.min()), float(there.max())))
    return sorted(found)


def test_a_plus_closes_before_a_window_opens_in_its_place() -> None:
    found = seen(plate(plus(50, 50, 20)), plate(square(35, 35, 30)))
    assert len(found) == 2
    assert found[0][1] <= 0.5 <= found[1][0]


def test_one_pip_does_not_become_one_of_four() -> None:
    four = [disc(x, y, 6) for x in (25, 75) for y in (25, 75)]
    assert len(becomes(plate(disc(50, 50, 6)), plate(*four))) == 5
    # Two of three that stay where they are do so.
    pairs = becomes(plate(four[0], four[3]), plate(four[0], disc(50, 50, 6), four[3]))
    assert sum(one == other for one, other in pairs) == 3


def test_a_hole_goes_nowhere_over_another_one() -> None:
    slot = ring([(47, 20), (53, 20), (53, 80), (47, 80)])
    first, second = plate(disc(35, 50, 8), slot), plate(disc(65, 50, 8))
    assert len(becomes(first, second)) == 3


def test_a_hole_closes_before_what_it_lies_in_has_gone() -> None:
    first = Item((ring([(0, 0), (90, 0), (90, 30), (0, 30)]), disc(80, 15, 8)), INK)
    corners = [(0, 0), (45, 0), (45, 30), (0, 30)]
    second = Item((ring(corners),), INK)
    still = Blend(Pieces(first.outer.curves, second.outer.curves, True), np.zeros((2, 2)))
    (track,) = hole_tracks(first, second, still)
    times = np.linspace(0, 1, 21)
    hole, area = track.curves(times), still.curves(times)
    gone = np.ptp(hole, axis=(1, 2)).max(axis=1) < 1e-9
    assert gone[-1]
    inside = hole[..., 0].max(axis=(1, 2)) <= area[..., 0].max(axis=(1, 2)) + 0.1
    assert (gone | inside).all()


def test_a_hole_that_a_bar_divides_is_cut_where_the_bar_will_be() -> None:
    first = plate(square(30, 20, 40))
    second = plate(
        ring([(30, 20), (70, 20), (70, 37), (30, 37)]),
        ring([(30, 43), (70, 43), (70, 60), (30, 60)]),
    )
    for one, other in ((first, second), (second, first)):
        outer = Blend(Pieces(one.outer.curves, other.outer.curves, True), np.zeros((2, 2)))
        tracks = hole_tracks(one, other, outer)
        assert len(tracks) == 2
        halves = [track.curves(np.array([0.0, 0.5, 1.0])) for track in tracks]
        widths = [np.ptp(half[..., 0], axis=(1, 2)) for half in halves]
        np.testing.assert_allclose(widths, 40, atol=1e-6)
        heights = [np.ptp(half[..., 1], axis=(1, 2)) for half in halves]
        ends = [20, 18.5, 17] if one is first else [17, 18.5, 20]
        np.testing.assert_allclose(heights, [ends, ends], atol=0.5)


def test_the_hole_that_makes_a_frame_stays_one_whatever_its_form() -> None:
    star = ring([(50, 5), (62, 38), (95, 50), (62, 62), (50, 95), (38, 62), (5, 50), (38, 38)])
    assert len(becomes(plate(square(5, 5, 90)), plate(square(8, 8, 84)))) == 1
    hollow = ring([(10, 10), (90, 10), (90, 90), (60, 90), (50, 60), (40, 90), (10, 90)])
    assert len(becomes(plate(square(5, 5, 90)), plate(hollow))) == 1
    assert len(becomes(plate(square(40, 40, 10)), plate(star))) == 2


def test_a_bold_letter_becomes_a_light_one() -> None:
    bold, light = plus(50, 50, 20), plus(50, 50, 16)
    assert len(becomes(plate(bold), plate(light))) == 1


def test_a_hole_that_is_symmetric_at_both_ends_stays_so() -> None:
    chevron = ring([(20, 20), (50, 40), (80, 20), (80, 32), (50, 52), (20, 32)])
    kite = ring([(50, 12), (80, 40), (50, 70), (20, 40)])
    (track,) = hole_tracks(plate(chevron), plate(kite), still())
    for curves in track.curves(np.linspace(0, 1, 7)):
        points = flatten(curves[None], 16).reshape(-1, 2)
        area = shapely.Polygon(points)
        image = affinity.scale(area, -1, 1, origin=(50, 0))
        assert area.symmetric_difference(image).area < 1e-3 * area.area


def test_a_page_does_not_melt_into_hands_but_an_even_opening_becomes_another() -> None:
    page = ring([(20, 30), (80, 30), (80, 80), (20, 80)])
    hands = ring([(48, 20), (53, 20), (53, 50), (70, 60), (67, 64), (48, 54)])
    assert len(becomes(plate(page), plate(hands))) == 2
    chevron = ring([(20, 20), (50, 40), (80, 20), (80, 30), (50, 50), (20, 30)])
    kite = ring([(50, 12), (80, 40), (50, 70), (20, 40)])
    assert len(becomes(plate(chevron), plate(kite))) == 1


def test_a_bar_that_comes_stays_level_in_a_bubble_whose_tail_changes_sides() -> None:
    bubble = ring([(0, 0), (100, 0), (100, 80), (20, 80), (0, 100)])
    other = ring([(0, 0), (100, 0), (100, 100), (80, 80), (0, 80)])
    bar = ring([(20, 30), (80, 30), (80, 40), (20, 40)])
    first, second = Item((bubble,), INK), Item((other, bar), INK)
    outer = Blend(Pieces(bubble.curves, other.curves, True), np.zeros((2, 2)))
    (track,) = hole_tracks(first, second, outer)
    for curves in track.curves(np.array([0.6, 0.8, 1.0])):
        assert np.unique(np.round(curves[:, 0, 1], 6)).size == 2


def test_a_dot_is_not_one_of_two_eyes() -> None:
    """Of dots above each other none goes aside to be an eye; a level row of dots may."""
    eye = np.array([(-9, -9), (9, -2), (9, 2), (-9, 9), (-3, 0)], dtype=float)
    eyes = [
        ring([(x + s * float(a), 40 + float(b)) for a, b in eye[::s]])
        for x, s in ((30, 1), (70, -1))
    ]
    column = becomes(plate(disc(50, 30, 6), disc(50, 55, 6)), plate(*eyes))
    assert ((50.0, 30.0), (30.0, 40.0)) not in column
    assert len(column) == 4
    assert len(becomes(plate(disc(36, 40, 6), disc(64, 40, 6)), plate(*eyes))) == 2
