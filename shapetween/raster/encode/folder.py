"""One PNG a frame."""

from collections.abc import Iterable
from pathlib import Path

from shapetween.io.files import fresh_frames
from shapetween.raster.encode.timing import Clock
from shapetween.raster.light import Bytes
from shapetween.raster.load import pillow

__all__ = ["write_folder"]

#: zlib's level. Higher makes photographs hardly smaller and takes several times as long.
COMPRESSION = 3


def write_folder(path: Path, frames: Iterable[Bytes], clock: Clock) -> None:
    """Write ``frame_0000.png`` and so on into a folder.

    Raises
    ------
    OptionError
        If they cannot be written; the folder is then as it was before.
    """
    image = pillow()
    with fresh_frames(path, ".png") as folder:
        for k, frame in enumerate(frames):
            image.fromarray(frame).save(folder / f"frame_{k:04}.png", compress_level=COMPRESSION)
    del clock
