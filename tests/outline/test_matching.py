"""Holes are matched as their rings turn, not by themselves."""

import numpy as np
import pytest

from shapetween.base.observe import unobserved
from shapetween.geometry.bezier import line_curves
from shapetween.model.outline import Outline
from shapetween.outline.matching import match_hole


def mouth(bend: float) -> Outline:
    """A thin crescent, its ends down where `bend` is positive."""
    x = np.linspace(-5, 5, 21)
    upper, lower = bend * (x / 5) ** 2 - 0.6 * (1 - (x / 5) ** 2), bend * (x / 5) ** 2
    points = np.concatenate([np.stack([x, upper], 1), np.stack([x, lower], 1)[-2:0:-1]])
    return Outline(line_curves(points, np.roll(points, -1, axis=0)))


@pytest.mark.parametrize("bend", [3.0, 2.0])
def test_a_mouth_is_not_turned_upside_down(bend: float) -> None:
    smile, frown = mouth(-bend), mouth(bend)
    match = match_hole(smile, frown, 0.0, unobserved)
    assert match.matching.turn == 0
    left = np.argmin(match.samples.source[:, 0])
    assert match.samples.target[left, 0] < 0
