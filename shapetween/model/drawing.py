"""A drawing: shapes in the order they are painted, in one frame of coordinates."""

from dataclasses import dataclass, field, replace

import numpy as np

from shapetween.base.arrays import Affine
from shapetween.model.gradients import moved_group, moved_style
from shapetween.model.paint import Shape

__all__ = ["Box", "Drawing", "Shape"]


@dataclass(frozen=True, slots=True)
class Box:
    """A view box in user units."""

    x: float
    y: float
    width: float
    height: float


@dataclass(frozen=True, slots=True, eq=False)
class Drawing:
    """Shapes in paint order, the last on top.

    Attributes
    ----------
    shapes : tuple of Shape
    box : Box
        The part of the plane that is shown.
    title : str
    warnings : tuple of str
        What the file holds that could not be carried, one line each.
    page : tuple of (str, str)
        Attributes of the file's root that say how it is shown in a page, such as its width.
    """

    shapes: tuple[Shape, ...] = field(repr=False)
    box: Box
    title: str = ""
    warnings: tuple[str, ...] = ()
    page: tuple[tuple[str, str], ...] = ()

    @property
    def drawn(self) -> Box:
        """The least box around all outlines, wherever they are."""
        boxes = np.array([ring.box for shape in self.shapes for ring in shape.rings])
        low, high = boxes[:, 0].min(axis=0), boxes[:, 1].max(axis=0)
        return Box(*low.tolist(), *(high - low).tolist())

    def transformed(self, matrix: Affine) -> "Drawing":
        """Every ring and gradient mapped by an affine map (2, 3); the box stays.

        Stroke widths grow with the square root of the map's determinant, as a circle's would.
        """
        scale = float(np.sqrt(abs(np.linalg.det(matrix[:, :2]))))
        shapes = []
        for shape in self.shapes:
            style = moved_style(replace(shape.style, groups=()), matrix)
            groups = tuple(moved_group(group, matrix, refit=True) for group in shape.style.groups)
            style = replace(style, groups=groups)
            if style.stroke is not None:
                stroke = style.stroke
                style = replace(
                    style,
                    stroke=replace(
                        stroke,
                        width=stroke.width * scale,
                        dashes=tuple(d * scale for d in stroke.dashes),
                        dash_offset=stroke.dash_offset * scale,
                    ),
                )
            rings = tuple(ring.transformed(matrix) for ring in shape.rings)
            shapes.append(Shape(rings, style, shape.name))
        return Drawing(tuple(shapes), self.box, self.title, self.warnings, self.page)
