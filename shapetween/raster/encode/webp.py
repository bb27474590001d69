"""Animated WebP, frame by frame.

Pillow compresses each frame; the animation around them is made here, because Pillow's own wants
all frames at once.

.. [Cont] *WebP Container Specification*, Google, 2023.
"""

import io
import struct
from collections.abc import Iterable
from pathlib import Path

from shapetween.base.errors import OptionError
from shapetween.io.files import fresh_file
from shapetween.raster.encode.timing import Clock, patch_between
from shapetween.raster.light import Bytes
from shapetween.raster.load import pillow

__all__ = ["write_webp"]

#: Of 100, for colours; alpha is kept exactly. Lower smears lettering; higher doubles the file.
QUALITY = 85

#: Widest and highest picture that WebP can hold.
LARGEST = 16383

ANIMATED, TRANSPARENT = 0x02, 0x10

#: A frame's pixels replace what was there, and stay.
REPLACE = 0x02


def write_webp(path: Path, frames: Iterable[Bytes], clock: Clock) -> None:
    """Write an animated WebP.

    Raises
    ------
    OptionError
        If frames are too large for WebP, or it cannot be written; a file that was there is then
        still whole.
    """
    with fresh_file(path) as fresh, fresh.open("wb") as file:
        before: Bytes | None = None
        for k, frame in enumerate(frames):
            height, width, channels = frame.shape
            if before is None:
                if max(width, height) > LARGEST:
                    raise OptionError(
                        f"{path}: WebP holds at most {LARGEST} pixels a side; "
                        f"expected a smaller --size than {width}x{height}"
                    )
                flags = ANIMATED | (TRANSPARENT if channels == 4 else 0)
                size = _three(width - 1) + _three(height - 1)
                file.write(b"RIFF\0\0\0\0WEBP")
                file.write(_chunk(b"VP8X", struct.pack("<I", flags) + size))
                plays = 0 if clock.repeats else 1
                file.write(_chunk(b"ANIM", struct.pack("<IH", 0, plays)))
            patch = patch_between(before, frame, step=2)
            place = (patch.left // 2, patch.top // 2, patch.width - 1, patch.height - 1)
            head = b"".join(_three(part) for part in (*place, clock.ticks(k, 1000)))
            body = _compressed(patch.of(frame))
            file.write(_chunk(b"ANMF", head + bytes([REPLACE]) + body))
            before = frame
        length = file.tell()
        file.seek(4)
        file.write(struct.pack("<I", length - 8))


def _compressed(pixels: Bytes) -> bytes:
    """The chunks of a still WebP that hold its pixels."""
    still = io.BytesIO()
    pillow().fromarray(pixels).save(still, "WEBP", quality=QUALITY, method=4)
    data = still.getvalue()
    kept, place = b"", 12
    while place < len(data):
        kind, size = struct.unpack_from("<4sI", data, place)
        end = place + 8 + size + size % 2
        if kind in (b"ALPH", b"VP8 ", b"VP8L"):
            kept += data[place:end]
        place = end
    return kept


def _chunk(kind: bytes, data: bytes) -> bytes:
    return kind + struct.pack("<I", len(data)) + data + b"\0" * (len(data) % 2)


def _three(number: int) -> bytes:
    """A number in three bytes, the least first."""
    return struct.pack("<I", number)[:3]
