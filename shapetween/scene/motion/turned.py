"""A ring that is another one turned, an arrow that points the other way: it turns in place."""

import numpy as np

from shapetween.geometry.bezier import flatten
from shapetween.match.frames import MIN_TURN
from shapetween.match.matcher import registered
from shapetween.match.moments import area_moments
from shapetween.scene.items import intersection_over_union
from shapetween.scene.motion.tracks import Blend
from shapetween.scene.places import Places, cut_alike

__all__ = ["turned_ring"]

#: Greatest ratio of the stretches of a ring that turns in place. Larger, and an oval tumbles to
#: stand upright; at 1 rounding decides.
SQUEEZED = 1.1

#: How many times more area one ring may enclose for its length, to be looked at. Smaller, and
#: rounding decides; larger, and time goes by on rings that are nothing alike.
ROUNDER = 1.1


#: Chords of each curve by which that is seen.
CHORDS = 8

#: Share that both rings' areas have in common, middle on middle, from which on neither turns. At 1
#: a head that is round above rolls over to be round below; smaller, and a triangle that points
#: elsewhere is bent to it.
ALIKE = 0.75


def turned_ring(source: Places, target: Places) -> Blend | None:
    """The track of a ring that turns in place; None of others.

    Parameters
    ----------
    source, target : Places
        Closed, both clockwise.
    """
    sizes = [area_moments(places.outline.curves) for places in (source, target)]
    roundness = [
        area / max(places.length**2, 1e-300)
        for (area, _, _), places in zip(sizes, (source, target), strict=True)
    ]
    if min(roundness) <= 0 or max(roundness) > ROUNDER * min(roundness):
        return None
    exact = registered(source.outline, target.outline)
    if exact is None or abs(exact.turn) < MIN_TURN:
        return None
    stretches = np.linalg.svd(exact.matrix[:, :2], compute_uv=False)
    if stretches[0] > SQUEEZED * stretches[1]:
        return None
    if _alike(source, target):
        return None
    # Half a turn either way is one clockwise.
    turn = exact.turn + 2 * np.pi * (exact.turn < 1e-9 - np.pi)
    pieces = cut_alike(source, target, exact.u, exact.v)
    return Blend(pieces, np.stack([sizes[0][1], sizes[1][1]]), float(turn))


def _alike(source: Places, target: Places) -> bool:
    """Whether two rings lie on each other as they are, middle on middle."""
    import shapely
    import shapely.affinity

    areas = []
    for places in (source, target):
        area = shapely.make_valid(shapely.Polygon(flatten(places.outline.curves, CHORDS)))
        areas.append(shapely.affinity.translate(area, -area.centroid.x, -area.centroid.y))
    return intersection_over_union(*areas) > ALIKE
