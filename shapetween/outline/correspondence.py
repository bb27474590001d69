"""What is told of two matched rings: which points belong together, in each drawing's own units."""

from __future__ import annotations

from dataclasses import dataclass

from shapetween.base.arrays import Affine, Floats, Points
from shapetween.geometry.affine import mapped
from shapetween.outline.body import RingMatch

__all__ = ["RingCorrespondence"]


@dataclass(frozen=True, slots=True, eq=False)
class RingCorrespondence:
    """Matched points of one ring of each drawing.

    Attributes
    ----------
    name : str
        Of the shape that the ring belongs to; empty where it has none.
    hole : bool
    w : (N,) float64
        Places in the common parameter, the mean of the fractions of both lengths, strictly
        increasing in [0, 1).
    source, target : (N, 2) float64
        The points at these places, each in its own drawing's user units.
    """

    name: str
    hole: bool
    w: Floats
    source: Points
    target: Points

    @classmethod
    def of(cls, name: str, ring: RingMatch, back: Affine) -> RingCorrespondence:
        """What a ring's matching says.

        Parameters
        ----------
        name : str
        ring : RingMatch
        back : (2, 3) float64
            From the movement's frame to the second drawing's units.
        """
        samples = ring.samples
        return cls(name, ring.hole, samples.w, samples.source, mapped(samples.target, back))

    def moved(self, source: Affine, target: Affine) -> RingCorrespondence:
        """The same with the points of each drawing mapped by a map of its own, (2, 3)."""
        ends = mapped(self.source, source), mapped(self.target, target)
        return RingCorrespondence(self.name, self.hole, self.w, *ends)
