"""A fill through the movement: bodies that move by themselves, and what is attached to them."""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from shapetween.base.arrays import Curves, Floats, Mask, Points, side_by_side
from shapetween.deform.check import crossing_frames
from shapetween.deform.deformation import Deformation
from shapetween.fill.appearing import AppearingRegion
from shapetween.fill.small import BlendedCurve
from shapetween.model.part import Change, CurveTrack
from shapetween.model.whole import MOTION_TIMES, WholeMotion
from shapetween.outline.body import Carried

__all__ = ["FillTrack", "fills_of"]


@dataclass(frozen=True, slots=True, eq=False)
class FillTrack:
    """The rings of a fill: those of bodies that move, and what opens and closes on them.

    Attributes
    ----------
    name : str
        The shape's.
    bodies : tuple of Carried
    appearing : tuple of AppearingRegion
    small : tuple of BlendedCurve
        Pieces too small for meshes, as closed lines.
    """

    name: str
    bodies: tuple[Carried, ...]
    appearing: tuple[AppearingRegion, ...] = ()
    small: tuple[BlendedCurve, ...] = ()

    @property
    def counts(self) -> tuple[int, ...]:
        """Number of curves in each ring."""
        return tuple(n for track in self._tracks for n in track.counts)

    @property
    def closed(self) -> tuple[bool, ...]:
        """All of the rings are closed."""
        return (True,) * len(self.counts)

    @property
    def areas(self) -> tuple["FillTrack", ...]:
        """All of it."""
        return (self,)

    @property
    def deformations(self) -> tuple[Deformation, ...]:
        """What moves the bodies."""
        return tuple(body.path for body in self.bodies)

    def curves(self, t: Floats) -> Curves:
        """Control points at the times (F,), (F, N, 4, 2)."""
        # Solving a motion costs most: once for its body and all that is bound to it.
        solved = {id(body): body.path.vertices(t) for body in self.bodies}
        drawn = [body.nodes.curves(solved[id(body)], t) for body in self.bodies]
        return side_by_side([*drawn, *self._attached(t, solved)])

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

    def following(self, change: Change) -> CurveTrack:
        """Itself, changed."""
        return change(self)

    def whole_motion(self) -> WholeMotion | None:
        """The motion of all bodies as one, which gradients follow."""
        inside, areas = zip(*(body.inside(MOTION_TIMES) for body in self.bodies), strict=True)
        return WholeMotion.of(np.concatenate(inside, axis=1), np.concatenate(areas))

    @property
    def _tracks(self) -> tuple[Carried | AppearingRegion | BlendedCurve, ...]:
        return (*self.bodies, *self.appearing, *self.small)


def fills_of(tracks: Iterable[CurveTrack]) -> tuple[FillTrack, ...]:
    """The fills that meshes move among what tracks are made of."""
    areas = (area for track in tracks for area in track.areas)
    return tuple(area for area in areas if isinstance(area, FillTrack))
