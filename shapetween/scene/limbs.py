"""Areas that are a body with strokes on it: a lock and its shackle, a bag and its handle.

A stroke on a body is where no disc a little wider than it fits in: what opening the area by that
disc takes away ([Ser82]_). It is cut off along the straight line between the corners where it
leaves the body, and moves as a stroke, over the body.

.. [Ser82] J. Serra, *Image Analysis and Mathematical Morphology*, Academic Press, 1982.
"""

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from shapetween.base.arrays import Points
from shapetween.base.ranking import comparable
from shapetween.boolean.chords import chords_of, joined
from shapetween.boolean.trace import traced
from shapetween.fill.regions import Region
from shapetween.geometry.bezier import line_curves
from shapetween.model.outline import Outline
from shapetween.scene.items import Item
from shapetween.scene.strokes.centrelines import is_broad
from shapetween.scene.strokes.outlined import line_of
from shapetween.scene.strokes.segmentation import outlined_strokes

if TYPE_CHECKING:
    import shapely

__all__ = ["with_limbs"]

#: Most items of a drawing, and most curves of an area, that are looked at; more take longer than it
#: is worth.
MOST_ITEMS, MOST_CURVES = 6, 160

#: Radii, as shares of the largest disc's, by which an area is opened to look for strokes.
RADII = (0.15, 0.25, 0.4)

#: Radius of the disc, as a share of a stroke's width, that takes it off. At half of it, and the
#: disc fits in; much more, and it also takes off what is no stroke.
DISC = 0.62

#: Least length of a stroke on a body, as a multiple of its width.
LONG = 3.0

#: Distance, as a share of the root of an area, that its outline may be off where strokes are looked
#: for: far less than a stroke is wide, and of a tenth of the points.
ROUGH = 1e-3

#: How far a stroke reaches into the body, as a share of its width, so that there is no seam.
ROOT = 0.4

#: Least share of the area that is left to the body.
BODY = 0.3

#: Greatest ratio of the sizes of two bodies that become each other.
GROWN = 1.6


def with_limbs(
    first: Sequence[Item], second: Sequence[Item]
) -> tuple[tuple[Item, ...], tuple[Item, ...]] | None:
    """Both drawings' items with strokes on bodies apart, where both have as many on one body.

    Parameters
    ----------
    first, second : sequence of Item
        In paint order.
    """
    if max(len(first), len(second)) > MOST_ITEMS:
        return None
    looked = []
    for side in (first, second):
        cut = [(k, cuts) for k, item in enumerate(side) if (cuts := _cuts(item))]
        if len(cut) != 1:
            return None
        looked.append(cut[0])
    found = []
    for side, (k, cuts) in zip((first, second), looked, strict=True):
        parts = _split(side[k], cuts)
        if parts is None:
            return None
        found.append((k, parts))
    (i, one), (j, other) = found
    sizes = one[0].size, other[0].size
    if len(one) != len(other) or max(sizes) > GROWN * min(sizes):
        return None
    return (
        (*first[:i], *one, *first[i + 1 :]),
        (*second[:j], *other, *second[j + 1 :]),
    )


def _split(item: Item, cuts: Sequence[Points]) -> list[Item] | None:
    """A body and the strokes on it as items; None of what is not made so."""
    import shapely

    own = chords_of(list(item.rings))
    area = shapely.Polygon(own.polylines[0], own.polylines[1:])
    lines = [shapely.LineString(cut) for cut in cuts]
    net = shapely.union_all([area.boundary, *lines])
    found = shapely.get_parts(shapely.polygonize(shapely.get_parts(net))).tolist()
    faces = [face for face in found if area.contains(face.representative_point())]
    sizes = comparable([face.area for face in faces])
    body = faces[int(sizes.argmax())]
    limbs = [face for face in faces if face is not body]
    if not limbs or body.area < BODY * area.area:
        return None
    chords = [own]
    borders = []
    for limb in limbs:
        roots = [_root(line, body) for line in lines if line.distance(limb) < 1e-6 * item.extent]
        if not roots:
            return None
        whole = shapely.union_all([limb, *roots])
        if is_broad(whole):
            return None
        borders.append(whole)
        for root in roots:
            edge = shapely.get_coordinates(root)[:-1]
            chords.append(chords_of([Outline(line_curves(edge, np.roll(edge, -1, axis=0)))]))
    chords += [chords_of([Outline(line_curves(cut, cut[::-1]))]) for cut in cuts]
    every = joined(chords)
    regions = []
    for face in (body, *borders):
        rings = traced(face, every)
        if len(rings) != 1:
            return None
        outer, *holes = rings[0]
        regions.append(Region(outer, tuple(hole.clockwise() for hole in holes)))
    result = [replace(item, rings=(regions[0].outer, *regions[0].holes), cut=True)]
    for region in regions[1:]:
        strokes = outlined_strokes(region)
        if strokes is None:
            return None
        result += [line_of(stroke, item) for stroke in strokes]
    return result


