"""An animated SVG: the whole movement in one file that plays by itself.

Written in SMIL, which every browser plays even inside ``<img>``. Without it the file shows the
first frame: that is what each path holds at rest. A reader who asks for less motion is shown the
first frame too, as a twin of the drawing that stands still.
"""

import xml.etree.ElementTree as ET
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Literal

import numpy as np

from shapetween.model.drawing import Shape
from shapetween.model.movement import Movement
from shapetween.model.part import Part
from shapetween.svg.write.animate import animate_shown
from shapetween.svg.write.animate_groups import add_parts
from shapetween.svg.write.clock import Clock
from shapetween.svg.write.elements import LATER, GradientDefs, document, named, text_of
from shapetween.svg.write.gathered import gathered
from shapetween.svg.write.numbers import decimals_of
from shapetween.svg.write.parts import PartWriter
from shapetween.svg.write.triggers import add_triggers, trigger_of
from shapetween.svg.write.twins import (
    MOVING,
    REDUCED_MOTION,
    WAITING_RULE,
    add_twins,
    runs_of_moving,
)
from shapetween.timing import defaults
from shapetween.timing.keyframes import KEYFRAME_TOLERANCE, looser_keyframes
from shapetween.timing.schedule import Schedule
from shapetween.timing.timeline import Loop, Timeline

__all__ = ["smil_svg"]


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
    tell: Callable[[str], object] | None = None,
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
    tell : callable, optional
        Told what cannot be written as closely as all else.

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
    tolerance = KEYFRAME_TOLERANCE * max(first.box.width, first.box.height)
    paths: list[ET.Element] = []
    shown: Sequence[Shape] = ()
    writers = [PartWriter(replace(clock, leg=k), gradients, tolerance) for k in range(len(legs))]
    if clock.adaptive:
        legs = tuple(gathered(leg, writer) for leg, writer in zip(legs, writers, strict=True))
    ids = iter(named([part.name for leg in legs for part in leg.parts]))
    for leg, writer in zip(legs, writers, strict=True):
        group = moving if len(legs) == 1 else _add_leg(moving, writer.clock)
        before, after = (drawing.shapes for drawing in leg.at(np.array([0.0, 1.0])))
        shown = shown or before
        names = [next(ids) for _ in leg.parts]
        paths += _add_movement(group, leg, names, (before, after), writer)
    for run in runs_of_moving(root, drawn, gradients) if len(legs) == 1 else [moving]:
        add_twins(root, run, zip(paths, shown, strict=False), gradients)
        sheet.text = REDUCED_MOTION
    add_triggers(root, first.box, clock)
    sheet.text = (sheet.text or "") + gradients.style_sheet
    if root.find(".//*[@class='shapetween-later']") is not None:
        sheet.text += WAITING_RULE
    looser = max(writer.looser for writer in writers)
    if looser > 1 and tell is not None:
        tell(looser_keyframes(looser))
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
    writer: PartWriter,
) -> list[ET.Element]:
    """Write all parts of a leg; the first path of each."""
    firsts: list[ET.Element] = []

    def add(inside: ET.Element, part: Part, name: dict[str, str]) -> None:
        paths = writer.add(inside, part, name)
        if len(firsts) < len(leg.parts) and part is leg.parts[len(firsts)]:  # not one of a mask
            firsts.append(paths[0])

    defs, tolerance = writer.gradients, writer.tolerance
    add_parts(parent, leg.parts, names, ends, writer.slower, writer.times, defs, tolerance, add)
    return firsts


def _add_leg(parent: ET.Element, clock: Clock) -> ET.Element:
    """A group for the paths of one leg, which is shown in its turn.

    Each leg has paths of its own, for the number of its curves is its own. Without SMIL the first
    one is shown.
    """
    group = ET.SubElement(parent, "g", {**LATER, "display": "none"} if clock.leg > 0 else {})
    animate_shown(group, clock)
    return group


def _clock(timeline: Timeline, easing: str, keyframes: Literal["auto"] | int) -> Clock:
    """The clock the options ask for, of the first leg."""
    if keyframes == "auto":
        return Clock(Schedule.of(easing), True, timeline)
    return Clock(Schedule.of(easing, keyframes), False, timeline)
