"""Pictures read from PNG, JPEG and WebP, upright, in sRGB, and never larger than allowed.

Pillow reads them; it is an extra, imported when a picture is.
"""

import io
import struct
import warnings
import zlib
from pathlib import Path
from types import ModuleType
from typing import TYPE_CHECKING, Any

import numpy as np

from shapetween.base.errors import BudgetError, InputError, OptionError
from shapetween.io import files
from shapetween.raster.light import Bytes
from shapetween.raster.picture import Picture

if TYPE_CHECKING:
    from PIL.Image import Image

__all__ = ["DEFAULT_MEGAPIXELS", "pillow", "read_picture"]

#: Largest picture that is read unless more is asked for: what phones take. A picture and its
#: halved copies need 11 bytes a pixel, and its file may be small all the same.
DEFAULT_MEGAPIXELS = 64

FORMATS = ("PNG", "JPEG", "WEBP")

#: Exponent of files for screens that say nothing else; sRGB's curve is what they mean.
USUAL_GAMMA, NEAR_GAMMA = 2.2, 0.05

#: What Pillow raises on files that are cut off or damaged, beside its own errors.
DAMAGED = (OSError, SyntaxError, ValueError, EOFError, struct.error, zlib.error, IndexError)


def pillow() -> ModuleType:
    """Pillow's `Image` module.

    Raises
    ------
    OptionError
        If it is not installed.
    """
    try:
        from PIL import Image
    except ImportError as error:
        raise OptionError(
            "pictures need Pillow; install it with: pip install 'shapetween[image]'"
        ) from error
    return Image


def read_picture(path: Path, megapixels: float = DEFAULT_MEGAPIXELS) -> Picture:
    """Read a picture.

    Turned as its EXIF orientation says; brought from its colour profile to sRGB, or from its own
    gamma to light. Of an animation the first frame is taken.

    Parameters
    ----------
    path : Path
    megapixels : float
        Largest picture that is read.

    Raises
    ------
    InputError
        If there is no such file, or it is no whole picture.
    BudgetError
        If it is larger than allowed.
    OptionError
        If Pillow is not installed.
    """
    image_module = pillow()
    name = str(path)
    budget = round(megapixels * 1e6)
    # A file may be larger than its pixels, but hardly more than twice.
    data = files.read_bytes(path, max(files.MAX_BYTES, 8 * budget))
    with warnings.catch_warnings():
        # Sizes are checked here, and files that Pillow only grumbles about are read.
        warnings.simplefilter("ignore")
        try:
            image = image_module.open(io.BytesIO(data), formats=FORMATS)
        except image_module.DecompressionBombError as error:
            raise _too_large(name, "more pixels than can be read", megapixels) from error
        except image_module.UnidentifiedImageError as error:
            raise InputError(name, "is not a picture; expected PNG, JPEG or WebP") from error
        except DAMAGED as error:
            raise InputError(name, "is damaged: it cannot be read as a picture") from error
        width, height = image.size
        if width * height > budget:
            size = f"{width} x {height} pixels are {width * height / 1e6:.1f} megapixels"
            raise _too_large(name, size, megapixels)
        try:
            image.load()
            return _picture(image)
        except DAMAGED as error:
            raise InputError(name, "is cut off or damaged") from error


def _too_large(name: str, size: str, megapixels: float) -> BudgetError:
    return BudgetError(
        name, f"{size}; at most {megapixels:g} megapixels are read, more with --max-megapixels"
    )


def _picture(image: "Image") -> Picture:
    from PIL import ImageOps

    losses = []
    if getattr(image, "n_frames", 1) > 1:
        losses.append("is an animation, of which the first frame was taken")
    info = dict(image.info)
    upright = ImageOps.exif_transpose(image)
    if upright.mode.startswith(("I", "F")):
        upright = _eight_bits(upright)
    upright, loss = _in_srgb(upright, info.get("icc_profile"))
    if loss:
        losses.append(loss)
    values: Bytes = np.array(upright.convert("RGBA"))
    gamma = None
    if "gamma" in info and "srgb" not in info and not info.get("icc_profile"):
        exponent = 1 / info["gamma"] if info["gamma"] > 0 else USUAL_GAMMA
        gamma = exponent if abs(exponent - USUAL_GAMMA) > NEAR_GAMMA else None
    return Picture.of(values, gamma, tuple(losses))


def _eight_bits(image: "Image") -> "Image":
    """A grey picture of 16 bits in 8, which Pillow would only cut off."""
    values = np.clip(np.array(image).astype(np.float64), 0, 65535)
    return pillow().fromarray(np.rint(values / 257).astype(np.uint8))  # type: ignore[no-any-return]


def _in_srgb(image: "Image", profile: Any) -> tuple["Image", str]:
    """The picture in sRGB, and what is to be said if its profile is of no use."""
    if not profile or image.mode == "P":
        return image, ""
    from PIL import ImageCms

    mode = image.mode
    alpha = image.getchannel("A") if mode in ("RGBA", "LA") else None
    try:
        colours = image.convert("RGB" if mode == "RGBA" else "L") if alpha else image
        own = ImageCms.ImageCmsProfile(io.BytesIO(profile))
        srgb = ImageCms.createProfile("sRGB")
        result = ImageCms.profileToProfile(colours, own, srgb, outputMode="RGB")
    except (ImageCms.PyCMSError, OSError, ValueError):
        return image, "its colour profile cannot be used; its colours were taken as sRGB"
    assert result is not None
    if alpha is not None:
        result.putalpha(alpha)
    return result, ""
