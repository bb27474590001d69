"""Animated PNG, frame by frame.

.. [PNG3] *Portable Network Graphics (PNG) Specification*, third edition, W3C, section 11.3.6.
"""

import struct
import zlib
from collections.abc import Iterable
from itertools import count
from pathlib import Path
from typing import BinaryIO

import numpy as np

from shapetween.io.files import fresh_file
from shapetween.raster.encode.timing import Clock, Patch, patch_between
from shapetween.raster.light import Bytes

__all__ = ["write_apng"]

#: zlib's level. Higher makes photographs hardly smaller and takes several times as long.
COMPRESSION = 6

#: Bytes of pixels in one chunk.
CHUNK = 1 << 20

MILLISECONDS = 1000


def write_apng(path: Path, frames: Iterable[Bytes], clock: Clock) -> None:
    """Write an animated PNG; viewers that cannot play show the first frame.

    Raises
    ------
    OptionError
        If it cannot be written; a file that was there is then still whole.
    """
    with fresh_file(path) as fresh, fresh.open("wb") as file:
        numbers = count()
        before: Bytes | None = None
        for k, frame in enumerate(frames):
            if before is None:
                _write_head(file, frame, clock)
            patch = patch_between(before, frame)
            _write_control(file, next(numbers), patch, clock.ticks(k, MILLISECONDS))
            data = _compressed(patch.of(frame))
            for start in range(0, len(data), CHUNK):
                part = data[start : start + CHUNK]
                if before is None:
                    _write_chunk(file, b"IDAT", part)
                else:
                    _write_chunk(file, b"fdAT", struct.pack(">I", next(numbers)) + part)
            before = frame
        _write_chunk(file, b"IEND", b"")


def _write_head(file: BinaryIO, frame: Bytes, clock: Clock) -> None:
    height, width, channels = frame.shape
    file.write(b"\x89PNG\r\n\x1a\n")
    colour = {3: 2, 4: 6}[channels]
    _write_chunk(file, b"IHDR", struct.pack(">IIBBBBB", width, height, 8, colour, 0, 0, 0))
    _write_chunk(file, b"sRGB", b"\0")
    plays = 0 if clock.repeats else 1
    _write_chunk(file, b"acTL", struct.pack(">II", clock.count, plays))


def _write_control(file: BinaryIO, number: int, patch: Patch, milliseconds: int) -> None:
    """Say where and how long the next frame is shown; it replaces what was there."""
    # Numerator and denominator are 16 bits wide: past a minute, whole seconds.
    whole = (milliseconds // MILLISECONDS, 1)
    seconds = (milliseconds, MILLISECONDS) if milliseconds < 1 << 16 else whole
    _write_chunk(
        file,
        b"fcTL",
        struct.pack(
            ">IIIIIHHBB",
            number,
            patch.width,
            patch.height,
            patch.left,
            patch.top,
            *seconds,
            0,
            0,
        ),
    )


def _compressed(pixels: Bytes) -> bytes:
    """Rows each filtered by "up": what little differs from the row above packs well."""
    height, width, channels = pixels.shape
    rows = pixels.reshape(height, width * channels)
    filtered = np.zeros((height, width * channels + 1), np.uint8)
    filtered[:, 0] = 2
    filtered[0, 1:] = rows[0]
    filtered[1:, 1:] = rows[1:] - rows[:-1]
    return zlib.compress(filtered.tobytes(), COMPRESSION)


def _write_chunk(file: BinaryIO, kind: bytes, data: bytes) -> None:
    file.write(struct.pack(">I", len(data)) + kind + data)
    file.write(struct.pack(">I", zlib.crc32(kind + data)))
