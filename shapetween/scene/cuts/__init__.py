"""Cutting items beforehand where gaps will be, so that one that becomes several is as many."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TypeAlias

from shapetween.base.arrays import Points
from shapetween.base.notices import Notice
from shapetween.scene.asked import Group
from shapetween.scene.cuts.areas import divided_areas
from shapetween.scene.cuts.closing import closed_lines
from shapetween.scene.cuts.division import Found
from shapetween.scene.cuts.lines import parted_lines, shared_lines
from shapetween.scene.cuts.rings import divided_rings
from shapetween.scene.items import Item
from shapetween.scene.relations import Scene, perceive

__all__ = ["Cut", "cut_alike_items"]

Cutting: TypeAlias = Callable[[Scene, Scene, Sequence[Group]], Found | None]
"""From a scene whose items are cut, one whose items they become, and what the user asks for.

None where there is too much to look at.
"""

CUTS: tuple[Cutting, ...] = (closed_lines, parted_lines, shared_lines, divided_areas, divided_rings)
"""All ways, in order."""

#: What is told where one of them finds too much.
UNCUT = Notice(
    "too-many-parts",
    "of so many lines it is not looked for where they run along each other",
    instead="each becomes another as a whole",
    severity="note",
)


@dataclass(frozen=True, slots=True, eq=False)
class Cut:
    """Two scenes that are drawn as before, of items that correspond better.

    Attributes
    ----------
    scenes : (Scene, Scene)
    given : tuple of (int, int)
        Items that become each other, by the cuts.
    notices : tuple of Notice
        What was not looked for.
    """

    scenes: tuple[Scene, Scene]
    given: tuple[tuple[int, int], ...]
    notices: tuple[Notice, ...] = ()


def cut_alike_items(
    a: Scene, b: Scene, views: tuple[Points, Points], groups: Sequence[Group] = ()
) -> Cut:
    """Cut the items of both scenes, each where the other one's ask for it.

    Parameters
    ----------
    a, b : Scene
    views : ((2, 2) float64, (2, 2) float64)
        What is shown of each drawing.
    groups : sequence of Group
        Shapes that become each other because the user says so: one may become several.
    """
    given: list[tuple[Item, Item]] = []
    notices: tuple[Notice, ...] = ()
    for cut in CUTS:
        for backwards in (False, True):
            whole, parts = (b, a) if backwards else (a, b)
            asked = [(two, one) for one, two in groups] if backwards else groups
            found = cut(whole, parts, asked)
            if found is None:
                notices = (UNCUT,)
            if not found:
                continue
            items: list[Item] = []
            for k, item in enumerate(whole.items):
                items += found[k].pieces if k in found else [item]
            for division in found.values():
                pairs = [(piece, parts.items[j]) for piece, j in division.pairs]
                given += [(two, one) for one, two in pairs] if backwards else pairs
            if backwards:
                b = perceive(items, views[1])
            else:
                a = perceive(items, views[0])
    where = [{id(item): k for k, item in enumerate(scene.items)} for scene in (a, b)]
    pairs_now = [
        (where[0][id(one)], where[1][id(other)])
        for one, other in given
        if id(one) in where[0] and id(other) in where[1]
    ]
    return Cut((a, b), tuple(pairs_now), notices)
