"""How much of each pixel a polygon covers, exactly.

The shares of faces that abut add up to 1 in every pixel they share. So a mesh is drawn by adding
its faces, each times its share, and no seam shows; painting antialiased faces over one another
would leave a quarter of the background in such pixels.

.. [Lev] R. Levien, "Inside the fastest font renderer in the world", 2016: signed areas
   accumulated along rows.
"""

from dataclasses import dataclass

import numpy as np

from shapetween.base.arrays import Points
from shapetween.geometry.polygon import cross
from shapetween.raster.light import Shares

__all__ = ["Coverage", "clipped", "coverage"]

#: Shares below this are rounding error of the sums along a row.
LEAST_SHARE = 1e-6


@dataclass(frozen=True, slots=True, eq=False)
class Coverage:
    """Shares of the pixels in a box.

    Attributes
    ----------
    left, top : int
        Place of the box in the frame.
    shares : (h, w) float32
        From 0 to 1.
    """

    left: int
    top: int
    shares: Shares


def clipped(polygon: Points, width: float, height: float) -> Points:
    """The part of a convex polygon inside the frame (0, 0) to (width, height), (K, 2).

    Clips at one side of the frame after the other (Sutherland and Hodgman); K is 0 if nothing is
    left.
    """
    limits = (width, height)
    for axis in (0, 1):
        for sign, limit in ((1.0, 0.0), (-1.0, -limits[axis])):
            inside = sign * polygon[:, axis] - limit
            if not len(polygon) or (inside >= 0).all():
                continue
            following = np.roll(polygon, -1, axis=0)
            after = np.roll(inside, -1)
            crosses = (inside >= 0) != (after >= 0)
            share = inside[crosses] / (inside[crosses] - after[crosses])
            cuts = polygon[crosses] + share[:, None] * (following - polygon)[crosses]
            cuts[:, axis] = sign * limit
            # Each corner that stays comes just before the cut of the side it starts.
            order = np.concatenate([np.flatnonzero(inside >= 0), np.flatnonzero(crosses) + 0.5])
            kept = np.concatenate([polygon[inside >= 0], cuts])
            polygon = kept[np.argsort(order, kind="stable")]
    return polygon


def coverage(polygon: Points, width: int, height: int) -> Coverage | None:
    """Shares of a frame's pixels that lie in a convex polygon.

    Parameters
    ----------
    polygon : (K, 2) float64
        Convex, in pixels; (0, 0) is the outer corner of the first pixel.
    width, height : int
        Of the frame, to which the polygon is clipped.

    Returns
    -------
    Coverage or None
        None if the polygon lies outside.

    Notes
    -----
    Sides are cut at all rows and columns. A piece from y0 to y1 at mean distance f from its
    pixel's left side adds (y1 - y0)(1 - f) to that pixel and (y1 - y0) f to the next; sums along
    the row are then the shares [Lev]_.
    """
    polygon = clipped(polygon, width, height)
    if len(polygon) < 3:
        return None
    low = np.floor(polygon.min(axis=0)).astype(int)
    high = np.ceil(polygon.max(axis=0)).astype(int)
    columns, rows = (high - low).tolist()
    if columns < 1 or rows < 1:
        return None
    starts = polygon - low
    ends = np.roll(starts, -1, axis=0)
    area = cross(starts, ends).sum() / 2
    if area == 0:
        return None
    pieces = [_pieces(start, end) for start, end in zip(starts, ends, strict=True)]
    before, after = (np.concatenate(part) for part in zip(*pieces, strict=True))
    middle = (before + after) / 2
    # Rounding may put a piece on the last row or column's far side.
    column = np.clip(np.floor(middle[:, 0]), 0, columns - 1).astype(np.intp)
    row = np.clip(np.floor(middle[:, 1]), 0, rows - 1).astype(np.intp)
    rise = (before[:, 1] - after[:, 1]) * np.sign(area)
    share = middle[:, 0] - column
    cell = row * (columns + 1) + column
    sums = np.bincount(
        np.concatenate([cell, cell + 1]),
        np.concatenate([rise * (1 - share), rise * share]),
        minlength=rows * (columns + 1),
    ).reshape(rows, columns + 1)
    shares = np.cumsum(sums[:, :-1], axis=1).astype(np.float32)
    shares[shares < LEAST_SHARE] = 0
    np.minimum(shares, 1, out=shares)
    return Coverage(int(low[0]), int(low[1]), shares)


def _pieces(start: Points, end: Points) -> tuple[Points, Points]:
    """A side cut wherever it crosses a row or a column: starts and ends, (N, 2) each."""
    cuts = [np.array([0.0, 1.0])]
    for axis in (0, 1):
        a, b = float(start[axis]), float(end[axis])
        if a != b:
            lines = np.arange(np.floor(min(a, b)) + 1, np.ceil(max(a, b)))
            cuts.append((lines - a) / (b - a))
    share = np.sort(np.concatenate(cuts))[:, None]
    points = (1 - share) * start + share * end
    return points[:-1], points[1:]
