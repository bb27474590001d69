"""sRGB's curve, against values of the standard."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from shapetween.model.srgb import linear_to_srgb, srgb_to_linear


def test_known_values() -> None:
    values = np.array([0.0, 0.04045, 0.5, 1.0, -0.5])
    light = np.array([0.0, 0.0031308, 0.2140411, 1.0, -0.2140411])
    assert srgb_to_linear(values) == pytest.approx(light, abs=1e-7)


@given(st.floats(-2, 2))
def test_there_and_back(value: float) -> None:
    back = linear_to_srgb(srgb_to_linear(np.array(value)))
    # Both halves of the curve meet only to the standard's five digits.
    assert back == pytest.approx(value, abs=1e-6)
