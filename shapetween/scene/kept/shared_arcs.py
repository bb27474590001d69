"""Arcs that the outlines of two areas have in common, drawn of the very same curves."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from shapetween.base.arrays import Curves, Floats, Index, Mask
from shapetween.model.outline import Outline
from shapetween.scene.places import Pieces, Places, cut_alike, run_of

__all__ = ["SharedArc", "Snapped", "snapped"]

#: Even samples of an outline that are looked for on the other area's, besides its joints. Fewer
#: miss short arcs; more cost time with the other outline's length.
SAMPLED = 200

#: Least length of an arc, as a multiple of the distance within which outlines are one. Where
#: outlines only cross they are that near for a little way too.
SHORTEST = 6.0

#: Distance along an outline, as a multiple of the same, within which an arc ends at a joint.
#: Smaller, and outlines that part at an angle of 20 degrees are cut behind the corner.
AT_JOINT = 3.0

#: By how much the lengths of two outlines between samples may differ, as a share, and still be one.
UNEVEN = 0.35


@dataclass(frozen=True, slots=True, eq=False)
class SharedArc:
    """One arc that two rings have in common.

    Attributes
    ----------
    rings : (int, int)
        Of the first area and of the second.
    own, other : (float, float)
        Shares of their lengths, increasing.
    pieces : Pieces
        The curves of both, cut alike.
    """

    rings: tuple[int, int]
    own: tuple[float, float]
    other: tuple[float, float]
    pieces: Pieces


@dataclass(frozen=True, slots=True, eq=False)
class Snapped:
    """Two areas' rings whose common arcs are of the same curves.

    Attributes
    ----------
    first : tuple of Outline
        The first area's rings, cut where arcs begin and end.
    second : tuple of Outline
        The second area's, of the first one's curves along the arcs.
    exact : tuple of Outline
        The second area's as they are drawn, curve by curve as `second`.
    shared : ((N,) float64, (M,) float64)
        Length of the arcs on each ring of either area.
    lengths : ((N,) float64, (M,) float64)
        Of the rings.
    arcs : tuple of SharedArc
    """

    first: tuple[Outline, ...]
    second: tuple[Outline, ...]
    exact: tuple[Outline, ...]
    shared: tuple[Floats, Floats]
    lengths: tuple[Floats, Floats]
    arcs: tuple[SharedArc, ...]

    @property
    def common(self) -> tuple[float, float]:
        """Share of either area's outlines that is common."""
        first, second = (
            float(shared.sum() / max(float(lengths.sum()), 1e-300))
            for shared, lengths in zip(self.shared, self.lengths, strict=True)
        )
        return first, second


def snapped(first: Sequence[Outline], second: Sequence[Outline], reach: float) -> Snapped:
    """Give the second area's rings the first one's curves wherever they run along them.

    Parameters
    ----------
    first, second : sequence of Outline
        Rings that run so that the area lies on one side: outer ones clockwise, holes against.
    reach : float
        Distance within which outlines are one.
    """
    own = [Places(ring) for ring in first]
    others = [Places(ring) for ring in second]
    found = [_arcs_of(k, places, own, reach) for k, places in enumerate(others)]
    found = _apart(found)
    shared = np.zeros(len(own)), np.zeros(len(others))
    for k, row in enumerate(found):
        for arc in row:
            low, high = arc.own
            shared[0][arc.rings[0]] += (high - low) * own[arc.rings[0]].length
            low, high = arc.other
            shared[1][k] += (high - low) * others[k].length
    rings = [
        _assembled(
            places, [(s.own, s.pieces.source) for row in found for s in row if s.rings[0] == k]
        )
        for k, places in enumerate(own)
    ]
    drawn = [
        (
            _assembled(p, [(s.other, s.pieces.source) for s in row]),
            _assembled(p, [(s.other, s.pieces.target) for s in row]),
        )
        for p, row in zip(others, found, strict=True)
    ]
    return Snapped(
        tuple(rings),
        tuple(one for one, _ in drawn),
        tuple(other for _, other in drawn),
        shared,
        (np.array([p.length for p in own]), np.array([p.length for p in others])),
        tuple(arc for row in found for arc in row),
    )


