"""Knots of two outlines by their corners: which corners become which, which come and go.

Between corners that become each other both outlines go evenly, so that straight runs stay straight
and round ones round: what follows every small likeness of two outlines wobbles on the way.
"""

from dataclasses import dataclass, replace

import numpy as np

from shapetween.base.arrays import Floats, Index, Points
from shapetween.scene.motion.bends import Bends, bends_of
from shapetween.scene.places import SAME, Places

__all__ = ["along_knots", "half_knots", "ring_knots"]

#: What a place's shift costs beside the turn of its direction.
SHIFT = 0.8

#: What a run costs that goes to nothing, beside one of its length that turns by a right angle.
STRETCH = 0.3

#: What half a turn of a corner costs that comes from nothing in plain sight, and what it costs to
#: differ by so much from what it becomes. Less, and corners melt into sides; more, and corners
#: that have nothing to do with each other become each other.
ALONE, UNLIKE = 0.12, 0.08

#: What a corner costs that points the other way.
AWAY = 0.04

#: Places at which two runs are compared, and cells in which an outline's directions are kept.
SAMPLES, CELLS = 10, 512

#: Distance of a corner from the end of a part, as a share of the length, that is that end.
AT = 1e-3

#: Most pairs of runs that are compared: more take more time than an icon has.
MOST_RUNS = 40_000

#: Pairs of corners at which the way round two rings may begin, and shifts of smooth ones.
STARTS, SHIFTS = 10, 96


@dataclass(frozen=True, slots=True, eq=False)
class _Look:
    """Directions and places along an outline, in its own box."""

    ways: Points
    points: Points

    @classmethod
    def of(cls, places: Places) -> "_Look":
        cells = np.arange(CELLS + 1) / CELLS
        points = places.point(cells)
        if places.outline.closed:
            points[-1] = points[0]
        ahead = np.diff(points, axis=0)
        size = np.hypot(ahead[:, 0], ahead[:, 1])
        ways = ahead / np.where(size > 0, size, 1.0)[:, None]
        low, high = points.min(axis=0), points.max(axis=0)
        box = np.maximum(high - low, 0.25 * float((high - low).max()) or 1.0)
        return cls(ways, (points - (low + high) / 2) / box)

    def at(self, shares: Floats) -> tuple[Points, Points]:
        """Directions and places at shares, past a whole turn too."""
        cell = np.floor(shares * CELLS).astype(np.intp)
        return self.ways[cell % CELLS], self.points[cell % CELLS]


@dataclass(frozen=True, slots=True, eq=False)
class _Run:
    """An outline's corners from one place to another, as nodes of a way through them.

    Attributes
    ----------
    look : _Look
    starts, ends : (N,) float64
        Of each node, increasing.
    turns, seen : (N,) float64
    facing : (N,) intp
    length : float
        Of all of it, as a share of the outline's.
    ring : bool
        Whether the first node comes again after the last one.
    line : bool
        Whether it has no inside, so that a corner may turn over.
    """

    look: _Look
    starts: Floats
    ends: Floats
    turns: Floats
    seen: Floats
    facing: Index
    length: float
    ring: bool
    line: bool = False

    @classmethod
    def part(
        cls, look: _Look, bends: Bends, low: float, high: float, *, line: bool = False
    ) -> "_Run":
        """The part between two places, which are its first and last node."""
        half = (bends.ends - bends.starts) / 2
        middles = low + (bends.middles - low) % 1.0
        # A corner on or beside either end of the part is that end, and reaches into the part.
        inner = (middles > low) & (middles < high)
        reach, turns = [], []
        for end in (low, high):
            away = np.abs((bends.middles - end + 0.5) % 1.0 - 0.5)
            at = away < half + AT
            reach.append(float((half + away)[at & (half > 0)].max(initial=0.0)))
            turns.append(float(bends.turns[at].sum()))
            inner &= ~at
        reach = np.minimum(reach, (high - low) / 3).tolist()
        order = np.argsort(middles[inner], kind="stable")
        starts, ends = (
            np.clip((middles + side * half)[inner][order], low, high) for side in (-1, 1)
        )
        return cls(
            look,
            np.concatenate([[low], starts, [high - reach[1]]]),
            np.concatenate([[low + reach[0]], ends, [high]]),
            np.concatenate([turns[:1], bends.turns[inner][order], turns[1:]]),
            np.concatenate([[0.0], bends.seen[inner][order], [0.0]]),
            np.concatenate([[-1], bends.facing[inner][order], [-1]]),
            high - low,
            ring=False,
            line=line,
        )

    def node(self, index: Index) -> tuple[Index, Floats]:
        """Nodes at places in the way round, and how many whole turns those are on."""
        count = len(self.starts)
        if not self.ring:
            return np.clip(index, 0, count - 1), np.zeros(index.shape)
        return index % count, np.floor_divide(index, count).astype(np.float64)

    def runs(self, most: int) -> tuple[Floats, Floats, Floats]:
        """Starts, lengths and what is left out of the runs that reach each node, (N, most + 1)."""
        count = len(self.starts)
        to = np.arange(count)[:, None]
        since, turns = self.node(to - np.arange(most + 1))
        begin = self.ends[since] + turns
        length = self.starts[:, None] - begin
        length[:, 0] = 0.0
        begin[:, 0] = self.starts
        sums = np.concatenate([[0.0], np.cumsum(self.seen)])
        before = sums[to] - sums[since + 1] - turns * sums[-1]
        before[:, 0] = 0.0
        if not self.ring:
            length = np.where(to >= np.arange(most + 1), length, np.nan)
        return begin, length, np.maximum(before, 0.0)


