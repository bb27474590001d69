"""Drawings crossed out for which all was drawn anew: the slash shows the second one behind it."""

import numpy as np
import pytest
import shapely
from shapely import affinity

from shapetween.scene.items import items_of
from shapetween.scene.kept.redrawn import crossed_tracks
from shapetween.svg.read.reader import read_svg
from tests.match.alphabet import drawn
from tests.scene.test_kept import PAGE, T, frames, off, path, prepared

BODY = shapely.union_all(
    [shapely.Point(50, 38).buffer(22, quad_segs=12), shapely.box(46, 66, 54, 90)]
)
SLASH = shapely.LineString([(12, 88), (88, 12)]).buffer(4)
ANEW = affinity.scale(BODY, 0.96, 0.97, origin=(50, 50))
CROSSED = ANEW.difference(SLASH.buffer(5)).union(SLASH)


@pytest.mark.parametrize("comes", [True, False])
def test_behind_the_tip_is_the_second_drawing_and_before_it_the_first(comes: bool) -> None:
    ends = path(BODY), path(CROSSED)
    found = frames(*(ends if comes else ends[::-1]))
    both = BODY.union(CROSSED)
    ahead = np.array([-1, 1]) / np.sqrt(2)
    places = shapely.get_coordinates(both) @ ahead
    low, high = float(places.min()), float(places.max())
    for t, area in zip(T, found, strict=True):
        tip = low + (t if comes else 1 - t) * (high - low)
        corner = tip * ahead
        across = np.array([300, 300])
        far = corner - 600 * ahead
        behind = shapely.Polygon([corner - across, corner + across, far + across, far - across])
        shown = CROSSED.intersection(behind).union(BODY.difference(behind))
        assert off(area, shown) < 12


def test_another_body_behind_a_slash_is_not_revealed() -> None:
    other = affinity.scale(BODY, 0.6, 1.0, origin=(50, 50)).difference(SLASH.buffer(5)).union(SLASH)
    items = [
        items_of(read_svg(f"{PAGE}{path(area)}</svg>".encode(), "x").shapes, "x")[0]
        for area in (BODY, other)
    ]
    assert crossed_tracks((items[0], items[1]), 140.0) is None
    anew = items_of(read_svg(f"{PAGE}{path(CROSSED)}</svg>".encode(), "x").shapes, "x")[0]
    assert crossed_tracks((items[0], anew), 140.0) is not None


def test_a_slash_drawn_anew_is_no_exchange() -> None:
    scene = prepared(path(BODY), path(CROSSED)).scene
    assert scene is not None
    assert scene.matched is None
    assert any(role.reason == "kept" for role in scene.roles.pairs)


def test_a_letter_that_is_little_but_its_bar_is_not_crossed_out() -> None:
    """A J shares nothing with an I but what lies beside its stem."""
    items = [items_of(drawn(letter).shapes, letter)[0] for letter in "IJ"]
    assert crossed_tracks((items[0], items[1]), 24.0) is None


@pytest.mark.parametrize(("size", "is_one"), [(5.5, True), (9.5, False)])
def test_what_has_a_thing_more_away_from_its_bar_is_not_only_crossed_out(
    size: float, is_one: bool
) -> None:
    crossed = BODY.difference(SLASH.buffer(5)).union(SLASH)
    more = crossed.union(shapely.box(14, 40, 14 + size, 40 + size))
    items = [
        items_of(read_svg(f"{PAGE}{path(area)}</svg>".encode(), "x").shapes, "x")[0]
        for area in (BODY, more)
    ]
    assert (crossed_tracks((items[0], items[1]), 140.0) is not None) is is_one


FRAME = shapely.box(25, 15, 75, 85).buffer(4)
THIN = FRAME.difference(FRAME.buffer(-2.5))
BAR = shapely.LineString([(10, 90), (90, 10)])


