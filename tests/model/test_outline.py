"""Outlines: closed, whatever rounding their ends have."""

import numpy as np
import pytest

from shapetween.geometry.bezier import line_curves
from shapetween.model.outline import Outline


@pytest.mark.parametrize("unit", [1e-6, 1.0, 1e6])
def test_what_ends_a_rounding_off_its_start_gets_no_side_without_length(unit: float) -> None:
    corners = unit * np.array([[0.0, 0.0], [4.0, 0.0], [4.0, 3.0], [1e-15, -2e-15]])
    ring = Outline(line_curves(corners[:-1], corners[1:]), closed=False).close()
    assert ring.closed
    assert len(ring.curves) == 3
    np.testing.assert_array_equal(ring.curves[-1, 3], ring.curves[0, 0])


def test_a_short_side_back_is_drawn() -> None:
    corners = np.array([[0.0, 0.0], [4.0, 0.0], [4.0, 3.0], [1e-7, 0.0]])
    ring = Outline(line_curves(corners[:-1], corners[1:]), closed=False).close()
    assert len(ring.curves) == 4
