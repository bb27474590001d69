"""Lines without a partner are retracted along their length, and what comes is drawn so."""

from collections.abc import Sequence
from typing import Literal

import numpy as np

from shapetween.base.arrays import Points
from shapetween.base.ends import End
from shapetween.scene.forms import OpenLine, Segment
from shapetween.scene.items import Item
from shapetween.scene.places import Places
from shapetween.scene.relations import Scene
from shapetween.scene.unmatched.clusters import Cluster, is_line
from shapetween.scene.unmatched.folding import fold_onto
from shapetween.scene.unmatched.going import Going, Side, nearer_end, nearest_beside
from shapetween.scene.unmatched.presence import BOTH, Carry, Leaving

__all__ = ["first_end", "gap_going", "retracted_lines"]

#: Length of a line, as a share of the drawing, from which on drawing it takes longer, and from
#: which on it takes nearly all the time, as a slash does; and by how much its window grows. Else a
#: slash would fly over the drawing.
LONG, LONGEST, LONGER = 0.25, 0.55, 0.35

#: Share of its length by which a slash goes to the side, and up or down: bars of menus do not.
SLANTED = 0.2

#: Share of a line that lies between what stays, for it to be a slash.
ACROSS = 0.5

#: When a gap opens that nothing runs through; it closes when that is over. Shorter, and an opening
#: lock snaps.
ALONE = (0.05, 0.8)

#: Share of a line's length at which it is first seen. With less it is a dot first, with much it
#: snaps into place.
STUB = 0.15

#: How near a line's end is to what it lies on, in widths.
ON = 0.6


def gap_going(k: int, side: Side) -> Going:
    """A piece of a line that was cut out goes into what is left of it."""
    item = side.scene.items[k]
    ends = item.outer.curves[[0, -1], [0, 3]]
    reach = 1e-3 * item.width
    found: list[int | None] = [None, None]
    for j in side.anchors:
        other = side.scene.items[j]
        if not other.cut or other.closed or other.shape != item.shape:
            continue
        theirs = other.outer.curves[[0, -1], [0, 3]]
        for e in range(2):
            if (np.linalg.norm(theirs - ends[e], axis=1) <= reach).any():
                found[e] = j
    carries = [side.carry(j, ends[e], "at") for e, j in enumerate(found)]
    window = ALONE if side.end is End.SOURCE else (1 - ALONE[1], 1 - ALONE[0])
    if all(carries):
        return Going(Leaving(window, kept=BOTH, steady=True), carries[0] + carries[1])
    kept = 0.5 if not any(carries) else float(not carries[0])
    return Going(Leaving(window, kept=kept, steady=True), carries[0] or carries[1])


def retracted_lines(cluster: Cluster, side: Side) -> dict[int, Going] | None:
    """How lines go that touch each other; None if they are a sign by themselves."""
    levels = _levels(cluster, side)
    if not levels and len(cluster.members) > 1:
        return None
    return _retracted(cluster, levels, side)


def _levels(cluster: Cluster, side: Side) -> list[dict[int, tuple[int | None, int | None]]]:
    """Lines by how far they hang from what stays: what each one's ends lie on, level by level.

    What lies on nothing, if others do, hangs on what it touches, by no end of its own.
    """
    scene = side.scene
    stays = [
        j
        for j in side.anchors
        if not scene.sheets[j] and not (scene.items[j].filled and j == cluster.parent)
    ]
    levels: list[dict[int, tuple[int | None, int | None]]] = []
    rest = list(cluster.members)
    while rest:
        found = {k: _lies_on(k, stays, scene) for k in rest}
        level = {k: on for k, on in found.items() if on != (None, None)}
        if not level:
            if not levels:
                return []
            level = {k: on for k, on in found.items() if scene.touching[k, stays].any()} or found
        levels.append(level)
        rest = [k for k in rest if k not in level]
        stays = list(level)
    return levels


