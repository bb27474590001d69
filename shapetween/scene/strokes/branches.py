"""Runs of a medial axis put together into lines: straight on at crossings, round corners."""

from dataclasses import dataclass
from itertools import combinations, pairwise

import numpy as np

from shapetween.base.arrays import Mask, Points
from shapetween.geometry.polygon import cross
from shapetween.scene.strokes.axis_fit import end_motion
from shapetween.scene.strokes.medial_axis import Chain, MedialAxis

__all__ = ["Limb", "limbs_of"]

#: Length, as a multiple of half the width, below which a run of even width says nothing: the
#: axis of a box has such runs between its corners.
SHORTEST = 0.35

#: Length, as a multiple of half the width, by which the axis bends before its radius differs by
#: what is still even: beside a corner it is a parabola, which rises by its square over four.
BENDING = 0.45

#: Length next to an end, as a multiple of half the width, that its direction is taken from.
REACH = 1.5

#: Greatest turn, radians, beyond that which the runs' own bending leads to, at which one run goes
#: on as the other: within a run, where a bump is no corner, and at a crossing.
BUMP, STRAIGHT_ON = np.deg2rad(12.0), np.deg2rad(28.0)

#: Greatest turn, radians, of a corner where three lines or more meet. Sharper ones are where a
#: line ends on another.
SHARPEST = np.deg2rad(135.0)

#: Difference of two turns, radians, below which they are alike: an arrow's shaft is as near to one
#: arm as to the other, and belongs to neither.
ALIKE = np.deg2rad(4.0)

#: Free tail of the axis, as a multiple of half the width, up to which a line still has its width.
LONGEST_TAIL = 1.3

End = tuple[int, int]
"""A branch, and 0 for its start or -1 for its end."""


@dataclass(frozen=True, slots=True, eq=False)
class Limb:
    """A line as runs of points.

    Attributes
    ----------
    runs : tuple of (N, 2) float64
    corners : tuple of bool
        Whether the line turns sharply after each run; the last says so of a ring's start.
    closed : bool
    meets : (int, int)
        Where it starts and ends: a number of a crossing, or -1 for a free end.
    """

    runs: tuple[Points, ...]
    corners: tuple[bool, ...]
    closed: bool
    meets: tuple[int, int]


@dataclass(frozen=True, slots=True, eq=False)
class _Branch:
    runs: tuple[Points, ...]
    meets: tuple[int, int]


def limbs_of(axis: MedialAxis, half: float, even: float) -> tuple[Limb, ...] | None:
    """Lines that the axis' runs of one width make up.

    Parameters
    ----------
    axis : MedialAxis
    half : float
        Half of that width.
    even : float
        How far the radius may be from it.

    Returns
    -------
    tuple of Limb, or None
        None if the region tapers towards an end.
    """
    runs = [_even_runs(chain, half, even, axis.degrees) for chain in axis.chains]
    crossing = _crossings(axis, runs)
    branches, limbs = [], []
    for chain, found in zip(axis.chains, runs, strict=True):
        ends = [-1 if axis.degrees.get(node) == 1 else crossing[node] for node in chain.ends]
        if not found:
            continue
        for k, end in enumerate(ends):
            tail = found[0][0] - chain.points[0] if k == 0 else found[-1][-1] - chain.points[-1]
            if end == -1 and np.hypot(*tail) > LONGEST_TAIL * half:
                return None
        if chain.ends[0] not in axis.degrees:
            limbs.append(_ring(found, half))
        else:
            branches.append(_Branch(tuple(found), (ends[0], ends[1])))
    follows = _joined(branches, half)
    limbs += _traced(branches, follows, half)
    return tuple(limbs)


def _even_runs(chain: Chain, half: float, even: float, degrees: dict[int, int]) -> list[Points]:
    """Runs of a chain's points whose radius is about half the width."""
    good: Mask = np.abs(chain.radii - half) <= even
    points = chain.points
    if good.all():
        found = [points]
    else:
        if chain.ends[0] == chain.ends[1] and good[0] and (points[0] == points[-1]).all():
            # A ring starts where it is uneven, so that no run is cut in two.
            turn = int(np.flatnonzero(~good)[0])
            points = np.concatenate([points[turn:-1], points[: turn + 1]])
            good = np.concatenate([good[turn:-1], good[: turn + 1]])
        edges = np.flatnonzero(np.diff(np.concatenate([[0], good.astype(np.int8), [0]])))
        found = [points[a:b] for a, b in edges.reshape(-1, 2)]
    found = [r for r in found if len(r) > 1 and _length(r) >= SHORTEST * half]
    if good.all() and chain.ends[0] not in degrees:
        return found
    free = [degrees.get(node) == 1 for node in chain.ends]
    return [
        _trimmed(run, half, not (free[0] and k == 0), not (free[1] and k == len(found) - 1))
        for k, run in enumerate(found)
    ]


def _trimmed(points: Points, half: float, head: bool, tail: bool) -> Points:
    """A run without what bends towards a corner or crossing at its ends, if it is long enough."""
    cut = BENDING * half
    along = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))])
    if along[-1] < 3 * cut:
        return points
    low = cut if head else 0.0
    high = along[-1] - (cut if tail else 0.0)
    kept = points[(along >= low) & (along <= high)]
    return kept if len(kept) > 2 else points


def _length(points: Points) -> float:
    return float(np.hypot(*np.diff(points, axis=0).T).sum())