def _arcs_of(which: int, places: Places, own: Sequence[Places], reach: float) -> list[SharedArc]:
    """Where a ring of the second area runs along the first area's rings."""
    shares = [np.arange(SAMPLED) / SAMPLED, places.joints[:-1]]
    for other in own:
        corners = other.point(other.joints[:-1])
        at = places.nearest(corners) % 1.0
        near = np.linalg.norm(places.point(at) - corners, axis=1) <= reach
        shares.append(at[near])
    every = np.unique(np.round(np.concatenate(shares), 9))
    every = every[every < 1.0]
    points = places.point(every)
    at = np.stack([other.nearest(points) for other in own])
    away = np.stack(
        [np.linalg.norm(o.point(a) - points, axis=1) for o, a in zip(own, at, strict=True)]
    )
    ring = away.argmin(axis=0)
    index = np.arange(len(every))
    near = away[ring, index] <= reach
    joint = np.isin(every, np.round(np.concatenate(shares[1:]), 9))
    joint[0] = True
    found = []
    looked = _Run(-1, at[ring, index], every, joint, away[ring, index])
    for run in _runs(places, own, looked, ring, near, reach):
        arc = _arc_of(which, places, own, run, reach)
        if arc is not None:
            found.append(arc)
    return found


@dataclass(frozen=True, slots=True, eq=False)
class _Run:
    """Samples along both outlines.

    Attributes
    ----------
    ring : int
        Of the first area.
    own, other : (N,) float64
        Increasing shares of that ring and of the second area's.
    joint : (N,) bool
        Whether a curve of either starts there.
    away : (N,) float64
        Distance of the outlines.
    """

    ring: int
    own: Floats
    other: Floats
    joint: Mask
    away: Floats

    def trimmed(self, length: float, reach: float) -> "_Run":
        """The run ended where the outlines part, and not where they are too far apart to be one.

        That is at a joint of either, the one nearest to the other outline.
        """
        ends = []
        for end in (0, -1):
            near = self.joint & (np.abs(self.other - self.other[end]) * length <= reach)
            away = np.where(near, np.round(self.away / reach, 3), np.inf)
            found = np.flatnonzero(away == away.min()) if near.any() else np.array([0, -1])
            ends.append(int(found[end]) % len(self.own))
        chosen = slice(ends[0], max(ends[1], ends[0]) + 1)
        return _Run(
            self.ring,
            self.own[chosen],
            self.other[chosen],
            self.joint[chosen],
            self.away[chosen],
        )


def _runs(
    places: Places, own: Sequence[Places], looked: _Run, ring: Index, near: Mask, reach: float
) -> list[_Run]:
    """Samples of a whole ring that follow one another on both outlines."""
    every, at = looked.other, looked.own
    count = len(every)
    after = (np.arange(count) + 1) % count
    ahead = np.where(after == 0, every[after] + 1.0, every[after]) - every
    lengths = np.array([o.length for o in own])
    step = (at[after] - at + 0.5) % 1.0 - 0.5
    way, own_way = ahead * places.length, step * lengths[ring]
    goes_on = near & near[after] & (ring == ring[after]) & (own_way > -reach / 4)
    goes_on &= np.abs(way - own_way) <= UNEVEN * np.maximum(way, own_way) + reach / 2
    whole = bool(goes_on.all())
    breaks = np.array([count - 1]) if whole else np.flatnonzero(~goes_on)
    found = []
    for k, last in enumerate(breaks.tolist()):
        first = int(breaks[k - 1]) + 1
        size = count if whole else (last - first) % count
        if size == 0:
            continue
        chosen = (first + np.arange(size + 1)) % count
        shares, own_shares = (
            start + np.concatenate([[0.0], np.cumsum(steps[chosen[:-1]])])
            for start, steps in ((every[chosen[0]], ahead), (at[chosen[0]], step))
        )
        run = _Run(
            int(ring[chosen[0]]),
            np.maximum.accumulate(own_shares),
            shares,
            looked.joint[chosen],
            looked.away[chosen],
        )
        found.append(run if whole else run.trimmed(places.length, AT_JOINT * reach))
    return found


