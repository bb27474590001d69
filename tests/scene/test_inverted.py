"""Signs that get a plate behind them, which inverts what it covers."""

import numpy as np
import pytest
import shapely
from shapely import affinity

from tests.scene.test_kept import T, drawn, frames, off, path, prepared

#: A bent stroke and a dot, as a question mark has them, and a plate.
SIGN = shapely.union_all(
    [
        shapely.LineString([(38, 30), (62, 30), (62, 48), (50, 48), (50, 58)]).buffer(5),
        shapely.Point(50, 74).buffer(6),
    ]
)
PLATE = shapely.Point(50, 50).buffer(42, quad_segs=64)


@pytest.mark.parametrize("comes", [True, False])
@pytest.mark.parametrize("size", [1.0, 0.7])
def test_a_plate_grows_behind_a_sign_and_inverts_it(comes: bool, size: float) -> None:
    small = affinity.scale(SIGN, size, size, origin=(50, 50))
    whole = PLATE.difference(small)
    ends = path(SIGN), path(whole)
    found = frames(*(ends if comes else ends[::-1]))
    for t, area in zip(T, found, strict=True):
        share = t if comes else 1 - t
        sign = affinity.scale(SIGN, *[1 + share * (size - 1)] * 2, origin=(50, 50))
        disc = shapely.Point(50, 50).buffer(42 * (1 - (1 - share) ** 2), quad_segs=64)
        assert off(area, disc.symmetric_difference(sign)) < 2e-3 * PLATE.area


def test_a_sign_with_a_hole_keeps_it() -> None:
    letter = shapely.box(40, 25, 60, 75).difference(shapely.box(46, 40, 54, 60))
    letter = letter.union(shapely.box(60, 25, 75, 35))
    found = frames(path(letter), path(PLATE.difference(letter)))
    middle = shapely.Point(50, 50).buffer(42 * 0.75, quad_segs=64)
    assert off(found[4], middle.symmetric_difference(letter)) < 5


def test_a_blot_is_not_inverted_and_a_disc_opens_to_a_ring() -> None:
    # A pentagon with a disc behind it is a line in the middle; a ring is a hole that opens.
    pentagon = shapely.Polygon([(50, 10), (88, 38), (74, 82), (26, 82), (12, 38)])
    small = affinity.scale(pentagon, 0.5, 0.5, origin=(50, 50))
    found = frames(path(pentagon), path(PLATE.difference(small)))
    assert min(area.area for area in found) > 0.6 * pentagon.area
    hole = shapely.Point(50, 50).buffer(20)
    opening = frames(path(PLATE), path(PLATE.difference(hole)))
    assert all(area.union(PLATE).area < PLATE.area + 0.1 for area in opening)
    assert all(PLATE.difference(area).difference(hole).area < 0.5 for area in opening)


def test_other_colours_and_other_signs_are_not_inverted() -> None:
    cross = shapely.union(shapely.box(20, 45, 80, 55), shapely.box(45, 20, 55, 80))
    for ends in (
        (path(SIGN, fill="#e00"), path(PLATE.difference(SIGN), fill="#00e")),
        (path(cross), path(PLATE.difference(SIGN))),
    ):
        middle = drawn(prepared(*ends).movement.at(np.array([0.5]))[0])
        disc = shapely.Point(50, 50).buffer(42 * 0.75, quad_segs=64)
        assert off(middle, disc.symmetric_difference(SIGN)) > 100
