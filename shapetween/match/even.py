"""Matchings of two symmetric outlines that match axis with axis, each sector like the next."""

from dataclasses import dataclass, replace

import numpy as np

from shapetween.base.arrays import Floats, Index
from shapetween.match.candidate import Candidate, Halves, away
from shapetween.match.costs import Prepared, sample_features, upright_cost, upright_features
from shapetween.match.dynamic import priced_path
from shapetween.match.lopsided import lopsided_ends
from shapetween.match.scale import BAND, FINE_SAMPLES, MATCH_SAMPLES, VERTEX_REWARD, rounded
from shapetween.match.symmetry import aligned_ends

__all__ = ["even_matchings", "lopsided_matchings", "refined_even"]

#: Least steps of a sector. Fewer, and a regular shape of many axes loses what lies between two of
#: them; more cost time.
LEAST_STEPS = 12


@dataclass(frozen=True, slots=True, eq=False)
class _Side:
    """Samples of one outline, sector by sector.

    Attributes
    ----------
    shares : (m + 1,) float64
        How far along its sector each sample lies, from 0 to 1, seen from the axis that even
        sectors start at.
    places : (2 g, m + 1) float64
        Fractions of the length from the canonical start; those of an odd sector run back.
    sector, sample : (V,) intp
        Where the salient vertices are; one on an axis is there once for either side.
    vertex : (V,) intp
    """

    shares: Floats
    places: Floats
    sector: Index
    sample: Index
    vertex: Index


def even_matchings(a: Prepared, b: Prepared, angle: float, rewards: Floats) -> list[Candidate]:
    """The best matchings of two outlines that keep the axes they have in common, in one frame.

    Parameters
    ----------
    a, b : Prepared
    angle : float
        By which the first is turned.
    rewards : (K, K) float64
        Of salient vertices that meet.
    """
    axes = aligned_ends(a.axes, b.axes, angle)
    made = (_matched(a, b, x, (None, None), angle, rewards, MATCH_SAMPLES, None) for x in axes)
    return [candidate for candidate in made if candidate is not None]


def lopsided_matchings(a: Prepared, b: Prepared, rewards: Floats) -> list[Candidate]:
    """The same as drawn, where one of them is even but for something on one side."""
    made = (_matched(a, b, *x, 0.0, rewards, MATCH_SAMPLES, None) for x in lopsided_ends(a, b))
    return [candidate for candidate in made if candidate is not None]


def refined_even(a: Prepared, b: Prepared, candidate: Candidate, rewards: Floats) -> Candidate:
    """The matching found again with more samples, near where it was."""
    assert candidate.ends is not None
    found = _matched(
        a, b, candidate.ends, candidate.halves, candidate.turn, rewards, FINE_SAMPLES, candidate
    )
    return candidate if found is None else replace(found, cost=candidate.cost)


