"""MP4 by way of ffmpeg, fed one frame after the other."""

import shutil
import subprocess
import tempfile
from collections.abc import Iterable
from contextlib import suppress
from pathlib import Path
from typing import IO

import numpy as np

from shapetween.base.errors import OptionError
from shapetween.io.files import fresh_file
from shapetween.raster.encode.timing import Clock
from shapetween.raster.light import Bytes

__all__ = ["write_video"]

#: x264's constant rate factor. Lower makes files larger for nothing seen; higher smears lettering.
RATE_FACTOR = "18"


def write_video(path: Path, frames: Iterable[Bytes], clock: Clock) -> None:
    """Write an MP4 in H.264, which plays everywhere, and once.

    What is transparent becomes white. Frames of odd width or height get another column or row.

    Raises
    ------
    OptionError
        If there is no ffmpeg, it fails, or the file cannot be written; a file that was there is
        then still whole.
    """
    program = _ffmpeg()
    with fresh_file(path) as fresh, tempfile.TemporaryFile() as log:
        failed = _fed(program, fresh, frames, clock.fps, log)
        if failed:
            log.seek(0)
            lines = log.read().decode(errors="replace").strip().splitlines()
            raise OptionError(f"{path}: ffmpeg failed: {lines[-1] if lines else 'without a word'}")


def _fed(program: str, out: Path, frames: Iterable[Bytes], fps: float, log: IO[bytes]) -> bool:
    """Run ffmpeg over all frames; whether it failed."""
    rest = iter(frames)
    first = next(rest)
    command = _command(program, first.shape[1], first.shape[0], fps, out)
    pipe = subprocess.Popen(command, stdin=subprocess.PIPE, stderr=log)
    assert pipe.stdin is not None
    try:
        pipe.stdin.write(_on_white(first).tobytes())
        for frame in rest:
            pipe.stdin.write(_on_white(frame).tobytes())
        pipe.stdin.close()
        return pipe.wait() != 0
    except BrokenPipeError:  # it gave up before the last frame
        return True
    finally:
        if pipe.poll() is None:
            pipe.kill()
            pipe.wait()
        with suppress(BrokenPipeError):
            pipe.stdin.close()


def _ffmpeg() -> str:
    """The ffmpeg program: the system's, or the one that comes with imageio-ffmpeg."""
    found = shutil.which("ffmpeg")
    if found is None:
        try:
            from imageio_ffmpeg import get_ffmpeg_exe
        except ImportError as error:
            raise OptionError(
                "MP4 needs ffmpeg; install it, or: pip install 'shapetween[video]'"
            ) from error
        try:
            found = str(get_ffmpeg_exe())
        except RuntimeError as error:
            raise OptionError("MP4 needs ffmpeg, and imageio-ffmpeg has none here") from error
    return found


def _command(program: str, width: int, height: int, fps: float, out: Path) -> list[str]:
    options = {
        "-loglevel": "error",
        "-f": "rawvideo",
        "-pix_fmt": "rgb24",
        "-s": f"{width}x{height}",
        "-r": f"{fps:.10g}",
        "-i": "-",
    }
    written = {
        "-vf": "pad=ceil(iw/2)*2:ceil(ih/2)*2,scale=out_color_matrix=bt709,format=yuv420p",
        "-c:v": "libx264",
        "-crf": RATE_FACTOR,
        "-colorspace": "bt709",
        "-color_primaries": "bt709",
        "-color_trc": "iec61966-2-1",
        "-movflags": "+faststart",
        "-fflags": "+bitexact",
        "-flags:v": "+bitexact",
        "-f": "mp4",
    }
    flat = [part for table in (options, written) for pair in table.items() for part in pair]
    return [program, "-y", *flat, str(out)]


def _on_white(frame: Bytes) -> Bytes:
    """A frame without transparency; edges are mixed as players of pictures do."""
    if frame.shape[2] == 3:
        return frame
    alpha = frame[..., 3:].astype(np.float32) / 255
    mixed = frame[..., :3] * alpha + 255 * (1 - alpha)
    return np.rint(mixed).astype(np.uint8)
