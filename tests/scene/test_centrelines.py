"""Centre lines are found again where strokes were outlined, and nowhere else."""

import numpy as np
import pytest
import shapely

from shapetween.fill.regions import regions_of
from shapetween.geometry.bezier import evaluate
from shapetween.model.outline import Outline
from shapetween.scene.strokes.axis_fit import fit_curves
from shapetween.scene.strokes.centrelines import centre_lines, is_broad, run_into
from shapetween.scene.strokes.segmentation import outlined_strokes
from shapetween.svg.read.reader import read_svg
from tests.scene.strokes import arc, flat, painted, polyline

CHECK = [polyline((4, 13), (9, 18), (20, 6))]
PLUS = [polyline((4, 12), (20, 12)), polyline((12, 4), (12, 20))]
CROSS = [polyline((5, 5), (19, 19)), polyline((19, 5), (5, 19))]
ARROW = [polyline((3, 12), (21, 12)), polyline((14, 5), (21, 12), (14, 19))]
GLASS = [arc((10, 10), 6, 0, 4), polyline((14.2, 14.2), (21, 21))]
SHACKLE = [arc((12, 10), 5, 90, 3)]
RING = [arc((12, 12), 8, 0, 4)]
TEE = [polyline((3, 6), (21, 6)), polyline((12, 6), (12, 21))]
BAR = [polyline((3, 12), (21, 12))]

STROKES = {
    "bar": BAR,
    "check": CHECK,
    "plus": PLUS,
    "cross": CROSS,
    "arrow": ARROW,
    "magnifier": GLASS,
    "shackle": SHACKLE,
    "ring": RING,
    "tee": TEE,
}


def distance(found: Outline, drawn: list[Outline]) -> float:
    """Greatest distance of a line from the nearest of some others."""
    lines = shapely.union_all([shapely.LineString(_chords(line)) for line in drawn])
    return float(shapely.distance(lines, shapely.points(_chords(found))).max())


def _chords(line: Outline) -> np.ndarray:
    return np.concatenate([flat(line.curves), line.curves[-1:, 3]])


@pytest.mark.parametrize("name", STROKES)
@pytest.mark.parametrize("angle", [0, 17])
@pytest.mark.parametrize("scale", [1e-3, 1.0, 1e5])
def test_strokes_are_found_again(name: str, angle: int, scale: float) -> None:
    a = np.deg2rad(angle)
    turn = scale * np.array([[np.cos(a), -np.sin(a), 3], [np.sin(a), np.cos(a), -7]])
    drawn = [line.transformed(turn) for line in STROKES[name]]
    width = 1.6 * scale
    found = centre_lines(painted(drawn, width))
    assert found is not None
    lines, measured = found
    assert measured == pytest.approx(width, rel=0.01)
    assert len(lines) == len(drawn)
    assert sorted(item.line.closed for item in lines) == sorted(line.closed for line in drawn)
    for item in lines:
        assert distance(item.line, drawn) < 0.05 * width
    for line in drawn:
        # A handle starts at the ring's middle line, inside of its own stroke.
        assert distance(line, [item.line for item in lines]) < 0.15 * width


def test_lines_go_straight_on_at_crossings_and_end_on_others() -> None:
    found = centre_lines(painted(ARROW, 1.6))
    assert found is not None
    shaft, head = sorted(found[0], key=lambda item: len(item.line.curves))
    assert sorted(shaft.free) == [False, True]
    assert head.free == (True, True)
    crossing = centre_lines(painted(PLUS, 1.6))
    assert crossing is not None
    assert all(item.free == (True, True) for item in crossing[0])
    assert all(len(item.line.curves) == 1 for item in crossing[0])


def star(points: int, inner: float) -> shapely.Polygon:
    k = np.arange(2 * points)
    radius = np.where(k % 2 == 0, 10, inner)
    angle = np.pi * k / points
    return shapely.Polygon(np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=1))


