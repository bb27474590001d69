"""Keyframes, chosen in blocks, are those of a search that takes one sample after another."""

import numpy as np
import pytest

from shapetween.base.arrays import Floats
from shapetween.timing.keyframes import keyframes


def one_by_one(samples: Floats, times: Floats, tolerance: float) -> list[int]:
    """From each keyframe as far as every shorter step was near enough."""
    chosen = [0]
    while chosen[-1] < len(samples) - 1:
        start = chosen[-1]
        end = start + 1
        while end < len(samples) - 1:
            share = (times[start : end + 2] - times[start]) / (times[end + 1] - times[start])
            way = samples[start] + share[:, None, None] * (samples[end + 1] - samples[start])
            off = np.linalg.norm(samples[start : end + 2] - way, axis=-1)
            if off.max() > tolerance:
                break
            end += 1
        chosen.append(end)
    return chosen


@pytest.mark.parametrize("points", [1, 7, 3000])
@pytest.mark.parametrize("tolerance", [0.003, 0.03, 0.3])
def test_blocks_find_what_single_steps_find(points: int, tolerance: float) -> None:
    """Few points are looked at many steps at a time, many points one step at a time."""
    random = np.random.default_rng(points)
    times = np.sort(random.uniform(size=61))
    waves = random.normal(size=(4, points, 2))
    samples = sum(wave * np.sin((k + 1) * 2 * times)[:, None, None] for k, wave in enumerate(waves))
    found = keyframes(np.asarray(samples), times, tolerance)
    assert found.tolist() == one_by_one(np.asarray(samples), times, tolerance)


def test_no_more_are_sought_than_are_of_use() -> None:
    samples = np.cumsum(np.random.default_rng(1).normal(size=(40, 2, 2)), axis=0)
    times = np.linspace(0, 1, 40)
    assert keyframes(samples, times, 1e-3, 5).tolist() == [0, 1, 2, 3, 4, 5]
