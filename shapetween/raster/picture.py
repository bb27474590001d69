"""Pictures ready to be sampled: amounts of light, with smaller copies of themselves.

.. [Wil83] L. Williams, "Pyramidal parametrics", SIGGRAPH 1983.
"""

from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from shapetween.base.errors import ShapeError
from shapetween.raster.light import BAND, FULL, Bytes, Light, Shares, decode

__all__ = ["Picture", "Texels", "colours_at", "fourfold"]

Texels: TypeAlias = NDArray[np.uint64]
"""Pixels whose four 16-bit amounts of light are packed into one number, so that they are fetched
at once."""


@dataclass(frozen=True, slots=True, eq=False)
class Picture:
    """Light in linear, premultiplied pixels, and its pyramid.

    Attributes
    ----------
    levels : tuple of (H, W) uint64
        The picture, then each time half as wide and high (rounded up) down to one pixel [Wil83]_.
    opaque : bool
        Whether alpha is full everywhere.
    warnings : tuple of str
        What about the file could not be honoured, one line each.
    """

    levels: tuple[Texels, ...]
    opaque: bool
    warnings: tuple[str, ...] = ()

    @classmethod
    def of(
        cls, values: Bytes, gamma: float | None = None, warnings: tuple[str, ...] = ()
    ) -> "Picture":
        """A picture of pixel values.

        Parameters
        ----------
        values : (H, W, 3) or (H, W, 4) uint8
            Red, green, blue, and alpha that is not multiplied in.
        gamma : float, optional
            Exponent from value to light; sRGB's own curve if left out.
        warnings : tuple of str

        Raises
        ------
        ShapeError
            If that is not the shape of a picture.
        """
        if values.ndim != 3 or values.shape[2] not in (3, 4) or not values.size:
            raise ShapeError(f"expected pixels of shape (H, W, 3 or 4), got {values.shape}")
        if values.shape[2] == 3:
            full = np.full((*values.shape[:2], 1), 255, np.uint8)
            values = np.concatenate([values, full], axis=2)
        return cls.of_light(decode(values, gamma), warnings)

    @classmethod
    def of_light(cls, light: Light, warnings: tuple[str, ...] = ()) -> "Picture":
        """A picture of amounts of light, (H, W, 4) uint16."""
        opaque = bool((light[..., 3] == FULL).all())
        levels = [light]
        while max(levels[-1].shape[:2]) > 1:
            levels.append(_halved(levels[-1]))
        packed = tuple(np.ascontiguousarray(level).view(np.uint64)[..., 0] for level in levels)
        for level in packed:
            level.setflags(write=False)
        return cls(packed, opaque, warnings)

    @property
    def width(self) -> int:
        """In pixels."""
        return int(self.levels[0].shape[1])

    @property
    def height(self) -> int:
        """In pixels."""
        return int(self.levels[0].shape[0])

    @property
    def light(self) -> Light:
        """Amounts of light, (H, W, 4) uint16."""
        return self.levels[0][..., None].view(np.uint16)


def _halved(light: Light) -> Light:
    """Means of two by two pixels; an odd last row or column counts twice."""
    height, width = light.shape[:2]
    result = np.zeros(((height + 1) // 2, (width + 1) // 2, 4), np.uint16)
    for start in range(0, len(result), BAND):
        rows = light[2 * start : 2 * (start + BAND)]
        rows = np.pad(rows, ((0, len(rows) % 2), (0, width % 2), (0, 0)), mode="edge")
        total = rows[::2].astype(np.uint32) + rows[1::2]
        result[start : start + BAND] = (total[:, ::2] + total[:, 1::2] + 2) // 4
    return result


def fourfold(shares: NDArray[Any]) -> Shares:
    """Each of (N,) shares for all four amounts of light, (N, 4).

    Written out, because numpy is ten times as slow where it repeats along so short an axis.
    """
    return np.repeat(shares.astype(np.float32), 4).reshape(-1, 4)


def colours_at(texels: Texels, x: NDArray[np.float64], y: NDArray[np.float64]) -> Shares:
    """Light at places of a picture, on straight lines between the middles of its pixels.

    Parameters
    ----------
    texels : (H, W) uint64
    x, y : (N,) float64
        In pixels; (0, 0) is the outer corner of the first pixel. Places beyond the middles of the
        outermost pixels have those pixels' colour.

    Returns
    -------
    (N, 4) float32
        In units of 1 / FULL.
    """
    height, width = texels.shape
    across = np.clip(x - 0.5, 0, width - 1)
    down = np.clip(y - 0.5, 0, height - 1)
    column, row = across.astype(np.intp), down.astype(np.intp)
    right, below = fourfold(across - column), fourfold(down - row)
    index = row * width + column
    step_right = (column < width - 1).astype(np.intp)
    step_down = np.where(row < height - 1, width, 0)
    flat = texels.reshape(-1)

    def fetch(places: NDArray[np.intp]) -> Shares:
        return flat.take(places).view(np.uint16).reshape(-1, 4).astype(np.float32)

    upper = fetch(index)
    other = fetch(index + step_right)
    other -= upper
    other *= right
    upper += other
    index += step_down
    lower = fetch(index)
    other = fetch(index + step_right)
    other -= lower
    other *= right
    lower += other
    lower -= upper
    lower *= below
    upper += lower
    return upper
