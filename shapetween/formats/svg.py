"""Movements as SVG: one file that plays, or a file a frame."""

from pathlib import Path

from shapetween.base.observe import Observer, unobserved
from shapetween.formats.options import WriteOptions
from shapetween.formats.table import Segments, Written
from shapetween.io import files
from shapetween.svg.write.sequence import frame_svg
from shapetween.svg.write.smil import smil_svg
from shapetween.timing.easing import easing_function, even_times

__all__ = ["animated", "frames"]

#: What there is to say of drawings that wait for a click or a pointer.
IN_IMG = "an <img> passes no clicks or pointers on to an SVG; put it into the page, or <object>"


def animated(segments: Segments, options: WriteOptions, observe: Observer = unobserved) -> Written:
    """All of it as the text of one animated SVG."""
    del observe
    losses = [] if options.start == "load" else [IN_IMG]
    text = smil_svg(
        *segments.movements,
        duration=segments.lengths(options.duration),
        easing=options.easing,
        loop=options.loop,
        hold=options.hold,
        closed=segments.closed,
        keyframes=options.keyframes,
        precision=options.precision,
        start=options.start,
        tell=losses.append,
    )
    return Written.of(text, losses)


def frames(segments: Segments, options: WriteOptions, observe: Observer = unobserved) -> Written:
    """One SVG a frame, into a folder; where two segments meet it is one frame."""
    del observe
    times = easing_function(options.easing)(even_times(options.frames))
    texts = [
        frame_svg(drawing, options.precision)
        for k, movement in enumerate(segments.movements)
        for drawing in movement.at(times)[min(k, 1) :]
    ]

    def write(folder: Path) -> None:
        files.write_frames(folder, texts)

    return Written(write)
