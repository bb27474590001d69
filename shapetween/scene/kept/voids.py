"""Holes that both areas have, each moving as the form it is: a disc, a box, a stroke."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from shapetween.base.arrays import Floats
from shapetween.fill.regions import Region
from shapetween.geometry.bezier import signed_area
from shapetween.model.outline import Outline
from shapetween.model.paint import Colour, Style
from shapetween.model.part import CurveTrack
from shapetween.scene.forms import RoundedBox, form_of
from shapetween.scene.items import Item
from shapetween.scene.kept.bars import bar_of
from shapetween.scene.kept.wipes import Against, Slot
from shapetween.scene.motion.choose import Ends, open_track
from shapetween.scene.motion.holes import Opening, matched_holes
from shapetween.scene.motion.tracks import Blend
from shapetween.scene.places import Pieces
from shapetween.scene.relations import in_common, pictures
from shapetween.scene.stroke_limbs import OutlinedStroke, outlined_strokes
from shapetween.scene.strokes import as_painted, line_of

if TYPE_CHECKING:
    import shapely

__all__ = ["lone_void", "paired_voids", "void_track"]

#: Greatest distance of two holes that become each other, as a share of the drawing; what a factor
#: e in size counts beside it; and the greatest such factor.
APART, SIZE, GROWN = 0.8, 0.15, 1.2

#: Share of the way of two holes that may lie outside of what is solid.
STRAY = 0.02

#: Least share that two holes have in common, each in its own square, to be of one form.
ALIKE = 0.6

#: Distance from its mirror image, as a share of its size, of a line that is its own.
SYMMETRIC = 0.02

#: Least ratio of the sides of a hole that is drawn as a bar.
SLOT = 2.2

#: What a hole is seen as by itself.
_INK = Style(fill=Colour())


def paired_voids(
    first: Sequence[Outline],
    second: Sequence[Outline],
    solid: "tuple[shapely.Geometry, shapely.Geometry]",
    scale: float,
) -> list[tuple[int, int]]:
    """Holes that become each other, by place and size, with nothing in between.

    Parameters
    ----------
    first, second : sequence of Outline
        Holes that have no stretch in common with the other drawing.
    solid : (shapely geometry, shapely geometry)
        Both areas with these holes filled.
    scale : float
        Size of the drawing.
    """
    import shapely
    from scipy.optimize import linear_sum_assignment

    if not first or not second:
        return []
    items = [[Item((ring.clockwise(),), _INK) for ring in side] for side in (first, second)]
    centres = [np.array([item.centre for item in side]) for side in items]
    sizes = [np.array([item.size for item in side]) for side in items]
    apart = np.linalg.norm(centres[0][:, None] - centres[1], axis=-1) / scale
    grown = np.abs(np.log(sizes[0][:, None] / sizes[1]))
    cost: Floats = np.round(apart + SIZE * grown, 9)
    rows, columns = linear_sum_assignment(cost)
    both = solid[0].intersection(solid[1])
    alike = in_common(pictures(items[0]), pictures(items[1])) > ALIKE
    boxes, bent = (
        [np.array([test(item) for item in side]) for side in items]
        for test in (_is_box, _is_stroke)
    )
    alike |= (boxes[0][:, None] & boxes[1]) | (bent[0][:, None] & bent[1])
    found = []
    for i, j in zip(rows.tolist(), columns.tolist(), strict=True):
        if apart[i, j] > APART or grown[i, j] > GROWN or not alike[i, j]:
            continue
        way = shapely.union(items[0][i].enclosed, items[1][j].enclosed).convex_hull
        if way.difference(both).area <= STRAY * way.area:
            found.append((i, j))
    return found


def _is_box(item: Item) -> bool:
    return isinstance(form_of(item), RoundedBox)


def _is_stroke(item: Item) -> bool:
    return _stroke_of(item) is not None


def _stroke_of(item: Item) -> OutlinedStroke | None:
    """The one open stroke that a hole is, if it is one."""
    strokes = outlined_strokes(Region(item.outer))
    if strokes is None or len(strokes) != 1 or strokes[0].line.line.closed:
        return None
    return strokes[0]


def void_track(first: Outline, second: Outline, scale: float) -> CurveTrack:
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


def lone_void(ring: Outline, closes: bool) -> CurveTrack:
    """A hole that opens round its middle, or closes; a bar opens round at one end and is drawn.

    Parameters
    ----------
    ring : Outline
    closes : bool
    """
    void = ring.clockwise().reversed().curves
    area = Item((ring.clockwise(),), _INK).enclosed
    bar = bar_of(area, slender=SLOT)
    if bar is None:
        return Opening(Blend(Pieces(void, void, True), np.stack([void[0, 0]] * 2)), closes)
    places = void @ bar.ahead
    low, high = float(places.min()) + bar.half, float(places.max()) - bar.half
    begun = void - np.clip(places - low, 0.0, high - low)[..., None] * bar.ahead
    return Slot(begun, void, closes)


def _as_stroke(one: Item, other: Item, scale: float) -> CurveTrack | None:
    """Two holes that are outlined strokes by their lines; None of others."""
    lines = []
    for item in (one, other):
        stroke = _stroke_of(item)
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