def along_knots(
    source: Places, target: Places, *, mirrored: bool = False
) -> tuple[Floats, Floats, float]:
    """Knots of two open lines run in one direction, and what they cost.

    Parameters
    ----------
    source, target : Places
        Open.
    mirrored : bool
        Whether both are their own mirror images, so that the knots have to be.
    """
    end = 0.5 if mirrored else 1.0
    runs = [
        _Run.part(_Look.of(places), bends_of(places), 0.0, end, line=True)
        for places in (source, target)
    ]
    u, v, cost = _through(runs[0], runs[1])
    if mirrored:
        u, v = (np.concatenate([knots, 1 - knots[-2::-1]]) for knots in (u, v))
    return u, v, cost


def half_knots(
    source: Places, target: Places, first: tuple[float, float], second: tuple[float, float]
) -> tuple[Floats, Floats]:
    """Knots of two rings that are their own mirror images, themselves mirror images.

    Parameters
    ----------
    source, target : Places
        Closed, both clockwise.
    first, second : (float, float)
        Shares at which each crosses its axis, where one half begins and where it ends.
    """
    ends = (first, second)
    runs = [
        _Run.part(_Look.of(places), bends_of(places), low, high)
        for places, (low, high) in zip((source, target), ends, strict=True)
    ]
    u, v, _ = _through(runs[0], runs[1])
    halves = []
    for knots, (low, high) in zip((u, v), ends, strict=True):
        # The other half, run the other way: its length is what is left of the turn.
        back = high + (1 - (high - low)) * (high - knots[::-1]) / (high - low)
        halves.append(np.concatenate([knots, back[1:]]))
    return halves[0], halves[1]


def ring_knots(source: Places, target: Places) -> tuple[Floats, Floats]:
    """Knots of two closed outlines, both clockwise, of which neither turns."""
    looks = _Look.of(source), _Look.of(target)
    bends = bends_of(source), bends_of(target)
    shift, plain = _shifted(*looks)
    plain += ALONE * float(sum(side.seen.sum() for side in bends)) / 2
    even = np.array([0.0, 1.0])
    if min(len(side) for side in bends) == 0:
        return even, even + shift
    first, second = (
        _Run(look, side.starts, side.ends, side.turns, side.seen, side.facing, 1.0, ring=True)
        for look, side in zip(looks, bends, strict=True)
    )
    u, v, cost = _through(first, second)
    return (u, v) if cost < plain - 1e-6 else (even, even + shift)


def _shifted(first: _Look, second: _Look) -> tuple[float, float]:
    """The shift of a ring by which another is most like it, and what is left of the difference."""
    steps = np.arange(SHIFTS) / SHIFTS
    (ways, points), (others, there) = first.at(steps), second.at(steps)
    turned = (np.arange(SHIFTS)[:, None] + np.arange(SHIFTS)) % SHIFTS
    costs = 1 - (ways * others[turned]).sum(axis=-1)
    costs += SHIFT * np.linalg.norm(points - there[turned], axis=-1)
    mean = np.round(costs.mean(axis=1), 6)
    best = int(mean.argmin())
    return best / SHIFTS, float(mean[best])


