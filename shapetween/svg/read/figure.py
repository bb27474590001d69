"""One painted element to the shapes it draws, in the drawing's user units."""

from collections.abc import Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from shapetween.boolean.area import hidden_share
from shapetween.boolean.chords import chords_of
from shapetween.geometry.affine import inverted, mapped, mean_scale, stretch
from shapetween.model.drawing import Shape
from shapetween.model.outline import Outline
from shapetween.model.paint import Style
from shapetween.svg.read.document import Document
from shapetween.svg.read.frames import Placed
from shapetween.svg.read.painting import picture_style, style_of
from shapetween.svg.read.pathdata import Subpath
from shapetween.svg.read.paths import in_range
from shapetween.svg.read.rings import encloses_nothing, ring_of, unfolded
from shapetween.svg.read.subpaths import subpaths_of
from shapetween.svg.read.units import number

__all__ = ["rings_of", "shapes_of"]

#: Share of its length up to which a stroke inside of what it surrounds is left out: ends of
#: outlines that overlap a little. Lower and fill and stroke of such shapes part for nothing.
HIDDEN = 0.05

#: Greatest over least scale up to which a stroke keeps its one width; more shows.
MOST_STRETCH = 1.05

#: Greatest over least scale from which on all is flat and no outline can be told.
FLAT = 1e6


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
    if placed.tag == "text":
        return _letters(document, placed)
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
    return _painted(document, placed, subpaths, style, placed.name)


def _letters(document: Document, placed: Placed) -> list[Shape]:
    """Each letter of a text as a shape; what paints them is laid over the whole text."""
    from shapetween.svg.read.text import letters_of

    letters = letters_of(document, placed)
    whole = [subpath for letter in letters for subpath in letter.subpaths]
    shapes = []
    for letter in letters:
        properties = letter.frame.properties
        if properties.get("visibility", "visible") != "visible":
            continue
        style = style_of(document, letter.frame, whole, None)
        if style.fill is not None or style.stroke is not None:
            name = placed.name if len(letters) == 1 else ""
            own = replace(placed, frame=letter.frame)
            shapes += _painted(document, own, letter.subpaths, style, name)
    return shapes


def _painted(
    document: Document, placed: Placed, subpaths: Sequence[Subpath], style: Style, name: str
) -> list[Shape]:
    """What a style paints of subpaths."""
    layers = _layers(document, placed, subpaths, style)
    shapes = []
    for layer in layers:
        rings = rings_of(document, placed, subpaths, layer)
        parts = [(rings, layer)]
        if layer.stroke is not None and _is_uneven(placed):
            outlined = _outlined(document, placed, rings, layer)
            shapes += [Shape(found, own, name) for found, own in outlined if found]
            continue
        if layer.fill is None and layer.stroke is not None:
            parts = unfolded(rings, layer)
            if layer.stroke.dashes and len(layers) > 1:
                # Open where it starts, so that its dashes start there however it moves.
                parts = [(tuple(Outline(r.curves, closed=False) for r in rings), layer)]
        shapes += [Shape(kept, own, name) for kept, own in parts if kept]
    return shapes


def _layers(
    document: Document, placed: Placed, subpaths: Sequence[Subpath], style: Style
) -> list[Style]:
    """The style, or fill and stroke of it by themselves, in the order in which they are painted."""
    if style.fill is None or style.stroke is None:
        return [style]
    apart = [replace(style, stroke=None), replace(style, fill=None)]
    if _stroke_first(placed):
        return apart[::-1]
    if _is_uneven(placed):
        return apart
    rings = rings_of(document, placed, subpaths, style)
    # What encloses nothing has no fill, and would count as an area; dashes start where the line
    # does, which an area has no need to keep.
    if any(encloses_nothing(ring) for ring in rings) or style.stroke.dashes:
        return apart
    if placed.frame.opacity == 1:
        closed = [ring for ring in rings if ring.closed]
        lines = chords_of(closed).polylines if closed else ()
        if hidden_share(lines, style.fill_rule) > HIDDEN:
            return apart
    return [style]


def _is_uneven(placed: Placed) -> bool:
    """Whether its transform makes a stroke wider one way than another."""
    if placed.frame.properties.get("vector-effect") == "non-scaling-stroke":
        return False
    return stretch(placed.frame.matrix) > MOST_STRETCH


def _outlined(
    document: Document, placed: Placed, rings: Sequence[Outline], style: Style
) -> list[tuple[tuple[Outline, ...], Style]]:
    """A stroke under an uneven transform as the area that it paints."""
    from shapetween.svg.read.stroked import stroke_rings

    matrix, stroke = placed.frame.matrix, style.stroke
    assert stroke is not None  # it is strokes that are outlined
    if stretch(matrix) < FLAT:
        back, scale = inverted(matrix), mean_scale(matrix)
        own = replace(
            stroke,
            width=stroke.width / scale,
            dashes=tuple(dash / scale for dash in stroke.dashes),
            dash_offset=stroke.dash_offset / scale,
        )
        found = stroke_rings([ring.transformed(back) for ring in rings], own)
        if found is not None:
            area = replace(
                style,
                fill=stroke.paint,
                stroke=None,
                fill_rule="nonzero",
                texture=None,
                pattern=None,
            )
            return [(tuple(ring.transformed(matrix) for ring in found), area)]
    document.losses.add("a stroke under an uneven scale was given its mean width", placed.name)
    return [(tuple(rings), style)]


def rings_of(
    document: Document, placed: Placed, subpaths: Sequence[Subpath], style: Style
) -> tuple[Outline, ...]:
    """Subpaths as rings in the drawing's user units, without those of which nothing is seen."""
    stroke = style.stroke
    with np.errstate(all="ignore"):  # numbers that overflow are left out below
        placed_paths = [
            Subpath(
                mapped(subpath.curves, placed.frame.matrix),
                mapped(subpath.start, placed.frame.matrix),
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
            width=stroke.width if stroke is not None else 1.0,
        )
        for subpath in map(partial(_within, document.reach), in_range(document, placed_paths))
    )
    return tuple(ring for ring in rings if ring is not None)


def _within(reach: float, subpath: Subpath) -> Subpath:
    """A subpath that comes no farther than that from the origin, unless all of it is out there."""
    away = np.abs(subpath.curves).max(axis=-1)
    if away.max(initial=0.0) <= reach or away.min() > reach:
        return subpath
    curves, start = (np.clip(points, -reach, reach) for points in (subpath.curves, subpath.start))
    return Subpath(curves, start, subpath.closed)


def _stroke_first(placed: Placed) -> bool:
    order = placed.frame.properties.get("paint-order", "normal").lower().split()
    first = next((word for word in order if word in ("fill", "stroke")), "fill")
    return first == "stroke"
