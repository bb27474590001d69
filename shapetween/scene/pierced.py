"""Single areas with holes: where they are unlike, nobody could follow one to the other."""

from collections.abc import Sequence

import numpy as np

from shapetween.base.arrays import Floats
from shapetween.geometry.bezier import signed_area
from shapetween.model.part import CurveTrack
from shapetween.scene.disturbance import MANY_HOLES
from shapetween.scene.doubtful import CONVEX, filling, nothing_corresponds, own_matching
from shapetween.scene.items import Item
from shapetween.scene.motion.choose import corner_tracks
from shapetween.scene.motion.mouths import mouth_track
from shapetween.scene.relations import in_common, pictures

__all__ = ["opens_well", "pierced", "pierced_apart", "suits_lines"]

#: Unlikeness of the outer outlines of two single areas, one with a hole at least, from which on
#: they are exchanged: of 44 such pairs judged by eye none above looked well as it moved, of those
#: below most did. Smaller, and a bag leaves for a pin to come; larger, and letters' bowls tear.
PIERCED = 0.47

#: Doubt of the outlines' own matching from which on they are if one has more holes than the other.
#: Smaller, and an eight leaves for an O to come; larger, and a six is a blot before it is a B.
OTHERWISE_PIERCED = 0.8

#: How much more is painted on the way than at either end from which on it is a blot. Smaller, and
#: letters leave whose bowls move; larger, and a nine is a blot before it is a D.
BLOT = 1.25

#: Times that are looked at, the ends first and last.
LOOKED = np.linspace(0.0, 1.0, 7)

#: Unlikeness of what is painted up to which a hole opens into a bay. Smaller, and a G comes for a
#: Q that leaves; larger, and an R is torn to be a seven.
OPENS = 0.55

#: Share of what the outer outline encloses that holes take up from which on they count. Smaller,
#: and the eyelet of a pen makes a silhouette an area with holes; larger, and letters have none.
OPEN = 0.04


def pierced(one: Item, other: Item) -> bool:
    """Whether two are areas, one with a hole at least that is no mere eyelet."""
    return one.filled and other.filled and max(_open(one), _open(other)) >= OPEN


def pierced_apart(one: Item, other: Item) -> bool:
    """Whether two areas, one with a hole at least, are too unlike for one to become the other.

    Convex ones move well, however they lie, if there are not several holes to swim through.
    """
    if not pierced(one, other):
        return False
    few = max(len(one.holes), len(other.holes)) < MANY_HOLES
    if few and min(filling(one), filling(other)) > CONVEX:
        return False
    if nothing_corresponds(one, other):
        return True
    if len(one.holes) != len(other.holes):
        matching = own_matching(one.outer.clockwise(), other.outer.clockwise())
        if matching is None or round(matching.doubt, 6) > OTHERWISE_PIERCED:
            return True
    found = pictures([item.replaced(item.rings[:1]) for item in (one, other)])
    return 1 - float(in_common(found[:1], found[1:])[0, 0]) > PIERCED or _blots(one, other)


def _blots(one: Item, other: Item) -> bool:
    """Whether holes close on the way so that most of what was open is painted."""
    outer, *holes = corner_tracks(one, other)
    painted = abs(_areas(outer)) - sum(abs(_areas(track)) for track in holes)
    return bool(np.round(painted.max() / max(painted[0], painted[-1]), 6) > BLOT)


def _areas(track: CurveTrack) -> Floats:
    """What a ring encloses at the times that are looked at."""
    return np.array([signed_area(curves) for curves in track.curves(LOOKED)])


def suits_lines(one: Item, other: Item, lines: tuple[Sequence[Item], Sequence[Item]]) -> bool:
    """Whether two areas move well as the one line that each of them is.

    Where a line touches itself in one of them alone, what is painted tears.
    """
    if any(side[0].filled for side in lines):
        return False
    return len(one.holes) == len(other.holes) or lines[0][0].closed != lines[1][0].closed


def opens_well(one: Item, other: Item) -> bool:
    """Whether a hole of one area opens to be a bay of the other, and the rest is alike."""
    found = pictures([one, other])
    unlike = 1 - float(in_common(found[:1], found[1:])[0, 0])
    return round(unlike, 6) < OPENS and mouth_track(one, other) is not None


def _open(item: Item) -> float:
    """Share of what an item encloses that is hole."""
    enclosed = item.enclosed.area
    return float(1 - item.area / enclosed) if enclosed > 0 else 0.0
