"""Rings that are their own mirror images, and stay so while they move."""

import numpy as np

from shapetween.base.arrays import Floats
from shapetween.scene.motion.bend_knots import half_knots
from shapetween.scene.places import Places

__all__ = ["axis_crossings", "even_knots", "mirrored_knots"]

#: Distance of the halves of a ring from each other's mirror images, as a share of its extent, up to
#: which it moves as one that is symmetric. More, and a flame loses its tip, which is off its axis.
UNEVEN = 0.03

#: How often a step over the axis is halved. Fewer and a ring that is symmetric moves a little
#: askew; more are below rounding.
HALVINGS = 40


def mirrored_knots(source: Places, target: Places, flips: int) -> tuple[Floats, Floats] | None:
    """Knots of two rings, themselves mirror images; None where one of the rings is none.

    Parameters
    ----------
    source, target : Places
        Closed, both clockwise.
    flips : int
        0 about an upright axis, 1 about a level one.
    """
    crossings = []
    for places in (source, target):
        half = axis_crossings(places, flips)
        if half is None or not _even(places, half, flips):
            return None
        crossings.append(half)
    return half_knots(source, target, *crossings)


def even_knots(source: Places, target: Places) -> tuple[Floats, Floats] | None:
    """Knots of two rings that both are their own mirror images about one direction, if they are."""
    for flips in (0, 1):
        knots = mirrored_knots(source, target, flips)
        if knots is not None:
            return knots
    return None


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
    following = np.append(off[1:], off[:1] + len(sign) - 1)
    over = sign[off] * sign[following % (len(sign) - 1)] <= 0
    off, following = off[over], following[over]
    if len(off) < 2:
        return None
    # Places on the axis lie between, or else the step is halved until rounding: what is a little
    # off the axis leans.
    found = shares[(off + following) // 2 % (len(sign) - 1)]
    next_to = following <= off + 1
    low, high = shares[off[next_to]], shares[off[next_to] + 1]
    for _ in range(HALVINGS):
        half = (low + high) / 2
        there = places.point(half)[:, flips] - middle[flips]
        before = there * sign[off[next_to]] > 0
        low, high = np.where(before, half, low), np.where(before, high, half)
    found[next_to] = (low + high) / 2
    along = places.point(found)[:, 1 - flips]
    first, last = float(found[along.argmin()]), float(found[along.argmax()])
    return first, last + (last < first)
