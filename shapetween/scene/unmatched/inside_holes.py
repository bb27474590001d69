"""What lies in a hole that closes goes with that hole, and comes with one that opens."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from shapetween.base.ends import End
from shapetween.geometry.bezier import flatten
from shapetween.model.part import CurveTrack
from shapetween.scene.motion.holes import Opening
from shapetween.scene.motion.tracks import InTurn, Shared
from shapetween.scene.unmatched.going import Going, Side
from shapetween.scene.unmatched.presence import NEAR, Carry, Leaving

if TYPE_CHECKING:
    import shapely

__all__ = ["gone_with_hole"]


def gone_with_hole(members: Sequence[int], side: Side) -> dict[int, Going] | None:
    """How items go that lie in a hole without a partner; None of others.

    By themselves they would be run over by its border.
    """
    import shapely

    own = shapely.union_all([side.scene.items[k].drawn for k in members])
    for j, tracks in side.anchors.items():
        if not side.scene.items[j].holes:
            continue
        for track in tracks[1:]:
            hole = track.track if isinstance(track, Shared) else track
            window = side.window
            if isinstance(hole, InTurn):
                hole = hole.track
                window = (0.0, 0.5) if side.end is End.SOURCE else (0.5, 1.0)
            if not isinstance(hole, Opening) or hole.closes != (side.end is End.SOURCE):
                continue
            ring = _at_home(hole, side.end)
            if not ring.contains(own):
                continue
            middle = np.reshape(ring.bounds, (2, 2)).mean(axis=0)
            reach = NEAR * side.scene.scale
            going = Going(Leaving(window, middle), (Carry(track, middle, reach, side.end),))
            return dict.fromkeys(members, going)
    return None


def _at_home(hole: CurveTrack, end: End) -> "shapely.Geometry":
    """What a hole covers at one end."""
    import shapely

    points = flatten(hole.curves(np.array([float(end)])), 8)[0]
    return shapely.make_valid(shapely.Polygon(points))
