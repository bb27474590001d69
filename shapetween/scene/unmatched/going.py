"""How an item without a partner goes or comes, and what it goes along with."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Literal

import numpy as np

from shapetween.base.arrays import Mask, Points
from shapetween.base.ends import End
from shapetween.model.part import CurveTrack
from shapetween.scene.forms import Dot, Segment
from shapetween.scene.items import Item
from shapetween.scene.motion.fold import Fold
from shapetween.scene.relations import Scene
from shapetween.scene.unmatched.clusters import Anchors
from shapetween.scene.unmatched.presence import NEAR, Carry, Leaving

if TYPE_CHECKING:
    import shapely

__all__ = ["Going", "Side", "nearer_end", "nearest_beside", "within_reach"]

#: When what has no partner disappears, and when it appears. One is early and the other late, but
#: they overlap: apart, the middle is empty; much more together, and both are seen at once.
GOES, COMES = (0.0, 0.44), (0.42, 1.0)

#: The same where nothing stays, and a middle with neither of the two would be blank; where little
#: stays, between the two.
ALL_GO, ALL_COME = (0.0, 0.48), (0.42, 1.0)

#: The same where what goes and what comes are nowhere near each other: they may be seen at once,
#: and nothing jumps into the picture half way.
APART_GO, APART_COME = (0.0, 0.52), (0.28, 1.0)

#: When what has no partner comes where nothing goes that it would have to wait for. Later, and for
#: half of the time nothing happens; from the very start, and it comes with a jerk.
ONLY_COME = (0.12, 1.0)

#: Share of its time by which each piece of a composed line waits for the one that it hangs on.
WAITS = 0.35

#: Distance from a loose part, as a share of the drawing, of what carries it along.
BESIDE = 0.15

#: Least ratio of sizes at which a thing carries what is loose beside it. At 1 equal things of a
#: list carry each other about; larger, and a sun leaves its rays behind.
BIGGER = 1.5

#: Share of a line's length by which one of its ends must be nearer than the other to count so.
NEARER = 0.4


@dataclass(frozen=True, slots=True, eq=False)
class Going:
    """How an item goes or comes, and with what.

    Attributes
    ----------
    leaving : Leaving
    carries : tuple of Carry
        One for all of it, one for each half of a line that goes into both its ends, one for each
        end of a line that goes into its middle, or none.
    cut : float
        Where that line is cut, or a ring that is drawn, as a share of its length.
    fold : Fold or None
        How a line folds down onto what it hangs on, instead.
    along : CurveTrack or None
        The outline that a ring runs along and keeps to, instead.
    """

    leaving: Leaving
    carries: tuple[Carry, ...] = ()
    cut: float = 0.5
    fold: Fold | None = None
    along: CurveTrack | None = None


@dataclass(frozen=True, eq=False)
class Side:
    """One drawing, what stays of it, and at which end the rest exists.

    Attributes
    ----------
    scene : Scene
    anchors : mapping of int to sequence of Track
        Of the items that have partners.
    end : End
        The end at which what has no partner exists.
    gaps : tuple of Item
        Pieces that are cut out of the other drawing's lines.
    only : bool
        Whether the other drawing has nothing without a partner.
    apart : bool
        Whether that is nowhere near what has none of this one.
    faces : mask, optional
        Which items have features of a face on them.
    """

    scene: Scene
    anchors: Anchors
    end: End
    gaps: tuple[Item, ...] = ()
    only: bool = False
    apart: bool = False
    faces: Mask | None = None

    @cached_property
    def window(self) -> tuple[float, float]:
        """When what has no partner goes or comes, by how much of the drawing stays."""
        if self.only and self.end is End.TARGET:
            return ONLY_COME
        areas = np.array([item.area for item in self.scene.items])
        areas[self.scene.sheets] = 0.0
        whole = float(areas.sum())
        stays = float(areas[list(self.anchors)].sum()) / whole if whole > 0 else 1.0
        go = (APART_GO, ALL_GO) if self.apart else (GOES, ALL_GO)
        come = (APART_COME, ALL_COME) if self.apart else (COMES, ALL_COME)
        some, none = come if self.end is End.TARGET else go
        gone = (1 - stays) ** 2  # a part or two that go do not count
        low, high = ((1 - gone) * a + gone * b for a, b in zip(some, none, strict=True))
        return low, high

    def carry(
        self, anchor: int | None, place: Points, how: Literal["in", "at", "beside"]
    ) -> tuple[Carry, ...]:
        """What carries a place along that lies in an item that stays, at it, or beside it.

        What lies in it turns and grows as it does; what is at it keeps to what it touches; what is
        beside it goes with it as a whole, or a set of such things would be torn apart.
        """
        if anchor is None:
            return ()
        reach = self.scene.scale * (1.0 if how == "beside" else NEAR)
        track = self.anchors[anchor][0]
        return (Carry(track, place, reach, self.end, how == "in"),)

    def part_of(self, step: int, steps: int) -> tuple[float, float]:
        """The window of one of several that come or go one after the other."""
        low, high = self.window
        if steps == 1:
            return low, high
        wait = WAITS * (high - low) * (1 if self.end is End.TARGET else -1) / (steps - 1)
        if self.end is End.TARGET:
            return low + step * wait, high - (steps - 1 - step) * wait
        return low - (steps - 1 - step) * wait, high + step * wait


def nearest_beside(members: Sequence[int], side: Side) -> int | None:
    """What a loose part is carried by: the nearest larger thing that stays, and is near."""
    import shapely

    scene = side.scene
    least = BIGGER * max(scene.sizes[k] for k in members)
    anchors = [
        j
        for j in side.anchors
        if not scene.sheets[j]
        and scene.sizes[j] > least
        and not isinstance(scene.forms[j], Segment | Dot)
    ]
    if not anchors:
        return None
    own = shapely.union_all([scene.items[k].drawn for k in members])
    reach = BESIDE * scene.scale
    anchors = [j for j in anchors if within_reach(scene.items[j], own, reach)]
    if not anchors:
        return None
    away = shapely.distance(own, np.array([scene.items[j].drawn for j in anchors], dtype=object))
    best = int(np.round(away / scene.scale, 6).argmin())
    return anchors[best] if away[best] < BESIDE * scene.scale else None


def within_reach(item: Item, other: "shapely.Geometry", reach: float) -> bool:
    """Whether an item's area is as near to another one: of a long outline a quick look."""
    import shapely

    shapely.prepare(item.drawn)
    return bool(shapely.dwithin(item.drawn, other, reach * (1 + 1e-9)))


def nearer_end(ends: Points, anchor: int, scene: Scene) -> int | None:
    """Which of two ends is nearer to an item, if one is by much."""
    import shapely

    away = shapely.distance(scene.items[anchor].enclosed, shapely.points(ends))
    length = float(np.linalg.norm(ends[1] - ends[0]))
    if abs(away[0] - away[1]) < NEARER * length:
        return None
    return int(away[1] < away[0])
