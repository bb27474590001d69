"""SVG to pixels, by way of resvg, an extra that is imported when it is needed."""

import io
import subprocess
import sys
from pathlib import Path
from types import ModuleType

import numpy as np

from shapetween.base.errors import InputError, OptionError
from shapetween.raster.light import Bytes
from shapetween.raster.load import pillow
from shapetween.raster.resvg_apart import SECONDS

__all__ = ["drawn", "drawn_apart", "resvg"]


def resvg() -> ModuleType:
    """The renderer's module.

    Raises
    ------
    OptionError
        If it is not installed.
    """
    try:
        import resvg_py
    except ImportError as error:
        raise OptionError(
            "drawings as pictures need resvg; install it with: pip install 'shapetween[image]'"
        ) from error
    module: ModuleType = resvg_py
    return module


def drawn(text: str, width: int, height: int) -> Bytes:
    """Pixels of an SVG that this program wrote, (height, width, 4), alpha not multiplied in."""
    png = resvg().svg_to_bytes(
        svg_string=text, dpi=96, width=width, height=height, skip_system_fonts=True
    )
    return _pixels(bytes(png), width, height)


def drawn_apart(text: str, width: int, height: int, name: str) -> Bytes:
    """Pixels of an SVG with parts that a stranger wrote, drawn in a process of its own.

    Raises
    ------
    InputError
        If it cannot be drawn within limits of time and memory; `name` is what the file is called.
    """
    resvg()
    program = Path(__file__).with_name("resvg_apart.py")
    # -P keeps the modules beside the program from standing in for others of their names.
    command = [sys.executable, "-P", str(program), str(width), str(height)]
    try:
        done = subprocess.run(
            command, input=text.encode(), capture_output=True, timeout=2 * SECONDS, check=False
        )
    except subprocess.TimeoutExpired as error:
        raise InputError(name, "a pattern or picture in it takes too long to draw") from error
    if done.returncode or not done.stdout:
        raise InputError(name, "a pattern or picture in it cannot be drawn")
    return _pixels(done.stdout, width, height)


def _pixels(png: bytes, width: int, height: int) -> Bytes:
    """Pixels of a PNG; a row or column that rounding added or left out is cut off or empty."""
    found = np.array(pillow().open(io.BytesIO(png)).convert("RGBA"))
    if found.shape[:2] == (height, width):
        return found
    pixels = np.zeros((height, width, 4), np.uint8)
    rows, columns = min(height, found.shape[0]), min(width, found.shape[1])
    pixels[:rows, :columns] = found[:rows, :columns]
    return pixels
