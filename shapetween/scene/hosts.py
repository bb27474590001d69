"""Things that stand still with others on them: folders, cards, pages and frames."""

import numpy as np

from shapetween.base.arrays import Mask, Points
from shapetween.scene.relations import Scene

__all__ = ["lies_on", "stands_still"]

#: Way of the middle, as a share of the drawing, and logarithm of width and of height, up to which
#: a thing stands still. Larger, and the lens of a camera leaves the body that becomes a tower;
#: smaller, and the digits on a calendar drawn anew go each by itself.
WAY, SIDES = 0.06, 0.25

#: Share of a thing that is over what it lies on. Larger, and a badge at a corner is beside it;
#: smaller, and a handle on its rim lies on it.
OVER = 0.5

#: Greatest size of a thing, as a share of what it lies on. Larger, and the front of a folder is a
#: sign on its back; smaller, and a badge that covers most of a folder is none.
SMALLER = 0.8


def stands_still(first: Points, second: Points, scale: float) -> bool:
    """Whether a box (2, 2) is nearly where another one is, and as large."""
    way = float(np.linalg.norm(first.mean(axis=0) - second.mean(axis=0)))
    sides = [np.maximum(box[1] - box[0], 1e-9 * scale) for box in (first, second)]
    growth = float(np.abs(np.log(sides[0] / sides[1])).max())
    return round(way / scale, 6) <= WAY and round(growth, 6) <= SIDES


def lies_on(scene: Scene, host: int) -> Mask:
    """Which items lie on another one, mostly, and are painted after it, (N,)."""
    import shapely

    ground = scene.items[host].enclosed
    places = np.arange(len(scene.items))
    # What is painted before a fill is behind it.
    may = ~scene.sheets & ((places > host) | (not scene.items[host].filled))
    may &= places != host
    low, high = ground.bounds[:2], ground.bounds[2:]
    bounds = shapely.bounds(scene.drawn)
    may &= (bounds[:, :2] < high).all(axis=1) & (bounds[:, 2:] > low).all(axis=1)
    for k in np.flatnonzero(may & (scene.outlined == host)):
        may[k] = not scene.items[k].closed
    near = np.flatnonzero(may)
    if not len(near):
        return np.asarray(may)
    enclosed = np.array([shapely.area(scene.items[k].enclosed) for k in near])
    over = shapely.area(shapely.intersection(scene.drawn[near], ground))
    own = shapely.area(scene.drawn[near])
    on_it = np.round(over / np.maximum(own, 1e-300), 6) > OVER
    on_it &= np.round(enclosed / ground.area, 6) < SMALLER
    may[near] = on_it
    return np.asarray(may)
