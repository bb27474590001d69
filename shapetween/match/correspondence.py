"""The value a matching is: which place of one outline becomes which place of the other."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal

import numpy as np

from shapetween.base.arrays import Affine, Floats, frozen
from shapetween.base.errors import ShapeError

__all__ = ["Confidence", "Correspondence"]

Confidence = Literal["sure", "likely", "unsure"]


@dataclass(frozen=True, slots=True, eq=False)
class Correspondence:
    """A continuous, strictly monotone matching of two closed outlines.

    Places are fractions of the outlines' lengths from their starts; between knots the matching
    is linear.

    Attributes
    ----------
    u, v : (K,) float64
        Knots along source and target: both increase strictly over exactly one turn, so the last
        knot is the first one plus 1.
    cost : float
        What the matching costs; 0 for an exact affine map. Comparable between matchings of the
        same two outlines only.
    runner_up : float
        Cost of the best matching that is a different one; infinite if there is none.
    confidence : {"sure", "likely", "unsure"}
        How likely it is the one meant: by how alike the outlines are where they are matched, and
        by how far it is ahead of the runner-up.
    turn : float
        Angle by which the source was turned to compare the two, radians; 0 is upright.
    affine : (2, 3) float64 or None
        The affine map from source to target, where the target is an affine image of the source.
    others : tuple of Correspondence
        Other matchings worth a try, best first.
    doubt : float
        What `confidence` is the word for: 0 for an exact affine map, 2 for a guess.
    even : bool
        Whether it lays an axis of the one outline onto an axis of the other, or onto the line about
        which the other is nearly even.
    lopsided : bool
        Whether it lays the axis of an even outline onto the line about which the other one is
        nearly even.
    """

    u: Floats
    v: Floats
    cost: float
    runner_up: float
    confidence: Confidence
    turn: float = 0.0
    affine: Affine | None = None
    others: tuple[Correspondence, ...] = field(default=())
    doubt: float = 0.0
    even: bool = False
    lopsided: bool = False

    def __post_init__(self) -> None:
        """Copy, check and lock the knots."""
        u, v = (frozen(knots, np.float64, ndim=1) for knots in (self.u, self.v))
        if len(u) != len(v) or len(u) < 2:
            raise ShapeError("a correspondence needs as many knots on both outlines, two or more")
        if not ((np.diff(u) > 0).all() and (np.diff(v) > 0).all()):
            raise ShapeError("the knots of a correspondence must increase strictly")
        if abs(u[-1] - u[0] - 1) > 1e-12 or abs(v[-1] - v[0] - 1) > 1e-12:
            raise ShapeError("the knots of a correspondence must span one turn")
        object.__setattr__(self, "u", u)
        object.__setattr__(self, "v", v)
        if self.affine is not None:
            object.__setattr__(self, "affine", frozen(self.affine, np.float64, ndim=2))

    def inverse(self) -> Correspondence:
        """The same matching from target to source."""
        affine = None
        if self.affine is not None:
            linear = np.linalg.inv(self.affine[:, :2])
            affine = np.column_stack([linear, -linear @ self.affine[:, 2]])
        return Correspondence(
            u=self.v,
            v=self.u,
            cost=self.cost,
            runner_up=self.runner_up,
            confidence=self.confidence,
            turn=-self.turn,
            affine=affine,
            others=tuple(other.inverse() for other in self.others),
            doubt=self.doubt,
            even=self.even,
            lopsided=self.lopsided,
        )
