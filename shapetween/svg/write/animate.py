"""Attributes that change with time, as SMIL ``<animate>`` elements.

A track is what an attribute is at every sample of the clock. It is written only if it changes,
and only at as many keyframes as it needs.
"""

import xml.etree.ElementTree as ET
from collections.abc import Callable, Mapping, Sequence

import numpy as np

from shapetween.base.arrays import Floats, Index
from shapetween.svg.write.clock import Clock

__all__ = [
    "add_animation",
    "animate",
    "animate_choice",
    "animate_number",
    "animate_seen",
    "animate_shown",
    "animate_transform",
]


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
        _add(element, attribute, clock.straight(picks, values))


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
    added = {"additive": "sum"} if element.find("animateTransform") is not None else {}
    for timing in clock.straight(picks, values):
        attributes = {"attributeName": attribute, "type": kind, **added, **timing}
        ET.SubElement(element, "animateTransform", attributes)


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
    jumps, values = clock.schedule.clock[changes], [track[k] for k in [0, *changes]]
    _add(element, attribute, clock.jumping(jumps, values))


def animate_seen(
    element: ET.Element, clock: Clock, seen: tuple[float, float], opacity: str
) -> None:
    """Let an element have its opacity between two times of the movement, and none outside."""
    inside = [(time, text) for time, text in zip(seen, (opacity, "0"), strict=True) if 0 < time < 1]
    values = ["0" if seen[0] > 0 else opacity, *(text for _, text in inside)]
    if values[0] != "1":
        element.set("opacity", values[0])
    schedule, _ = clock.schedule.finer()
    jumps = np.interp([time for time, _ in inside], schedule.time, schedule.clock)
    _add(element, "opacity", clock.jumping(jumps, values))


def animate_shown(element: ET.Element, clock: Clock) -> None:
    """Show an element while the leg of the clock is to be seen, and no longer."""
    _add(element, "display", clock.showing("inline", "none"))


def add_animation(element: ET.Element, attributes: Mapping[str, str]) -> None:
    """Add one animation, as a ``<set>`` if it comes at once: if it has a ``to``."""
    ET.SubElement(element, "set" if "to" in attributes else "animate", dict(attributes))


def _add(element: ET.Element, attribute: str, timings: Sequence[dict[str, str]]) -> None:
    for timing in timings:
        add_animation(element, {"attributeName": attribute, **timing})
