"""What every user is promised, on real drawings: DESIGN's exact ends, similarity, no units."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import shapely
from scipy.spatial import KDTree

from shapetween.base.arrays import Affine, Points
from shapetween.geometry.bezier import evaluate, sub_curves
from shapetween.model.drawing import Box, Drawing
from shapetween.model.outline import Outline
from shapetween.pipeline import Options, Prepared, prepare
from shapetween.svg.read.reader import read_svg
from tests.strategies import rotation

INPUTS = Path(__file__).resolve().parents[1] / "gallery" / "inputs"
T = np.array([0.0, 0.25, 0.5, 0.8, 1.0])


def drawing(name: str) -> Drawing:
    return read_svg((INPUTS / f"{name}.svg").read_bytes(), name)


@pytest.fixture(scope="module")
def horse() -> Drawing:
    return drawing("horse")


@pytest.fixture(scope="module")
def kangaroo() -> Drawing:
    return drawing("kangaroo")


@pytest.fixture(scope="module")
def base(horse: Drawing, kangaroo: Drawing) -> Prepared:
    return prepare(horse, kangaroo)


def moved(drawing: Drawing, matrix: Affine) -> Drawing:
    return drawing.transformed(matrix)


def similarity(degrees: float, scale: float = 1.0, shift: tuple[float, float] = (0, 0)) -> Affine:
    return np.column_stack([scale * rotation(np.deg2rad(degrees)), shift])


def replaced(drawing: Drawing, outline: Outline) -> Drawing:
    shape = drawing.shapes[0]
    return replace(drawing, shapes=(replace(shape, rings=(outline,)),))


def outline_points(prepared: Prepared, t: Points, count: int = 300) -> Points:
    """Points along the drawn outlines at even arc length from the topmost one, (F, count, 2)."""
    frames = []
    for curves in prepared.movement.parts[0].curves(t):
        dense = evaluate(curves, np.arange(64) / 64).reshape(-1, 2)
        step = np.linalg.norm(np.roll(dense, -1, axis=0) - dense, axis=1)
        place = np.concatenate([[0], np.cumsum(step)])
        closed = np.concatenate([dense, dense[:1]])
        even = np.arange(count) / count * place[-1]
        frames.append(np.stack([np.interp(even, place, closed[:, k]) for k in (0, 1)], axis=1))
    return np.array(frames)


def distance(first: Points, second: Points) -> float:
    """Greatest distance of points of each outline to the other's nearest point."""
    apart = np.linalg.norm(first[:, None] - second[None], axis=-1)
    return float(max(apart.min(axis=0).max(), apart.min(axis=1).max()))


def same_shapes(first: Points, second: Points) -> float:
    return max(distance(a, b) for a, b in zip(first, second, strict=True))


def test_ends_are_the_inputs_own_curves(base: Prepared, horse: Drawing, kangaroo: Drawing) -> None:
    """Every piece lies on its input's curve, and together they are all of it."""
    curves = base.movement.parts[0].curves(np.array([0.0, 1.0]))
    for got, drawn in zip(curves, (horse, kangaroo), strict=True):
        own = drawn.shapes[0].rings[0].curves
        dense = evaluate(own, np.linspace(0, 1, 2000)).reshape(-1, 2)
        points = evaluate(got, np.linspace(0, 1, 7)).reshape(-1, 2)
        assert np.max(KDTree(dense).query(points)[0]) < 2e-3  # half a step of the dense polyline
        area = abs(Outline(got).area / drawn.shapes[0].rings[0].area)
        assert area == pytest.approx(1, abs=1e-6)


def test_same_structure_throughout(base: Prepared) -> None:
    frames = base.movement.at(np.linspace(0, 1, 7))
    assert len({tuple(len(r.curves) for s in f.shapes for r in s.rings) for f in frames}) == 1


def test_about_as_many_curves_as_both_inputs_need(
    base: Prepared, horse: Drawing, kangaroo: Drawing
) -> None:
    count = base.movement.parts[0].rings[0]
    needed = sum(len(d.shapes[0].rings[0].curves) for d in (horse, kangaroo))
    assert count < 1.5 * needed


def test_a_to_a_stands_still(horse: Drawing) -> None:
    curves = prepare(horse, horse).movement.parts[0].curves(T)
    assert np.abs(curves - curves[0]).max() < 1e-6 * 24


