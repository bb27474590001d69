"""Lines that become others by turning along their length."""

import numpy as np
import pytest

from shapetween.attach.unroll import Turns, matched_along, overturned
from shapetween.geometry.bezier import evaluate
from shapetween.geometry.rotation import rotations
from shapetween.model.outline import Outline
from tests.drawings import line
from tests.movements import circle

T = np.linspace(0, 1, 9)


def arc(turn: float, size: float = 10.0, count: int = 12) -> Outline:
    """A chain of chords that turns by so much, evenly."""
    steps = size * np.exp(1j * np.linspace(0, turn, count))
    points = np.concatenate([[0], np.cumsum(steps)])
    return line(*zip(points.real, points.imag, strict=True)).rings[0]


def on_the_way(source: Outline, target: Outline, t: np.ndarray) -> np.ndarray:
    turns = Turns.of(source.curves, target.curves)
    ends = [np.repeat(o.curves[None], len(t), axis=0) for o in (source, target)]
    return turns.between(ends[0], ends[1], t)


def lengths(curves: np.ndarray) -> np.ndarray:
    points = evaluate(curves, np.linspace(0, 1, 9))
    return np.asarray(np.linalg.norm(np.diff(points, axis=-2), axis=-1).sum(axis=(-1, -2)))


def test_ends_are_met() -> None:
    source, target = arc(1.0), arc(-5.0, 7.0).transformed(np.array([[0, -1, 5], [1, 0, 9]]))
    frames = on_the_way(source, target, np.array([0.0, 1.0]))
    np.testing.assert_allclose(frames[0], source.curves, atol=1e-9)
    np.testing.assert_allclose(frames[1], target.curves, atol=1e-9)


def test_a_wire_that_is_bent_keeps_its_length_and_turns_evenly() -> None:
    frames = on_the_way(arc(2.0), arc(4.0), T)
    np.testing.assert_allclose(lengths(frames), 120.0)
    chords = (frames[:, :, 3] - frames[:, :, 0]) @ np.array([1, 1j])
    turned = np.angle(chords[:, 1:] / chords[:, :-1]).sum(axis=1)
    np.testing.assert_allclose(turned, 2.0 + 2.0 * T, atol=1e-9)


def test_it_does_not_grow_out_of_the_picture() -> None:
    frames = on_the_way(arc(12.0), arc(-12.0), T)
    boxes = np.ptp(frames.reshape(len(T), -1, 2), axis=1)
    assert np.linalg.norm(boxes, axis=1).max() <= 1.11 * np.linalg.norm(boxes[0])


def test_a_turned_line_turns_as_a_whole() -> None:
    source = arc(3.0)
    target = source.transformed(np.column_stack([rotations(np.asarray(2.5)), [3.0, 4.0]]))
    np.testing.assert_allclose(lengths(on_the_way(source, target, T)), 120.0)


def test_joints_stay_smooth() -> None:
    half = Outline(circle(np.zeros(2), 10.0)[:2], closed=False)
    other = half.reversed().transformed(np.array([[1.0, 0.3, 0], [0, 2.0, 0]]))
    frames = on_the_way(half, other, T)
    leaving = (frames[:, 1, 1] - frames[:, 1, 0]) @ np.array([1, 1j])
    reaching = (frames[:, 0, 3] - frames[:, 0, 2]) @ np.array([1, 1j])
    np.testing.assert_allclose(np.angle(leaving / reaching), 0, atol=1e-9)


@pytest.mark.parametrize("back", [False, True])
def test_the_ends_that_turn_least_become_each_other(back: bool) -> None:
    source = arc(3.0)
    target = arc(3.2).reversed() if back else arc(3.2)
    found = matched_along(source, target)
    assert not found.closed
    first = target.curves[-1, 3] if back else target.curves[0, 0]
    np.testing.assert_allclose(found.target[0, 0], first, atol=1e-9)
    assert len(found.source) == len(found.target) == 12


def test_a_ring_is_cut_open_to_become_a_line() -> None:
    ring = Outline(circle(np.zeros(2), 10.0))
    for pair in ((ring, arc(6.0)), (arc(6.0), ring)):
        found = matched_along(*pair)
        assert not found.closed
        np.testing.assert_allclose(found.source[1:, 0], found.source[:-1, 3], atol=1e-9)
        turns = Turns.of(found.source, found.target)
        assert np.ptp(turns.angles) < 1.0


def test_parts_without_handles_or_length_are_no_trouble() -> None:
    first, second = arc(1.0, count=3).curves.copy(), arc(4.0, count=3).curves.copy()
    first[0, 1], second[2, 2] = first[0, 0], second[2, 3]
    second[1] = second[1, 0]
    second[2] += second[1, 3] - second[2, 0]
    source, target = Outline(first, closed=False), Outline(second, closed=False)
    frames = on_the_way(source, target, np.array([0.0, 0.5, 1.0]))
    assert np.isfinite(frames).all()
    np.testing.assert_allclose(frames[0], first, atol=1e-9)
    np.testing.assert_allclose(frames[2], second, atol=1e-9)


def test_what_turns_far_is_told() -> None:
    assert overturned(arc(0.0).curves, arc(6.0).curves)
    assert not overturned(arc(0.0).curves, arc(1.0).curves)
