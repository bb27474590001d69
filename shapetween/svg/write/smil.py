"""An animated SVG: the whole movement in one file that plays by itself.

Written in SMIL, which every browser plays even inside ``<img>``. Without it the file shows the
first frame: that is what each path holds at rest. A reader who asks for less motion is shown the
first frame too, as a twin of the drawing that stands still.
"""

import xml.etree.ElementTree as ET
from dataclasses import replace
from functools import partial
from typing import Literal

import numpy as np

from shapetween.model.drawing import Shape
from shapetween.model.movement import Movement, Part
from shapetween.model.tracks import style_tracks
from shapetween.svg.write.animate import Clock, animate, animate_shown
from shapetween.svg.write.animate_groups import add_parts
from shapetween.svg.write.animate_style import animate_style
from shapetween.svg.write.elements import GradientDefs, document, named, text_of
from shapetween.svg.write.groups import add_shapes
from shapetween.svg.write.numbers import decimals_of, path_data
from shapetween.timing import defaults
from shapetween.timing.keyframes import KEYFRAME_TOLERANCE
from shapetween.timing.schedule import Schedule
from shapetween.timing.timeline import Loop, Timeline

__all__ = ["add_part", "smil_svg"]

#: Shows the twin instead of the movement. The class names are ours alone, because a page that holds
#: the drawing shares its style sheet; and without any style sheet the twin stays hidden.
REDUCED_MOTION = (
    "@media (prefers-reduced-motion:reduce){"
    ".shapetween-moving{display:none}.shapetween-still{display:inline}}"
)


#: Paint is looked at on every fourth sample: it changes evenly, and slower than shapes.
PAINT_STRIDE = 4

#: Curves of all keyframes of a path that are written, about 30 bytes each, before keyframes become
#: fewer by ever looser tolerances; but so many keyframes there are. More and browsers stall on it.
MOST_WRITTEN, LEAST_KEYFRAMES, LOOSER = 300_000, 9, 1.5

#: Curves of all samples that are held at once, and the strides of samples that may be left out for
#: it: parts of the steps on which keyframes may lie.
MOST_SAMPLED, STRIDES = 1_500_000, (2, 3, 4, 5, 6)

#: A style's times are kept inside these, where it has all it needs on the way (a plain colour on
#: its way to a gradient is a gradient there) and differs from its ends by nothing to be seen.
INSIDE = (1e-6, 1 - 1e-6)


def smil_svg(
    *legs: Movement,
    duration: float = defaults.DURATION,
    easing: str = defaults.EASING,
    loop: Loop = "once",
    hold: float = 0.0,
    closed: bool = False,
    keyframes: Literal["auto"] | int = "auto",
    precision: int | None = None,
) -> str:
    """Write a movement as an animated SVG, or several that follow each other.

    Parameters
    ----------
    *legs : Movement
        Each starts with the drawing that the one before ends with. All are shown in the box, and
        under the title, of the first.
    duration : float
        Seconds of each of them.
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

    Raises
    ------
    OptionError
        If an option cannot be used; the message says what could.
    """
    clock = _clock(Timeline(duration, loop, hold, len(legs), closed), easing, keyframes)
    first = legs[0]
    tolerance = KEYFRAME_TOLERANCE * max(first.box.width, first.box.height)
    ends = [drawing for leg in legs for drawing in leg.at(np.array([0.0, 1.0]))]
    decimals = max(decimals_of(drawing, precision) for drawing in ends)
    gradients = GradientDefs(decimals, box=first.box)

    root = document(first.box, first.title)
    sheet = ET.SubElement(root, "style")
    root.append(gradients.element)
    moving = ET.SubElement(root, "g", {"class": "shapetween-moving"})
    still = ET.SubElement(root, "g", {"class": "shapetween-still", "display": "none"})
    ids = iter(named([part.name for leg in legs for part in leg.parts]))
    for k, leg in enumerate(legs):
        own = replace(clock, leg=k)
        group = moving if len(legs) == 1 else _add_leg(moving, own)
        names = [next(ids) for _ in leg.parts]
        slower = _slower(own)
        add_parts(
            group,
            leg.parts,
            names,
            (ends[2 * k].shapes, ends[2 * k + 1].shapes),
            slower,
            np.clip(slower.schedule.time, *INSIDE),
            gradients,
            tolerance,
            partial(_add_named, clock=own, gradients=gradients, tolerance=tolerance),
        )
    at_rest = [Shape(shape.rings, shape.style) for shape in ends[0].shapes]
    add_shapes(still, at_rest, gradients)
    sheet.text = REDUCED_MOTION + gradients.style_sheet
    if not len(gradients.element):
        root.remove(gradients.element)
    return text_of(root)


def _add_leg(parent: ET.Element, clock: Clock) -> ET.Element:
    """A group for the paths of one leg, which is shown in its turn.

    Each leg has paths of its own, for the number of its curves is its own. Without SMIL the first
    one is shown.
    """
    group = ET.SubElement(parent, "g", {"display": "none"} if clock.leg > 0 else {})
    animate_shown(group, clock)
    return group


def _add_named(
    parent: ET.Element,
    part: Part,
    name: dict[str, str],
    *,
    clock: Clock,
    gradients: GradientDefs,
    tolerance: float,
) -> None:
    add_part(parent, part, clock, gradients, name, tolerance)


def _slower(clock: Clock) -> Clock:
    """The clock of paint."""
    thinned = clock.schedule.thinned(PAINT_STRIDE if clock.adaptive else 1)
    return replace(clock, schedule=thinned)


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
) -> None:
    """Write a part as an animated path, or as several that take turns where its kind of paint does.

    `tolerance` is how far points may be off between two keyframes.
    """
    count = sum(part.rings)
    shape_clock = _for_so_many(clock, count)
    stack = part.curves(shape_clock.schedule.time)
    picks = shape_clock.pick(stack.reshape(len(stack), -1, 2), tolerance)
    while clock.adaptive and len(picks) > max(LEAST_KEYFRAMES, MOST_WRITTEN // max(count, 1)):
        tolerance *= LOOSER
        picks = shape_clock.pick(stack.reshape(len(stack), -1, 2), tolerance)
    values = path_data(stack[picks], part.rings, part.closed, gradients.decimals)
    slower = _slower(clock)
    styles = [part.style(t) for t in np.clip(slower.schedule.time, *INSIDE).tolist()]
    for track in style_tracks(styles):
        path = ET.SubElement(parent, "path", name if track.start == 0 else {})
        animate_style(path, track, slower, gradients, tolerance)
        path.set("d", values[0])
        animate(path, "d", shape_clock, picks, values)


def _for_so_many(clock: Clock, count: int) -> Clock:
    """The clock with fewer samples, where so many curves at all of them would not fit in memory."""
    steps = len(clock.schedule.time) - 1
    if not clock.adaptive or steps * count <= MOST_SAMPLED:
        return clock
    stride = next(k for k in STRIDES if steps * count <= k * MOST_SAMPLED or k == STRIDES[-1])
    return replace(clock, schedule=clock.schedule.thinned(stride))
