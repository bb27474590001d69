"""Polygons, triangles and quads as arrays of corners."""

import numpy as np

from shapetween.base.arrays import Floats, Points, Quads

__all__ = ["corner_sines", "cross", "diagonal_crossings", "polygon_area", "rms_radius"]


def cross(a: Points, b: Points) -> Floats:
    """Third component of the cross product of plane vectors, (...,)."""
    return np.asarray(a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0])


def polygon_area(points: Points) -> Floats:
    """Signed area of closed polygons, positive when clockwise as drawn.

    Parameters
    ----------
    points : (..., N, 2) float64

    Returns
    -------
    (...,) float64
    """
    local = points - points[..., :1, :]
    return np.asarray(cross(local, np.roll(local, -1, axis=-2)).sum(-1) / 2)


def corner_sines(faces: Quads) -> Floats:
    """Sine of the turn at each corner of polygons that run clockwise as drawn.

    Parameters
    ----------
    faces : (..., N, 2) float64

    Returns
    -------
    (..., N) float64
        All positive if and only if a quad or triangle is strictly convex and clockwise; 0 where
        a side has no length.
    """
    leaving = np.roll(faces, -1, axis=-2) - faces
    reaching = np.roll(leaving, 1, axis=-2)
    size = np.linalg.norm(leaving, axis=-1) * np.linalg.norm(reaching, axis=-1)
    return cross(reaching, leaving) / np.where(size > 0, size, 1.0)


def rms_radius(points: Points) -> Floats:
    """Root mean square distance of points to their mean, (...,) for (..., N, 2)."""
    offsets = points - points.mean(axis=-2, keepdims=True)
    return np.asarray(np.sqrt((offsets**2).sum(-1).mean(-1)))


def diagonal_crossings(quads: Quads) -> Points:
    """Where the diagonals of convex quads cross, (..., 2) for (..., 4, 2).

    Homographies take it along, which they do not the mean of the corners.
    """
    a, b, c, d = np.moveaxis(quads, -2, 0)
    share = cross(b - a, d - b) / cross(c - a, d - b)
    return np.asarray(a + share[..., None] * (c - a))
