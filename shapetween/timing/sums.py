"""A movement as a sum of easings: a few fixed displacements, each eased in its own way.

Points that move smoothly move in few independent ways, so that

    X(u) = X(0) + sum_j C_j E_j(u)

holds closely with five to ten easings E_j, each a cubic Bezier from 0 to 1 over the whole way or
over a window of it, and fixed displacements C_j of all points, which add up to X(1) - X(0). A
player that can add, as SMIL's ``additive="sum"`` does, needs no keyframes then, and a file a fifth
of their bytes.

The easings are chosen by orthogonal matching pursuit [Pat93]_ with exchanges, and the displacements
rounded to a grid one easing after another, each making up for the rounding of those before it
(Babai's nearest plane [Bab86]_).

.. [Pat93] Y. C. Pati, R. Rezaiifar, P. S. Krishnaprasad, "Orthogonal matching pursuit", 1993.
.. [Bab86] L. Babai, "On Lovász' lattice reduction and the nearest lattice point problem", 1986.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from shapetween.base.arrays import Floats, Index, row_lengths
from shapetween.timing.pursuit import ALIKE, TIE, Pursuit, differences
from shapetween.timing.ramps import together
from shapetween.timing.windows import Eased, eased_shares, library

__all__ = ["EasingSum", "Grid", "sum_of_easings", "united"]

Grid = NDArray[np.int64]
"""Coordinates in steps of the last decimal that is written."""

#: Most easings that run together, over the whole way or over one window of it. With more it takes
#: twice as long to find them, and hardly a movement needs them; with fewer what moves in many ways
#: takes keyframes, and three times the bytes: at most fourteen of them, in all windows together,
#: make eight of 167 pairs up to three times as large, to spare .15 ms a frame in Chromium.
MOST_TERMS = 20

#: Most easings in all where windows follow each other. A player adds what has arrived too: in
#: Chromium twenty take twice as long as keyframes do, 0.3 ms a frame of 70 curves, and 40 twice
#: that. With fewer, what goes piece by piece takes keyframes, and twice the bytes.
MOST_IN_TURN = 40

#: Weight of the end, which must be met, among samples that weigh 1.
END_WEIGHT = 100.0

#: Of so many samples one takes part in the pursuit, whose time grows with their square; how far off
#: a sum is is looked at at all of them. With fewer, what moves quickly is overlooked.
PURSUED = 2

#: Of no more samples all take part.
FEW = 60

#: How late a point may be, a share of the whole time, and from which speed on, in tolerances a
#: whole time: as if it ran through most of the picture. What is drawn out runs through several;
#: larger, and it lags visibly; smaller, and it takes keyframes.
LATE, FAST = 1 / 2000, 4000.0

#: How many times the error allowed the pursuit may be off before exchanges are tried to bring it
#: down. Larger saves a term at times and takes several times as long.
NEARLY = 10

#: With so few easings no others are sought.
AT_ONCE = 3

#: Share of the error allowed by which a point may be off at a corner that it passes evenly.
EVENLY = 0.25

#: Most corners between any two of which windows are tried. With more it takes seconds.
TOGETHER = 6

#: A movement that after so many easings, and one for each corner, is off by so many times the error
#: allowed jumps somewhere, and no sum comes near it. Sooner or less, and sums that would do are
#: given up.
SOON, HOPELESS = 6, 20.0

#: Steps of the coarsest grid that displacements other than the first are tried on, a power of ten:
#: each digit that is not written saves a fifth of the file.
COARSEST = 100

#: Steps by which rounding may add to the error allowed: what rounding the places themselves does.
ROUNDING = 0.5


@dataclass(frozen=True, slots=True, eq=False)
class EasingSum:
    """Displacements, each eased in its own way, on whole steps of a grid.

    Attributes
    ----------
    easings : tuple of Eased
        By when they set off.
    terms : (M, K, 2) int64
        The displacement of every point for each easing; they add up to the way from the first
        place to the last exactly.
    """

    easings: tuple[Eased, ...]
    terms: Grid

    def at(self, clock: Floats) -> Floats:
        """Displacements at some times of the player's clock (S,), (S, K, 2), in steps."""
        shares = np.stack([eased_shares(easing, clock) for easing in self.easings], axis=1)
        return np.tensordot(shares, self.terms, axes=1)


