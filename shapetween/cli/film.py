"""Drawings' movements written as pictures instead of SVG."""

import os
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

from shapetween.base.errors import OptionError
from shapetween.io.progress import Progress

if TYPE_CHECKING:
    from shapetween.api import Morph
    from shapetween.chains import Chain
    from shapetween.model.paint import Colour
    from shapetween.raster.film import Film
    from shapetween.raster.light import Bytes

__all__ = [
    "DEFAULT_FPS",
    "MOST_FRAMES",
    "PICTURES",
    "counted",
    "moving_pictures",
    "still_pictures",
    "workers",
]

#: Endings of films; see `shapetween.raster.encode.WRITERS`.
PICTURES = (".webp", ".png", ".apng", ".gif", ".mp4")

#: Frames drawn at the same time, at most: each needs memory of its own.
MOST_WORKERS = 4

#: Frames a second where that is not asked for, and most frames of a file.
DEFAULT_FPS, MOST_FRAMES = 30.0, 100_000

#: Largest frame, in pixels: larger ones are a slip of the hand and fill the memory.
MOST_PIXELS = 64_000_000


Writer: TypeAlias = Callable[[Path], None]
"""Writes what it was made for to a place."""

Ready: TypeAlias = tuple[Writer, tuple[str, ...]]
"""What writes a film, and what there is to warn of."""


def moving_pictures(
    result: "Morph | Chain",
    out: Path,
    run: Progress,
    fps: float | None,
    size: tuple[int, ...] | None,
    background: str | None,
    timing: Mapping[str, Any],
) -> Ready:
    """Prepare one file of moving pictures.

    Parameters
    ----------
    result : Morph or Chain
        Prepared with pictures.
    out : Path
        One of `PICTURES`.
    run : Progress
    fps : float, optional
        Frames a second.
    size : (width, height) or (width,), optional
    background : str, optional
        A colour.
    timing : Mapping
        What `Chain.svg` takes: duration, easing, loop and hold.

    Raises
    ------
    ShapetweenError
        If the film cannot be drawn as asked.
    """
    from shapetween.raster.encode import Clock, writer_for

    write, fps = writer_for(out), fps or DEFAULT_FPS
    count = max(2, round(fps * timing["duration"]))
    held = 1 + round(fps * timing["hold"])
    if count + held > MOST_FRAMES:
        raise OptionError(f"--fps and --duration: {count + held} frames; expected {MOST_FRAMES}")
    film = _film(result, count, timing["easing"], size, background)
    closed = getattr(result, "closed", False)
    order = _order(film, held, timing["loop"], closed)
    clock = Clock(len(order), fps, timing["loop"] != "once")
    frames = counted(film.frames(order, workers()), len(order), run)
    return lambda path: write(path, frames, clock), film.warnings


def still_pictures(
    result: "Morph | Chain",
    run: Progress,
    count: int,
    easing: str,
    size: tuple[int, ...] | None,
    background: str | None,
) -> Ready:
    """Prepare a folder of PNG frames, `count` from each drawing to the next.

    Raises
    ------
    ShapetweenError
        If the film cannot be drawn as asked.
    """
    from shapetween.raster.encode import Clock
    from shapetween.raster.encode.folder import write_folder

    film = _film(result, count, easing, size, background)
    frames = counted(film.frames(None, workers()), film.count, run)
    clock = Clock(film.count, DEFAULT_FPS, False)
    return lambda path: write_folder(path, frames, clock), film.warnings


def _film(
    result: "Morph | Chain",
    count: int,
    easing: str,
    size: tuple[int, ...] | None,
    background: str | None,
) -> "Film":
    from shapetween.api import Morph
    from shapetween.raster.film import Film, frame_size
    from shapetween.timing.easing import easing_function, even_times

    legs = (result,) if isinstance(result, Morph) else result.legs
    movements = [leg.prepared.movement for leg in legs]
    width, height = frame_size(movements[0].box, size)
    if width * height > MOST_PIXELS:
        most = MOST_PIXELS // 1_000_000
        raise OptionError(f"--size {width}x{height}: expected at most {most} megapixels")
    times = easing_function(easing)(even_times(count))
    return Film.of(movements, times, size=(width, height), background=_colour(background))


def _order(film: "Film", held: int, loop: str, closed: bool) -> list[int]:
    """Frames in the order they are shown in, those of the drawings `held` times."""
    ends = set(film.ends)
    last = film.count - 1
    way = [k for k in range(1, last) for _ in range(held if k in ends else 1)]
    if loop == "repeat" and closed:
        return [0] * held + way
    there = [0] * held + way + [last] * held
    return there + way[::-1] if loop == "alternate" else there


def workers() -> int:
    """How many frames to draw at once."""
    return min(MOST_WORKERS, os.cpu_count() or 1)


def counted(frames: "Iterator[Bytes]", count: int, run: Progress) -> "Iterator[Bytes]":
    """Frames, while the progress says which one it is at."""
    for k, frame in enumerate(frames):
        with run(f"frame {k + 1} of {count}"):
            yield frame


def _colour(text: str | None) -> "Colour | None":
    if text is None:
        return None
    from shapetween.model.paint import Colour
    from shapetween.svg.read.colours import parse_paint

    value: Any = parse_paint(text)
    if value is None or value.reference or not isinstance(value.colour, Colour):
        raise OptionError(f"--background {text!r}: expected a colour such as #fff")
    return value.colour
