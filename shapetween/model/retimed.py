"""A part on a clock of its own."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from shapetween.base.arrays import Curves, Floats
from shapetween.model.movement import Part, curves_at
from shapetween.model.paint import Style

__all__ = ["RetimedPart"]


@dataclass(frozen=True, slots=True, eq=False)
class RetimedPart:
    """A part that is shown at other times than it is asked for.

    Attributes
    ----------
    part : Part
    times : callable
        From times that are asked for (F,) to those that are shown, which may be past the ends.
    """

    part: Part
    times: Callable[[Floats], Floats]

    @property
    def name(self) -> str:
        """Name of the path, empty if it has none."""
        return self.part.name

    @property
    def rings(self) -> tuple[int, ...]:
        """Number of curves in each of its rings."""
        return self.part.rings

    @property
    def closed(self) -> tuple[bool, ...]:
        """Which of the rings are closed."""
        return self.part.closed

    def curves(self, t: Floats) -> Curves:
        """Control points at the times (F,), (F, N, 4, 2)."""
        return curves_at(self.part, self.times(np.asarray(t, np.float64)))

    def style(self, t: float) -> Style:
        """How it is painted at one time."""
        return self.part.style(float(np.clip(self.times(np.array([t]))[0], 0.0, 1.0)))
