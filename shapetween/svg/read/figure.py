"""One painted element to the shapes it draws, in the drawing's user units."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from shapetween.boolean.area import hidden_share
from shapetween.boolean.chords import chords_of
from shapetween.model.drawing import Shape
from shapetween.model.outline import Outline
from shapetween.model.paint import Style
from shapetween.svg.read.document import Document
from shapetween.svg.read.frames import Placed
from shapetween.svg.read.painting import picture_style, style_of
from shapetween.svg.read.pathdata import Subpath
from shapetween.svg.read.rings import ring_of
from shapetween.svg.read.subpaths import in_range, subpaths_of
from shapetween.svg.read.transform import apply
from shapetween.svg.read.units import number

__all__ = ["rings_of", "shapes_of"]

LOST_MARKERS = "markers on a line were left out"

#: Share of its length up to which a stroke inside of what it surrounds is left out: ends of
#: outlines that overlap a little. Lower and fill and stroke of such shapes part for nothing.
HIDDEN = 0.05

_MARKERS = ("marker-start", "marker-mid", "marker-end")


def shapes_of(document: Document, placed: Placed) -> list[Shape]:
    """What a shape's element paints: nothing, a shape, or fill and stroke as two.

    They are two where the stroke lies under the fill, and where it is seen inside of it, as in a
    five-pointed star drawn in one go: the outline of what is filled does not run there. Clips are
    not yet applied.

    Raises
    ------
    BudgetError
    """
    properties = placed.frame.properties
    if properties.get("visibility", "visible") != "visible":
        return []
    subpaths = subpaths_of(document, placed)
    if not subpaths:
        return []
    if placed.tag == "image":
        style = picture_style(document, placed, subpaths)
        rings = rings_of(document, placed, subpaths, style) if style is not None else ()
        return [Shape(rings, style, placed.name)] if style is not None and rings else []
    path_length = number(placed.element.get("pathLength"))
    style = style_of(document, placed.frame, subpaths, path_length)
    if style.fill is None and style.stroke is None:
        return []
    if any(properties.get(name, "none") != "none" for name in _MARKERS):
        document.losses.add(LOST_MARKERS)
    layers = [style]
    if style.fill is not None and style.stroke is not None and _stroke_first(placed):
        layers = [replace(style, fill=None), replace(style, stroke=None)]
    elif style.fill is not None and style.stroke is not None and placed.frame.opacity == 1:
        closed = [ring for ring in rings_of(document, placed, subpaths, style) if ring.closed]
        lines = chords_of(closed).polylines if closed else ()
        if hidden_share(lines, style.fill_rule) > HIDDEN:
            layers = [replace(style, stroke=None), replace(style, fill=None)]
    shapes = []
    for layer in layers:
        rings = rings_of(document, placed, subpaths, layer)
        if rings:
            shapes.append(Shape(rings, layer, placed.name))
    return shapes


def rings_of(
    document: Document, placed: Placed, subpaths: Sequence[Subpath], style: Style
) -> tuple[Outline, ...]:
    """Subpaths as rings in the drawing's user units, without those of which nothing is seen."""
    stroke = style.stroke
    with np.errstate(all="ignore"):  # numbers that overflow are left out below
        mapped = [
            Subpath(
                apply(placed.frame.matrix, subpath.curves),
                apply(placed.frame.matrix, subpath.start),
                subpath.closed,
            )
            for subpath in subpaths
        ]
    rings = (
        ring_of(
            subpath,
            filled=style.fill is not None,
            stroked=stroke is not None,
            dots=stroke is not None and stroke.cap != "butt",
        )
        for subpath in in_range(document, mapped)
    )
    return tuple(ring for ring in rings if ring is not None)


def _stroke_first(placed: Placed) -> bool:
    order = placed.frame.properties.get("paint-order", "normal").lower().split()
    first = next((word for word in order if word in ("fill", "stroke")), "fill")
    return first == "stroke"
