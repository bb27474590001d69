"""Outlines as equal steps of arc length, from a start and in a size that geometry alone decides.

Everything here is the same for one curve whatever its unit, place, start point or cuts.
"""

from dataclasses import dataclass

import numpy as np

from shapetween.base.arrays import Points
from shapetween.geometry.bezier import bernstein
from shapetween.match.moments import area_moments
from shapetween.model.arclength import ArcLength, arc_length
from shapetween.model.outline import Outline

__all__ = ["SAMPLES", "Samples", "sample"]

#: Samples of an outline from which its features are read. Fewer blur what is 1 % of the outline;
#: the medial radii take time with the square.
SAMPLES = 384

#: Direction in which the canonical start lies farthest. An odd angle: a side that stands square to
#: it, where the farthest point would be undecided, is not drawn by hand or by grid.
START_DIRECTION = np.array([np.cos(4.0), np.sin(4.0)])


@dataclass(frozen=True, slots=True, eq=False)
class Samples:
    """One outline sampled.

    Attributes
    ----------
    arcs : ArcLength
    size : float
        Root of the area, in user units.
    start : float
        Fraction of the length at which the samples start.
    points : (SAMPLES, 2) float64
        Centroid at 0, area 1.
    """

    arcs: ArcLength
    size: float
    start: float
    points: Points


def sample(outline: Outline) -> Samples:
    """Sample a closed outline of positive area."""
    arcs = arc_length(outline)
    area, centroid, _ = area_moments(outline.curves)
    start = canonical_start(arcs)
    size = float(np.sqrt(area))
    points = arcs.point(start + np.arange(SAMPLES) / SAMPLES)
    return Samples(arcs, size, start, (points - centroid) / size)


def canonical_start(arcs: ArcLength) -> float:
    """Place of the outline's farthest point in `START_DIRECTION`.

    Each curve's candidates are its start and the roots of a quadratic, so the answer is exact.
    """
    heights = (arcs.outline.curves - arcs.outline.curves[0, 0]) @ START_DIRECTION
    first, second, third = np.diff(heights, axis=1).T
    # Derivative of the height over 3: first (1-t)^2 + 2 second t (1-t) + third t^2.
    a, b, c = first - 2 * second + third, second - first, first
    root = np.sqrt(np.maximum(b * b - a * c, 0.0))
    q = -(b + np.where(b < 0, -root, root))
    with np.errstate(divide="ignore", invalid="ignore"):
        roots = np.stack([q / a, c / q], axis=1)
    roots = np.where((roots > 0) & (roots < 1), roots, 0.0)  # NaN compares false
    t = np.concatenate([np.zeros((len(a), 1)), roots], axis=1)
    reach = (bernstein(t) * heights[:, None]).sum(axis=-1)
    # Of the equally far ones, but for rounding, the first along a fixed second direction.
    span = np.ptp(heights)
    curve, which = np.nonzero(reach >= reach.max() - 1e-12 * span)
    places = arcs.fraction(curve, t[curve, which])
    if len(places) == 1:
        return float(places[0])
    across = arcs.point(places) @ [-START_DIRECTION[1], START_DIRECTION[0]]
    return float(places[np.lexsort((places, np.round(across / span, 9)))[0]])
