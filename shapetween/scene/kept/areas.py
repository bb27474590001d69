"""Areas that largely coincide in place: what both have stands still, and the rest moves beside it.

A lid that opens in a box, a badge on a bell, the slash through an eye: a person sees one thing to
which something is done. So the outlines are not matched as wholes.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TypeAlias

import numpy as np

from shapetween.base.notices import Notice
from shapetween.boolean.chords import chords_of
from shapetween.fill.regions import Region
from shapetween.fill.splitting import split_alike
from shapetween.model.part import CurveTrack
from shapetween.scene.asked import Group
from shapetween.scene.items import Item
from shapetween.scene.kept.appearing import InTurn
from shapetween.scene.kept.badges import Grown, badge_tracks, badges_of, blunt_badges, meets
from shapetween.scene.kept.bars import Bar, bar_of, slot_of
from shapetween.scene.kept.changes import tracks_of_pieces
from shapetween.scene.kept.holes import (
    holes_in_turn,
    loose_holes,
    matched_hole_pairs,
    matched_hole_track,
    unmatched_hole_track,
)
from shapetween.scene.kept.pieces import areas_of, drawn_rings, overlay
from shapetween.scene.kept.shared_arcs import Snapped, snapped

__all__ = ["COLOUR", "MOST_AREAS", "REACH", "Kept", "KeptArea", "kept_areas", "scale_of"]

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

#: Least share of the outlines of both that is common, and most area of holes that open or close
#: alone, for what differs to come and go as parts although edges seem to move. A smaller share, and
#: sides of a box that grows are wiped; larger, and an arrow in a cloud tears to point the other
#: way. With more holes a table is black before it is another one; fewer, and the arrow tears.
STEADY, OPENED = 0.55, 0.2

#: Most areas of a drawing, and most curves of those of one colour, that are looked at; more take
#: longer than it is worth.
MOST_AREAS, MOST_CURVES = 40, 300

Family: TypeAlias = tuple[list[int], list[int]]
"""Items of both drawings."""


@dataclass(frozen=True, slots=True, eq=False)
class KeptArea:
    """Two items that stand for all that is kept, and what moves them.

    Attributes
    ----------
    first, second : Item
    tracks : tuple of CurveTrack
    """

    first: Item
    second: Item
    tracks: tuple[CurveTrack, ...]


@dataclass(frozen=True, slots=True, eq=False)
class Kept:
    """Two drawings' items and which of them become each other by what they have in common.

    Attributes
    ----------
    first, second : tuple of Item
        Without those that are part of a kept area and do not stand for it.
    areas : tuple of KeptArea
    notices : tuple of Notice
    """

    first: tuple[Item, ...]
    second: tuple[Item, ...]
    areas: tuple[KeptArea, ...] = ()
    notices: tuple[Notice, ...] = ()


def kept_areas(
    first: Sequence[Item],
    second: Sequence[Item],
    groups: Sequence[Group] = (),
    *,
    parts: bool = False,
) -> Kept:
    """Find areas of which most stays where it is.

    Parameters
    ----------
    first, second : sequence of Item
        In paint order and one frame.
    groups : sequence of Group
        Shapes that become each other: they are kept together or not at all.
    parts : bool
        Whether, where most is common, all that differs comes and goes as parts.
    """
    sides = (first, second)
    scale = scale_of(sides)
    areas: list[KeptArea] = []
    now: tuple[dict[int, Item | None], dict[int, Item | None]] = ({}, {})
    families = _families(sides)
    looked = [found for f in families if (found := _look(sides, f, scale)) is not None]
    bars = [bar for found in looked for bar in found.bars]
    for found in looked:
        if _divides(found, REACH * scale):
            continue
        beside = _beside(sides, looked, found)
        moved = _tracks(found, bars, beside, sides, scale)
        if moved is None and parts:
            moved = _tracks(found, bars, beside, sides, scale, parts=True)
        if moved is None:
            continue
        tracks, badges = moved
        first_of, second_of = found.members
        members: Family = (sorted({*first_of, *badges[0]}), sorted({*second_of, *badges[1]}))
        largest = [
            max(own, key=lambda k: (round(side[k].area / scale**2, 9), -k))
            for side, own in zip(sides, members, strict=True)
        ]
        if not _agrees(groups, sides, members, largest):
            continue
        marked = []
        for side, own, k in zip((0, 1), members, largest, strict=True):
            marked.append(replace(sides[side][k], cut=True))
            now[side].update(dict.fromkeys(own))
            now[side][k] = marked[side]
        areas.append(KeptArea(marked[0], marked[1], tracks))
    left = [
        tuple(i for i in (changed.get(k, item) for k, item in enumerate(side)) if i is not None)
        for changed, side in zip(now, sides, strict=True)
    ]
    return Kept(left[0], left[1], tuple(areas), _limits(sides, families))


def _limits(
    sides: tuple[Sequence[Item], Sequence[Item]], families: Sequence[Family]
) -> tuple[Notice, ...]:
    """What to tell where there is too much to look for what stays of it."""
    most = max(sum(item.plain for item in side) for side in sides)
    if most > MOST_AREAS:
        text = f"of {most} areas, more than {MOST_AREAS}, what stays in part is not looked for"
    elif any(_curves(sides, family) > MOST_CURVES for family in families):
        text = f"of areas of more than {MOST_CURVES} curves what stays in part is not looked for"
    else:
        return ()
    return (Notice("too-many-parts", text, instead="each moves as a whole", severity="note"),)


def _curves(sides: tuple[Sequence[Item], Sequence[Item]], family: Family) -> int:
    """How many curves the items of a family have."""
    items = (side[k] for side, own in zip(sides, family, strict=True) for k in own)
    return sum(len(ring.curves) for item in items for ring in item.rings)


def _agrees(
    groups: Sequence[Group],
    sides: tuple[Sequence[Item], Sequence[Item]],
    members: Family,
    largest: Sequence[int],
) -> bool:
    """Whether what some shapes are to become is what the largest of them do."""
    shapes = [{side[n].shape for n in own} for side, own in zip(sides, members, strict=True)]
    main = [side[k].shape for side, k in zip(sides, largest, strict=True)]
    return all(
        (main[0] in group[0] and main[1] in group[1])
        or not (shapes[0] & {*group[0]} or shapes[1] & {*group[1]})
        for group in groups
    )


def scale_of(sides: tuple[Sequence[Item], Sequence[Item]]) -> float:
    """Diagonal of all that is drawn."""
    boxes = np.array([item.box for side in sides for item in side])
    return float(np.hypot(*(boxes[:, 1].max(axis=0) - boxes[:, 0].min(axis=0))))


def _families(sides: tuple[Sequence[Item], Sequence[Item]]) -> list[Family]:
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


@dataclass(frozen=True, slots=True, eq=False)
class _Looked:
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


def _look(
    sides: tuple[Sequence[Item], Sequence[Item]], family: Family, scale: float
) -> _Looked | None:
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
    return _Looked(members, kept, found, tuple(bars))


def _divides(looked: _Looked, reach: float) -> bool:
    """Whether one area comes apart into several, or back, with nothing but gaps between them.

    It does so as a cell: nothing is clipped from between what then stands as if it always had. But
    a slot is: opened all along at once it begins as a hair.
    """
    import shapely

    sides = sorted(looked.items, key=len)
    if looked.bars or len(sides[0]) != 1 or len(sides[1]) < 2:
        return False
    drawn = sides[0][0].drawn
    left = drawn.difference(shapely.union_all([item.drawn for item in sides[1]]))
    if slot_of(left.buffer(-reach, cap_style="flat", join_style="mitre")) is not None:
        return False
    if sum(item.drawn.difference(drawn).area for item in sides[1]) > reach * drawn.length:
        return False
    (whole,), parts = ([Region(item.outer, item.holes) for item in side] for side in sides)
    return split_alike(whole, parts) is not None


def _beside(
    sides: tuple[Sequence[Item], Sequence[Item]], looked: Sequence[_Looked], own: _Looked
) -> Family:
    """Items of the colour of what is kept that are no part of it."""
    colour = own.items[0][0].colour
    first, second = (
        [
            k
            for k, item in enumerate(side)
            if item.plain
            and np.abs(item.colour - colour).sum() < COLOUR
            and all(k not in found.members[n] for found in looked)
        ]
        for n, side in enumerate(sides)
    )
    return first, second


def _tracks(
    looked: _Looked,
    bars: Sequence[Bar],
    beside: Family,
    sides: tuple[Sequence[Item], Sequence[Item]],
    scale: float,
    *,
    parts: bool = False,
) -> tuple[tuple[CurveTrack, ...], Family] | None:
    """Tracks of all that is kept, comes and goes, and which of the items beside it are badges."""
    kept, found = looked.items, looked.snapped
    if parts and min(found.common) < STEADY:
        return None
    counts = [len(i.rings) for i in kept[0]], [len(i.rings) for i in kept[1]]
    chords = chords_of([*found.first, *found.second])
    holes = loose_holes(counts, found)
    solid = areas_of(chords.polylines, counts, {*holes[0], *holes[1]})
    rings = drawn_rings(kept[0]), drawn_rings(kept[1])
    count = len(rings[0])
    loose = [rings[0][k] for k in holes[0]], [rings[1][k - count] for k in holes[1]]
    pairs = matched_hole_pairs(*loose, solid, scale)
    paired = {holes[0][i] for i, _ in pairs} | {holes[1][j] for _, j in pairs}
    lone_holes = [
        ring
        for own, side in zip(holes, loose, strict=True)
        for k, ring in zip(own, side, strict=True)
        if k not in paired
    ]
    if parts and sum(abs(ring.area) for ring in lone_holes) > OPENED * solid[0].area:
        return None
    moving = [matched_hole_track(loose[0][i], loose[1][j], scale) for i, j in pairs]
    for side, k in holes_in_turn(holes, paired, chords.polylines, solid):
        paired.add(k)
        ring = loose[side][holes[side].index(k)]
        moving.append(InTurn(unmatched_hole_track(ring, closes=side == 0), first=side == 0))
    laid = overlay(areas_of(chords.polylines, counts, paired), found, chords, scale)
    if not laid.pieces and not moving:
        return None
    if parts and len({piece.comes for piece in laid.pieces}) < 2:
        return None  # what is only bitten off, or only grows, is one outline still
    bound = [
        {k: ring for k, ring in enumerate(side) if k + first not in {*holes[0], *holes[1]}}
        for first, side in ((0, rings[0]), (count, rings[1]))
    ]
    near = [sides[0][k] for k in beside[0]], [sides[1][k] for k in beside[1]]
    badges = badges_of(laid, near, scale)
    bitten = [piece for badge in badges for piece in badge.pieces]
    blunt, cleared = blunt_badges(laid, near, badges)
    unmatched = len({*holes[0], *holes[1]} - paired)
    moved = tracks_of_pieces(
        laid, bars, bitten, cleared, bound[0], bound[1], unmatched, REACH * scale, parts=parts
    )
    if moved is None:
        return None
    taken: Family = ([], [])
    for badge in badges:
        own = badge_tracks(badge, near[badge.comes], laid)
        if meets(badge, near):
            own = [InTurn(track, first=not badge.comes) for track in own]
        moved = (*moved, *own)
        taken[badge.comes].extend(beside[badge.comes][k] for k in badge.items)
    for k, comes in blunt:
        item = near[comes][k]
        grown = Grown(tuple(drawn_rings([item])), item.box.mean(axis=0), comes)
        moved = (*moved, InTurn(grown, first=not comes))
        taken[comes].append(beside[comes][k])
    return (*moved, *moving), taken


def _covered(sides: tuple[Sequence[Item], Sequence[Item]], members: Family) -> bool:
    """Whether something else is painted between some items, so that they cannot be one."""
    for side, own in zip(sides, members, strict=True):
        between = [k for k in range(own[0], own[-1]) if k not in own]
        if any(side[k].drawn.intersects(side[n].drawn) for k in between for n in own):
            return True
    return False