def _through(first: _Run, second: _Run) -> tuple[Floats, Floats, float]:
    """The cheapest way through the corners of both, as knots, and what it costs."""
    if not first.ring:
        first, second = _with_tips(first, second), _with_tips(second, first)
        for k in (0, -1):
            # The tip of a star does not grow out of the notch of a heart, nor a corner of a side.
            if first.turns[k] * second.turns[k] <= 0:
                _plain_end(first, k)
                _plain_end(second, k)
    match = _matches(first, second)
    runs = _run_costs(first, second)
    starts = np.zeros((1, 2), dtype=np.intp)
    if first.ring:
        flat = np.round(match - ALONE * (first.seen[:, None] + second.seen) / 2, 9)
        flat[~np.isfinite(match)] = np.inf
        some = np.argsort(flat, axis=None, kind="stable")[:STARTS]
        some = some[np.isfinite(flat.ravel()[some])]
        if not len(some):
            return np.array([0.0, 1.0]), np.array([0.0, 1.0]), np.inf
        starts = np.stack(np.unravel_index(some, flat.shape), axis=1)
    pairs, cost = _cheapest(match, runs, starts, first.ring)
    knots = []
    for side, run in enumerate((first, second)):
        node, turns = run.node(pairs[:, side])
        knots.append(np.stack([run.starts[node] + turns, run.ends[node] + turns], axis=1).ravel())
    both = np.maximum.accumulate(np.array(knots), axis=1)
    if first.ring:
        # The last corner is the first one again: it begins where that did.
        both = both[:, :-1]
        both[:, -1] = both[:, 0] + 1.0
    # Knots that are one but for rounding are one.
    both = both[:, np.append(True, (np.diff(both, axis=1) > SAME).any(axis=0))]
    return both[0], both[1], cost


def _with_tips(run: _Run, other: _Run) -> _Run:
    """A part with the corner that is its end as a node of its own, where the other's end is none.

    So the tip of a triangle, which lies on its axis, becomes both corners of a bar.
    """
    for k, beside, at in ((0, 1, 1), (-1, -2, len(run.starts) - 1)):
        corner = len(other.starts) > 2 and run.turns[k] * other.turns[beside] > 0
        if not corner or other.turns[k] != 0:
            continue
        place = run.starts[0] if k == 0 else run.ends[-1]
        starts, ends = np.array(run.starts), np.array(run.ends)
        turns = np.insert(run.turns, at, run.turns[k] / 2)
        turns[k], starts[k], ends[k] = 0.0, place, place
        run = replace(
            run,
            starts=np.insert(starts, at, run.starts[k]),
            ends=np.insert(ends, at, run.ends[k]),
            turns=turns,
            seen=np.insert(run.seen, at, 0.0),
            facing=np.insert(run.facing, at, -1),
        )
    return run


def _plain_end(run: _Run, k: int) -> None:
    """Take a part's end for a mere place, whatever corner lies there."""
    ends, starts = (run.ends, run.starts) if k == 0 else (run.starts, run.ends)
    ends[k] = starts[k]


def _matches(first: _Run, second: _Run) -> Floats:
    """What it costs that a corner becomes another, (N, M); infinite of an area's bay and cape."""
    looks = [run.look.at((run.starts + run.ends) / 2) for run in (first, second)]
    ways = []
    for run in (first, second):
        before, _ = run.look.at(run.starts - 0.5 / CELLS)
        after, _ = run.look.at(run.ends + 0.5 / CELLS)
        middle = before + after
        size = np.hypot(middle[:, 0], middle[:, 1])
        ways.append(middle / np.where(size > 1e-6, size, np.inf)[:, None])
    turn = first.turns[:, None] - second.turns
    away = np.linalg.norm(looks[0][1][:, None] - looks[1][1], axis=-1)
    cost = UNLIKE * np.abs(turn) / np.pi
    cost = cost + AWAY * (1 - ways[0] @ ways[1].T) + AWAY * SHIFT * away
    if not first.line:
        cost[first.turns[:, None] * second.turns < 0] = np.inf
    cost[first.facing[:, None] != second.facing] = np.inf
    if not first.ring:
        cost[[0, -1]], cost[:, [0, -1]] = np.inf, np.inf
        cost[0, 0] = cost[-1, -1] = 0.0
    return np.asarray(cost)


