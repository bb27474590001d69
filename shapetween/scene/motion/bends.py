"""Where an outline bends: its corners, sharp or round, each with the run over which it turns."""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from shapetween.base.arrays import Floats, Index, Mask
from shapetween.geometry.bezier import end_tangents, evaluate
from shapetween.geometry.polygon import cross
from shapetween.scene.places import Places

__all__ = ["Bends", "bends_of"]

#: Greatest radius of a corner, as a share of the outline's extent. Larger, and a disc is all
#: corners; smaller, and the corners of a rounded box are part of its sides, which then wobble.
RADIUS = 0.2

#: Least angle of a corner, radians. Less, and the joints of a curve fitted by hand count as some.
LEAST = np.deg2rad(20.0)

#: Least kink between two curves that is no mere rounding of their coordinates, radians.
KINK = np.deg2rad(2.0)

#: Angle, radians, past which a round corner is several: the end of a bar is two right angles, as
#: it is where it is cut off square.
SEVERAL = np.deg2rad(130.0)

#: Least length of what is several corners, as a share of the outline's.
LONG = 0.01

#: Gap between runs that turn, as a share of the length, which does not divide a corner.
GAP = 1e-3

#: How much a place is seen that faces up, down or sideways on a round run. Less, and every such
#: place of a wave becomes one of the other's; more, and they count as corners do.
FACING = 0.02

#: Steps in which a curve's direction is looked at.
STEPS = 8

#: Angle, in quarters of a turn, that is rounding.
ROUNDING = 1e-6

#: Most corners of an outline that are told apart; the most visible ones. Time goes with the square.
MOST = 28

#: Length of the sides of a corner, as a share of the outline's, from which on it is fully seen.
SEEN = 0.06


@dataclass(frozen=True, slots=True, eq=False)
class Bends:
    """Corners of an outline in order.

    Attributes
    ----------
    starts, ends : (N,) float64
        Shares of the length between which each turns; equal where it is sharp.
    turns : (N,) float64
        By how much, radians.
    seen : (N,) float64
        How much each is seen, from 0 to its angle as a share of half a turn.
    facing : (N,) intp
        -1 for corners; of places on round runs that face up, down or sideways, which of these.
    """

    starts: Floats
    ends: Floats
    turns: Floats
    seen: Floats
    facing: Index

    def __len__(self) -> int:
        """How many there are."""
        return len(self.starts)

    @property
    def middles(self) -> Floats:
        """Shares of the length in the middle of each."""
        return np.asarray((self.starts + self.ends) / 2)

    def kept(self, index: Index) -> "Bends":
        """Some of them."""
        starts, ends, turns, seen = (
            values[index] for values in (self.starts, self.ends, self.turns, self.seen)
        )
        return Bends(starts, ends, turns, seen, self.facing[index])


def bends_of(places: Places) -> Bends:
    """The corners of an outline, whose curves may be of no length."""
    shares, angles = _turning(places)
    steps = np.diff(angles)
    ahead = np.diff(shares)
    points = places.outline.curves.reshape(-1, 2)
    extent = float(np.ptp(points, axis=0).max()) or 1.0
    least = places.length / (RADIUS * extent)
    quick = np.abs(steps) > np.where(ahead > 1e-6, least * ahead, KINK)
    runs: list[list[float]] = []
    for k in np.flatnonzero(quick).tolist():
        turn = float(steps[k])
        last = runs[-1] if runs else None
        if last and shares[k] - last[1] <= GAP and last[2] * turn > 0:
            last[1], last[2] = float(shares[k + 1]), last[2] + turn
        else:
            runs.append([float(shares[k]), float(shares[k + 1]), turn])
    if places.outline.closed and len(runs) > 1:
        first, last = runs[0], runs[-1]
        if first[0] + 1 - last[1] <= GAP and last[2] * first[2] > 0:
            last[1], last[2] = first[1] + 1, last[2] + first[2]
            runs = runs[1:]
    found: list[tuple[float, float, float]] = []
    for start, end, turn in runs:
        if abs(turn) < LEAST:
            continue
        several = abs(turn) > SEVERAL and end - start > LONG
        count = max(2, round(abs(turn) / (np.pi / 2))) if several else 1
        edges = np.linspace(start, end, count + 1).tolist() if several else (start, end)
        found += [(low, high, turn / count) for low, high in pairwise(edges)]
    rows = np.array(found).reshape(-1, 3)
    rows = rows[np.argsort(rows[:, 0], kind="stable")]
    starts, ends, turns = rows.T
    seen = np.abs(turns) / np.pi * _sides(places, starts, ends)
    at, facing = _faces(shares, angles, quick)
    corners = np.full(len(starts), -1)
    bends = Bends(
        np.concatenate([starts, at]),
        np.concatenate([ends, at]),
        np.concatenate([turns, np.zeros(len(at))]),
        np.concatenate([seen, np.full(len(at), FACING)]),
        np.concatenate([corners, facing]),
    )
    order = np.argsort(np.round(-bends.seen, 9), kind="stable")[:MOST]
    bends = bends.kept(order)
    return bends.kept(np.argsort(bends.middles, kind="stable"))