def _cuts(item: Item) -> list[Points]:
    """Straight lines, (2, 2), along which strokes leave the body of an area."""
    import shapely

    if item.cut or not item.plain or sum(len(ring.curves) for ring in item.rings) > MOST_CURVES:
        return []
    whole = item.drawn
    if whole.geom_type != "Polygon" or not item.area > 0:
        return []
    area = whole.simplify(ROUGH * np.sqrt(item.area))
    largest = float(shapely.maximum_inscribed_circle(area, 1e-2 * np.sqrt(area.area)).length)
    for share in RADII:
        off = _taken(area, share * largest, _opened(area, share * largest))
        if off:
            width = max(2 * part.area / part.length for part in off)
            cuts = [_onto(mouth, item) for mouth in _mouths(area, DISC * width)]
            cuts = [cut for cut in cuts if (cut[0] != cut[1]).any()]
            if cuts:
                return cuts
    return []


def _mouths(area: "shapely.Polygon", radius: float) -> list[Points]:
    """Ends, (2, 2), of the lines that what a disc takes off an area hangs on."""
    import shapely

    opened = _opened(area, radius)
    body = opened.buffer(6e-3 * radius)
    found = []
    for part in _taken(area, radius, opened):
        mouth = part.boundary.intersection(body)
        for line in shapely.get_parts(shapely.line_merge(mouth)).tolist():
            if line.geom_type == "LineString":
                ends = shapely.get_coordinates(line)[[0, -1]]
                if np.hypot(*(ends[1] - ends[0])) > radius / 2:
                    found.append(ends)
    return found


def _opened(area: "shapely.Polygon", radius: float) -> "shapely.Geometry":
    """Where in an area a disc fits in."""
    return area.buffer(-radius, quad_segs=16).buffer(radius, quad_segs=16)


def _taken(
    area: "shapely.Polygon", radius: float, opened: "shapely.Geometry"
) -> "list[shapely.Polygon]":
    """What opening an area by a disc takes away that is long enough for a stroke."""
    import shapely

    if opened.is_empty:
        return []
    left = shapely.get_parts(area.difference(opened.buffer(5e-3 * radius))).tolist()
    found = []
    for part in left:
        if part.geom_type != "Polygon" or part.area < radius**2:
            continue
        width = 2 * part.area / part.length
        if min(part.length / 2, part.area / width) > LONG * width:
            found.append(part)
    return found


def _onto(ends: Points, item: Item) -> Points:
    """The corners of an area that the ends of a mouth are nearest to."""
    corners = np.concatenate([ring.curves[:, 0] for ring in item.rings])
    away = np.linalg.norm(ends[:, None] - corners, axis=-1)
    return np.asarray(corners[comparable(away).argmin(axis=1)])


def _root(line: "shapely.LineString", body: "shapely.Polygon") -> "shapely.Polygon":
    """What of a body is behind the line that a stroke leaves it by."""
    import shapely

    start, end = shapely.get_coordinates(line)
    way = end - start
    normal = ROOT * np.array([-way[1], way[0]])
    sides = [shapely.Polygon([start, end, end + n, start + n]) for n in (normal, -normal)]
    inside = comparable([side.intersection(body).area for side in sides])
    return sides[int(inside.argmax())]
