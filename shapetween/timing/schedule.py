"""When a movement is looked at, so that keyframes can be chosen among those moments.

Between keyframes a player moves straight; but it can be told to ease on the way exactly as the
whole does. So keyframes are needed only where the movement is not straight in its own time.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise

import numpy as np

from shapetween.base.arrays import Floats, Index
from shapetween.geometry.bezier import sub_curves
from shapetween.timing.easing import LINEAR, bezier_share, even_times, handles_of
from shapetween.timing.windows import exact_shares

__all__ = ["SAMPLE_STEPS", "Schedule"]

#: Steps on which keyframes may lie. Fewer miss quick turns between two of them; more cost time.
#: 120 has the halves, thirds, quarters, fifths and sixths of a chain of movements.
SAMPLE_STEPS = 120

#: Samples between two corners at least: with fewer, what is quick is overlooked.
BETWEEN = 8

#: Shares of the first and the last step at which it is looked at besides, where that is asked for:
#: an easing that sets off or arrives like a root goes a tenth of a step in a hundredth of its time.
NEARER = np.array([1 / 256, 1 / 64, 1 / 16, 1 / 4])


@dataclass(frozen=True, slots=True, eq=False)
class Schedule:
    """Samples of a movement as a player shows them, even along the easing's curve.

    So a steep easing leaves no gap in either clock.

    Attributes
    ----------
    clock : (S,) float64
        When the player shows each sample, from 0 to 1.
    time : (S,) float64
        The movement's time then.
    handles : tuple of float
        x1, y1, x2, y2 of the easing.
    """

    clock: Floats
    time: Floats
    handles: tuple[float, float, float, float]

    @classmethod
    def of(cls, easing: str, count: int = SAMPLE_STEPS + 1) -> "Schedule":
        """The schedule of an easing, `count` samples long."""
        x1, y1, x2, y2 = handles_of(easing)
        linear = (x1, x2) == (y1, y2)
        return cls._at(even_times(count), LINEAR if linear else (x1, y1, x2, y2))

    @classmethod
    def _at(cls, s: Floats, handles: tuple[float, float, float, float]) -> "Schedule":
        """Samples at parameters of the easing's curve."""
        if handles == LINEAR:
            return cls(s, s, LINEAR)
        x1, y1, x2, y2 = handles
        # Rounding must neither leave [0, 1] nor turn the clock back where it all but stands.
        clock = np.maximum.accumulate(np.clip(bezier_share(s, x1, x2), 0.0, 1.0))
        return cls(clock, np.clip(bezier_share(s, y1, y2), 0.0, 1.0), handles)

    def time_at(self, clock: Floats) -> Floats:
        """The movement's time when the player's clock shows any (M,), from 0 to 1."""
        return exact_shares(self.handles, clock)

    def finer(self) -> tuple["Schedule", Index]:
        """More samples near both ends, where an easing may be as steep as it likes.

        And which of them are the samples of this schedule. Read only.
        """
        return _finer(self)

    def with_corners(self, corners: Sequence[float]) -> tuple["Schedule", Index]:
        """More samples, at some moments of the clock and between those that are close.

        And which of them are the samples of this schedule.
        """
        ends = sorted({0.0, *corners, 1.0})
        more = [np.linspace(a, b, BETWEEN + 2) for a, b in pairwise(ends)]
        clock = np.unique(np.concatenate([self.clock, *more]))
        schedule = Schedule(clock, self.time_at(clock).copy(), self.handles)
        kept = np.searchsorted(clock, self.clock)
        schedule.time[kept] = self.time
        return schedule, kept

    def strided(self, stride: int) -> "Schedule":
        """Every so manieth sample."""
        return Schedule(self.clock[::stride], self.time[::stride], self.handles)

    @property
    def stops(self) -> list[int]:
        """Samples that must be keyframes, besides the ends, for `parts` to stay in their square.

        Notes
        -----
        The speed along either axis is a parabola that is nowhere negative; in Bernstein form over
        the whole its coefficients are a, b, c. A part that has its lowest point inside may have a
        negative b, and then a handle outside; no other part can.
        """
        x1, y1, x2, y2 = self.handles
        lowest = []
        for first, second in ((x1, x2), (y1, y2)):
            a, b, c = first, second - first, 1 - second
            if b < 0:
                lowest.append(round((a - b) / (a - 2 * b + c) * (len(self.time) - 1)))
        return sorted(set(lowest))

    def parts(self, picks: Index) -> Floats:
        """The easing between each two of the samples picked, (M - 1, 4), as handles x1 y1 x2 y2.

        Any part of a Bezier is a Bezier, and every coordinate is from 0 to 1 if the `stops` are
        among the picks.
        """
        s = picks / max(len(self.clock) - 1, 1)
        whole = np.array([0.0, 0.0, *self.handles, 1.0, 1.0]).reshape(1, 4, 2)
        curves = sub_curves(np.repeat(whole, len(s) - 1, axis=0), s[:-1], s[1:])
        start, size = curves[:, :1], curves[:, 3:] - curves[:, :1]
        inner = (curves[:, 1:3] - start) / np.where(size > 0, size, 1.0)
        return np.clip(inner, 0.0, 1.0).reshape(-1, 4)


@lru_cache(maxsize=4)  # all parts of a movement ask for the same
def _finer(schedule: Schedule) -> tuple[Schedule, Index]:
    steps = len(schedule.clock) - 1
    near = NEARER / steps
    inner = np.arange(1, steps) / steps
    s = np.concatenate([[0.0], near, inner, 1 - near[::-1], [1.0]])
    kept = np.concatenate([[0], len(near) + np.arange(1, steps), [len(s) - 1]])
    finer = Schedule._at(s, schedule.handles)
    for array in (finer.clock, finer.time, kept):
        array.setflags(write=False)
    return finer, kept
