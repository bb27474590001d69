"""The places where curves meet, and the parts of curves between them.

Where two runs of polygon sides join, their curves' chords meet; the curves themselves meet nearby,
at a place that Newton's method finds.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from shapetween.base.arrays import Curves, Floats, Index, Mask, Points
from shapetween.boolean.chords import Chords
from shapetween.geometry.bezier import derivatives, evaluate, line_curves, sub_curves
from shapetween.geometry.polygon import cross

__all__ = ["Run", "pieces"]

#: Distance, in units of the chords' flatness, by which the place where two curves meet may be off
#: where their chords do. Curves that meet at a small angle may be far off.
MOST_MOVED = 50.0

#: Distance, in the same unit, at which curves that follow one another join where their ends are.
AT_END = 5.0

#: Distance, in the same unit, at which two places are one. Chords are cut on a grid far finer.
SAME = 0.2

NEWTON_STEPS = 12

#: Longest step of Newton's method along a curve.
LONGEST_STEP = 0.1

#: Distance between points of two curves, in units of flatness, at which they are one.
MET = 1e-6

_THIRDS = np.linspace(0.0, 1.0, 4)[:, None]


@dataclass(frozen=True, slots=True)
class Run:
    """Polygon sides along one curve.

    Attributes
    ----------
    point : int
        The polygon's point where it starts.
    curve : int
        -1 for a side that is on no curve.
    arc : int
        The arc of the curve that it ends on.
    back : bool
        Whether it runs against the curve.
    start, end : float
        Parameters on the curve.
    """

    point: int
    curve: int = -1
    arc: int = -1
    back: bool = False
    start: float = 0.0
    end: float = 0.0


def pieces(runs: Sequence[Run], following: Index, points: Points, chords: Chords) -> Curves:
    """The part of its curve that each run stands for, each starting where the one before ends.

    Parameters
    ----------
    runs : sequence of Run
    following : (R,) intp
        The run after each run.
    points : (P, 2) float64
        Of the polygons.
    chords : Chords

    Returns
    -------
    (R, 4, 2) float64
        A single point, four times, where nothing is left of a run.
    """
    curve = np.array([run.curve for run in runs])
    on = curve >= 0
    own = chords.curves[np.where(on, curve, 0)]
    start = np.array([run.start for run in runs])
    end = np.array([run.end for run in runs])
    place = points[[run.point for run in runs]]
    flatness = np.ones(len(chords.curves))
    flatness[chords.curve] = chords.flatness
    near = flatness[np.where(on, curve, 0)]
    near = np.minimum(near, near[following])
    first = _Joints(own, own[following], end, start[following], place[following], near)
    first = first.at_ends(on, on[following])
    found = first.met(on & on[following])

    # A run that the places found turn round is so short that what its chords say must do.
    before = np.argsort(following)
    forward = np.array([not run.back for run in runs])
    turned = on & ((found.t > found.u[before]) != forward)
    keep = ~(turned | turned[following])
    ends = np.where(keep[:, None], found.place, first.place)
    t = np.where(keep, found.t, first.t)
    u = np.where(keep, found.u, first.u)[before]
    parts = sub_curves(own, u, t)
    parts[~on] = line_curves(ends[before], ends)[~on]
    flat = on & ((t > u) != forward)
    parts[flat] = line_curves(ends[before], ends)[flat]
    shift = np.stack([ends[before] - parts[:, 0], ends - parts[:, 3]], axis=1)
    parts += (1 - _THIRDS) * shift[:, :1] + _THIRDS * shift[:, 1:]
    parts[:, 0], parts[:, 3] = ends[before], ends
    return parts


@dataclass(frozen=True, slots=True, eq=False)
class _Joints:
    """Where the end of one curve's part meets the start of another's.

    Attributes
    ----------
    one, other : (J, 4, 2) float64
    t, u : (J,) float64
        Parameters on both.
    place : (J, 2) float64
    near : (J,) float64
        Flatness of the finer chords.
    """

    one: Curves
    other: Curves
    t: Floats
    u: Floats
    place: Points
    near: Floats

    def at_ends(self, one_is: Mask, other_is: Mask) -> "_Joints":
        """Joints moved to where a curve ends, if that is near; both ends, if they are one point."""
        at = np.round(self.t), np.round(self.u)
        ends = _own(self.one, at[0]), _own(self.other, at[1])
        off = [np.linalg.norm(end - self.place, axis=1) / self.near for end in ends]
        both = one_is & other_is & (ends[0] == ends[1]).all(axis=1) & (off[0] <= AT_END)
        first = both | (one_is & (off[0] <= SAME))
        second = both | (other_is & (off[1] <= SAME))
        place = np.where(second[:, None], ends[1], self.place)
        place = np.where(first[:, None], ends[0], place)
        t, u = np.where(first, at[0], self.t), np.where(second, at[1], self.u)
        return replace(self, t=t, u=u, place=place)

    def met(self, both: Mask) -> "_Joints":
        """Joints moved to where the curves really meet, which is looked for on `both`."""
        apart = (_own(self.one, self.t) != _own(self.other, self.u)).any(axis=1)
        moving = np.flatnonzero(both & apart)
        if not len(moving):
            return self
        curves = self.one[moving], self.other[moving]
        t, u = _meeting(*curves, self.t[moving], self.u[moving])
        found, there = _own(curves[0], t), _own(curves[1], u)
        near = self.near[moving]
        good = np.linalg.norm(found - there, axis=1) <= MET * near
        good &= np.linalg.norm(found - self.place[moving], axis=1) <= MOST_MOVED * near
        moved = replace(self, t=self.t.copy(), u=self.u.copy(), place=self.place.copy())
        moved.t[moving[good]] = t[good]
        moved.u[moving[good]] = u[good]
        moved.place[moving[good]] = found[good]
        return moved


def _meeting(one: Curves, other: Curves, t: Floats, u: Floats) -> tuple[Floats, Floats]:
    """Parameters at which pairs of curves meet, from where they nearly do, by Newton's method.

    What it returns for curves that touch, or do not meet, is no such place.
    """
    for _ in range(NEWTON_STEPS):
        gap = _own(one, t) - _own(other, u)
        ways = derivatives(one, t[:, None])[:, 0], derivatives(other, u[:, None])[:, 0]
        turn = cross(*ways)
        turn = np.where(turn != 0, turn, np.inf)  # no step where both run the same way
        with np.errstate(over="ignore"):  # steps of any length are cut
            steps = cross(gap, ways[1]) / turn, cross(gap, ways[0]) / turn
        t, u = (
            np.clip(p - np.clip(step, -LONGEST_STEP, LONGEST_STEP), 0.0, 1.0)
            for p, step in zip((t, u), steps, strict=True)
        )
    return t, u


def _own(curves: Curves, t: Floats) -> Points:
    """The point of each curve at its own parameter."""
    return evaluate(curves, t[:, None])[:, 0]