def sum_of_easings(
    points: Floats,
    clock: Floats,
    step: float,
    tolerance: float,
    importance: Floats,
    most: Callable[[], int] = lambda: MOST_TERMS,
    turns: tuple[float, ...] = (),
    *,
    late: bool = False,
) -> EasingSum | None:
    """The shortest sum found that stays near a movement.

    Parameters
    ----------
    points : (S, K, 2) float64
        Places at rising times, the first and the last of which are the ends.
    clock : (S,) float64
        Those times, from 0 to 1.
    step : float
        Of the grid on which displacements are given.
    tolerance : float
        Greatest distance allowed between a point and its place, before rounding.
    importance : (K,) float64
        What each point's distance counts.
    most : callable
        Says how many easings are of use, at least one. Asked only where one is not enough.
    turns : tuple of float
        Times among the clock's at which the movement turns a corner, the sharpest first.
    late : bool
        Whether what is quick may be late, as what comes or goes.

    Returns
    -------
    EasingSum or None
        None if no sum is near enough.
    """
    moved = (points - points[0]).reshape(len(points), -1)
    if not np.abs(moved).max(initial=0.0):
        return None
    whole = (np.rint(points[-1] / step) - np.rint(points[0] / step)).astype(np.int64).reshape(-1)
    counts = importance * _slack(points, clock, tolerance) if late else importance[None]
    task = _Task(points[0].reshape(-1), moved, whole, clock, step, tolerance, counts)
    best: EasingSum | None = None

    def fewer() -> int:
        return most() if best is None else min(most(), len(best.easings) - 1)

    # Windows that are none lead the pursuit astray, so it is tried without any too.
    tries = ((True, turns), (False, turns)) if 0 < len(turns) <= TOGETHER else ((True, ()),)
    for own, some in (*tries, (False, ())):
        best = task.solved(some, fewer, own=own) or best
        if best is not None and len(best.easings) <= AT_ONCE:
            return best
    found = task.in_turn(sorted(turns), min(most(), MOST_IN_TURN)) if turns else None
    return best if found is None or (best and len(found.easings) >= len(best.easings)) else found


def united(sums: Sequence[tuple[Index, EasingSum]], count: int) -> EasingSum:
    """Sums of some of so many points each as one of all, in which no easing comes twice."""
    terms: dict[Eased, Grid] = {}
    for points, found in sums:
        for easing, own in zip(found.easings, found.terms, strict=True):
            whole = terms.setdefault(easing, np.zeros((count, 2), np.int64))
            whole[points] += own
    easings = sorted(terms, key=lambda easing: (easing.window, easing.handles))
    return EasingSum(tuple(easings), np.stack([terms[easing] for easing in easings]))


@dataclass(frozen=True, slots=True, eq=False)
class _Task:
    """Places (2 K) and displacements (S, 2 K) at samples of a clock, the last of them in steps.

    What the distance of a point from its place counts is told for each sample, (S, K), or once for
    all, (1, K).
    """

    start: Floats
    moved: Floats
    whole: Grid
    clock: Floats
    step: float
    tolerance: float
    counts: Floats

    def solved(
        self, turns: tuple[float, ...], most: Callable[[], int], *, own: bool
    ) -> EasingSum | None:
        """The shortest sum found with windows between some times; None if none is near enough."""
        count = len(self.moved)
        choices, shares = library(self.clock, turns, own=own)
        weights = np.ones(count)
        weights[-1] = END_WEIGHT
        stride = PURSUED if count > FEW else 1
        rows = np.unique(np.append(np.arange(0, count, stride), count - 1))
        pursuit = Pursuit((shares * weights[:, None])[rows], (self.moved * weights[:, None])[rows])
        for terms in range(1, min(MOST_TERMS, count - 1) + 1):
            if terms > 1 and terms > most():
                return None
            pursuit.add()
            off = self._off(shares[:, pursuit.chosen])
            if len(pursuit.chosen) > SOON + len(turns) and off.max() > HOPELESS * self.tolerance:
                return None
            if self.tolerance < off.max() <= NEARLY * self.tolerance:
                pursuit.emphasise(off)
                if pursuit.exchange():
                    off = self._off(shares[:, pursuit.chosen])
            if off.max() <= self.tolerance:
                # Who sets off first takes the others along.
                chosen = sorted(pursuit.chosen, key=lambda k: choices[k].window[0])
                rounded = self._rounded(shares[:, chosen])
                if rounded is not None:
                    return EasingSum(tuple(choices[k] for k in chosen), rounded)
        return None

    def in_turn(self, turns: Sequence[float], most: int) -> EasingSum | None:
        """A sum for each window between corners, one after another; None if some takes too many."""
        easings: list[Eased] = []
        terms: list[Grid] = []
        ends = np.searchsorted(self.clock, [0.0, *turns, 1.0])
        for first, last in pairwise(ends.tolist()):
            rows = slice(first, last + 1)
            start, end = float(self.clock[first]), float(self.clock[last])
            # Whole steps from the corner before, which is where it is rounded to.
            there = [np.rint((self.start + self.moved[k]) / self.step) for k in (first, last)]
            whole = (there[1] - there[0]).astype(np.int64)
            moved = self.moved[rows] - (there[0] * self.step - self.start)
            if not whole.any() and not (abs(moved) > self.tolerance).any():
                continue
            part = replace(
                self,
                start=there[0] * self.step,
                moved=moved,
                whole=whole,
                clock=(self.clock[rows] - start) / (end - start),
                counts=self.counts[rows] if len(self.counts) > 1 else self.counts,
            )
            if len(easings) == most:
                return None
            left = partial(int, most - len(easings))
            found = part.solved((), left, own=True) or part.solved((), left, own=False)
            if found is None:
                return None
            easings += [Eased(easing.handles, (start, end)) for easing in found.easings]
            terms.append(found.terms)
        if not easings:
            return None
        allowed = max(EVENLY * self.tolerance / self.step, 1.0)
        return EasingSum(*together(easings, np.concatenate(terms), allowed))

    def _off(self, easings: Floats) -> Floats:
        """How far each point is off at its worst, (K,), where the best sum of easings is."""
        left = self.moved - easings[:, :1] * (self.whole * self.step)
        if easings.shape[1] > 1:
            axes = np.linalg.qr(differences(easings))[0]
            left -= axes @ (axes.T @ left)
        return _longest(left, self.counts)

    def _rounded(self, easings: Floats) -> Grid | None:
        """Displacements (M, K, 2), on as coarse grids as are near enough; None if none is."""
        allowed = self.tolerance / self.step + ROUNDING
        terms = _coarsely_rounded(easings, self.moved / self.step, self.whole, allowed, self.counts)
        return None if terms is None else terms.reshape(len(terms), -1, 2)


