"""Amounts of light: what pixel values are turned into before they are mixed, and back.

Mixing, averaging and covering are sums of light, so they are right only on linear values with the
alpha multiplied in; done on sRGB's values they leave dark seams and fringes.
"""

from functools import cache
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from shapetween.model.srgb import linear_to_srgb, srgb_to_linear

__all__ = [
    "FULL",
    "Bytes",
    "Light",
    "Shares",
    "decode",
    "encode",
]

Bytes: TypeAlias = NDArray[np.uint8]
"""Pixel values as files have them, (H, W, 3) or (H, W, 4)."""
Light: TypeAlias = NDArray[np.uint16]
"""Red, green, blue in linear light times alpha, and alpha, in units of 1 / FULL, (H, W, 4)."""
Shares: TypeAlias = NDArray[np.float32]
"""The same in units of 1 while it is worked on."""

#: Full light. With 16 bits the darkest step of sRGB's 8 is twenty units wide.
FULL = 65535

#: Rows that are turned at a time, so that what is needed in between stays small.
BAND = 64


@cache
def _encoding() -> NDArray[np.uint8]:
    values = linear_to_srgb(np.arange(FULL + 1) / FULL)
    table = np.rint(values * 255).astype(np.uint8)
    table.setflags(write=False)
    return table


def decode(values: Bytes, gamma: float | None = None) -> Light:
    """Light of pixels with red, green, blue and alpha.

    Parameters
    ----------
    values : (H, W, 4) uint8
    gamma : float, optional
        Exponent from value to light; sRGB's own curve if left out.
    """
    levels = np.arange(256) / 255
    curve = srgb_to_linear(levels) if gamma is None else levels**gamma
    table = np.rint(curve * FULL).astype(np.uint16)
    result = np.zeros(values.shape, np.uint16)
    for start in range(0, len(values), BAND):
        rows = values[start : start + BAND]
        band = result[start : start + BAND]
        band[..., :3] = table[rows[..., :3]]
        alpha = rows[..., 3:]
        band[..., 3:] = alpha.astype(np.uint16) * 257
        if (alpha != 255).any():
            # Rounded division by 255: 65535 * 255 still fits into 32 bits.
            product = band[..., :3].astype(np.uint32) * alpha
            band[..., :3] = (product + 127) // 255
    return result


def encode(shares: Shares, *, opaque: bool) -> Bytes:
    """Pixel values of an amount of light.

    Parameters
    ----------
    shares : (H, W, 4) float32
    opaque : bool
        Whether alpha is 1 everywhere and is left out of the result.

    Returns
    -------
    (H, W, 3) or (H, W, 4) uint8
    """
    table = _encoding()
    result = np.zeros((*shares.shape[:2], 3 if opaque else 4), np.uint8)
    for start in range(0, len(shares), BAND):
        band = shares[start : start + BAND]
        colour = band[..., :3]
        if not opaque:
            alpha = band[..., 3:]
            colour = np.divide(colour, alpha, out=np.zeros_like(colour), where=alpha > 0)
            result[start : start + BAND, :, 3] = np.rint(np.clip(alpha[..., 0], 0, 1) * 255)
        index = np.minimum(np.maximum(colour, 0), 1)
        index = (index * np.float32(FULL) + np.float32(0.5)).astype(np.uint16)
        result[start : start + BAND, :, :3] = table.take(index)
    return result
