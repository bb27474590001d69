"""What has been prepared, as it is asked for: at a time, as frames, as a file of any format."""

from abc import ABC, abstractmethod
from math import ceil
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np

from shapetween.base.errors import OptionError
from shapetween.base.observe import Observer, unobserved
from shapetween.formats.options import WriteOptions, write_options
from shapetween.formats.table import WRITERS, Segments, Writer, Written, put, writer_of
from shapetween.model.drawing import Drawing
from shapetween.model.movement import Movement
from shapetween.timing import defaults
from shapetween.timing.easing import easing_function, even_times

__all__ = ["Moving"]


class Moving(ABC):
    """Prepared movements that follow each other: one of a pair, several of a chain."""

    __slots__ = ()

    @property
    @abstractmethod
    def movements(self) -> tuple[Movement, ...]:
        """From each drawing to the next, all in the frame of the first."""

    @property
    @abstractmethod
    def closed(self) -> bool:
        """Whether the last drawing is the first one again."""

    @property
    @abstractmethod
    def warnings(self) -> tuple[str, ...]:
        """What was lost or is doubtful, one line each."""

    @abstractmethod
    def report(self) -> dict[str, Any]:
        """How it was found and what is known of its quality, ready for JSON."""

    def at(self, t: float) -> Drawing:
        """The drawing at one time, from 0 at the first to 1 at the last, every way as long.

        Before 0 and after 1 the movement goes on as `shapetween.model.movement` says, for one way.
        """
        count = len(self.movements)
        if not -1 / count <= t <= 1 + 1 / count:
            past = "" if count == 1 else f"/{count}"
            raise OptionError(
                f"t: {t} is not from 0 to 1, nor past it by at most 1{past}, as far as movement "
                "goes on"
            )
        place = t * count
        leg = min(max(ceil(place) - 1, 0), count - 1)
        return self.movements[leg].at(np.array([place - leg]))[0]

    def frames(self, count: int, easing: str = defaults.EASING) -> list[Drawing]:
        """`count` drawings of each way, even along the easing; where two ways meet it is one."""
        times = easing_function(easing)(even_times(count))
        drawings = [movement.at(times) for movement in self.movements]
        return [*drawings[0][:1], *(drawing for way in drawings for drawing in way[1:])]

    def written(
        self,
        writer: Writer,
        options: WriteOptions,
        *,
        name: str = "morph",
        observe: Observer = unobserved,
    ) -> Written:
        """What a file of a format holds; `name` is what its format may call the movement.

        Raises
        ------
        OptionError
            If an option does not fit the format.
        """
        segments = Segments(self.movements, self.closed, name, self.warnings)
        return writer.write(segments, options, observe)

    def svg(self, **options: Any) -> str:
        """All of it as the text of one animated SVG.

        `options` are those of `shapetween.formats.options.WriteOptions`, such as ``duration`` and
        ``loop``. `duration`, `easing` and `keyframes` are those of each way, and every drawing
        stands still for `hold` seconds. Going back, or starting over, concerns the whole.
        """
        return self._text(".svg", options)

    def css(self, **options: Any) -> str:
        """All of it, if it is one filled shape, as a style sheet; `options` as for `write`."""
        return self._text(".css", options)

    def vector_drawable(self, **options: Any) -> str:
        """All of it as an animated vector drawable of Android; `options` as for `write`."""
        return self._text(".xml", options)

    def html(self, **options: Any) -> str:
        """All of it as the text of a page with a player; `options` as for `write`."""
        return self._text(".html", options)

    def lottie(self, **options: Any) -> str:
        """All of it as the text of a Lottie animation; `options` as for `write`."""
        return self._text(".json", options)

    def module(self, **options: Any) -> str:
        """All of it as the text of a JavaScript module; `options` as for `write`."""
        return self._text(".mjs", options)

    def write(self, path: str | PathLike[str], **options: Any) -> tuple[str, ...]:
        """Write all of it to a file, in the format of its ending.

        Parameters
        ----------
        path : path
            Ending in one of `shapetween.formats.table.WRITERS`.
        **options
            Those of `shapetween.formats.options.WriteOptions`.

        Returns
        -------
        tuple of str
            What the format could not hold, one line each.

        Raises
        ------
        OptionError
            If the ending is none, an option does not fit it, or the file cannot be written;
            nothing is written then.
        """
        place = Path(path)
        writer = writer_of(place)
        made = self.written(writer, write_options(options), name=place.stem)
        put(place, made)
        return made.warnings

    def _text(self, ending: str, options: dict[str, Any]) -> str:
        """What a file of an ending whose format is text holds."""
        return str(self.written(WRITERS[ending], write_options(options)).content)

    def _repr_html_(self) -> str:
        """Show it in a notebook."""
        return self.svg(loop="repeat" if self.closed else "alternate")
