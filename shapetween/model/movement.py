"""A movement: drawn paths that keep their structure through time.

What every writer takes. Nothing here knows how the paths are moved.
"""

from dataclasses import dataclass
from typing import Protocol

from shapetween.base.arrays import Curves, Floats
from shapetween.model.drawing import Box, Drawing, Shape
from shapetween.model.outline import Outline
from shapetween.model.paint import Style

__all__ = ["Movement", "Part"]


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
    """Parts in paint order, and the box they are seen in."""

    parts: tuple[Part, ...]
    box: Box
    title: str = ""

    def at(self, t: Floats) -> tuple[Drawing, ...]:
        """The drawings at the times (F,), one each."""
        stacks = [part.curves(t) for part in self.parts]
        drawings = []
        for frame, time in enumerate(t):
            shapes = []
            for part, stack in zip(self.parts, stacks, strict=True):
                rings, first = [], 0
                for count, closed in zip(part.rings, part.closed, strict=True):
                    rings.append(Outline(stack[frame, first : first + count], closed))
                    first += count
                shapes.append(Shape(tuple(rings), part.style(float(time)), part.name))
            drawings.append(Drawing(tuple(shapes), self.box, self.title))
        return tuple(drawings)
