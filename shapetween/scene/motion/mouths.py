"""A ring that becomes an open shape: it is cut where the mouth will be, and opens there."""

from dataclasses import dataclass

import numpy as np

from shapetween.base.arrays import Curves, Floats, Points
from shapetween.deform.check import LOOKED, crossing_frames
from shapetween.geometry.bezier import line_curves
from shapetween.model.outline import Outline
from shapetween.scene.items import Item
from shapetween.scene.motion.bend_knots import along_knots
from shapetween.scene.motion.tracks import Blend
from shapetween.scene.places import Pieces, Places, cut_alike, run_of

__all__ = ["mouth_track"]

#: Directions that are looked out into from the middle of a hole.
AROUND = 180

#: Least and greatest width of a mouth, as a share of them. Wider, and it is a bowl that nobody
#: sees as a ring; narrower, and it is a crack.
WIDTH = (0.02, 0.45)

#: Distance of a corner from where a mouth is seen to end, as a share of the shape, within which it
#: ends there.
AT_CORNER = 0.08

#: Knots of lines that become each other evenly.
ENDS = np.array([0.0, 1.0])

#: Turn of an outline, radians, that is a corner.
CORNER = np.deg2rad(40.0)

#: Least share of its convex hull that the hole's middle must lie in from the hull's border on, as a
#: share of the shape's size: else it lies in no mouth.
INSIDE = 0.05


def mouth_track(first: Item, second: Item) -> Blend | None:
    """The track of a ring and an open shape, either way; None of others.

    Parameters
    ----------
    first, second : Item
        Areas, one of which has one hole and the other none.
    """
    counts = len(first.holes), len(second.holes)
    if sorted(counts) != [0, 1]:
        return None
    ring, shape = (first, second) if counts[0] else (second, first)
    mouth = _mouth(ring, shape)
    if mouth is None:
        return None
    pieces = _pieces(ring, shape, mouth)
    if pieces is None:
        return None
    if not counts[0]:
        pieces = Pieces(pieces.target, pieces.source, True)
    found = Blend(pieces, np.stack([first.centre, second.centre]))
    count = found.counts[0]
    return None if crossing_frames(found.curves(LOOKED), [count], [True]).any() else found


@dataclass(frozen=True, slots=True, eq=False)
class _Mouth:
    """Where a shape is open.

    Attributes
    ----------
    middle : (2,) float64
        Where the hole's middle is in the shape.
    before, behind : (2, 2) float64
        Inner and outer end of the mouth's sides, clockwise as drawn: the first it has behind it.
    direction : (2,) float64
    """

    middle: Points
    before: Points
    behind: Points
    direction: Points


def _mouth(ring: Item, shape: Item) -> _Mouth | None:
    """The one mouth that a hole's middle looks out of, where it lies in another shape."""
    import shapely

    boxes = ring.box, shape.box
    size = np.maximum(boxes[0][1] - boxes[0][0], 1e-300)
    hole = Item((ring.holes[0],), ring.style).centre
    middle = boxes[1][0] + (hole - boxes[0][0]) / size * (boxes[1][1] - boxes[1][0])
    place, area = shapely.Point(middle), shape.enclosed
    hull = area.convex_hull
    if area.contains(place) or not hull.contains(place):
        return None
    if hull.boundary.distance(place) < INSIDE * shape.extent:
        return None
    angles = 2 * np.pi * np.arange(AROUND) / AROUND
    ways = np.stack([np.cos(angles), np.sin(angles)], axis=-1)
    far = middle + 2 * shape.extent * ways
    rays = shapely.linestrings(np.stack([np.broadcast_to(middle, far.shape), far], axis=1))
    free = ~shapely.intersects(rays, area)
    starts = np.flatnonzero(free & ~np.roll(free, 1))
    if len(starts) != 1 or not WIDTH[0] < free.mean() < WIDTH[1]:
        return None
    first, count = int(starts[0]), int(free.sum())
    sides = []
    for side in ((first - 1) % AROUND, (first + count) % AROUND):
        met = shapely.get_coordinates(rays[side].intersection(area))
        away = np.linalg.norm(met - middle, axis=1)
        sides.append(np.stack([met[away.argmin()], met[away.argmax()]]))
    half = angles[first] + np.pi * (count - 1) / AROUND
    return _Mouth(middle, sides[0], sides[1], np.array([np.cos(half), np.sin(half)]))


