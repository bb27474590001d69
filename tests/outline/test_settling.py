"""What a limb without a partner becomes: the place that it stands on."""

import numpy as np
import pytest

from shapetween.base.arrays import Floats
from shapetween.model.arclength import ArcLength, arc_length
from shapetween.outline import scales, settling
from shapetween.outline.settling import settled
from tests.match.shapes import polygon

#: A square, and the same with a spine in the middle of its first side, the corners of both first.
SQUARE = np.array([[0, 0], [8, 0], [8, 8], [0, 8]], dtype=float)
ROOTS, TIP = np.array([[3.9, 0], [4.1, 0]]), np.array([[4, -1.5]])
SPINED = np.concatenate([SQUARE[:1], ROOTS[:1], TIP, ROOTS[1:], SQUARE[1:]])

#: The same with three small steps in place of one of its corners.
STEPPED = np.array([[0, 0], [8, 0], [8, 7], [7.5, 7], [7.5, 7.5], [7, 7.5], [7, 8], [0, 8]])


def lengths(points: Floats) -> ArcLength:
    return arc_length(polygon(points))


def corners(side: ArcLength, points: Floats) -> Floats:
    """Fractions of the length at which some corners lie."""
    return np.asarray(side.nearest(points)[0])


def by_corners(first: ArcLength, second: ArcLength, points: Floats) -> tuple[Floats, Floats]:
    """The matching by length between corners that both have."""
    u, v = corners(first, points), corners(second, points)
    order = np.argsort((u - u[0]) % 1)
    u, v = u[0] + (u[order] - u[0]) % 1, v[0] + (v[order] - v[0]) % 1
    return np.append(u, u[0] + 1), np.append(v, v[0] + 1)


def width(u: Floats, v: Floats, ends: Floats) -> float:
    """What stretch of the second a stretch of the first becomes, as a share of its length."""
    at = np.sort(u[0] + (ends - u[0]) % 1)
    return float(np.ptp(np.interp(at, u, v)))


def spine_width(unit: float = 1.0) -> tuple[float, float]:
    first, second = lengths(unit * SPINED), lengths(unit * SQUARE)
    u, v = by_corners(first, second, unit * SQUARE)
    roots = corners(first, unit * ROOTS)
    return width(u, v, roots), width(*settled(first, second, u, v), roots)


def test_a_spine_becomes_the_place_that_it_stands_on() -> None:
    before, after = spine_width()
    assert before == pytest.approx(3.006 / 10.81 / 4, abs=1e-3)
    assert after < before / 1.4


def test_settling_has_no_unit() -> None:
    assert spine_width(1e-4) == pytest.approx(spine_width(), abs=1e-9)


def moved_corners() -> float:
    """How far what the corners are matched with moves, as a share of the length."""
    first, second = lengths(SPINED), lengths(SQUARE)
    new = settled(first, second, *by_corners(first, second, SQUARE))
    at = new[0][0] + (corners(first, SQUARE) - new[0][0]) % 1
    gap = np.interp(at, *new) - corners(second, SQUARE)
    return float(np.abs(gap - np.round(gap)).max())


def test_corners_stay_with_their_own(monkeypatch: pytest.MonkeyPatch) -> None:
    assert moved_corners() < 1e-3
    monkeypatch.setattr(settling, "CORNER", 2.0)
    assert moved_corners() > 2e-3


def moves(points: Floats, places: Floats) -> Floats:
    """How far what some places of an outline with a spine are matched with moves on the square."""
    first, second = lengths(points), lengths(SQUARE)
    given = by_corners(first, second, SQUARE)
    at = corners(first, places)
    gap = np.interp(at, *settled(first, second, *given)) - np.interp(at, *given)
    return np.asarray(np.abs(gap - np.round(gap)))


def test_nothing_moves_far(monkeypatch: pytest.MonkeyPatch) -> None:
    usual = moves(SPINED, ROOTS).max()
    assert usual < 0.015
    monkeypatch.setattr(settling, "FARTHEST", 1.0)
    assert moves(SPINED, ROOTS).max() > 1.08 * usual


#: A spine that leans over a long stretch of the side that it stands on.
LEANING = np.concatenate([SQUARE[:1], ROOTS[:1], [[5.0, -1.2]], ROOTS[1:], SQUARE[1:]])


def test_a_tip_stays_with_its_own(monkeypatch: pytest.MonkeyPatch) -> None:
    assert moves(LEANING, LEANING[2:3]).max() < 1e-3
    for name in ("TIP", "OWN"):
        with monkeypatch.context() as patch:
            patch.setattr(settling, name, 1.1)
            assert moves(LEANING, LEANING[2:3]).max() > 5e-3


def test_the_roots_of_a_limb_are_no_tips(monkeypatch: pytest.MonkeyPatch) -> None:
    usual = spine_width()[1]
    monkeypatch.setattr(settling, "APART", 0.02)
    assert spine_width()[1] > 1.08 * usual


def test_what_both_have_stays() -> None:
    first, second = lengths(SPINED), lengths(SPINED * [1.1, 0.95])
    given = by_corners(first, second, SPINED[[0, 2, 4, 5, 6]] * [1.1, 0.95])
    new = settled(first, second, *given)
    places = np.linspace(0, 1, 400)
    gap = np.interp(new[0][0] + (places - new[0][0]) % 1, *new)
    gap -= np.interp(given[0][0] + (places - given[0][0]) % 1, *given)
    assert np.abs(gap - np.round(gap)).max() < 4e-3


def test_backwards_it_is_the_same() -> None:
    first, second = lengths(STEPPED), lengths(SPINED)
    u, v = by_corners(first, second, SQUARE[[0, 1, 3]])
    forth, back = settled(first, second, u, v), settled(second, first, v, u)
    np.testing.assert_allclose(forth, back[::-1], atol=1e-12)
    for places in forth:
        assert (np.diff(places) > 0).all()
        assert places[-1] - places[0] == pytest.approx(1, abs=1e-12)


def test_a_disc_without_corners_settles_too() -> None:
    angles = np.linspace(0, 2 * np.pi, 90, endpoint=False)
    disc = 4 * np.stack([np.cos(angles), np.sin(angles)], axis=1)
    spine = np.array([[4.0, -0.1], [5.0, 0.0], [4.0, 0.1]])
    spined = np.concatenate([spine, disc[1:]])
    first, second = lengths(spined), lengths(disc)
    even = np.linspace(0, 1, 50)
    u = even + corners(first, disc[45:46])
    v = even + corners(second, disc[45:46])
    roots = corners(first, spine[[0, 2]])
    assert width(*settled(first, second, u, v), roots) < 0.8 * width(u, v, roots)


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("SCALE", 0.004),
        ("REACH", 0.5),
        ("LEAST", 1.0),
        ("GROUND", 0.02),
        ("SMOOTH", 0.02),
        ("FARTHEST", 0.004),
    ],
)
def test_otherwise_it_is_a_tooth(monkeypatch: pytest.MonkeyPatch, name: str, value: float) -> None:
    usual = spine_width()[1]
    monkeypatch.setattr(settling, name, value)
    assert spine_width()[1] > 1.08 * usual


def test_with_fewer_places_it_is_wider(monkeypatch: pytest.MonkeyPatch) -> None:
    usual = spine_width()[1]
    for module in (scales, settling):
        monkeypatch.setattr(module, "PLACES", 64)
    assert spine_width()[1] > 1.08 * usual
