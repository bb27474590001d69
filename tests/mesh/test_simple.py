import numpy as np
import pytest
import shapely

from shapetween.base.arrays import Points
from shapetween.geometry.polygon import polygon_area
from shapetween.mesh.simple import cheapest_triangulation, inner_diagonals, touching_sides
from tests.mesh.pairs import comb, regular, spiral, star, untangled

RINGS = {
    "disc": regular(12),
    "star": star(6),
    "comb": comb(3),
    "spiral": spiral()[::2],
    **{f"random-{seed}": untangled(np.random.default_rng(seed), 16) for seed in range(6)},
}


@pytest.fixture(params=list(RINGS))
def ring(request: pytest.FixtureRequest) -> Points:
    points = RINGS[request.param]
    return np.asarray(points / np.sqrt(polygon_area(points)))


def test_inner_diagonals_are_those_inside(ring: Points) -> None:
    inside = inner_diagonals(ring)
    shape = shapely.Polygon(ring)
    for i in range(len(ring)):
        for j in range(i + 1, len(ring)):
            if j - i in (1, len(ring) - 1):
                assert not inside[i, j]
                continue
            line = shapely.LineString(ring[[i, j]])
            proper = shape.covers(line) and all(
                line.distance(shapely.Point(p)) > 1e-9
                for k, p in enumerate(ring)
                if k not in (i, j)
            )
            assert inside[i, j] == inside[j, i] == proper


def test_simple_polygons_have_no_touching_sides(ring: Points) -> None:
    assert not touching_sides(ring).any()


@pytest.mark.parametrize(
    ("name", "ring", "touching"),
    [
        ("bow-tie", [[0, 0], [1, 1], [1, 0], [0, 1]], [0, 2]),
        ("corner-on-side", [[0, 0], [2, 0], [2, 2], [1, 0], [0, 2]], [0, 2, 3]),
        ("spike", [[0, 0], [1, 0], [1, 1], [1, 3], [1, 1.5], [0, 1]], [2, 3, 4]),
    ],
)
def test_touching_sides_are_told(name: str, ring: Points, touching: list[int]) -> None:
    found = touching_sides(np.array(ring, dtype=float))
    assert np.flatnonzero(found).tolist() == touching


def test_triangulations_cover_the_polygon(ring: Points) -> None:
    count = len(ring)
    allowed = inner_diagonals(ring)
    diagonals = cheapest_triangulation(ring, allowed, np.zeros((count, count)))
    assert len(diagonals) == count - 3
    assert allowed[diagonals[:, 0], diagonals[:, 1]].all()
    for a, b in diagonals:
        for c, d in diagonals:
            assert not a < c < b < d


def test_straight_corners_get_no_empty_triangles() -> None:
    square = np.array([[0.0, 0], [1, 0], [2, 0], [3, 0], [3, 3], [2, 3], [1, 3], [0, 3]])
    diagonals = cheapest_triangulation(square, inner_diagonals(square), np.zeros((8, 8)))
    assert len(diagonals) == 5
    assert not {(0, 2), (1, 3), (0, 3), (4, 6), (5, 7), (4, 7)} & set(
        map(tuple, diagonals.tolist())
    )


def test_cheap_diagonals_are_preferred() -> None:
    hexagon = regular(6)
    price = np.ones((6, 6))
    price[1, 4] = price[1, 3] = price[1, 5] = 0
    diagonals = cheapest_triangulation(hexagon, inner_diagonals(hexagon), price)
    assert diagonals.tolist() == [[1, 3], [1, 4], [1, 5]]
