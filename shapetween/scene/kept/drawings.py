"""What two drawings have in common in place, or after one slide, and how the rest of them moves."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from shapetween.base.arrays import Points
from shapetween.base.notices import Notice
from shapetween.base.ranking import comparable
from shapetween.geometry.bezier import curve_lengths, flatten
from shapetween.scene.asked import Group
from shapetween.scene.items import SAMPLES, Item, intersection_over_union
from shapetween.scene.kept.areas import Kept, KeptArea, kept_areas
from shapetween.scene.kept.coinciding import (
    COLOUR,
    MOST_AREAS,
    REACH,
    Sides,
    coinciding_areas,
    scale_of,
)
from shapetween.scene.kept.redrawn import crossed_tracks
from shapetween.scene.motion.tracks import Frame, Framed

__all__ = ["kept_drawings", "slide_between"]

#: Share of the first outline that a slide takes onto the second one, for it to be seen. Smaller,
#: and discs of one size slide together whatever else there is.
ALIKE = 0.5

#: Greatest slide, as a share of the drawing. Larger, and a letter slides onto its like in a word.
FARTHEST = 0.15

#: Share that two areas have in common that are one, drawn anew.
SAME = 0.95

#: Most rings of a drawing that slides are looked for with, and every which of the samples on each
#: they are judged by. More of either cost time, rings with their square.
MOST_RINGS, EVERY = 6, 2


def kept_drawings(first: Sequence[Item], second: Sequence[Item], groups: Sequence[Group]) -> Kept:
    """Find what stays where it is of two drawings, or slides as one.

    Parameters
    ----------
    first, second : sequence of Item
        In paint order and one frame.
    groups : sequence of Group
        Shapes that become each other: they are kept together or not at all.
    """
    sides: Sides = (first, second)
    scale = scale_of(sides)
    coinciding = coinciding_areas(first, second)
    kept = kept_areas(coinciding, groups)
    if groups or (kept.areas and _is_all(kept)):
        return kept
    crossed = _crossed(sides, scale)
    if crossed is not None:
        return crossed
    slid = None if kept.areas else _slid(sides, scale)
    if slid is not None:
        return slid
    kept = kept_areas(coinciding, parts=True)
    return kept if kept.areas else replace(kept, notices=(*kept.notices, *_limits(sides)))


def _limits(sides: Sides) -> tuple[Notice, ...]:
    """What to tell where there is too much to be looked for."""
    found = []
    if sum(map(len, sides)) > MOST_AREAS and _one_colour(sides):
        found.append(
            f"of more than {MOST_AREAS} areas it is not looked for whether a slash comes over all"
        )
    if _most_rings(sides) > MOST_RINGS:
        found.append(f"of more than {MOST_RINGS} outlines it is not looked for a slide")
    return tuple(Notice("too-many-parts", text, severity="note") for text in found)


def _most_rings(sides: Sides) -> int:
    return max(sum(len(item.rings) for item in side) for side in sides)


def _one_colour(sides: Sides) -> bool:
    """Whether each drawing is plain areas of one colour."""
    return all(
        item.plain and np.abs(item.colour - side[0].colour).sum() <= COLOUR
        for side in sides
        for item in side
    )


def slide_between(sides: Sides, scale: float) -> Points | None:
    """The slide, (2,), that takes much of one drawing onto the other one; None without one."""
    import shapely

    if _most_rings(sides) > MOST_RINGS:
        return None
    rings = [[ring for item in side for ring in item.rings] for side in sides]
    boxes = [np.array([ring.box for ring in side]) for side in rings]
    ways = boxes[1] - boxes[0][:, None]
    corners = np.stack([ways[:, :, i, 0] for i in (0, 1)] * 2, axis=-1).reshape(-1, 4)
    rises = np.stack([ways[:, :, i, 1] for i in (0, 0, 1, 1)], axis=-1).reshape(-1, 4)
    tried = np.stack([corners, rises], axis=-1).reshape(-1, 2)
    length = np.hypot(tried[:, 0], tried[:, 1])
    tried = tried[(length < FARTHEST * scale) & (length > REACH * scale)]
    tried = np.unique(np.round(tried / (REACH * scale)), axis=0) * REACH * scale
    if not len(tried):
        return None
    style = sides[0][0].style
    points = np.concatenate([Item((ring,), style).points[::EVERY] for ring in rings[0]])
    weights = np.repeat(
        [float(curve_lengths(ring.curves).sum()) for ring in rings[0]], SAMPLES // EVERY
    )
    lines = [np.append(flatten(r.curves, 16), r.curves[-1:, 3], 0) for r in rings[1]]
    outline = shapely.MultiLineString(lines)
    shapely.prepare(outline)
    there = shapely.points(tried[:, None] + points)
    near = shapely.dwithin(outline, there, 2 * REACH * scale)
    shares = near @ weights / weights.sum()
    best = int(comparable(shares).argmax())
    return np.asarray(tried[best]) if shares[best] > ALIKE else None


def _slid(sides: Sides, scale: float) -> Kept | None:
    """What stays of two drawings once the second one is slid onto the first, moved by that.

    What has no part in it goes its own way.
    """
    if not all(item.plain for side in sides for item in side):
        return None
    way = slide_between(sides, scale)
    if way is None:
        return None
    back = np.column_stack([np.eye(2), -way])
    moved = [item.transformed(back) for item in sides[1]]
    kept = kept_areas(coinciding_areas(sides[0], moved))
    if not kept.areas or not _one_sided(kept):
        return None
    frame = Frame(np.stack([np.zeros(2), way]), 0.0, np.eye(2))
    forth = np.column_stack([np.eye(2), way])
    own = {id(item): item.transformed(forth) for item in kept.second}
    own |= {id(item): drawn for item, drawn in zip(moved, sides[1], strict=True)}
    areas = tuple(
        KeptArea(a.first, own[id(a.second)], tuple(Framed(track, frame) for track in a.tracks))
        for a in kept.areas
    )
    return replace(kept, second=tuple(own[id(item)] for item in kept.second), areas=areas)


def _one_sided(kept: Kept) -> bool:
    """Whether what is left of at least one drawing is there in the other one too."""
    own = [{id(a.first) for a in kept.areas}, {id(a.second) for a in kept.areas}]
    left = [
        [item.drawn for item in side if id(item) not in areas]
        for side, areas in zip((kept.first, kept.second), own, strict=True)
    ]
    return any(
        all(
            any(intersection_over_union(one, other) > SAME for other in left[1 - k])
            for one in left[k]
        )
        for k in (0, 1)
    )


def _is_all(kept: Kept) -> bool:
    """Whether nothing is left of either drawing."""
    return len(kept.first) == len(kept.second) == len(kept.areas)


def _crossed(sides: Sides, scale: float) -> Kept | None:
    """All of two drawings of one colour as one area, if one is the other one crossed out."""
    if sum(map(len, sides)) > MOST_AREAS or not _one_colour(sides):
        return None
    tracks = crossed_tracks(sides, scale)
    if tracks is None:
        return None
    first, second = (
        _by_winding(max(side, key=lambda item: round(item.enclosed.area / scale**2, 9)))
        for side in sides
    )
    return Kept((first,), (second,), (KeptArea(first, second, tracks),))


def _by_winding(item: Item) -> Item:
    """An item of which what runs against what it lies on is cut out of that."""
    return replace(item, cut=True, style=replace(item.style, fill_rule="nonzero"))
