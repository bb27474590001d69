"""A movement: drawn paths that keep their structure through time.

What every writer takes. Nothing here knows how the paths are moved.

A movement runs from 0 to 1. An easing that overshoots asks for a little more: past an end every
point goes on as it came, mirrored at the point where it is then (X(1 + s) = 2 X(1) - X(1 - s)). So
nothing jumps or turns a corner there, what parts share stays shared, and no farther than one whole
way past either end is anything known. Paint stays as it is at the end.
"""

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from shapetween.base.arrays import Curves, Floats
from shapetween.base.errors import OptionError
from shapetween.model.drawing import Box, Drawing, Shape
from shapetween.model.outline import Outline
from shapetween.model.paint import Style

__all__ = ["BEYOND", "Movement", "Part", "curves_at"]

#: First and last time at which a movement answers: one way past either end.
BEYOND = (-1.0, 2.0)


class Part(Protocol):
    """One drawn path through the whole movement."""

    @property
    def name(self) -> str:
        """Name of the path, empty if it has none."""

    @property
    def rings(self) -> tuple[int, ...]:
        """Number of curves in each of its rings, the same at every time."""

    @property
    def closed(self) -> tuple[bool, ...]:
        """Which of the rings are closed."""

    def curves(self, t: Floats) -> Curves:
        """Control points at the times (F,), ring after ring, shape (F, N, 4, 2)."""

    def style(self, t: float) -> Style:
        """How it is painted at one time."""


@dataclass(frozen=True, slots=True, eq=False)
class Movement:
    """Parts in paint order, the box they are seen in, and the root's attributes in a page."""

    parts: tuple[Part, ...]
    box: Box
    title: str = ""
    page: tuple[tuple[str, str], ...] = ()

    def at(self, t: Floats) -> tuple[Drawing, ...]:
        """The drawings at the times (F,), one each, which may be past the ends."""
        stacks = [curves_at(part, t) for part in self.parts]
        drawings = []
        for frame, time in enumerate(t):
            shapes = []
            for part, stack in zip(self.parts, stacks, strict=True):
                rings, first = [], 0
                for count, closed in zip(part.rings, part.closed, strict=True):
                    rings.append(Outline(stack[frame, first : first + count], closed))
                    first += count
                shapes.append(
                    Shape(tuple(rings), part.style(min(max(float(time), 0.0), 1.0)), part.name)
                )
            drawings.append(Drawing(tuple(shapes), self.box, self.title, page=self.page))
        return tuple(drawings)


def curves_at(part: Part, t: Floats) -> Curves:
    """Control points of a part at times that may be past the ends, (F, N, 4, 2).

    Raises
    ------
    OptionError
        If a time is farther past an end than one whole way.
    """
    if not t.size or (t.min() >= 0 and t.max() <= 1):
        return part.curves(t)
    low, high = BEYOND
    if not (t.min() >= low and t.max() <= high):
        raise OptionError(f"t: expected from {low:g} to {high:g}, past the ends by a way at most")
    inside = part.curves(np.where(t < 0, -t, np.where(t > 1, 2 - t, t)))
    ends = part.curves(np.array([0.0, 1.0]))
    for outside, end in ((t < 0, ends[0]), (t > 1, ends[1])):
        inside = np.where(outside[:, None, None, None], 2 * end - inside, inside)
    return np.asarray(inside)
