"""Patterns: one tile as shapes, and the colour that it is on the whole.

.. [SVG2] *Scalable Vector Graphics 2*, section 14.3.
"""

from collections.abc import Sequence
from dataclasses import replace
from xml.etree.ElementTree import Element, tostring

import numpy as np

from shapetween.base.arrays import Affine, Floats
from shapetween.boolean.area import filled_area
from shapetween.boolean.chords import chords_of
from shapetween.geometry.affine import affine, compose, inverted, mapped
from shapetween.model.drawing import Box, Shape
from shapetween.model.paint import Colour, Gradient, Paint, Pattern
from shapetween.model.srgb import linear_to_srgb, srgb_to_linear
from shapetween.svg.read.document import Document
from shapetween.svg.read.frames import Frame
from shapetween.svg.read.transform import parse_transform
from shapetween.svg.read.viewbox import fit, parse_view_box
from shapetween.svg.read.walk import walk
from shapetween.svg.read.xml import local_name

__all__ = ["pattern_of"]

#: Patterns that take their parts from others; more is taken for a circle.
MOST_REFERENCES = 16

#: Patterns within patterns; more is taken for a circle.
MOST_NESTED = 4

#: Most shapes of a tile that are written again. Drawn tiles have a handful; of more only the
#: colour is kept.
MOST_SHAPES = 500

#: Digits of a tile's sides, in units of what is in it: two that differ by less are the same.
DECIMALS = 9

#: Cells along each side of the tile that its colour is the mean of. Fewer miss thin lines.
CELLS = 48


def pattern_of(
    document: Document, element: Element, box: Box, frame: Frame, alpha: float
) -> tuple[Pattern | None, Colour]:
    """A pattern as it fills a shape, and its mean colour; None where it cannot be written again.

    Pictures are not looked into: grey stands for a pattern that holds one.

    Parameters
    ----------
    document : Document
    element : Element
        The ``pattern``.
    box : Box
        The shape's own bounding box, in its local coordinates and without its stroke.
    frame : Frame
        The shape's own.
    alpha : float
        ``fill-opacity``.
    """
    nothing = None, Colour(alpha=0.0)
    chain = _chain(document, element)
    filled = next((link for link in chain if any(local_name(child) for child in link)), None)
    values: dict[str, str] = {}
    for link in reversed(chain):
        values.update(link.items())
    tile = _tile(values, box, frame)
    if filled is None or tile is None or len(document.within) >= MOST_NESTED:
        return nothing
    turned = parse_transform(values.get("patternTransform", ""))
    matrix = frame.matrix if turned is None else compose(frame.matrix, turned)
    # Content is in units of its own, which are the same wherever the pattern is used.
    step = compose(affine(1, 0, 0, 1, tile.x, tile.y), _content(values, tile, box))
    if np.linalg.det(step[:, :2]) == 0:
        return nothing
    corners = np.array([[tile.x, tile.y], [tile.x + tile.width, tile.y + tile.height]])
    low, high = mapped(corners, inverted(step)).round(DECIMALS).tolist()
    own = Box(low[0], low[1], high[0] - low[0], high[1] - low[1])
    matrix = compose(matrix, compose(step, affine(1, 0, 0, 1, own.x, own.y)))
    if not np.isfinite(matrix).all() or np.linalg.det(matrix[:, :2]) == 0:
        return nothing
    if any(local_name(inner) == "image" for inner in filled.iter()):
        return None, Colour(0.5, 0.5, 0.5, alpha)
    shapes, colour = _painted(document, filled, frame, own)
    whole = replace(colour, alpha=colour.alpha * alpha)
    if colour.alpha == 0:
        return nothing
    if len(shapes) > MOST_SHAPES or any(shape.style.groups for shape in shapes):
        return None, whole
    text = tostring(filled, "unicode")
    return Pattern(
        (own.width, own.height), tuple(matrix.T.ravel().tolist()), alpha, text, shapes
    ), whole


def _chain(document: Document, element: Element) -> list[Element]:
    """A pattern and those it takes its missing parts from, nearest first."""
    chain = [element]
    while len(chain) <= MOST_REFERENCES:
        following = document.target(chain[-1])
        if following is None or following in chain or local_name(following) != "pattern":
            break
        chain.append(following)
    return chain


