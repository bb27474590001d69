"""A part's curves at many times, and what they have in common at all of them."""

from dataclasses import dataclass

import numpy as np

from shapetween.base.arrays import Curves, Floats, Index, Mask, Points
from shapetween.geometry.merging import merged_curves
from shapetween.model.part import Part

__all__ = ["STRAIGHT", "Sampled", "enough_times", "sampled"]

#: How far a handle may lie from its chord at any time, as a share of the view box's larger side,
#: for the curve to be written as a line. Larger and soft bends break; smaller and rounding in the
#: files that drawings come from keeps lines curves, which take three times the bytes.
STRAIGHT = 8e-5

#: How far a point may be from its place where curves become one, on the way and at the ends, as
#: shares of the view box's larger side. More is seen; less keeps curves that nobody can tell apart.
MERGED, EXACT = 4.5e-5, 2e-5

#: Samples of one way: as many steps as keyframes may lie on. Fewer miss quick turns.
SAMPLES = 121

#: Control points of all samples that are held at once; of larger parts fewer samples are taken,
#: but never fewer than the least. More fill the memory.
MOST_HELD, LEAST_SAMPLES = 6_000_000, 21


@dataclass(frozen=True, slots=True, eq=False)
class Sampled:
    """One part through a movement.

    Attributes
    ----------
    rings : tuple of int
        Number of curves in each ring.
    closed : tuple of bool
    stack : (S, N, 4, 2) float64
        Control points at every sample.
    straight : (N,) bool
        Curves that are lines at all times.
    """

    rings: tuple[int, ...]
    closed: tuple[bool, ...]
    stack: Curves
    straight: Mask

    @property
    def still(self) -> bool:
        """Whether nothing moves."""
        return not np.ptp(self.stack, axis=0).any()

    @property
    def points(self) -> Index:
        """Which control points are drawn, in order, as indices into the N * 4 of all curves.

        The start of each ring, then of each curve its handles, if it is no line, and its end; the
        end of a closed ring is its start, and is left out.
        """
        order: list[int] = []
        first = 0
        for count, closed in zip(self.rings, self.closed, strict=True):
            order.append(4 * first)
            for curve in range(first, first + count):
                if not self.straight[curve]:
                    order += [4 * curve + 1, 4 * curve + 2]
                if not (closed and curve == first + count - 1):
                    order.append(4 * curve + 3)
            first += count
        return np.array(order, np.intp)

    def spread(self, values: Points) -> Curves:
        """Curves (M, N, 4, 2) of the drawn control points (M, P, 2); lines have none between."""
        place = {point: k for k, point in enumerate(self.points.tolist())}
        where: list[int] = []
        first = 0
        for count in self.rings:
            at = place[4 * first]
            for curve in range(first, first + count):
                end = place.get(4 * curve + 3, place[4 * first])
                inner = (at, end) if self.straight[curve] else (place[4 * curve + 1], at + 2)
                where += [at, *inner, end]
                at = end
            first += count
        return values[:, where].reshape(len(values), -1, 4, 2)


def sampled(part: Part, times: Floats, size: float, *, merged: bool = True) -> Sampled:
    """Sample a part.

    Parameters
    ----------
    part : Part
    times : (S,) float64
        Of the movement.
    size : float
        The view box's larger side.
    merged : bool
        Whether neighbours that are one curve at all samples may become one.
    """
    stack, rings = part.curves(times), part.rings
    if merged:
        stack, rings = merged_curves(stack, rings, MERGED * size, EXACT * size)
    return Sampled(rings, part.closed, stack, _straight(stack, STRAIGHT * size))


def enough_times(part: Part, count: int = SAMPLES) -> Floats:
    """Times from 0 to 1 that a part is sampled at: `count`, or fewer where it is very large."""
    points = 4 * max(sum(part.rings), 1)
    while count > LEAST_SAMPLES and count * points > MOST_HELD:
        count = (count - 1) // 2 + 1
    return np.linspace(0.0, 1.0, count)


def _straight(stack: Curves, tolerance: float) -> Mask:
    """Whether both handles of each curve lie on its chord, between its ends, at all times."""
    start, chord = stack[:, :, :1], stack[:, :, 3:] - stack[:, :, :1]
    length = (chord**2).sum(-1)
    handles = stack[:, :, 1:3] - start
    share = np.clip((handles * chord).sum(-1) / np.where(length > 0, length, 1.0), 0.0, 1.0)
    away = handles - share[..., None] * chord
    return np.asarray(((away**2).sum(-1) <= tolerance**2).all(axis=(0, 2)))
