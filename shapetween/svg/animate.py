"""Attributes that change with time, as SMIL ``<animate>`` elements.

A track is what an attribute is at every sample of the clock. It is written only if it changes,
and only at as many keyframes as it needs.
"""

import xml.etree.ElementTree as ET
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Literal, TypeAlias

import numpy as np

from shapetween.arrays import Floats, Index
from shapetween.frames import LINEAR, Schedule, keyframes
from shapetween.svg.numbers import number

__all__ = ["Clock", "Loop", "animate", "animate_choice", "animate_number", "animate_transform"]

Loop: TypeAlias = Literal["once", "repeat", "alternate"]

#: Decimals of a keyframe's time, a share of the whole: finer than a frame of any screen.
TIME_DECIMALS = 5

#: Decimals of an easing's handles, shares of the time between two keyframes.
SPLINE_DECIMALS = 4


@dataclass(frozen=True, slots=True, eq=False)
class Clock:
    """When an animation's samples are shown.

    Attributes
    ----------
    schedule : Schedule
        For one way, from the start to the end.
    adaptive : bool
        Whether keyframes are chosen among the samples; else every sample is one.
    duration : float
        Seconds one way takes.
    loop : {"once", "repeat", "alternate"}
        Stay at the end, start over, or go back and start over.
    """

    schedule: Schedule
    adaptive: bool
    duration: float
    loop: Loop

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
        times, splines = self.schedule.clock[picks], self.schedule.parts(picks)
        if self.loop == "alternate":
            times = np.concatenate([times / 2, 1 - times[-2::-1] / 2])
            # Backwards a curve starts at its end, and both axes run the other way.
            splines = np.concatenate([splines, 1 - splines[::-1, [2, 3, 0, 1]]])
            values = [*values, *values[-2::-1]]
        timing = self._timing(times, values)
        if self.schedule.handles == LINEAR:
            return {"calcMode": "linear", **timing}
        texts = [" ".join(number(v, SPLINE_DECIMALS) for v in row) for row in splines.tolist()]
        return {"calcMode": "spline", "keySplines": ";".join(texts), **timing}

    def jumping(self, jumps: Floats, values: Sequence[str]) -> dict[str, str]:
        """Attributes that show the first value, and from each of some times on the next."""
        times = np.concatenate([[0.0], jumps])
        if self.loop == "alternate":
            times = np.concatenate([times / 2, 1 - jumps[::-1] / 2])
            values = [*values, *values[-2::-1]]
        return {"calcMode": "discrete", **self._timing(times, values)}

    def _timing(self, times: Floats, values: Sequence[str]) -> dict[str, str]:
        ways = 2 if self.loop == "alternate" else 1
        return {
            "dur": f"{number(self.duration * ways, 3)}s",
            **({"fill": "freeze"} if self.loop == "once" else {"repeatCount": "indefinite"}),
            "keyTimes": ";".join(number(time, TIME_DECIMALS) for time in times.tolist()),
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
