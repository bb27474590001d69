import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely import Polygon, box

from shapetween.base.arrays import Floats, Points, Quads
from shapetween.photo.coverage import clipped, coverage
from tests.strategies import convex_quads

WIDTH, HEIGHT = 13, 9


def whole(polygon: Points) -> Floats:
    """Shares of all of a frame's pixels."""
    result = np.zeros((HEIGHT, WIDTH))
    found = coverage(polygon, WIDTH, HEIGHT)
    if found is not None:
        height, width = found.shares.shape
        result[found.top : found.top + height, found.left : found.left + width] = found.shares
    return result


def areas(polygon: Points) -> Floats:
    """The same by cutting the polygon at every pixel."""
    shape = Polygon(polygon)
    return np.array(
        [
            [shape.intersection(box(x, y, x + 1, y + 1)).area for x in range(WIDTH)]
            for y in range(HEIGHT)
        ]
    )


@settings(max_examples=40)
@given(convex_quads(), st.floats(2, 30), st.floats(-8, 20), st.floats(-8, 16))
def test_shares_are_areas(quad: Quads, size: float, x: float, y: float) -> None:
    centred = quad - quad.mean(axis=0)
    polygon = centred / np.abs(centred).max() * size + (x, y)
    assert np.abs(whole(polygon) - areas(polygon)).max() < 1e-5
    assert np.abs(whole(polygon[::-1]) - areas(polygon)).max() < 1e-5


@pytest.mark.parametrize(
    "polygon",
    [
        pytest.param([[2, 1], [5, 1], [5, 4], [2, 4]], id="on-pixels"),
        pytest.param([[2.5, 1], [2.5, 1], [6, 4], [2.5, 4]], id="corner-twice"),
        pytest.param([[-5, -5], [40, -5], [40, 40], [-5, 40]], id="whole-frame"),
        pytest.param([[0, 0], [13, 0], [13, 9], [0, 9]], id="exactly-the-frame"),
        pytest.param([[20, 1], [30, 1], [30, 4], [20, 4]], id="outside"),
        pytest.param([[3.2, 3.1], [3.4, 3.1], [3.4, 3.3], [3.2, 3.3]], id="within-a-pixel"),
        pytest.param([[13, 2], [15, 2], [15, 5], [13, 5]], id="touching-the-edge"),
    ],
)
def test_named_cases(polygon: list[list[float]]) -> None:
    points = np.array(polygon, np.float64)
    assert np.abs(whole(points) - areas(points)).max() < 1e-6


@given(st.floats(0.05, 0.95), st.floats(0.05, 0.95))
def test_abutting_faces_leave_nothing_open(s: float, r: float) -> None:
    corners = np.array([[2.0, 1.2], [11.0, 1.5], [10.5, 8.0], [1.5, 7.5]])
    top = corners[0] + s * (corners[1] - corners[0])
    bottom = corners[3] + r * (corners[2] - corners[3])
    left = np.stack([corners[0], top, bottom, corners[3]])
    right = np.stack([top, corners[1], corners[2], bottom])
    assert np.abs(whole(left) + whole(right) - whole(corners)).max() < 1e-5


def test_clipping_keeps_the_order_of_corners() -> None:
    square = np.array([[-2.0, 2.0], [4.0, 2.0], [4.0, 5.0], [-2.0, 5.0]])
    assert clipped(square, 10, 10).tolist() == [[0, 2], [4, 2], [4, 5], [0, 5]]
