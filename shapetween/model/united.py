"""Several parts of one paint as a single path."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from shapetween.base.arrays import Curves, Floats
from shapetween.geometry.bezier import signed_area
from shapetween.model.paint import Style
from shapetween.model.part import Leaf, Part

__all__ = ["united"]


def united(parts: Sequence[Part]) -> Part:
    """Parts filled alike by the rule nonzero, as one of the name and paint of the first.

    Where two of them overlap, both are to be seen: so parts that run anticlockwise are run through
    the other way, for windings of different signs would cancel.
    """
    track = _United(tuple(parts), tuple(_area(part) < 0 for part in parts))
    return Part(parts[0].name, (track,), _PaintOf(parts[0]))


@dataclass(frozen=True, slots=True, eq=False)
class _United(Leaf):
    """The rings of parts, each at its own pace.

    Attributes
    ----------
    parts : tuple of Part
    turned : tuple of bool
        Which parts run anticlockwise half-way, where both of their ends take part.
    """

    parts: tuple[Part, ...]
    turned: tuple[bool, ...]

    @property
    def counts(self) -> tuple[int, ...]:
        """Those of all parts."""
        return tuple(count for part in self.parts for count in part.rings)

    @property
    def closed(self) -> tuple[bool, ...]:
        """Those of all parts."""
        return tuple(closed for part in self.parts for closed in part.closed)

    def curves(self, t: Floats) -> Curves:
        """Control points of all parts, one after the other."""
        stacks = []
        for part, turned in zip(self.parts, self.turned, strict=True):
            stack = part.curves(t)
            first = 0
            for count in part.rings:
                ring = stack[:, first : first + count]
                stacks.append(ring[:, ::-1, ::-1] if turned else ring)
                first += count
        return np.concatenate(stacks, axis=1)


@dataclass(frozen=True, slots=True, eq=False)
class _PaintOf:
    """The paint of a part, at its pace."""

    part: Part

    def at(self, t: float) -> Style:
        """How it is painted at one time."""
        return self.part.style(t)


def _area(part: Part) -> float:
    """The signed area of all rings of a part, half-way."""
    curves = part.curves(np.array([0.5]))[0]
    edges = np.cumsum([0, *part.rings]).tolist()
    rings = [curves[a:b] for a, b in pairwise(edges)]
    return sum(signed_area(ring) for ring in rings if len(ring))