def _run_costs(first: _Run, second: _Run) -> Floats:
    """What it costs that runs become each other, (N, M, K + 1, L + 1), by the nodes they reach.

    The last two say how many nodes before that each run begins.
    """
    counts = [len(run.starts) - (not run.ring) for run in (first, second)]
    most = list(counts)
    while len(first.starts) * len(second.starts) * (most[0] + 1) * (most[1] + 1) > MOST_RUNS:
        most[int(most[1] > most[0])] -= 1
    (begin_a, long_a, lost_a), (begin_b, long_b, lost_b) = (
        run.runs(n) for run, n in zip((first, second), most, strict=True)
    )
    part = (np.arange(SAMPLES) + 0.5) / SAMPLES
    looks = []
    for run, begin, long in ((first, begin_a, long_a), (second, begin_b, long_b)):
        long = np.where(np.isfinite(long), long, 0.0)
        looks.append(run.look.at(begin[..., None] + long[..., None] * part))
    lengths = [long / run.length for run, long in ((first, long_a), (second, long_b))]
    one, other = lengths[0][:, None, :, None], lengths[1][None, :, None, :]
    (ways, points), (others, there) = looks
    turned = 1 - np.einsum("iasx,jbsx->ijab", ways, others) / SAMPLES
    square = (points**2).sum(-1).mean(-1)[:, None, :, None]
    square = square + (there**2).sum(-1).mean(-1)[None, :, None, :]
    apart = square - 2 * np.einsum("iasx,jbsx->ijab", points, there) / SAMPLES
    shift = np.sqrt(np.maximum(apart, 0.0))
    both = (one + other) / 2
    # What goes to nothing has no direction to turn from.
    turned = np.where((one > 0) & (other > 0), turned, 0.0)
    cost = both * (turned + SHIFT * shift)
    cost += STRETCH * (one - other) ** 2 / np.maximum(one + other, 1e-12)
    cost += ALONE * (lost_a[:, None, :, None] + lost_b[None, :, None, :])
    cost[:, :, 0, 0] = np.inf
    # A corner becomes two, or two become one; more would be a side that goes to nothing.
    cost[:, :, 0, 2:], cost[:, :, 2:, 0] = np.inf, np.inf
    return np.asarray(np.where(np.isfinite(cost), cost, np.inf))


def _cheapest(match: Floats, runs: Floats, starts: Index, ring: bool) -> tuple[Index, float]:
    """Pairs of nodes in turn, (P, 2), from one of some pairs round to it again; and the cost."""
    rows, columns, across, along = runs.shape
    most = (rows, columns) if ring else (rows - 1, columns - 1)
    pad = across - 1, along - 1
    count = len(starts)
    total = np.full((count, most[0] + across, most[1] + along), np.inf)
    came = np.zeros((count, most[0] + 1, most[1] + 1), dtype=np.intp)
    total[:, pad[0], pad[1]] = 0.0
    for i in range(most[0] + 1):
        a = (starts[:, 0] + i) % rows
        for j in range(most[1] + 1):
            if i == j == 0:
                continue
            b = (starts[:, 1] + j) % columns
            window = total[:, i : i + across, j : j + along][:, ::-1, ::-1]
            found = (window + runs[a, b]).reshape(count, -1)
            best = found.argmin(axis=1)
            came[:, i, j] = best
            total[:, i + pad[0], j + pad[1]] = found[np.arange(count), best] + match[a, b]
    ends = np.round(total[:, -1, -1], 9)
    k = int(ends.argmin())
    if not np.isfinite(ends[k]):
        return np.stack([starts[k], starts[k] + most]), np.inf
    i, j = most
    pairs = [(i, j)]
    while (i, j) != (0, 0):
        back, aside = divmod(int(came[k, i, j]), along)
        i, j = i - back, j - aside
        pairs.append((i, j))
    return np.array(pairs[::-1]) + starts[k], float(ends[k])
