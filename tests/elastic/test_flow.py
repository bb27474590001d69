"""A drawing moves as one: its silhouette, and all that is drawn with it."""

import numpy as np
import pytest

from shapetween.base.arrays import Affine
from shapetween.elastic.silhouette import covered_by, silhouette
from shapetween.model.drawing import Box, Drawing, Shape
from shapetween.model.outline import Outline
from shapetween.model.paint import Colour
from shapetween.pipeline import Prepared
from tests.drawings import BOX, area, drawing, line, ring, square
from tests.elastic.whole import prepare_elastic
from tests.movements import circle
from tests.strategies import rotation

T = np.linspace(0, 1, 9)
PAGE = np.array([[0.0, 0.0], [100.0, 100.0]])
RED = Colour(1, 0, 0)


def disc(x: float, y: float, radius: float) -> Outline:
    return Outline(circle(np.array([x, y]), radius))


def outlines(*shapes: Shape) -> tuple[Outline, ...]:
    return silhouette(shapes, covered_by(shapes), PAGE)


def face() -> Drawing:
    """A head with an outline, two eyes and a mouth; none of its shapes holds another."""
    head = ring([(20, 10), (80, 10), (90, 60), (50, 90), (10, 60)])
    stroke = Shape((head,), line((0, 0), (1, 1)).style)
    eyes = area(disc(35, 40, 4)), area(disc(65, 40, 4))
    return drawing(area(head, colour=RED), *eyes, line((35, 65), (50, 72), (65, 65)), stroke)


def moved(source: Drawing, matrix: Affine) -> Drawing:
    return Drawing(source.transformed(matrix).shapes, BOX)


def points(prepared: Prepared, part: int) -> np.ndarray[tuple[int, ...], np.dtype[np.float64]]:
    return prepared.movement.parts[part].curves(T).reshape(len(T), -1, 2)


def test_shapes_side_by_side_make_one_silhouette() -> None:
    (found,) = outlines(area(square(10, 10, 30)), area(square(40.5, 10, 30)))
    np.testing.assert_allclose(found.box, np.array([[10, 10], [70.5, 40]]), atol=0.2)
    assert found.area == pytest.approx(60.5 * 30, rel=0.01)


def test_holes_shadows_and_what_is_off_the_page_make_no_silhouette() -> None:
    (whole,) = outlines(area(square(10, 10, 60), square(20, 20, 40)))
    assert whole.area == pytest.approx(3600, rel=0.01)
    shadow = area(square(10, 40, 60), colour=Colour(alpha=0.2))
    far = area(square(300, 10, 60))
    (solid,) = outlines(area(square(10, 10, 20)), shadow, far)
    assert solid.area == pytest.approx(400, rel=0.01)
    assert outlines(far)[0].area == pytest.approx(3600, rel=0.01)


def test_a_drawing_becoming_itself_stands_still() -> None:
    prepared = prepare_elastic(face(), face())
    for k in range(len(prepared.movement.parts)):
        curves = points(prepared, k)
        np.testing.assert_allclose(curves, np.repeat(curves[:1], len(T), axis=0), atol=1e-9)


@pytest.mark.parametrize("degrees", [40, 150])
def test_a_turned_drawing_turns_as_one(degrees: float) -> None:
    turn = np.column_stack([1.4 * rotation(np.deg2rad(degrees)), [20.0, -10.0]])
    prepared = prepare_elastic(face(), moved(face(), turn))
    every = np.concatenate([points(prepared, k) for k in range(5)], axis=1)
    local = every - every.mean(axis=1, keepdims=True)
    for t, frame in zip(T, local, strict=True):
        expected = (1 + 0.4 * t) * local[0] @ rotation(t * np.deg2rad(degrees)).T
        np.testing.assert_allclose(frame, expected, atol=1e-6)


def test_an_outline_keeps_to_what_it_goes_round() -> None:
    """Head and outline become another's; nothing says that they belong together."""
    other = ring([(30, 30), (70, 20), (95, 50), (60, 95), (15, 80)])
    second = drawing(
        area(other, colour=RED),
        area(disc(50, 50, 4)),
        area(disc(70, 50, 4)),
        line((45, 70), (55, 75), (65, 70)),
        Shape((other,), line((0, 0), (1, 1)).style),
    )
    prepared = prepare_elastic(face(), second)
    assert prepared.carrier is not None
    styles = [part.style(0.0) for part in prepared.movement.parts]
    fill = points(prepared, next(k for k, style in enumerate(styles) if style.fill == RED))
    rings = [part.rings[0] > 3 and part.closed[0] for part in prepared.movement.parts]
    stroke = points(
        prepared, next(k for k, style in enumerate(styles) if style.fill is None and rings[k])
    )
    apart = np.linalg.norm(fill[:, :, None] - stroke[:, None], axis=-1).min(axis=2)
    assert apart.max() < 1


def test_a_page_goes_from_box_to_box() -> None:
    """Whatever turn would take it there as well."""
    wide = drawing(area(ring([(0, 20), (100, 20), (100, 70), (0, 70)])), area(disc(30, 40, 9)))
    high = drawing(area(ring([(20, 0), (70, 0), (70, 100), (20, 100)])), area(disc(35, 30, 9)))
    frames = points(prepare_elastic(wide, high), 0)
    for t, frame in zip(T, frames, strict=True):
        low, far = (1 - t) * np.array([0, 20]) + t * np.array([20, 0]), frame.max(axis=0)
        high_corner = (1 - t) * np.array([100, 70]) + t * np.array([70, 100])
        np.testing.assert_allclose([frame.min(axis=0), far], [low, high_corner], atol=0.01)


@pytest.mark.parametrize("size", [1e-3, 1e6])
def test_units_do_not_matter(size: float) -> None:
    """On a page; how far the plane around other shapes keeps this is tested with it."""
    page = ring([(0, 20), (100, 20), (100, 70), (0, 70)])
    first = drawing(area(page), area(disc(30, 40, 9)), line((50, 30), (60, 60)))
    second = drawing(area(square(20, 5, 60)), area(square(30, 30, 12)), line((50, 30), (70, 60)))
    box = Box(0, 0, 100 * size, 100 * size)
    large = [Drawing(d.transformed(size * np.eye(2, 3)).shapes, box) for d in (first, second)]
    here = prepare_elastic(first, second).movement.parts
    there = prepare_elastic(large[0], large[1]).movement.parts
    assert [part.rings for part in here] == [part.rings for part in there]
    for part, other in zip(here, there, strict=True):
        np.testing.assert_allclose(other.curves(T) / size, part.curves(T), atol=1e-6)


@pytest.mark.parametrize("comes", [False, True])
def test_what_lies_beside_only_drifts_along(comes: bool) -> None:
    """The body grows to twice its size and moves; a spot beside it is not flung after it."""
    small, large = area(disc(40, 50, 15)), area(ring([(30, 10), (80, 15), (85, 85), (25, 80)]))
    spot = area(square(94, 45, 4) if comes else square(80, 45, 4), colour=RED)
    first, second = [small], [large]
    (second if comes else first).append(spot)
    prepared = prepare_elastic(drawing(*first), drawing(*second))
    drift = np.diff([o.box.mean(axis=0) for o in (small.rings[0], large.rings[0])], axis=0)[0]
    (lone,) = (k for k, part in enumerate(prepared.movement.parts) if part.style(0.5).fill == RED)
    middles = points(prepared, lone).mean(axis=1)
    home = spot.rings[0].box.mean(axis=0)
    expected = home + (T - float(comes))[:, None] * drift
    np.testing.assert_allclose(middles, expected, atol=0.5)
