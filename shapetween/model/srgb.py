"""sRGB's curve between the values that files hold and the light they stand for.

.. [sRGB] IEC 61966-2-1:1999.
"""

import numpy as np

from shapetween.base.arrays import Floats

__all__ = ["linear_to_srgb", "srgb_to_linear"]


def srgb_to_linear(values: Floats) -> Floats:
    """Linear light of sRGB's values, both from 0 to 1 ([sRGB]_); negative ones are mirrored."""
    size = np.abs(values)
    light = np.where(size <= 0.04045, size / 12.92, ((size + 0.055) / 1.055) ** 2.4)
    return np.asarray(np.copysign(light, values))


def linear_to_srgb(light: Floats) -> Floats:
    """The inverse of `srgb_to_linear`."""
    size = np.abs(light)
    values = np.where(size <= 0.0031308, size * 12.92, 1.055 * size ** (1 / 2.4) - 0.055)
    return np.asarray(np.copysign(values, light))