def _lies_on(k: int, others: Sequence[int], scene: Scene) -> tuple[int | None, int | None]:
    """What a line's first and last end lie on."""
    import shapely

    item = scene.items[k]
    ends = shapely.points(item.outer.curves[[0, -1], [0, 3]])
    reach = ON * item.width - item.width / 2
    on: list[int | None] = [None, None]
    for j in others:
        if not scene.touching[k, j] or j == scene.outlined[k]:
            continue
        near = shapely.distance(scene.items[j].drawn, ends) <= reach
        on = [j if found else before for before, found in zip(on, near, strict=True)]
    return on[0], on[1]


def _retracted(
    cluster: Cluster, levels: list[dict[int, tuple[int | None, int | None]]], side: Side
) -> dict[int, Going]:
    """How lines go that hang together: each to what it hangs on, the farthest first."""
    found: dict[int, Going] = {}
    scene = side.scene
    for step, level in enumerate(levels):
        window = side.part_of(step, len(levels))
        for k, on in level.items():
            item = scene.items[k]
            ends = item.outer.curves[[0, -1], [0, 3]]
            carries = [
                ()
                if j is None
                else (found[j].carries[:1] if j in found else side.carry(j, end, "at"))
                for j, end in zip(on, ends, strict=True)
            ]
            if on[0] is not None and on[1] is not None:
                found[k] = _between(k, (on[0], on[1]), (carries[0], carries[1]), window, side)
            elif on != (None, None):
                leaving = Leaving(window, kept=float(on[0] is None), least=STUB)
                found[k] = Going(leaving, carries[0] or carries[1])
            else:
                kept = _touched(k, list(found), scene)
                found[k] = Going(Leaving(window, kept=kept, least=STUB))
    if not levels:
        (k,) = cluster.members
        found[k] = _line_alone(k, cluster.parent, side)
    return found


def _between(
    k: int,
    on: tuple[int, int],
    carries: tuple[tuple[Carry, ...], tuple[Carry, ...]],
    window: tuple[float, float],
    side: Side,
) -> Going:
    """How a line goes both ends of which lie on something.

    It folds down onto that, or goes to its middle; from both ends, its halves would meet in a seam,
    or break into prongs. A slash is drawn as one draws it.
    """
    item = side.scene.items[k]
    ends = item.outer.curves[[0, -1], [0, 3]]
    if np.abs(ends[1] - ends[0]).max() < ON * item.width:  # a loop
        return Going(Leaving(window, ends[0], least=STUB), carries[0])
    fold = fold_onto(k, on[0], side) if on[0] == on[1] else None
    if fold is not None:
        return Going(Leaving(window), carries[0] if fold.anchor is None else (), fold=fold)
    mated = any(axis.mates[k] >= 0 for axis in side.scene.axes)
    if mated or not (side.end is End.TARGET and _slashes(k, None, side)):
        apart = all(j in side.anchors for j in on)
        spanned = carries[0] + carries[1] if apart else carries[0]
        return Going(Leaving(window, kept=0.5, least=STUB), spanned)
    end = int(first_end(ends))
    return Going(Leaving(window, kept=float(end), least=STUB), carries[end])


def _touched(k: int, others: Sequence[int], scene: Scene) -> float:
    """Share of a line at which others touch it."""
    import shapely

    places = Places(scene.items[k].outer)
    touched = [scene.items[j].drawn for j in others if scene.touching[k, j]]
    shared = shapely.intersection(scene.items[k].drawn, shapely.union_all(touched))
    if shared.is_empty:
        return 0.5
    middle = np.array([[shared.centroid.x, shared.centroid.y]])
    return float(places.nearest(middle)[0])


def _line_alone(k: int, parent: int | None, side: Side) -> Going:
    """A line that no end of lies on anything.

    A slash takes its time, as the gaps that it cuts open with it. A line across one that stays
    goes into where they cross. Any other is drawn from the end that is next to something, or as
    one writes, from the left or from the foot; on a mirror axis of all such from its middle.
    """
    scene, item = side.scene, side.scene.items[k]
    crossed = _crossed(k, parent, side)
    anchor = parent if parent is not None else nearest_beside((k,), side)
    ends = item.outer.curves[[0, -1], [0, 3]]
    window, steady = side.window, _slashes(k, parent, side)
    if steady:
        kept = first_end(ends)
        window = _longer(window, item, scene)
    else:
        kept = _kept(k, parent, anchor, side)
    place = Places(item.outer).point(np.array([kept]))[0]
    if parent is None and crossed:
        anchor = crossed[0]
    how: Literal["at", "beside"] = "at" if parent is not None or crossed else "beside"
    carries = side.carry(anchor, place, how) if not steady else ()
    leaving = Leaving(window, kept=kept, least=0.0 if steady else STUB, steady=steady)
    return Going(leaving, carries)


