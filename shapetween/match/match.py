"""The best matchings of two outlines: found in every frame, ranked, and the first one refined."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from shapetween.base.arrays import Floats
from shapetween.base.ranking import comparable
from shapetween.match.band import band_path
from shapetween.match.bends import bends_alike, plainly_the_same
from shapetween.match.candidate import Candidate, apart, around, away, distinct, follow, near
from shapetween.match.certainty import confidence_of, doubt
from shapetween.match.correspondence import Correspondence
from shapetween.match.costs import (
    Cells,
    Prepared,
    all_cells,
    intrinsic_cost,
    sample_features,
    upright_cost,
    upright_features,
)
from shapetween.match.dynamic import Paths, cyclic_paths, cyclic_prices, rolled_paths
from shapetween.match.even import even_matchings, lopsided_matchings, refined_even
from shapetween.match.frames import (
    Frame,
    handicap,
    margin_over,
    other_way_round,
    standing,
    tilted_sides,
    turn_between,
    worth_trying,
)
from shapetween.match.layout import Layout, layout_of
from shapetween.match.pins import pull_of
from shapetween.match.rewards import cell_rewards, salient_tips, vertex_rewards
from shapetween.match.scale import BAND, FINE_SAMPLES, MATCH_SAMPLES, VERTEX_REWARD, rounded
from shapetween.match.symmetry import turns_onto

__all__ = ["best_matching", "best_matchings", "upright_matching_cost"]

#: Symmetric outlines are meant to stay so: the matching that keeps them symmetric may cost this
#: many times the cheapest. Less, and one side of a thing moves unlike the other; more, and a heart
#: is laid on its side to become a C.
SYMMETRY_RATIO = 1.25

#: The same where one of them is so but for a tuft. Nearer to 1, and a hammer's claw and face grow
#: alike into a pick; less leaves a lamp to burn askew.
NEARLY_RATIO = 0.9

#: The same where one of them is so but for something large on one side. Nearer to 1, and a cut in
#: one side bends all of a chess piece on its way; more, and limbs are laid onto what is no limb.
LOPSIDED_RATIO = 1.1

#: Matchings kept of each frame.
PER_FRAME = 3

#: Matchings of the frame that was not chosen which are offered in any case. Fewer, and whoever
#: meant the thing turned finds it nowhere; more, and they take the places of better ones.
OTHER_FRAME = 2

#: Places at which a matching's unlikeness is read.
MEAN_PLACES = 128


def best_matching(a: Prepared, b: Prepared, pins: Floats) -> Correspondence:
    """The best matching of two outlines that are no affine images of one another.

    Parameters
    ----------
    a, b : Prepared
        Source and target.
    pins : (K, 2) float64
        Fractions along source and target that are to be matched, in cyclic order.
    """
    return best_matchings(a, b, pins, PER_FRAME + 1, forced=False)[0]


def best_matchings(
    a: Prepared, b: Prepared, pins: Floats, count: int, *, forced: bool
) -> list[Correspondence]:
    """Distinct matchings of two outlines, the best one first.

    Parameters
    ----------
    a, b, pins
        As for `best_matching`.
    count : int
        At most so many.
    forced : bool
        Whether salient tips are also forced onto each other, every one onto every other.
    """
    pins = pins - [a.samples.start, b.samples.start]
    pins = pins - np.floor(pins)
    if _comes_second(a, b):
        found = _Comparison(b, a, pins[:, ::-1]).best(count, forced)
        return [matching.inverse() for matching in found]
    return _Comparison(a, b, pins).best(count, forced)


def upright_matching_cost(a: Prepared, b: Prepared) -> float:
    """Cost of the best matching of two outlines as drawn, as `Correspondence` has it."""
    if _comes_second(a, b):
        a, b = b, a
    return _Comparison(a, b, np.zeros((0, 2))).upright_cost()


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


@dataclass(frozen=True, slots=True, eq=False)
class _Ranked:
    """A candidate, what it counts as, and the rewards of vertices in its frame."""

    cost: float
    candidate: Candidate
    rewards: Floats


@dataclass(frozen=True, slots=True, eq=False)
class _Found:
    """What was found in one frame: all candidates, the cheapest, and whether some are even."""

    frame: Frame
    entries: list[_Ranked]
    best: _Ranked
    even: bool

    def weighed(self, factor: float) -> list[_Ranked]:
        """The candidates with their costs multiplied."""
        return [replace(entry, cost=entry.cost * factor) for entry in self.entries]


class _Comparison:
    """Two outlines in the order that geometry gives them, and the pins on them."""

    def __init__(self, a: Prepared, b: Prepared, pins: Floats) -> None:
        self.a, self.b = a, b
        self.pins = pins[np.argsort(pins[:, 0])]
        self.layout = layout_of(a, b, self.pins, MATCH_SAMPLES)
        self.cells = all_cells(len(self.layout.a), len(self.layout.b))

    def best(self, count: int, forced: bool) -> list[Correspondence]:
        """Distinct matchings, the best one first and refined, at most `count`."""
        ranked = sorted(self._ranked(forced), key=lambda entry: entry.cost)
        if forced:
            other = [e for e in ranked if e.candidate.turn != ranked[0].candidate.turn]
            ranked = [ranked[0], *other[:OTHER_FRAME], *ranked[1:]]
        kept: list[tuple[_Ranked, Candidate]] = []
        for entry in ranked:
            if len(kept) == count:
                break
            if any(near(entry.candidate, other.candidate) for other, _ in kept):
                continue
            # Candidates that are only there to be compared with need not be refined.
            found = entry.candidate
            if forced or not kept:
                found = self._refined(found, entry.rewards)
            if not any(near(found, other) for _, other in kept):
                kept.append((entry, found))
        kept[1:] = sorted(kept[1:], key=lambda pair: pair[0].cost)
        costs = [entry.cost for entry, _ in kept]
        made = [self._finished(found, cost) for (_, found), cost in zip(kept, costs, strict=True)]
        value = doubt(costs, [0.0, *(apart(made[0], other) for other in made[1:])])
        made[0] = replace(
            made[0],
            runner_up=costs[1] if len(costs) > 1 else np.inf,
            confidence=confidence_of(value),
            doubt=value,
            others=tuple(made[1:]),
        )
        return made

    def upright_cost(self) -> float:
        """Cost of the best matching in the upright frame, rewards that are not earned added."""
        rewards = vertex_rewards(self.a, self.b, 0.0)
        return float(self._paths(self._prices(0.0, rewards)).costs.min()) + self._unrewarded

    @property
    def _unrewarded(self) -> float:
        """Rewards that can be earned at most, so that the costs of two frames have a ratio."""
        return VERTEX_REWARD * len(self.a.vertices.index)

    def _ranked(self, forced: bool) -> list[_Ranked]:
        """Candidates of all frames."""
        unlike = self._unlike()
        upright = self._found(0.0, unlike, forced)
        tried = [self._found(turn, unlike, forced) for turn in self._turns(unlike, upright)]
        if not tried:
            return upright.entries
        factors = [self._factor(upright, turned) for turned in tried]
        costs = [factor * turned.best.cost for factor, turned in zip(factors, tried, strict=True)]
        # Of two that cost the same but for rounding the first, so of none and one no turn at all.
        as_drawn, *ranks = comparable([upright.best.cost, *costs]).tolist()
        best = int(np.argmin(ranks))
        turn, factor = tried[best].frame.turn, factors[best]
        found = upright.entries + tried[best].weighed(factor)
        if ranks[best] < as_drawn:
            # What is much the same both ways round is laid that way which turns it less.
            other = self._found(other_way_round(turn), unlike, forced)
            found += other.weighed(factor * self._margin(tried[best], other))
        return found

    def _found(self, angle: float, unlike: Floats, forced: bool) -> _Found:
        """What is found in one frame."""
        a, b = self.a, self.b
        unrewarded = self._unrewarded
        rewards = vertex_rewards(a, b, angle)
        even = even_matchings(a, b, angle, rewards) if len(self.pins) == 0 else []
        entries = [
            _Ranked(c.cost + unrewarded, c, rewards) for c in self._in_frame(angle, rewards, forced)
        ]
        meant = a.axes.even and b.axes.even
        ratio = SYMMETRY_RATIO if meant else NEARLY_RATIO
        entries += [_Ranked((c.cost + unrewarded) / ratio, c, rewards) for c in even]
        # What is round is nearly even about any line, and would roll in a turned frame.
        tried = not angle and not even and not len(self.pins)
        lopsided = lopsided_matchings(a, b, rewards) if tried else []
        entries += [_Ranked((c.cost + unrewarded) / LOPSIDED_RATIO, c, rewards) for c in lopsided]
        best = min(entries, key=lambda entry: entry.cost)
        tilted = tilted_sides(a, b, angle) if angle else 0.0
        frame = Frame(angle, self._mean(unlike, best.candidate), tilted)
        return _Found(frame, entries, best, bool(even) and meant)

    def _factor(self, upright: _Found, turned: _Found) -> float:
        """What the costs of a turned frame are weighed by against those as drawn."""
        frames = upright.frame, turned.frame, standing(self.a), standing(self.b)
        even = upright.even, turned.even
        most, least = (handicap(*frames, even=even, plain=plain) for plain in (0.0, 1.0))
        cost = turned.best.cost
        if not least * cost < upright.best.cost <= most * cost:
            return most
        alike = (self._bends_alike(found.best) for found in (turned, upright))
        return handicap(*frames, even=even, plain=plainly_the_same(*alike))

    def _margin(self, found: _Found, other: _Found) -> float:
        """What the costs of the other way round are weighed by against those of a turned frame."""
        less, more = sorted((found, other), key=lambda one: abs(one.frame.turn))
        most, least = (margin_over(more.frame.turn, plain) for plain in (0.0, 1.0))
        if least * more.best.cost < less.best.cost <= most * more.best.cost:
            alike = (self._bends_alike(one.best) for one in (more, less))
            most = margin_over(more.frame.turn, plainly_the_same(*alike))
        return most if less is found else 1 / most

    def _bends_alike(self, entry: _Ranked) -> float:
        return bends_alike(self.a, self.b, self._refined(entry.candidate, entry.rewards))

    def _unlike(self) -> Floats:
        """Unlikeness of all pairs of samples that no turning changes."""
        first, second = (
            sample_features(self.a, self.layout.a),
            sample_features(self.b, self.layout.b),
        )
        return rounded(intrinsic_cost(first, second, self.cells))

    def _turns(self, unlike: Floats, upright: _Found) -> list[float]:
        """Angles of the frames worth trying beside the upright one."""
        turns = [self._turn(unlike)]
        if not upright.even and self.a.axes.even and self.b.axes.even:
            turns += turns_onto(self.a.axes, self.b.axes)
        return worth_trying(turns)

    def _turn(self, unlike: Floats) -> float:
        """The angle by which the first is turned where they match best whatever their angle."""
        layout = self.layout
        paths = cyclic_paths(unlike, np.zeros_like(unlike), layout.fixed, layout.starts)
        return turn_between(self.a, self.b, next(self._by_cost(paths, 0, 0.0)))

    def _mean(self, unlike: Floats, candidate: Candidate) -> float:
        """Mean unlikeness along a matching, at even steps of both lengths."""
        knots = (candidate.a - candidate.a[0] + candidate.b - candidate.b[0]) / 2
        even = (np.arange(MEAN_PLACES) + 0.5) / MEAN_PLACES
        count = len(unlike)
        low, share = [], []
        for places, layout in ((candidate.a, self.layout.a), (candidate.b, self.layout.b)):
            at = np.interp(even, knots, places)
            at = at - np.floor(at - layout[0])
            index = np.interp(at, np.append(layout, layout[0] + 1), np.arange(count + 1))
            low.append(np.floor(index).astype(np.intp))
            share.append(index - low[-1])
        (i, j), (s, t) = low, share
        rows = [
            (1 - t) * unlike[k % count, j % count] + t * unlike[k % count, (j + 1) % count]
            for k in (i, i + 1)
        ]
        return float(((1 - s) * rows[0] + s * rows[1]).mean())

    def _in_frame(self, angle: float, rewards: Floats, forced: bool) -> list[Candidate]:
        """The cheapest matchings of one frame that are different ones."""
        layout, prices = self.layout, self._prices(angle, rewards)
        found = distinct(self._by_cost(self._paths(prices), 0, angle), PER_FRAME)
        if not forced or len(self.pins):
            return found
        tips = [salient_tips(side) for side in (self.a, self.b)]
        goals = np.unique(layout.b_vertices[tips[1]])
        more = [
            candidate
            for first in np.unique(layout.a_vertices[tips[0]]).tolist()
            for candidate in self._by_cost(rolled_paths(prices, first, goals), first, angle)
        ]
        more.sort(key=lambda candidate: candidate.cost)
        return found + distinct(more, len(more), found)

    def _prices(self, angle: float, rewards: Floats) -> Floats:
        """Prices of the moves in one frame."""
        cost = self._cost(self.layout, angle, self.cells)
        return cyclic_prices(cost, cell_rewards(rewards, self.layout), self.layout.fixed)

    def _paths(self, prices: Floats) -> Paths:
        """The cheapest paths from the first outline's sample 0."""
        count = prices.shape[1]
        return Paths(prices, count, self.layout.starts, count)

    def _by_cost(self, paths: Paths, first: int, turn: float) -> Iterator[Candidate]:
        """The paths from a sample of the first outline, the cheapest first."""
        places = around(self.layout)
        once = np.concatenate([self.layout.a[first:], self.layout.a[: first + 1] + 1])
        for which in np.argsort(paths.costs, kind="stable").tolist():
            if not np.isfinite(paths.costs[which]):
                return
            rows, columns = paths.trace(which)
            b = places[1][columns + paths.starts[which]]
            yield Candidate(once[rows], b, float(paths.costs[which]), turn)

    def _finished(self, found: Candidate, cost: float) -> Correspondence:
        """The candidate in the outlines' own fractions."""
        u, v = self.a.samples.start + found.a, self.b.samples.start + found.b
        u[-1], v[-1] = u[0] + 1, v[0] + 1
        kept = found.ends is not None, any(half is not None for half in found.halves)
        return Correspondence(u, v, cost, np.inf, "unsure", found.turn, None, (), 0.0, *kept)

    def _refined(self, candidate: Candidate, rewards: Floats) -> Candidate:
        """The matching found again with more samples, near where it was.

        Near along either outline: a tip beside its like may cross an arc that the candidate
        passed in one step.

        Without pins, the first pass keeps one knot; the second is cut open half-way round, so that
        this knot moves as well.
        """
        a, b, pins = self.a, self.b, self.pins
        if candidate.ends is not None:
            return refined_even(a, b, candidate, rewards)
        best = candidate
        for cut in (0.0,) if len(pins) else (0.0, 0.5):
            middle = best.a[0] + cut
            kept = np.array([[middle, follow(best.a, best.b, np.array([middle]))[0]]])
            layout = layout_of(a, b, pins if len(pins) else kept, FINE_SAMPLES)
            within = away(best, layout.a, layout.b) <= BAND
            rows, columns = np.nonzero(within)
            cost = self._cost(layout, candidate.turn, (rows, columns))
            reward = cell_rewards(rewards, layout)[within]
            path = band_path((rows, columns), cost, reward, layout.fixed, len(layout.a))
            if path is None:
                break
            knots = around(layout)
            best = replace(best, a=knots[0][path[0]], b=knots[1][path[1]])
        return best

    def _cost(self, layout: Layout, angle: float, cells: Cells) -> Floats:
        """Costs of pairs of samples in one frame."""
        first, second = sample_features(self.a, layout.a), sample_features(self.b, layout.b)
        cost = upright_cost(upright_features(first.turned(angle)), upright_features(second), cells)
        if len(self.pins):
            weight, residual = pull_of(layout, self.pins, cells)
            pulled = (intrinsic_cost(first, second, cells) + residual) / 2
            cost = weight * pulled + (1 - weight) * cost
        return rounded(cost)
