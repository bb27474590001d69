"""Lines that end on others stay on them, whatever either becomes."""

import numpy as np
import pytest

from shapetween.attach.nearby import Parts
from shapetween.attach.planes import AffinePlane
from shapetween.attach.riders import Rider, Tip, riding
from shapetween.attach.ties import Spot, Tie, Tied
from shapetween.base.arrays import Curves, Floats
from shapetween.geometry.bezier import evaluate
from shapetween.model.outline import Outline
from tests.drawings import line, square

T = np.linspace(0, 1, 9)
REST = AffinePlane(np.eye(2, 3), np.zeros(2))
NOWHERE = np.zeros(2)


def rider(first: Outline, second: Outline) -> Rider:
    return riding(Parts(first.curves, second.curves, first.closed), REST, (100.0, 100.0))


def post(x: float, top: float = 0.0) -> Outline:
    return line((x, top), (x, 100)).rings[0]


def bar(left: float, right: float, y: float) -> Outline:
    return line((left, y), ((left + right) / 2, y), (right, y)).rings[0]


def on_line(points: Floats, curves: Curves) -> Floats:
    """Distances of points (F, 2) from lines (F, P, 4, 2)."""
    dense = evaluate(curves, np.linspace(0, 1, 401)).reshape(len(curves), -1, 2)
    return np.asarray(np.linalg.norm(dense - points[:, None], axis=2).min(axis=1))


def test_a_bar_between_two_posts_stays_between_them() -> None:
    left, right = rider(post(10), post(30, 40)), rider(post(90), post(60, 40))
    alone = rider(bar(10, 90, 50), bar(30, 60, 70))
    spots = [(Spot(0.5, NOWHERE), Spot(0.5, NOWHERE))] * 2
    # Of the way of the posts' middles the bar alone knows nothing.
    crooked = riding(
        Parts(left.source, left.target, False),
        AffinePlane(np.array([[1.0, 0.2, 3], [0, 1.3, 0]]), np.zeros(2)),
        (100.0, 100.0),
    )
    found = Tied(alone, (Tie(0.0, crooked, spots[0], True), Tie(2.0, right, spots[1], True)))
    frames = found.curves(T)
    np.testing.assert_array_equal(frames[0], alone.source)
    np.testing.assert_array_equal(frames[-1], alone.target)
    assert on_line(frames[:, 0, 0], crooked.curves(T)).max() < 0.3
    assert on_line(frames[:, -1, 3], right.curves(T)).max() < 0.3
    np.testing.assert_allclose(frames[:, 1:, 0], frames[:, :-1, 3], atol=1e-9)


def test_an_end_that_is_not_tied_stays_where_it_is() -> None:
    host = rider(post(10), post(10))
    moved = riding(
        Parts(host.source, host.target, False),
        AffinePlane(np.array([[1.0, 0.5, 0], [0, 1, 0]]), np.zeros(2)),
        (100.0, 100.0),
    )
    alone = rider(bar(10, 90, 50), bar(10, 90, 50))
    found = Tied(alone, (Tie(0.0, moved, (Spot(0.5, NOWHERE), Spot(0.5, NOWHERE)), True),))
    frames, free = found.curves(T), alone.curves(T)
    np.testing.assert_allclose(frames[:, -1, 3], free[:, -1, 3])
    assert np.abs(frames[:, 0, 0] - free[:, 0, 0]).max() > 1


def test_a_tie_of_one_drawing_loosens_on_the_way() -> None:
    host = rider(post(10), post(60))
    alone = rider(bar(10, 90, 50), bar(20, 90, 50))
    found = Tied(alone, (Tie(0.0, host, (Spot(0.5, NOWHERE), None), False),))
    away = np.linalg.norm(found.curves(T)[:, 0, 0] - alone.curves(T)[:, 0, 0], axis=1)
    np.testing.assert_allclose(away, 40 * T * (1 - T) ** 2, atol=1e-9)


@pytest.mark.parametrize("arrives", [False, True])
def test_what_comes_or_goes_is_carried_whole(arrives: bool) -> None:
    host = rider(post(10), post(60))
    twig = bar(60, 80, 50) if arrives else bar(10, 30, 50)
    tip = Tip.of(twig.curves, arrives, REST, 100.0)
    spot = Spot(0.5, NOWHERE)
    found = Tied(tip, (Tie(0.0, host, (None, spot) if arrives else (spot, None), True),))
    whole = found.whole(T)
    np.testing.assert_array_equal(whole[-1 if arrives else 0], twig.curves)
    np.testing.assert_allclose(
        whole - whole[:1],
        np.broadcast_to((50 * T)[:, None, None, None] * [1, 0], whole.shape),
        atol=1e-9,
    )
    assert np.ptp(found.curves(T)[0 if arrives else -1].reshape(-1, 2), axis=0).max() < 1e-9


def test_a_place_on_a_ring_goes_the_short_way_round() -> None:
    ring = square(0, 0, 40)
    host = rider(ring, ring)
    alone = rider(bar(0, 4, -9), bar(0, 4, -9))
    ties = (Tie(0.0, host, (Spot(3.9, NOWHERE), Spot(0.1, NOWHERE)), True),)
    ends = Tied(alone, ties).curves(T)[1:-1, 0, 0]
    assert np.linalg.norm(ends, axis=1).max() <= 4 + 1e-9


def test_lines_may_be_tied_to_tied_lines() -> None:
    host = rider(post(10), post(60))
    spot = Spot(0.5, NOWHERE)
    first = Tied(rider(bar(10, 50, 50), bar(60, 90, 50)), (Tie(0.0, host, (spot, spot), True),))
    twig = rider(line((30, 50), (30, 90)).rings[0], line((75, 50), (75, 90)).rings[0])
    second = Tied(twig, (Tie(0.0, first, (Spot(1.0, NOWHERE), Spot(1.0, NOWHERE)), True),))
    assert on_line(second.curves(T)[:, 0, 0], first.curves(T)).max() < 1e-9
