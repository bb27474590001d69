"""The best matchings of two outlines: the frames they are compared in, and the choice."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from shapetween.arrays import Floats
from shapetween.correspond.correspondence import Confidence, Correspondence
from shapetween.correspond.costs import (
    Prepared,
    intrinsic_cost,
    prepare,
    stations,
    upright_cost,
)
from shapetween.correspond.dynamic import Paths, cyclic_paths, open_path
from shapetween.outline import Outline

__all__ = ["match"]

#: Stations a matching is chosen with, and how many of the second outline's are skipped between
#: those the first one's first may be matched with. Fewer lose limbs, more time.
STATIONS, EVERY = 96, 2

#: Stations a chosen matching is refined with, and how far it may move, as a share of them.
FINE_STATIONS, BAND = 192, 0.06

#: Least angle, radians, between the upright frame and one worth trying beside it.
MIN_TURN = 0.25

#: Least mean distance, as a share of the length, between two matchings that are different ones.
DISTINCT = 0.03

#: Drawings are meant upright: a turned frame must match this much better than the upright one.
#: Higher turns shapes that only look alike when turned, lower misses the turned ones.
FRAME_RATIO = 0.68

#: Matchings kept of each frame.
PER_FRAME = 3

#: Least lead over the runner-up, as a share of the cost, of a matching that is sure, or likely.
SURE, LIKELY = 0.3, 0.1


@dataclass(frozen=True, slots=True, eq=False)
class Candidate:
    """A matching found in one frame.

    Attributes
    ----------
    a, b : (K,) float64
        Knots, in both outlines' measures.
    cost : float
    turn : float
        The frame: the angle the first outline was turned by.
    """

    a: Floats
    b: Floats
    cost: float
    turn: float


def match(source: Outline, target: Outline) -> Correspondence:
    """The best matching of two outlines that are no affine images of one another."""
    a, b = prepare(source), prepare(target)
    if _comes_second(a, b):
        return _ordered_match(b, a).inverse()
    return _ordered_match(a, b)


def _comes_second(a: Prepared, b: Prepared) -> bool:
    """Whether the outlines are to be exchanged, so that both orders give one matching.

    Geometry decides: the first clear difference in length, then in the samples.
    """
    gaps = np.append(
        a.samples.arcs.length / a.samples.size - b.samples.arcs.length / b.samples.size,
        (a.samples.points - b.samples.points).ravel(),
    )
    clear = np.flatnonzero(np.abs(gaps) > 1e-6)
    return bool(len(clear) and gaps[clear[0]] > 0)


def _ordered_match(a: Prepared, b: Prepared) -> Correspondence:
    at = np.arange(STATIONS) / STATIONS
    sa, sb = stations(a, at), stations(b, at)
    frames = [0.0]
    intrinsic = _distinct(cyclic_paths(intrinsic_cost(sa, sb), EVERY), a, b, 1, 0.0)
    turn = _turn_between(a, b, intrinsic[0])
    if abs(turn) >= MIN_TURN:
        frames.append(turn)
    ranked: list[tuple[float, Candidate]] = []
    for angle in frames:
        paths = cyclic_paths(upright_cost(sa.turned(angle), sb), EVERY)
        handicap = 1.0 if angle == 0 else 1 / FRAME_RATIO
        ranked += [(c.cost * handicap, c) for c in _distinct(paths, a, b, PER_FRAME, angle)]
    ranked.sort(key=lambda entry: entry[0])
    costs = [cost for cost, _ in ranked] + [np.inf]
    lead = costs[1] / costs[0] - 1
    confidence: Confidence = "sure" if lead > SURE else "likely" if lead > LIKELY else "unsure"
    made = [_finished(a, b, candidate, cost) for cost, candidate in ranked]
    best = made[0]
    return Correspondence(
        u=best.u,
        v=best.v,
        cost=costs[0],
        runner_up=costs[1],
        confidence=confidence,
        turn=best.turn,
        others=tuple(made[1:]),
    )


def _turn_between(a: Prepared, b: Prepared, candidate: Candidate) -> float:
    """Angle of the rotation that takes the first's matched points nearest the second's."""
    za, zb = (
        stations(p, knots).points @ [1, 1j] for p, knots in ((a, candidate.a), (b, candidate.b))
    )
    return float(np.angle((zb * za.conj()).sum()))


def _distinct(paths: Paths, a: Prepared, b: Prepared, count: int, turn: float) -> list[Candidate]:
    """The cheapest paths that are different matchings, at most `count`."""
    kept: list[Candidate] = []
    reached: list[Floats] = []
    grid = np.arange(STATIONS) / STATIONS
    for which in np.argsort(paths.costs, kind="stable"):
        if not np.isfinite(paths.costs[which]):
            break
        rows, columns = paths.trace(int(which))
        candidate = Candidate(
            a=rows / STATIONS,
            b=(columns + paths.starts[which]) / STATIONS,
            cost=float(paths.costs[which]),
            turn=turn,
        )
        v = np.interp(grid, a.places(candidate.a), b.places(candidate.b))
        if all(np.abs((v - w + 0.5) % 1 - 0.5).mean() > DISTINCT for w in reached):
            reached.append(v)
            kept.append(candidate)
            if len(kept) == count:
                break
    return kept


def _refined(a: Prepared, b: Prepared, candidate: Candidate) -> Candidate:
    """The matching found again with more stations, near where it was.

    The first pass keeps the candidate's first knot; the second is cut open half-way round, so that
    this knot moves as well.
    """
    fine = np.arange(FINE_STATIONS + 1) / FINE_STATIONS
    knots_a, knots_b = candidate.a, candidate.b
    for cut in (0.0, 0.5):
        start_a = knots_a[0] + cut
        start_b = float(_follow(knots_a, knots_b, np.array([start_a]))[0])
        at_a, at_b = start_a + fine, start_b + fine
        cost = upright_cost(stations(a, at_a).turned(candidate.turn), stations(b, at_b))
        away = _follow(knots_a, knots_b, at_a)[:, None] - at_b
        rows, columns = open_path(np.where(np.abs(away) <= BAND, cost, np.inf))
        knots_a, knots_b = at_a[rows], at_b[columns]
    return Candidate(knots_a, knots_b, candidate.cost, candidate.turn)


def _follow(knots: Floats, values: Floats, at: Floats) -> Floats:
    """Linear between knots over one turn, continued beyond it."""
    whole = np.floor(at - knots[0])
    return np.asarray(np.interp(at - whole, knots, values) + whole)


def _finished(a: Prepared, b: Prepared, candidate: Candidate, cost: float) -> Correspondence:
    fine = _refined(a, b, candidate)
    u, v = a.samples.start + a.places(fine.a), b.samples.start + b.places(fine.b)
    u[-1], v[-1] = u[0] + 1, v[0] + 1
    return Correspondence(u, v, cost, np.inf, "unsure", candidate.turn)
