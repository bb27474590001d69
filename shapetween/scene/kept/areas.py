"""Areas that largely coincide in place: what both have stands still, and the rest moves beside it.

A lid that opens in a box, a badge on a bell, the slash through an eye: a person sees one thing to
which something is done. So the outlines are not matched as wholes.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from shapetween.base.notices import Notice
from shapetween.boolean.chords import chords_of
from shapetween.fill.regions import Region
from shapetween.fill.splitting import split_alike
from shapetween.model.outline import Outline
from shapetween.model.part import CurveTrack
from shapetween.scene.asked import Group
from shapetween.scene.disturbance import floods
from shapetween.scene.items import Item
from shapetween.scene.kept.badges import Grown, badge_tracks, badges_of, blunt_badges, meets
from shapetween.scene.kept.bars import Bar, slot_of
from shapetween.scene.kept.changes import tracks_of_pieces
from shapetween.scene.kept.coinciding import COLOUR, REACH, Coinciding, Family, Looked, Sides
from shapetween.scene.kept.holes import (
    holes_in_turn,
    holes_over_edges,
    loose_holes,
    matched_hole_pairs,
    matched_hole_track,
    unmatched_hole_track,
)
from shapetween.scene.kept.pieces import areas_of, drawn_rings, overlay
from shapetween.scene.motion.tracks import InTurn

if TYPE_CHECKING:
    import shapely

__all__ = ["Kept", "KeptArea", "kept_areas"]

#: Least share of the outlines of both that is common, and most area of holes that open or close
#: alone, for what differs to come and go as parts although edges seem to move. A smaller share, and
#: sides of a box that grows are wiped; larger, and an arrow in a cloud tears to point the other
#: way. With more holes a table is black before it is another one; fewer, and the arrow tears.
STEADY, OPENED = 0.55, 0.2


#: The same of what else is kept. Smaller, and a line is held to be one side of the bar that it
#: becomes; larger, and a bell leaves for one that is crossed out.
SHARED_BY_BOTH = 0.38


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
    coinciding: Coinciding, groups: Sequence[Group] = (), *, parts: bool = False
) -> Kept:
    """Find areas of which most stays where it is.

    Parameters
    ----------
    coinciding : Coinciding
        What `coinciding_areas` finds of two drawings.
    groups : sequence of Group
        Shapes that become each other: they are kept together or not at all.
    parts : bool
        Whether, where most is common, all that differs comes and goes as parts.
    """
    sides, scale, looked = coinciding.sides, coinciding.scale, coinciding.looked
    areas: list[KeptArea] = []
    now: tuple[dict[int, Item | None], dict[int, Item | None]] = ({}, {})
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
    return Kept(left[0], left[1], tuple(areas), coinciding.notices)


def _agrees(
    groups: Sequence[Group],
    sides: Sides,
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


def _divides(looked: Looked, reach: float) -> bool:
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


def _beside(sides: Sides, looked: Sequence[Looked], own: Looked) -> Family:
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
    looked: Looked,
    bars: Sequence[Bar],
    beside: Family,
    sides: Sides,
    scale: float,
    *,
    parts: bool = False,
) -> tuple[tuple[CurveTrack, ...], Family] | None:
    """Tracks of all that is kept, comes and goes, and which of the items beside it are badges."""
    kept, found = looked.items, looked.snapped
    least = STEADY if parts else 0.0 if bars else SHARED_BY_BOTH
    if min(found.common) < least:
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
    unmatched_holes = [
        ring
        for own, side in zip(holes, loose, strict=True)
        for k, ring in zip(own, side, strict=True)
        if k not in paired
    ]
    if parts and sum(abs(ring.area) for ring in unmatched_holes) > OPENED * solid[0].area:
        return None
    if _floods(solid, loose, pairs):
        return None
    moving = [matched_hole_track(loose[0][i], loose[1][j], scale) for i, j in pairs]
    in_turn = holes_in_turn(holes, paired, chords.polylines, solid)
    paired.update(k for _, k in in_turn)
    over = holes_over_edges(holes, paired, chords.polylines, solid)
    paired.update(k for _, k in over)
    for side, k in (*in_turn, *over):
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
    if over:
        # What a hole lies across goes after that has closed, or comes before it opens.
        moved = tuple(InTurn(track, first=over[0][0] == 1) for track in moved)
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


def _floods(
    solid: "Sequence[shapely.Geometry]",
    loose: Sequence[Sequence[Outline]],
    pairs: Sequence[tuple[int, int]],
) -> bool:
    """Whether most of what is open in both areas closes on the way.

    Parameters
    ----------
    solid : sequence of shapely geometry
        Both areas with their loose holes filled.
    loose : sequence of sequence of Outline
        Those holes.
    pairs : sequence of (int, int)
        Which of them become each other.
    """
    painted = [s.area - sum(abs(h.area) for h in own) for s, own in zip(solid, loose, strict=True)]
    open_all_along = sum(max(abs(loose[0][i].area), abs(loose[1][j].area)) for i, j in pairs)
    half_way = max(s.area for s in solid) - open_all_along
    return floods(half_way, painted)
