"""One outline: a run of cubic Bezier curves."""

from dataclasses import dataclass

import numpy as np

from shapetween.base.arrays import Affine, Curves, Points, frozen
from shapetween.base.errors import ShapeError
from shapetween.geometry import bezier
from shapetween.geometry.affine import mapped

__all__ = ["Outline"]

#: Distance of an outline's ends, as a share of its size, up to which they are one place. Smaller,
#: and arcs that end a rounding off their start get a side without length, which has no direction;
#: larger, and short sides are lost.
MEETS = 1e-9


@dataclass(frozen=True, slots=True, eq=False)
class Outline:
    """Cubic Bezier curves, each starting where the one before it ended.

    Attributes
    ----------
    curves : (N, 4, 2) float64
        Control points in user units, N at least 1.
    closed : bool
        Whether the last curve ends where the first one starts.
    """

    curves: Curves
    closed: bool = True

    def __post_init__(self) -> None:
        """Copy, check and lock the curves."""
        curves = frozen(self.curves, np.float64, last=(4, 2))
        if len(curves) == 0:
            raise ShapeError("an outline needs at least one curve")
        gaps = curves[1:, 0] - curves[:-1, 3]
        if gaps.any() or (self.closed and (curves[0, 0] != curves[-1, 3]).any()):
            raise ShapeError("an outline's curves must follow one another without a gap")
        object.__setattr__(self, "curves", curves)

    @property
    def area(self) -> float:
        """Signed area inside, positive when the outline runs clockwise as drawn."""
        return bezier.signed_area(self.curves)

    @property
    def box(self) -> Points:
        """Least and greatest corner of the drawn curve's bounding box, (2, 2).

        Taken from 16 chords a curve, so within 0.2 % of a curve's own size.
        """
        points = np.concatenate([bezier.flatten(self.curves, 16), self.curves[-1:, 3]])
        x, y = points[:, 0], points[:, 1]  # both at once take ten times as long
        return np.array([[x.min(), y.min()], [x.max(), y.max()]])

    def close(self) -> "Outline":
        """The outline with a straight line back to its start, if it is open and ends elsewhere."""
        if self.closed:
            return self
        start, end = self.curves[0, 0], self.curves[-1, 3]
        if np.abs(end - start).max() <= MEETS * np.ptp(self.curves.reshape(-1, 2), axis=0).max():
            curves = self.curves.copy()
            curves[-1, 3] = start
            return Outline(curves)
        return Outline(np.concatenate([self.curves, bezier.line_curves(end, start)[None]]))

    def reversed(self) -> "Outline":
        """The same curve run the other way, from the same start if it is closed."""
        return Outline(self.curves[::-1, ::-1], self.closed)

    def clockwise(self) -> "Outline":
        """The same outline, run clockwise as drawn if it is closed."""
        return self.reversed() if self.closed and self.area < 0 else self

    def transformed(self, matrix: Affine) -> "Outline":
        """Every control point mapped by an affine map, (2, 3)."""
        return Outline(mapped(self.curves, matrix), self.closed)
