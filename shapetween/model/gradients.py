"""Gradients in a normal form in which two of them can be blended number by number.

A gradient may be written in many ways that paint the same. Here every linear one has no matrix,
and every radial one is an upright-or-turned ellipse: a unit circle under a symmetric matrix.
Halfway between two symmetric positive matrices lies another, so nothing flattens on the way, as
halfway between a matrix and its half turn everything does.
"""

from dataclasses import replace
from typing import TypeVar

import numpy as np

from shapetween.base.arrays import Affine, Floats
from shapetween.model.paint import (
    Colour,
    Filter,
    Gradient,
    Group,
    Mask,
    Pattern,
    Shape,
    Stop,
    Style,
    Texture,
)

__all__ = [
    "IDENTITY",
    "common_offsets",
    "has_gradient",
    "in_normal_form",
    "moved",
    "moved_group",
    "moved_style",
    "on_offsets",
    "solid_gradient",
]

PlacedT = TypeVar("PlacedT", Gradient, Texture, Pattern)

IDENTITY = (1.0, 0.0, 0.0, 1.0, 0.0, 0.0)

#: Determinant below which a matrix, for its size, flattens the plane; a smaller bound divides by
#: rounding error, a larger one refuses gradients that are only very narrow.
FLAT = 1e-12


def in_normal_form(gradient: Gradient) -> Gradient:
    """The same paint: a linear gradient without a matrix, a radial one as a symmetric matrix.

    Notes
    -----
    Linear: stripes stay stripes under an affine map, but no longer at right angles to the line
    between the two points; so the second point slides along its stripe until they are.
    Radial: with A the map of the unit circle, A = S R where S is symmetric and R a turn or mirror,
    which leaves the circle as it is and only moves the focus.
    A matrix that flattens the plane paints the last stop (SVG 2, section 13.2), and is left alone.
    """
    a, b, c, d, e, f = gradient.matrix
    linear = np.array([[a, c], [b, d]])
    if abs(a * d - b * c) <= FLAT * float((linear**2).sum()):
        return gradient
    shift = np.array([e, f])
    if gradient.kind == "linear":
        start, end = np.array(gradient.points).reshape(2, 2)
        line = end - start
        stripe = linear @ (-line[1], line[0])
        moved = linear @ line
        length = float(stripe @ stripe)
        if length > 0:
            moved = moved - stripe * float(moved @ stripe) / length
        start = linear @ start + shift
        points = (*start.tolist(), *(start + moved).tolist())
        return replace(gradient, points=points, matrix=IDENTITY)
    cx, cy, r, fx, fy = gradient.points
    if r <= 0:
        return gradient
    left, sizes, right = np.linalg.svd(linear * r)
    symmetric = (left * sizes) @ left.T
    focus = left @ right @ (np.array([fx - cx, fy - cy]) / r)
    centre = linear @ (cx, cy) + shift
    matrix = (*symmetric.T.ravel().tolist(), *centre.tolist())
    return replace(gradient, points=(0.0, 0.0, 1.0, *focus.tolist()), matrix=matrix)


def has_gradient(style: Style) -> bool:
    """Whether anything in a style lies somewhere in the plane."""
    if any(group.masks or group.filter is not None for group in style.groups):
        return True
    paints = (style.fill, style.stroke.paint if style.stroke is not None else None)
    return style.pattern is not None or any(isinstance(paint, Gradient) for paint in paints)


def moved(paint: PlacedT, matrix: Affine) -> PlacedT:
    """A gradient or a texture after an affine map (2, 3) of what it paints."""
    a, b, c, d, e, f = paint.matrix
    own = np.array([[a, c, e], [b, d, f], [0.0, 0.0, 1.0]])
    return replace(paint, matrix=tuple((matrix @ own).T.ravel().tolist()))


def moved_style(style: Style, matrix: Affine) -> Style:
    """The style with all of it that lies somewhere moved; strokes stay as wide as they are."""
    if style.groups:
        groups = tuple(moved_group(group, matrix) for group in style.groups)
        style = replace(style, groups=groups)
    if style.texture is not None:
        style = replace(style, texture=moved(style.texture, matrix))
    if style.pattern is not None:
        style = replace(style, pattern=moved(style.pattern, matrix))
    if isinstance(style.fill, Gradient):
        style = replace(style, fill=moved(style.fill, matrix))
    if style.stroke is not None and isinstance(style.stroke.paint, Gradient):
        paint = moved(style.stroke.paint, matrix)
        style = replace(style, stroke=replace(style.stroke, paint=paint))
    return style


