"""Drawings of many shapes that move together."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from shapetween.base.arrays import Mask, Points
from shapetween.base.errors import OutlineError
from shapetween.base.notices import Notice
from shapetween.elastic.aboard import RidingPart, ShownPart
from shapetween.elastic.fill import FillSettings, morph_fill
from shapetween.elastic.flow import Flow, drawing_flow, resting_flow
from shapetween.elastic.gathering import gather_areas
from shapetween.elastic.junctions import with_hanging
from shapetween.elastic.overlaps import shared_areas
from shapetween.elastic.pairing import pair_shapes
from shapetween.elastic.parts import FilledPart
from shapetween.elastic.ridden import brought, ride_fill, ride_line, ride_lone
from shapetween.elastic.sharing import share_lines
from shapetween.elastic.silhouette import Areas, covered, covered_by
from shapetween.elastic.stacking import stacked
from shapetween.elastic.stroking import outlined
from shapetween.elastic.tying import tied
from shapetween.model.drawing import Shape
from shapetween.model.movement import Part
from shapetween.model.paint import Style

__all__ = ["move_together"]

#: Share of a shape without a partner that lies on another one for it to go with that one.
HELD = 0.65

#: Share of that other one's area that it covers to fade in place instead of opening and closing.
LARGE = 0.3


def move_together(
    first: Sequence[Shape],
    second: Sequence[Shape],
    boxes: tuple[Points, Points],
    settled: Sequence[tuple[int, int]],
    settings: FillSettings,
    names: tuple[str, str],
    *,
    together: bool,
) -> tuple[tuple[Part, ...], FilledPart | None, tuple[Notice, ...]]:
    """The movement between two drawings' shapes.

    Parameters
    ----------
    first, second : sequence of Shape
        In paint order and one frame, each either filled or stroked along lines.
    boxes : ((2, 2) float64, (2, 2) float64)
        What is shown of each drawing, as least and greatest corners.
    settled : sequence of (int, int)
        Shapes that become each other because the user says so.
    settings : FillSettings
    names : tuple of str
        What messages call the drawings.
    together : bool
        Whether shapes ride on the movement of the whole drawing; else each moves by itself.

    Returns
    -------
    parts : tuple of Part
        In paint order.
    carrier : FilledPart or None
        The silhouette that they ride on.
    notices : tuple of Notice
    """
    rides = together and settings.folds == "prevent"
    if len(first) == len(second) == 1:
        return _move_one(first[0], second[0], boxes, settings, names, rides=rides)
    areas = covered_by(first), covered_by(second)
    flow = resting_flow(first, second)
    if rides:
        flow = drawing_flow(first, second, areas, boxes, settings)
    if flow.exact:
        settled = [(k, k) for k in range(len(first))]
    elif rides and not settings.meshes:  # meshes are for shapes as they are drawn
        drawn = first, second
        first, second, settled = gather_areas(first, second, areas, flow, settled)
        first, second, settled = share_lines(first, second, flow, settled)
        areas = _covered_now(first, drawn[0], areas[0]), _covered_now(second, drawn[1], areas[1])
    hidden = [_hidden(side, box) for side, box in zip((first, second), boxes, strict=True)]
    pairing = pair_shapes(
        first,
        second,
        flow.lanes[0].extents[1],
        settled,
        brought=[brought(shape, flow) for shape in first],
        shared=shared_areas(areas, flow),
        barred=hidden[0][:, None] != hidden[1],
    )
    pairing = with_hanging(first, second, pairing)
    said: list[Notice] = []
    pairs: dict[tuple[int, int], tuple[Part, ...]] = {}
    for i, j in pairing.pairs:
        lines = first[i].style.fill is None and second[j].style.fill is None
        meshed = settings.has_mesh(first[i].name or second[j].name)
        if not lines and (meshed or not rides):
            part, more = morph_fill(*_areas(first[i], second[j]), settings, names, alone=False)
            pairs[i, j] = (part,)
        else:
            pairs[i, j], more = _ride(first[i], second[j], flow, names)
        said += more
    parts: list[Part] = []
    for layer in stacked(areas, pairing):
        source, target = layer.source, layer.target
        if source is not None and target is not None:
            there = pairs[source, target]
            always = layer.shown == (0.0, 1.0)
            parts += there if always else [ShownPart(part, layer.shown) for part in there]
        elif source is not None:
            host, fades = _host(source, areas[0], {pair[0]: p for pair, p in pairs.items()})
            shape = _rooted(source, first, areas[0])
            parts.append(ride_lone(shape, flow, False, host, fades=fades))
        elif target is not None:
            host, fades = _host(target, areas[1], {pair[1]: p for pair, p in pairs.items()})
            shape = _rooted(target, second, areas[1])
            parts.append(ride_lone(shape, flow, True, host, fades=fades))
    return tied(parts), _carrier(flow), tuple(said)


def _covered_now(shapes: Sequence[Shape], drawn: Sequence[Shape], areas: Areas) -> Areas:
    """What shapes cover, most of which are drawn ones, of which it is known."""
    known = {id(shape): area for shape, area in zip(drawn, areas, strict=True)}
    return np.array([known.get(id(s)) or covered(s) for s in shapes], dtype=object)


def _host(
    lone: int, areas: Areas, partnered: dict[int, tuple[Part, ...]]
) -> tuple[RidingPart | None, bool]:
    """The topmost shape with a partner that a shape without one lies on.

    And whether it covers so much of that one that it should fade: it would be seen to shrink away
    from where it belongs.
    """
    import shapely

    area = areas[lone]
    for below in sorted((k for k in partnered if k < lone), reverse=True):
        part = partnered[below][0]
        if not isinstance(part, RidingPart) or not shapely.intersects(areas[below], area):
            continue
        if shapely.intersection(areas[below], area).area >= HELD * area.area:
            return part, bool(area.area >= LARGE * areas[below].area)
    return None, False


def _rooted(lone: int, shapes: Sequence[Shape], areas: Areas) -> Shape:
    """A shape whose open lines start at the end that is nearer to the rest of the drawing."""
    import shapely

    shape = shapes[lone]
    rest = np.delete(areas, lone)
    rest = rest[~shapely.is_empty(rest)]
    if all(ring.closed for ring in shape.rings) or not len(rest):
        return shape
    rings = []
    for ring in shape.rings:
        ends = shapely.points([ring.curves[0, 0], ring.curves[-1, 3]])
        start, end = (float(shapely.distance(rest, point).min()) for point in ends)
        rings.append(ring.reversed() if end < start and not ring.closed else ring)
    return replace(shape, rings=tuple(rings))


def _move_one(
    first: Shape,
    second: Shape,
    boxes: tuple[Points, Points],
    settings: FillSettings,
    names: tuple[str, str],
    *,
    rides: bool,
) -> tuple[tuple[Part, ...], FilledPart | None, tuple[Notice, ...]]:
    """Two shapes that are all of their drawings: an area moves by itself, as do open lines."""
    if first.style.fill is not None or second.style.fill is not None:
        part, said = morph_fill(*_areas(first, second), settings, names, alone=True)
        return (part,), None, said
    # What an open line goes round is no silhouette.
    closed = all(ring.closed for ring in (*first.rings, *second.rings))
    flow = resting_flow([first], [second])
    if rides and closed:
        areas = covered_by([first]), covered_by([second])
        flow = drawing_flow([first], [second], areas, boxes, settings)
    parts, said = _ride(first, second, flow, names)
    return tied(parts), _carrier(flow), said


def _carrier(flow: Flow) -> FilledPart | None:
    return FilledPart("", (Style(), Style()), flow.bodies) if flow.bodies else None


def _hidden(shapes: Sequence[Shape], box: Points) -> Mask:
    """Which shapes lie wholly outside what is shown, (N,)."""
    boxes = [np.array([ring.box for ring in shape.rings]) for shape in shapes]
    low = np.array([corners[:, 0].min(axis=0) for corners in boxes])
    high = np.array([corners[:, 1].max(axis=0) for corners in boxes])
    return np.asarray(((high < box[0]) | (low > box[1])).any(axis=1))


def _areas(first: Shape, second: Shape) -> tuple[Shape, Shape]:
    """Both filled; a line that becomes an area becomes its own outline first."""
    one, other = (outlined(s) if s.style.fill is None else s for s in (first, second))
    return one, other


def _ride(
    first: Shape, second: Shape, flow: Flow, names: tuple[str, str]
) -> tuple[tuple[Part, ...], tuple[Notice, ...]]:
    if first.style.fill is not None or second.style.fill is not None:
        try:
            part, said = ride_fill(*_areas(first, second), flow, names)
        except OutlineError:
            pass  # what encloses nothing shows its stroke at most
        else:
            return (part,), said
    line, lone = ride_line(first, second, flow)
    return (line, *lone), ()