def _slashes(k: int, parent: int | None, side: Side) -> bool:
    """Whether a line runs across what stays, or through gaps of the other drawing."""
    import shapely

    item = side.scene.items[k]
    if any(shapely.distance(item.drawn, gap.drawn) <= 0 for gap in side.gaps):
        return True
    if parent is not None or not isinstance(side.scene.forms[k], Segment):
        return False
    stays = [side.scene.items[j].drawn for j in side.anchors if not side.scene.sheets[j]]
    if not stays or item.length < LONG * side.scene.scale:
        return False
    ends = item.outer.curves[[0, -1], [0, 3]]
    if np.abs(ends[1] - ends[0]).min() < SLANTED * item.length:
        return False
    line = shapely.LineString(ends)
    drawn = shapely.union_all(stays)
    within = shapely.intersection(line, shapely.convex_hull(drawn))
    crossed = shapely.intersection(line, drawn)
    once = not crossed.is_empty and shapely.get_num_geometries(crossed) == 1
    return bool(within.length > ACROSS * line.length and not once)


def _crossed(k: int, parent: int | None, side: Side) -> list[int]:
    """What stays and touches a line, but what that lies in or is drawn round."""
    apart = (parent, int(side.scene.outlined[k]))
    return [
        j
        for j in side.anchors
        if side.scene.touching[k, j] and j not in apart and not side.scene.sheets[j]
    ]


def _kept(k: int, parent: int | None, anchor: int | None, side: Side) -> float:
    """The share of a line that stays longest."""
    scene, item = side.scene, side.scene.items[k]
    crossed = _crossed(k, parent, side)
    if crossed:
        return _touched(k, crossed, scene)
    ends = item.outer.curves[[0, -1], [0, 3]]
    near = nearer_end(ends, anchor, scene) if parent is None and anchor is not None else None
    if near is not None:
        return float(near)
    others = [
        j
        for j in range(len(scene.items))
        if j != k
        and j not in side.anchors
        and is_line(j, scene)
        and scene.parents[j] == scene.parents[k]
    ]
    if any(all(axis.mates[j] == j for j in (k, *others)) for axis in scene.axes):
        return 0.5
    if parent is not None and scene.items[parent].filled and _is_plain(k, scene):
        return 0.5
    if side.end is End.SOURCE and isinstance(scene.forms[k], Segment):
        return 0.5
    for axis in scene.axes:
        if axis.flips == 0 and axis.mates[k] not in (-1, k) and item.centre[0] > axis.place:
            return first_end(ends * np.array([-1.0, 1.0]))  # as the mirror image of its mate
    return first_end(ends)


def _is_plain(k: int, scene: Scene) -> bool:
    """Whether a line has no corner, as a mouth or a brow: ticks are drawn as one writes them."""
    form = scene.forms[k]
    return isinstance(form, Segment) or (isinstance(form, OpenLine) and not len(form.corners))


def first_end(ends: Points) -> float:
    """The end of a line that one draws it from: the left one, of an upright line the lower one."""
    way = ends[1] - ends[0]
    upright = abs(way[0]) < 0.2 * abs(way[1])
    return float(way[1] > 0) if upright else float(way[0] < 0)


def _longer(window: tuple[float, float], item: Item, scene: Scene) -> tuple[float, float]:
    """A window that is longer for a long line."""
    long = (item.length / scene.scale - LONG) / (LONGEST - LONG)
    more = LONGER * float(np.clip(long, 0.0, 1.0))
    low, high = window
    return (low, high + more) if low == 0.0 else (max(low - more, 0.0), high)