def crossed(first: shapely.Geometry, second: shapely.Geometry) -> bool:
    """Whether one of two areas is the other one crossed out, on a page of 100."""
    one, other = (
        items_of(read_svg(f"{PAGE}{path(area)}</svg>".encode(), "x").shapes, "x")[0]
        for area in (first, second)
    )
    comes = crossed_tracks((one, other), 100.0) is not None
    assert (crossed_tracks((other, one), 100.0) is not None) is comes
    return comes


@pytest.mark.parametrize(("aside", "is_one"), [(1.4, True), (3.0, False)])
def test_a_thin_outline_drawn_a_little_aside_is_crossed_out(aside: float, is_one: bool) -> None:
    """Nothing of it coincides, and the slash runs through its walls without a gap."""
    assert crossed(THIN, affinity.translate(THIN, aside).union(BAR.buffer(1.2))) is is_one


def test_a_slash_that_other_changes_touch_is_drawn_along_its_length() -> None:
    """Rings in one another come apart under it, so what is new there is no bar."""
    rings = [shapely.Point(*c).buffer(22) for c in ((36, 64), (64, 36))]
    walls = [ring.difference(ring.buffer(-7)) for ring in rings]
    over = shapely.box(0, 0, 100, 50).intersection(walls[0]).buffer(3)
    linked = walls[0].union(walls[1].difference(over))
    slash = shapely.LineString([(14, 14), (86, 86)]).buffer(3.5)
    apart = shapely.union_all(walls).difference(slash.buffer(6)).union(slash)
    assert crossed(linked, apart)
    found = frames(path(linked), path(apart))
    before = found[4].difference(linked.buffer(0.5)).difference(apart.buffer(0.5))
    assert before.area < 1e-6  # nothing is drawn that neither has


@pytest.mark.parametrize(
    ("slash", "is_one"),
    [
        (BAR.buffer(0.6), True),
        (BAR.buffer(0.4), False),
        (BAR.buffer(6.5, cap_style="flat"), True),
        (BAR.buffer(8.5, cap_style="flat"), False),
        (shapely.Polygon([(9, 89), (11, 91), (91.3, 11.3), (88.7, 8.7)]), True),
        (shapely.Polygon([(9, 89), (11, 91), (92.4, 12.4), (87.6, 7.6)]), False),
        (shapely.LineString([(50, 2), (50, 98)]).buffer(1.5), False),
        (shapely.LineString([(38, 2), (80, 98)]).buffer(1.5), True),
        (shapely.LineString([(28, 72), (60, 40)]).buffer(1.5), False),
    ],
)
def test_slashes_are_long_oblique_bars(slash: shapely.Geometry, is_one: bool) -> None:
    assert crossed(THIN, affinity.translate(THIN, 0.8).union(slash)) is is_one


def test_a_slash_that_much_crosses_is_one() -> None:
    """Edges of its sides are as short as what is between the lines that it crosses."""
    lines = shapely.union_all([shapely.box(10, y, 90, y + 2) for y in range(12, 90, 8)])
    assert crossed(lines, affinity.translate(lines, 0, 0.6).union(BAR.buffer(1.2)))


def test_a_slash_ends_although_an_edge_runs_on_beside_it() -> None:
    roof = shapely.Polygon([(41, 60.4), (93, 8.4), (95.2, 10.6), (43.2, 62.6)])
    slash = shapely.LineString([(12, 88), (66, 34)]).buffer(2.8, cap_style="flat")
    house = shapely.union_all([THIN, roof, shapely.box(30, 20, 45, 40)])
    assert crossed(house, house.union(slash))


def test_a_bow_across_is_no_slash() -> None:
    bow = shapely.Point(120, 120).buffer(141, quad_segs=40).boundary.buffer(1.2)
    across = bow.intersection(shapely.box(2, 2, 98, 98))
    assert not crossed(THIN, affinity.translate(THIN, 0.8).union(across))


def test_a_slash_comes_in_another_colour() -> None:
    other = affinity.translate(THIN, 0.8).union(BAR.buffer(1.2))
    scene = prepared(path(THIN), path(other, "#161a1e")).scene
    assert scene is not None
    assert [role.reason for role in scene.roles.pairs] == ["kept"]
