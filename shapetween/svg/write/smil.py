"""An animated SVG: the whole movement in one file that plays by itself.

Written in SMIL, which every browser plays even inside ``<img>``. Without it the file shows the
first frame: that is what each path holds at rest. A reader who asks for less motion is shown the
first frame too, as a twin of the drawing that stands still.
"""

import xml.etree.ElementTree as ET
from collections.abc import Sequence
from dataclasses import replace
from typing import Literal

import numpy as np

from shapetween.model.drawing import Shape
from shapetween.model.movement import Movement
from shapetween.model.part import Part
from shapetween.model.tracks import style_tracks
from shapetween.svg.write.animate import animate_shown
from shapetween.svg.write.animate_groups import add_parts
from shapetween.svg.write.animate_pattern import add_ends, fills_of, keep_pattern
from shapetween.svg.write.animate_style import animate_style
from shapetween.svg.write.clock import Clock
from shapetween.svg.write.elements import LATER, GradientDefs, document, named, text_of
from shapetween.svg.write.numbers import decimals_of
from shapetween.svg.write.shape import shape_motion
from shapetween.svg.write.triggers import add_triggers, trigger_of
from shapetween.svg.write.twins import (
    MOVING,
    REDUCED_MOTION,
    WAITING_RULE,
    add_twins,
    runs_of_moving,
)
from shapetween.timing import defaults
from shapetween.timing.keyframes import KEYFRAME_TOLERANCE
from shapetween.timing.schedule import Schedule
from shapetween.timing.timeline import Loop, Timeline

__all__ = ["add_part", "smil_svg"]

#: Paint is looked at on every fourth sample: it changes evenly, and slower than shapes.
PAINT_STRIDE = 4

#: A style's times are kept inside these, where it has all it needs on the way (a plain colour on
#: its way to a gradient is a gradient there) and differs from its ends by nothing to be seen.
INSIDE = (1e-6, 1 - 1e-6)


def smil_svg(
    *legs: Movement,
    duration: float | tuple[float, ...] = defaults.DURATION,
    easing: str = defaults.EASING,
    loop: Loop = "once",
    hold: float = 0.0,
    closed: bool = False,
    keyframes: Literal["auto"] | int = "auto",
    precision: int | None = None,
    start: str = "load",
) -> str:
    """Write a movement as an animated SVG, or several that follow each other.

    Parameters
    ----------
    *legs : Movement
        Each starts with the drawing that the one before ends with. All are shown in the box, and
        under the title, of the first.
    duration : float or tuple of float
        Seconds of each of them, or of one after the other.
    easing : str
        That of each; see `shapetween.timing.easing.easing_function`. The default shows at every
        moment what the frame of that time shows.
    loop : {"once", "repeat", "alternate"}
        Stay at the end, start over, or go back through all of them and start over.
    hold : float
        Seconds that each drawing stands still.
    closed : bool
        Whether the last drawing is the first, and starting over needs no rest at both.
    keyframes : "auto" or int
        By default as few as keep every point within a quarter of a pixel where the view box is
        1000 px large; or a number of them, even along the easing.
    precision : int, optional
        Decimals of coordinates; by default about 1/10000 of the larger side of the view
        box, or of what is drawn where that is smaller.

    start : {"load", "click", "hover"}
        What sets it going. Once, the next click, or leaving it, brings it back; for ever, ends it.

    Raises
    ------
    OptionError
        If an option cannot be used; the message says what could.
    """
    ways = duration if isinstance(duration, tuple) else (duration,) * len(legs)
    clock = _clock(Timeline(ways, loop, hold, closed), easing, keyframes)
    first = legs[0]
    ends = [drawing for leg in legs for drawing in leg.at(np.array([0.0, 1.0]))]
    decimals = max(decimals_of(drawing, precision) for drawing in ends)
    gradients = GradientDefs(decimals, box=first.box)

    clock = replace(clock, trigger=trigger_of(start, gradients))
    root = document(first.box, first.title, first.page)
    sheet = ET.SubElement(root, "style")
    root.append(gradients.element)
    drawn = len(root)
    moving = root if len(legs) == 1 else ET.SubElement(root, "g", MOVING)
    ids = iter(named([part.name for leg in legs for part in leg.parts]))
    paths: list[ET.Element] = []
    for k, leg in enumerate(legs):
        group = moving if len(legs) == 1 else _add_leg(moving, replace(clock, leg=k))
        names = [next(ids) for _ in leg.parts]
        both = ends[2 * k].shapes, ends[2 * k + 1].shapes
        paths += _add_movement(group, leg, names, both, replace(clock, leg=k), gradients)
    for run in runs_of_moving(root, drawn, gradients) if len(legs) == 1 else [moving]:
        add_twins(root, run, zip(paths, ends[0].shapes, strict=False), gradients)
        sheet.text = REDUCED_MOTION
    add_triggers(root, first.box, clock)
    sheet.text = (sheet.text or "") + gradients.style_sheet
    if root.find(".//*[@class='shapetween-later']") is not None:
        sheet.text += WAITING_RULE
    if not sheet.text:
        root.remove(sheet)
    if not len(gradients.element):
        root.remove(gradients.element)
    return text_of(root)


