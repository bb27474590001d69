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
