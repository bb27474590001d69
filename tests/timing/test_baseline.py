"""How movements are told in time, in figures that are known.

Points turn, swing, are drawn out piece by piece, leap and come to rest, so that each way of telling
it as a sum, and as keyframes, is taken by some and given up by others.
"""

from collections.abc import Callable

import numpy as np
import pytest

from shapetween.base.arrays import Floats
from shapetween.base.errors import OptionError
from shapetween.timing import windows
from shapetween.timing.easing import easing_function
from shapetween.timing.fitted import fitted_keyframes
from shapetween.timing.keyframes import KEYFRAME_TOLERANCE, keyframes
from shapetween.timing.schedule import Schedule
from shapetween.timing.springs import spring
from shapetween.timing.sums import EasingSum, sum_of_easings
from shapetween.timing.timeline import Timeline
from shapetween.timing.windows import turning_times
from tests.baseline import assert_known

SCHEDULE, _ = Schedule.of("linear").finer()
STEP = 0.01
TOLERANCE = 1000 * KEYFRAME_TOLERANCE

SIZES = (0.01, 0.1, 0.6, 3.0)


def _home(count: int, seed: int) -> Floats:
    return np.random.default_rng(seed).normal(size=(count, 2)) * 200


def _ramp(t: Floats, start: float, end: float) -> Floats:
    return np.clip((t - start) / (end - start), 0.0, 1.0)


def _turned(t: Floats, size: float) -> Floats:
    c, s = np.cos(2.0 * size * t), np.sin(2.0 * size * t)
    turn = np.stack([np.stack([c, -s], -1), np.stack([s, c], -1)], -2)
    return np.asarray(np.einsum("tij,kj->tki", turn, _home(12, 1)))


def _swung(t: Floats, size: float) -> Floats:
    way = np.stack([np.sin(5 * size * t), 1 - np.cos(3 * t)], -1)
    return _home(8, 2) + 90 * way[:, None] * np.linspace(0.2, 1.0, 8)[:, None]


def _pieces(t: Floats, size: float) -> Floats:
    ends = [(0.05 + 0.11 * k, 0.05 + 0.11 * k + 0.05 + 0.1 * size / 3) for k in range(7)]
    shares = np.stack([_ramp(t, *both) for both in ends], -1)
    return _home(7, 3) * (0.2 + shares[..., None])


def _leaping(t: Floats, size: float) -> Floats:
    leap = _ramp(t, 0.4142, 0.4142 + 2e-3 * size)
    return _turned(t, 0.3) + 30 * size * leap[:, None, None]


def _coming(t: Floats, size: float) -> Floats:
    grown = _ramp(t, 0.1 + 0.2 * size / 3, 0.9) ** (1.5 + size)
    return _home(9, 4) * grown[:, None, None] + 20 * size * t[:, None, None]


def _shaken(t: Floats, size: float) -> Floats:
    shake = np.sin(40 * t[:, None] + np.arange(12)) * size
    return _turned(t, 0.5) + np.stack([shake, 0.3 * shake], -1)


def _setting_off(t: Floats, size: float) -> Floats:
    late = np.clip(t - 0.53, 0, None)
    way = np.stack([200 * t + 1e5 * size * late**3, 30 * np.sin(t) + 900 * late**2], -1)
    return _home(5, 5) + way[:, None]


def _near_corners(t: Floats, size: float) -> Floats:
    """Corners at places that lie closer together the larger it is."""
    gap = 0.03 / (1 + 4 * size)
    corners = [0.3 + gap * k for k in range(4)] + [0.81]
    ways = [np.clip(t - c, 0, None) * (150 + 100 * k) for k, c in enumerate(corners)]
    both = np.stack([sum(ways[::2], 0 * t), sum(ways[1::2], 0 * t)], -1)
    return _home(4, 6) + both[:, None]


MOVES: tuple[Callable[[Floats, float], Floats], ...] = (
    _turned,
    _swung,
    _pieces,
    _leaping,
    _coming,
    _shaken,
    _setting_off,
    _near_corners,
)


