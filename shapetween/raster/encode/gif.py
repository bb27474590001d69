"""Animated GIF, frame by frame, each with a palette of its own for the pixels that change.

Pixels that stay as they were are left alone: painted anew with another palette they would flicker.

Pillow finds the palettes and compresses; the file around the frames is made here, because
Pillow's own wants all frames at once.

.. [Gif] *Graphics Interchange Format, Version 89a*, CompuServe, 1990.
"""

import io
import struct
from collections.abc import Iterable
from pathlib import Path
from typing import BinaryIO

import numpy as np

from shapetween.base.arrays import Mask
from shapetween.base.errors import OptionError
from shapetween.io.files import fresh_file
from shapetween.raster.encode.timing import Clock, patch_between
from shapetween.raster.light import Bytes
from shapetween.raster.load import pillow

__all__ = ["write_gif"]

#: Ticks a second, and the fewest for a frame: players take less for a mistake and show it long.
HUNDREDTHS, LEAST_TICKS = 100, 2

#: Widest and highest picture that GIF can hold.
LARGEST = 65535

#: Numbers of colours; the last one stands for what is not painted.
COLOURS = 256

KEEP, CLEAR = 1, 2


def write_gif(path: Path, frames: Iterable[Bytes], clock: Clock) -> None:
    """Write an animated GIF; pixels less than half opaque are left out.

    Raises
    ------
    OptionError
        If GIF cannot play so fast, or it cannot be written; a file that was there is then still
        whole.
    """
    if clock.fps > HUNDREDTHS / LEAST_TICKS:
        raise OptionError(f"{path}: GIF plays at most {HUNDREDTHS // LEAST_TICKS} frames a second")
    with fresh_file(path) as fresh, fresh.open("wb") as file:
        before: Bytes | None = None
        for k, frame in enumerate(frames):
            height, width, channels = frame.shape
            if before is None:
                if max(width, height) > LARGEST:
                    raise OptionError(f"{path}: GIF holds at most {LARGEST} pixels a side")
                file.write(b"GIF89a" + struct.pack("<HHBBB", width, height, 0x70, 0, 0))
                if clock.repeats:
                    file.write(b"\x21\xff\x0bNETSCAPE2.0\x03\x01\0\0\0")
            # A frame can paint over the one before but not erase it, unless that one clears itself.
            below = before if channels == 3 else None
            patch = patch_between(below, frame)
            ticks = max(LEAST_TICKS, clock.ticks(k, HUNDREDTHS))
            _write_control(file, ticks, CLEAR if channels == 4 else KEEP)
            pixels = patch.of(frame)
            if channels == 4:
                painted = pixels[..., 3] >= 128
            elif below is None:
                painted = np.ones(pixels.shape[:2], bool)
            else:
                painted = (patch.of(below) != pixels).any(axis=2)
            table, data = _compressed(pixels[..., :3], painted)
            place = (patch.left, patch.top, patch.width, patch.height)
            file.write(b"\x2c" + struct.pack("<HHHHB", *place, 0x87) + table + data)
            before = frame
        file.write(b"\x3b")


def _write_control(file: BinaryIO, ticks: int, afterwards: int) -> None:
    flags = afterwards << 2 | 1
    file.write(b"\x21\xf9\x04" + struct.pack("<BHB", flags, ticks, COLOURS - 1) + b"\0")


def _compressed(pixels: Bytes, painted: Mask) -> tuple[bytes, bytes]:
    """The palette, 768 bytes, and the compressed indices of an image, (H, W, 3), or parts of it."""
    image = pillow()
    colours = image.fromarray(np.ascontiguousarray(pixels))
    counted = pixels[painted] if painted.any() else pixels[:1, 0]
    paletted = image.fromarray(np.ascontiguousarray(counted[None]))
    paletted = paletted.quantize(COLOURS - 1, image.Quantize.MEDIANCUT)
    # Found first, then dithered to: asked for both at once Pillow does not dither.
    paletted = colours.quantize(palette=paletted, dither=image.Dither.FLOYDSTEINBERG)
    indices = np.array(paletted)
    indices[~painted] = COLOURS - 1
    table = bytes(paletted.getpalette("RGB") or b"").ljust(3 * COLOURS, b"\0")[: 3 * COLOURS]
    plain = image.fromarray(indices)
    plain.putpalette(table)
    still = io.BytesIO()
    plain.save(still, "GIF", optimize=False, interlace=False)
    data = still.getvalue()
    place = 13 + _table_size(data[10])
    while data[place] != 0x2C:  # extensions, in blocks that say their length
        place += 2
        while data[place]:
            place += data[place] + 1
        place += 1
    place += 10 + _table_size(data[place + 9])
    return table, data[place:-1]


def _table_size(flags: int) -> int:
    """Bytes of the colour table that a descriptor's flags tell of ([Gif]_, section 18)."""
    return 3 * (2 << (flags & 7)) if flags & 0x80 else 0
