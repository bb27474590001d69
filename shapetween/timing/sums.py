"""A movement as a sum of easings: a few fixed displacements, each eased in its own way.

Points that move smoothly move in few independent ways, so that

    X(u) = X(0) + sum_j C_j E_j(u)

holds closely with five to ten easings E_j, each a cubic Bezier from 0 to 1 over the whole way, and
fixed displacements C_j of all points, which add up to X(1) - X(0). A player that can add, as SMIL's
``additive="sum"`` does, needs no keyframes then, and a file a fifth of their bytes.

The easings are chosen by orthogonal matching pursuit [Pat93]_ with exchanges, and the displacements
rounded to a grid one easing after another, each making up for the rounding of those before it
(Babai's nearest plane [Bab86]_).

.. [Pat93] Y. C. Pati, R. Rezaiifar, P. S. Krishnaprasad, "Orthogonal matching pursuit", 1993.
.. [Bab86] L. Babai, "On Lovász' lattice reduction and the nearest lattice point problem", 1986.
"""

from dataclasses import dataclass
from functools import lru_cache
from itertools import product

import numpy as np
from numpy.typing import NDArray

from shapetween.base.arrays import Floats
from shapetween.timing.easing import bezier_share

__all__ = ["EasingSum", "Grid", "sum_of_easings"]

Grid = NDArray[np.int64]
"""Coordinates in steps of the last decimal that is written."""

#: Most easings of a sum. With more, keyframes are about as short, and a player adds for longer.
MOST_TERMS = 16

#: Handles of the easings to choose among. A finer set saves no easing on the pairs it was tried on;
#: a coarser one costs one or two.
HANDLES_X = (0.0, 0.2, 0.4, 0.6, 0.8, 1.0)
HANDLES_Y = (0.0, 0.5, 1.0)

#: Easings that are nowhere farther apart than this are one: telling them apart needs displacements
#: so large that rounding them shows.
APART = 0.02

#: Weight of the end, which must be met, among samples that weigh 1.
END_WEIGHT = 100.0

#: Share of a movement's extent below which what is left of it is rounding, and no longer fitted.
NOISE = 1e-6

#: How many times the error allowed the pursuit may be off before exchanges are tried to bring it
#: down. Larger saves a term at times and takes several times as long.
NEARLY = 10

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

#: Share by which choices and rounding keep off ties, so that no last bit decides.
TIE = 1e-7

#: Halvings that solve an easing for its parameter: to a millionth of a share.
HALVINGS = 24


@dataclass(frozen=True, slots=True, eq=False)
class EasingSum:
    """Displacements, each eased in its own way, on whole steps of a grid.

    Attributes
    ----------
    handles : tuple of (x1, y1, x2, y2)
        Of each easing.
    terms : (M, K, 2) int64
        The displacement of every point for each easing; they add up to the way from the first
        place to the last exactly.
    """

    handles: tuple[tuple[float, float, float, float], ...]
    terms: Grid

    def at(self, clock: Floats) -> Floats:
        """Displacements at some times of the player's clock (S,), (S, K, 2), in steps."""
        shares = np.stack([_ease(handles, clock) for handles in self.handles], axis=1)
        return np.tensordot(shares, self.terms, axes=1)