def _faces(shares: Floats, angles: Floats, quick: Mask) -> tuple[Floats, Index]:
    """Where round runs are level or upright, and which way: twice the quarter, and one of bays."""
    quarters = angles / (np.pi / 2)
    low, high = np.minimum(quarters[:-1], quarters[1:]), np.maximum(quarters[:-1], quarters[1:])
    whole = np.ceil(low - ROUNDING)
    some = (whole < high - ROUNDING) & (np.diff(shares) > 0) & ~quick
    part = (whole - quarters[:-1])[some] / np.diff(quarters)[some]
    at = shares[:-1][some] + np.clip(part, 0.0, 1.0) * np.diff(shares)[some]
    bays = np.diff(quarters)[some] < 0
    return at % 1.0, np.asarray(2 * (whole[some].astype(np.intp) % 4) + bays)


def _turning(places: Places) -> tuple[Floats, Floats]:
    """Shares of the length and the direction there, radians, which goes on past whole turns."""
    curves = places.outline.curves
    index = np.flatnonzero(np.ptp(curves, axis=1).max(axis=1) > 0)
    if not len(index):
        return np.zeros(1), np.zeros(1)
    some = curves[index]
    leaving, reaching = end_tangents(some)
    t = np.arange(STEPS + 1) / STEPS
    points = evaluate(some, t)
    chords = np.diff(points, axis=1)
    # The direction in the middle of a step is that of its chord; at the ends it is the curve's.
    ways = np.concatenate([leaving[:, None], chords, reaching[:, None]], axis=1)
    turns = np.arctan2(cross(ways[:, :-1], ways[:, 1:]), (ways[:, :-1] * ways[:, 1:]).sum(-1))
    middles = (t[:-1] + t[1:]) / 2
    at = np.concatenate([[0.0], middles, [1.0]])
    every = places.share(np.repeat(index, len(at)), np.tile(at, len(index))).reshape(-1, len(at))
    closed = places.outline.closed
    before = np.roll(reaching, 1, axis=0)
    kinks = np.arctan2(cross(before, leaving), (before * leaving).sum(-1))
    if not closed:
        kinks[0] = 0.0
    # Of each curve: the kink at its start, of no length, then its own turns.
    shares = np.concatenate([every[:, :1], every], axis=1).ravel()
    steps = np.concatenate([kinks[:, None], turns, np.zeros((len(index), 1))], axis=1).ravel()
    first = float(np.arctan2(leaving[0, 1], leaving[0, 0])) - float(kinks[0])
    return shares, first + np.concatenate([[0.0], np.cumsum(steps[:-1])])


def _sides(places: Places, starts: Floats, ends: Floats) -> Floats:
    """How long the shorter side of each corner is, as a share of what is fully seen."""
    if not len(starts):
        return np.zeros(0)
    if places.outline.closed:
        before, after = np.roll(ends, 1), np.roll(starts, -1)
        before[0] -= 1.0
        after[-1] += 1.0
    else:
        before, after = np.append(0.0, ends[:-1]), np.append(starts[1:], 1.0)
    middles = (starts + ends) / 2
    short = np.minimum(middles - before, after - middles)
    return np.clip(short / SEEN, 0.05, 1.0)
