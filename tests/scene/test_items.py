"""Drawings taken apart: several regions and lines of one path are items as several elements are."""

from dataclasses import replace

import numpy as np
import pytest

from shapetween.base.errors import OutlineError
from shapetween.model.drawing import Shape
from shapetween.model.outline import Outline
from shapetween.model.paint import Colour, Stroke, Style
from shapetween.scene.items import items_of
from tests.drawings import area, line, ring, square


def test_parts_of_one_path_are_items_as_elements_are() -> None:
    first, second = square(0, 0, 10), square(20, 0, 8)
    whole, _ = items_of([area(first, second)], "a.svg")
    apart, _ = items_of([area(first), area(second)], "a.svg")
    assert len(whole) == len(apart) == 2
    for one, other in zip(whole, apart, strict=True):
        np.testing.assert_array_equal(one.outer.curves, other.outer.curves)
    lines = line((0, 0), (9, 0)), line((0, 5), (9, 5))
    joined = Shape(tuple(ring for shape in lines for ring in shape.rings), lines[0].style)
    assert len(items_of([joined], "a.svg")[0]) == 2


def test_a_hole_belongs_to_its_region() -> None:
    (item,), _ = items_of([area(square(0, 0, 10), square(3, 3, 4))], "a.svg")
    assert len(item.holes) == 1
    assert item.area == pytest.approx(100 - 16)
    assert item.size == pytest.approx(10)


def test_a_hair_of_an_area_is_none_of_what_it_paints() -> None:
    """Areas and lines together have no border of which could be asked what touches it."""
    hair = [(10, 5), (20, 5), (10, 5 + 1e-14)]
    (item,), _ = items_of([area(ring([(0, 0), (10, 0), *hair, (10, 10), (0, 10)]))], "a.svg")
    assert item.drawn.boundary is not None
    assert item.drawn.area == pytest.approx(100)


def test_a_flat_fill_is_not_seen_beside_its_stroke() -> None:
    flat = line((0, 0), (9, 0))
    painted = Shape(flat.rings, replace(flat.style, fill=Colour()))
    (item,), _ = items_of([painted], "a.svg")
    assert not item.filled
    with pytest.raises(OutlineError, match="encloses no area"):
        items_of([Shape(flat.rings, Style())], "a.svg")


def test_an_open_outline_with_fill_and_stroke_is_both() -> None:
    corner = line((0, 0), (9, 0), (9, 9))
    shape = Shape(corner.rings, Style(Colour(1), Stroke(Colour())))
    fill, stroke = items_of([shape], "a.svg")[0]
    assert fill.filled
    assert fill.closed
    assert fill.style.stroke is None
    assert not stroke.filled
    assert not stroke.closed


def test_a_line_whose_ends_meet_is_a_ring() -> None:
    corners = np.array([[0, 0], [9, 0], [9, 9], [0, 0]], dtype=float)
    rounded = line(*[(float(x), float(y)) for x, y in corners])
    stroke = Stroke(Colour(), 2.0, "round", "round")
    (item,), _ = items_of([Shape(rounded.rings, Style(None, stroke))], "a.svg")
    assert item.closed
    (open_item,), _ = items_of([rounded], "a.svg")
    assert not open_item.closed


def test_samples_are_even_whatever_the_curves() -> None:
    few = square(0, 0, 10)
    (item,), _ = items_of([Shape((few,), Style())], "a.svg")
    steps = np.linalg.norm(np.diff(item.points, axis=0), axis=1)
    np.testing.assert_allclose(steps, 40 / 64, rtol=1e-9)
    dot = Outline(np.zeros((1, 4, 2)), False)
    (item,), _ = items_of([Shape((dot,), Style(None, Stroke(Colour(), 2.0, "round")))], "a.svg")
    assert item.points.shape == (64, 2)
    assert item.area == pytest.approx(np.pi, rel=0.05)


def test_an_outline_whose_ends_meet_keeps_its_border_though_nothing_closes_it() -> None:
    """Its border would fade by itself, as a grey ring, beside one that is closed."""
    meeting = line((0, 0), (9, 0), (9, 9), (0, 0))
    stroke = Stroke(Colour(), 2.0, "round", "round")
    (item,), _ = items_of([Shape(meeting.rings, Style(Colour(), stroke))], "a.svg")
    assert item.filled
    assert item.style.stroke == stroke
