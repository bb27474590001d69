"""What is even but for something on one side is matched axis onto axis, side onto side."""

import numpy as np
import pytest

from shapetween.base.arrays import Points
from shapetween.match import correspond, lopsided, match
from shapetween.match.costs import prepare
from shapetween.match.lopsided import lopsided_ends, nearly_even_about
from shapetween.model.outline import Outline
from tests.match.shapes import polygon, rotation, target_at

#: The right half of a lamp and of a glass, from the top down.
LAMP = np.array([[0.6, -2.0], [1.4, 0.4], [0.25, 0.4], [0.25, 1.7], [0.8, 1.7], [0.8, 2.0]])
GLASS = np.array([[1.2, -2.0], [0.9, 0.2], [0.2, 0.8], [0.2, 1.8], [0.9, 1.8], [0.9, 2.0]])


def whole(half: Points) -> Points:
    return np.concatenate([half, half[::-1] * [-1, 1]])


def chained(length: float = 1.1) -> Outline:
    """The lamp with a chain under its right side."""
    chain = np.array([[1.1, 0.4], [1.1, 0.4 + length], [0.9, 0.4 + length], [0.9, 0.4]])
    return polygon(np.concatenate([LAMP[:2], chain, LAMP[2:], LAMP[::-1] * [-1, 1]]))


def glass() -> Outline:
    return polygon(whole(GLASS))


def askew(lamp: Outline, other: Outline) -> float:
    """How far the lamp's two lower corners go to places that are not each other's mirror image."""
    places = np.array([[1.4, 0.4], [-1.4, 0.4]])
    found = correspond(lamp, other)
    at = _at(lamp, places)
    there = _points(other, target_at(found, at))
    return float(np.abs(there[0] * [-1, 1] - there[1]).max())


def _at(outline: Outline, points: Points) -> np.ndarray:
    from shapetween.model.arclength import arc_length

    return arc_length(outline).nearest(points)[0]


def _points(outline: Outline, at: np.ndarray) -> Points:
    from shapetween.model.arclength import arc_length

    return arc_length(outline).point(at % 1.0)


def test_both_sides_of_a_lamp_with_a_chain_go_alike(monkeypatch: pytest.MonkeyPatch) -> None:
    assert correspond(chained(), glass()).lopsided
    assert correspond(glass(), chained()).lopsided
    assert askew(chained(), glass()) < 0.1
    monkeypatch.setattr(match, "LOPSIDED_RATIO", 0.5)
    assert not correspond(chained(), glass()).lopsided


def test_two_even_outlines_and_two_uneven_ones_are_not_lopsided() -> None:
    assert not correspond(glass(), polygon(whole(LAMP))).lopsided
    assert not correspond(chained(), chained(0.8)).lopsided


@pytest.mark.parametrize(("common", "taken"), [(0.86, True), (0.99, False)])
def test_how_much_both_sides_have_in_common_decides(
    monkeypatch: pytest.MonkeyPatch, common: float, taken: bool
) -> None:
    monkeypatch.setattr(lopsided, "COMMON", common)
    assert correspond(chained(), glass()).lopsided == taken


def test_what_faces_aside_is_not_even(monkeypatch: pytest.MonkeyPatch) -> None:
    flag = prepare(polygon(np.array([[0, 0], [3, 0], [3, 1.5], [0.4, 1.5], [0.4, 4], [0, 4.0]])))
    assert nearly_even_about(flag, np.pi / 2) is None
    monkeypatch.setattr(lopsided, "COMMON", 0.7)
    assert nearly_even_about(flag, np.pi / 2) is not None


@pytest.mark.parametrize("angle", [0.0, 0.7, 2.5])
def test_the_line_is_the_lamps_own_axis_however_it_is_turned(angle: float) -> None:
    outline = chained().transformed(rotation(angle, 3.0))
    aside = nearly_even_about(prepare(outline), np.pi / 2 + angle)
    assert aside is not None
    box = prepare(outline).samples
    # The chain draws the centroid to one side; the line stays where the rest has its middle.
    plain = chained()
    centre = _centroid(plain)[0] / np.sqrt(plain.area)
    assert abs(aside) == pytest.approx(abs(centre), abs=0.01)
    assert box.size > 0


def _centroid(outline: Outline) -> Points:
    from shapetween.match.moments import area_moments

    return area_moments(outline.curves)[1]


@pytest.mark.parametrize(("name", "few"), [("LINES", 5), ("STEPS", 6)])
def test_too_few_places_misjudge_what_is_common(
    monkeypatch: pytest.MonkeyPatch, name: str, few: int
) -> None:
    """Of lamps whose chains grow some are taken for even that are not, or the other way round."""

    def taken() -> list[bool]:
        lamps = [prepare(chained(length)) for length in np.linspace(0.2, 9.0, 40)]
        return [nearly_even_about(lamp, np.pi / 2) is not None for lamp in lamps]

    usual = taken()
    assert usual == sorted(usual, reverse=True)
    monkeypatch.setattr(lopsided, name, few)
    assert taken() != usual


def test_sides_are_compared_closely_enough(monkeypatch: pytest.MonkeyPatch) -> None:
    """The corner beside the chain belongs to its mirror image."""

    def gap() -> float:
        lamp = prepare(chained())
        (ends, halves), *_ = lopsided_ends(prepare(glass()), lamp)
        assert halves[0] is None
        assert halves[1] is not None
        first, last = ends[:, 1]
        share = np.linspace(0, 1, 400)
        common = halves[1].mean(axis=0)
        sides = [np.interp(share, common, half) for half in halves[1]]
        here = first + sides[0] * (last - first)
        there = first + 1 - sides[1] * (first + 1 - last)
        samples = lamp.samples
        points = [samples.arcs.point((samples.start + at) % 1.0) for at in (here, there)]
        off = np.abs(points[0] * [-1, 1] - points[1]).max(axis=1)
        return float(np.sort(off)[: len(off) // 2].mean())

    usual = gap()
    assert usual < 0.05
    monkeypatch.setattr(lopsided, "HALF_STEPS", 10)
    assert gap() > 2 * usual


def test_what_is_even_about_any_line_is_not_lopsided(monkeypatch: pytest.MonkeyPatch) -> None:
    """A saw blade is, whose teeth lean; a square with a corner cut off is not."""
    angle = 2 * np.pi * np.arange(24) / 24 + np.tile([0.0, 0.2], 12)
    radius = np.tile([1.0, 0.85], 12)
    blade = np.stack([np.cos(angle), np.sin(angle)], axis=1) * radius[:, None]
    cut = np.array([[-1.0, -1], [0.6, -1], [1, -0.6], [1, 1], [-1, 1]])
    wheel, square = prepare(polygon(blade)), prepare(polygon(cut))
    assert nearly_even_about(wheel, np.pi / 2) is None
    assert nearly_even_about(square, np.pi / 2) is not None
    monkeypatch.setattr(lopsided, "ANOTHER_WAY", 0.01)
    assert nearly_even_about(square, np.pi / 2) is None
    monkeypatch.setattr(lopsided, "ANOTHER_WAY", np.pi / 4)
    assert nearly_even_about(square, np.pi / 2) is None
