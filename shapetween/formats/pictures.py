"""Movements as pictures: one file of moving ones, or a PNG a frame."""

from collections.abc import Callable, Iterable, Sequence
from pathlib import Path

import numpy as np

from shapetween.base.arrays import Floats
from shapetween.base.errors import OptionError
from shapetween.base.observe import Observer, unobserved
from shapetween.formats.options import WriteOptions
from shapetween.formats.plain import colour_losses
from shapetween.formats.table import Segments, Written
from shapetween.raster.encode import WRITERS, Clock
from shapetween.raster.encode.folder import write_folder
from shapetween.raster.film import Film, frame_size
from shapetween.raster.light import Bytes
from shapetween.raster.streams import counted, workers
from shapetween.svg.read.colours import plain_colour
from shapetween.timing import defaults
from shapetween.timing.easing import easing_function, even_times
from shapetween.timing.timeline import Timeline

__all__ = ["apng", "frames", "gif", "mp4", "png", "webp"]

#: Largest frame, in pixels: larger ones are a slip of the hand and fill the memory.
MOST_PIXELS = 64_000_000


def webp(segments: Segments, options: WriteOptions, observe: Observer = unobserved) -> Written:
    """An animated WebP."""
    return _moving(".webp", segments, options, observe)


def png(segments: Segments, options: WriteOptions, observe: Observer = unobserved) -> Written:
    """An animated PNG."""
    return _moving(".png", segments, options, observe)


def apng(segments: Segments, options: WriteOptions, observe: Observer = unobserved) -> Written:
    """An animated PNG, under the name that says so."""
    return _moving(".apng", segments, options, observe)


def gif(segments: Segments, options: WriteOptions, observe: Observer = unobserved) -> Written:
    """A GIF."""
    return _moving(".gif", segments, options, observe)


def mp4(segments: Segments, options: WriteOptions, observe: Observer = unobserved) -> Written:
    """A video, which has no transparency: white is behind what has no background."""
    return _moving(".mp4", segments, options, observe)


def frames(segments: Segments, options: WriteOptions, observe: Observer = unobserved) -> Written:
    """One PNG a frame, into a folder; where two segments meet it is one frame."""
    film = _film(segments, options, even_times(options.frames))
    clock = Clock(film.count, defaults.FPS, False)
    told = colour_losses(segments.movements, "pictures")
    return _drawn(film, list(range(film.count)), clock, write_folder, observe, told)


def _moving(ending: str, segments: Segments, options: WriteOptions, observe: Observer) -> Written:
    """One file of moving pictures."""
    fps = options.fps or defaults.FPS
    steps = [max(2, round(fps * each)) - 1 for each in segments.lengths(options.duration)]
    held = round(fps * options.hold)
    if max(steps) + held > defaults.MOST_FRAMES:
        most = defaults.MOST_FRAMES
        raise OptionError(f"fps and duration: {max(steps) + held} frames; expected at most {most}")
    # What is drawn of each leg is at these times; of legs of other lengths only some of them are.
    clock = np.unique(np.concatenate([even_times(count + 1) for count in steps]))
    film = _film(segments, options, clock)
    order = _order(steps, held, options, segments, clock)
    shown = Clock(len(order), fps, options.loop != "once")
    told = colour_losses(segments.movements, f"moving pictures ({ending})")
    return _drawn(film, order, shown, WRITERS[ending], observe, told)


def _film(segments: Segments, options: WriteOptions, clock: Floats) -> Film:
    """The film of frames at moments (F,) of the way from each drawing to the next."""
    movements = segments.movements
    width, height = frame_size(movements[0].box, options.size)
    if width * height > MOST_PIXELS:
        most = MOST_PIXELS // 1_000_000
        raise OptionError(f"size {width}x{height}: expected at most {most} megapixels")
    times = easing_function(options.easing)(clock)
    behind = None if options.background is None else plain_colour(options.background)
    return Film.of(movements, times, size=(width, height), background=behind)


def _order(
    steps: Sequence[int], held: int, options: WriteOptions, segments: Segments, clock: Floats
) -> list[int]:
    """Frames in the order they are shown in, by the plan that every player has, in frames.

    A way of n frames has both ends among them. Where the last drawing is not the first one to come
    again, the frame that shows it is one more; and what is played once rests there too.
    """
    loop = "repeat" if options.loop == "once" else options.loop
    cyclic = loop == "alternate" or (options.loop == "repeat" and segments.closed)
    closed = cyclic and segments.closed
    plan = Timeline(tuple(map(float, steps)), loop, float(held), closed)
    shown = (plan.shown(float(k)) for k in range(round(plan.seconds) + (not cyclic)))
    found = []
    for leg, share in shown:
        place = round(share * steps[leg]) / steps[leg]
        found.append(leg * (len(clock) - 1) + int(np.abs(clock - place).argmin()))
    return found


def _drawn(
    film: Film,
    order: list[int],
    clock: Clock,
    write: Callable[[Path, Iterable[Bytes], Clock], None],
    observe: Observer,
    told: Sequence[str],
) -> Written:
    def put(path: Path) -> None:
        frames = film.frames(order, workers())
        write(path, counted(frames, len(order), observe), clock)

    return Written.of(put, (*film.warnings, *told))
