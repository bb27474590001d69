"""A ring that becomes an open shape is cut where the mouth will be, and opens there."""

import numpy as np
import pytest
import shapely
from shapely import affinity

from shapetween.pipeline import prepare
from shapetween.svg.read.reader import read_svg
from tests.scene.test_kept import PAGE, drawn, off, path

T = np.linspace(0, 1, 9)


def oval(x: float, y: float, a: float, b: float) -> shapely.Geometry:
    return affinity.scale(shapely.Point(x, y).buffer(1, 16), a, b, origin=(x, y))


RING = oval(50, 50, 40, 42).difference(oval(50, 50, 22, 34))
WEDGE = shapely.Polygon([(52, 50), (100, 28), (100, 72)])
C = oval(50, 50, 40, 42).difference(oval(54, 50, 24, 36)).difference(WEDGE)
U = shapely.box(15, 10, 85, 90).difference(shapely.box(38, 0, 62, 60))
CUP = shapely.box(15, 10, 85, 90).difference(shapely.box(25, 0, 75, 20))


def frames(first: shapely.Geometry, second: shapely.Geometry) -> list[shapely.Geometry]:
    one, other = (read_svg(f"{PAGE}{path(area)}</svg>".encode(), "x") for area in (first, second))
    return [drawn(frame) for frame in prepare(one, other).movement.at(T)]


@pytest.mark.parametrize(("shape", "mouth"), [(C, (80, 50)), (U, (50, 14))])
def test_a_ring_opens_at_the_mouth_and_its_hole_is_never_filled(
    shape: shapely.Geometry, mouth: tuple[int, int]
) -> None:
    way = shapely.LineString([(50, 45), mouth]).buffer(0.2)
    for first, second, step in ((RING, shape, 1), (shape, RING, -1)):
        found = frames(first, second)[::step]
        assert off(found[0], RING) < 0.05
        assert off(found[-1], shape) < 0.05
        for area in found[1:]:
            assert area.geom_type == "Polygon"
            assert not area.interiors
            assert area.intersection(way).area < 0.2 * way.area
            # The walls keep about their weight: nothing swells.
            assert area.area < 1.15 * max(RING.area, shape.area)


def test_a_bowl_is_no_mouth() -> None:
    found = frames(RING, CUP)
    assert found[1].interiors
