"""Roles: which item becomes which, and what comes and goes by itself."""

from collections.abc import Collection, Sequence
from dataclasses import dataclass

import numpy as np

from shapetween.base.arrays import Floats, Mask
from shapetween.geometry.assignment import cheapest_pairs
from shapetween.scene.costs import (
    Current,
    alone,
    axes_cost,
    fixed_terms,
    parents_cost,
    relations_cost,
    same_things,
)
from shapetween.scene.evidence import Evidence, twins_cost
from shapetween.scene.outlines import with_outlines
from shapetween.scene.relations import Scene, colours_apart
from shapetween.scene.sets import Ordered
from shapetween.scene.torn import torn

__all__ = ["Role", "Roles", "alike_in_place", "assign"]

#: Rounds in which parents and relations are taken from the pairs of the round before.
ROUNDS = 6

#: Greatest departure of two items that are alike in place: way and distance of outlines, as shares
#: of the drawing and of their size, logarithm of sizes, and sum of colours.
SAME_PLACE, SAME_OUTLINE, SAME_SIZE, SAME_COLOUR = 0.012, 0.04, 0.06, 0.15

#: Way, as a share of the size, and logarithm of sizes, up to which a pair hardly changes.
HARDLY = 0.25

#: Cost of a pair that is fixed.
FIXED = -2.0

#: Decimals of a cost that count. More, and rounding chooses between pairs that are as good.
DECIMALS = 6

#: What a rank's difference in paint order costs, to choose between pairs that are as good.
TIE = 1e-7


@dataclass(frozen=True, slots=True)
class Role:
    """One pair, and why.

    Attributes
    ----------
    first, second : int
        Items.
    cost : float
    reason : str
        How it was found: "given", "alike", "matched", or "kept" if most of it stays where it is.
    """

    first: int
    second: int
    cost: float
    reason: str


@dataclass(frozen=True, slots=True)
class Roles:
    """Who becomes whom.

    Attributes
    ----------
    pairs : tuple of Role
    disappearing, appearing : tuple of int
        Items without a partner.
    disappearing_costs, appearing_costs : tuple of float
        What the best partner would have cost each of them, less what leaving both alone does.
    """

    pairs: tuple[Role, ...]
    disappearing: tuple[int, ...]
    appearing: tuple[int, ...]
    disappearing_costs: tuple[float, ...] = ()
    appearing_costs: tuple[float, ...] = ()

    def without(self, dropped: Collection[int]) -> "Roles":
        """The same, but with both items of some pairs alone."""
        firsts = {self.pairs[k].first: np.inf for k in dropped}
        seconds = {self.pairs[k].second: np.inf for k in dropped}
        firsts |= dict(zip(self.disappearing, self.disappearing_costs, strict=True))
        seconds |= dict(zip(self.appearing, self.appearing_costs, strict=True))
        return Roles(
            tuple(role for k, role in enumerate(self.pairs) if k not in dropped),
            tuple(sorted(firsts)),
            tuple(sorted(seconds)),
            tuple(firsts[k] for k in sorted(firsts)),
            tuple(seconds[k] for k in sorted(seconds)),
        )


def assign(
    a: Scene,
    b: Scene,
    given: Sequence[tuple[int, int]] = (),
    barred: Mask | None = None,
    price: float = 1.0,
) -> Roles:
    """Find the pairs of least total cost, leaving alone what has no match worth it.

    Parameters
    ----------
    a, b : Scene
        In one frame.
    given : sequence of (int, int)
        Pairs that are fixed.
    barred : (N, M) bool, optional
        Pairs that are not made unless they are fixed.
    price : float
        What leaving alone costs, times this.
    """
    count = len(a.items), len(b.items)
    evidence = Evidence.of(a, b)
    ordered = evidence.ordered
    table = sum(fixed_terms(a, b, evidence).values(), np.zeros(count))
    never = np.zeros(count, dtype=bool) if barred is None else barred.copy()
    never |= a.sheets[:, None] != b.sheets
    # A fill's outline goes where the fill goes, so to another outline or to nothing.
    never |= ((a.outlined >= 0)[:, None] != (b.outlined >= 0)) & ~_nearly_same(a, b)
    never |= torn(a, b)
    fixed = dict.fromkeys(given, "given")
    if not fixed:
        fixed = dict.fromkeys(_all_in_order(a, b, ordered, never), "alike")
    fixed |= dict.fromkeys(alike_in_place(a, b, never, fixed), "alike")
    for i, j in fixed:
        never[i, :] = never[:, j] = True
    for i, j in fixed:
        never[i, j] = False
        table[i, j] = FIXED
    left = price * alone(a), price * alone(b)
    now: Current | None = None
    relation: Floats | None = None
    history: Current | None = None
    if count == (1, 1):  # one thing becomes the other, whatever they are
        table[:] = np.minimum(table, 0.0)
    for turn in range(ROUNDS):
        costs = table
        if now is not None:
            latest = relations_cost(a, b, now)
            relation = latest if relation is None or turn < 2 else (relation + latest) / 2
            costs = table + parents_cost(a, b, now) + relation
        sets = [costs[first, second].mean() for first, second in ordered]
        costs = twins_cost(axes_cost(a, b, costs), evidence)
        for (first, second), mean in zip(ordered, sets, strict=True):  # all of a set or none
            costs[first, second] = mean
        for i, j in fixed:
            costs[i, j] = FIXED
        costs = np.where(never, np.inf, costs)
        history, now = now, _cheapest(costs, *left)
        if history is not None and _same(history, now) and turn > 2:
            break
    assert now is not None
    now = _both_or_neither(now, a, b, evidence, fixed)
    now = with_outlines(now, a, b, costs)
    pairs = tuple(
        Role(int(i), int(j), float(cost), fixed.get((int(i), int(j)), "matched"))
        for i, j, cost in zip(now.first, now.second, now.costs, strict=True)
    )
    disappearing = sorted(set(range(count[0])) - {p.first for p in pairs})
    appearing = sorted(set(range(count[1])) - {p.second for p in pairs})
    missing = costs - left[0][:, None] - left[1]
    return Roles(
        pairs,
        tuple(disappearing),
        tuple(appearing),
        tuple(missing[k].min(initial=np.inf) for k in disappearing),
        tuple(missing[:, k].min(initial=np.inf) for k in appearing),
    )


