"""An area and the line round it are one thing: where one of them goes, the other does."""

import numpy as np

from shapetween.base.arrays import Floats
from shapetween.scene.costs import Current
from shapetween.scene.relations import Scene

__all__ = ["with_outlines"]


def with_outlines(now: Current, a: Scene, b: Scene, costs: Floats) -> Current:
    """The pairs, and those of areas whose outlines are pairs, and the other way round.

    Parameters
    ----------
    now : Current
    a, b : Scene
    costs : (N, M) float64
        Infinite of what is never a pair.
    """
    partner = dict(zip(now.first.tolist(), now.second.tolist(), strict=True))
    taken = set(partner.values())

    def join(one: int, other: int) -> None:
        if one not in partner and other not in taken and np.isfinite(costs[one, other]):
            partner[one] = other
            taken.add(other)

    for one, other in list(partner.items()):
        if min(a.outlined[one], b.outlined[other]) >= 0:
            join(int(a.outlined[one]), int(b.outlined[other]))
    for one, other in list(partner.items()):
        lines = np.flatnonzero(a.outlined == one), np.flatnonzero(b.outlined == other)
        if len(lines[0]) == len(lines[1]) == 1:
            first, second = int(lines[0][0]), int(lines[1][0])
            if a.items[first].closed == b.items[second].closed:
                join(first, second)
    firsts = np.array(list(partner), dtype=np.intp)
    seconds = np.array(list(partner.values()), dtype=np.intp)
    return Current(firsts, seconds, costs[firsts, seconds])
