"""When an attribute has which value: the timing attributes of SMIL's animation elements.

What is played once sets off when its turn comes and stays where it arrives, so that nothing need be
said of the time before and after. What is played for ever has the whole in every element, rests and
the way back included, for only then does all of it stay in step.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from shapetween.base.arrays import Floats, Index
from shapetween.svg.write.numbers import number
from shapetween.timing.easing import LINEAR
from shapetween.timing.fitted import fitted_keyframes
from shapetween.timing.keyframes import keyframes
from shapetween.timing.schedule import Schedule
from shapetween.timing.timeline import Iteration, Timeline
from shapetween.timing.windows import Eased

__all__ = ["Clock", "Trigger"]

#: Decimals of a keyframe's time, a share of one way: finer than a frame of any screen.
TIME_DECIMALS = 5

#: Decimals of an easing's handles, shares of the time between two keyframes.
SPLINE_DECIMALS = 4

#: Decimals of seconds.
SECOND_DECIMALS = 3

#: Keyframes that are counted: with so many any sum of easings takes fewer bytes.
MOST_COUNTED = 64

#: Handles of one straight interval.
_STRAIGHT = np.array([LINEAR])


@dataclass(frozen=True, slots=True)
class Trigger:
    """Events that set the whole going, and back again, or end what is played for ever."""

    there: str
    back: str


@dataclass(frozen=True, slots=True, eq=False)
class Clock:
    """When the samples of a movement are shown.

    Attributes
    ----------
    schedule : Schedule
        For one way, from the start to the end.
    adaptive : bool
        Whether keyframes are chosen among the samples; else every sample is one.
    timeline : Timeline
        The plan of the whole.
    leg : int
        Which of its movements this is.
    trigger : Trigger, optional
        What sets it going, if not the start of the document.
    """

    schedule: Schedule
    adaptive: bool
    timeline: Timeline
    leg: int = 0
    trigger: Trigger | None = None

    def keyframes_needed(self, samples: Floats, tolerance: float) -> int:
        """How many keyframes on the way the samples (S, K, D) need, as far as they are counted."""
        return len(keyframes(samples, self.schedule.time, tolerance, MOST_COUNTED))

    def pick(self, samples: Floats, tolerance: float) -> Index:
        """Which of the samples (S, K, D) become keyframes."""
        if not self.adaptive:
            return np.arange(len(samples))
        time = self.schedule.time
        parts = pairwise([0, *self.schedule.stops, len(time) - 1])
        picks = [
            start + keyframes(samples[start : end + 1], time[start : end + 1], tolerance)
            for start, end in parts
        ]
        return np.unique(np.concatenate(picks))

    def fitted(self, samples: Floats, tolerance: float) -> tuple[Floats, Floats, Floats | None]:
        """Keyframes for the samples (S, K, D), and where those are that are not on the way.

        Returns
        -------
        (M,) float64
            When each is shown, a share of the way.
        (M, K, D) float64
            What is shown.
        (M - 1, 4) float64 or None
            The easing between each two, None where all are even.
        """
        if self.adaptive and self.schedule.handles == LINEAR:
            return (*fitted_keyframes(samples, self.schedule.time, tolerance), None)
        picks = self.pick(samples, tolerance)
        return self.schedule.clock[picks], samples[picks], self._eased(picks)

    def straight(self, picks: Index, values: Sequence[str]) -> list[dict[str, str]]:
        """Attributes that show each value at its sample, way back included, and blend between.

        One set of them for each animation that is needed: one, or one for either way.
        """
        return self.running(self.schedule.clock[picks], values, self._eased(picks))

    def _eased(self, picks: Index) -> Floats | None:
        """The easing between samples, (M - 1, 4), None where it is even."""
        return None if self.schedule.handles == LINEAR else self.schedule.parts(picks)

    def eased(self, easing: Eased, rest: str, value: str) -> list[dict[str, str]]:
        """Attributes that run from one value to another along an easing of their own.

        Over a window of the way: what is played once sets off and arrives with it.
        """
        start, end = easing.window
        if self.timeline.loop == "once" and self.trigger is None:
            (iteration,) = self._iterations
            begin = iteration.start + start * (iteration.end - iteration.start)
            stop = iteration.start + end * (iteration.end - iteration.start)
            (way,) = self._ways
            inside = replace(way, iterations=(replace(iteration, start=begin, end=stop),))
            handles = np.array([easing.handles])
            return [self._once(inside, np.array([0.0, 1.0]), (rest, value), handles)]
        moments = [0.0, start, end, 1.0]
        values, rows = [rest, rest, value, value], [LINEAR, easing.handles, LINEAR]
        if end == 1:
            del moments[3], values[3], rows[2]
        if start == 0:
            del moments[0], values[0], rows[0]
        return self.running(np.array(moments), values, np.array(rows))

    @property
    def is_one_way(self) -> bool:
        """Whether the whole is one way through this leg, and no rest is said."""
        if self.timeline.loop == "once":
            return self.trigger is None
        (first, *others) = self._iterations
        return not others and (first.start, first.end) == (0.0, self.timeline.seconds)

    def jumping(self, jumps: Floats, values: Sequence[str]) -> list[dict[str, str]]:
        """Attributes that show the first value, and from each of some times on the next.

        A single jump that is played once needs no more than what comes then.
        """
        if self.timeline.loop == "once" and self.trigger is None and len(jumps) == 1:
            (iteration,) = self._iterations
            begin = _seconds(float(iteration.at(jumps)[0]))
            return [{"to": values[1], "begin": begin, "fill": "freeze"}]
        found = []
        for way in self._ways:
            times, shown = [way.since], [values[-1] if way.iterations[0].back else values[0]]
            for iteration in way.iterations:
                times += iteration.at(jumps).tolist()
                shown += values[-2::-1] if iteration.back else values[1:]
            found.append({"calcMode": "discrete", **self._whole(way, times, shown)})
        return found

    def showing(self, on: str, off: str) -> list[dict[str, str]]:
        """Attributes that have one value while the leg is to be seen, and else another."""
        found = []
        for way in self._ways:
            edges = [edge for p in way.iterations for edge in (p.shown, p.until)]
            # Where one iteration follows another, and at both ends of the whole, nothing changes.
            end = way.since + way.length
            times = [edge for edge in edges if edges.count(edge) == 1 and way.since < edge < end]
            values = (off, on) if edges[0] > way.since else (on, off)
            shown = [values[k % 2] for k in range(len(times) + 1)]
            timing = self._whole(way, [way.since, *times], shown)
            found.append({"calcMode": "discrete", **timing})
        return found

    @property
    def _iterations(self) -> tuple[Iteration, ...]:
        return self.timeline.iterations(self.leg)

    @property
    def _ways(self) -> "list[_Way]":
        """What is set going by itself: the whole, or what is played once there, and then back."""
        if self.trigger is None or self.timeline.loop != "once":
            begin = "" if self.trigger is None else self.trigger.there
            return [_Way(begin, 0.0, self.timeline.seconds, self._iterations)]
        both = replace(self.timeline, loop="alternate")
        there, back = both.iterations(self.leg)
        half = both.seconds / 2
        return [
            _Way(self.trigger.there, 0.0, half, (there,)),
            _Way(self.trigger.back, half, half, (back,)),
        ]

    def running(
        self, clock: Floats, values: Sequence[str], easing: Floats | None
    ) -> list[dict[str, str]]:
        """Attributes that show values (M,) at moments (M,) of the way, eased (M - 1, 4) between."""
        step = np.repeat(_STRAIGHT, len(clock) - 1, axis=0) if easing is None else easing
        if self.timeline.loop == "once":
            return [self._once(way, clock, values, step) for way in self._ways]
        (whole,) = self._ways
        times, shown, splines = [0.0], [values[0]], [np.zeros((0, 4))]

        def rest(until: float) -> None:
            if until > times[-1]:
                times.append(until)
                shown.append(shown[-1])
                splines.append(_STRAIGHT)

        for iteration in whole.iterations:
            rest(iteration.start)
            times += iteration.at(clock)[1:].tolist()
            shown += values[-2::-1] if iteration.back else values[1:]
            splines.append(_backwards(step) if iteration.back else step)
        rest(whole.length)
        return [{**_easing(np.concatenate(splines)), **self._whole(whole, times, shown)}]

    def _once(
        self, way: "_Way", clock: Floats, values: Sequence[str], easing: Floats
    ) -> dict[str, str]:
        """Attributes of what sets off in its turn, and stays where it arrives."""
        (iteration,) = way.iterations
        begin = _begin(way.begin, iteration.start - way.since)
        if iteration.back:
            clock, values, easing = 1 - clock[::-1], values[::-1], _backwards(easing)
        eased = _easing(easing)
        kept = {} if len(clock) == 2 and not eased else {"keyTimes": self._times(clock)}
        return {
            **eased,
            **({"begin": begin} if begin else {}),
            "dur": _seconds(iteration.end - iteration.start),
            "fill": "freeze",
            **kept,
            "values": ";".join(values),
        }

    def _whole(
        self, way: "_Way", seconds: Sequence[float], values: Sequence[str]
    ) -> dict[str, str]:
        """Attributes that show values at some seconds of the whole."""
        for_ever = {"repeatCount": "indefinite"}
        if self.trigger is not None:
            for_ever["end"] = self.trigger.back
        return {
            **({"begin": way.begin} if way.begin else {}),
            "dur": _seconds(way.length),
            **({"fill": "freeze"} if self.timeline.loop == "once" else for_ever),
            "keyTimes": self._times((np.array(seconds) - way.since) / way.length, way.length),
            "values": ";".join(values),
        }

    def _times(self, shares: Floats, whole: float | None = None) -> str:
        """Shares of a time, as fine in seconds as if that were one way alone."""
        ratio = 1.0 if whole is None else whole / self.timeline.ways[self.leg]
        decimals = TIME_DECIMALS + len(str(int(ratio))) - 1
        return ";".join(number(share, decimals) for share in shares.tolist())


@dataclass(frozen=True, slots=True)
class _Way:
    """What one event, or the start of the document, sets going.

    Attributes
    ----------
    begin : str
        The event, empty for the start of the document.
    since, length : float
        The second of the timeline that it starts at, and how many it takes.
    iterations : tuple of Iteration
        Of the leg, meanwhile.
    """

    begin: str
    since: float
    length: float
    iterations: tuple[Iteration, ...]


def _backwards(easing: Floats) -> Floats:
    """Easings (M, 4) seen from the end: a curve starts there, and both axes run the other way."""
    return np.asarray(1 - easing[::-1, [2, 3, 0, 1]])


def _begin(event: str, offset: float) -> str:
    """When an animation sets off, some seconds after an event; empty if at once, without one."""
    if offset <= 0:
        return event
    return f"{event}+{_seconds(offset)}" if event else _seconds(offset)


def _easing(rows: Floats) -> dict[str, str]:
    """Attributes for the easing of every interval, (M, 4); blending evenly needs none."""
    if (rows == _STRAIGHT).all():
        return {}
    texts = [" ".join(number(v, SPLINE_DECIMALS) for v in row) for row in rows.tolist()]
    return {"calcMode": "spline", "keySplines": ";".join(texts)}


def _seconds(value: float) -> str:
    return f"{number(value, SECOND_DECIMALS)}s"