def _crossings(axis: MedialAxis, runs: list[list[Points]]) -> dict[int, int]:
    """The crossing that each node belongs to: chains that hold no run join theirs."""
    first = {node: node for chain in axis.chains for node in chain.ends}

    def root(node: int) -> int:
        while first[node] != node:
            node = first[node]
        return node

    for chain, found in zip(axis.chains, runs, strict=True):
        if not found:
            a, b = sorted(root(node) for node in chain.ends)
            first[b] = a
    return {node: root(node) for node in first}


def _turn(one: Points, other: Points) -> float:
    return float(np.arctan2(cross(one, other), one @ other))


def _going_on(before: Points, after: Points, half: float) -> tuple[float, float]:
    """Turn from one run's end to another's start, and by how much that is not a smooth one."""
    leaving, bend = end_motion(before, REACH * half, -1)
    onward, other_bend = end_motion(after, REACH * half, 0)
    gap = after[0] - before[-1]
    turn = _turn(leaving, onward)
    length = float(np.hypot(*gap))
    if length < 1e-9 * half:
        return turn, abs(turn)
    expected = (bend + other_bend) / 2 * length
    expected = float(np.clip(expected, -1.2, 1.2))
    aside = abs(_turn(leaving, gap) - turn / 2)
    return turn, max(min(abs(turn - expected), abs(turn)), aside)


def _ring(runs: list[Points], half: float) -> Limb:
    if len(runs) == 1 and (runs[0][0] == runs[0][-1]).all():
        return Limb((runs[0][:-1],), (False,), True, (-1, -1))
    corners = [
        _going_on(run, runs[(k + 1) % len(runs)], half)[1] > BUMP for k, run in enumerate(runs)
    ]
    return Limb(tuple(runs), tuple(corners), True, (-1, -1))


def _joined(branches: list[_Branch], half: float) -> dict[End, tuple[End, bool]]:
    """Which branch's end goes on as which other's, and whether in a corner."""
    meeting: dict[int, list[End]] = {}
    for k, branch in enumerate(branches):
        for end in (0, -1):
            if branch.meets[end] >= 0:
                meeting.setdefault(branch.meets[end], []).append((k, end))
    follows: dict[End, tuple[End, bool]] = {}

    def outward(end: End) -> Points:
        run = branches[end[0]].runs[end[1]]
        return run if end[1] == -1 else run[::-1]

    for ends in meeting.values():
        costs = {}
        for one, other in combinations(ends, 2):
            if one != other:
                costs[one, other] = _going_on(outward(one), outward(other)[::-1], half)
        for pair in sorted(costs, key=lambda pair: (round(costs[pair][1], 2), pair)):
            free = pair[0] not in follows and pair[1] not in follows
            if free and costs[pair][1] < STRAIGHT_ON:
                _link(follows, pair, corner=False)
        through = any(end in follows for end in ends)
        rest = [end for end in ends if end not in follows]
        if len(ends) == 2 and len(rest) == 2:
            _link(follows, (rest[0], rest[1]), corner=True)
        elif not through and len(rest) >= 2:
            bent = _corner({p: abs(turn) for p, (turn, _) in costs.items()})
            if bent is not None:
                _link(follows, bent, corner=True)
    return follows


def _corner(turns: dict[tuple[End, End], float]) -> tuple[End, End] | None:
    """The two ends at a crossing that are most likely one line with a corner."""
    fair = {pair: turn for pair, turn in turns.items() if turn < SHARPEST}
    if not fair:
        return None
    order = sorted(fair, key=lambda pair: (round(fair[pair], 2), pair))
    best = order[0]
    if len(order) > 1 and fair[order[1]] - fair[best] < ALIKE:
        shared = set(best) & set(order[1])
        apart = tuple(sorted(set(best) ^ set(order[1])))
        if len(shared) == 1 and (apart[0], apart[1]) in fair:
            return apart[0], apart[1]
    return best


def _link(follows: dict[End, tuple[End, bool]], pair: tuple[End, End], *, corner: bool) -> None:
    one, other = pair
    follows[one], follows[other] = (other, corner), (one, corner)


def _traced(
    branches: list[_Branch], follows: dict[End, tuple[End, bool]], half: float
) -> list[Limb]:
    """Branches that go on as each other, from one end to the other."""
    used = [False] * len(branches)
    starts = [(k, e) for k in range(len(branches)) for e in (0, -1) if (k, e) not in follows]
    starts += [(k, 0) for k in range(len(branches))]
    limbs = []
    for first in starts:
        if used[first[0]]:
            continue
        runs: list[Points] = []
        corners: list[bool] = []
        at, closed = first, False
        while True:
            k, end = at
            used[k] = True
            own = branches[k].runs if end == 0 else [r[::-1] for r in branches[k].runs[::-1]]
            for one, other in pairwise(own):
                corners.append(_going_on(one, other, half)[1] > BUMP)
            runs += own
            far: End = (k, -1 if end == 0 else 0)
            onward = follows.get(far)
            if onward is None:
                corners.append(False)
                break
            corners.append(onward[1])
            at = onward[0]
            if at == first:
                closed = True
                break
            if used[at[0]]:
                break
        meets = (
            (-1, -1) if closed else (branches[first[0]].meets[first[1]], branches[k].meets[far[1]])
        )
        limbs.append(Limb(tuple(runs), tuple(corners), closed, meets))
    return limbs