def of_sum(found: EasingSum | None) -> list[float]:
    if found is None:
        return [0.0] * 4
    handles = np.array([easing.handles for easing in found.easings])
    ends = np.array([easing.window for easing in found.easings])
    order = 1 + 0.31 * np.arange(len(ends))
    size = np.abs(found.terms).sum(axis=(1, 2))
    return [
        float(len(ends)),
        float((order[:, None] * handles * [1, 1.3, 1.7, 2.1]).sum()),
        float((order[:, None] * ends * [1, 1.5]).sum()),
        float((order * size).sum()),
    ]


@pytest.mark.parametrize("move", MOVES, ids=lambda move: move.__name__[1:])
def test_sums_are_known(move: Callable[[Floats, float], Floats]) -> None:
    figures: list[float] = []
    for size in SIZES:

        def places(clock: Floats, size: float = size) -> Floats:
            return move(clock, size)

        turns = turning_times(places(SCHEDULE.clock), SCHEDULE.clock, TOLERANCE, places)
        figures += [float(len(turns)), float(np.sum(turns))]
        schedule = SCHEDULE.with_corners(turns)[0] if turns else SCHEDULE
        for late, importance, most in ((False, 1.0, 60), (True, 0.3, 30)):
            points = places(schedule.clock)
            weights = np.full(points.shape[1], importance)

            def of_use(most: int = most) -> int:
                return most

            found = sum_of_easings(
                points, schedule.clock, STEP, TOLERANCE, weights, of_use, turns, late=late
            )
            figures += of_sum(found)
    assert_known("timing", f"sum of what is {move.__name__[1:]}", figures)


@pytest.mark.parametrize("move", MOVES, ids=lambda move: move.__name__[1:])
def test_keyframes_are_known(move: Callable[[Floats, float], Floats]) -> None:
    schedule = Schedule.of("linear")
    figures: list[float] = []
    for size in SIZES:
        points = move(schedule.clock, size)
        knots, values = fitted_keyframes(points, schedule.clock, TOLERANCE)
        figures += [float(len(knots)), float(knots.sum()), float(np.abs(values).sum())]
        picks = keyframes(points, schedule.time, TOLERANCE)
        figures += [float(len(picks)), float(picks.sum())]
    assert_known("timing", f"keyframes of what is {move.__name__[1:]}", figures)


def test_when_samples_are_is_known() -> None:
    figures: list[float] = []
    for name in ("linear", "ease", "cubic-bezier(0,.6,.1,1)"):
        schedule = Schedule.of(name)
        finer, kept = schedule.finer()
        cornered, own = finer.with_corners((0.2, 0.2131, 0.7))
        for each in (schedule, finer, cornered, schedule.strided(4)):
            order = np.arange(len(each.clock)) % 7
            figures += [float(len(each.clock)), float(order @ each.clock), float(order @ each.time)]
            figures.append(float(np.diff(each.clock).min() * 1e3))
        figures += [float(kept.sum()), float(own.sum())]
    assert_known("timing", "samples", figures)


def test_springs_are_known() -> None:
    times = np.linspace(0, 1, 41)
    dampings = (2.0, 8.0, 20.0, 20 * (1 + 5e-7), 20 * (1 + 5e-6), 45.0)
    figures = [float(spring(1.0, 100.0, damping)(times).sum()) for damping in dampings]
    figures += easing_function("spring(1,200,9)")(times).tolist()
    assert_known("timing", "springs", figures)


def test_easings_to_choose_among_are_known() -> None:
    clock = np.linspace(0, 1, 241)
    figures: list[float] = []
    for turns in ((), (0.3,), (0.2, 0.4, 0.6), (0.1, 0.2, 0.3, 0.4, 0.5)):
        easings, shares = windows.library(clock, turns)
        figures += [float(len(easings)), float(shares.sum())]
    assert_known("timing", "library", figures)


