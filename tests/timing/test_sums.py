"""Movements as sums of easings: near at all times, exact at the ends, and few."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from shapetween.base.arrays import Floats
from shapetween.timing.easing import LINEAR, easing_function
from shapetween.timing.schedule import Schedule
from shapetween.timing.sums import MOST_IN_TURN, MOST_TERMS, EasingSum, sum_of_easings, united
from shapetween.timing.windows import Eased, turning_times

SCHEDULE, _ = Schedule.of("linear").finer()
CLOCK = SCHEDULE.clock
STEP, TOLERANCE = 0.01, 0.18
EVERYWHERE = np.linspace(0, 1, 601)


def turning(angle: float, t: Floats, count: int = 40) -> Floats:
    """Points on a circle of 300 that turn and drift, (S, K, 2), in thousandths of a picture."""
    around = np.linspace(0, 2 * np.pi, count, endpoint=False)
    phase = angle * t[:, None] + around
    drift = np.stack([120 * t, -50 * t * t], axis=-1)[:, None]
    return 300 * np.stack([np.cos(phase), np.sin(phase)], axis=-1) + drift


def found(points: Floats, importance: Floats | None = None) -> EasingSum | None:
    weights = np.ones(points.shape[1]) if importance is None else importance
    turns = turning_times(points, CLOCK, TOLERANCE)
    return sum_of_easings(points, CLOCK, STEP, TOLERANCE, weights, turns=turns)


def in_rows(t: Floats) -> Floats:
    """Twelve points of which one after another is drawn out by 400, as a slash draws gaps."""
    rows = []
    for k in range(6):
        share = np.clip((t - k / 7.1) / (1.6 / 7.1), 0.0, 1.0)[:, None, None]
        rows.append(share * np.array([[400.0, 60.0 * k], [380.0, 10.0]]))
    return np.concatenate(rows, axis=1)


def shown(result: EasingSum, points: Floats, clock: Floats) -> Floats:
    """As a player works it out, by easings solved anew."""
    total = np.broadcast_to(np.rint(points[0] / STEP) * STEP, (len(clock), *points[0].shape)).copy()
    for easing, term in zip(result.easings, result.terms, strict=True):
        ease = easing_function(f"cubic-bezier({','.join(map(repr, easing.handles))})")
        start, end = easing.window
        share = ease(np.clip((clock - start) / (end - start), 0, 1))
        total += share[:, None, None] * term * STEP
    return total


@settings(max_examples=30)
@given(st.floats(-2.5, 2.5))
def test_points_that_turn_stay_near_their_places(angle: float) -> None:
    points = turning(angle, CLOCK)
    result = found(points)
    assert result is not None
    away = shown(result, points, EVERYWHERE) - turning(angle, EVERYWHERE)
    assert np.linalg.norm(away, axis=-1).max() <= TOLERANCE + STEP
    end = shown(result, points, np.ones(1))[0]
    np.testing.assert_allclose(end, np.rint(points[-1] / STEP) * STEP, atol=1e-9)
    np.testing.assert_allclose(
        result.at(EVERYWHERE) * STEP + np.rint(points[0] / STEP) * STEP,
        shown(result, points, EVERYWHERE),
        atol=1e-3,
    )


def test_a_straight_way_is_one_easing() -> None:
    points = np.array([[0.0, 0.0], [50.0, 10.0]]) + CLOCK[:, None, None] * np.array([300.0, 40.0])
    result = found(points)
    assert result is not None
    assert result.easings == (Eased(LINEAR),)
    eased = easing_function("cubic-bezier(.4,0,.6,1)")(CLOCK)
    result = found(points[:1] + eased[:, None, None] * np.array([300.0, 40.0]))
    assert result is not None
    assert len(result.easings) == 1


def test_few_easings_do_where_a_third_of_a_turn_takes_dozens_of_keyframes() -> None:
    result = found(turning(2.1, CLOCK))
    assert result is not None
    assert len(result.easings) <= 6


def test_what_shakes_is_no_sum() -> None:
    shaken = turning(1.0, CLOCK)
    shaken[:, 5, 0] += 20 * np.sin(40 * CLOCK)
    assert found(shaken) is None


def test_what_jumps_is_one_that_jumps() -> None:
    points = turning(1.0, CLOCK)
    points[CLOCK > 0.5, 3] += 40.0
    result = found(points)
    assert result is not None
    away = shown(result, points, CLOCK) - points
    assert np.linalg.norm(away, axis=-1).max() <= 2 * TOLERANCE + STEP


def test_what_returns_to_where_it_was_is_a_sum_too() -> None:
    points = turning(0.0, CLOCK) * 0 + (60 * CLOCK * (1 - CLOCK))[:, None, None]
    result = found(points)
    assert result is not None
    np.testing.assert_array_equal(result.terms.sum(axis=0), 0)
    assert len(result.easings) <= MOST_TERMS


def smooth(t: Floats) -> Floats:
    s = np.clip(t, 0.0, 1.0)
    return np.asarray(s * s * (3 - 2 * s))


def test_what_goes_in_a_part_of_the_time_is_one_easing_over_it() -> None:
    """It shrinks without a jerk, and is still for the rest."""
    home = turning(0.0, CLOCK)[:1]
    points = home * (1 - smooth(CLOCK / 0.45))[:, None, None]
    assert turning_times(points, CLOCK, TOLERANCE) == (0.45,)
    result = found(points)
    assert result is not None
    assert result.easings == (Eased((1 / 3, 0.0, 2 / 3, 1.0), (0.0, 0.45)),)
    later = home * smooth((CLOCK - 0.55) / 0.45)[:, None, None]
    result = found(later)
    assert result is not None
    assert result.easings == (Eased((1 / 3, 0.0, 2 / 3, 1.0), (0.55, 1.0)),)


def test_what_goes_while_it_is_carried_takes_few_more() -> None:
    """Without windows it takes three times as many, or cannot be."""
    points = turning(1.2, CLOCK) * (1 - 0.7 * smooth((CLOCK - 0.1) / 0.45))[:, None, None]
    result = found(points)
    assert result is not None
    assert len(result.easings) <= 9
    away = shown(result, points, CLOCK) - points
    assert np.linalg.norm(away, axis=-1).max() <= TOLERANCE + STEP
    starts = [easing.window[0] for easing in result.easings]
    assert starts == sorted(starts)


@pytest.mark.parametrize("power", [2, 3])
def test_what_shrinks_to_a_sudden_stop_is_one_easing(power: int) -> None:
    home = turning(0.0, CLOCK)[:1]
    points = home * (1 - np.clip(CLOCK / 0.5, 0, 1) ** power)[:, None, None]
    assert turning_times(points, CLOCK, TOLERANCE) == (0.5,)
    result = found(points)
    assert result is not None
    assert len(result.easings) == 1
    later = home * (1 - np.clip((1 - CLOCK) / 0.5, 0, 1) ** power)[:, None, None]
    result = found(later)
    assert result is not None
    assert len(result.easings) == 1


def test_what_shrinks_as_parts_do_is_one_easing() -> None:
    home = turning(0.0, CLOCK)[:1] * 0.6
    result = found(home * (1 - CLOCK**2.4)[:, None, None])
    assert result is not None
    assert len(result.easings) == 1


def test_corners_between_samples_are_found_by_looking_closer() -> None:
    def places(t: Floats) -> Floats:
        return in_rows(t) + np.clip((t - 0.4142) / 0.004, 0, 1)[:, None, None] * [30.0, 0.0]

    close = turning_times(places(CLOCK), CLOCK, TOLERANCE, places)
    wanted = [k / 7.1 for k in range(1, 6)] + [(k + 1.6) / 7.1 for k in range(5)]
    for corner in [*wanted, 0.4142, 0.4182]:
        assert min(abs(np.array(close) - corner)) < 2e-5
    assert len(close) <= len(wanted) + 3


@pytest.mark.parametrize("gap", [0.0012, 0.0014, 0.0018, 0.0022, 0.003, 0.005, 0.012])
@pytest.mark.parametrize("first", [0.4, 0.40011, 0.3997])
def test_corners_near_each_other_are_where_they_are_whatever_the_last_bits(
    first: float, gap: float
) -> None:
    """Beside one of them a corner was seen .0014 off, where only rounding told how far."""
    random = np.random.default_rng(1)

    def places(t: Floats, noise: float = 0.0) -> Floats:
        across, down = (300 * np.clip(t - corner, 0, None) for corner in (first, first + gap))
        exact = np.stack([across, down + 30 * t], axis=-1)[:, None]
        return np.asarray(exact * (1 + noise * random.uniform(-1, 1, exact.shape)))

    usual = turning_times(places(CLOCK), CLOCK, TOLERANCE, places)
    for time in usual:
        assert min(abs(time - first), abs(time - first - gap)) < 2e-5
    assert len(usual) == 2 or gap < 0.0025
    for _ in range(4):
        shaken = turning_times(places(CLOCK), CLOCK, TOLERANCE, lambda t: places(t, noise=2e-16))
        assert shaken == usual


def test_what_sets_off_as_a_third_power_is_a_corner() -> None:
    def places(t: Floats) -> Floats:
        late = np.clip(t - 0.91, 0, None)
        return np.stack([200 * t + 6e5 * late**3, 30 * np.sin(t)], axis=-1)[:, None]

    times = turning_times(places(CLOCK), CLOCK, TOLERANCE, places)
    assert min(abs(time - 0.91) for time in times) < 0.006
    # On the way there is none, as fast as it bends.
    assert not [time for time in times if 0.92 < time < 0.99]


def test_what_is_drawn_out_piece_by_piece_is_one_even_window_each() -> None:
    turns = turning_times(in_rows(CLOCK), CLOCK, TOLERANCE, in_rows)
    schedule, _ = SCHEDULE.with_corners(turns)
    clock = schedule.clock
    weights = np.ones(12)
    result = sum_of_easings(in_rows(clock), clock, STEP, TOLERANCE, weights, turns=turns)
    assert result is not None
    assert len(result.easings) == 6
    assert {easing.handles for easing in result.easings} == {LINEAR}
    away = shown(result, in_rows(clock), EVERYWHERE) - in_rows(EVERYWHERE)
    assert np.linalg.norm(away, axis=-1).max() <= TOLERANCE + STEP


@pytest.mark.parametrize(("pieces", "sums"), [(MOST_IN_TURN - 2, True), (MOST_IN_TURN + 2, False)])
def test_windows_one_after_another_are_no_more_than_a_player_is_to_add(
    pieces: int, sums: bool
) -> None:
    def places(t: Floats) -> Floats:
        shares = np.clip(pieces * t[:, None] - np.arange(pieces), 0.0, 1.0)
        return np.asarray(shares[..., None] * np.array([400.0, 60.0]))

    turns = tuple(k / pieces for k in range(1, pieces))
    clock = SCHEDULE.with_corners(turns)[0].clock
    weights = np.ones(pieces)
    result = sum_of_easings(
        places(clock), clock, STEP, TOLERANCE, weights, lambda: 100, turns=turns
    )
    assert (result is not None) == sums
    assert result is None or len(result.easings) == pieces


def test_smooth_movement_has_no_corners() -> None:
    assert turning_times(turning(2.5, CLOCK), CLOCK, TOLERANCE) == ()


def test_no_more_easings_are_sought_than_are_of_use() -> None:
    points = turning(2.1, CLOCK)
    weights = np.ones(points.shape[1])
    assert sum_of_easings(points, CLOCK, STEP, TOLERANCE, weights, lambda: 2) is None


def test_what_stands_still_is_none() -> None:
    assert found(np.ones((len(CLOCK), 3, 2))) is None


def test_points_of_less_importance_may_be_farther_off() -> None:
    points = turning(1.3, CLOCK)
    points[:, ::2, 0] += 1.5 * np.sin(9 * CLOCK)[:, None]
    even, uneven = found(points), found(points, np.where(np.arange(40) % 2, 1.0, 0.05))
    assert uneven is not None
    assert even is None or len(uneven.easings) < len(even.easings)


@pytest.mark.parametrize("scale", [1 / 1024, 1024.0])
def test_units_do_not_matter(scale: float) -> None:
    points = turning(1.7, CLOCK)
    usual = found(points)
    other = sum_of_easings(
        points * scale, CLOCK, STEP * scale, TOLERANCE * scale, np.ones(points.shape[1])
    )
    assert usual is not None
    assert other is not None
    assert usual.easings == other.easings
    np.testing.assert_array_equal(usual.terms, other.terms)


@pytest.mark.parametrize("bent", range(1, 7))
def test_the_last_bits_of_places_choose_no_easing(bent: int) -> None:
    points = turning(1.7, CLOCK)
    points[:, ::3, 0] += 10 * bent * np.sin(5 * CLOCK)[:, None] * np.linspace(0, 1, 14)
    points[:, 1::3, 1] += 8 * bent * CLOCK[:, None] ** 3 * np.linspace(-1, 1, 13)
    noise = np.random.default_rng(bent).uniform(-2e-13, 2e-13, (3, *points.shape))
    noise[:, [0, -1]] = 0
    sums = [
        sum_of_easings(places, CLOCK, STEP, TOLERANCE / 10, np.ones(40))
        for places in (points, *(points * (1 + noise)))
    ]
    first = sums[0]
    assert first is not None
    for other in sums[1:]:
        assert other is not None
        assert other.easings == first.easings


def test_sums_of_some_points_each_are_one_of_all_where_no_easing_comes_twice() -> None:
    clock = np.linspace(0, 1, 121)
    late = np.clip((clock - 0.25) / 0.5, 0, 1)
    ways = np.stack([3 * late, 5 * clock, 7 * late, 0 * clock], axis=1)
    points = np.stack([ways, -ways], axis=-1)
    parts = []
    corners = (0.25, 0.75)
    groups: list[tuple[list[int], tuple[float, ...]]]
    groups = [([0], corners), ([1], ()), ([2, 3], corners)]
    for own, turns in groups:
        one = sum_of_easings(points[:, own], clock, 0.01, 0.02, np.ones(len(own)), turns=turns)
        assert one is not None
        parts.append((np.array(own), one))
    whole = united(parts, 4)
    assert len(whole.easings) == 2
    np.testing.assert_allclose(whole.at(clock) * 0.01, points - points[0], atol=0.03)
