"""Animated GIF, frame by frame, each with a palette of its own.

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

from shapetween.errors import OptionError
from shapetween.files import fresh_file
from shapetween.image.light import Bytes
from shapetween.image.load import pillow
from shapetween.image.writers.timing import Clock, patch_between

__all__ = ["write_gif"]

#: Ticks a second, and the fewest for a frame: players take less for a mistake and show it long.
HUNDREDTHS, LEAST_TICKS = 100, 2

#: Widest and highest picture that GIF can hold.
LARGEST = 65535

#: Colours of a palette; with transparency the last stands for it.
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
            patch = patch_between(before if channels == 3 else None, frame)
            ticks = max(LEAST_TICKS, clock.ticks(k, HUNDREDTHS))
            _write_control(file, ticks, transparent=channels == 4)
            table, data = _compressed(patch.of(frame))
            place = (patch.left, patch.top, patch.width, patch.height)
            file.write(b"\x2c" + struct.pack("<HHHHB", *place, 0x87) + table + data)
            before = frame
        file.write(b"\x3b")


def _write_control(file: BinaryIO, ticks: int, *, transparent: bool) -> None:
    flags = CLEAR << 2 | 1 if transparent else KEEP << 2
    index = COLOURS - 1 if transparent else 0
    file.write(b"\x21\xf9\x04" + struct.pack("<BHB", flags, ticks, index) + b"\0")


def _compressed(pixels: Bytes) -> tuple[bytes, bytes]:
    """The palette, 768 bytes, and the compressed indices of an image."""
    image = pillow()
    transparent = pixels.shape[2] == 4
    colours = image.fromarray(np.ascontiguousarray(pixels[..., :3]))
    paletted = colours.quantize(COLOURS - transparent, image.Quantize.MEDIANCUT)
    # Found first, then dithered to: asked for both at once Pillow does not dither.
    paletted = colours.quantize(palette=paletted, dither=image.Dither.FLOYDSTEINBERG)
    indices = np.array(paletted)
    if transparent:
        indices[pixels[..., 3] < 128] = COLOURS - 1
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
