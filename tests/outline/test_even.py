"""What is even about an axis at both ends stays even, but for what is on one side alone."""

from functools import cache

import numpy as np
import pytest

from shapetween.base.arrays import Points
from shapetween.base.observe import unobserved
from shapetween.outline import even
from shapetween.outline.body import Carried
from shapetween.outline.even import evened
from shapetween.outline.matching import match_outer
from shapetween.outline.unfold import unfolded
from tests.match.shapes import polygon

#: The right half of a table with a lamp on it, from the lamp down, and of a bowl.
TABLE = np.array([[0.2, -2.0], [0.2, -1.0], [2.0, -0.8], [2.0, 2.0], [1.5, 2.0], [1.5, 0.2]])
BOWL = np.array([[1.6, -1.2], [2.0, -0.9], [2.0, 1.5], [1.7, 1.5], [1.6, -0.2], [1.0, 1.8]])
LAMP = np.array([0.6, -2.3])


def whole(half: Points) -> Points:
    return np.concatenate([half, half[::-1] * [-1, 1]])


@cache
def moved() -> Carried:
    """A table whose lamp burns askew becomes a bowl."""
    burning = np.concatenate([[LAMP], whole(TABLE)])
    ring = match_outer(
        polygon(burning), polygon(whole(BOWL)), quads=None, pins=np.zeros((0, 4)), mesh=None,
        upright=False, observe=unobserved,
    )  # fmt: skip
    return unfolded([ring], "projective")


def unevenness(body: Carried) -> float:
    """How far the two legs' lowest places are from being level half-way."""
    points = body.curves(np.array([0.5]))[0, :, 0]
    left, right = points[points[:, 0] < -0.8], points[points[:, 0] > 0.8]
    return float(abs(left[:, 1].max() - right[:, 1].max()))


def flame(body: Carried) -> Points:
    """The tip of the lamp on its way."""
    at = np.linalg.norm(body.nodes.ends[0] - LAMP, axis=1).argmin()
    return np.asarray(body.path.vertices(np.linspace(0, 1, 5))[:, at])


def test_legs_stay_even_under_a_lamp_that_burns_askew() -> None:
    body = moved()
    found = evened(body)
    assert unevenness(body) > 0.05
    assert unevenness(found) < 0.02
    assert not found.crossing
    np.testing.assert_array_equal(
        found.curves(np.array([0.0, 1.0])), body.curves(np.array([0.0, 1.0]))
    )


def test_what_is_on_one_side_alone_is_left_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    body = moved()
    assert np.abs(flame(evened(body)) - flame(body)).max() < 0.01
    monkeypatch.setattr(even, "SAME_PLACE", 0.3)
    assert np.abs(flame(evened(body)) - flame(body)).max() > 0.03


@pytest.mark.parametrize(("name", "value"), [("NEARLY_ALL", 0.99), ("SAME_PLACE", 0.005)])
def test_lopsided_ones_are_left_alone(
    monkeypatch: pytest.MonkeyPatch, name: str, value: float
) -> None:
    monkeypatch.setattr(even, name, value)
    assert evened(moved()) is moved()


def test_what_is_uneven_at_an_end_fades(monkeypatch: pytest.MonkeyPatch) -> None:
    """Half-way an eighth of it is left, of either end."""
    usual = evened(moved()).curves(np.array([0.5]))
    monkeypatch.setattr(even, "FADING", 1)
    other = evened(moved()).curves(np.array([0.5]))
    assert np.abs(usual - other).max() > 3e-3


#: From the lamp's shade on, its right half with a chain on it.
SHADE = np.array([[0.6, -2.0], [1.4, 0.4]])
CHAIN = np.array([[1.1, 0.4], [1.1, 1.5], [0.9, 1.5], [0.9, 0.4]])
STAND = np.array([[0.25, 0.4], [0.25, 1.7], [0.8, 1.7], [0.8, 2.0]])
GLASS = np.array([[1.2, -2.0], [0.9, 0.2], [0.2, 0.8], [0.2, 1.8], [0.9, 1.8], [0.9, 2.0]])


@cache
def hung() -> Carried:
    """A lamp with a chain under one side of its shade becomes a glass."""
    left = np.concatenate([SHADE, STAND])[::-1] * [-1, 1]
    lamp = polygon(np.concatenate([SHADE, CHAIN, STAND, left]))
    ring = match_outer(
        lamp, polygon(whole(GLASS)), quads=None, pins=np.zeros((0, 4)), mesh=None,
        upright=False, observe=unobserved,
    )  # fmt: skip
    return unfolded([ring], "projective")


def test_what_is_nearly_even_stays_so(monkeypatch: pytest.MonkeyPatch) -> None:
    def lean(body: Carried) -> float:
        """How far the shade's corners are from being level half-way."""
        ends = body.nodes.ends[0]
        at = [np.linalg.norm(ends - [side * 1.4, 0.4], axis=1).argmin() for side in (1, -1)]
        right, left = body.path.vertices(np.array([0.5]))[0, at]
        return float(abs(right[1] - left[1]))

    found = evened(hung())
    assert lean(hung()) > 2 * lean(found)
    assert lean(found) < 0.05
    assert not found.crossing
    monkeypatch.setattr(even, "nearly_even_about", lambda *_: None)
    assert evened(hung()) is hung()