def _both_or_neither(
    now: Current, a: Scene, b: Scene, evidence: Evidence, fixed: dict[tuple[int, int], str]
) -> Current:
    """The pairs without those whose mate on either side is left alone.

    Lines may have other reasons, and what stays the same thing may lose its mate.
    """
    made = [np.zeros(len(scene.items), dtype=bool) for scene in (a, b)]
    made[0][now.first] = made[1][now.second] = True
    kept = np.ones(len(now.first), dtype=bool)
    same = same_things(a, b)[now.first, now.second] > 0
    for scene, own, done, features in zip(
        (a, b), (now.first, now.second), made, evidence.features, strict=True
    ):
        filled = np.array([item.filled for item in scene.items])
        twins = [features.twins, *(axis.mates for axis in scene.axes if axis.flips == 0)]
        for mates in twins:
            other = mates[own]
            kept &= same | (other < 0) | (other == own) | done[other] | ~filled[own]
    for k, pair in enumerate(zip(now.first.tolist(), now.second.tolist(), strict=True)):
        kept[k] |= pair in fixed
    return Current(now.first[kept], now.second[kept], now.costs[kept])


def _all_in_order(a: Scene, b: Scene, ordered: Ordered, never: Mask) -> list[tuple[int, int]]:
    """Pairs of two drawings that are one set each, of as many members."""
    for first, second in ordered:
        if len(first) == (~a.sheets).sum() and len(second) == (~b.sheets).sum():
            pairs = zip(first.tolist(), second.tolist(), strict=True)
            return [(i, j) for i, j in pairs if not never[i, j]]
    return []


def _same(one: Current, other: Current) -> bool:
    return np.array_equal(one.first, other.first) and np.array_equal(one.second, other.second)


def _cheapest(costs: Floats, left: Floats, right: Floats) -> Current:
    """Pairs of least total cost; each item may be left alone at its price."""
    rank = np.abs(
        np.arange(len(costs))[:, None] / len(costs) - np.arange(len(costs[0])) / len(costs[0])
    )
    # To leave both alone costs nothing here: all that pairs save is below it.
    saved = (
        np.round(costs, DECIMALS) - np.round(left, DECIMALS)[:, None] - np.round(right, DECIMALS)
    )
    saved = np.minimum(saved + TIE * rank, 0.0)
    rows, columns = cheapest_pairs(saved)
    made = saved[rows, columns] < 0
    rows, columns = rows[made], columns[made]
    return Current(rows, columns, costs[rows, columns])


def alike_in_place(
    a: Scene,
    b: Scene,
    never: Mask,
    fixed: dict[tuple[int, int], str],
    loose: float = 1.0,
) -> list[tuple[int, int]]:
    """Pairs that are the same in both drawings, place and form and paint, or nearly (`loose`)."""
    away = np.linalg.norm(a.centres[:, None] - b.centres, axis=-1)
    scale = (a.scale + b.scale) / 2
    near = (away < loose * SAME_PLACE * scale) & ~never
    near &= np.abs(np.log(a.sizes[:, None] / b.sizes)) < loose * SAME_SIZE
    near &= colours_apart(a.colours, b.colours) < SAME_COLOUR
    kinds = [np.array([(i.filled, i.closed) for i in s.items]) for s in (a, b)]
    near &= (kinds[0][:, None] == kinds[1]).all(axis=-1)
    taken = {i for i, _ in fixed}, {j for _, j in fixed}
    found: list[tuple[float, int, int]] = []
    for i, j in np.argwhere(near).tolist():
        if i in taken[0] or j in taken[1]:
            continue
        one, other = a.items[i], b.items[j]
        apart = _outlines_apart(one.points, other.points)
        if apart < loose * SAME_OUTLINE * max(one.extent, other.extent):
            order = abs(i / len(a.items) - j / len(b.items))
            found.append((round(apart / scale, DECIMALS) + TIE * order, i, j))
    pairs: list[tuple[int, int]] = []
    for _, i, j in sorted(found):
        if i not in taken[0] and j not in taken[1]:
            pairs.append((i, j))
            taken[0].add(i)
            taken[1].add(j)
    return pairs


def _nearly_same(a: Scene, b: Scene) -> Mask:
    """Which pairs hardly move or change: gleams are taken for outlines at one time or another."""
    away = np.linalg.norm(a.centres[:, None] - b.centres, axis=-1)
    near = away < HARDLY * np.minimum(a.sizes[:, None], b.sizes)
    near &= np.abs(np.log(a.sizes[:, None] / b.sizes)) < HARDLY
    near &= colours_apart(a.colours, b.colours) < SAME_COLOUR
    return np.asarray(near)


def _outlines_apart(one: Floats, other: Floats) -> float:
    """Greatest distance of a sample of either outline from the nearest one of the other."""
    apart = np.linalg.norm(one[:, None] - other, axis=-1)
    spacing = np.linalg.norm(one[1] - one[0]) / 2
    return max(0.0, float(max(apart.min(axis=0).max(), apart.min(axis=1).max()) - spacing))
