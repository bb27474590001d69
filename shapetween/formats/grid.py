"""A grid of whole numbers over a view box, for formats that hold many coordinates."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from shapetween.base.arrays import Floats, Index
from shapetween.base.errors import OptionError
from shapetween.model.drawing import Box, Drawing
from shapetween.svg.write.numbers import LARGEST_EXACT, LEAST_DRAWN

__all__ = ["Grid", "grid_of"]

#: Cells along the larger side of the view box, or of what is drawn where that is smaller: 0.1 px
#: at 1000 px. Fewer and curves show steps when enlarged; more and files grow unseen.
CELLS = 10_000


@dataclass(frozen=True, slots=True)
class Grid:
    """Where whole numbers lie in the plane.

    Attributes
    ----------
    box : Box
        Its corner is the origin.
    step : float
        User units of one cell.
    """

    box: Box
    step: float

    def cells(self, points: Floats) -> Index:
        """Coordinates of points (..., 2) to the nearest whole number.

        Raises
        ------
        OptionError
            If one has more digits than a double carries.
        """
        scaled = (points - (self.box.x, self.box.y)) / self.step
        if scaled.size and float(np.abs(scaled).max()) >= LARGEST_EXACT:
            raise OptionError("a coordinate has too many digits; expected a lower precision")
        return np.rint(scaled).astype(np.int64)

    @property
    def size(self) -> tuple[float, float]:
        """Width and height of the view box in cells."""
        return self.box.width / self.step, self.box.height / self.step


def grid_of(ends: Sequence[Drawing], precision: int | None) -> Grid:
    """The grid for drawings in one view box, as fine as the smallest of them needs.

    Parameters
    ----------
    ends : sequence of Drawing
        The drawings that movements start and end with.
    precision : int, optional
        Decimals of user units that the user has asked for.
    """
    box = ends[0].box
    if precision is not None:
        return Grid(box, 10.0**-precision)
    page = max(box.width, box.height)
    sizes = [max(d.drawn.width, d.drawn.height) for d in ends if d.shapes]
    size = max(min([page, *sizes]), LEAST_DRAWN * page)
    return Grid(box, size / CELLS)
