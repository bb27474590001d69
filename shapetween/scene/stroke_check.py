"""Whether a stroke's outline stays one of a stroke while its line moves."""

from typing import TYPE_CHECKING

import numpy as np

from shapetween.base.arrays import Curves, Floats
from shapetween.geometry.bezier import flatten

if TYPE_CHECKING:
    import shapely

__all__ = ["LOOKED", "strays"]

#: Times on the way at which a stroke's outline is compared with its line's. Of fewer, a spike that
#: comes and goes is missed.
LOOKED = np.array([0.1, 0.2, 0.35, 0.5, 0.65, 0.8, 0.9])

#: Chords of a curve: a stroke's outline has many short ones.
CHORDS = 4

#: Share of the stroke by which its outline may differ on the way, beyond what it does at the ends.
#: Larger, and splinters beside the line are seen; smaller, and corners that are drawn sharper or
#: rounder than a pen would count as faults.
STRAYED = 0.08


def strays(lines: Curves, outlines: Curves, counts: tuple[int, ...], widths: Floats) -> bool:
    """Whether a moving stroke's outline leaves the line that it is the outline of.

    Parameters
    ----------
    lines : (F, N, 4, 2) float64
        The line at both ends and between them.
    outlines : (F, M, 4, 2) float64
        The outline at the same times, ring after ring.
    counts : tuple of int
        Curves of each ring.
    widths : (F,) float64
        Of the stroke.
    """
    apart = [
        _apart(line, outline, counts, width)
        for line, outline, width in zip(lines, outlines, widths.tolist(), strict=True)
    ]
    return max(apart[1:-1]) > max(apart[0], apart[-1]) + STRAYED


def _apart(line: Curves, outline: Curves, counts: tuple[int, ...], width: float) -> float:
    """Area of which only one of a stroke and its outline covers, as a share of the stroke's."""
    import shapely

    points = np.concatenate([flatten(line, CHORDS), line[-1:, 3]])
    stroke = shapely.LineString(points).buffer(width / 2)
    drawn = _inside(outline, counts)
    return float(stroke.symmetric_difference(drawn).area / stroke.area)


def _inside(outline: Curves, counts: tuple[int, ...]) -> "shapely.Geometry":
    """What rings cover by the rule even-odd."""
    import shapely

    covered: shapely.Geometry = shapely.Polygon()
    for ring in np.split(outline, np.cumsum(counts)[:-1]):
        area = shapely.make_valid(shapely.Polygon(flatten(ring, CHORDS)))
        covered = covered.symmetric_difference(area)
    return covered