def _add_movement(
    parent: ET.Element,
    leg: Movement,
    names: Sequence[dict[str, str]],
    ends: tuple[Sequence[Shape], Sequence[Shape]],
    clock: Clock,
    gradients: GradientDefs,
) -> list[ET.Element]:
    """Write all parts of a leg; the first path of each."""
    slower = _slower(clock)
    tolerance = KEYFRAME_TOLERANCE * max(gradients.box.width, gradients.box.height)
    firsts: list[ET.Element] = []

    def add(inside: ET.Element, part: Part, name: dict[str, str]) -> None:
        paths = add_part(inside, part, clock, gradients, name, tolerance)
        if len(firsts) < len(leg.parts) and part is leg.parts[len(firsts)]:  # not one of a mask
            firsts.append(paths[0])

    times = np.clip(slower.schedule.time, *INSIDE)
    add_parts(parent, leg.parts, names, ends, slower, times, gradients, tolerance, add)
    return firsts


def _add_leg(parent: ET.Element, clock: Clock) -> ET.Element:
    """A group for the paths of one leg, which is shown in its turn.

    Each leg has paths of its own, for the number of its curves is its own. Without SMIL the first
    one is shown.
    """
    group = ET.SubElement(parent, "g", {**LATER, "display": "none"} if clock.leg > 0 else {})
    animate_shown(group, clock)
    return group


def _slower(clock: Clock) -> Clock:
    """The clock of paint."""
    strided = clock.schedule.strided(PAINT_STRIDE if clock.adaptive else 1)
    return replace(clock, schedule=strided)


def _clock(timeline: Timeline, easing: str, keyframes: Literal["auto"] | int) -> Clock:
    """The clock the options ask for, of the first leg."""
    if keyframes == "auto":
        return Clock(Schedule.of(easing), True, timeline)
    return Clock(Schedule.of(easing, keyframes), False, timeline)


def add_part(
    parent: ET.Element,
    part: Part,
    clock: Clock,
    gradients: GradientDefs,
    name: dict[str, str],
    tolerance: float,
) -> list[ET.Element]:
    """Write a part as an animated path, or as several that take turns where its kind of paint does.

    `tolerance` is how far points may be off between two keyframes.
    """
    motion = shape_motion(part, clock, gradients.decimals, tolerance)
    slower = _slower(clock)
    times = np.clip(slower.schedule.time, *INSIDE)
    styles = [part.style(t) for t in times.tolist()]
    add_ends(parent, part, styles, times, slower, gradients, motion)
    paths = []
    for track in style_tracks(fills_of(part, styles, times)):
        path = ET.SubElement(parent, "path", name if track.start == 0 else {})
        animate_style(path, track, slower, gradients, tolerance)
        keep_pattern(path, track.styles, slower, gradients, tolerance)
        path.set("d", motion.rest)
        for attributes in motion.animations:
            ET.SubElement(path, "set" if "to" in attributes else "animate", attributes)
        paths.append(path)
    return paths
