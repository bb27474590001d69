"""Two outlines read as one: cut pieces are all of both, joints are cuts, anchors are met."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from shapetween.base.arrays import Curves, Floats
from shapetween.geometry.bezier import curve_lengths, evaluate
from shapetween.model.arclength import ArcLength
from shapetween.model.outline import Outline
from shapetween.outline.matched import CLEARANCE, MatchedOutlines
from tests.match.shapes import polygon, rewritten, rounded, star

T = np.linspace(0, 1, 7)


def knots(seed: int, count: int = 40) -> tuple[Floats, Floats]:
    """A random monotone matching of two circles, its knots over one turn."""
    rng = np.random.default_rng(seed)
    steps = rng.uniform(0.3, 1.7, (2, count))
    u, v = np.cumsum(np.concatenate([np.zeros((2, 1)), steps / steps.sum(1)[:, None]], axis=1), 1)
    return u + rng.uniform(), v + rng.uniform()


def pair(seed: int) -> tuple[Outline, Outline]:
    """One of corners and straight sides, the other smooth, and otherwise cut."""
    return polygon(star(seed, 5 + seed % 6)), rewritten(rounded(star(seed + 50, 7)), seed % 5, 0.4)


def matched(seed: int, anchors: Floats | None = None) -> MatchedOutlines:
    source, target = pair(seed)
    return MatchedOutlines(ArcLength(source), ArcLength(target), *knots(seed), anchors=anchors)


def own_parts(parts: Curves, outline: Outline) -> float:
    """Greatest distance of points of the parts from the outline itself, by dense points."""
    dense = evaluate(outline.curves, np.linspace(0, 1, 300)).reshape(-1, 2)
    points = evaluate(parts, T).reshape(-1, 2)
    return float(np.sqrt(((points[:, None] - dense) ** 2).sum(-1).min(axis=1)).max())


seeds = st.integers(0, 60)


@settings(max_examples=12)
@given(seeds, st.lists(st.floats(0, 0.999), max_size=6))
def test_pieces_are_all_of_both_outlines(seed: int, cuts: list[float]) -> None:
    """In order, without a gap, as long as the outline, each piece on it and inside it the same."""
    pieces = matched(seed).cut(np.unique(cuts))
    assert (np.diff(pieces.w) >= 0).all()
    for parts, outline in zip((pieces.source, pieces.target), pair(seed), strict=True):
        np.testing.assert_array_equal(parts[:, 3], np.roll(parts[:, 0], -1, axis=0))
        length = curve_lengths(outline.curves).sum()
        assert curve_lengths(parts).sum() == pytest.approx(length, rel=1e-6)
        assert Outline(parts).area == pytest.approx(outline.area, rel=1e-9)
        assert own_parts(parts, outline) < 0.01 * np.ptp(outline.box, axis=0).max()


@settings(max_examples=25)
@given(seeds)
def test_joints_of_either_outline_are_cuts(seed: int) -> None:
    """To the bit: curves that are whole are not computed anew."""
    pieces = matched(seed).cut(np.zeros(0))
    for parts, outline in zip((pieces.source, pieces.target), pair(seed), strict=True):
        starts = {tuple(point) for point in parts[:, 0].tolist()}
        assert {tuple(point) for point in outline.curves[:, 0].tolist()} <= starts


@settings(max_examples=25)
@given(seeds, st.lists(st.floats(0, 0.999), min_size=1, max_size=5))
def test_cuts_lie_where_the_matching_puts_them(seed: int, cuts: list[float]) -> None:
    both = matched(seed)
    places = np.unique(np.round(cuts, 3))
    pieces = both.cut(places)
    for w, *points in zip(places, *both.points(places), strict=True):
        k = int(np.abs(pieces.w - w).argmin())
        assert abs(pieces.w[k] - w) < 1e-9
        for parts, point in zip((pieces.source, pieces.target), points, strict=True):
            np.testing.assert_allclose(parts[k, 0], point, atol=1e-5)


@settings(max_examples=25)
@given(seeds, st.integers(1, 5))
def test_anchors_are_met_exactly(seed: int, count: int) -> None:
    """Points that a user pinned are the ends of pieces, on both sides at once."""
    u, v = knots(seed)
    rng = np.random.default_rng(seed)
    w = np.sort((np.arange(count) + rng.uniform(0.2, 0.8, count)) / count)
    on = w * (len(u) - 1)
    anchors = np.stack([np.interp(on, np.arange(len(u)), k) % 1 for k in (u, v)], axis=1)
    both = matched(seed, anchors)
    pieces = both.cut(np.zeros(0))
    a, b = (ArcLength(outline) for outline in pair(seed))
    for first, second in anchors:
        k = int(np.abs(pieces.source[:, 0] - a.point(np.array([first]))).sum(axis=1).argmin())
        np.testing.assert_allclose(pieces.source[k, 0], a.point(np.array([first]))[0], atol=1e-6)
        np.testing.assert_allclose(pieces.target[k, 0], b.point(np.array([second]))[0], atol=1e-6)


def test_corners_that_nearly_match_become_each_other() -> None:
    """A matching that misses every corner by a little: no slivers are cut beside them."""
    outline = polygon(star(3))
    places = ArcLength(outline)
    u = np.linspace(0, 1, 101)
    v = u + 0.004
    pieces = MatchedOutlines(places, places, u, v).cut(np.zeros(0))
    assert len(pieces.source) == len(outline.curves)
    np.testing.assert_array_equal(pieces.source, pieces.target)
    exact = MatchedOutlines(places, places, u, v, exact=True).cut(np.zeros(0))
    assert len(exact.source) == 2 * len(outline.curves)


def test_corners_go_to_corners_rather_than_to_smooth_joints() -> None:
    """A square's corner and a joint on its side, as near to the other square's corner."""
    corners = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
    plain = polygon(corners)
    jointed = polygon(np.insert(corners, 1, [0.985, 0.0], axis=0))
    u = np.linspace(0, 1, 101)
    both = MatchedOutlines(ArcLength(plain), ArcLength(jointed), u, u - 0.0018)
    pieces = both.cut(np.zeros(0))
    k = int(np.abs(pieces.source[:, 0] - [1, 0]).sum(axis=1).argmin())
    np.testing.assert_array_equal(pieces.source[k, 0], [1, 0])
    np.testing.assert_array_equal(pieces.target[k, 0], [1, 0])


@settings(max_examples=25)
@given(seeds, st.sampled_from([32, 200, 512]))
def test_samples_hold_every_joint_once_and_keep_apart(seed: int, count: int) -> None:
    both = matched(seed)
    samples = both.samples(count)
    assert (np.diff(samples.w) > 1e-3 / count).all()
    assert samples.w.min() >= 0
    assert samples.w.max() < 1
    gaps = np.diff(np.append(samples.w, samples.w[0] + 1))
    assert gaps.max() < 2.6 / count
    for points, outline in zip((samples.source, samples.target), pair(seed), strict=True):
        for joint in outline.curves[:, 0]:
            near = np.linalg.norm(points[samples.joints] - joint, axis=1).min()
            assert near < 0.02 * np.ptp(outline.box, axis=0).max()


def test_rounding_does_not_choose_the_samples() -> None:
    corners = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
    found = []
    for noise in (-1e-12, 1e-12):
        at = 0.625 + (CLEARANCE + noise) / 8  # a joint just as far from a sample as may be
        square = ArcLength(polygon(np.insert(corners, 3, [3 - 4 * at, 1], axis=0)))
        u = np.linspace(0.0, 1.0, 9)
        found.append(MatchedOutlines(square, square, u, u).samples(8))
    assert (found[0].joints == found[1].joints).all()
    np.testing.assert_allclose(found[0].w, found[1].w, atol=1e-9)


@settings(max_examples=20)
@given(seeds)
def test_the_common_parameter_of_a_place(seed: int) -> None:
    both = matched(seed)
    u = np.linspace(0, 0.99, 34)
    source, _ = both.points(both.parameter(u))
    np.testing.assert_allclose(source, ArcLength(pair(seed)[0]).point(u), atol=1e-6)