def _slack(points: Floats, clock: Floats, tolerance: float) -> Floats:
    """What distances of points (S, K, 2) count, (S, K): less where they are fast, being late."""
    steps = row_lengths(np.diff(points, axis=0)) / np.diff(clock)[:, None]
    before, after = (np.concatenate(side) for side in ((steps[:1], steps), (steps, steps[-1:])))
    speed = np.minimum(before, after)
    return np.asarray(1 / (1 + LATE * np.maximum(speed / tolerance - FAST, 0.0)))


def _longest(values: Floats, counts: Floats) -> Floats:
    """Greatest lengths in each column of vectors whose coordinates follow each other.

    (S, 2 K) to (K,), each length of (S, K) counted as it is said, or each column of (1, K).
    """
    squares = values * values
    lengths = squares[:, ::2] + squares[:, 1::2]
    if len(counts) == 1:
        return np.asarray(np.sqrt(lengths.max(axis=0)) * counts[0])
    np.sqrt(lengths, out=lengths)
    lengths *= counts
    return np.asarray(lengths.max(axis=0))


def _coarsely_rounded(
    easings: Floats, moved: Floats, whole: Grid, tolerance: float, counts: Floats
) -> Grid | None:
    """Displacements (M, D), on as coarse grids as are near enough; None if none is."""
    q, r = np.linalg.qr(differences(easings))
    target = q.T @ (moved - easings[:, :1] * whole)
    seen = abs(np.diag(r))
    if seen.min(initial=1.0) <= ALIKE * seen.max(initial=1.0):  # two easings are one at the samples
        return None
    grids = np.full(len(r), COARSEST)
    while True:
        terms = _rounded(r, target, whole, grids)
        if _longest(easings @ terms - moved, counts).max() <= tolerance:
            return terms
        if (grids == 1).all():
            return None
        # The one whose rounding is seen most.
        worst = int((grids * seen * (grids > 1)).argmax())
        grids[worst] //= 10


def _rounded(r: Floats, target: Floats, whole: Grid, grids: NDArray[np.int64]) -> Grid:
    """Displacements (M, D), all but the first in multiples of a number of steps: (M - 1,)."""
    count = len(r)
    terms = np.zeros((count + 1, len(whole)), np.int64)
    for k in range(count - 1, -1, -1):
        left = target[k] - r[k, k + 1 :] @ terms[k + 2 :]
        steps = np.rint(left / (r[k, k] * grids[k]) + TIE).astype(np.int64)
        terms[k + 1] = steps * grids[k]
    terms[0] = whole - terms[1:].sum(axis=0)
    return terms