BODIES = {
    "disc": shapely.Point(0, 0).buffer(9),
    "square": shapely.box(0, 0, 10, 10),
    "short bar": shapely.box(0, 0, 12, 4),
    "triangle": shapely.Polygon([(0, 0), (10, 6), (0, 12)]),
    "star": star(5, 4),
    "gear": star(12, 8),
    "nut": shapely.Point(0, 0).buffer(9).difference(shapely.Point(0, 0).buffer(3)),
    "wedge": shapely.Polygon([(0, 0), (20, 2), (20, 3)]),
    "lens": shapely.Point(-8, 0).buffer(10).intersection(shapely.Point(8, 0).buffer(10)),
    "paddle": shapely.Point(0, 0).buffer(6).union(shapely.box(0, -1, 20, 1)),
}


@pytest.mark.parametrize("name", BODIES)
def test_bodies_have_none(name: str) -> None:
    assert centre_lines(BODIES[name]) is None


@pytest.mark.parametrize("name", ["disc", "square", "triangle", "gear", "paddle"])
def test_bodies_are_told_by_a_quick_look(name: str) -> None:
    assert is_broad(BODIES[name])


@pytest.mark.parametrize("width", [0.5, 1.6, 3.0])
def test_no_stroke_is_taken_for_a_body_at_a_glance(width: float) -> None:
    """Also where thick ones cross, and hardly anything is left of them between."""
    for name, lines in STROKES.items():
        assert not is_broad(painted(lines, width)), name
    level = [polyline((4, y), (20, y)) for y in (8, 16)]
    grid = level + [polyline((x, 4), (x, 20)) for x in (8, 16)]
    assert not is_broad(painted(grid, width))


def test_a_line_that_is_all_there_is_runs_into_nothing() -> None:
    place, ahead = np.array([1.0, 2.0]), np.array([1.0, 0.0])
    assert run_into(place, ahead, [], 0.5) is None
    meet = run_into(place, ahead, [shapely.LineString([(2, 0), (2, 4)])], 0.5)
    assert meet is not None
    np.testing.assert_allclose(meet, np.array([2.0, 2.0]))


def test_an_arc_is_not_cut_for_the_noise_at_its_ends() -> None:
    """A wave whose caps lie aside of its middle: by the points next to its end an arc bends off."""
    wave = "M20 5a1 1 0 0 0-1.4 1.4 8 8 0 0 1 0 11.2 1 1 0 0 0 1.4 1.4 10 10 0 0 0 0-14z"
    svg = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 24 24"><path d="{wave}"/></svg>'
    (region,), _ = regions_of(read_svg(svg.encode(), "wave.svg").shapes[0], "wave")
    strokes = outlined_strokes(region)
    assert strokes is not None
    (stroke,) = strokes
    assert len(stroke.line.line.curves) == 1  # five by directions alone
    middle = (20 - np.sqrt(10**2 - 7**2) + 18.6 - np.sqrt(8**2 - 5.6**2)) / 2
    away = np.hypot(*(_chords(stroke.line.line) - [middle, 12.0]).T)
    assert np.abs(away - 9).max() < 0.03


@pytest.mark.parametrize("seed", range(4))
def test_a_free_end_is_as_near_as_all_else(seed: int) -> None:
    """Noisy points of an arc, the ends of them too, are one curve within the noise."""
    tolerance = 1e-3
    angle = np.linspace(0.0, np.pi / 2, 90)
    noise = tolerance * np.random.default_rng(seed).uniform(-0.6, 0.6, len(angle))
    points = (1 + noise)[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    (curve,) = fit_curves(points, tolerance, 0.1, closed=False)
    assert np.abs(np.hypot(*evaluate(curve, np.arange(65) / 64).T) - 1).max() < tolerance
    assert np.hypot(*(curve[[0, 3]] - points[[0, -1]]).T).max() < 3 * tolerance