def sum_of_easings(
    points: Floats, clock: Floats, step: float, tolerance: float, importance: Floats
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

    Returns
    -------
    EasingSum or None
        None if no sum is near enough.
    """
    count = len(points)
    moved = (points - points[0]).reshape(count, -1)
    whole = np.rint(points[-1] / step) - np.rint(points[0] / step)
    whole = whole.astype(np.int64).reshape(-1)
    extent = float(np.abs(moved).max(initial=0.0))
    if extent == 0.0:
        return None
    library = _library(clock.tobytes())
    weights = np.ones(count)
    weights[-1] = END_WEIGHT
    pursuit = _Pursuit(library.shares * weights[:, None], moved * weights[:, None])

    def worst() -> Floats:
        return _worst(library.shares[:, pursuit.chosen], moved, whole * step) * importance

    for _ in range(min(MOST_TERMS, count - 1)):
        pursuit.add()
        off = worst()
        if len(pursuit.chosen) > SOON and off.max() > HOPELESS * tolerance:
            return None
        if tolerance < off.max() <= NEARLY * tolerance:
            pursuit.emphasise(off)
            if pursuit.exchange():
                off = worst()
        if off.max() <= tolerance:
            easings = library.shares[:, pursuit.chosen]
            allowed = tolerance / step + ROUNDING
            terms = _coarsely_rounded(easings, moved / step, whole, allowed, importance)
            if terms is not None:
                handles = tuple(library.handles[k] for k in pursuit.chosen)
                return EasingSum(handles, terms.reshape(len(handles), -1, 2))
    return None


@dataclass(frozen=True, slots=True, eq=False)
class _Library:
    """Easings to choose among: their handles, and what they are at the samples, (S, L)."""

    handles: tuple[tuple[float, float, float, float], ...]
    shares: Floats


@lru_cache(maxsize=8)
def _library(clock: bytes) -> _Library:
    times = np.frombuffer(clock, np.float64)
    even = np.linspace(0, 1, 101)
    handles: list[tuple[float, float, float, float]] = []
    seen: list[Floats] = []
    choices = [(1 / 3, 1 / 3, 2 / 3, 2 / 3)]
    choices += [
        (x1, y1, x2, y2)
        for x1, y1, x2, y2 in product(HANDLES_X, HANDLES_Y, HANDLES_X, HANDLES_Y)
        if y1 <= y2 or x1 <= x2
    ]
    for choice in choices:
        shape = _ease(choice, even)
        if not seen or np.abs(np.array(seen) - shape).max(axis=1).min() > APART:
            seen.append(shape)
            handles.append(choice)
    shares = np.stack([_ease(choice, times) for choice in handles], axis=1)
    shares.setflags(write=False)
    return _Library(tuple(handles), shares)


def _ease(handles: tuple[float, float, float, float], clock: Floats) -> Floats:
    x1, y1, x2, y2 = handles
    low, high = np.zeros_like(clock), np.ones_like(clock)
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        before = bezier_share(middle, x1, x2) < clock
        low, high = np.where(before, middle, low), np.where(before, high, middle)
    share = bezier_share((low + high) / 2, y1, y2)
    return np.asarray(np.where(clock <= 0, 0.0, np.where(clock >= 1, 1.0, share)))


def _compressed(values: Floats) -> Floats:
    """Fewer columns with the same products among rows, (S, D) to (S, R)."""
    few = values.shape[1] < len(values)
    powers, axes = np.linalg.eigh(values.T @ values if few else values @ values.T)
    kept = powers > NOISE**2 * powers[-1]
    return np.asarray(values @ axes[:, kept] if few else axes[:, kept] * np.sqrt(powers[kept]))


class _Pursuit:
    """Columns of a library chosen one by one so that least of some values is left over."""

    def __init__(self, library: Floats, values: Floats) -> None:
        self._library, self._moved = library, values
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
                if gain > self._gain(others, self.chosen[place]) * (1 + TIE):
                    self.chosen[place] = best
        return before != self.chosen

    def _rest(self, others: list[int]) -> tuple[Floats, Floats]:
        """The library and the values without what some columns explain."""
        if not others:
            return self._library, self._values
        basis = np.linalg.qr(self._library[:, others])[0]
        library = self._library - basis @ (basis.T @ self._library)
        return library, self._values - basis @ (basis.T @ self._values)

    def _gains(self, others: list[int]) -> Floats:
        library, values = self._rest(others)
        size = (library**2).sum(axis=0)
        known = size > 1e-9 * (self._library**2).sum(axis=0)
        gains = ((library.T @ values) ** 2).sum(axis=1)
        return np.asarray(gains * known / np.where(known, size, 1.0))

    def _best(self, others: list[int]) -> tuple[int, float]:
        gains = self._gains(others)
        # Of those that are as good, the first, whatever the rounding.
        best = int((gains >= gains.max() * (1 - TIE)).argmax())
        return best, float(gains[best])

    def _gain(self, others: list[int], column: int) -> float:
        return float(self._gains(others)[column])


def _basis(easings: Floats) -> Floats:
    """Differences to the first easing: what the others add to it, 0 at both ends."""
    return easings[:, 1:] - easings[:, :1]


def _worst(easings: Floats, moved: Floats, whole: Floats) -> Floats:
    """How far each point is off at its worst, (K,), where the best sum of these easings is."""
    left = moved - easings[:, :1] * whole
    if easings.shape[1] > 1:
        basis = np.linalg.qr(_basis(easings))[0]
        left -= basis @ (basis.T @ left)
    return _longest(left)


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
