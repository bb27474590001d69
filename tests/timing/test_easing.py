"""Easing, even frames and keyframes."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from shapetween.base.arrays import Floats
from shapetween.base.errors import OptionError
from shapetween.timing import windows
from shapetween.timing.easing import (
    EASINGS,
    bezier_share,
    easing_function,
    even_times,
    handles_of,
    is_plain,
    overshoots,
)
from shapetween.timing.keyframes import keyframes
from shapetween.timing.schedule import Schedule

unit = st.floats(0, 1)


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        # At 1/4, 1/2 and 3/4, as Chromium computes them.
        ("linear", (0.25, 0.5, 0.75)),
        ("ease", (0.40851, 0.80240, 0.96046)),
        ("ease-in", (0.09346, 0.31536, 0.62186)),
        ("ease-out", (0.37814, 0.68464, 0.90654)),
        ("ease-in-out", (0.12916, 0.5, 0.87084)),
        ("cubic-bezier(0,0,1,1)", (0.25, 0.5, 0.75)),
        (" Cubic-Bezier( .42, 0, 1, 1 ) ", (0.09346, 0.31536, 0.62186)),
    ],
)
def test_easings_are_those_of_css(name: str, expected: tuple[float, float, float]) -> None:
    eased = easing_function(name)(np.array([0.25, 0.5, 0.75]))
    np.testing.assert_allclose(eased, expected, atol=1e-5)


@given(unit, unit, unit, unit)
def test_every_easing_rises_from_0_to_1(x1: float, y1: float, x2: float, y2: float) -> None:
    ease = easing_function(f"cubic-bezier({x1!r},{y1!r},{x2!r},{y2!r})")
    eased = ease(np.linspace(0, 1, 41))
    assert eased[0] == 0
    assert eased[-1] == 1
    assert ((eased >= 0) & (eased <= 1)).all()
    if y1 <= y2:
        assert (np.diff(eased) >= -1e-12).all()


@given(st.sampled_from(sorted(EASINGS)), unit)
def test_easings_solve_their_bezier(name: str, s: float) -> None:
    x1, y1, x2, y2 = EASINGS[name]
    points = np.array([[0, 0], [x1, y1], [x2, y2], [1, 1]])
    while len(points) > 1:  # de Casteljau
        points = (1 - s) * points[:-1] + s * points[1:]
    x, y = points[0]
    np.testing.assert_allclose(easing_function(name)(np.array([x])), [y], atol=1e-12)


@pytest.mark.parametrize(
    "name",
    [
        "",
        "easy",
        "cubic-bezier(0,0,1)",
        "cubic-bezier(0,0,2,1)",
        "linear()",
        "linear(0)",
        "linear(0, 1 2)",
        "linear(a, 1)",
        "spring(1,2)",
        "spring(1,2,x)",
        "cubic-bezier(nan,0,1,1)",
        "0,0,1,1",
    ],
)
def test_unknown_easings_are_refused(name: str) -> None:
    with pytest.raises(OptionError, match="expected linear, ease"):
        easing_function(name)


@pytest.mark.parametrize(
    ("name", "says"),
    [
        ("cubic-bezier(.3,9,.6,1)", "runs to"),
        ("cubic-bezier(.3,-9,.6,1)", "runs to"),
        ("linear(0, 3, 1)", "runs to"),
        ("linear(.5, 1)", "run from 0 to 1"),
        ("linear(0 10%, 1)", "run from 0 to 1"),
        ("spring(0,1,1)", "numbers above 0"),
        ("spring(1,100,.1)", "never rests; expected from 1 to 400"),
        ("spring(1,100,9999)", "never rests"),
    ],
)
def test_easings_that_cannot_be_shown_are_refused(name: str, says: str) -> None:
    with pytest.raises(OptionError, match=says):
        easing_function(name)


@pytest.mark.parametrize("damping", [1.5, 10.0, 19.999, 20.0, 20.001, 60.0])
def test_springs_obey_their_equation(damping: float) -> None:
    """On any clock: m x'' + c x' + k (x - 1) = 0 is solved by one length of the way."""
    u = np.linspace(0, 1, 20_001)
    x = easing_function(f"spring(1,100,{damping})")(u)
    assert (x[0], x[-1]) == (0, 1)
    step = u[1]
    speed, pull = np.gradient(x, step), np.gradient(np.gradient(x, step), step)
    inner = slice(50, -50)
    # With time = length * u: x'' / length^2 + damping x' / length = 100 (1 - x).
    terms = np.stack([pull, damping * speed, 100 * (1 - x)], axis=1)[inner]
    lengths = np.linspace(0.1, 12, 6000)
    off = [abs(terms @ (1 / n**2, 1 / n, -1)).max() for n in lengths]
    assert min(off) < 1.0
    assert (x.max() > 1.001) == (damping < 15)


