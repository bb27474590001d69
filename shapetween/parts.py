"""Drawn paths through a movement: what pairs of shapes, and shapes without a partner, become."""

from dataclasses import dataclass, replace

import numpy as np

from shapetween.arrays import Curves, Floats, Points
from shapetween.blend import blend
from shapetween.body import Carried
from shapetween.gradients import moved_style
from shapetween.lines import LineMorph
from shapetween.outline import Outline
from shapetween.paint import Style
from shapetween.passengers import Passenger
from shapetween.whole import WholeMotion

__all__ = ["FilledPart", "LinePart", "LonePart"]


@dataclass(frozen=True, slots=True, eq=False)
class FilledPart:
    """A filled shape: bodies that move, and rings that open and close on them.

    Attributes
    ----------
    name : str
    styles : (Style, Style)
    bodies : tuple of Carried
    passengers : tuple of Passenger
    specks : tuple of LineMorph
        Pieces too small for meshes, as closed lines.
    motion : WholeMotion or None
        What gradients follow.
    """

    name: str
    styles: tuple[Style, Style]
    bodies: tuple[Carried, ...]
    passengers: tuple[Passenger, ...] = ()
    specks: tuple[LineMorph, ...] = ()
    motion: WholeMotion | None = None

    @property
    def rings(self) -> tuple[int, ...]:
        """Number of curves in each ring."""
        return tuple(n for rider in self._riders for n in rider.counts)

    @property
    def closed(self) -> tuple[bool, ...]:
        """All of the rings are closed."""
        return (True,) * len(self.rings)

    def curves(self, t: Floats) -> Curves:
        """Control points at the times (F,), (F, N, 4, 2)."""
        # Solving a plane's motion costs most: once for its body and all that ride on it.
        solved = {id(body): body.path.vertices(t) for body in self.bodies}
        drawn = [body.nodes.curves(solved[id(body)], t) for body in self.bodies]
        drawn += [rider.curves(t, solved.get(id(rider.on))) for rider in self.passengers]
        drawn += [speck.curves(t) for speck in self.specks]
        return np.concatenate(drawn, axis=1)

    def style(self, t: float) -> Style:
        """Paint at one time."""
        return blend(*self.styles, t, self.motion)

    @property
    def _riders(self) -> tuple[Carried | Passenger | LineMorph, ...]:
        return (*self.bodies, *self.passengers, *self.specks)


@dataclass(frozen=True, slots=True, eq=False)
class LinePart:
    """A shape of stroked lines.

    Attributes
    ----------
    name : str
    styles : (Style, Style)
    lines : tuple of LineMorph
    motion : WholeMotion or None
        What gradients follow.
    """

    name: str
    styles: tuple[Style, Style]
    lines: tuple[LineMorph, ...]
    motion: WholeMotion | None = None

    @property
    def rings(self) -> tuple[int, ...]:
        """Number of curves in each line."""
        return tuple(line.count for line in self.lines)

    @property
    def closed(self) -> tuple[bool, ...]:
        """Which of the lines are closed."""
        return tuple(line.closed for line in self.lines)

    def curves(self, t: Floats) -> Curves:
        """Control points at the times (F,), (F, N, 4, 2)."""
        return np.concatenate([line.curves(t) for line in self.lines], axis=1)

    def style(self, t: float) -> Style:
        """Paint at one time."""
        return blend(*self.styles, t, self.motion)


@dataclass(frozen=True, slots=True, eq=False)
class LonePart:
    """A shape without a partner: it opens from the middle of its place, or closes to it.

    Attributes
    ----------
    name : str
    whole : Style
        Its paint where it is whole.
    outlines : tuple of Outline
    arrives : bool
        Whether it is whole at the end; else at the start.
    """

    name: str
    whole: Style
    outlines: tuple[Outline, ...]
    arrives: bool

    @property
    def rings(self) -> tuple[int, ...]:
        """Number of curves in each ring."""
        return tuple(len(ring.curves) for ring in self.outlines)

    @property
    def closed(self) -> tuple[bool, ...]:
        """Which of the rings are closed."""
        return tuple(ring.closed for ring in self.outlines)

    def curves(self, t: Floats) -> Curves:
        """Control points at the times (F,), (F, N, 4, 2)."""
        curves = np.concatenate([ring.curves for ring in self.outlines])
        size = t if self.arrives else 1 - t
        result = self._centre + size[:, None, None, None] * (curves - self._centre)
        result[size == 1] = curves
        return np.asarray(result)

    def style(self, t: float) -> Style:
        """Paint at one time; gradients shrink and a stroke thins out with the shape."""
        size = t if self.arrives else 1 - t
        if size == 1:
            return self.whole
        shrunk = np.column_stack([size * np.eye(2), (1 - size) * self._centre])
        style = moved_style(self.whole, shrunk)
        stroke = style.stroke
        if stroke is None:
            return style
        dashes = tuple(d * size for d in stroke.dashes) if size > 0 else ()
        return replace(style, stroke=replace(stroke, width=stroke.width * size, dashes=dashes))

    @property
    def _centre(self) -> Points:
        boxes = np.array([ring.box for ring in self.outlines])
        return np.asarray((boxes[:, 0].min(axis=0) + boxes[:, 1].max(axis=0)) / 2)
