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

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from shapetween.base.arrays import Floats
from shapetween.timing.windows import Eased, eased_shares, library, turning_times

__all__ = ["EasingSum", "Grid", "sum_of_easings"]

Grid = NDArray[np.int64]
"""Coordinates in steps of the last decimal that is written."""

#: Most easings of a sum. With more, keyframes are about as short, and a player adds for longer.
MOST_TERMS = 14

#: Weight of the end, which must be met, among samples that weigh 1.
END_WEIGHT = 100.0

#: Of so many samples one takes part in the pursuit, whose time grows with their square; how far off
#: a sum is is looked at at all of them. With fewer, what moves quickly is overlooked.
PURSUED = 2

#: Share of a movement's extent below which what is left of it is rounding, and no longer fitted.
NOISE = 1e-6

#: How many times the error allowed the pursuit may be off before exchanges are tried to bring it
#: down. Larger saves a term at times and takes several times as long.
NEARLY = 10

#: With so few easings over windows no others are sought.
AT_ONCE = 3

#: A movement that after so many easings is off by so many times the error allowed jumps somewhere,
#: and no sum comes near it. Sooner or less, and sums that would do are given up.
SOON, HOPELESS = 6, 20.0

#: What a point that is where it should be counts, where the one farthest off counts 1. At 1 a few
#: points that move otherwise than the rest are never reached; at 0 the rest is lost again.
EVEN = 0.2

#: Steps of the coarsest grid that displacements other than the first are tried on, a power of ten:
#: each digit that is not written saves a fifth of the file.
COARSEST = 100

#: Steps by which rounding may add to the error allowed: what rounding the places themselves does.
ROUNDING = 0.5

#: Share of what the best easing explains by which others that explain less are as good. Smaller,
#: and rounding, which late in a pursuit is a billionth of it, chooses among the many that
#: are nearly alike, otherwise on other processors; larger takes more easings.
ALIKE = 1e-5

