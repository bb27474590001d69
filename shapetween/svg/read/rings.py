"""Subpaths to the rings of a shape."""

from collections.abc import Sequence

import numpy as np

from shapetween.base.arrays import Curves
from shapetween.geometry.bezier import line_curves
from shapetween.geometry.polygon import cross
from shapetween.model.drawing import Box
from shapetween.model.outline import Outline
from shapetween.svg.read.pathdata import Subpath

__all__ = ["bounds", "ring_of"]

#: A gap that is closed by moving the last point instead of drawing a line, as a share of the
#: ring's size: what programs that add up rounded numbers leave. Larger and a line that somebody
#: drew would go; smaller and rings get closing lines of no visible length, with any direction.
CLOSING_GAP = 1e-6

#: Width of a ring over its length, below which it encloses nothing: rounding of its coordinates.
FLAT = 1e-12


def bounds(subpaths: Sequence[Subpath]) -> Box:
    """The least box around what subpaths draw, without strokes."""
    curves = np.concatenate([np.zeros((0, 4, 2)), *(subpath.curves for subpath in subpaths)])
    if not len(curves):
        return Box(0.0, 0.0, 0.0, 0.0)
    # A coordinate is extreme at an end, or where the derivative c + b t + a t^2 is 0.
    p0, p1, p2, p3 = np.moveaxis(curves, 1, 0)
    a, b, c = p3 - p0 + 3 * (p1 - p2), 2 * (p0 - 2 * p1 + p2), p1 - p0
    with np.errstate(all="ignore"):
        half = -(b + np.copysign(np.sqrt(b * b - 4 * a * c), b)) / 2
        roots = np.stack([half / a, c / half])
    t = np.where((roots > 0) & (roots < 1), roots, 0.0)
    s = 1 - t
    inner = s**3 * p0 + 3 * s * s * t * p1 + 3 * s * t * t * p2 + t**3 * p3
    points = np.concatenate([p0, p3, inner.reshape(-1, 2)])
    least, greatest = points.min(axis=0), points.max(axis=0)
    return Box(*least.tolist(), *(greatest - least).tolist())


def ring_of(subpath: Subpath, *, filled: bool, stroked: bool, dots: bool) -> Outline | None:
    """The ring that a subpath draws.

    Parameters
    ----------
    subpath : Subpath
    filled, stroked : bool
        How the shape is painted. A ring that is only filled is closed; one that is stroked stays
        open if it was drawn so.
    dots : bool
        Whether a line without length shows, as the caps of its stroke.

    Returns
    -------
    Outline or None
        None if there is nothing to see.
    """
    curves = subpath.curves
    curves = curves[(curves != curves[:, :1]).any(axis=(1, 2))]
    if not len(curves):
        if stroked and dots and (subpath.closed or len(subpath.curves)):
            return Outline(np.broadcast_to(subpath.start, (1, 4, 2)), subpath.closed)
        return None
    closed = subpath.closed or not stroked
    if closed:
        curves = _closed(curves)
    if filled and not stroked and _is_flat(curves):
        return None
    return Outline(curves, closed)


def _closed(curves: Curves) -> Curves:
    start, end = curves[0, 0], curves[-1, 3]
    gap = np.abs(end - start).max()
    if gap == 0:
        return curves
    points = curves.reshape(-1, 2)
    if gap <= CLOSING_GAP * np.ptp(points, axis=0).max():
        curves = curves.copy()
        curves[-1, 3] = start
        # The curve may have been nothing but that gap.
        return curves if (curves[-1] != start).any() or len(curves) == 1 else curves[:-1]
    return np.concatenate([curves, line_curves(end[None], start[None])])


def _is_flat(curves: Curves) -> bool:
    """Whether all control points lie on one line, so that nothing is enclosed."""
    points = curves.reshape(-1, 2)
    offsets = points - points[0]
    size = np.abs(offsets).max()
    farthest = offsets[np.abs(offsets).max(axis=1).argmax()]
    # Divided by the size first: neither square may vanish in a tiny drawing.
    return bool(np.abs(cross(offsets / size, farthest / size)).max() <= FLAT)