def _matched(
    a: Prepared,
    b: Prepared,
    ends: Floats,
    halves: Halves,
    angle: float,
    rewards: Floats,
    count: int,
    near: Candidate | None,
) -> Candidate | None:
    """The cheapest path through one sector, the costs of all sectors laid upon each other."""
    sectors = len(ends)
    steps = max(count // sectors, LEAST_STEPS * count // MATCH_SAMPLES)
    first, second = (
        _side(outline, end, half, steps)
        for outline, end, half in zip((a, b), ends.T, halves, strict=True)
    )
    side = np.arange(steps + 1)
    rows, columns = (part.ravel() for part in np.meshgrid(side, side, indexing="ij"))
    if near is not None:
        gaps = [away(near, p, q) for p, q in zip(first.places, second.places, strict=True)]
        rows, columns = np.nonzero((np.array(gaps) <= BAND).any(axis=0))
    base = (steps + 1) * np.arange(sectors)[:, None]
    cells = base + rows, base + columns
    here = upright_features(sample_features(a, first.places.ravel()).turned(angle))
    there = upright_features(sample_features(b, second.places.ravel()))
    cost = np.full((steps + 1, steps + 1), np.inf)
    cost[rows, columns] = rounded(upright_cost(here, there, cells).mean(axis=0))
    earned = _earned(first, second, rewards, sectors, steps)
    path = priced_path(cost, steps * earned)
    if path is None:
        return None
    knots = [
        _unfolded(end, [_along(half, side.shares[at], k) for k in range(2)])
        for side, at, end, half in zip(
            (first, second), (path.rows, path.columns), ends.T, halves, strict=True
        )
    ]
    return Candidate(knots[0], knots[1], path.cost - float(earned[0, 0]), angle, ends, halves)


def _along(half: Floats | None, shares: Floats, side: int) -> Floats:
    """How far along a sector of one side common shares are, from 0 to 1."""
    if half is None:
        return shares
    return np.asarray(np.interp(shares, half.mean(axis=0), half[side]))


def _common(half: Floats | None, shares: Floats, sides: Index) -> Floats:
    """Inverse of `_along`."""
    if half is None:
        return shares
    both = [np.interp(shares, half[side], half.mean(axis=0)) for side in range(2)]
    return np.asarray(np.where(sides == 0, *both))


def _side(prepared: Prepared, ends: Floats, half: Floats | None, steps: int) -> _Side:
    """Samples at even steps of the measure, moved onto the nearest vertices."""
    sectors = len(ends)
    bounds = np.append(ends, ends[0] + 1)
    lengths = np.diff(bounds)
    at = prepared.measures(bounds[:2])
    shares = (prepared.places(np.linspace(at[0], at[1], steps + 1)) - bounds[0]) / lengths[0]
    shares = _common(half, shares, np.zeros(len(shares), dtype=np.intp))
    shares[0], shares[-1] = 0.0, 1.0
    vertex = prepared.vertices.index / len(prepared.samples.points)
    vertex = vertex - np.floor(vertex - bounds[0])
    sector = np.searchsorted(bounds, vertex, side="right") - 1
    share = (vertex - bounds[sector]) / lengths[sector]
    share = _common(half, np.where(sector % 2 == 0, share, 1 - share), sector % 2)
    sample = np.abs(share[:, None] - shares).argmin(axis=1)
    inner = (sample > 0) & (sample < steps)
    for k in np.flatnonzero(inner)[::-1]:  # of several at one sample the first counts
        shares[sample[k]] = share[k]
    # One on an axis belongs to the sectors on both sides of it.
    back = (sample == 0) == (sector % 2 == 0)
    beside = np.where(back, sector - 1, sector + 1) % sectors
    on = np.flatnonzero(~inner)
    turned = np.where(np.arange(sectors) % 2 == 0, 1.0, -1.0)[:, None]
    begin = np.where(turned > 0, bounds[:-1, None], bounds[1:, None])
    sides = np.array([_along(half, shares, k % 2) for k in range(sectors)])
    places = begin + turned * sides * lengths[:, None]
    every = np.arange(len(vertex))
    return _Side(
        shares,
        places,
        np.append(sector, beside[on]),
        np.append(sample, sample[on]),
        np.append(every, on),
    )


def _earned(first: _Side, second: _Side, rewards: Floats, sectors: int, steps: int) -> Floats:
    """What all sectors together earn in each cell by salient vertices that meet."""
    best = np.zeros((steps + 1, steps + 1))
    same = first.sector[:, None] == second.sector
    pairs = np.where(same, rewards[np.ix_(first.vertex, second.vertex)], 0.0)
    np.maximum.at(best, (first.sample[:, None], second.sample[None]), pairs)
    best *= sectors * VERTEX_REWARD
    # What lies on an axis is in two sectors, and there once.
    best[[0, -1]] /= 2
    best[1:-1, [0, -1]] /= 2
    return rounded(best)


def _unfolded(ends: Floats, shares: list[Floats]) -> Floats:
    """Knots of all sectors from those of one on either side, over one turn."""
    lengths = np.diff(np.append(ends, ends[0] + 1))
    forth, back = shares[0][:-1], 1 - shares[1][:0:-1]
    knots = [
        start + length * (back if k % 2 else forth)
        for k, (start, length) in enumerate(zip(ends, lengths, strict=True))
    ]
    return np.append(np.concatenate(knots), ends[0] + 1)
