"""A ring that is another one turned turns in place."""

import numpy as np
import pytest

from shapetween.base.arrays import Points
from shapetween.geometry.rotation import rotations
from shapetween.scene.motion.turned import turned_ring
from shapetween.scene.places import Places
from tests.drawings import ring

ARROW = np.array([(40, 10), (60, 10), (60, 50), (80, 50), (50, 80), (20, 50), (40, 50)], float)


def places(points: Points) -> Places:
    return Places(ring([(float(x), float(y)) for x, y in points]).clockwise())


@pytest.mark.parametrize("degrees", [90, 180, -120])
def test_an_arrow_keeps_its_form_while_it_turns(degrees: float) -> None:
    turned = (ARROW - 50) @ rotations(np.deg2rad(np.array(degrees))).T + 50
    track = turned_ring(places(ARROW), places(turned))
    assert track is not None
    assert np.rad2deg(track.turn) == pytest.approx(degrees, abs=1e-3)
    whole = track.curves(np.array([0.0, 0.37]))
    for one, other in zip(*whole, strict=True):
        assert np.linalg.norm(one[3] - one[0]) == pytest.approx(np.linalg.norm(other[3] - other[0]))


def test_what_is_not_turned_or_is_stretched_does_not_turn() -> None:
    assert turned_ring(places(ARROW), places(ARROW + 5)) is None
    flat = (50 - ARROW) * [1.0, 0.7]
    assert turned_ring(places(ARROW), places(flat)) is None
    assert turned_ring(places(ARROW), places(ARROW[[0, 1, 2, 4, 6]])) is None


@pytest.mark.parametrize(("corner", "turns"), [(16.0, False), (45.0, True)])
def test_what_lies_on_itself_turned_does_not_turn(corner: float, turns: bool) -> None:
    """A head that is round above becomes one that is round below; a triangle turns over."""
    head = np.array([(50 - 46, 90), (50 - 46, 90 - 80 + 2 * corner), (4 + corner, 10)])
    head = np.concatenate([head, (100, 0) + head[::-1] * [-1, 1]])
    assert (turned_ring(places(head), places(100 - head)) is not None) == turns
