"""Outlines without waves that neither end has, and with the lengths that both have."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from shapetween.base.arrays import Floats
from shapetween.geometry.bezier import flatten
from shapetween.geometry.linearmaps import as_complex
from shapetween.outline import fairing
from shapetween.outline.body import Carried
from shapetween.outline.fairing import faired
from tests.match.shapes import polygon, rounded, star
from tests.outline.test_straight import moved

T = np.linspace(0, 1, 9)
MIDDLE = np.array([0.5])

#: A cabin that hangs on a rod, and a hook.
CABIN = np.array([[0, 0], [4, 0], [4, -2], [5, -2], [5, 0], [9, 0], [9, 6], [0, 6]], dtype=float)
HOOK = np.array(
    [[3, 0], [4, 0], [5, 3], [6, 2], [8, 3], [9, 6], [8, 8], [6, 9], [4, 8], [3, 6]], dtype=float
)


@cache
def cabin() -> Carried:
    return moved(polygon(CABIN), polygon(HOOK))


@cache
def stars() -> Carried:
    return moved(polygon(star(0)), rounded(star(50, 6)))


def steps(body: Carried) -> Floats:
    z = as_complex(flatten(body.curves(T), 8))
    return np.asarray(np.roll(z, -1, axis=1) - z)


def turned(body: Carried) -> float:
    """By how many turns more than its ends have on the way the outline bends, at most."""
    along = steps(body)
    bend = np.abs(np.angle(np.roll(along, -1, axis=1) * along.conj()))
    turns = np.where(np.abs(along) > 1e-9, bend, 0.0).sum(axis=1) / (2 * np.pi)
    return float((turns - (1 - T) * turns[0] - T * turns[-1]).max())


def shortened(body: Carried) -> float:
    """By what share the outline is shorter than its ends are on the way, at most."""
    lengths = np.abs(steps(body)).sum(axis=1)
    return float(1 - (lengths / ((1 - T) * lengths[0] + T * lengths[-1])).min())


def moves(body: Carried, times: Floats) -> float:
    """How far nodes are moved at some times, at most, as a share of the drawing."""
    count = len(body.nodes.ends[0])
    before, after = (as_complex(b.path.vertices(times))[:, :count] for b in (body, faired(body)))
    return float(np.abs(after - before).max() / np.ptp(body.nodes.ends[0]))


def test_an_outline_has_fewer_waves_that_neither_end_has() -> None:
    body = cabin()
    found = faired(body)
    assert turned(body) > 0.05
    assert turned(found) < 0.03
    assert found.crossing == body.crossing == 0
    ends = np.array([0.0, 1.0])
    np.testing.assert_array_equal(found.curves(ends), body.curves(ends))


def test_a_smaller_scale_leaves_waves_and_a_larger_one_leaves_the_mesh(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    assert 0.0075 < moves(cabin(), MIDDLE) < 0.009
    monkeypatch.setattr(fairing, "SCALE", 0.015)
    assert turned(faired(cabin())) > 0.03
    monkeypatch.setattr(fairing, "SCALE", 0.12)
    assert moves(cabin(), MIDDLE) > 0.015


@pytest.mark.parametrize(("power", "least", "most"), [(1, 0.1, 1.0), (8, 0.0, 0.018)])
def test_how_sharply_the_mesh_takes_over(
    power: int, least: float, most: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert 0.02 < turned(faired(cabin())) < 0.025
    monkeypatch.setattr(fairing, "POWER", power)
    assert least < turned(faired(cabin())) < most


def test_steps_that_differ_keep_most_of_their_length(monkeypatch: pytest.MonkeyPatch) -> None:
    kept = shortened(faired(stars()))
    monkeypatch.setattr(fairing, "RESTORED", 0.0)
    assert kept < shortened(faired(stars())) - 0.002
    monkeypatch.setattr(fairing, "RESTORED", 1.0)
    assert kept > shortened(faired(stars())) + 0.001


def test_bends_are_no_waves(monkeypatch: pytest.MonkeyPatch) -> None:
    fair = turned(faired(stars()))
    monkeypatch.setattr(fairing, "CHORDS", 2)
    assert abs(turned(faired(stars())) - fair) > 0.003
    monkeypatch.setattr(fairing, "CHORDS", 16)
    assert abs(turned(faired(stars())) - fair) < 0.001


def test_corners_between_even_places_leave_their_place_slowly() -> None:
    assert moves(stars(), np.array([1e-3, 1 - 1e-3])) < 1e-4


def test_what_is_moved_by_an_affine_map_is_left_to_it() -> None:
    body = moved(polygon(CABIN), polygon(CABIN @ np.array([[1.2, 0.3], [0.0, 0.8]])))
    assert body.nodes.rings[0].matching.affine is not None
    assert faired(body) is body


def test_a_body_that_would_cross_is_left_as_it_is(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(fairing, "pushed", lambda body, *_: replace(body, crossing=1))
    assert faired(cabin()) is cabin()
    crossing = replace(cabin(), crossing=1)
    assert faired(crossing) is not crossing
