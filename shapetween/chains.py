"""More than two drawings, each moved to the next, in the frame of the first."""

from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from itertools import pairwise
from math import ceil
from os import PathLike
from pathlib import Path
from typing import Any, Literal

from shapetween import report
from shapetween.api import Morph, Source, name_of, opened
from shapetween.base.errors import OptionError
from shapetween.base.observe import Observer, unobserved
from shapetween.io import files
from shapetween.model.drawing import Drawing
from shapetween.model.fit import Fit, fit_matrix
from shapetween.pipeline import Folds, Options, prepare

__all__ = ["Chain", "chain"]


@dataclass(frozen=True, slots=True, eq=False)
class Chain:
    """Prepared movements that follow each other.

    Attributes
    ----------
    legs : tuple of Morph
        From each drawing to the next, all in the frame and the user units of the first.
    names : tuple of str
        What the drawings are called, one more than legs.
    closed : bool
        Whether the last drawing is the first one again.
    """

    legs: tuple[Morph, ...] = field(repr=False)
    names: tuple[str, ...]
    closed: bool

    @property
    def warnings(self) -> tuple[str, ...]:
        """What was lost or is doubtful, one line each; what names no drawing names its leg."""
        lines = [
            line if line.startswith(tuple(f"{name}: " for name in names)) else f"{of_leg}: {line}"
            for leg, names in zip(self.legs, pairwise(self.names), strict=True)
            for of_leg in [" to ".join(names)]
            for line in leg.warnings
        ]
        return tuple(dict.fromkeys(lines))

    def at(self, t: float) -> Drawing:
        """The drawing at one time, from 0 at the first to 1 at the last, every leg as long."""
        if not 0 <= t <= 1:
            raise OptionError(f"t: {t} is not from 0 to 1")
        place = t * len(self.legs)
        leg = max(ceil(place) - 1, 0)
        return self.legs[leg].at(place - leg)

    def frames(self, count: int, easing: str = "linear") -> list[Drawing]:
        """`count` drawings of each leg, as `Morph.frames` has them; where two meet it is one."""
        drawings = [leg.frames(count, easing) for leg in self.legs]
        return drawings[0][:1] + [drawing for leg in drawings for drawing in leg[1:]]

    def svg(
        self,
        *,
        duration: float = 2.0,
        easing: str = "linear",
        loop: Literal["once", "repeat", "alternate"] = "once",
        hold: float = 0.0,
        keyframes: int | Literal["auto"] = "auto",
        precision: int | None = None,
    ) -> str:
        """All of it as the text of one animated SVG.

        `duration`, `easing` and `keyframes` are those of each leg, and every drawing stands still
        for `hold` seconds. Going back, or starting over, concerns the whole.
        """
        from shapetween.svg.write.smil import smil_svg

        return smil_svg(
            *(leg.prepared.movement for leg in self.legs),
            duration=duration,
            easing=easing,
            loop=loop,
            hold=hold,
            closed=self.closed,
            keyframes=keyframes,
            precision=precision,
        )

    def write(self, path: str | PathLike[str], **settings: Any) -> None:
        """Write all of it as one animated SVG, named so; `settings` are those of `svg`."""
        place = Path(path)
        files.check_form(place, "a movement", (".svg",))
        files.write_text(place, self.svg(**settings))

    def report(self) -> dict[str, Any]:
        """How each leg was found and what is known of its quality, ready for JSON."""
        return report.build_chain([leg.report() for leg in self.legs], self.names, self.warnings)

    def _repr_html_(self) -> str:
        """Show it in a notebook."""
        return self.svg(loop="repeat" if self.closed else "alternate")


def chain(
    drawings: Iterable[Source],
    *,
    method: str = "projective",
    quads: int | None = None,
    fit: Fit = "view",
    folds: Folds = "prevent",
    pictures: bool = False,
    observe: Observer = unobserved,
) -> Chain:
    """Prepare the movement through several drawings.

    Parameters
    ----------
    drawings : iterable of path or Drawing
        SVG files, or drawings already read, at least two. Naming the first one again at the end
        closes the chain.
    method, quads, folds, pictures
        As for `shapetween.morph`, for every leg.
    fit : {"view", "geometry", "none"}
        How each drawing is brought into the frame of the first.
    observe : Observer, optional
        Told of every stage of every leg as it begins and ends.

    Raises
    ------
    ShapetweenError
        If a file cannot be read or an option does not fit; its text is one line.
    """
    if isinstance(drawings, str | PathLike | Drawing):
        raise OptionError(f"chain: {name_of(drawings, 'one drawing')}: expected a list of drawings")
    sources = list(drawings)
    if len(sources) < 2:
        raise OptionError(f"chain: {len(sources)} drawings; expected two or more")
    options = Options(method=method, quads=quads, fit="none", folds=folds)
    names = tuple(name_of(source, f"drawing {k}") for k, source in enumerate(sources, start=1))
    with observe("read"):
        different = {_key(source): source for source in sources}
        drawn = {key: opened(source, pictures) for key, source in different.items()}
        read = [drawn[_key(source)] for source in sources]
    with observe("fit"):
        framed = [_in_frame(drawing, read[0], fit) for drawing in read]
    title = " to ".join(drawing.title for drawing in read if drawing.title)
    legs = []
    for pair, both in zip(pairwise(framed), pairwise(names), strict=True):
        prepared = prepare(*pair, options, names=both, observe=observe)
        titled = replace(prepared, movement=replace(prepared.movement, title=title))
        legs.append(Morph(titled, method))
    return Chain(tuple(legs), names, read[0] is read[-1])


def _key(source: Source) -> str | int:
    """The same for the same drawing."""
    return id(source) if isinstance(source, Drawing) else str(Path(source).absolute())


def _in_frame(drawing: Drawing, first: Drawing, fit: Fit) -> Drawing:
    """The drawing as it is to be seen in the frame of the first, whose own place is kept."""
    if drawing is first:
        return first
    return replace(drawing.transformed(fit_matrix(first, drawing, fit)), box=first.box)