def test_css_linear() -> None:
    ease = easing_function("linear(0, 1 20% 40%, .5, 1)")
    np.testing.assert_allclose(
        ease(np.array([0, 0.1, 0.2, 0.3, 0.4, 0.55, 0.7, 0.85, 1])),
        [0, 0.5, 1, 1, 1, 0.75, 0.5, 0.75, 1],
    )


def test_overshoot_as_css_has_it() -> None:
    """Values of CSS's own ``cubic-bezier(.34,1.56,.64,1)``, by its definition."""
    s = np.linspace(0, 1, 11)
    x = 3 * (1 - s) ** 2 * s * 0.34 + 3 * (1 - s) * s**2 * 0.64 + s**3
    y = 3 * (1 - s) ** 2 * s * 1.56 + 3 * (1 - s) * s**2 * 1 + s**3
    np.testing.assert_allclose(easing_function("cubic-bezier(.34,1.56,.64,1)")(x), y, atol=1e-9)
    assert overshoots("cubic-bezier(.34,1.56,.64,1)")
    assert not is_plain("cubic-bezier(.34,1.56,.64,1)")
    assert is_plain("ease")
    assert not overshoots("linear(0, .5, 1)")


def test_even_times() -> None:
    np.testing.assert_array_equal(even_times(5), [0, 0.25, 0.5, 0.75, 1])
    np.testing.assert_array_equal(even_times(1), [0])
    assert even_times(50)[-1] == 1
    with pytest.raises(OptionError, match="0 frames"):
        even_times(0)


def wave(u: np.ndarray, speed: float, bend: float) -> np.ndarray:
    """A turning point, a straight one, and one that turns back at a corner, (S, 3, 2)."""
    turning = np.stack([np.cos(speed * u), np.sin(speed * u)], -1)
    straight = np.stack([u, 2 * u], -1)
    corner = np.stack([np.abs(u - 0.5) * bend, u], -1)
    return np.stack([turning, straight, corner], axis=1)


@given(st.floats(0, 12), st.floats(0, 3), st.sampled_from([1e-1, 1e-2, 1e-3]))
def test_lines_between_keyframes_stay_near(speed: float, bend: float, tolerance: float) -> None:
    u = Schedule.of("linear").clock
    samples = wave(u, speed, bend)
    picks = keyframes(samples, u, tolerance)
    assert picks[0] == 0
    assert picks[-1] == len(u) - 1
    assert (np.diff(picks) > 0).all()
    fine = np.linspace(0, 1, 1999)
    exact = wave(fine, speed, bend).reshape(len(fine), -1)
    flat = samples.reshape(len(u), -1)
    shown = np.stack(
        [np.interp(fine, u[picks], flat[picks, k]) for k in range(flat.shape[1])], axis=-1
    )
    away = np.linalg.norm((shown - exact).reshape(len(fine), 3, 2), axis=-1).max()
    # Between two samples nobody looked: there a turn may go on by its own sagitta.
    assert away <= tolerance + 1.01 * speed**2 / (8 * 120**2)


