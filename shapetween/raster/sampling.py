"""A picture's colours on one face of a frame, averaged where the picture shrinks.

.. [MPFJ99] J. McCormack, R. Perry, K. Farkas, N. Jouppi, "Feline: fast elliptical lines for
   anisotropic texture mapping", SIGGRAPH 1999.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from shapetween.base.arrays import Floats, Mask, Points
from shapetween.raster.faces import FaceMap, Footprint
from shapetween.raster.light import FULL, Shares
from shapetween.raster.picture import Picture, Texels, colours_at, fourfold

__all__ = ["Texture", "between_levels"]

#: How far a face may reach over the picture's edge, in pixels, and still count as inside it.
REACH = 0.01


@dataclass(frozen=True, slots=True, eq=False)
class Texture:
    """What a face shows of a picture in one frame.

    Attributes
    ----------
    picture : Picture
    inverse : FaceMap
        From the frame to the picture.
    footprint : Footprint
    beyond : (2, 2) bool
        Whether the face reaches beyond the picture's left and top, and right and bottom edge.
    """

    picture: Picture
    inverse: FaceMap
    footprint: Footprint
    beyond: Mask

    @classmethod
    def of(
        cls, picture: Picture, inverse: FaceMap, footprint: Footprint, corners: Points
    ) -> "Texture":
        """The texture of a face whose corners in the picture, (K, 2), are given."""
        low, high = corners.min(axis=0), corners.max(axis=0)
        size = np.array([picture.width, picture.height])
        return cls(picture, inverse, footprint, np.stack([low < -REACH, high > size + REACH]))

    def at(self, x: Floats, y: Floats) -> Shares:
        """Light at middles of pixels of the frame, (N,) each: (N, 4), in units of 1.

        Notes
        -----
        Along the way in which the picture shrinks most, several probes are taken in each pixel,
        so that halved copies of the picture need only be as coarse as its other way asks for
        [MPFJ99]_.
        """
        probes = self.footprint.probes
        dx, dy = self.footprint.direction
        steps = (np.arange(probes) + 0.5) / probes - 0.5
        total = self._once(x + steps[0] * dx, y + steps[0] * dy)
        for step in steps[1:]:
            total += self._once(x + step * dx, y + step * dy)
        total *= np.float32(1 / (FULL * probes))
        return total

    def _once(self, x: Floats, y: Floats) -> Shares:
        u, v = self.inverse(x, y)
        levels = self.picture.levels
        if not self.footprint.shrinks:
            colours = colours_at(levels[0], u, v)
        else:
            level = np.minimum(self.footprint.level(x, y, u, v), len(levels) - 1)
            colours = between_levels(levels, level, u, v)
        if self.beyond.any():
            colours *= fourfold(self._inside(u, v))
        return colours

    def _inside(self, u: Floats, v: Floats) -> Shares:
        """Shares of the picture in its own pixels at these places: 0 beyond its edges."""
        result = np.ones(len(u), np.float32)
        for axis, (place, size) in enumerate(((u, self.picture.width), (v, self.picture.height))):
            if self.beyond[0, axis]:
                result *= np.clip(place + 0.5, 0, 1)
            if self.beyond[1, axis]:
                result *= np.clip(size - place + 0.5, 0, 1)
        return result


def between_levels(
    levels: tuple[Texels, ...], level: NDArray[np.float32], u: Floats, v: Floats
) -> Shares:
    """Light between two halvings of a picture, linearly by level, (N, 4) in units of 1 / FULL."""
    low, high = int(level.min()), math.ceil(level.max())
    if high - low <= 1:
        colours = colours_at(levels[low], u / 2**low, v / 2**low)
        if high > low:
            coarse = colours_at(levels[high], u / 2**high, v / 2**high)
            coarse -= colours
            coarse *= fourfold(level - np.float32(low))
            colours += coarse
        return colours
    colours = np.zeros((len(u), 4), np.float32)
    for k in range(low, high):
        here = np.flatnonzero(level.astype(np.intp) == k)
        if len(here):
            colours[here] = between_levels(levels, level[here], u[here], v[here])
    return colours
