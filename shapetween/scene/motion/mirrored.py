"""Rings that are their own mirror images, and stay so while they move."""

import numpy as np

from shapetween.base.arrays import Floats
from shapetween.scene.motion.bend_knots import half_knots, ring_knots
from shapetween.scene.places import Places

__all__ = ["axis_crossings", "even_knots", "mirrored_knots"]

#: Distance of the halves of a ring from each other's mirror images, as a share of its extent, up to
#: which it moves as one that is symmetric. More, and a flame loses its tip, which is off its axis.
UNEVEN = 0.03


def mirrored_knots(source: Places, target: Places, flips: int) -> tuple[Floats, Floats] | None:
    """Knots of two rings, themselves mirror images; None where one of the rings is none.

    Parameters
    ----------
    source, target : Places
        Closed, both clockwise.
    flips : int
        0 about an upright axis, 1 about a level one.
    """
    crossings = axis_crossings(source, flips), axis_crossings(target, flips)
    if crossings[0] is None or crossings[1] is None:
        return None
    if not (_even(source, crossings[0], flips) and _even(target, crossings[1], flips)):
        return None
    return half_knots(source, target, crossings[0], crossings[1])


def even_knots(source: Places, target: Places) -> tuple[Floats, Floats]:
    """Knots of two rings, themselves mirror images where both rings are, about one direction."""
    for flips in (0, 1):
        knots = mirrored_knots(source, target, flips)
        if knots is not None:
            return knots
    return ring_knots(source, target)


def _even(places: Places, half: tuple[float, float], flips: int) -> bool:
    """Whether the two halves of a ring are each other's mirror images, all but a little."""
    low, high = half
    part = np.linspace(0.0, 1.0, 33)[1:-1]
    there = places.point(low + (high - low) * part)
    back = places.point(low - (1 - (high - low)) * part)
    middle = places.point(np.array([low]))[0, flips]
    back[:, flips] = 2 * middle - back[:, flips]
    extent = float(np.ptp(places.outline.curves.reshape(-1, 2), axis=0).max())
    return bool(np.linalg.norm(there - back, axis=1).max() <= UNEVEN * extent)


def axis_crossings(places: Places, flips: int) -> tuple[float, float] | None:
    """Where a ring crosses the middle of its box, first and last, as increasing shares."""
    middle = places.outline.box.mean(axis=0)
    steps = 8 * 48
    shares = np.arange(steps + 1) / steps
    shares = np.union1d(shares, places.joints)
    points = places.point(shares)
    side = points[:, flips] - middle[flips]
    side[np.abs(side) < 1e-9 * float(np.ptp(points, axis=0).max())] = 0.0
    sign = np.sign(side)
    off = np.flatnonzero(sign[:-1])
    found = []
    following = np.append(off[1:], off[:1] + len(sign) - 1)
    for k, after in zip(off.tolist(), following.tolist(), strict=True):
        if sign[k] * sign[after % (len(sign) - 1)] > 0:
            continue
        if after > k + 1:  # places on the axis lie between
            found.append(float(shares[(k + after) // 2 % (len(sign) - 1)]))
            continue
        # Halved until rounding: what is a little off the axis leans.
        low, high = shares[k], shares[k + 1]
        for _ in range(40):
            half = (low + high) / 2
            there = places.point(np.array([half]))[0, flips] - middle[flips]
            low, high = (half, high) if there * sign[k] > 0 else (low, half)
        found.append(float((low + high) / 2))
    if len(found) < 2:
        return None
    along = places.point(np.array(found))[:, 1 - flips]
    first, last = found[int(along.argmin())], found[int(along.argmax())]
    return first, last + (last < first)
