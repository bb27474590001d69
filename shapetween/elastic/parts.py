"""A filled shape through the movement: bodies that move by themselves, and what rides on them."""

from dataclasses import dataclass

import numpy as np

from shapetween.attach.passengers import Passenger
from shapetween.attach.riders import Rider
from shapetween.base.arrays import Curves, Floats, Mask, Points
from shapetween.deform.check import crossing_frames
from shapetween.model.blend import blend
from shapetween.model.paint import Style
from shapetween.model.whole import WholeMotion
from shapetween.outline.body import Carried

__all__ = ["FilledPart"]


@dataclass(frozen=True, slots=True, eq=False)
class FilledPart:
    """A filled shape: bodies that move, and rings that open and close on them.

    Attributes
    ----------
    name : str
    styles : (Style, Style)
    bodies : tuple of Carried
    passengers : tuple of Passenger
    specks : tuple of Rider
        Pieces too small for meshes, as closed lines.
    motion : WholeMotion or None
        What gradients follow.
    """

    name: str
    styles: tuple[Style, Style]
    bodies: tuple[Carried, ...]
    passengers: tuple[Passenger, ...] = ()
    specks: tuple[Rider, ...] = ()
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
        return np.concatenate([*drawn, *self._ridden(t, solved)], axis=1)

    def crossing(self, t: Floats) -> Mask:
        """At which times (F,) a ring that rides on the bodies crosses itself."""
        riders: tuple[Passenger | Rider, ...] = (*self.passengers, *self.specks)
        counts = [n for rider in riders for n in rider.counts]
        if not counts:
            return np.zeros(len(t), dtype=bool)
        solved = {id(body): body.path.vertices(t) for body in self.bodies}
        drawn = np.concatenate(self._ridden(t, solved), axis=1)
        return crossing_frames(drawn, counts, [True] * len(counts))

    def _ridden(self, t: Floats, solved: dict[int, Points]) -> list[Curves]:
        """Control points of what rides, with the bodies' vertices at the times."""
        riding = [rider.curves(t, solved.get(id(rider.on))) for rider in self.passengers]
        return riding + [speck.curves(t) for speck in self.specks]

    def style(self, t: float) -> Style:
        """Paint at one time."""
        return blend(*self.styles, t, self.motion)

    @property
    def _riders(self) -> tuple[Carried | Passenger | Rider, ...]:
        return (*self.bodies, *self.passengers, *self.specks)
