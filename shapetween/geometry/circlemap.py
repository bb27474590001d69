"""Monotone maps of a circle onto a circle, both of length 1, as piecewise linear functions."""

from dataclasses import dataclass

import numpy as np

from shapetween.base.arrays import Floats, frozen
from shapetween.base.errors import ShapeError

__all__ = ["SAME", "CircleMap", "turn", "wrapped"]

#: Knots nearer than this are one: more is lost to rounding in the places themselves.
SAME = 1e-12


def turn(values: Floats) -> Floats:
    """Places on the circle, in [0, 1)."""
    rest = values - np.floor(values)
    return np.asarray(np.where(rest < 1, rest, 0.0))


def wrapped(values: Floats) -> Floats:
    """Signed way round the circle, in [-0.5, 0.5)."""
    return np.asarray(turn(values + 0.5) - 0.5)


@dataclass(frozen=True, slots=True, eq=False)
class CircleMap:
    """A strictly increasing function with f(x + 1) = f(x) + 1, linear between its knots.

    Attributes
    ----------
    x, y : (K,) float64
        Knots over one turn, both strictly increasing; the last is the first, a turn later.

    Raises
    ------
    ShapeError
        If the knots do not increase, or do not close after a turn.
    """

    x: Floats
    y: Floats

    def __post_init__(self) -> None:
        """Copy, check and lock the knots."""
        for name in ("x", "y"):
            knots = frozen(getattr(self, name), np.float64, ndim=1)
            object.__setattr__(self, name, knots)
            if (
                len(knots) < 2
                or abs(knots[-1] - knots[0] - 1) > 1e-9
                or (np.diff(knots) <= 0).any()
            ):
                raise ShapeError(f"{name}: knots must increase over exactly one turn")
        if len(self.x) != len(self.y):
            raise ShapeError(f"{len(self.x)} knots with {len(self.y)} values")

    def __call__(self, x: Floats) -> Floats:
        """Values at any x, (N,); one turn further on, they are 1 greater."""
        turns = np.floor(x - self.x[0])
        return np.asarray(np.interp(x - turns, self.x, self.y) + turns)

    def inverse(self) -> "CircleMap":
        """The map back."""
        return CircleMap(self.y, self.x)

    def bent(self, old: Floats, new: Floats) -> "CircleMap":
        """The same map after its parameter is moved: what was at `old` comes to be at `new`.

        Parameters
        ----------
        old, new : (M,) float64
            In the same cyclic order; each pair less than half a turn apart.
        """
        if not len(old):
            return self
        order = np.argsort(turn(old))
        start = turn(old)[order]
        end = start + wrapped(new - old)[order]
        move = CircleMap(np.append(start, start[0] + 1), np.append(end, end[0] + 1))
        first = self.x[0]
        x = np.union1d(self.x[:-1], first + turn(start - first))
        moved, values = move(x), self(x)
        keep = np.append(True, (np.diff(moved) > SAME) & (np.diff(values) > SAME))
        # The first knot comes again a turn later; what coincides with that is it.
        keep[1:] &= (moved[1:] < moved[0] + 1 - SAME) & (values[1:] < values[0] + 1 - SAME)
        moved, values = moved[keep], values[keep]
        return CircleMap(np.append(moved, moved[0] + 1), np.append(values, values[0] + 1))
