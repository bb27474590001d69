"""What an outline looks like from each of its points: turning, thickness, surroundings."""

from dataclasses import dataclass

import numpy as np

from shapetween.base.arrays import Floats, Points
from shapetween.geometry.polygon import cross
from shapetween.match.sampling import SAMPLES

__all__ = ["CONTEXT_STEP", "TURN_WINDOWS", "Features", "contexts", "describe", "unit"]

#: Half-widths of the windows the turning is measured in, as shares of the length.
TURN_WINDOWS = (1 / 96, 1 / 48, 1 / 24, 1 / 12, 1 / 6)

#: Largest medial radius worth telling from infinity, in roots of the area.
MAX_RADIUS = 3.0

#: Share of the sample measure that follows the bends, the rest being even. More starves long
#: plain sides of samples, less leaves corners to chance.
BEND_SHARE = 0.6

#: Rings and sectors of a shape context, and its least and greatest radius in mean distances.
RINGS, SECTORS, NEAREST, FARTHEST = 5, 12, 1 / 8, 2.0

#: Every how many-th sample counts in a context.
CONTEXT_STEP = SAMPLES // 96

#: Half-width of the arc whose middle an apex points away from, in samples: wide enough to see
#: the end of a limb as one.
APEX_REACH = SAMPLES // 32

#: Height of an apex, in roots of the area, below which it fades: a straight side has no direction
#: but rounding's.
STRAIGHT = 0.01

#: Samples on either side of one that no disc is touched at.
BESIDE = 2

#: Samples whose discs are found at once. With more, the tables no longer stay in the processor's
#: cache.
BLOCK = 48


@dataclass(frozen=True, slots=True, eq=False)
class Features:
    """Read at every sample of one outline, all independent of its unit and place.

    Attributes
    ----------
    turns : (5, N) float64
        Signed turn between the chords over each of `TURN_WINDOWS` before and after.
    tangents : (N, 2) float64
        Unit vectors.
    apexes : (N, 2) float64
        Directions from the middle of the arc about the sample to the sample, of length 1 but
        where the outline is straight.
    inside, outside : (N,) float64
        Radius of the largest disc that touches the outline here on that side, in roots of the
        area, at most `MAX_RADIUS`.
    measure : (N + 1,) float64
        From 0 to 1: samples are set at equal steps of it, closer where the outline bends.
    """

    turns: Floats
    tangents: Points
    apexes: Points
    inside: Floats
    outside: Floats
    measure: Floats


def describe(points: Points) -> Features:
    """Features of evenly spaced points of a closed outline of area 1."""
    count = len(points)
    turns = np.stack([_turning(points, round(share * count)) for share in TURN_WINDOWS])
    tangents = unit(np.roll(points, -1, axis=0) - np.roll(points, 1, axis=0))
    around = np.roll(points, APEX_REACH, axis=0) + np.roll(points, -APEX_REACH, axis=0)
    apexes = points - around / 2
    inside, outside = _touching_discs(points, tangents)
    bend = np.abs(turns[1:3]).mean(axis=0)
    density = (1 - BEND_SHARE) / count + BEND_SHARE * bend / bend.sum()
    # Trapezoids, so that the measure is as smooth as the density.
    steps = (density + np.roll(density, -1)) / 2
    measure = np.concatenate([[0.0], np.cumsum(steps)])
    return Features(
        turns=turns,
        tangents=tangents,
        apexes=apexes / np.hypot(STRAIGHT, np.linalg.norm(apexes, axis=1, keepdims=True)),
        inside=inside,
        outside=outside,
        measure=measure / measure[-1],
    )


def unit(vectors: Points) -> Points:
    """Vectors scaled to length 1; those of no length stay."""
    size = np.linalg.norm(vectors, axis=-1, keepdims=True)
    return np.asarray(vectors / np.where(size > 0, size, 1.0))


