"""Attributes that change with time, as SMIL ``<animate>`` elements.

A track is what an attribute is at every sample of the clock. It is written only if it changes,
and only at as many keyframes as it needs.
"""

import xml.etree.ElementTree as ET
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from shapetween.base.arrays import Floats, Index
from shapetween.svg.write.numbers import number
from shapetween.timing.easing import LINEAR
from shapetween.timing.keyframes import keyframes
from shapetween.timing.schedule import Schedule
from shapetween.timing.timeline import Passage, Timeline

__all__ = [
    "Clock",
    "animate",
    "animate_choice",
    "animate_number",
    "animate_shown",
    "animate_transform",
]

#: Decimals of a keyframe's time, a share of one way: finer than a frame of any screen.
TIME_DECIMALS = 5

#: Decimals of an easing's handles, shares of the time between two keyframes.
SPLINE_DECIMALS = 4


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
    """

    schedule: Schedule
    adaptive: bool
    timeline: Timeline
    leg: int = 0

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

    def straight(self, picks: Index, values: Sequence[str]) -> dict[str, str]:
        """Attributes that show each value at its sample, way back included, and blend between."""
        clock, easing = self.schedule.clock[picks], self.schedule.parts(picks)
        times, shown, splines = [0.0], [values[0]], [np.zeros((0, 4))]

        def rest(until: float) -> None:
            if until > times[-1]:
                times.append(until)
                shown.append(shown[-1])
                splines.append(np.array([LINEAR]))

        for passage in self._passages:
            rest(passage.start)
            times += passage.at(clock)[1:].tolist()
            shown += values[-2::-1] if passage.back else values[1:]
            # Backwards a curve starts at its end, and both axes run the other way.
            splines.append(1 - easing[::-1, [2, 3, 0, 1]] if passage.back else easing)
        rest(1.0)
        timing = self._timing(times, shown)
        if self.schedule.handles == LINEAR:
            return {"calcMode": "linear", **timing}
        rows = np.concatenate(splines).tolist()
        texts = [" ".join(number(v, SPLINE_DECIMALS) for v in row) for row in rows]
        return {"calcMode": "spline", "keySplines": ";".join(texts), **timing}

    def jumping(self, jumps: Floats, values: Sequence[str]) -> dict[str, str]:
        """Attributes that show the first value, and from each of some times on the next."""
        times, shown = [0.0], [values[0]]
        for passage in self._passages:
            times += passage.at(jumps).tolist()
            shown += values[-2::-1] if passage.back else values[1:]
        return {"calcMode": "discrete", **self._timing(times, shown)}

    def showing(self, on: str, off: str) -> dict[str, str]:
        """Attributes that have one value while the leg is to be seen, and else another."""
        edges = [edge for p in self._passages for edge in (p.shown, p.until)]
        # Where one passage follows on another, and at both ends of the whole, nothing changes.
        times = [edge for edge in edges if edges.count(edge) == 1 and 0 < edge < 1]
        values = (off, on) if edges[0] > 0 else (on, off)
        shown = [values[k % 2] for k in range(len(times) + 1)]
        return {"calcMode": "discrete", **self._timing([0.0, *times], shown)}

    @property
    def _passages(self) -> tuple[Passage, ...]:
        return self.timeline.passages(self.leg)

    def _timing(self, times: Sequence[float], values: Sequence[str]) -> dict[str, str]:
        whole = self.timeline.seconds
        # As fine, in seconds, as if there were one way alone.
        decimals = TIME_DECIMALS + len(str(int(whole / self.timeline.duration))) - 1
        once = self.timeline.loop == "once"
        return {
            "dur": f"{number(whole, 3)}s",
            **({"fill": "freeze"} if once else {"repeatCount": "indefinite"}),
            "keyTimes": ";".join(number(time, decimals) for time in times),
            "values": ";".join(values),
        }


def animate(
    element: ET.Element, attribute: str, clock: Clock, picks: Index, values: Sequence[str]
) -> None:
    """Let an attribute run through values, straight from each to the next.

    Parameters
    ----------
    element : Element
    attribute : str
    clock : Clock
    picks : (M,) intp
        Samples of the clock at which the values hold.
    values : sequence of str
        M of them; nothing is written if they are all the same.
    """
    if len(set(values)) > 1:
        timing = clock.straight(picks, values)
        ET.SubElement(element, "animate", {"attributeName": attribute, **timing})


def animate_transform(
    element: ET.Element,
    attribute: str,
    kind: str,
    clock: Clock,
    picks: Index,
    values: Sequence[str],
) -> None:
    """Let one step of a transform run through values, after the steps written before it.

    As `animate` does it; but it is always written, because a step replaces the attribute unless
    an earlier one has.
    """
    ET.SubElement(
        element,
        "animateTransform",
        {
            "attributeName": attribute,
            "type": kind,
            **({"additive": "sum"} if element.find("animateTransform") is not None else {}),
            **clock.straight(picks, values),
        },
    )


def animate_number(
    element: ET.Element,
    attribute: str,
    clock: Clock,
    track: Floats,
    tolerance: float,
    text: Callable[[float], str],
) -> None:
    """Let an attribute run through the numbers (S,), each written by `text`."""
    picks = clock.pick(track[:, None, None], tolerance)
    animate(element, attribute, clock, picks, [text(value) for value in track[picks].tolist()])


def animate_choice(element: ET.Element, attribute: str, clock: Clock, track: Sequence[str]) -> None:
    """Let an attribute jump through values that have nothing between them.

    `track` has one value for each sample, which holds until the next.
    """
    changes = [k for k in range(1, len(track)) if track[k] != track[k - 1]]
    if not changes:
        return
    timing = clock.jumping(clock.schedule.clock[changes], [track[k] for k in [0, *changes]])
    ET.SubElement(element, "animate", {"attributeName": attribute, **timing})


def animate_shown(element: ET.Element, clock: Clock) -> None:
    """Show an element while the leg of the clock is to be seen, and no longer."""
    timing = clock.showing("inline", "none")
    ET.SubElement(element, "animate", {"attributeName": "display", **timing})
