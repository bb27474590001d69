"""A sign that becomes the hole in a plate: the plate grows behind it and inverts what it covers.

An arrow gets a square round it, a question mark a disc. In between nobody wants a blot out of which
the plate swells; the sign stays, at its place and form, and turns white where the plate is.
"""

from collections.abc import Sequence
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from shapetween.base.arrays import Affine, Points
from shapetween.geometry.assignment import cheapest_pairs
from shapetween.model.outline import Outline
from shapetween.model.paint import Colour, Style
from shapetween.model.part import CurveTrack
from shapetween.scene.items import Item, intersection_over_union
from shapetween.scene.kept.appearing import Against
from shapetween.scene.kept.badges import Grown
from shapetween.scene.kept.holes import matched_hole_track

if TYPE_CHECKING:
    import shapely

__all__ = ["inverted_tracks"]

Sign: TypeAlias = tuple[list[Item], list[Item]]
"""What a sign's outer outlines enclose, and what its holes do."""

#: Least share of its hull that a plate's outline fills. Smaller, and a house with a door is one.
PLATE = 0.9

#: Most that a plate and the sign, its holes filled, each brought to one box, have in common. More,
#: and a disc that becomes a ring is inverted rather than opened.
UNLIKE = 0.9

#: Greatest distance of a sign from what the plate shows of it, as a share of their size. Smaller,
#: and signs drawn bolder in a plate are others; larger, and a tick is a cross.
SAME = 0.2

#: Greatest ratio of the two ratios of width to height.
NARROWER = 1.6

#: Share of its hull from which on a sign, or what is cut out, is one blot. Larger, and a heart that
#: gets a disc round it is seen as a thin line, and a C as the hole of a D; smaller, and a bolt
#: swells to the disc.
BLOT = 0.85

#: Most rings of a sign.
MOST = 8


def inverted_tracks(
    sides: tuple[Sequence[Item], Sequence[Item]], scale: float
) -> tuple[CurveTrack, ...] | None:
    """Tracks of a drawing that is a sign and of one that is a plate with that cut out, or back.

    The rule nonzero shows them: the sign runs against the plate, so that both are seen alone, and
    neither where they lie on each other.

    Parameters
    ----------
    sides : (sequence of Item, sequence of Item)
        All there is, of one colour.
    scale : float
        Size of the drawing.

    Returns
    -------
    tuple of CurveTrack or None
        The plate's first; None of other drawings.
    """
    for comes in (True, False):
        sign, whole = sides if comes else sides[::-1]
        plate = max(whole, key=lambda item: round(item.enclosed.area / scale**2, 9))
        shown = _cut_out(plate, whole)
        if shown is None or not _is_plate(plate):
            continue
        mine: Sign = (
            _areas([item.outer for item in sign]),
            _areas([hole for item in sign for hole in item.holes]),
        )
        if [len(side) for side in mine] != [len(side) for side in shown]:
            continue
        if sum(map(len, mine)) > MOST or not _is_shown(mine, shown, plate):
            continue
        if any(intersection_over_union(area.enclosed, plate.enclosed) > UNLIKE for area in mine[0]):
            continue  # it stands where it stood, and gets something in its hole
        tracks: list[CurveTrack] = [
            Grown((plate.outer.clockwise(),), plate.box.mean(axis=0), comes)
        ]
        maps = _to_unit(_box(mine[0])), _to_unit(_box(shown[0]))
        for k, (own, there) in enumerate(zip(mine, shown, strict=True)):
            for i, j in _partners(own, there, maps):
                ends = own[i].outer, there[j].outer
                track = matched_hole_track(*(ends if comes else ends[::-1]), scale)
                tracks.append(Against(track) if k else track)
        return tuple(tracks)
    return None


def _cut_out(plate: Item, whole: Sequence[Item]) -> tuple[list[Item], list[Item]] | None:
    """What is cut out of a plate, and what lies in that; None with anything else beside it."""
    holes = _areas(plate.holes)
    islands: list[Item] = []
    for item in whole:
        if item is plate:
            continue
        if item.holes or not any(hole.enclosed.contains(item.enclosed) for hole in holes):
            return None
        islands += _areas(item.rings)
    return (holes, islands) if holes else None


def _areas(rings: Sequence[Outline]) -> list[Item]:
    """What each of some rings encloses."""
    return [Item((ring.clockwise(),), Style(fill=Colour())) for ring in rings]


def _is_plate(item: Item) -> bool:
    """Whether an item is nearly convex."""
    area = item.enclosed
    return bool(area.area > PLATE * area.convex_hull.area)


def _is_shown(mine: Sign, shown: Sign, plate: Item) -> bool:
    """Whether a sign is what is cut out of a plate, and is not the plate itself."""
    boxes = _box(mine[0]), _box(shown[0])
    sizes = np.stack([np.ptp(box, axis=0) for box in boxes])
    if not (sizes > 0).all() or abs(np.diff(np.log(sizes[:, 0] / sizes[:, 1]))) > np.log(NARROWER):
        return False
    own, there = _region(mine), _region(shown)
    if own.hausdorff_distance(there) > SAME:
        return False
    if any(area.area > BLOT * area.convex_hull.area for area in (own, there)):
        return False
    whole, filled = _region(([plate.replaced(plate.rings[:1])], [])), _region((mine[0], []))
    return intersection_over_union(filled, whole) < UNLIKE


def _box(items: Sequence[Item]) -> Points:
    """Least and greatest corner of some items, (2, 2)."""
    boxes = np.array([item.box for item in items])
    return np.stack([boxes[:, 0].min(axis=0), boxes[:, 1].max(axis=0)])


def _to_unit(box: Points) -> Affine:
    """The map that takes a box to the one from 0 to 1, (2, 3)."""
    size = np.ptp(box, axis=0)
    return np.column_stack([np.diag(1 / size), -box[0] / size])


def _region(sign: Sign) -> "shapely.Geometry":
    """What a sign paints, in a box from 0 to 1."""
    import shapely

    matrix = _to_unit(_box(sign[0]))
    outer, inner = (
        shapely.union_all([item.transformed(matrix).enclosed for item in side]) for side in sign
    )
    return outer.difference(inner)


def _partners(
    mine: Sequence[Item], shown: Sequence[Item], maps: tuple[Affine, Affine]
) -> list[tuple[int, int]]:
    """Which areas become each other: those that are nearest where the signs are one."""
    if not mine:
        return []
    one, other = (
        np.array([item.transformed(matrix).box.ravel() for item in side])
        for side, matrix in zip((mine, shown), maps, strict=True)
    )
    apart = np.round(np.linalg.norm(one[:, None] - other, axis=-1), 6)
    rows, columns = cheapest_pairs(apart)
    return list(zip(rows.tolist(), columns.tolist(), strict=True))
