"""Small drawings to make movements of."""

from collections.abc import Sequence

import numpy as np

from shapetween.base.arrays import Points
from shapetween.geometry.bezier import line_curves
from shapetween.model.drawing import Box, Drawing, Shape
from shapetween.model.outline import Outline
from shapetween.model.paint import Colour, Paint, Stroke, Style

__all__ = ["BOX", "area", "drawing", "line", "ring", "square"]

BOX = Box(0, 0, 100, 100)


def ring(corners: Points | Sequence[tuple[float, float]]) -> Outline:
    """The closed polygon, run as given."""
    points = np.asarray(corners, dtype=np.float64)
    return Outline(line_curves(points, np.roll(points, -1, axis=0)))


def square(x: float, y: float, side: float) -> Outline:
    """Clockwise as drawn, from its upper left corner."""
    return ring([(x, y), (x + side, y), (x + side, y + side), (x, y + side)])


def area(*rings: Outline, name: str = "", colour: Paint = None) -> Shape:
    """A filled shape; holes by the even-odd rule."""
    return Shape(rings, Style(fill=colour or Colour(), fill_rule="evenodd"), name)


def line(*corners: tuple[float, float], width: float = 2.0, name: str = "") -> Shape:
    """A stroked line through points."""
    points = np.asarray(corners, dtype=np.float64)
    curves = line_curves(points[:-1], points[1:])
    return Shape((Outline(curves, closed=False),), Style(None, Stroke(Colour(), width)), name)


def drawing(*shapes: Shape) -> Drawing:
    return Drawing(shapes, BOX)