def test_corners_seen_from_afar_are_known() -> None:
    """How sharp a corner is seen among others, and how far what leaps goes."""
    clock = SCHEDULE.clock
    found = []
    for share in np.geomspace(0.03, 1.0, 24):
        both = np.clip(clock - 0.3, 0, None) + share * np.clip(clock - 0.7, 0, None)
        points = np.stack([900 * both, 20 * clock], axis=-1)[:, None]
        found.append(float(len(turning_times(points, clock, TOLERANCE))))
    for way in np.geomspace(0.1, 100.0, 24):
        points = np.stack([way * np.clip(clock - 0.4, 0, 0.3), 90 * clock], axis=-1)[:, None]
        found.append(float(len(turning_times(points, clock, TOLERANCE))))
    assert_known("timing", "corners from afar", found)


def test_how_short_a_way_may_be_is_known() -> None:
    refused = 0
    for seconds in np.geomspace(1e-4, 1e-2, 60):
        try:
            Timeline((float(seconds),), "once", 0.0, False)
        except OptionError:
            refused += 1
    assert_known("timing", "too short", [float(refused)])


def test_how_late_what_is_quick_may_be_is_known() -> None:
    """Points that run at many speeds, and come or go meanwhile."""
    figures: list[float] = []
    schedule = SCHEDULE.with_corners((0.25, 0.5))[0]
    for speed in np.geomspace(500.0, 60_000.0, 12):
        ways = _ramp(schedule.clock, 0.25, 0.5)[:, None, None] * np.array([[1.0, 0.3], [0.5, 1.0]])
        sway = np.sin(7 * schedule.clock + speed)[:, None, None] * np.array(
            [[0.5, 0.1], [0.2, 0.4]]
        )
        points = ways * speed / 4 + sway * TOLERANCE * 4
        turns = (0.25, 0.5)
        found = sum_of_easings(
            points, schedule.clock, STEP, TOLERANCE, np.ones(2), lambda: 40, turns, late=True
        )
        figures += of_sum(found)
    assert_known("timing", "late", figures)


def _zigzag(t: Floats, corners: int) -> Floats:
    """As many corners, evenly in time but for a little, one as sharp as the other."""
    at = (np.arange(1, corners + 1) + 0.2 * np.sin(np.arange(corners))) / (corners + 1)
    signs = np.where(np.arange(corners) % 2, 1.0, -1.0)
    way = 400 * t + 800 * (signs * np.clip(t[:, None] - at, 0, None)).sum(axis=1)
    return np.asarray(_home(3, 7) + np.stack([way, 0.3 * way], -1)[:, None])


def test_what_has_many_corners_is_known() -> None:
    figures: list[float] = []
    for corners in (2, 4, 6, 7, 9, 12, 13, 20, 31, 32, 33, 45, 70):
        clock = np.linspace(0, 1, 1201)
        figures.append(float(len(turning_times(_zigzag(clock, corners), clock, TOLERANCE))))
    for corners in (2, 4, 6, 7, 9, 12, 13):
        turns = turning_times(_zigzag(SCHEDULE.clock, corners), SCHEDULE.clock, TOLERANCE)
        schedule = SCHEDULE.with_corners(turns)[0] if turns else SCHEDULE
        points = _zigzag(schedule.clock, corners)
        weights = np.ones(points.shape[1])
        found = sum_of_easings(
            points, schedule.clock, STEP, TOLERANCE, weights, lambda: 60, turns, late=False
        )
        figures += of_sum(found)
    assert_known("timing", "many corners", figures)


def test_what_moves_in_many_ways_is_known() -> None:
    """Which takes many easings, or is given up; and at few samples, of which all take part."""
    figures: list[float] = []
    for count in (21, 41, 61, 81, 241):
        clock = np.linspace(0, 1, count)
        for waves in (1.0, 3.0, 6.0, 9.0):
            own = np.arange(1, 9) * waves
            sway = np.stack([np.sin(own * clock[:, None]), np.cos(own * clock[:, None])], -1)
            points = _home(8, 8) + 40 * sway / own[:, None]
            found = sum_of_easings(
                points, clock, STEP, 3 * TOLERANCE, np.ones(8), lambda: 60, (), late=False
            )
            figures += of_sum(found)
    assert_known("timing", "many ways", figures)