@given(st.floats(1, 12), st.sampled_from([1e-1, 1e-2]))
def test_no_keyframe_is_wasted(speed: float, tolerance: float) -> None:
    u = Schedule.of("linear").clock
    samples = wave(u, speed, 0)
    picks = keyframes(samples, u, tolerance)
    for start, end in pairwise(picks[:-1].tolist()):
        # One sample farther, and a point in between is too far from the line.
        share = np.linspace(0, 1, end + 2 - start)[:, None, None]
        line = (1 - share) * samples[start] + share * samples[end + 1]
        assert np.linalg.norm(samples[start : end + 2] - line, axis=-1).max() > tolerance


def test_stillness_and_straight_lines_need_only_their_ends() -> None:
    u = Schedule.of("linear").clock
    still = np.ones((len(u), 5, 2))
    line = still * u[:, None, None]
    assert keyframes(still, u, 1e-9).tolist() == [0, len(u) - 1]
    assert keyframes(line, u, 1e-9).tolist() == [0, len(u) - 1]
    assert keyframes(still[:1], u[:1], 1e-9).tolist() == [0]


@pytest.mark.parametrize("name", [*EASINGS, "cubic-bezier(1,0,0,1)", "cubic-bezier(0,1,0,1)"])
def test_samples_lie_on_the_easing_without_gaps(name: str) -> None:
    schedule = Schedule.of(name)
    u, t = schedule.clock, schedule.time
    assert (u[0], t[0], u[-1], t[-1]) == (0, 0, 1, 1)
    assert (np.diff(u) >= 0).all()
    assert max(np.diff(u).max(), np.diff(t).max()) < 0.026
    # Where the clock stands the easing has no one value; there the curve itself is the answer.
    moving = np.gradient(u) > 1e-4
    np.testing.assert_allclose(easing_function(name)(u)[moving], t[moving], atol=1e-6)


@given(unit, unit, unit, unit)
def test_parts_of_an_easing_are_easings_that_make_the_whole(
    x1: float, y1: float, x2: float, y2: float
) -> None:
    assume((x1, x2) != (y1, y2))  # which is linear, however it is written
    schedule = Schedule.of(f"cubic-bezier({x1!r},{y1!r},{x2!r},{y2!r})")
    picks = np.unique([0, 30, 70, 120, *schedule.stops])
    for handles, (a, b) in zip(schedule.parts(picks), pairwise(picks.tolist()), strict=True):
        s = np.linspace(0, 1, 21)[:, None]
        corners = np.concatenate([[0, 0], handles, [1, 1]]).reshape(4, 2)
        low = np.array([schedule.clock[a], schedule.time[a]])
        high = np.array([schedule.clock[b], schedule.time[b]])
        part = low + bernstein(s) @ corners * (high - low)
        whole = np.array([[0, 0], [x1, y1], [x2, y2], [1, 1]])
        np.testing.assert_allclose(part, bernstein((a + s * (b - a)) / 120) @ whole, atol=2e-3)


def bernstein(s: Floats) -> Floats:
    return np.concatenate([(1 - s) ** 3, 3 * s * (1 - s) ** 2, 3 * s**2 * (1 - s), s**3], axis=1)


@pytest.mark.parametrize("name", [*EASINGS, "cubic-bezier(0,1,1,0)", "cubic-bezier(1,0,1,0)"])
def test_an_easing_is_solved_as_by_halving_in_a_third_of_the_steps(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    x1, y1, x2, y2 = handles_of(name)
    clock = np.concatenate([np.linspace(-0.1, 1.1, 301), 10.0 ** -np.arange(1, 17)])
    times = np.clip(clock, 0.0, 1.0)
    solve = windows._halved
    wanted = bezier_share(solve(x1, x2, times, windows.EXACTLY), y1, y2)
    wanted = np.where(times <= 0, 0.0, np.where(times >= 1, 1.0, wanted))
    steps: list[int] = []

    def counted(
        a: float, b: float, times: Floats, halvings: int, start: float = 0.0, size: float = 1.0
    ) -> Floats:
        steps.append(len(times) * halvings)
        return solve(a, b, times, halvings, start, size)

    monkeypatch.setattr(windows, "_halved", counted)
    found = windows.exact_shares((x1, y1, x2, y2), clock)
    np.testing.assert_array_equal(found, wanted)
    assert sum(steps) < len(clock) * windows.EXACTLY / 3
