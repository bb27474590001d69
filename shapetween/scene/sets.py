"""Repeated sets: one thing several times, whose members go to another set's in order of place."""

from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from shapetween.base.arrays import Floats, Index, Mask, Points
from shapetween.geometry.assignment import cheapest_pairs
from shapetween.scene.relations import Scene, colours_apart

__all__ = ["REPEATED", "Ordered", "Sets", "components", "paired_sets", "sets_of"]

#: How much members may differ: logarithm of sizes and of lengths, and sum of colours.
SIZES, LENGTHS, COLOURS = 0.15, 0.15, 0.15

#: Members from which on a set is a pattern: rays, teeth, windows. Twos are mates, and three lines
#: may be anything.
REPEATED = 4

#: Least number of members that go in order.
LEAST = 2

#: Greatest difference of sets that become each other, in colour, place, and size. Sets that are
#: all there is of their drawings may differ more.
OTHER = 0.5

#: Extent across, as a share of that along, up to which a set is a row.
ROW = 0.15

#: Greatest departure of members from a circle about their middle, as a share of its radius, and
#: least number of them, for a set to be a ring.
RING, ROUND = 0.1, 5


Ordered: TypeAlias = list[tuple[Index, Index]]
"""Sets that become each other: items of both drawings, in the order in which they do."""


@dataclass(frozen=True, slots=True, eq=False)
class Sets:
    """Which items are one thing several times.

    Attributes
    ----------
    labels : (N,) intp
        Items of one set have one number.
    counts : (N,) intp
        Number of members of each item's set.
    """

    labels: Index
    counts: Index

    @property
    def members(self) -> list[Index]:
        """All sets of at least `LEAST`, each as its items."""
        order = np.argsort(self.labels, kind="stable")
        groups = np.split(order, np.flatnonzero(np.diff(self.labels[order])) + 1)
        return [group for group in groups if len(group) >= LEAST]


def sets_of(scene: Scene) -> Sets:
    """See which items are repeated: of one size, length and colour, in one thing."""
    sizes = np.log(scene.sizes)
    lengths = np.log([max(item.length, 1e-9 * scene.scale) for item in scene.items])
    kinds = np.array([(item.filled, item.closed) for item in scene.items])
    keys = np.column_stack([kinds, scene.parents, scene.sheets, scene.outlined >= 0])
    alike = np.abs(sizes[:, None] - sizes) < SIZES
    alike &= np.abs(lengths[:, None] - lengths) < LENGTHS
    alike &= colours_apart(scene.colours, scene.colours) < COLOURS
    alike &= (keys[:, None] == keys).all(axis=-1)
    labels = components(alike)
    return Sets(labels, np.bincount(labels)[labels])


def components(alike: Mask) -> Index:
    """Of each item the first one that it is alike with, by others if need be."""
    labels = np.arange(len(alike))
    while True:
        least = np.where(alike, labels, len(labels)).min(axis=1, initial=len(labels))
        least = least[least]
        if (least == labels).all():
            return labels
        labels = least


def paired_sets(a: Scene, b: Scene, repeated: tuple[Sets, Sets]) -> Ordered:
    """Sets of as many members that become each other, the members in order."""
    ours, theirs = repeated[0].members, repeated[1].members
    if not ours or not theirs:
        return []
    counts = [np.array([len(own) for own in side]) for side in (ours, theirs)]
    looks = [_looks(scene, side) for scene, side in ((a, ours), (b, theirs))]
    cost = np.abs(looks[0][:, None] - looks[1]).sum(axis=-1)
    cost = np.where(counts[0][:, None] == counts[1], np.round(cost, 6), 1e6)
    rows, columns = cheapest_pairs(cost)
    found = []
    for i, j in zip(rows.tolist(), columns.tolist(), strict=True):
        whole = len(ours[i]) == (~a.sheets).sum() and len(theirs[j]) == (~b.sheets).sum()
        if cost[i, j] < (1e6 if whole else OTHER):
            found.append(_in_order(a.centres[ours[i]], b.centres[theirs[j]], ours[i], theirs[j]))
    return found


def _looks(scene: Scene, sets: list[Index]) -> Floats:
    """What tells sets apart: colour, size, place, and how long their members are, (S, D)."""
    middle = scene.box.mean(axis=0)
    rows = []
    for own in sets:
        place = (scene.centres[own].mean(axis=0) - middle) / scene.scale
        size = np.log(scene.sizes[own] / scene.scale).mean()
        lines = np.mean([not scene.items[k].closed for k in own.tolist()])
        rows.append([*scene.colours[own].mean(axis=0), *place, 0.5 * size, lines])
    return np.array(rows)


def _in_order(one: Points, other: Points, ours: Index, theirs: Index) -> tuple[Index, Index]:
    """Members of two sets as they become each other, from where they are."""
    rows = _in_row(one), _in_row(other)
    if rows[0] is not None and rows[1] is not None:
        return ours[rows[0]], theirs[rows[1]]
    rings = _in_ring(one), _in_ring(other)
    if rings[0] is not None and rings[1] is not None:
        first, second = ours[rings[0][0]], theirs[rings[1][0]]
        turns = rings[1][1][_shifts(len(second))] - rings[0][1]
        turns = np.abs((turns + np.pi) % (2 * np.pi) - np.pi).sum(axis=1)
        return first, second[_shifts(len(second))[int(np.argmin(np.round(turns, 6)))]]
    places = []
    for centres in (one, other):
        low, size = centres.min(axis=0), np.ptp(centres, axis=0)
        places.append((centres - low) / np.where(size > 0, size, 1.0))
    cost = np.round(np.linalg.norm(places[0][:, None] - places[1], axis=-1), 6)
    i, j = cheapest_pairs(cost)
    return ours[i], theirs[j]


def _shifts(count: int) -> Index:
    """Every way to go round, (count, count)."""
    return np.asarray((np.arange(count)[:, None] + np.arange(count)) % count)


def _in_row(centres: Points) -> Index | None:
    """Order of a row from left to right, or of a column from above; None of other sets."""
    width, height = np.ptp(centres, axis=0)
    if min(width, height) > ROW * max(width, height):
        return None
    along = centres[:, 0] if width >= height else centres[:, 1]
    return np.argsort(along, kind="stable")


def _in_ring(centres: Points) -> tuple[Index, Floats] | None:
    """Order round a ring, and the angles in it; None of other sets."""
    offsets = centres - centres.mean(axis=0)
    radii = np.hypot(offsets[:, 0], offsets[:, 1])
    if len(centres) < ROUND or np.ptp(radii) > RING * radii.mean():
        return None
    angles = np.arctan2(offsets[:, 1], offsets[:, 0])
    order = np.argsort(np.round(angles, 6), kind="stable")
    return order, angles[order]
