"""From two drawings' items to who becomes whom."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from shapetween.base.arrays import Mask, Points
from shapetween.base.notices import Notice
from shapetween.base.observe import Observer, unobserved
from shapetween.model.part import CurveTrack
from shapetween.scene.asked import Asked, Group
from shapetween.scene.assign import Roles, assign
from shapetween.scene.cuts import Cut, cut_alike_items
from shapetween.scene.items import Item
from shapetween.scene.kept.areas import KeptArea
from shapetween.scene.letters import other_letters
from shapetween.scene.likeness import scaled_groups
from shapetween.scene.motion.pinned import pinned_items
from shapetween.scene.motion.tracks import Frame
from shapetween.scene.relations import Scene, perceive
from shapetween.scene.slides import lines_that_slide
from shapetween.scene.whole import frame_between, moved_items

__all__ = ["Paired", "pair_items"]


#: Distance, as a share of the drawing, up to which what is left of a line is all of another one.
#: Smaller, and a stem that is drawn with a dome leaves; larger, and a corner becomes a check.
ALL_OF = 0.03

#: Size, as a share of the drawing, up to which what is left of a line is a gap in it. Larger, and
#: the back of a folder is; smaller, and the corner of a table becomes a stroke of an x.
GAP = 0.4

#: What is told of drawings of too many pairs.
UNSCALED = Notice(
    "too-many-parts",
    "of so many parts it is not looked for whether one drawing is in the other, moved and scaled",
    instead="each becomes what is like it",
    severity="note",
)


@dataclass(frozen=True, slots=True, eq=False)
class Paired:
    """Two drawings as scenes, and who becomes whom.

    Attributes
    ----------
    scenes : (Scene, Scene)
        The second one as it is in the frame.
    roles : Roles
    frame : Frame or None
        In which the drawings move as a whole.
    pinned : dict of int to (int, int)
        The pair that each pin is on.
    still : dict of (int, int) to tuple of CurveTrack
        Pairs of which most stays where it is, and how the rest moves.
    notices : tuple of Notice
        What was not looked for.
    """

    scenes: tuple[Scene, Scene]
    roles: Roles
    frame: Frame | None
    pinned: dict[int, tuple[int, int]]
    still: dict[tuple[int, int], tuple[CurveTrack, ...]]
    notices: tuple[Notice, ...] = ()


def pair_items(
    first: Sequence[Item],
    second: Sequence[Item],
    views: tuple[Points, Points],
    asked: Asked,
    kept: Sequence[KeptArea] = (),
    observe: Observer = unobserved,
) -> Paired:
    """See both drawings, cut what becomes several, and find who becomes whom.

    Parameters
    ----------
    first, second : sequence of Item
        In paint order and one frame.
    views : ((2, 2) float64, (2, 2) float64)
        What is shown of each drawing, as least and greatest corners.
    asked : Asked
    kept : sequence of KeptArea
        Items among them of which most stays where it is.
    observe : Observer, optional
        Told of every stage.
    """
    with observe("perceive"):
        a, b = perceive(first, views[0]), perceive(second, views[1])
        frame = frame_between(a, b) if not (len(asked.pins) or kept) else None
        if frame is not None:
            b = perceive(moved_items(b, frame), views[1])
    with observe("match"):
        free = not (asked.groups or len(asked.pins) or kept or frame)
        moved = scaled_groups(a, b) if free else []
        cut = Cut((a, b), ()) if moved else cut_alike_items(a, b, views, asked.groups)
        notices = (*cut.notices, *(() if moved is not None else (UNSCALED,)))
        a, b = cut.scenes
        still = {_places_of(area, a, b): area.tracks for area in kept}
        fixed, barred = _fixed(a, b, asked.groups)
        fixed += [pair for pair in still if pair not in fixed]
        barred |= _rests(cut)
        pinned = pinned_items(asked.pins, a, b)
        fixed += [pair for pair in pinned.values() if pair not in fixed]
        fixed += [pair for pair in cut.given if not barred[pair]]
        barred |= other_letters(a, b)
        if not fixed and not barred.any() and frame is None:
            fixed = lines_that_slide(a, b) or moved or []
        roles = assign(a, b, fixed, barred, asked.price)
        roles = replace(
            roles,
            pairs=tuple(
                replace(role, reason="kept") if (role.first, role.second) in still else role
                for role in roles.pairs
            ),
        )
    return Paired((a, b), roles, frame, pinned, still, notices)


def _rests(cut: Cut) -> Mask:
    """Pairs of the little that is left of a line that was cut, and anything that was not.

    It goes into what it was cut from, or comes out of that, unless it is all of the other one.
    """
    given = [{pair[n] for pair in cut.given} for n in (0, 1)]
    kinds = [
        [
            item.cut and not item.filled and k not in own and item.size < GAP * scene.scale
            for k, item in enumerate(scene.items)
        ]
        for scene, own in zip(cut.scenes, given, strict=True)
    ]
    whole = [[not item.cut for item in scene.items] for scene in cut.scenes]
    rests = np.outer(kinds[0], whole[1]) | np.outer(whole[0], kinds[1])
    for i, j in np.argwhere(rests).tolist():
        points = [scene.items[k].points for scene, k in zip(cut.scenes, (i, j), strict=True)]
        ways = [
            np.linalg.norm(points[0] - way, axis=1).max() for way in (points[1], points[1][::-1])
        ]
        rests[i, j] = min(ways) > ALL_OF * cut.scenes[0].scale
    return np.asarray(rests)


def _places_of(area: KeptArea, a: Scene, b: Scene) -> tuple[int, int]:
    """Where the items that stand for a kept area are among all."""
    items = (area.first, a), (area.second, b)
    one, other = (
        next(k for k, item in enumerate(scene.items) if item is own) for own, scene in items
    )
    return one, other


def _fixed(a: Scene, b: Scene, groups: Sequence[Group]) -> tuple[list[tuple[int, int]], Mask]:
    """Pairs of items that groups of shapes fix, and what they bar."""
    shapes = [np.array([item.shape for item in scene.items]) for scene in (a, b)]
    barred = np.zeros((len(a.items), len(b.items)), dtype=bool)
    pairs = []
    for group in groups:
        inside = [np.isin(side, named) for side, named in zip(shapes, group, strict=True)]
        barred |= inside[0][:, None] != inside[1]
        own = [np.flatnonzero(side) for side in inside]
        if len(own[0]) == len(own[1]) == 1:
            pairs.append((int(own[0][0]), int(own[1][0])))
    return pairs, barred
