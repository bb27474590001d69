"""Lines to lines: their own curves at both ends, the same way round, turned as a whole."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from shapetween.attach.nearby import matched_nearby
from shapetween.attach.planes import AffinePlane
from shapetween.attach.riders import Rider, riding
from shapetween.attach.specks import morph_speck
from shapetween.base.arrays import Points
from shapetween.geometry.bezier import curve_lengths, evaluate
from shapetween.model.outline import Outline
from tests.drawings import line
from tests.match.shapes import disc, polygon, star
from tests.strategies import rotation

T = np.linspace(0, 1, 11)

RESTING = AffinePlane(np.eye(2, 3), np.zeros(2))


def morph_line(source: Outline, target: Outline) -> Rider:
    """A line becoming another where nothing else moves."""
    extents = [float(np.ptp(line.box)) for line in (source, target)]
    return riding(matched_nearby(source, target, RESTING), RESTING, (extents[0], extents[1]))


def path(*corners: tuple[float, float]) -> Outline:
    return line(*corners).rings[0]


def wavy(seed: int) -> Outline:
    """A random open line of curves."""
    rng = np.random.default_rng(seed)
    count = int(rng.integers(1, 6))
    points = np.cumsum(rng.uniform(0.5, 2, (3 * count + 1, 2)) * [1, rng.choice([-1, 1])], axis=0)
    curves = np.stack([points[3 * k : 3 * k + 4] for k in range(count)])
    return Outline(curves, closed=False)


def distance(points: Points, outline: Outline) -> float:
    dense = evaluate(outline.curves, np.linspace(0, 1, 400)).reshape(-1, 2)
    return float(np.linalg.norm(points[:, None] - dense, axis=-1).min(axis=1).max())


seeds = st.integers(0, 80)


@settings(max_examples=30)
@given(seeds, seeds)
def test_open_lines_end_as_they_are(a: int, b: int) -> None:
    """All of both, in one run, from end to end, whichever way they are run."""
    source, target = wavy(a), wavy(b)
    found = morph_line(source, target)
    frames = found.curves(T)
    assert frames.shape == (len(T), len(found.source), 4, 2)
    np.testing.assert_array_equal(frames[:, 1:, 0], frames[:, :-1, 3])
    for frame, drawn in ((frames[0], source), (frames[-1], target)):
        assert curve_lengths(frame).sum() == pytest.approx(curve_lengths(drawn.curves).sum())
        size = np.ptp(drawn.box)
        assert distance(evaluate(frame, np.linspace(0, 1, 5)).reshape(-1, 2), drawn) < 0.02 * size
        got = {tuple(p) for p in (frame[0, 0], frame[-1, 3])}
        assert got == {tuple(p) for p in (drawn.curves[0, 0], drawn.curves[-1, 3])}
    assert len(found.source) <= len(source.curves) + len(target.curves)
    assert not found.closed


def test_a_line_drawn_the_other_way_is_the_same_line() -> None:
    there = path((0, 0), (10, 2), (20, 0))
    for target in (there, there.reversed()):
        frames = morph_line(there, target).curves(T)
        np.testing.assert_allclose(frames, np.repeat(there.curves[None], len(T), axis=0))


@pytest.mark.parametrize("degrees", [20, 75, 90])
def test_a_turned_line_turns(degrees: float) -> None:
    """It keeps its length instead of shrinking through its middle."""
    there = path((0, 0), (10, 2), (20, 0), (25, 8))
    matrix = np.column_stack([rotation(np.deg2rad(degrees)), [5.0, 1.0]])
    frames = morph_line(there, there.transformed(matrix)).curves(T)
    lengths = [curve_lengths(frame).sum() for frame in frames]
    np.testing.assert_allclose(lengths, lengths[0])


def test_corners_that_nearly_match_become_each_other() -> None:
    """No curve is cut beside a corner."""
    found = morph_line(path((0, 0), (10, 0), (20, 5)), path((0, 0), (10, 3), (20, 3)))
    assert len(found.source) == 2
    far = morph_line(path((0, 0), (5, 0), (20, 5)), path((0, 0), (14, 6), (20, 6)))
    assert len(far.source) == 3


@settings(max_examples=4)
@given(seeds, seeds, st.booleans())
def test_closed_lines_stay_closed(a: int, b: int, backwards: bool) -> None:
    source, target = polygon(star(a, 6)), polygon(star(b, 8))
    found = morph_line(source, target.reversed() if backwards else target)
    assert found.closed
    frames = found.curves(T)
    np.testing.assert_array_equal(frames[:, :, 0], np.roll(frames[:, :, 3], 1, axis=1))
    assert abs(Outline(frames[0]).area) == pytest.approx(source.area)
    assert abs(Outline(frames[-1]).area) == pytest.approx(target.area)


@pytest.mark.parametrize("opened", ["source", "target"])
@pytest.mark.parametrize("backwards", [False, True])
def test_a_closed_line_opens_where_the_open_one_ends(opened: str, backwards: bool) -> None:
    """A circle to three quarters of itself: it opens at the missing quarter."""
    whole = disc()
    arc = Outline(whole.curves[:3], closed=False)
    if backwards:
        arc = arc.reversed()
    pair = (arc, whole) if opened == "source" else (whole, arc)
    found = morph_line(*pair)
    assert not found.closed
    frames = found.curves(T)
    ring = frames[-1] if opened == "source" else frames[0]
    np.testing.assert_allclose(ring[0, 0], ring[-1, 3], atol=1e-12)
    missing = evaluate(whole.curves[3:], np.array([0.5]))[0, 0]
    assert ring[0, 0] @ missing > 0.85
    assert curve_lengths(ring).sum() == pytest.approx(curve_lengths(whole.curves).sum())


def test_closed_lines_that_enclose_nothing_are_lines_too() -> None:
    """There and back again, closed: it has no area to be matched by."""
    flat = Outline(path((0, 0), (10, 0), (0, 0)).curves)
    found = morph_line(flat, polygon(star(3)))
    frames = found.curves(T)
    assert np.isfinite(frames).all()
    assert curve_lengths(frames[0]).sum() == pytest.approx(20)


def test_specks_stay_closed_and_end_as_they_are() -> None:
    source, target = polygon(star(3, 6)), disc()
    frames = morph_speck(source, target).curves(T)
    np.testing.assert_array_equal(frames[:, :, 0], np.roll(frames[:, :, 3], 1, axis=1))
    assert Outline(frames[0]).area == pytest.approx(source.area)
    assert Outline(frames[-1]).area == pytest.approx(target.area)
