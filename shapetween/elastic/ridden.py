"""Shapes that ride on a drawing's movement: pairs of them, and those without a partner."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from shapetween.attach.carriages import is_compact
from shapetween.attach.nearby import matched_nearby
from shapetween.attach.riders import Leaver, Rider, Tip, riding
from shapetween.attach.unroll import matched_along, overturned
from shapetween.base.arrays import Points
from shapetween.base.errors import OutlineError
from shapetween.base.notices import Notice
from shapetween.elastic.aboard import LonePart, RidingPart
from shapetween.elastic.flow import Flow, Lane
from shapetween.elastic.pairing import Thing, pair_things
from shapetween.elastic.regions import Region, regions_of
from shapetween.geometry.bezier import flatten
from shapetween.model.drawing import Shape
from shapetween.model.outline import Outline

__all__ = ["brought", "ride_fill", "ride_line", "ride_lone"]

#: Chords of a curve where a polygon will do.
CHORDS = 8

#: Size of a ring beside its plane's extent up to which it is matched by even lengths: nothing
#: of it could be told apart.
SPECK = 0.02

#: Size of a stroked ring without a partner, beside its plane's extent, from which on it does not
#: open from a point but thickens where it is.
OUTLINE = 0.5


def brought(shape: Shape, flow: Flow) -> Thing:
    """Where the flow takes a shape of the source, and how large it makes it."""
    points = np.concatenate([flatten(ring.curves, 2) for ring in shape.rings])
    points = np.concatenate([points, shape.rings[-1].curves[-1:, 3]])
    if not flow.carries(_middle(points)):
        return Thing.of(points)
    lane = flow.lane(_middle(points), None)
    return Thing.of(lane.plane.hold(points, False).at(np.ones(1))[0])


def ride_fill(
    first: Shape, second: Shape, flow: Flow, names: tuple[str, str]
) -> tuple[RidingPart, tuple[Notice, ...]]:
    """Let one filled shape become another while both ride, and what there is to warn of."""
    before, said_a = _regions(first, names[0])
    after, said_b = _regions(second, names[1])
    lane = flow.lane(_centre(first), _centre(second))
    riders: list[Rider | Leaver] = []
    pairing = _paired([r.outer for r in before], [r.outer for r in after], lane)
    for i, j in pairing[0]:
        outer = len(riders)
        riders.append(_ride(before[i].outer, after[j].outer, lane))
        holes, gone, come = _paired(before[i].holes, after[j].holes, lane)
        riders += [
            _ride(before[i].holes[m].reversed(), after[j].holes[n].reversed(), lane)
            for m, n in holes
        ]
        around = riders[outer]
        assert isinstance(around, Rider)
        riders += [_leave(Region(before[i].holes[m]), False, lane, around, hole=True) for m in gone]
        riders += [_leave(Region(after[j].holes[n]), True, lane, around, hole=True) for n in come]
    riders += [_leave(before[i], False, lane) for i in pairing[1]]
    riders += [_leave(after[j], True, lane) for j in pairing[2]]
    name = first.name or second.name
    closed = (True,) * sum(len(rider.counts) for rider in riders)
    part = RidingPart.of(name, (first.style, second.style), tuple(riders), closed, lane.plane)
    return part, (*said_a, *said_b)


def ride_line(first: Shape, second: Shape, flow: Flow) -> tuple[RidingPart, list[LonePart]]:
    """Let stroked lines become others while both ride; lines left over come or go alone."""
    lane = flow.lane(_centre(first), _centre(second))
    pairs, gone, come = _paired(first.rings, second.rings, lane)
    riders = [_ride(first.rings[i], second.rings[j], lane) for i, j in pairs]
    if len(riders) == 1 and not flow.bodies and overturned(riders[0].source, riders[0].target):
        # A line by itself, which need not stay with anything.
        (i, j), *_ = pairs
        parts = matched_along(first.rings[i], second.rings[j])
        riders = [riding(parts, lane.plane, lane.extents, unrolls=True)]
    part = RidingPart.of(
        first.name or second.name,
        (first.style, second.style),
        tuple(riders),
        tuple(rider.closed for rider in riders),
        lane.plane,
    )
    alone = (
        [Shape((first.rings[i],), first.style) for i in gone],
        [Shape((second.rings[j],), second.style) for j in come],
    )
    lone = [ride_lone(s, flow, bool(k)) for k in (0, 1) for s in alone[k]]
    return part, lone


def ride_lone(
    shape: Shape,
    flow: Flow,
    arrives: bool,
    host: RidingPart | None = None,
    *,
    fades: bool = False,
) -> LonePart:
    """Let a shape without a partner open or close while it rides, perhaps on what is below it.

    Parameters
    ----------
    shape : Shape
    flow : Flow
    arrives : bool
        Whether it is whole at the end; else at the start.
    host : RidingPart, optional
    fades : bool
        Whether an area fades in place instead of opening and closing.
    """
    centre = _centre(shape)
    lane = flow.lane(None, centre) if arrives else flow.lane(centre, None)
    if host is None and not flow.carries(centre, int(arrives)):
        lane = replace(lane, plane=lane.drift)
    first = None if host is None else host.riders[0]
    on = first if isinstance(first, Rider) else None
    riders: list[Leaver | Tip] = []
    closed: list[bool] = []
    if shape.style.fill is not None:
        try:
            regions, _ = regions_of(shape, "")
        except OutlineError:
            regions = ()
        for region in regions:
            riders.append(_leave(region, arrives, lane, on, shrinks=not fades))
            closed += [True] * len(riders[-1].counts)
    fades = fades and bool(riders)
    if not riders:
        where = arrives, lane.plane, lane.extents[arrives], on
        for ring in shape.rings:
            closed.append(ring.closed)
            middle = np.asarray(ring.box.mean(axis=0))
            # What goes round most of the drawing is its outline, and stays in place.
            large = np.linalg.norm(np.ptp(ring.box, axis=0)) > OUTLINE * lane.extents[arrives]
            riders.append(
                Leaver.of((ring.curves,), middle, *where, shrinks=not large)
                if ring.closed
                else Tip.of(ring.curves, *where)
            )
    return LonePart(
        shape.name, shape.style, tuple(riders), tuple(closed), arrives, lane.plane, fades
    )


def _regions(shape: Shape, name: str) -> tuple[tuple[Region, ...], tuple[Notice, ...]]:
    return regions_of(shape, f"{name}: shape {shape.name!r}" if shape.name else name)


def _centre(shape: Shape) -> Points:
    return np.asarray(np.array([ring.box for ring in shape.rings]).mean(axis=(0, 1)))


def _middle(points: Points) -> Points:
    return np.asarray((points.min(axis=0) + points.max(axis=0)) / 2)


def _paired(
    first: Sequence[Outline], second: Sequence[Outline], lane: Lane
) -> tuple[tuple[tuple[int, int], ...], tuple[int, ...], tuple[int, ...]]:
    """Outlines paired by where the plane brings the first of them."""
    one = np.ones(1)
    sides = [
        [lane.plane.hold(flatten(o.curves, 2), False).at(one)[0] for o in first],
        [flatten(o.curves, 2) for o in second],
    ]
    things = [[Thing.of(points) for points in side] for side in sides]
    pairing = pair_things(things[0], things[1], lane.extents[1])
    return pairing.pairs, pairing.first_only, pairing.second_only


def _ride(first: Outline, second: Outline, lane: Lane) -> Rider:
    fine = not (
        is_compact(first.curves, lane.extents[0] * SPECK)
        and is_compact(second.curves, lane.extents[1] * SPECK)
    )
    parts = matched_nearby(first, second, lane.plane, fine=fine)
    return riding(parts, lane.plane, lane.extents)


def _leave(
    region: Region,
    arrives: bool,
    lane: Lane,
    host: Rider | None = None,
    *,
    hole: bool = False,
    shrinks: bool = True,
) -> Leaver:
    import shapely

    outer = region.outer.reversed() if hole else region.outer
    rings = (outer.curves, *(ring.reversed().curves for ring in region.holes))
    polygon = shapely.make_valid(
        shapely.Polygon(flatten(outer.curves, CHORDS)), method="structure", keep_collapsed=False
    )
    centre = region.centre
    if not polygon.is_empty:
        extent = float(np.ptp(outer.box, axis=0).max())
        circle = shapely.maximum_inscribed_circle(polygon, tolerance=2e-2 * extent)
        centre = np.array(circle.coords[0])
    return Leaver.of(
        rings, centre, arrives, lane.plane, lane.extents[arrives], host, shrinks=shrinks
    )
