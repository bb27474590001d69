"""Areas, corners and crossings of polygons."""

import numpy as np
import pytest
import shapely
from hypothesis import given

from shapetween.base.arrays import Quads
from shapetween.geometry.polygon import (
    corner_sines,
    cross,
    diagonal_crossings,
    polygon_area,
    rms_radius,
)
from tests.mesh.pairs import untangled
from tests.strategies import convex_quads

SQUARE = np.array([[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]])


@pytest.mark.parametrize("seed", range(5))
def test_area_is_shapelys(seed: int) -> None:
    ring = untangled(np.random.default_rng(seed), 12)
    assert polygon_area(ring) == pytest.approx(shapely.Polygon(ring).area)
    assert polygon_area(ring[::-1]) == pytest.approx(-shapely.Polygon(ring).area)


def test_area_far_from_the_origin_keeps_its_digits() -> None:
    assert polygon_area(SQUARE + 1e9) == pytest.approx(4, rel=1e-6)


def test_sines_say_convex_or_not() -> None:
    faces = {
        "square": SQUARE,
        "straight-corner": np.array([[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [0.0, 2.0]]),
        "dart": np.array([[0.0, 0.0], [2.0, 0.0], [0.5, 0.5], [0.0, 2.0]]),
        "bow-tie": SQUARE[[0, 2, 1, 3]],
        "no-side": SQUARE[[0, 0, 1, 2]],
    }
    sines = {name: corner_sines(face) for name, face in faces.items()}
    np.testing.assert_allclose(sines["square"], 1)
    assert sines["straight-corner"][1] == 0
    assert (sines["dart"] < 0).sum() == 1
    assert (sines["bow-tie"] < 0).sum() == 2
    assert (sines["no-side"][:2] == 0).all()
    assert (corner_sines(SQUARE[::-1]) < 0).all()


@given(convex_quads())
def test_diagonals_cross_on_both_diagonals(quad: Quads) -> None:
    place = diagonal_crossings(quad)
    size = np.ptp(quad)
    for a, b in ((quad[0], quad[2]), (quad[1], quad[3])):
        assert abs(cross(b - a, place - a)) < 1e-9 * size**2
        assert 0 < (place - a) @ (b - a) < (b - a) @ (b - a)


def test_radius() -> None:
    assert rms_radius(SQUARE + 7) == pytest.approx(np.sqrt(2))
