"""Frames written as they come: a folder of PNGs, APNG, WebP, GIF, MP4, chosen by OUT's ending.

Every writer is handed one frame after the other and keeps at most two, however many there are.
"""

from collections.abc import Callable, Iterable
from pathlib import Path
from typing import TypeAlias

from shapetween.base.errors import OptionError
from shapetween.raster.encode.apng import write_apng
from shapetween.raster.encode.folder import write_folder
from shapetween.raster.encode.gif import write_gif
from shapetween.raster.encode.timing import Clock
from shapetween.raster.encode.video import write_video
from shapetween.raster.encode.webp import write_webp
from shapetween.raster.light import Bytes

__all__ = ["WRITERS", "Clock", "Writer", "writer_for"]

Writer: TypeAlias = Callable[[Path, Iterable[Bytes], Clock], None]

WRITERS: dict[str, Writer] = {
    "": write_folder,
    ".png": write_apng,
    ".apng": write_apng,
    ".webp": write_webp,
    ".gif": write_gif,
    ".mp4": write_video,
}
"""What writes a file of that ending."""


def writer_for(out: Path) -> Writer:
    """The writer for an output's name.

    Raises
    ------
    OptionError
        If its ending is none that is written.
    """
    suffix = "" if out.is_dir() else out.suffix.lower()
    if suffix not in WRITERS:
        endings = ", ".join(ending for ending in WRITERS if ending)
        raise OptionError(f"{out}: expected an ending of {endings}, or a folder for PNG frames")
    return WRITERS[suffix]
