"""Areas that are a body with strokes on it: the strokes move as strokes, over the body."""

import numpy as np
import pytest
import shapely

from shapetween.scene.items import Item, items_of
from shapetween.scene.limbs import with_limbs
from shapetween.svg.read.reader import read_svg
from tests.scene.test_kept import PAGE, T, drawn, path, prepared

LOCKED = (
    "<path d='M22 50H30V32A20 20 0 0 1 70 32V50H78A4 4 0 0 1 82 54V86A4 4 0 0 1 78 90H22A4 4 0 0 1"
    " 18 86V54A4 4 0 0 1 22 50ZM37 50H63V32A13 13 0 0 0 37 32Z' fill-rule='evenodd'/>"
)
OPEN = (
    "<path d='M12 50H48V32A20 20 0 0 1 88 32V44A3.5 3.5 0 0 1 81 44V32A13 13 0 0 0 55 32V50H68"
    "A4 4 0 0 1 72 54V86A4 4 0 0 1 68 90H12A4 4 0 0 1 8 86V54A4 4 0 0 1 12 50Z'/>"
)


def items(text: str) -> tuple[Item, ...]:
    return items_of(read_svg(f"{PAGE}{text}</svg>".encode(), "x").shapes, "x")[0]


def test_a_shackle_is_cut_off_its_body_by_straight_lines() -> None:
    found = with_limbs(items(LOCKED), items(OPEN))
    assert found is not None
    (body, bow), (other, turned) = found
    for one, shackle in ((body, bow), (other, turned)):
        assert one.filled
        assert one.box[0, 1] == pytest.approx(50)
        assert not shackle.filled
        assert shackle.width == pytest.approx(7, rel=0.01)
    assert body.area == pytest.approx(64 * 40 - (4 - np.pi) * 16, rel=1e-3)


def test_a_lock_opens_with_its_shackle_at_constant_width_and_no_bent_body() -> None:
    found = [drawn(frame) for frame in prepared(LOCKED, OPEN).movement.at(T)]
    for t, area in zip(T, found, strict=True):
        below = area.intersection(shapely.box(0, 55, 100, 100))
        low, high = np.array(below.bounds)[[0, 2]]
        np.testing.assert_allclose([low, high], [18 - 10 * t, 82 - 10 * t], atol=0.05)
        assert below.area == pytest.approx(64 * 35 - (4 - np.pi) * 8, rel=2e-3)
        # Round the bow it is as wide as ever.
        bow = area.intersection(shapely.box(0, 0, 100, 30))
        assert 2 * bow.area / (bow.length - 14) == pytest.approx(7, rel=0.1)


def test_nothing_is_lost_where_strokes_leave_the_body() -> None:
    first, last = (drawn(f) for f in prepared(LOCKED, OPEN).movement.at(np.array([0.0, 1.0])))
    for area, text in ((first, LOCKED), (last, OPEN)):
        whole = drawn(read_svg(f"{PAGE}{text}</svg>".encode(), "x"))
        assert area.symmetric_difference(whole).area < 1.0


@pytest.mark.parametrize(
    "area",
    [shapely.box(20, 20, 80, 80), shapely.Point(50, 50).buffer(30)],
    ids=["box", "disc"],
)
def test_bodies_without_strokes_stay_whole(area: shapely.Geometry) -> None:
    assert with_limbs(items(path(area)), items(LOCKED)) is None


def test_drawings_with_other_numbers_of_strokes_stay_whole() -> None:
    body = shapely.box(20, 50, 80, 90)
    arms = [shapely.LineString([(x, 55), (x, 10)]).buffer(3) for x in (35, 65)]
    one, two = (path(shapely.union_all([body, *some])) for some in (arms[:1], arms))
    assert with_limbs(items(one), items(one)) is not None
    assert with_limbs(items(one), items(two)) is None


def test_a_ring_on_a_stick_is_all_stroke() -> None:
    ring = shapely.Point(40, 40).buffer(25).difference(shapely.Point(40, 40).buffer(19))
    glass = ring.union(shapely.LineString([(57, 57), (85, 85)]).buffer(3))
    assert with_limbs(items(path(glass)), items(LOCKED)) is None
