"""What a pair keeps to as it moves: the outline of an area, and what the ends of lines lie on."""

import numpy as np

from shapetween.base.arrays import Index
from shapetween.model.part import CurveTrack
from shapetween.scene.assign import Roles
from shapetween.scene.motion.carried import Carried, Junction, JunctionConstraint
from shapetween.scene.motion.tracks import Blend
from shapetween.scene.relations import Scene

__all__ = ["MOST_ENDS", "kept_to"]

#: Distance of a line's end from what it lies on, in widths.
ON = 0.35

#: Most pairs of a drawing of which lines keep to what they end on: each end is looked for on all
#: other lines. Fewer, and the lines of a large icon come apart; more take longer than is worth it.
MOST_ENDS = 400


def kept_to(
    k: int,
    found: tuple[CurveTrack, ...],
    a: Scene,
    b: Scene,
    roles: Roles,
    known: dict[int, tuple[CurveTrack, ...]],
) -> tuple[CurveTrack, ...]:
    """The tracks of one pair, kept to those pairs' that are known already.

    Parameters
    ----------
    k : int
        Which pair.
    found : tuple of CurveTrack
        Its own.
    a, b : Scene
    roles : Roles
    known : dict of int to tuple of CurveTrack
    """
    role = roles.pairs[k]
    one, other = a.items[role.first], b.items[role.second]
    if one.filled or other.filled or len(found) != 1:
        return found
    (track,) = found
    partner = {(pair.first, pair.second): m for m, pair in enumerate(roles.pairs)}
    anchor = partner.get((int(a.outlined[role.first]), int(b.outlined[role.second])))
    if anchor is not None and anchor in known and isinstance(track, Blend):
        return (Carried(track.pieces, known[anchor][0], (a.scale + b.scale) / 2),)
    if one.closed or other.closed or len(roles.pairs) > MOST_ENDS:
        return found
    junctions = []
    for last in (False, True):
        ends = track.curves(np.array([0.0, 1.0]))
        points = ends[:, -1, 3] if last else ends[:, 0, 0]
        anchors = [_under(role.first, points[0], a), _under(role.second, points[1], b)]
        for m in known:
            pair = roles.pairs[m]
            if pair.first in anchors[0] and pair.second in anchors[1]:
                junctions.append(Junction.of(track, last, known[m][0]))
                break
    return (JunctionConstraint(track, tuple(junctions)),) if junctions else found


def _under(k: int, point: Index, scene: Scene) -> list[int]:
    """Lines whose path a point of item `k` lies on."""
    import shapely

    place = shapely.Point(point)
    found = []
    for j in np.flatnonzero(scene.touching[k]).tolist():
        item = scene.items[j]
        if j == k or item.filled:
            continue
        reach = ON * max(item.width, scene.items[k].width)
        if shapely.distance(shapely.LineString(item.points), place) <= reach:
            found.append(j)
    return found
