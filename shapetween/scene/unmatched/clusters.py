"""What comes or goes together: items without a partner that touch, or lie in one another."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from shapetween.base.arrays import Index, Points
from shapetween.model.part import CurveTrack
from shapetween.scene.forms import OpenLine, Segment
from shapetween.scene.relations import Scene

__all__ = ["Anchors", "Cluster", "clusters_of", "contact", "is_line", "staying_parent"]

Anchors = Mapping[int, Sequence[CurveTrack]]
"""Tracks of the items that have partners."""

#: How near the borders of two things are that touch, as a share of the drawing.
REACH = 0.004


@dataclass(frozen=True, slots=True, eq=False)
class Cluster:
    """Items that come or go together.

    Attributes
    ----------
    members : tuple of int
        In paint order.
    parent : int or None
        The nearest item around all of them that stays.
    lines : bool
        Whether all of them are open lines.
    sign : bool
        Whether they are one sign on their parent, however they touch.
    """

    members: tuple[int, ...]
    parent: int | None
    lines: bool
    sign: bool = False


def is_line(k: int, scene: Scene) -> bool:
    """Whether an item is an open line, and longer than wide."""
    return isinstance(scene.forms[k], Segment | OpenLine)


def staying_parent(k: int, scene: Scene, anchors: Anchors) -> int | None:
    """The nearest item around one that has a partner."""
    parent = int(scene.parents[k])
    while parent >= 0 and parent not in anchors:
        parent = int(scene.parents[parent])
    return parent if parent >= 0 else None


def clusters_of(unmatched: Sequence[int], scene: Scene, anchors: Anchors) -> list[Cluster]:
    """Items without a partner, put together with those that they touch or lie in.

    Parameters
    ----------
    unmatched : sequence of int
    scene : Scene
    anchors : mapping of int to sequence of CurveTrack
    """
    around = {k: staying_parent(k, scene, anchors) for k in unmatched}
    own = {k: k for k in unmatched}

    def first(k: int) -> int:
        while own[k] != k:
            k = own[k]
        return k

    for k, j in _together(np.array(unmatched, dtype=np.intp), around, scene):
        one, other = sorted((first(k), first(j)))
        own[other] = one
    groups: dict[int, list[int]] = {}
    for k in unmatched:
        groups.setdefault(first(k), []).append(k)
    return [
        Cluster(tuple(members), around[key], all(is_line(k, scene) for k in members))
        for key, members in groups.items()
    ]


def _together(
    unmatched: Index, around: Mapping[int, int | None], scene: Scene
) -> list[tuple[int, int]]:
    """Pairs of items that touch within one thing that stays, or one of which is the other's."""
    inside = np.array([-1 if around[k] is None else around[k] for k in unmatched.tolist()])
    both = scene.touching[np.ix_(unmatched, unmatched)] & (inside[:, None] == inside)
    for of in (scene.parents[unmatched], scene.outlined[unmatched]):
        both |= of[:, None] == unmatched
    found = np.argwhere(np.triu(both | both.T, 1))
    return [(int(k), int(j)) for k, j in unmatched[found].tolist()]


def contact(
    members: Sequence[int], anchor: int, scene: Scene, inside: bool
) -> tuple[Points, float]:
    """Where some items touch another one's area, or its border from inside: middle and length.

    Returns
    -------
    (2,) float64
        The middle of what they share; the items' own if that is nothing.
    float
        The diagonal of its box, 0 for nothing.
    """
    import shapely

    one = shapely.union_all([scene.items[k].drawn for k in members])
    two: Any = scene.items[anchor].drawn
    reach = REACH * scene.scale
    near = shapely.boundary(two).buffer(reach) if inside else two.buffer(reach)
    shared = shapely.intersection(shapely.boundary(one), near)
    if shared.is_empty:
        return np.array([one.centroid.x, one.centroid.y]), 0.0
    middle = shared.centroid
    length = float(np.hypot(*np.diff(np.reshape(shared.bounds, (2, 2)), axis=0)[0]))
    return np.array([middle.x, middle.y]), length
