"""Which moving triangle each pixel of a frame lies in, and what it shows of a picture.

Where an outline is drawn over the edge of what fills it, no pixel is shared between triangles in a
way that shows. So pixels are looked up one by one, all triangles at once, instead of triangle by
triangle.
"""

from dataclasses import dataclass

import numpy as np

from shapetween.base.arrays import Floats, Index, Mask, Points
from shapetween.raster.faces import SHARPNESS
from shapetween.raster.light import Shares
from shapetween.raster.picture import Picture, colours_at
from shapetween.raster.sampling import between_levels

__all__ = ["Field", "triangles_at"]

#: Least area of a triangle in a frame, in pixels; what it would show cannot be seen.
LEAST_AREA = 1e-6


@dataclass(frozen=True, slots=True, eq=False)
class Field:
    """Some pixels of a frame, and the triangles they lie in.

    Attributes
    ----------
    x, y : (N,) float64
        Middles of the pixels.
    triangle : (N,) intp
    places : (T, 3, 2) float64
        Corners of the triangles in the frame's pixels.
    """

    x: Floats
    y: Floats
    triangle: Index
    places: Points

    @classmethod
    def of(cls, places: Points, seen: Mask) -> "Field":
        """The pixels that are seen, (H, W), by triangles with these corners, (T, 3, 2).

        A pixel that lies in no triangle, as where the plane is folded, goes with its nearest
        neighbour; if none lies in any, all go with the last triangle.
        """
        rows, columns = np.nonzero(seen)
        if not len(rows):
            return cls(np.zeros(0), np.zeros(0), rows, places)
        top, left = rows.min(), columns.min()
        shape = (int(rows.max() - top) + 1, int(columns.max() - left) + 1)
        index = triangles_at(places - [left, top], *shape)
        found = index[rows - top, columns - left]
        if (found < 0).any():
            from scipy.ndimage import distance_transform_edt

            near = distance_transform_edt(index < 0, return_distances=False, return_indices=True)
            found = index[near[0], near[1]][rows - top, columns - left]
        x, y = (np.asarray(place + 0.5, np.float64) for place in (columns, rows))
        return cls(x, y, found, places)

    def colours(self, picture: Picture, ends: Points) -> Shares:
        """Light of a picture, (N, 4) in units of 1 / FULL.

        Parameters
        ----------
        picture : Picture
        ends : (T, 3, 2) float64
            Corners of the triangles in the picture's pixels.
        """
        matrices = _affine(self.places, ends)
        stretches = np.linalg.svd(matrices[:, :, :2], compute_uv=False)[:, 0]
        levels = np.log2(np.maximum(stretches * SHARPNESS, 1)).astype(np.float32)
        (a, c, e), (b, d, f) = np.moveaxis(matrices, 0, 2)
        t, x, y = self.triangle, self.x, self.y
        u, v = a[t] * x + c[t] * y + e[t], b[t] * x + d[t] * y + f[t]
        level = np.minimum(levels[t], len(picture.levels) - 1)
        if not level.any():
            return colours_at(picture.levels[0], u, v)
        return between_levels(picture.levels, level, u, v)


def _affine(source: Points, target: Points) -> Floats:
    """Maps between triangles (T, 3, 2), shape (T, 2, 3); those without area get the identity."""
    first = np.stack([source[:, 1] - source[:, 0], source[:, 2] - source[:, 0]], axis=2)
    last = np.stack([target[:, 1] - target[:, 0], target[:, 2] - target[:, 0]], axis=2)
    flat = np.abs(np.linalg.det(first)) < LEAST_AREA
    first[flat], last[flat] = np.eye(2), np.eye(2)
    linear = last @ np.linalg.inv(first)
    shift = target[:, 0] - (linear @ source[:, 0, :, None])[..., 0]
    return np.concatenate([linear, shift[:, :, None]], axis=2)


def triangles_at(corners: Points, height: int, width: int) -> Index:
    """Number of the triangle that each pixel's middle lies in, -1 for none, (height, width).

    Parameters
    ----------
    corners : (T, 3, 2) float64
        In pixels. Triangles that share a side leave no pixel between them.

    Notes
    -----
    All rows of all triangles at once, each from its left to its right side; then all pixels of all
    these rows. A pixel is in a row or a triangle from its lower bound on, up to but without its
    upper bound.
    """
    low, high = corners[..., 1].min(axis=1), corners[..., 1].max(axis=1)
    triangle, row = _spans(low, high, height)
    y = row + 0.5
    left, right = np.full(len(y), np.inf), np.full(len(y), -np.inf)
    for k in (0, 1, 2):
        # Each side is taken from its upper end to its lower, so that both triangles it belongs to
        # compute the same.
        start, end = corners[:, k], corners[:, (k + 1) % 3]
        turned = (start[:, 1] > end[:, 1]) | (
            (start[:, 1] == end[:, 1]) & (start[:, 0] > end[:, 0])
        )
        start, end = np.where(turned[:, None], end, start), np.where(turned[:, None], start, end)
        start, end = start[triangle], end[triangle]
        crossed = (start[:, 1] <= y) & (y < end[:, 1])
        run = np.where(crossed, end[:, 1] - start[:, 1], 1.0)
        x = start[:, 0] + (y - start[:, 1]) / run * (end[:, 0] - start[:, 0])
        left = np.where(crossed, np.minimum(left, x), left)
        right = np.where(crossed, np.maximum(right, x), right)
    line, column = _spans(left, right, width)
    index = np.full((height, width), -1, np.intp)
    index[row[line], column] = triangle[line]
    return index


def _spans(low: Floats, high: Floats, count: int) -> tuple[Index, Index]:
    """Numbers of spans, and the pixels from 0 to `count` whose middles lie in them, in pairs."""
    first = np.clip(np.ceil(low - 0.5), 0, count).astype(np.intp)
    last = np.clip(np.ceil(high - 0.5), 0, count).astype(np.intp)
    lengths = np.maximum(last - first, 0)
    span = np.repeat(np.arange(len(first)), lengths)
    step = np.arange(len(span)) - np.repeat(np.cumsum(lengths) - lengths, lengths)
    return span, first[span] + step
