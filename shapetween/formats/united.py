"""Several parts of one paint as a single path."""

from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np

from shapetween.base.arrays import Curves, Floats
from shapetween.geometry.bezier import signed_area
from shapetween.model.movement import Part
from shapetween.model.paint import Style

__all__ = ["UnitedPart"]


@dataclass(frozen=True, eq=False)
class UnitedPart:
    """Parts filled alike by the rule nonzero, as one.

    Where two of them overlap, both are to be seen: so parts that run anticlockwise are run through
    the other way, for windings of different signs would cancel.
    """

    parts: tuple[Part, ...]

    @property
    def name(self) -> str:
        """That of the first."""
        return self.parts[0].name

    @property
    def rings(self) -> tuple[int, ...]:
        """Those of all parts."""
        return tuple(count for part in self.parts for count in part.rings)

    @property
    def closed(self) -> tuple[bool, ...]:
        """Those of all parts."""
        return tuple(closed for part in self.parts for closed in part.closed)

    def curves(self, t: Floats) -> Curves:
        """Control points of all parts, one after the other."""
        stacks = []
        for part, turned in zip(self.parts, self._turned, strict=True):
            stack = part.curves(t)
            first = 0
            for count in part.rings:
                ring = stack[:, first : first + count]
                stacks.append(ring[:, ::-1, ::-1] if turned else ring)
                first += count
        return np.concatenate(stacks, axis=1)

    def style(self, t: float) -> Style:
        """That of the first."""
        return self.parts[0].style(t)

    @cached_property
    def _turned(self) -> tuple[bool, ...]:
        """Which parts run anticlockwise half-way, where both of their ends take part."""
        return tuple(_area(part) < 0 for part in self.parts)


def _area(part: Part) -> float:
    """The signed area of all rings of a part, half-way."""
    curves = part.curves(np.array([0.5]))[0]
    edges = np.cumsum([0, *part.rings]).tolist()
    rings = [curves[a:b] for a, b in pairwise(edges)]
    return sum(signed_area(ring) for ring in rings if len(ring))
