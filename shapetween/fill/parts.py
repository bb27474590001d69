"""A filled shape through the movement: bodies that move by themselves, and what is attached."""

from dataclasses import dataclass

import numpy as np

from shapetween.base.arrays import Curves, Floats, Mask, Points
from shapetween.deform.check import crossing_frames
from shapetween.fill.appearing import AppearingRegion
from shapetween.fill.small import BlendedCurve
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
    appearing : tuple of AppearingRegion
    small : tuple of BlendedCurve
        Pieces too small for meshes, as closed lines.
    motion : WholeMotion or None
        What gradients follow.
    """

    name: str
    styles: tuple[Style, Style]
    bodies: tuple[Carried, ...]
    appearing: tuple[AppearingRegion, ...] = ()
    small: tuple[BlendedCurve, ...] = ()
    motion: WholeMotion | None = None

    @property
    def rings(self) -> tuple[int, ...]:
        """Number of curves in each ring."""
        return tuple(n for track in self._tracks for n in track.counts)

    @property
    def closed(self) -> tuple[bool, ...]:
        """All of the rings are closed."""
        return (True,) * len(self.rings)

    def curves(self, t: Floats) -> Curves:
        """Control points at the times (F,), (F, N, 4, 2)."""
        # Solving a motion costs most: once for its body and all that is bound to it.
        solved = {id(body): body.path.vertices(t) for body in self.bodies}
        drawn = [body.nodes.curves(solved[id(body)], t) for body in self.bodies]
        return np.concatenate([*drawn, *self._attached(t, solved)], axis=1)

    def crossing(self, t: Floats) -> Mask:
        """At which times (F,) an attached ring crosses itself."""
        attached: tuple[AppearingRegion | BlendedCurve, ...] = (*self.appearing, *self.small)
        counts = [n for track in attached for n in track.counts]
        if not counts:
            return np.zeros(len(t), dtype=bool)
        solved = {id(body): body.path.vertices(t) for body in self.bodies}
        drawn = np.concatenate(self._attached(t, solved), axis=1)
        return crossing_frames(drawn, counts, [True] * len(counts))

    def _attached(self, t: Floats, solved: dict[int, Points]) -> list[Curves]:
        """Control points of what is attached, with the bodies' vertices at the times."""
        drawn = [region.curves(t, solved.get(id(region.on))) for region in self.appearing]
        return drawn + [curve.curves(t) for curve in self.small]

    def style(self, t: float) -> Style:
        """Paint at one time."""
        return blend(*self.styles, t, self.motion)

    @property
    def _tracks(self) -> tuple[Carried | AppearingRegion | BlendedCurve, ...]:
        return (*self.bodies, *self.appearing, *self.small)
