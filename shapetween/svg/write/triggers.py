"""What sets an SVG going without a script: a click, or a pointer over it, and back again.

Two rectangles that nobody sees lie over the drawing, of which one at most takes part: a click on
the first, or a pointer that comes over it, sets all going; on the second, or leaving it, back. In
mid-way neither is there, so that nothing is cut short.
"""

import xml.etree.ElementTree as ET

from shapetween.base.errors import OptionError
from shapetween.model.drawing import Box
from shapetween.svg.write.clock import Clock, Trigger
from shapetween.svg.write.elements import LATER, GradientDefs
from shapetween.svg.write.numbers import decimals_for, number

__all__ = ["STARTS", "add_triggers", "trigger_of"]

#: Events that set going and back, by what is asked for.
STARTS = {"click": ("click", "click"), "hover": ("mouseover", "mouseout")}


def trigger_of(start: str, gradients: GradientDefs) -> Trigger | None:
    """The events for what is asked for; None if it is the page that starts it.

    Raises
    ------
    OptionError
        If that needs a script.
    """
    if start == "load":
        return None
    if start not in STARTS:
        raise OptionError(
            f"start {start!r}: an SVG has no script to tell it; expected load, click or hover, or "
            "a module that ends in .mjs"
        )
    there, back = STARTS[start]
    first, second = (gradients.name_of(part) for part in ("there", "back"))
    return Trigger(f"{first}.{there}", f"{second}.{back}")


def add_triggers(root: ET.Element, box: Box, clock: Clock) -> None:
    """Lay what is clicked on, or pointed at, over a drawing."""
    trigger = clock.trigger
    if trigger is None:
        return
    decimals = decimals_for(box) + 3
    sides = {name: number(getattr(box, name), decimals) for name in ("x", "y", "width", "height")}
    once = clock.timeline.loop == "once"
    seconds = number(clock.timeline.seconds + (clock.timeline.hold if once else 0.0), 3)
    # What is played for ever may be ended at any time; what is played once is let arrive.
    wait = f"+{seconds}s" if once else ""
    arrived = {event: f"{event}{wait}" for event in (trigger.there, trigger.back)}
    for event, first, (begin, end) in (
        (trigger.there, True, (trigger.there, arrived[trigger.back])),
        (trigger.back, False, (arrived[trigger.there], trigger.back)),
    ):
        name = event.rpartition(".")[0]
        hidden = {} if first else {**LATER, "visibility": "hidden"}
        attributes = {"id": name, **sides, "fill": "none", "pointer-events": "visible", **hidden}
        rect = ET.SubElement(root, "rect", attributes)
        to = "hidden" if first else "visible"
        ET.SubElement(
            rect, "set", {"attributeName": "visibility", "to": to, "begin": begin, "end": end}
        )
