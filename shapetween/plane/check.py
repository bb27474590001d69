"""Whether outlines in motion stay simple."""

import numpy as np
import shapely

from shapetween.arrays import Mask, Points

__all__ = ["simple_frames"]


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
