"""Everything that can be asked of a writer, with what it is where nobody asks.

This module is imported for its defaults before numpy is; what checks a value comes late.
"""

from dataclasses import dataclass, fields
from typing import Any, Literal

from shapetween.base.errors import OptionError
from shapetween.timing import defaults

__all__ = ["CSS_FORMS", "STARTS", "WriteOptions", "write_names", "write_options"]

#: What a style sheet can animate.
CSS_FORMS = ("path", "shape", "d")

#: Most seconds between two parts: more is a slip of the hand.
MOST_STAGGER = 3600.0

#: What can set a movement going; an SVG by itself has only the first three.
STARTS = ("load", "click", "hover", "seen", "scroll", "drag")


@dataclass(frozen=True, slots=True)
class WriteOptions:
    """How a movement is written; no format has a use for all of it.

    Attributes
    ----------
    duration : float
        Seconds of one way, from each drawing to the next.
    easing : str
        That of each way; see `shapetween.timing.easing.easing_function`. The default shows at
        every moment what the frame of that time shows.
    loop : {"once", "repeat", "alternate"}
        Stay at the end, start over, or go back through all of them and start over.
    hold : float
        Seconds that each drawing stands still.
    keyframes : "auto" or int
        By default as few as keep every point within a quarter of a pixel where the view box is
        1000 px large; or a number of them, even along the easing.
    precision : int, optional
        Decimals of coordinates; by default about 1/10000 of the larger side of the view box, or
        of what is drawn where that is smaller.
    frames : int
        How many separate frames from each drawing to the next, both counted.
    easing_over : {"leg", "chain"}
        Whether the easing is that of each way, or of all of a chain as a whole.
    stagger : float
        Seconds between the moments at which one part and the next set off; each of them moves for
        `duration`.
    stagger_by : {"order", "distance", "left"}
        Which sets off first: what is painted first, what is nearest to the middle of the drawing,
        or what is farthest to the left. Parts at one place set off together.
    start : {"load", "click", "hover", "seen", "scroll", "drag"}
        What sets it going: the page, a click, with the next one going back, a pointer over it,
        being seen, being scrolled past, or being dragged across.
    css : {"path", "shape", "d"}
        What a style sheet animates: a clip path in pixels, one in shares of its box, or the data of
        a path in an SVG.
    fps : float, optional
        Frames a second of moving pictures; `shapetween.timing.defaults.FPS` if left out.
    size : (width, height) or (width,), optional
        Of pictures, in pixels.
    background : str, optional
        A colour behind the drawings.
    """

    duration: float = defaults.DURATION
    easing: str = defaults.EASING
    loop: Literal["once", "repeat", "alternate"] = "once"
    hold: float = 0.0
    keyframes: Literal["auto"] | int = "auto"
    precision: int | None = None
    frames: int = 24
    easing_over: Literal["leg", "chain"] = "leg"
    stagger: float = 0.0
    stagger_by: Literal["order", "distance", "left"] = "order"
    start: Literal["load", "click", "hover", "seen", "scroll", "drag"] = "load"
    css: Literal["path", "shape", "d"] = "path"
    fps: float | None = None
    size: tuple[int, ...] | None = None
    background: str | None = None

    def __post_init__(self) -> None:
        """Check what does not depend on the drawings.

        Raises
        ------
        OptionError
            If an option cannot be used; the message says what could.
        """
        from shapetween.timing.easing import easing_function
        from shapetween.timing.timeline import Timeline

        Timeline((self.duration,), self.loop, self.hold)
        if self.easing != defaults.EASING:
            easing_function(self.easing)
        most = defaults.MOST_KEYFRAMES
        if self.keyframes != "auto" and not _whole(self.keyframes, 2, most):
            raise OptionError(f"{self.keyframes} keyframes: expected 'auto', or from 2 to {most}")
        if self.precision is not None and not _whole(self.precision, 0, 15):
            raise OptionError(
                f"precision {self.precision}: expected a number of decimals from 0 to 15"
            )
        if not _whole(self.frames, 1, defaults.MOST_FRAMES):
            raise OptionError(f"{self.frames} frames: expected from 1 to {defaults.MOST_FRAMES}")
        for name, value, known in (
            ("easing_over", self.easing_over, ("leg", "chain")),
            ("stagger_by", self.stagger_by, ("order", "distance", "left")),
        ):
            if value not in known:
                raise OptionError(f"{name} {value!r}: expected {', '.join(known)}")
        if not 0 <= self.stagger <= MOST_STAGGER:
            raise OptionError(
                f"stagger {self.stagger}: expected seconds, from 0 to {MOST_STAGGER:g}"
            )
        if self.stagger_by != "order" and self.stagger == 0:
            raise OptionError("stagger_by: changes nothing without stagger")
        if self.start not in STARTS:
            raise OptionError(f"start {self.start!r}: expected {', '.join(STARTS)}")
        if self.css not in CSS_FORMS:
            raise OptionError(f"css {self.css!r}: expected {', '.join(CSS_FORMS)}")
        if self.fps is not None and not 0 < self.fps < float("inf"):
            raise OptionError(f"fps {self.fps}: expected frames a second, above 0")
        if self.size is not None and not (
            len(self.size) in (1, 2) and all(_whole(side, 1, 100_000) for side in self.size)
        ):
            raise OptionError(f"size {self.size}: expected (width,) or (width, height) in pixels")
        if self.background is not None:
            from shapetween.svg.read.colours import plain_colour

            if plain_colour(self.background) is None:
                raise OptionError(f"background {self.background!r}: expected a colour such as #fff")

    @property
    def asked(self) -> tuple[str, ...]:
        """Names of the options that are not what they are by default, in their order here."""
        return tuple(
            field.name for field in fields(self) if getattr(self, field.name) != field.default
        )


def write_names() -> tuple[str, ...]:
    """Names of all options."""
    return tuple(field.name for field in fields(WriteOptions))


def write_options(given: dict[str, Any]) -> WriteOptions:
    """The options of some names.

    Raises
    ------
    OptionError
        If there is no option of a name, or it cannot be used.
    """
    known = write_names()
    for name in given:
        if name not in known:
            raise OptionError(f"{name}: is no option of writing; expected {', '.join(known)}")
    return WriteOptions(**given)


def _whole(value: object, low: int, high: int) -> bool:
    return isinstance(value, int) and not isinstance(value, bool) and low <= value <= high
