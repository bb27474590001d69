"""Shapes as they are moved: either filled or stroked, each line by itself."""

from collections.abc import Collection, Sequence
from dataclasses import replace

import numpy as np

from shapetween.elastic.naming import common_names
from shapetween.geometry.bezier import end_tangents
from shapetween.model.drawing import Shape
from shapetween.model.outline import Outline
from shapetween.model.paint import Gradient, Stroke

__all__ = ["plain_shapes"]

#: Cosine of the angle at which a line's end meets its start, from which on no join is seen there.
SMOOTH = 0.9999

#: Distance between a line's ends, as a share of its width, up to which they meet under round caps.
MEET = 0.1


def plain_shapes(
    first: Sequence[Shape], second: Sequence[Shape], kept: Collection[str] = ()
) -> tuple[tuple[Shape, ...], tuple[Shape, ...]]:
    """Shapes of two drawings, each either filled or stroked along open lines.

    A filled ring is closed and a stroked one is as it was drawn; where the two differ the shape
    becomes two. Lines that are stroked in one path become shapes of their own where both drawings
    have lines, so that each finds its own partner.

    Parameters
    ----------
    first, second : sequence of Shape
    kept : collection of str
        Names of shapes that stay whole.
    """
    sides = _plain(first), _plain(second)
    if not all(any(shape.style.fill is None for shape in side) for side in sides):
        return sides
    whole = {*kept, *common_names(*sides)}
    return _apart(sides[0], whole), _apart(sides[1], whole)


def _plain(shapes: Sequence[Shape]) -> tuple[Shape, ...]:
    plain = []
    for shape in shapes:
        style = shape.style
        rings = tuple(_joined(ring, style.stroke) for ring in shape.rings)
        if style.fill is None or all(ring.closed for ring in rings):
            plain.append(Shape(rings, style, shape.name))
            continue
        closed = tuple(ring.close() for ring in rings)
        plain.append(Shape(closed, replace(style, stroke=None), shape.name))
        if style.stroke is not None:
            plain.append(Shape(rings, replace(style, fill=None), ""))
    return tuple(plain)


def _joined(ring: Outline, stroke: Stroke | None) -> Outline:
    """A line as a ring if its ends meet, unless its caps look other there than a join."""
    start, end = ring.curves[0, 0], ring.curves[-1, 3]
    gap = float(np.linalg.norm(end - start))
    if ring.closed or stroke is None or stroke.dashes or gap > MEET * stroke.width:
        return ring
    leaving, reaching = end_tangents(ring.curves[[0, -1]])
    smooth = gap == 0 and float(leaving[0] @ reaching[1]) > SMOOTH
    return ring.close() if smooth or stroke.cap == stroke.join == "round" else ring


def _apart(shapes: Sequence[Shape], whole: Collection[str]) -> tuple[Shape, ...]:
    """Every line a shape of its own, but where lines that cross would then shine through."""
    apart = []
    for shape in shapes:
        stroke = shape.style.stroke
        if shape.style.fill is not None or stroke is None or shape.name in whole:
            apart.append(shape)
            continue
        alpha = 0.0 if isinstance(stroke.paint, Gradient) else stroke.paint.alpha
        if alpha * shape.style.opacity < 1:
            apart.append(shape)
            continue
        names = [shape.name, *([""] * (len(shape.rings) - 1))]
        apart += [Shape((r,), shape.style, n) for r, n in zip(shape.rings, names, strict=True)]
    return tuple(apart)
