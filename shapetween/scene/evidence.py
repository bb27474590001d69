"""What is seen in two drawings that tells who becomes whom: colours, names, sets, features."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from shapetween.base.arrays import Floats, Mask
from shapetween.fill.naming import is_given
from shapetween.scene.faces import features_of_both
from shapetween.scene.features import Feature, Features
from shapetween.scene.relations import Scene, colours_apart
from shapetween.scene.sets import REPEATED, Ordered, Sets, paired_sets, sets_of

__all__ = [
    "Evidence",
    "features_cost",
    "mouths_saving",
    "named_saving",
    "sets_cost",
    "sole_saving",
    "twins_cost",
    "unique_saving",
]

#: What a pair saves that is of a colour which both drawings have once, and of a name that both
#: have.
UNIQUE, NAMED = 1.1, 0.4

#: What a pair saves of which each is the only thing of its kind and colour in what it lies in.
SOLE = 0.6

#: What it saves where nearly all of several colours are in both drawings once, and how many at
#: least.
PALETTE, SEVERAL = 3.0, 3

#: What it saves to be one feature of a face or vehicle in both drawings, what it costs to be two
#: that contradict each other or lie on other sides, and to be one in one drawing only.
FEATURE, CONTRARY, STRANGE = 0.8, 2.0, 0.5

#: What more it saves to be the only mouth of both drawings, and up to which sum of differences of
#: colours. Smaller, and a mouth goes for one aside to come; larger, and a tongue becomes lips.
ONLY_MOUTH, ONE_INK = 0.6, 0.2

#: What it saves that both are their drawing's body, and what it costs that just one is.
BODY, NO_BODY = 0.5, 0.15

#: What it costs to leave the order of two sets, less for those in order; and to be one of a
#: pattern in one drawing only.
ORDER, PATTERN = 0.6, 0.7


@dataclass(frozen=True, slots=True, eq=False)
class Evidence:
    """What is seen in two drawings that tells who becomes whom.

    Attributes
    ----------
    repeated : (Sets, Sets)
        What either repeats.
    ordered : list of ((K,) intp, (K,) intp)
        Sets of them that become each other.
    features : (Features, Features)
        What the parts are.
    """

    repeated: tuple[Sets, Sets]
    ordered: Ordered
    features: tuple[Features, Features]

    @classmethod
    def of(cls, a: Scene, b: Scene) -> "Evidence":
        """Look at two scenes."""
        repeated = sets_of(a), sets_of(b)
        return cls(repeated, paired_sets(a, b, repeated), features_of_both(a, b))


def sole_saving(a: Scene, b: Scene) -> Floats:
    """Which pairs are each the only thing of one kind and colour in what they lie in."""
    keys = []
    for scene in (a, b):
        rows = [
            (int(parent), item.filled, item.closed, *np.round(item.colour, 2).tolist())
            for parent, item in zip(scene.parents, scene.items, strict=True)
        ]
        counts = Counter(rows)
        keys.append([row[1:] if counts[row] == 1 and row[0] >= 0 else None for row in rows])
    return SOLE * _equal(*keys)


def unique_saving(a: Scene, b: Scene) -> Floats:
    """Which pairs have a colour that both drawings have just once, of several."""
    keys = [[tuple(np.round(i.colour, 3).tolist()) for i in s.items] for s in (a, b)]
    counts = [Counter(side) for side in keys]
    once = {k for k in counts[0] if counts[0][k] == 1 and counts[1][k] == 1}
    if min(len(count) for count in counts) < 2:
        once = set()
    # A whole palette in common is no chance.
    whole = len(once) >= SEVERAL and len(once) >= 0.8 * max(len(a.items), len(b.items))
    alike = _equal(*([key if key in once else None for key in side] for side in keys))
    return np.asarray(alike * (PALETTE if whole else UNIQUE))


def named_saving(a: Scene, b: Scene) -> Floats:
    """Which pairs have one name that an editor gave."""
    keys = [[i.name if i.name and not is_given(i.name) else None for i in s.items] for s in (a, b)]
    return NAMED * _equal(*keys)


def _equal(ours: Sequence[object], theirs: Sequence[object]) -> Floats:
    """1 where two of some keys are one, None never, (N, M)."""
    numbers: dict[object, int] = {}
    first = np.array([-1 if key is None else numbers.setdefault(key, len(numbers)) for key in ours])
    second = np.array([-2 if key is None else numbers.get(key, -2) for key in theirs])
    return np.asarray(first[:, None] == second, dtype=np.float64)


def features_cost(one: Features, other: Features) -> tuple[Floats, Mask]:
    """What it costs to be another feature or another side's, and which pairs are one feature."""
    both = (one.kinds != 0)[:, None] & (other.kinds != 0)
    shared = (one.kinds[:, None] & other.kinds) != 0
    across = one.sides[:, None] * other.sides < 0
    cost = CONTRARY * (both & (~shared | across)) - FEATURE * (shared & ~across)
    cost = cost + STRANGE * ((one.kinds != 0)[:, None] != (other.kinds != 0))
    bodies = (
        (np.arange(len(one.kinds)) == one.body)[:, None],
        np.arange(len(other.kinds)) == other.body,
    )
    cost = cost + NO_BODY * (bodies[0] != bodies[1])
    cost = np.where(bodies[0] & bodies[1], -BODY, cost)
    return np.asarray(cost), np.asarray(shared & ~across)


def mouths_saving(a: Scene, b: Scene, evidence: Evidence) -> Floats:
    """Which pair is the only mouth of both drawings, in one colour."""
    one, other = ((own.kinds & Feature.MOUTH) > 0 for own in evidence.features)
    same = np.outer(one, other) & (one.sum() == other.sum() == 1)
    same &= colours_apart(a.colours, b.colours) < ONE_INK
    return np.where(same, ONLY_MOUTH, 0.0)


def sets_cost(evidence: Evidence) -> Floats:
    """What it costs to leave a set's order, or to become one of a pattern without being one."""
    pattern = [own.counts >= REPEATED for own in evidence.repeated]
    cost = PATTERN * (pattern[0][:, None] != pattern[1])
    for first, second in evidence.ordered:
        cost[np.ix_(first, second)] += ORDER
        cost[first, second] -= 2 * ORDER
    return np.asarray(cost)


def twins_cost(costs: Floats, evidence: Evidence) -> Floats:
    """The costs with two features going to two, both or neither."""
    one, other = evidence.features
    has = (one.twins >= 0)[:, None] & (other.twins >= 0)
    has &= ((one.kinds[:, None] & other.kinds) != 0) & (one.sides[:, None] == other.sides)
    mean = (costs + costs[one.twins][:, other.twins]) / 2
    return np.where(has, mean, costs)
