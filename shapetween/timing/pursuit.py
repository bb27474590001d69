"""Orthogonal matching pursuit with exchanges: a few columns of many that explain most.

Nothing is chosen by the last bits of a number: what is as good as the best counts as that.
"""

import numpy as np

from shapetween.base.arrays import Floats

__all__ = ["ALIKE", "TIE", "Pursuit", "differences"]

#: Share of a movement's extent below which what is left of it is rounding, and no longer fitted.
NOISE = 1e-6

#: What a point that is where it should be counts, where the one farthest off counts 1. At 1 a few
#: points that move otherwise than the rest are never reached; at 0 the rest is lost again.
EVEN = 0.2

#: Share of what the best easing explains by which others that explain less are as good. Smaller,
#: and rounding, which late in a pursuit is a billionth of it, chooses among the many that
#: are nearly alike, otherwise on other processors; larger takes more easings.
ALIKE = 1e-5

#: The same of the first easing, and the share of a step by which rounding keeps off ties. Larger,
#: and the one easing that a movement is is not found; smaller, and last bits decide.
TIE = 1e-7


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


class Pursuit:
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
        self.chosen.append(_first_best(self._gains(self.chosen), self.chosen))

    def exchange(self) -> bool:
        """Choose each column anew with the others given, twice; whether anything changed."""
        before, count, settled = list(self.chosen), len(self.chosen), 0
        for place in (*range(count), *range(count)):
            others = self.chosen[:place] + self.chosen[place + 1 :]
            gains = self._gains(others)
            best = _first_best(gains, others)
            if gains[best] > gains[self.chosen[place]] * (1 + _alike(others)):
                self.chosen[place], settled = best, 0
            settled += 1
            if settled == count:  # each is the best beside the others as they are
                break
        return before != self.chosen

    def _gains(self, others: list[int]) -> Floats:
        """How much more each column explains where some are given."""
        size, values = self._sizes, self._values
        library = self._library
        if others:
            # Differences first: the ends, which weigh most, drop out of them exactly, and leave
            # rounding no way into the little that tells easings apart.
            given = library[:, others]
            basis = np.linalg.qr(np.column_stack([differences(given), given[:, 0]]))[0]
            library = library - given[:, :1]
            library -= basis @ (basis.T @ library)
            # Lengths of what is left: a difference of squares keeps but half of their digits.
            size = (library**2).sum(axis=0)
            values = values - basis @ (basis.T @ values)
        known = size > 1e-9 * self._sizes
        gains = ((library.T @ values) ** 2).sum(axis=1)
        return np.asarray(gains * known / np.where(known, size, 1.0))


def _first_best(gains: Floats, others: list[int]) -> int:
    """Of the columns that are as good as the best, the first, whatever the rounding."""
    return int((gains >= gains.max() * (1 - _alike(others))).argmax())


def _alike(others: list[int]) -> float:
    """Share by which columns may differ that are as good: alone, nearly all meets the end."""
    return ALIKE if others else TIE


def differences(easings: Floats) -> Floats:
    """Differences to the first easing: what the others add to it, 0 at both ends."""
    return easings[:, 1:] - easings[:, :1]
