"""Blobs that idle wobble and do not roll."""

import numpy as np
import pytest

from shapetween.base.arrays import Points
from shapetween.match import correspond
from shapetween.model.arclength import ArcLength
from tests.match.shapes import rounded, target_at

PAIRS = 24
EVEN = np.arange(256) / 256

#: Mean angle, degrees, that a blob may roll by about its centre.
ROLL = 12.0


def blob(rng: np.random.Generator, corners: int) -> Points:
    """Points round a centre, their distances and angles a little uneven."""
    angle = 2 * np.pi * (np.arange(corners) + rng.uniform(-0.2, 0.2, corners)) / corners
    angle += rng.uniform(0, 2 * np.pi)
    radius = 100 * (1 + rng.uniform(-0.25, 0.25, corners))
    return np.column_stack([radius * np.cos(angle), radius * np.sin(angle)])


@pytest.mark.parametrize("corners", [5, 6, 8])
def test_blobs_do_not_roll(corners: int) -> None:
    rolled = []
    for seed in range(PAIRS // 3):
        rng = np.random.default_rng([corners, seed])
        ends = [rounded(blob(rng, corners)) for _ in "ab"]
        found = correspond(ends[0], ends[1])
        z = [
            ArcLength(outline).point(at) @ [1, 1j]
            for outline, at in zip(ends, (EVEN, target_at(found, EVEN)), strict=True)
        ]
        first, second = (points - points.mean() for points in z)
        rolled.append(abs(float(np.degrees(np.angle((second * first.conj()).sum())))))
    assert np.median(rolled) < ROLL / 2
    assert max(rolled) < ROLL
