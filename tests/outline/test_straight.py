"""Edges that are straight at both ends stay straight on the way."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from shapetween.base.arrays import Floats
from shapetween.base.observe import unobserved
from shapetween.deform.keyed import KeyedMotion
from shapetween.deform.schedule import CHECKED_TIMES
from shapetween.model.outline import Outline
from shapetween.outline import straight
from shapetween.outline.body import Carried
from shapetween.outline.matching import match_outer
from shapetween.outline.straight import _in_order, _is_straight, straightened
from shapetween.outline.unfold import unfolded
from tests.match.shapes import polygon, rounded

TIMES = np.linspace(0, 1, CHECKED_TIMES)

#: A flag on its pole, and the pole with the flag lower down and longer.
FLAG = np.array([[0, 0], [4, 0], [4, 3], [1, 3], [1, 9], [0, 9]], dtype=float)
LOW = np.array([[0, 0], [1, 0], [1, 3], [6, 3], [6, 5], [1, 5], [1, 9], [0, 9]], dtype=float)


def moved(first: Outline, second: Outline) -> Carried:
    ring = match_outer(
        first, second, quads=None, pins=np.zeros((0, 4)), mesh=None, upright=False,
        observe=unobserved,
    )  # fmt: skip
    return unfolded([ring], "projective")


@cache
def flags(unit: float = 1.0) -> Carried:
    return moved(polygon(unit * FLAG), polygon(unit * LOW))


def bends(body: Carried) -> Floats:
    """How far the nodes of the pole's back are off its chord, as a share of it, (F,)."""
    ends = body.nodes.ends
    size = np.ptp(ends[0])
    pole = np.flatnonzero((np.abs(ends[0][:, 0]) + np.abs(ends[1][:, 0])) < 1e-6 * size)
    assert len(pole) > 3
    z = body.path.vertices(TIMES)[:, pole] @ [1, 1j]
    order = np.argsort(ends[0][pole, 1])
    z = z[:, order]
    chord = z[:, -1:] - z[:, :1]
    return np.asarray(np.abs(((z - z[:, :1]) / chord).imag).max(axis=1))


def test_a_pole_stays_straight_while_its_flag_comes_down() -> None:
    body = flags()
    assert bends(body).max() > 0.01
    found = straightened(body)
    assert bends(found).max() < 1e-3
    assert not found.crossing
    for end, time in enumerate((0.0, 1.0)):
        at = found.path.vertices(np.array([time]))[0, : len(found.nodes.ends[0])]
        np.testing.assert_array_equal(at, found.nodes.ends[end])


def test_straightening_has_no_unit() -> None:
    plain, large = (straightened(flags(unit)).curves(TIMES[::20]) / unit for unit in (1.0, 1e5))
    assert np.abs(plain - large).max() < 1e-4


def test_round_sides_are_left_as_they_move() -> None:
    blob = np.array([[0, 0], [3, -0.5], [5, 1], [4, 4], [1, 3.5]], dtype=float)
    body = moved(rounded(blob), rounded(blob * [1.5, 0.8] + 0.3 * blob[:, ::-1]))
    assert straightened(body) is body


def test_what_would_cross_stays_bent(monkeypatch: pytest.MonkeyPatch) -> None:
    body = flags()

    def crossing(some: Carried, motion: KeyedMotion, pushes: Floats) -> Carried:
        return replace(some, crossing=some.crossing + 1)

    monkeypatch.setattr(straight, "pushed", crossing)
    assert straightened(body) is body


@pytest.mark.parametrize(("bow", "straight"), [(0.003, True), (0.006, False)])
def test_what_was_drawn_by_hand_is_straight_and_what_is_round_is_not(
    bow: float, straight: bool
) -> None:
    """A side that is bowed by a few thousandths of its length, at one end."""
    points = np.concatenate([9 * np.exp(0j) * np.linspace(0, 1, 9) + 0j])
    points = points + 1j * 9 * bow * np.sin(np.pi * np.linspace(0, 1, 9))
    assert _is_straight(points) == straight


def going(*steps: float) -> Floats:
    """Places of four nodes along an edge of length 3, the middle one's step as given in time."""
    middle = np.array([1.0, *steps, 1.0])
    return np.stack([0 * middle, 2 - middle, 2 + 0 * middle, 3 + 0 * middle], axis=1)


def test_nodes_of_a_straight_edge_keep_their_order() -> None:
    """What goes back on one line lies on itself, and rounding says whether it crosses itself."""
    for back in (-0.5, 0.0, 0.01):
        found = _in_order(going(0.6, back, 0.6))
        assert np.diff(found).min() == pytest.approx(0.1, rel=0.3)
        np.testing.assert_array_equal(found[:, [0, -1]], going(0.6, back, 0.6)[:, [0, -1]])
        np.testing.assert_array_equal(found[[0, -1]], going(1.0, 1.0, 1.0)[[0, -1]])


def test_nodes_that_keep_their_order_move_along_as_they_did() -> None:
    np.testing.assert_array_equal(_in_order(going(0.5, 0.2, 0.5)), going(0.5, 0.2, 0.5))
