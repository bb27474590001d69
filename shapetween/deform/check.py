"""Whether outlines in motion stay simple."""

from collections.abc import Sequence

import numpy as np
import shapely

from shapetween.base.arrays import Curves, Mask, Points
from shapetween.geometry.bezier import flatten

__all__ = ["LOOKED", "crossing_frames", "simple_frames"]

#: Times at which rings that are only attached are checked. More are dear where there are hundreds.
LOOKED = np.linspace(0, 1, 11)[1:-1]

#: Chords of a curve of such a ring.
CHORDS = 4


def simple_frames(points: Points, rings: tuple[int, ...] | None = None) -> Mask:
    """Which frames show closed polylines that neither cross nor touch themselves or each other.

    Parameters
    ----------
    points : (F, M, 2) float64
        Points of all rings, one ring after the other.
    rings : tuple of int, optional
        Number of points of each ring; by default all are of one.

    Returns
    -------
    (F,) bool
    """
    frames, count, _ = points.shape
    sizes = rings or (count,)
    owner = np.repeat(np.arange(frames * len(sizes)), np.tile(sizes, frames))
    loops = shapely.linearrings(points.reshape(-1, 2), indices=owner)
    if len(sizes) == 1:
        return np.asarray(shapely.is_simple(loops))
    group = np.repeat(np.arange(frames), len(sizes))
    return np.asarray(shapely.is_simple(shapely.multilinestrings(loops, indices=group)))


def crossing_frames(curves: Curves, counts: Sequence[int], closed: Sequence[bool]) -> Mask:
    """In which frames one of the closed rings crosses itself; one may lie across another.

    Parameters
    ----------
    curves : (F, P, 4, 2) float64
        Curves of all rings, one ring after the other.
    counts : sequence of int
        Number of curves of each ring.
    closed : sequence of bool
        Which of the rings are closed; others are not looked at.

    Returns
    -------
    (F,) bool
    """
    found = np.zeros(len(curves), dtype=bool)
    last = np.cumsum(counts)
    for end, count, is_closed in zip(last, counts, closed, strict=True):
        if is_closed and count:
            found |= ~simple_frames(flatten(curves[:, end - count : end], CHORDS))
    return found
