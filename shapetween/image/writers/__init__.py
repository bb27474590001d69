"""Frames written as they come: a folder of PNGs, APNG, WebP, GIF, MP4, chosen by OUT's ending.

Every writer is handed one frame after the other and keeps at most two, however many there are.
"""

from collections.abc import Callable, Iterable
from pathlib import Path
from typing import TypeAlias

from shapetween.errors import OptionError
from shapetween.image.light import Bytes
from shapetween.image.writers.apng import write_apng
from shapetween.image.writers.folder import write_folder
from shapetween.image.writers.gif import write_gif
from shapetween.image.writers.timing import Clock
from shapetween.image.writers.video import write_video
from shapetween.image.writers.webp import write_webp

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