def _arc_of(
    which: int, places: Places, own: Sequence[Places], run: _Run, reach: float
) -> SharedArc | None:
    """A run as curves cut alike; None of one that is too short."""
    there = own[run.ring]
    whole = run.other[-1] - run.other[0] >= 1.0 - 1e-9
    low, high = (_at_joint(float(run.own[k]), there, reach) for k in (0, -1))
    turn = float(np.floor(low))
    low, high = low - turn, high - turn
    if whole:
        high = low + 1.0
    length = (high - low) * there.length
    if length < SHORTEST * reach or high - low > 1.0 + 1e-9:
        return None
    start, end = float(run.other[0]), float(run.other[-1])
    inner = [Places(run_of(p, *ends)) for p, ends in ((there, (low, high)), (places, (start, end)))]
    u = np.clip((run.own - turn - low) / (high - low), 0.0, 1.0)
    v = (run.other - start) / (end - start)
    knots = _joints_alike(inner[0].joints[1:-1], inner[1].joints[1:-1], u, v, reach / length)
    pieces = cut_alike(inner[0], inner[1], *knots)
    return SharedArc((run.ring, which), (low, high), (start, end), pieces)


def _joints_alike(
    first: Floats, second: Floats, u: Floats, v: Floats, reach: float
) -> tuple[Floats, Floats]:
    """Knots at the joints of two runs that lie on each other, those next to each other as one.

    Parameters
    ----------
    first, second : (K,), (M,) float64
        Joints, as shares of the runs.
    u, v : (N,) float64
        Shares of both at samples.
    reach : float
        Distance within which outlines are one, as a share.
    """
    there = np.interp(first, u, v)
    pairs = list(zip(first.tolist(), there.tolist(), strict=True))
    free = dict(enumerate(pairs))
    for joint, back in zip(second.tolist(), np.interp(second, v, u).tolist(), strict=True):
        near = [k for k, (_, at) in free.items() if abs(at - joint) <= AT_JOINT * reach]
        if near:
            best = min(near, key=lambda k: (round(abs(free[k][1] - joint), 9), k))
            pairs[best] = free.pop(best)[0], joint
        else:
            pairs.append((back, joint))
    knots = [(0.0, 0.0)]
    for pair in sorted(pairs):
        if min(pair[0] - knots[-1][0], pair[1] - knots[-1][1]) > 1e-6 and max(pair) < 1 - 1e-6:
            knots.append(pair)
    knots.append((1.0, 1.0))
    table = np.array(knots)
    return table[:, 0], table[:, 1]


def _at_joint(share: float, places: Places, reach: float) -> float:
    """A share, or the joint's next to it."""
    turn = np.floor(share)
    away = np.abs(share - turn - places.joints)
    best = int(away.argmin())
    return float(places.joints[best] + turn) if away[best] * places.length <= reach else share


def _apart(found: list[list[SharedArc]]) -> list[list[SharedArc]]:
    """Arcs of which no two are on one place of the first area's rings, the longest first."""
    rows: list[list[SharedArc]] = [[] for _ in found]
    taken: list[SharedArc] = []
    order = sorted(
        (
            (round(s.own[0] - s.own[1], 6), k, n)
            for k, row in enumerate(found)
            for n, s in enumerate(row)
        )
    )
    for _, k, n in order:
        arc = found[k][n]
        clear = all(
            other.rings[0] != arc.rings[0]
            or all(
                min(arc.own[1], other.own[1] + turn) - max(arc.own[0], other.own[0] + turn) < 1e-6
                for turn in (-2.0, -1.0, 0.0, 1.0, 2.0)
            )
            for other in taken
        )
        if clear:
            taken.append(arc)
            rows[k].append(arc)
    return rows


def _assembled(places: Places, runs: list[tuple[tuple[float, float], Curves]]) -> Outline:
    """A ring with some of its runs replaced by given curves, which what is between runs to."""
    if not runs:
        return places.outline
    runs = sorted(
        [((low % 1.0, low % 1.0 + high - low), curves) for (low, high), curves in runs],
        key=lambda run: run[0],
    )
    parts: list[Curves] = []
    for k, ((_, end), curves) in enumerate(runs):
        (start, _), following = runs[(k + 1) % len(runs)]
        start += 1.0 if k + 1 == len(runs) else 0.0
        parts.append(curves)
        if start - end > 1e-7:
            low = end % 1.0
            between = run_of(places, low, low + start - end).curves.copy()
            for at, near, goal in ((0, 1, curves[-1, 3]), (3, 2, following[0, 0])):
                last = -1 if at else 0
                between[last, near] += goal - between[last, at]
                between[last, at] = goal
            parts.append(between)
    whole = np.concatenate(parts)
    whole[1:, 0] = whole[:-1, 3]
    whole[0, 0] = whole[-1, 3]
    return Outline(whole)
