"""Holes that both areas have, each moving as the form it is: a disc, a box, a stroke."""

from collections.abc import Collection, Sequence
from typing import TYPE_CHECKING

import numpy as np

from shapetween.base.arrays import Points
from shapetween.geometry.bezier import signed_area
from shapetween.model.outline import Outline
from shapetween.model.paint import Colour, Style
from shapetween.model.part import CurveTrack
from shapetween.scene.forms import form_of
from shapetween.scene.items import Item
from shapetween.scene.kept.appearing import Against, Slot
from shapetween.scene.kept.bars import bar_of
from shapetween.scene.kept.shared_arcs import Snapped
from shapetween.scene.motion.choose import Ends, open_track
from shapetween.scene.motion.hole_pairs import distances, paired_holes, stroke_of, way_between
from shapetween.scene.motion.holes import Opening, matched_holes
from shapetween.scene.motion.tracks import Blend
from shapetween.scene.places import Pieces
from shapetween.scene.strokes.outlined import as_painted, line_of

if TYPE_CHECKING:
    import shapely

__all__ = [
    "holes_in_turn",
    "holes_over_edges",
    "loose_holes",
    "matched_hole_pairs",
    "matched_hole_track",
    "unmatched_hole_track",
]

#: Greatest distance of two holes that become each other, as a share of the drawing, and factor
#: between their sizes, as a logarithm. More, and a hole crosses what another would open in.
APART, GROWN = 0.8, 1.2

#: Share of a hole, or of the way of two, that may lie outside of what is solid.
STRAY = 0.02

#: Share of a hole that may lie outside of what is solid in the other area for it to lie across an
#: edge of that. Larger, and an arm that reaches round a hole comes before the hole opens; smaller,
#: and a tick over a gap comes in pieces.
ACROSS = 0.5

#: Distance from its mirror image, as a share of its size, of a line that is its own.
SYMMETRIC = 0.02

#: Least share of its outline that one of two holes has in common with the other area, for them to
#: be one that changes. Smaller, and a plus grows out of the squares whose edges it happens to run
#: along; larger, and a bar that gets a cross bar is closed first.
MOSTLY = 0.6

#: Least ratio of the sides of a hole that is drawn as a bar.
SLOT = 2.2

#: What a hole is seen as by itself.
_INK = Style(fill=Colour())


def matched_hole_pairs(
    first: Sequence[Outline],
    second: Sequence[Outline],
    solid: "tuple[shapely.Geometry, shapely.Geometry]",
    scale: float,
) -> list[tuple[int, int]]:
    """Holes that become each other, by place and size, with nothing in between.

    Parameters
    ----------
    first, second : sequence of Outline
        Holes that have no arc in common with the other drawing.
    solid : (shapely geometry, shapely geometry)
        Both areas with these holes filled.
    scale : float
        Size of the drawing.
    """
    if not first or not second:
        return []
    items = [[Item((ring.clockwise(),), _INK) for ring in side] for side in (first, second)]
    sizes = [np.array([item.size for item in side]) for side in items]
    apart = distances(items[0], items[1], scale)
    allowed = (apart <= APART) & (np.abs(np.log(sizes[0][:, None] / sizes[1])) <= GROWN)
    both = solid[0].intersection(solid[1])
    for i, j in np.argwhere(allowed).tolist():
        way = way_between(items[0][i], items[1][j])
        allowed[i, j] = way.difference(both).area <= STRAY * way.area
    return paired_holes(items[0], items[1], apart, allowed)


def holes_in_turn(
    holes: tuple[list[int], list[int]],
    paired: Collection[int],
    polylines: Sequence[Points],
    solid: tuple["shapely.Geometry", "shapely.Geometry"],
) -> list[tuple[int, int]]:
    """Holes without partners where both areas have some: first they close, then they open.

    Returns
    -------
    list of (int, int)
        Which area's, and its number among all rings.
    """
    import shapely

    found: tuple[list[int], list[int]] = ([], [])
    for side in (0, 1):
        for k in holes[side]:
            area = shapely.make_valid(shapely.Polygon(polylines[k]))
            if k not in paired and area.difference(solid[1 - side]).area <= STRAY * area.area:
                found[side].append(k)
    if not found[0] or not found[1]:
        return []
    return [(side, k) for side in (0, 1) for k in found[side]]


