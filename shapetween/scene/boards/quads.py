"""Items that are quads: four straight sides, convex, and the homographies between two of them."""

import numpy as np

from shapetween.base.arrays import Points
from shapetween.geometry.polygon import cross
from shapetween.scene.items import Item

__all__ = ["corners_of"]

#: How far, as a share of an outline's extent, its curves may be from their chords, or a joint from
#: the side that it lies on. Smaller, and what a drawing program has rounded is no quad; larger, and
#: boxes with rounded corners are.
STRAIGHT = 2e-3

#: Least height of a corner over the line through its neighbours, as a share of the extent. Smaller,
#: and a triangle with one more joint is a quad that perspective throws to infinity.
LEAST_CORNER = 0.03


def corners_of(item: Item) -> Points | None:
    """The corners of an area that is a convex quad, (4, 2) clockwise as drawn; None of others."""
    if not item.filled or not item.closed or item.holes:
        return None
    curves = item.outer.curves
    reach = STRAIGHT * item.extent
    start, end = curves[:, 0], curves[:, 3]
    lengths = np.linalg.norm(end - start, axis=1)
    curves = curves[lengths > reach]
    if not 4 <= len(curves) <= 8:
        return None
    start, end = curves[:, 0], curves[:, 3]
    ahead = (end - start) / np.linalg.norm(end - start, axis=1)[:, None]
    if np.abs(cross(curves[:, 1:3] - start[:, None], ahead[:, None])).max() > reach:
        return None
    bends = np.abs(cross(start - np.roll(start, 1, axis=0), ahead)) > reach
    corners = start[bends]
    if len(corners) != 4:
        return None
    sides = np.roll(corners, -1, axis=0) - corners
    across = np.roll(corners, -2, axis=0) - corners
    heights = cross(sides, across) / np.linalg.norm(across, axis=1)
    return corners if heights.min() > LEAST_CORNER * item.extent else None
