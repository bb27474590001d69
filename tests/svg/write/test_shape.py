import numpy as np
import pytest

from shapetween.base.arrays import Curves, Floats
from shapetween.model.drawing import Box
from shapetween.model.movement import Movement
from shapetween.svg.write.shape import MOST_LOOKED
from shapetween.svg.write.smil import smil_svg
from tests.movements import circle, formula_part


@pytest.mark.parametrize("curves", [4, MOST_LOOKED // 20])
def test_movements_of_very_many_curves_are_not_sampled_again_for_their_corners(curves: int) -> None:
    asked = 0

    def move(t: Floats, start: Curves) -> Curves:
        nonlocal asked
        asked += len(t)
        there = np.abs(t - 0.37)[:, None, None, None] * np.array([20.0, 7.0])
        return np.asarray(start + there)

    ring = np.tile(circle(np.array([50.0, 50.0]), 9.0), (curves // 4, 1, 1))
    rings = (4,) * (curves // 4)
    part = formula_part(ring, move, rings=rings, closed=(True,) * len(rings))
    smil_svg(Movement((part,), Box(0, 0, 100, 100)))
    assert (asked > 300) == (curves == 4)
