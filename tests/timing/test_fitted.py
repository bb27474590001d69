"""Keyframes with fitted values stay near, and are fewer than those on the way."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from shapetween.base.arrays import Floats
from shapetween.timing.fitted import fitted_keyframes, hat_functions
from shapetween.timing.keyframes import keyframes

TIMES = np.linspace(0, 1, 121)


def turning(turns: float, points: int = 5) -> Floats:
    """Points that run on circles about the origin, (121, points, 2)."""
    angle = 2 * np.pi * turns * TIMES[:, None] + np.arange(points)
    return np.stack([np.cos(angle), np.sin(angle)], axis=-1)


def off(samples: Floats, knots: Floats, values: Floats) -> float:
    shown = hat_functions(TIMES, knots) @ values.reshape(len(values), -1)
    gap = (shown - samples.reshape(len(samples), -1)).reshape(samples.shape)
    return float(np.sqrt((gap**2).sum(-1)).max())


@given(st.floats(0.05, 2), st.floats(1e-4, 1e-1))
def test_they_stay_near_and_meet_both_ends(turns: float, tolerance: float) -> None:
    samples = turning(turns)
    knots, values = fitted_keyframes(samples, TIMES, tolerance)
    assert off(samples, knots, values) <= tolerance * (1 + 1e-9)
    assert (values[0] == samples[0]).all()
    assert (values[-1] == samples[-1]).all()
    assert (np.diff(knots) > 0).all()
    assert len(knots) <= len(keyframes(samples, TIMES, tolerance))


def test_a_turn_needs_a_fifth_fewer() -> None:
    samples = turning(0.5)
    knots, _ = fitted_keyframes(samples, TIMES, 1e-3)
    assert len(knots) <= 0.8 * len(keyframes(samples, TIMES, 1e-3))


@pytest.mark.parametrize("at", [1e-9, 0.4, 0.999])
def test_jumps_are_kept(at: float) -> None:
    samples = turning(0.1) + np.where(at < TIMES, 3.0, 0.0)[:, None, None]
    knots, values = fitted_keyframes(samples, TIMES, 1e-3)
    assert off(samples, knots, values) <= 1e-3
    assert len(knots) < 30


def test_what_stands_still_has_both_ends_alone() -> None:
    knots, _ = fitted_keyframes(turning(0.0), TIMES, 1e-3)
    assert knots.tolist() == [0, 1]


def test_between_samples_nothing_flies_off_where_knots_crowd() -> None:
    """At sharp corners more knots than samples would be wanted; their values were anything."""

    def places(t: Floats) -> Floats:
        angle = 2 * np.pi / 3 * np.interp(t, [0, 0.4, 0.7, 1], [0, 1.3, 0.8, 1])
        return np.stack([100 + 22 * np.cos(angle), 50 + 22 * np.sin(angle)], axis=-1)[:, None]

    knots, values = fitted_keyframes(places(TIMES), TIMES, 0.018)
    close = np.linspace(0, 1, 4801)
    shown = hat_functions(close, knots) @ values[:, 0]
    assert np.linalg.norm(shown - places(close)[:, 0], axis=-1).max() < 0.03
    assert len(knots) < 60
