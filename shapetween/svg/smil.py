"""An animated SVG: the whole movement in one file that plays by itself.

Written in SMIL, which every browser plays even inside ``<img>``. Without it the file shows the
first frame: that is what each path holds at rest. A reader who asks for less motion is shown the
first frame too, as a twin of the drawing that stands still.
"""

import math
import xml.etree.ElementTree as ET
from dataclasses import replace
from typing import Literal, get_args

import numpy as np

from shapetween.drawing import Shape
from shapetween.errors import OptionError
from shapetween.frames import KEYFRAME_TOLERANCE, Schedule
from shapetween.movement import Movement, Part
from shapetween.svg.animate import Clock, Loop, animate
from shapetween.svg.animate_style import animate_style
from shapetween.svg.elements import GradientDefs, add_shape, document, named, text_of
from shapetween.svg.numbers import decimals_for, path_data
from shapetween.tracks import style_tracks

__all__ = ["add_part", "smil_svg"]

#: Shows the twin instead of the movement. The class names are ours alone, because a page that holds
#: the drawing shares its style sheet; and without any style sheet the twin stays hidden.
REDUCED_MOTION = (
    "@media (prefers-reduced-motion:reduce){"
    ".shapetween-moving{display:none}.shapetween-still{display:inline}}"
)


#: Paint is looked at on every fourth sample: it changes evenly, and slower than shapes.
PAINT_STRIDE = 4

#: A style's times are kept inside these, where it has all it needs on the way (a plain colour on
#: its way to a gradient is a gradient there) and differs from its ends by nothing to be seen.
INSIDE = (1e-6, 1 - 1e-6)


def smil_svg(
    movement: Movement,
    *,
    duration: float = 2.0,
    easing: str = "linear",
    loop: Loop = "once",
    keyframes: Literal["auto"] | int = "auto",
    precision: int | None = None,
) -> str:
    """Write a movement as an animated SVG.

    Parameters
    ----------
    movement : Movement
    duration : float
        Seconds from the first drawing to the last.
    easing : str
        See `shapetween.frames.easing_function`. The default shows at every moment what the frame
        of that time shows.
    loop : {"once", "repeat", "alternate"}
        Stay at the end, start over, or go back and start over.
    keyframes : "auto" or int
        By default as few as keep every point within a quarter of a pixel where the view box is
        1000 px large; or a number of them, even along the easing.
    precision : int, optional
        Decimals of coordinates; by default about 1/10000 of the view box's larger side.

    Raises
    ------
    OptionError
        If an option cannot be used; the message says what could.
    """
    clock = _clock(duration, easing, loop, keyframes)
    size = max(movement.box.width, movement.box.height)
    gradients = GradientDefs(decimals_for(movement.box, precision))

    root = document(movement.box, movement.title)
    ET.SubElement(root, "style").text = REDUCED_MOTION
    root.append(gradients.element)
    moving = ET.SubElement(root, "g", {"class": "shapetween-moving"})
    still = ET.SubElement(root, "g", {"class": "shapetween-still", "display": "none"})
    ids = named([part.name for part in movement.parts])
    for part, shape, name in zip(
        movement.parts, movement.at(np.zeros(1))[0].shapes, ids, strict=True
    ):
        add_part(moving, part, clock, gradients, name, size * KEYFRAME_TOLERANCE)
        add_shape(still, Shape(shape.rings, shape.style), gradients, {})
    if not len(gradients.element):
        root.remove(gradients.element)
    return text_of(root)


def _clock(duration: float, easing: str, loop: Loop, keyframes: Literal["auto"] | int) -> Clock:
    """The clock the options ask for."""
    if not (math.isfinite(duration) and duration >= 1e-3):
        raise OptionError(f"duration {duration}: expected seconds, at least 0.001")
    if loop not in get_args(Loop):
        raise OptionError(f"loop {loop!r}: expected {', '.join(get_args(Loop))}")
    if keyframes == "auto":
        return Clock(Schedule.of(easing), True, duration, loop)
    if keyframes < 2:
        raise OptionError(f"{keyframes} keyframes: expected 'auto' or at least 2")
    return Clock(Schedule.of(easing, keyframes), False, duration, loop)


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
    stack = part.curves(clock.schedule.time)
    picks = clock.pick(stack.reshape(len(stack), -1, 2), tolerance)
    values = path_data(stack[picks], part.rings, part.closed, gradients.decimals)
    slower = clock.schedule.thinned(PAINT_STRIDE if clock.adaptive else 1)
    styles = [part.style(t) for t in np.clip(slower.time, *INSIDE).tolist()]
    for track in style_tracks(styles):
        path = ET.SubElement(parent, "path", name if track.start == 0 else {})
        animate_style(path, track, replace(clock, schedule=slower), gradients, tolerance)
        path.set("d", values[0])
        animate(path, "d", clock, picks, values)