def contexts(points: Points, surroundings: Points, axes: Points | None = None) -> Floats:
    """Histograms of the surroundings of points, square-rooted.

    Parameters
    ----------
    points : (n, 2) float64
    surroundings : (m, 2) float64
        What is counted.
    axes : (n, 2) float64, optional
        Unit vector of angle 0 at each point; that of the frame unless given.

    Returns
    -------
    (n, RINGS * SECTORS) float64
        Unit vectors, so that their products are the histograms' likeness (Hellinger).

    Notes
    -----
    Shape contexts (Belongie, Malik, Puzicha 2002) over log radius and angle, with votes shared
    bilinearly between neighbouring bins.
    """
    x, y = (surroundings[:, k] - points[:, k, None] for k in (0, 1))
    if axes is not None:
        along, across = axes[:, :1], axes[:, 1:]
        x, y = x * along + y * across, along * y - across * x
    # In place from here on: the tables are large, and new ones cost more than what is in them.
    sector = np.arctan2(y, x)
    sector *= SECTORS / (2 * np.pi)
    sector += SECTORS / 2
    x *= x
    y *= y
    x += y
    mean = np.sqrt(x).mean()
    low = np.log(NEAREST)
    scale = (RINGS - 1) / (np.log(FARTHEST) - low)
    # A spare ring on either side takes what is not seen: the point itself, and what lies far off.
    ring = np.log(np.maximum(x, (1e-6 * mean) ** 2, out=x), out=x)
    ring *= scale / 2
    ring -= (low + np.log(mean)) * scale
    np.clip(ring, -1, RINGS, out=ring)
    ring += 1
    # Rings and sectors that a vote may be shared with; the last two sectors are the first ones.
    rings, sectors = RINGS + 3, SECTORS + 2
    whole, part = np.floor(ring), np.floor(sector)
    outer, later = np.subtract(ring, whole, out=ring), np.subtract(sector, part, out=sector)
    whole += np.arange(len(points))[:, None] * rings
    whole *= sectors
    whole += part
    where = whole.astype(np.intp).ravel()
    both = outer * later
    outer -= both
    later -= both
    votes = np.zeros(len(points) * rings * sectors)
    for first, share in (
        (0, 1 - both - outer - later),
        (1, later),
        (sectors, outer),
        (sectors + 1, both),
    ):
        votes[first:] += np.bincount(where, share.ravel(), len(votes))[: len(votes) - first]
    kept = votes.reshape(len(points), rings, sectors)[:, 1:-2]
    kept[..., :2] += kept[..., SECTORS:]
    kept = kept[..., :SECTORS].reshape(len(points), -1)
    # No bin is quite empty: the root would make a vote's rounding error large.
    kept += 1e-6
    return np.asarray(np.sqrt(kept / kept.sum(axis=1, keepdims=True)))


def _turning(points: Points, reach: int) -> Floats:
    """Signed angle between the chords of `reach` samples before and after each point."""
    before = points - np.roll(points, reach, axis=0)
    after = np.roll(points, -reach, axis=0) - points
    return np.asarray(np.arctan2(cross(before, after), (before * after).sum(-1)))


def _touching_discs(points: Points, tangents: Points) -> tuple[Floats, Floats]:
    """Radius of the largest empty disc that touches at each point, inside and outside."""
    count = len(points)
    px, py = points.T
    # Neighbours say how the outline is sampled, not how thick the shape is.
    beside = (np.arange(count)[:, None] + np.arange(-BESIDE, BESIDE + 1)) % count
    inside, outside = np.zeros(count), np.zeros(count)
    for first in range(0, count, BLOCK):
        block = np.s_[first : first + BLOCK]
        x, y = px - px[block, None], py - py[block, None]
        height = y * tangents[block, :1]
        height -= x * tangents[block, 1:]
        x *= x
        y *= y
        x += y
        np.put_along_axis(x, beside[block], np.inf, axis=1)
        # Nor do points in one place, where an outline runs back along itself.
        np.putmask(x, x == 0, np.inf)
        height /= x  # half the curvature of the disc
        inside[block], outside[block] = height.max(axis=1), -height.min(axis=1)
    least = 0.5 / MAX_RADIUS
    return 0.5 / np.maximum(inside, least), 0.5 / np.maximum(outside, least)