def holes_over_edges(
    holes: tuple[list[int], list[int]],
    paired: Collection[int],
    polylines: Sequence[Points],
    solid: tuple["shapely.Geometry", "shapely.Geometry"],
) -> list[tuple[int, int]]:
    """Holes without partners that lie across edges of the other area, which has none.

    Clipped there they would come in pieces.

    Parameters
    ----------
    holes, paired, polylines, solid
        As for `holes_in_turn`.

    Returns
    -------
    list of (int, int)
        As of that.
    """
    import shapely

    alone = [(side, k) for side in (0, 1) for k in holes[side] if k not in paired]
    if len({side for side, _ in alone}) != 1:
        return []
    found = []
    for side, k in alone:
        area = shapely.make_valid(shapely.Polygon(polylines[k]))
        out = area.difference(solid[1 - side]).area
        if STRAY * area.area < out < ACROSS * area.area:
            found.append((side, k))
    return found


def loose_holes(
    counts: tuple[Sequence[int], Sequence[int]], found: Snapped
) -> tuple[list[int], list[int]]:
    """Holes of either area that are none of the other one's changed, by number among all.

    Of those, one of the two has most of its outline in common with the other area.
    """
    mostly = [
        shared >= MOSTLY * np.maximum(lengths, 1e-300)
        for shared, lengths in zip(found.shared, found.lengths, strict=True)
    ]
    bound = [own.copy() for own in mostly]
    for arc in found.arcs:
        for side in (0, 1):
            bound[side][arc.rings[side]] |= mostly[1 - side][arc.rings[1 - side]]
    first = 0
    loose: tuple[list[int], list[int]] = ([], [])
    for side, own in enumerate(counts):
        at = 0
        for count in own:
            loose[side].extend(first + k for k in range(at + 1, at + count) if not bound[side][k])
            at += count
        first += at
    return loose


def matched_hole_track(first: Outline, second: Outline, scale: float) -> CurveTrack:
    """A hole that becomes another, run against what it lies in.

    Parameters
    ----------
    first, second : Outline
    scale : float
        Size of the drawing.
    """
    one, other = (Item((ring.clockwise(),), _INK) for ring in (first, second))
    track = _as_stroke(one, other, scale)
    if track is None:
        pieces = matched_holes(one, other)
        track = Blend(pieces, np.stack([one.centre, other.centre]))
    start = track.curves(np.zeros(1))[0]
    return Against(track) if signed_area(start) > 0 else track


def unmatched_hole_track(ring: Outline, closes: bool) -> CurveTrack:
    """A hole that opens round its middle, or closes; a bar opens round and is drawn to both ends.

    Parameters
    ----------
    ring : Outline
    closes : bool
    """
    hole = ring.clockwise().reversed().curves
    area = Item((ring.clockwise(),), _INK).enclosed
    bar = bar_of(area, slender=SLOT)
    if bar is None:
        return Opening(Blend(Pieces(hole, hole, True), np.stack([hole[0, 0]] * 2)), closes)
    places = hole @ bar.ahead
    middle, half = float(places.min() + places.max()) / 2, float(np.ptp(places)) / 2 - bar.half
    begun = hole - np.clip(places - middle, -half, half)[..., None] * bar.ahead
    return Slot(begun, hole, closes)


def _as_stroke(one: Item, other: Item, scale: float) -> CurveTrack | None:
    """Two holes that are outlined strokes by their lines; None of others."""
    lines = []
    for item in (one, other):
        stroke = stroke_of(item)
        if stroke is None:
            return None
        lines.append(line_of(stroke, item))
    symmetric = next((k for k in (0, 1) if all(_is_own_image(line, k) for line in lines)), -1)
    forms = form_of(lines[0]), form_of(lines[1])
    ends = Ends(lines[0], lines[1], forms, scale, symmetric, root=False)
    first, _, tracks = as_painted(lines[0], lines[1], (open_track(ends),))
    return tracks[0] if first.filled and len(tracks[0].counts) == 1 else None


def _is_own_image(line: Item, flips: int) -> bool:
    """Whether an open line is its own mirror image, run the other way."""
    image = line.points[::-1].copy()
    image[:, flips] = line.box[:, flips].sum() - image[:, flips]
    return bool(np.abs(image - line.points).max() < SYMMETRIC * line.extent)