def _tile(values: dict[str, str], box: Box, frame: Frame) -> Box | None:
    """Where one tile is, before the pattern's own transform; None if it is nowhere."""
    viewport, origin, unit = frame.viewport, np.zeros(2), np.ones(2)
    if values.get("patternUnits", "objectBoundingBox").strip() != "userSpaceOnUse":
        viewport = replace(viewport, width=1.0, height=1.0)
        origin, unit = np.array([box.x, box.y]), np.array([box.width, box.height])
    lengths = [
        viewport.length(values.get(name, "0"), of) or 0.0
        for name, of in (
            ("x", viewport.width),
            ("y", viewport.height),
            ("width", viewport.width),
            ("height", viewport.height),
        )
    ]
    x, y = (origin + unit * lengths[:2]).tolist()
    width, height = (unit * lengths[2:]).tolist()
    return Box(x, y, width, height) if width > 0 and height > 0 else None


def _content(values: dict[str, str], tile: Box, box: Box) -> Affine:
    """From what is in a tile to the tile, whose corner is the origin."""
    view = parse_view_box(values.get("viewBox"))
    if view is not None:
        return fit(view, Box(0.0, 0.0, tile.width, tile.height), values)
    if values.get("patternContentUnits", "userSpaceOnUse").strip() == "objectBoundingBox":
        return affine(box.width, 0, 0, box.height, 0, 0)
    return affine(1, 0, 0, 1, 0, 0)


def _painted(
    document: Document, element: Element, frame: Frame, tile: Box
) -> tuple[tuple[Shape, ...], Colour]:
    """What is in one tile, from its corner on, and its mean colour."""
    key = (element, tile)
    if key not in document.patterns:
        corner = affine(1, 0, 0, 1, -tile.x, -tile.y)
        own = replace(
            frame, matrix=corner, properties=document.style(element), layers=(), uses=(), name=""
        )
        document.within.append(element)
        try:
            placed = (
                each
                for child in element
                if local_name(child)
                for each in walk(document, child, own)
            )
            shapes = tuple(document.painted(placed))
        finally:
            document.within.pop()
        document.patterns[key] = shapes, _mean(shapes, tile)
    return document.patterns[key]


def _mean(shapes: Sequence[Shape], tile: Box) -> Colour:
    """Mean over a tile of what is seen of some shapes."""
    import shapely

    x, y = (
        (np.stack(np.meshgrid(*[np.arange(CELLS)] * 2)).reshape(2, -1) + 0.5)
        / CELLS
        * np.array([[tile.width], [tile.height]])
    )
    seen = np.zeros((CELLS * CELLS, 4))
    for shape in shapes:
        chords = chords_of([ring.close() for ring in shape.rings])
        area = filled_area(chords.polylines, shape.style.fill_rule)
        if area is not None:
            _lay(seen, shapely.contains_xy(area, x, y), shape.style.fill, shape.style.opacity)
        stroke = shape.style.stroke
        if stroke is not None:
            lines = shapely.union_all([shapely.LineString(line) for line in chords.polylines])
            drawn = shapely.contains_xy(lines.buffer(stroke.width / 2), x, y)
            _lay(seen, drawn, stroke.paint, shape.style.opacity)
    total = seen.mean(axis=0)
    if not total[3] > 0:
        return Colour(alpha=0.0)
    # Rounded, for it is a sum of thousands and must not hang on their order.
    light = np.round(np.clip(linear_to_srgb(total[:3] / total[3]), 0.0, 1.0), 6)
    red, green, blue = light.tolist()
    return Colour(red, green, blue, round(min(float(total[3]), 1.0), 6))


def _lay(seen: Floats, where: Floats, paint: Paint, opacity: float) -> None:
    """Lay a paint over what is seen, light times alpha and alpha, (N, 4), at some places."""
    if paint is None:
        return
    colours = [stop.colour for stop in paint.stops] if isinstance(paint, Gradient) else [paint]
    rows = np.array([[c.red, c.green, c.blue, c.alpha * opacity] for c in colours])
    light = np.column_stack([srgb_to_linear(rows[:, :3]) * rows[:, 3:], rows[:, 3]]).mean(axis=0)
    seen[where] = light + (1 - light[3]) * seen[where]