@pytest.mark.parametrize("degrees", [30, 90, 120, 170])
@pytest.mark.parametrize("folds", ["prevent", "allow"])
def test_a_turned_drawing_turns(horse: Drawing, degrees: float, folds: str) -> None:
    matrix = similarity(degrees, 1.7, (5, -3))
    options = Options(fit="none", folds=folds)  # type: ignore[arg-type]
    curves = prepare(horse, moved(horse, matrix), options).movement.parts[0].curves(T)
    local = curves - curves.mean(axis=(1, 2), keepdims=True)
    for t, frame in zip(T, local, strict=True):
        angle, size = t * np.deg2rad(degrees), np.linalg.norm(frame) / np.linalg.norm(local[0])
        assert np.abs(frame - size * local[0] @ rotation(angle).T).max() < 1e-4 * 24
        assert size == pytest.approx(1 + 0.7 * t, abs=1e-4)


@pytest.mark.parametrize("folds", ["prevent", "allow"])
def test_an_affine_image_moves_affinely(kangaroo: Drawing, folds: str) -> None:
    matrix = np.array([[1.3, 0.6, 2.0], [-0.4, 0.7, 1.0]])
    options = Options(fit="none", folds=folds)  # type: ignore[arg-type]
    curves = prepare(kangaroo, moved(kangaroo, matrix), options).movement.parts[0].curves(T)
    points = curves.reshape(len(T), -1, 2)
    design = np.column_stack([points[0], np.ones(len(points[0]))])
    for frame in points:
        best = design @ np.linalg.lstsq(design, frame, rcond=None)[0]
        # 0.3 pixels at a thousand: the plane's solver rounds the corners of the match a little.
        assert np.abs(best - frame).max() < 3e-4 * 24


@pytest.mark.parametrize("size", [1e-3, 1e6])
def test_units_do_not_matter(
    base: Prepared, horse: Drawing, kangaroo: Drawing, size: float
) -> None:
    matrix = size * np.eye(2, 3)
    small = [
        replace(moved(d, matrix), box=Box(0, 0, 24 * size, 24 * size)) for d in (horse, kangaroo)
    ]
    got = prepare(small[0], small[1]).movement.parts[0].curves(T) / size
    np.testing.assert_allclose(got, base.movement.parts[0].curves(T), atol=1e-6 * 24)


def test_direction_start_and_cuts_do_not_matter(
    base: Prepared, horse: Drawing, kangaroo: Drawing
) -> None:
    """Reversed, started elsewhere, every third curve cut in two: the same movement."""
    curves = horse.shapes[0].rings[0].curves
    pieces = []
    for k, curve in enumerate(np.roll(curves, -5, axis=0)):
        cuts = [0.0, 0.37, 1.0] if k % 3 == 0 else [0.0, 1.0]
        stack = np.repeat(curve[None], len(cuts) - 1, axis=0)
        pieces.append(sub_curves(stack, np.array(cuts[:-1]), np.array(cuts[1:])))
    other = np.concatenate(pieces)
    other[:, 3] = np.roll(other[:, 0], -1, axis=0)
    source = replaced(horse, Outline(other).reversed())
    got = outline_points(prepare(source, kangaroo), T)
    assert same_shapes(got, outline_points(base, T)) < 0.01 * 24


def test_backwards_is_the_same_movement_backwards(
    base: Prepared, horse: Drawing, kangaroo: Drawing
) -> None:
    got = outline_points(prepare(kangaroo, horse), T)[::-1]
    times = 1 - T[::-1]
    assert same_shapes(got, outline_points(base, times)) < 0.01 * 24 * np.sqrt(2)


def test_nothing_crosses(base: Prepared) -> None:
    """Against shapely on frames the movement was not checked at."""
    t = (np.arange(100) + 0.5) / 100
    for curves in base.movement.parts[0].curves(t):
        points = evaluate(curves, np.arange(12) / 12).reshape(-1, 2)
        assert shapely.Polygon(points).is_valid


def test_the_same_bytes_twice(horse: Drawing, kangaroo: Drawing, base: Prepared) -> None:
    again = prepare(horse, kangaroo).movement.parts[0].curves(T)
    np.testing.assert_array_equal(again, base.movement.parts[0].curves(T))
