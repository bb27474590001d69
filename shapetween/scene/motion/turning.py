"""Total turning of an outline, and what its in-between forms turn beyond both ends."""

from dataclasses import dataclass

import numpy as np

from shapetween.base.arrays import Curves
from shapetween.deform.check import LOOKED, crossing_frames
from shapetween.geometry.bezier import evaluate
from shapetween.model.part import CurveTrack

__all__ = ["MOST_TURNS", "TurningExcess", "total_turning", "turning_excess"]

#: Most turning, in whole turns, of an outline whose corners say how it moves. More, and it has
#: limbs, which swing: that is the outline engine's.
MOST_TURNS = 4.3

#: Turning, in whole turns, that in-between forms may have beyond both ends and still be smooth:
#: half a corner. More, and waves that neither end has are let pass; less, and a corner that is
#: born from a round run is held to be one.
MOST_EXCESS = 0.12

#: Times at which turning is looked at, the ends first and last.
TURNING = np.array([0.0, 0.25, 0.5, 0.75, 1.0])

#: Steps of equal length in which turning is measured: less than an outline's own corners need
#: would round them off, and many more would count what nobody sees.
STEPS = 256


@dataclass(frozen=True, slots=True)
class TurningExcess:
    """What was seen of an outer ring on its way.

    Attributes
    ----------
    turns : float
        By how much the ends turn in all, in whole turns; that of the one which turns more.
    excess : float
        By how much in-between forms turn beyond that; negative if they turn less.
    crossing : bool
        Whether it crosses itself; not looked at where the ends turn by more than `MOST_TURNS`.
    """

    turns: float
    excess: float
    crossing: bool

    @property
    def simple(self) -> bool:
        """Whether the ends are simple enough for their corners to say how they move."""
        return self.turns <= MOST_TURNS and not self.crossing

    @property
    def smooth(self) -> bool:
        """Whether nothing is to be seen on the way that is in neither end."""
        return self.simple and self.excess <= MOST_EXCESS


def turning_excess(track: CurveTrack) -> TurningExcess:
    """How a track's outer ring turns on its way."""
    count = track.counts[0]
    curves = track.curves(TURNING)[:, :count]
    turns = np.round([total_turning(ring) for ring in curves], 6)
    ends = float(max(turns[0], turns[-1]))
    crossing = ends <= MOST_TURNS and bool(
        crossing_frames(track.curves(LOOKED)[:, :count], [count], [True]).any()
    )
    return TurningExcess(ends, float(turns[1:-1].max()) - ends, crossing)


def total_turning(curves: Curves, *, closed: bool = True) -> float:
    """All turning of a ring or a line (P, 4, 2), either way, in whole turns."""
    points = evaluate(curves, np.arange(8) / 8).reshape(-1, 2)
    points = np.concatenate([points, points[:1] if closed else curves[-1, 3:]])
    along = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))])
    even = along[-1] * np.arange(STEPS + 1) / STEPS
    x, y = (np.diff(np.interp(even, along, axis)) for axis in points.T)
    angle = np.arctan2(y, x)
    if closed:
        angle = np.append(angle, angle[0])
    turn = (np.diff(angle) + np.pi) % (2 * np.pi) - np.pi
    return float(np.abs(turn).sum() / (2 * np.pi))
