"""Styles for formats that have no groups: each shape is painted by itself."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from math import prod

import numpy as np

from shapetween.base.arrays import Floats
from shapetween.model.movement import Movement
from shapetween.model.paint import Colour, Gradient, Style
from shapetween.model.part import Part, shown_while

__all__ = [
    "AT_ONCE",
    "PAINT_TIMES",
    "colour_losses",
    "group_losses",
    "paint_times",
    "plain_style",
    "plain_styles",
]

#: Times at which paint is looked at: it changes evenly, and slower than shapes.
PAINT_TIMES = np.linspace(0.0, 1.0, 31)

#: How long after it comes, or before it goes, a part is looked at besides: some fade there in a
#: moment. Fewer, and a fade takes a thirtieth of the time; more is not seen.
BESIDE = 2.0 ** np.arange(4) / 480

#: How long a part takes that comes or goes at once. Longer, and it is seen half transparent; less
#: than frames are told in falls on one.
AT_ONCE = 1e-4

#: Times at which groups are looked at: a movement's ends from inside, and half-way.
LOOKED = (1e-6, 0.5, 1 - 1e-6)


def paint_times(part: Part) -> Floats:
    """Times from 0 to 1 at which the paint of a part is looked at, (S,), increasing.

    Even ones, and those about where it comes or goes in mid-way, which it may do at once.
    """
    low, high = shown_while(part)
    comes = [low - AT_ONCE, low, *(low + BESIDE)] if low > 0 else []
    goes = [*(high - BESIDE), high, high + AT_ONCE] if high < 1 else []
    return np.union1d(PAINT_TIMES, [time for time in (*comes, *goes) if 0 < time < 1])


def plain_styles(part: Part, times: Sequence[float]) -> list[Style]:
    """The styles of a part at some times, without groups."""
    return [plain_style(part.style(t)) for t in times]


def plain_style(style: Style) -> Style:
    """The style with the opacity of its groups as its own."""
    if not style.groups:
        return style
    opacity = style.opacity * prod(group.opacity for group in style.groups)
    return replace(style, opacity=opacity, groups=())


def group_losses(movements: Sequence[Movement], form: str, *, composed: bool = False) -> list[str]:
    """What of groups is left out, one line each; `form` is what messages call the format.

    One that is `composed` draws a group apart: its masks and its opacity are kept.
    """
    losses = []
    for movement in movements:
        members: dict[object, int] = {}
        for number, part in enumerate(movement.parts, start=1):
            groups = {group for t in LOOKED for group in part.style(t).groups}
            name = part.name or f"part {number}"
            if any(group.masks for group in groups) and not composed:
                losses.append(f"{name}: its mask is left out in {form}")
            if any(group.filter is not None for group in groups):
                losses.append(f"{name}: its filter is left out in {form}")
            if any(group.blend != "normal" for group in groups):
                losses.append(f"{name}: its blend mode is left out in {form}")
            for key in {group.key for group in groups if group.opacity < 1}:
                members[key] = members.get(key, 0) + 1
        if any(count > 1 for count in members.values()) and not composed:
            losses.append(f"shapes of one group fade each by itself in {form}")
    return losses


def colour_losses(movements: Sequence[Movement], form: str) -> list[str]:
    """Which colours that are the page's to choose become the file's own, in one line."""
    styles = [part.style(t) for m in movements for part in m.parts for t in LOOKED]
    asked = (reference for style in styles for reference in _references(style))
    words = [*dict.fromkeys(asked)]
    if not words:
        return []
    named, are = ("colour", "is") if len(words) == 1 else ("colours", "are")
    return [f"the page's own {named}, {', '.join(words)}, {are} fixed in {form}"]


def _references(style: Style) -> Iterator[str]:
    paints = (style.fill, style.stroke.paint if style.stroke is not None else None)
    for paint in paints:
        stops = paint.stops if isinstance(paint, Gradient) else ()
        for colour in (paint, *(stop.colour for stop in stops)):
            if isinstance(colour, Colour) and colour.reference:
                yield colour.reference
