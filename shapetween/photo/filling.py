"""What moving quads leave behind, filled from its surroundings.

Pictures that dissolve into each other show what moves three times: where it is, and pale where it
was and will be. By Telea's method [Tel04]_ the places are painted over, before they dissolve.

.. [Tel04] A. Telea, "An image inpainting technique based on the fast marching method", Journal of
   Graphics Tools 9(1), 2004.
"""

from importlib.util import find_spec

import numpy as np

from shapetween.base.arrays import Floats, Mask
from shapetween.base.errors import OptionError
from shapetween.model.srgb import linear_to_srgb, srgb_to_linear
from shapetween.raster.light import FULL, Bytes, Light

__all__ = ["can_fill", "filled"]

#: Pixels of the larger side at which it is painted; a larger picture is made smaller for it, for
#: time grows with the area, and what is painted is smooth.
LARGEST = 800

#: How far the place is widened, as a share of the larger side, for soft edges leave pale outlines;
#: and from how many pixels around colours are taken. Wider loses more of the picture.
WIDENED, RADIUS = 0.004, 5


def can_fill() -> bool:
    """Whether OpenCV is installed."""
    return find_spec("cv2") is not None


def filled(light: Light, covered: Mask) -> Light:
    """Light (H, W, 4) with the places that are covered, (H, W), filled from around them.

    Where all is covered nothing can be.

    Raises
    ------
    OptionError
        If OpenCV is not installed.
    """
    if not can_fill():
        raise OptionError(
            "background 'fill': needs OpenCV; pip install shapetween[fill], or use 'dissolve'"
        )
    import cv2

    height, width = covered.shape
    reach = max(1, round(WIDENED * max(width, height)))
    wide = cv2.dilate(covered.astype(np.uint8), np.ones((2 * reach + 1, 2 * reach + 1), np.uint8))
    if not wide.any() or wide.all():
        return light
    values = light.astype(np.float64) / FULL
    alpha = values[..., 3:]
    plain = linear_to_srgb(values[..., :3] / np.where(alpha > 0, alpha, 1.0))
    bytes_ = np.rint(255 * np.clip(np.concatenate([plain, alpha], axis=-1), 0, 1)).astype(np.uint8)
    painted = _painted(bytes_, np.asarray(wide, np.uint8)) / 255
    colour = srgb_to_linear(painted[..., :3]) * painted[..., 3:]
    found = np.rint(FULL * np.concatenate([colour, painted[..., 3:]], axis=-1))
    return np.where(wide[..., None] > 0, found, light).astype(light.dtype)


def _painted(values: Bytes, holes: Bytes) -> Floats:
    """Bytes (H, W, 4) painted over where there are holes, maybe at a smaller size."""
    import cv2

    height, width = holes.shape
    scale = min(1.0, LARGEST / max(width, height))
    small = values
    if scale < 1:
        size = max(1, round(width * scale)), max(1, round(height * scale))
        small = np.asarray(cv2.resize(values, size, interpolation=cv2.INTER_AREA), np.uint8)
        holes = (cv2.resize(holes * 255, size, interpolation=cv2.INTER_AREA) > 0).astype(np.uint8)
    colours = cv2.inpaint(np.ascontiguousarray(small[..., :3]), holes, RADIUS, cv2.INPAINT_TELEA)
    clear = cv2.inpaint(np.ascontiguousarray(small[..., 3]), holes, RADIUS, cv2.INPAINT_TELEA)
    painted = np.concatenate([colours, clear[..., None]], axis=-1)
    if scale < 1:
        painted = cv2.resize(painted, (width, height), interpolation=cv2.INTER_LINEAR)
    return np.asarray(painted, np.float64)