def moved_group(group: Group, matrix: Affine, *, refit: bool = False) -> Group:
    """A group after an affine map (2, 3) of what is in it.

    Parameters
    ----------
    group : Group
    matrix : (2, 3) float64
    refit : bool
        Whether the whole drawing is brought into another frame, and the units of a filter with
        it; else the shapes move within their frame, and only the region of a filter follows.
    """
    masks = tuple(
        Mask(tuple(_moved_shape(shape, matrix) for shape in mask.shapes), mask.plain)
        for mask in group.masks
    )
    found = group.filter
    return replace(
        group,
        masks=masks,
        filter=None if found is None else _moved_filter(found, matrix, refit),
    )


def _moved_shape(shape: Shape, matrix: Affine) -> Shape:
    """A shape of a mask; its stroke grows as its area does."""
    style = moved_style(shape.style, matrix)
    stroke = style.stroke
    if stroke is not None:
        scale = _scale(matrix)
        stroke = replace(
            stroke,
            width=stroke.width * scale,
            dashes=tuple(dash * scale for dash in stroke.dashes),
            dash_offset=stroke.dash_offset * scale,
        )
    rings = tuple(ring.transformed(matrix) for ring in shape.rings)
    return replace(shape, rings=rings, style=replace(style, stroke=stroke))


def _moved_filter(found: Filter, matrix: Affine, refit: bool) -> Filter:
    a, b, c, d, e, f = found.matrix
    own = np.array([[a, c, e], [b, d, f], [0.0, 0.0, 1.0]])
    if found.matrix != IDENTITY and refit:
        return replace(found, matrix=tuple((matrix @ own).T.ravel().tolist()))
    region = found.region
    if not found.in_box:
        local = np.linalg.inv(own) @ np.vstack([matrix, [0.0, 0.0, 1.0]]) @ own
        x, y, width, height = region
        corners = np.array([[x, y], [x + width, y], [x + width, y + height], [x, y + height]])
        corners = corners @ local[:2, :2].T + local[:2, 2]
        low, high = corners.min(axis=0), corners.max(axis=0)
        width, height = (high - low).tolist()
        region = (float(low[0]), float(low[1]), width, height)
    if found.matrix != IDENTITY:
        return replace(found, region=region)
    scale = _scale(matrix)
    primitives = tuple(
        replace(p, lengths=tuple((n, tuple(v * scale for v in vs)) for n, vs in p.lengths))
        for p in found.primitives
    )
    return replace(found, region=region, primitives=primitives)


def _scale(matrix: Affine) -> float:
    return float(np.sqrt(abs(np.linalg.det(matrix[:, :2]))))


def solid_gradient(colour: Colour, pattern: Gradient) -> Gradient:
    """A gradient shaped as `pattern` is, of one colour only."""
    return replace(pattern, stops=tuple(replace(stop, colour=colour) for stop in pattern.stops))


def common_offsets(first: Gradient, second: Gradient) -> Floats:
    """Offsets at which both have a stop, each as often as the one that has it more often."""
    ours = np.array([stop.offset for stop in first.stops])
    theirs = np.array([stop.offset for stop in second.stops])
    every = np.unique(np.concatenate([ours, theirs]))
    often = np.maximum((every[:, None] == ours).sum(axis=1), (every[:, None] == theirs).sum(axis=1))
    return np.repeat(every, often)


def on_offsets(gradient: Gradient, offsets: Floats) -> Gradient:
    """The same paint with stops at `offsets`, which include all of its own.

    Colours between stops are mixed as renderers do: in sRGB, not premultiplied. Where stops share
    an offset the colour jumps there, from the first of them to the last.
    """
    own = np.array([stop.offset for stop in gradient.stops])
    colours = np.array(
        [(s.colour.red, s.colour.green, s.colour.blue, s.colour.alpha) for s in gradient.stops]
    )
    if np.array_equal(own, offsets):
        return gradient
    stops = []
    for index, offset in enumerate(offsets.tolist()):
        here = np.flatnonzero(own == offset)
        if here.size:
            turn = index - int(np.searchsorted(offsets, offset))
            values = colours[here[min(turn, here.size - 1)]]
        else:
            values = _between(own, colours, offset)
        stops.append(Stop(offset, Colour(*values.tolist())))
    return replace(gradient, stops=tuple(stops))


def _between(offsets: Floats, colours: Floats, offset: float) -> Floats:
    """Colour at an offset that has no stop of its own."""
    after = int(np.searchsorted(offsets, offset))
    if after == 0:
        return np.asarray(colours[0])
    if after == len(offsets):
        return np.asarray(colours[-1])
    share = (offset - offsets[after - 1]) / (offsets[after] - offsets[after - 1])
    return np.asarray((1 - share) * colours[after - 1] + share * colours[after])
