"""When the legs of a chain are to be seen, and when they move."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from shapetween.timing.timeline import Iteration, Loop, Timeline

timelines = st.builds(
    Timeline,
    ways=st.lists(st.floats(0.01, 100), min_size=1, max_size=12).map(tuple),
    loop=st.sampled_from(["once", "repeat", "alternate"]),
    hold=st.just(0.0) | st.floats(0.001, 100),
    closed=st.booleans(),
)


def all_iterations(timeline: Timeline) -> list[tuple[int, Iteration]]:
    """Legs and their iterations, in the order in which they are to be seen."""
    found = [(leg, p) for leg in range(len(timeline.ways)) for p in timeline.iterations(leg)]
    return sorted(found, key=lambda both: both[1].shown)


@given(timelines)
def test_one_passage_after_another_without_a_gap(timeline: Timeline) -> None:
    iterations = [iteration for _, iteration in all_iterations(timeline)]
    assert iterations[0].shown == 0
    assert iterations[-1].until == timeline.seconds
    for before, after in pairwise(iterations):
        assert before.until == after.shown
    for p in iterations:
        assert p.shown <= p.start < p.end <= p.until


@given(timelines)
def test_every_way_takes_its_seconds_and_every_drawing_its_rest(timeline: Timeline) -> None:
    iterations = all_iterations(timeline)
    near = pytest.approx
    for leg, p in iterations:
        assert p.end - p.start == near(timeline.ways[leg])
        assert p.start - p.shown == near(timeline.hold, abs=1e-9)
    after_the_last = timeline.seconds - iterations[-1][1].end
    rests_there = timeline.loop == "repeat" and not timeline.closed
    assert after_the_last == near(timeline.hold if rests_there else 0, abs=1e-9)


@given(timelines)
def test_there_and_back(timeline: Timeline) -> None:
    order = [(leg, p.back) for leg, p in all_iterations(timeline)]
    there = [(leg, False) for leg in range(len(timeline.ways))]
    back = [(leg, True) for leg in reversed(range(len(timeline.ways)))]
    assert order == (there + back if timeline.loop == "alternate" else there)


@pytest.mark.parametrize(
    ("loop", "closed", "seconds"),
    [("once", False, 7.5), ("repeat", False, 8.0), ("repeat", True, 7.5), ("alternate", False, 15)],
)
def test_the_length_of_the_whole(loop: Loop, closed: bool, seconds: float) -> None:
    assert Timeline((2.0,) * 3, loop, 0.5, closed).seconds == seconds


def test_moments_of_a_passage_come_in_order() -> None:
    clock = np.array([0.0, 0.25, 1.0])
    there, back = Timeline((1.0,), "alternate").iterations(0)
    np.testing.assert_allclose(there.at(clock), [0, 0.25, 1.0])
    np.testing.assert_allclose(back.at(clock), [1.0, 1.75, 2.0])


@given(timelines, st.floats(0, 1))
def test_what_a_moment_shows_is_in_the_passage_of_that_moment(
    timeline: Timeline, share: float
) -> None:
    now = share * timeline.seconds
    leg, clock = timeline.shown(now)
    shown = [p for p in timeline.iterations(leg) if p.shown - 1e-9 <= now <= p.until + 1e-9]
    assert shown, "the leg is not to be seen then"
    clocks = [np.clip((now - p.start) / (p.end - p.start), 0, 1) for p in shown]
    assert any(
        abs((1 - c if p.back else c) - clock) < 1e-6 for p, c in zip(shown, clocks, strict=True)
    )


def test_whole_numbers_of_frames_meet_every_end_exactly() -> None:
    plan = Timeline((59.0,) * 3, "alternate", 3.0)
    shown = [plan.shown(float(k)) for k in range(round(plan.seconds))]
    assert {clock for _, clock in shown if clock in (0, 1)} == {0, 1}
    assert shown[3 + 59] == (1, 0.0)
    assert sum(clock in (0, 1) for _, clock in shown) == 6 * 4