def _pieces(ring: Item, shape: Item, mouth: _Mouth) -> Pieces | None:
    """The ring cut open and the shape, cut alike."""
    import shapely

    outer, hole = Places(ring.outer.clockwise()), Places(ring.holes[0].clockwise())
    border = Places(shape.outer.clockwise())
    boxes = ring.box, shape.box
    scale = (boxes[0][1] - boxes[0][0]) / np.maximum(boxes[1][1] - boxes[1][0], 1e-300)
    middle = boxes[0][0] + (mouth.middle - boxes[1][0]) * scale
    ray = shapely.LineString([middle, middle + 2 * ring.extent * scale * mouth.direction])
    cuts = []
    for places, last in ((hole, False), (outer, True)):
        line = shapely.Polygon(places.point(np.arange(512) / 512)).boundary
        met = shapely.get_coordinates(ray.intersection(line))
        if not len(met):
            return None
        away = np.linalg.norm(met - middle, axis=1)
        cuts.append(float(places.nearest(met[[away.argmax() if last else away.argmin()]])[0]))
    inner, around = run_of(hole, cuts[0], cuts[0] + 1), run_of(outer, cuts[1], cuts[1] + 1)
    ends = [
        _at_corner(border, side, mouth.middle, shape.extent)
        for side in (mouth.behind, mouth.before)
    ]
    (start_in, start_out), (end_in, end_out) = ends
    runs = [
        (around, run_of(border, start_out, _after(end_out, start_out))),
        (None, _run(border, end_out, end_in)),
        (inner.reversed(), run_of(border, end_in, _after(start_in, end_in))),
        (None, _run(border, start_in, start_out)),
    ]
    lengths = [float(Places(there).length) for _, there in runs if there is not None]
    if sum(lengths) > (1 + AT_CORNER) * border.length:
        return None
    source: list[Curves] = []
    target: list[Curves] = []
    tips = around.curves[-1, 3], inner.curves[-1, 3]
    for k, (own, there) in enumerate(runs):
        if there is None:
            continue
        if own is None:
            one, other = (tips[0], tips[1]) if k == 1 else (tips[1], tips[0])
            cut = Places(Outline(line_curves(one[None], other[None]), False))
            pieces = cut_alike(cut, Places(there), ENDS, ENDS)
        else:
            both = Places(own), Places(there)
            pieces = cut_alike(*both, *along_knots(*both)[:2])
        source.append(pieces.source)
        target.append(pieces.target)
    ends_of = [np.concatenate(side) for side in (source, target)]
    for curves in ends_of:
        curves[1:, 0] = curves[:-1, 3]
        curves[0, 0] = curves[-1, 3]
    return Pieces(ends_of[0], ends_of[1], True)


def _after(share: float, start: float) -> float:
    """A share of a closed outline's length, as it comes behind another one."""
    return start + ((share - start) % 1.0 or 1.0)


def _run(border: Places, start: float, end: float) -> Outline | None:
    """A mouth's side; None if it is but a point."""
    away = (end - start) % 1.0
    return None if min(away, 1 - away) < 1e-6 else run_of(border, start, start + away)


def _at_corner(border: Places, side: Points, middle: Points, extent: float) -> Floats:
    """Shares of a border at the inner and outer end of a mouth's side, at its corners if near."""
    shares = border.nearest(side) % 1.0
    joints = border.joints[:-1]
    curves = border.outline.curves
    leaving = curves[:, 1] - curves[:, 0]
    reaching = np.roll(curves[:, 3] - curves[:, 2], 1, axis=0)
    turn = np.abs(
        np.arctan2(
            reaching[:, 0] * leaving[:, 1] - reaching[:, 1] * leaving[:, 0],
            (reaching * leaving).sum(axis=1),
        )
    )
    corners = joints[turn > CORNER]
    if not len(corners):
        return shares
    points = border.point(corners)
    steps = side[0] + np.linspace(0.0, 1.0, 9)[:, None] * (side[1] - side[0])
    away = np.linalg.norm(points[:, None] - steps, axis=-1).min(axis=1)
    near = np.flatnonzero(away < AT_CORNER * extent)
    if len(near) < 2:
        return shares
    out = np.round(np.linalg.norm(points[near] - middle, axis=1) / extent, 9)
    return np.asarray(corners[near[[out.argmin(), out.argmax()]]])
