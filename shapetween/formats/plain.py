"""Styles for formats that have no groups: each shape is painted by itself."""

from collections.abc import Sequence
from dataclasses import replace
from math import prod

from shapetween.model.movement import Movement, Part
from shapetween.model.paint import Style

__all__ = ["group_losses", "plain_style", "plain_styles"]

#: Times at which groups are looked at: a movement's ends from inside, and half-way.
LOOKED = (1e-6, 0.5, 1 - 1e-6)


def plain_styles(part: Part, times: Sequence[float]) -> list[Style]:
    """The styles of a part at some times, without groups."""
    return [plain_style(part.style(t)) for t in times]


def plain_style(style: Style) -> Style:
    """The style with the opacity of its groups as its own."""
    if not style.groups:
        return style
    opacity = style.opacity * prod(group.opacity for group in style.groups)
    return replace(style, opacity=opacity, groups=())


def group_losses(movements: Sequence[Movement], form: str) -> list[str]:
    """What of groups is left out, one line each; `form` is what messages call the format."""
    losses = []
    for movement in movements:
        members: dict[object, int] = {}
        for number, part in enumerate(movement.parts, start=1):
            groups = {group for t in LOOKED for group in part.style(t).groups}
            name = part.name or f"part {number}"
            if any(group.masks for group in groups):
                losses.append(f"{name}: its mask is left out in {form}")
            if any(group.filter is not None for group in groups):
                losses.append(f"{name}: its filter is left out in {form}")
            if any(group.blend != "normal" for group in groups):
                losses.append(f"{name}: its blend mode is left out in {form}")
            for key in {group.key for group in groups if group.opacity < 1}:
                members[key] = members.get(key, 0) + 1
        if any(count > 1 for count in members.values()):
            losses.append(f"shapes of one group fade each by itself in {form}")
    return losses
