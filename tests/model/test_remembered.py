"""What is found about outlines is found once for all that have the same curves."""

import numpy as np
import pytest

from shapetween.geometry.bezier import line_curves
from shapetween.model.arclength import arc_length
from shapetween.model.outline import Outline
from shapetween.model.remembered import by_curves
from tests.benchmarks.measuring import read

CORNERS = np.array([[0.0, 0.0], [4.0, 0.0], [4.0, 3.0]])


def triangle(shift: float = 0.0) -> Outline:
    points = CORNERS + shift
    return Outline(line_curves(points, np.roll(points, -1, axis=0)))


def test_a_function_is_asked_once_for_outlines_of_the_same_curves() -> None:
    asked = []

    @by_curves(4)
    def lengths(one: Outline, other: Outline) -> float:
        asked.append((one, other))
        return arc_length(one).length + arc_length(other).length

    assert lengths(triangle(), triangle(1.0)) == pytest.approx(24.0)
    assert lengths(triangle(), triangle(1.0)) == pytest.approx(24.0)
    assert len(asked) == 1
    lengths(triangle(1.0), triangle())
    assert len(asked) == 2
    opened = Outline(triangle().curves, closed=False)
    lengths(opened, triangle(1.0))
    assert len(asked) == 3
    for _ in range(4):  # the first ones are forgotten
        lengths(triangle(float(len(asked))), triangle())
    lengths(triangle(), triangle(1.0))
    assert len(asked) == 8


def test_an_error_is_not_remembered() -> None:
    asked = []

    @by_curves(4)
    def fails(outline: Outline) -> None:
        asked.append(outline)
        raise ValueError("no such outline")

    for _ in range(2):
        with pytest.raises(ValueError, match="no such"):
            fails(triangle())
    assert len(asked) == 2


def test_lengths_of_alike_outlines_are_one_and_exact() -> None:
    ring = read("horse").shapes[0].rings[0]
    again = Outline(ring.curves.copy(), ring.closed)
    assert arc_length(ring) is arc_length(again)
    np.testing.assert_array_equal(arc_length(ring).outline.curves, ring.curves)
