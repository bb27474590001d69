"""Areas of two drawings that largely coincide in place, and what their outlines have in common."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from shapetween.base.notices import Notice
from shapetween.scene.items import Item
from shapetween.scene.kept.bars import Bar, bar_of
from shapetween.scene.kept.pieces import drawn_rings
from shapetween.scene.kept.shared_arcs import Snapped, snapped

__all__ = [
    "COLOUR",
    "MOST_AREAS",
    "REACH",
    "Coinciding",
    "Family",
    "Looked",
    "Sides",
    "coinciding_areas",
    "scale_of",
]

#: Distance within which outlines are one, as a share of the drawing: what rounding to one decimal
#: of an icon of 24 units moves. Larger, and thin walls count as drawn twice.
REACH = 2e-3

#: Sum of differences of colours that are one.
COLOUR = 0.05

#: Least share of the smaller one that two areas have in common, to be looked at together.
COMMON = 0.1

#: Least share of its outline that an area has in common with the other drawing's to be kept.
BODY = 0.08

#: Least share of all outlines that is common, of either drawing.
SHARED = 0.5

#: Most areas of a drawing, and most curves of those of one colour, that are looked at; more take
#: longer than it is worth.
MOST_AREAS, MOST_CURVES = 40, 300

Sides: TypeAlias = tuple[Sequence[Item], Sequence[Item]]
"""Items of both drawings, in paint order."""

Family: TypeAlias = tuple[list[int], list[int]]
"""Items of both drawings."""


@dataclass(frozen=True, slots=True, eq=False)
class Looked:
    """Items of both drawings that largely coincide.

    Attributes
    ----------
    members : (list of int, list of int)
    items : (list of Item, list of Item)
    snapped : Snapped
        Their rings.
    bars : tuple of Bar
        Those among them of which the other drawing has nothing.
    """

    members: Family
    items: tuple[list[Item], list[Item]]
    snapped: Snapped
    bars: tuple[Bar, ...]


@dataclass(frozen=True, slots=True, eq=False)
class Coinciding:
    """What of two drawings largely coincides.

    Attributes
    ----------
    sides : (sequence of Item, sequence of Item)
        All that is drawn.
    scale : float
        Its diagonal.
    looked : tuple of Looked
    notices : tuple of Notice
        What was not looked at.
    """

    sides: Sides
    scale: float
    looked: tuple[Looked, ...]
    notices: tuple[Notice, ...]


def coinciding_areas(first: Sequence[Item], second: Sequence[Item]) -> Coinciding:
    """Find areas that largely coincide.

    Parameters
    ----------
    first, second : sequence of Item
        In paint order and one frame.
    """
    sides = (first, second)
    scale = scale_of(sides)
    families = _families(sides)
    looked = tuple(found for f in families if (found := _look(sides, f, scale)) is not None)
    return Coinciding(sides, scale, looked, _limits(sides, families))


def _limits(sides: Sides, families: Sequence[Family]) -> tuple[Notice, ...]:
    """What to tell where there is too much to look for what stays of it."""
    most = max(sum(item.plain for item in side) for side in sides)
    if most > MOST_AREAS:
        text = f"of {most} areas, more than {MOST_AREAS}, what stays in part is not looked for"
    elif any(_curves(sides, family) > MOST_CURVES for family in families):
        text = f"of areas of more than {MOST_CURVES} curves what stays in part is not looked for"
    else:
        return ()
    return (Notice("too-many-parts", text, instead="each moves as a whole", severity="note"),)


def _curves(sides: Sides, family: Family) -> int:
    """How many curves the items of a family have."""
    items = (side[k] for side, own in zip(sides, family, strict=True) for k in own)
    return sum(len(ring.curves) for item in items for ring in item.rings)


def scale_of(sides: Sides) -> float:
    """Diagonal of all that is drawn."""
    boxes = np.array([item.box for side in sides for item in side])
    return float(np.hypot(*(boxes[:, 1].max(axis=0) - boxes[:, 0].min(axis=0))))


def _families(sides: Sides) -> list[Family]:
    """Plain areas of one colour that lie on each other, one drawing's on the other's."""
    import shapely

    plain = [[k for k, item in enumerate(side) if item.plain] for side in sides]
    if not plain[0] or not plain[1] or max(map(len, plain)) > MOST_AREAS:
        return []
    drawn = [np.array([s[k].drawn for k in own]) for s, own in zip(sides, plain, strict=True)]
    one, other = shapely.STRtree(drawn[1]).query(drawn[0], predicate="intersects")
    both = shapely.area(shapely.intersection(drawn[0][one], drawn[1][other]))
    least = np.minimum(shapely.area(drawn[0])[one], shapely.area(drawn[1])[other])
    colours = [np.array([s[k].colour for k in own]) for s, own in zip(sides, plain, strict=True)]
    alike = np.abs(colours[0][one] - colours[1][other]).sum(axis=-1) < COLOUR
    links = [
        (int(i), int(j))
        for i, j, fine in zip(one, other, alike & (both > COMMON * least), strict=True)
        if fine
    ]
    families: list[tuple[set[int], set[int]]] = []
    for i, j in links:
        joined = [f for f in families if i in f[0] or j in f[1]]
        families = [f for f in families if f not in joined]
        whole = {i}.union(*(f[0] for f in joined)), {j}.union(*(f[1] for f in joined))
        families.append(whole)
    return [
        (sorted(plain[0][i] for i in f[0]), sorted(plain[1][j] for j in f[1])) for f in families
    ]


def _look(sides: Sides, family: Family, scale: float) -> Looked | None:
    """Which items of a family are kept, with what comes and goes of them."""
    items = [[sides[k][n] for n in family[k]] for k in (0, 1)]
    if _curves(sides, family) > MOST_CURVES:
        return None
    reach = REACH * scale
    found = snapped(drawn_rings(items[0]), drawn_rings(items[1]), reach)
    bars: list[Bar] = []
    members: tuple[list[int], list[int]] = ([], [])
    kept: tuple[list[Item], list[Item]] = ([], [])
    common, length = [0.0, 0.0], [0.0, 0.0]
    for side in (0, 1):
        starts = np.cumsum([0, *(len(item.rings) for item in items[side])])[:-1]
        shared = np.add.reduceat(found.shared[side], starts)
        around = np.add.reduceat(found.lengths[side], starts)
        for k, (n, item) in enumerate(zip(family[side], items[side], strict=True)):
            if shared[k] >= BODY * around[k]:
                common[side] += float(shared[k])
                length[side] += float(around[k])
            else:
                bar = bar_of(item.enclosed, comes=side == 1)
                if bar is None:
                    continue
                bars.append(bar)
            members[side].append(n)
            kept[side].append(item)
    if not kept[0] or not kept[1] or _covered(sides, members):
        return None
    shares = [c / max(whole, 1e-300) for c, whole in zip(common, length, strict=True)]
    if max(shares) < SHARED:
        return None
    if [len(side) for side in members] != [len(side) for side in family]:
        found = snapped(drawn_rings(kept[0]), drawn_rings(kept[1]), reach)
    return Looked(members, kept, found, tuple(bars))


def _covered(sides: Sides, members: Family) -> bool:
    """Whether something else is painted between some items, so that they cannot be one."""
    for side, own in zip(sides, members, strict=True):
        between = [k for k in range(own[0], own[-1]) if k not in own]
        if any(side[k].drawn.intersects(side[n].drawn) for k in between for n in own):
            return True
    return False
