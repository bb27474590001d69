from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
import shapely

from shapetween.base.arrays import Curves, Floats
from shapetween.base.ends import End
from shapetween.geometry.bezier import line_curves
from shapetween.model.part import Leaf
from shapetween.scene.unmatched.going import nearest_beside
from shapetween.scene.unmatched.presence import MANY_CURVES, Carry


class Turning(Leaf):
    """A ring of many sides that turns, grows and moves; it counts how often it is asked."""

    def __init__(self, count: int) -> None:
        angle = 2 * np.pi * np.arange(count) / count
        ring = np.stack([np.cos(angle), 0.6 * np.sin(angle)], axis=1)
        self.ring = line_curves(ring, np.roll(ring, -1, axis=0))
        self.counts, self.closed, self.asked = (count,), (True,), 0

    def curves(self, t: Floats) -> Curves:
        self.asked += 1
        turn = (1 + 0.5 * t) * np.exp(1j * t)
        z = self.ring @ [1, 1j] * turn[:, None, None] + (3 * t * t)[:, None, None]
        return np.stack([z.real, z.imag], axis=-1)


@pytest.mark.parametrize("count", [60, MANY_CURVES + 1])
def test_what_is_carried_goes_with_its_outline_however_many_curves_that_has(count: int) -> None:
    track, place, t = Turning(count), np.array([0.8, 0.3]), np.linspace(0, 1, 37)
    there, turn = Carry(track, place, 0.05, End.SOURCE).moved(t)
    wanted = (1 + 0.5 * t) * np.exp(1j * t)
    assert np.abs(turn - wanted).max() < 1e-4
    moved = wanted * complex(*place) + 3 * t * t
    assert np.abs(there @ [1, 1j] - moved).max() < 1e-3
    np.testing.assert_allclose(there[0], place, atol=1e-12)


def test_an_outline_of_many_curves_is_asked_once_for_all_that_it_carries() -> None:
    track = Turning(MANY_CURVES + 1)
    for k in range(5):
        carry = Carry(track, np.array([0.1 * k, 0.0]), 0.05, End.TARGET)
        for t in (np.linspace(0, 1, 41), np.linspace(0.2, 0.7, 90)):
            carry.moved(t)
    assert track.asked == 1


@pytest.mark.parametrize(("size", "carried"), [(1.2, False), (1.45, False), (1.6, True)])
def test_only_what_is_plainly_larger_carries_what_is_loose(size: float, carried: bool) -> None:
    loose, other = shapely.box(0, 0, 1, 1), shapely.box(1.1, 0, 1.1 + size, 1)
    scene = SimpleNamespace(
        sizes=[1.0, size],
        sheets=[False, False],
        forms=[None, None],
        items=[SimpleNamespace(drawn=loose), SimpleNamespace(drawn=other)],
        scale=10.0,
    )
    side: Any = SimpleNamespace(scene=scene, anchors=[1])
    assert nearest_beside([0], side) == (1 if carried else None)
