"""Rings that come round what stays: they are drawn from their head down both sides."""

from collections.abc import Sequence

import numpy as np

from shapetween.base.ends import End
from shapetween.geometry.bezier import flatten
from shapetween.scene.items import Item
from shapetween.scene.places import Places
from shapetween.scene.unmatched.going import Going, Side
from shapetween.scene.unmatched.presence import Leaving

__all__ = ["encircling_going"]

#: How far what stays within a ring reaches, as a share of how far that does, from which on the ring
#: is drawn round it. Smaller, and a ring that could grow from a dot is drawn; larger, and rings cut
#: through what is in them.
SMALL = 0.35

#: Widths of its stroke by which what is in a ring keeps off it. At 0 both touch; larger, and what
#: fills its ring is waited for until the end.
OFF = 0.75

#: Latest time at which a ring begins to come. Later, and it snaps.
LATEST = 0.62

#: Share of a ring's length at which it is first seen. With none it is a dot first.
STUB = 0.08

#: Times at which what is inside is looked at.
LOOKED = np.linspace(0.0, 1.0, 17)


def encircling_going(members: Sequence[int], side: Side) -> Going | None:
    """How a ring goes that has in it what stays; None of what may grow from its middle."""
    scene = side.scene
    item = scene.items[members[0]]
    if len(members) > 1 or item.filled or not item.closed:
        return None
    inside = [
        j
        for j in side.anchors
        if not scene.sheets[j] and item.enclosed.contains(scene.items[j].drawn)
    ]
    if not inside or not _reaches(item, [scene.items[j] for j in inside]):
        return None
    low, high = side.window
    clear = _clear_from(item, inside, side)
    if side.end is End.TARGET:
        window = max(low, min(clear, LATEST)), high
    else:
        window = low, min(high, max(1 - clear, 1 - LATEST))
    return Going(Leaving(window, kept=0.5, least=STUB), cut=_foot(item))


def _reaches(item: Item, inside: Sequence[Item]) -> bool:
    """Whether some items reach so far that a ring that grew from its middle would cut them."""
    import shapely

    reach = float(shapely.Point(item.centre).distance(item.enclosed.boundary))
    corners = shapely.get_coordinates(shapely.union_all([other.drawn for other in inside]))
    far = float(np.linalg.norm(corners - item.centre, axis=1).max())
    return far >= SMALL * reach


def _clear_from(item: Item, inside: Sequence[int], side: Side) -> float:
    """Share of the way home from which on all that is in a ring keeps off it."""
    import shapely

    free = item.enclosed.buffer(-OFF * item.width)
    shapely.prepare(free)
    at = LOOKED if side.end is End.TARGET else LOOKED[::-1]
    within = np.ones(len(at), dtype=bool)
    for j in inside:
        for track in side.anchors[j]:
            points = flatten(track.curves(at), 4)
            off = side.scene.items[j].width / 2
            own = [float(shapely.distance(free.boundary, shapely.LineString(p))) for p in points]
            held = shapely.contains_xy(free, points[..., 0], points[..., 1]).all(axis=1)
            within &= held & (np.array(own) >= off)
    if within.all():
        return 0.0
    last = int(np.flatnonzero(~within)[-1])
    return float(LOOKED[min(last + 1, len(at) - 1)])


def _foot(item: Item) -> float:
    """Share of a ring's length at its foot, where it is cut: the lowest point in its middle."""
    low, high = item.box
    below = np.array([[(low[0] + high[0]) / 2, high[1]]])
    return float(Places(item.outer).nearest(below)[0])
