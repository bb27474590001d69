"""A movement: drawn paths that keep their structure through time.

What every writer takes. Nothing here knows how the paths are moved.

A movement runs from 0 to 1. An easing that overshoots asks for a little more: past an end every
point goes on as it came, mirrored at the point where it is then (X(1 + s) = 2 X(1) - X(1 - s)). So
nothing jumps or turns a corner there, what parts share stays shared, and no farther than one whole
way past either end is anything known. Paint stays as it is at the end.
"""

from dataclasses import dataclass

from shapetween.base.arrays import Floats
from shapetween.model.drawing import Box, Drawing, Shape
from shapetween.model.outline import Outline
from shapetween.model.part import Part

__all__ = ["Movement"]


@dataclass(frozen=True, slots=True, eq=False)
class Movement:
    """Parts in paint order, the box they are seen in, and the root's attributes in a page."""

    parts: tuple[Part, ...]
    box: Box
    title: str = ""
    page: tuple[tuple[str, str], ...] = ()

    def at(self, t: Floats) -> tuple[Drawing, ...]:
        """The drawings at the times (F,), one each, which may be past the ends."""
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
            drawings.append(Drawing(tuple(shapes), self.box, self.title, page=self.page))
        return tuple(drawings)