#: The same of the first easing, and the share of a step by which rounding keeps off ties. Larger,
#: and the one easing that a movement is is not found; smaller, and last bits decide.
TIE = 1e-7


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

    Returns
    -------
    EasingSum or None
        None if no sum is near enough.
    """
    moved = (points - points[0]).reshape(len(points), -1)
    if not np.abs(moved).max(initial=0.0):
        return None
    whole = (np.rint(points[-1] / step) - np.rint(points[0] / step)).astype(np.int64).reshape(-1)
    task = _Task(moved, whole, clock, step, tolerance, importance)
    turns = turning_times(points, clock, tolerance)
    best = task.solved(turns, most) if turns else None
    if best is not None and len(best.easings) <= AT_ONCE:
        return best
    # Windows that are none mislead the pursuit.
    fewest = MOST_TERMS if best is None else len(best.easings)
    return task.solved((), lambda: min(most(), fewest)) or best


@dataclass(frozen=True, slots=True, eq=False)
class _Task:
    """Displacements (S, 2 K) at samples of a clock, the last of them in steps, and what is near."""

    moved: Floats
    whole: Grid
    clock: Floats
    step: float
    tolerance: float
    importance: Floats

    def solved(self, turns: tuple[float, ...], most: Callable[[], int]) -> EasingSum | None:
        """The shortest sum found with windows between some times; None if none is near enough."""
        count = len(self.moved)
        choices, shares = library(self.clock, turns)
        weights = np.ones(count)
        weights[-1] = END_WEIGHT
        rows = np.unique(np.append(np.arange(0, count, PURSUED), count - 1))
        pursuit = _Pursuit((shares * weights[:, None])[rows], (self.moved * weights[:, None])[rows])
        for terms in range(1, min(MOST_TERMS, count - 1) + 1):
            if terms > 1 and terms > most():
                return None
            pursuit.add()
            off = self._off(shares[:, pursuit.chosen])
            if len(pursuit.chosen) > SOON and off.max() > HOPELESS * self.tolerance:
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

    def _off(self, easings: Floats) -> Floats:
        """How far each point is off at its worst, (K,), where the best sum of easings is."""
        left = self.moved - easings[:, :1] * (self.whole * self.step)
        if easings.shape[1] > 1:
            axes = np.linalg.qr(_basis(easings))[0]
            left -= axes @ (axes.T @ left)
        return np.asarray(_longest(left) * self.importance)

    def _rounded(self, easings: Floats) -> Grid | None:
        """Displacements (M, K, 2), on as coarse grids as are near enough; None if none is."""
        allowed = self.tolerance / self.step + ROUNDING
        terms = _coarsely_rounded(
            easings, self.moved / self.step, self.whole, allowed, self.importance
        )
        return None if terms is None else terms.reshape(len(terms), -1, 2)


def _compressed(values: Floats) -> Floats:
    """Fewer columns with the same products among rows, (S, D) to (S, R).

    By reflections, as products of the values keep but half of their digits, and what is left of a
    movement late in the pursuit is less than that.
    """
    if values.shape[1] > len(values):
        values = np.asarray(np.linalg.qr(values.T, mode="r")).T
    axes, sizes, _ = np.linalg.svd(values, full_matrices=False)
    kept = sizes > NOISE * sizes[0]
    return np.asarray(axes[:, kept] * sizes[kept])


class _Pursuit:
    """Columns of a library chosen one by one so that least of some values is left over."""

    def __init__(self, library: Floats, values: Floats) -> None:
        self._library, self._moved = library, values
        self._sizes = (library**2).sum(axis=0)
        self._values = _compressed(values)
        self.chosen: list[int] = []

    def emphasise(self, worst: Floats) -> None:
        """Let points count by how far they are off: it is the farthest that decides."""
        peak = worst.max()
        if peak > 0:
            emphasis = np.repeat(np.maximum(worst / peak, EVEN), 2)
            self._values = _compressed(self._moved * emphasis)

    def add(self) -> None:
        """Choose the column that leaves least."""
        self.chosen.append(self._best(self.chosen)[0])

    def exchange(self) -> bool:
        """Choose each column anew with the others given, twice; whether anything changed."""
        before = list(self.chosen)
        for _ in range(2):
            for place in range(len(self.chosen)):
                others = self.chosen[:place] + self.chosen[place + 1 :]
                best, gain = self._best(others)
                if gain > self._gain(others, self.chosen[place]) * (1 + _alike(others)):
                    self.chosen[place] = best
        return before != self.chosen

    def _gains(self, others: list[int]) -> Floats:
        """How much more each column explains where some are given."""
        size, values = self._sizes, self._values
        library = self._library
        if others:
            # Differences first: the ends, which weigh most, drop out of them exactly, and leave
            # rounding no way into the little that tells easings apart.
            given = library[:, others]
            basis = np.linalg.qr(np.column_stack([_basis(given), given[:, 0]]))[0]
            library = library - given[:, :1]
            library -= basis @ (basis.T @ library)
            # Lengths of what is left: a difference of squares keeps but half of their digits.
            size = (library**2).sum(axis=0)
            values = values - basis @ (basis.T @ values)
        known = size > 1e-9 * self._sizes
        gains = ((library.T @ values) ** 2).sum(axis=1)
        return np.asarray(gains * known / np.where(known, size, 1.0))

    def _best(self, others: list[int]) -> tuple[int, float]:
        gains = self._gains(others)
        # Of those that are as good, the first, whatever the rounding.
        best = int((gains >= gains.max() * (1 - _alike(others))).argmax())
        return best, float(gains[best])

    def _gain(self, others: list[int], column: int) -> float:
        return float(self._gains(others)[column])


def _alike(others: list[int]) -> float:
    """Share by which columns may differ that are as good: alone, nearly all meets the end."""
    return ALIKE if others else TIE


def _basis(easings: Floats) -> Floats:
    """Differences to the first easing: what the others add to it, 0 at both ends."""
    return easings[:, 1:] - easings[:, :1]


def _longest(values: Floats) -> Floats:
    """Greatest lengths in each column of vectors whose coordinates follow each other.

    (S, 2 K) to (K,).
    """
    squares = values * values
    return np.asarray(np.sqrt((squares[:, ::2] + squares[:, 1::2]).max(axis=0)))


def _coarsely_rounded(
    easings: Floats, moved: Floats, whole: Grid, tolerance: float, importance: Floats
) -> Grid | None:
    """Displacements (M, D), on as coarse grids as are near enough; None if none is."""
    q, r = np.linalg.qr(_basis(easings))
    target = q.T @ (moved - easings[:, :1] * whole)
    seen = abs(np.diag(r))
    grids = np.full(len(r), COARSEST)
    while True:
        terms = _rounded(r, target, whole, grids)
        if (_longest(easings @ terms - moved) * importance).max() <= tolerance:
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
