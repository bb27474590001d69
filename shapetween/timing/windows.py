"""Easings to choose among, each over the whole of a movement or over a window of it.

What comes or goes moves in a part of the time, and is still for the rest; what is carried along
meanwhile turns a corner there. Easings that know those times need no others to undo them.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import product
from typing import TypeAlias

import numpy as np

from shapetween.base.arrays import Floats
from shapetween.timing.easing import bezier_share

__all__ = ["Eased", "eased_shares", "library", "turning_times"]

Handles: TypeAlias = tuple[float, float, float, float]

#: Handles of the easings to choose among. A finer set saves no easing on the pairs it was tried on;
#: a coarser one costs one or two.
HANDLES_X = (0.0, 0.2, 0.4, 0.6, 0.8, 1.0)
HANDLES_Y = (0.0, 0.5, 1.0)

#: What parts do that come and go: set off and arrive without a jerk, or go as a power of time. Over
#: a window these are there besides all others, however like one they are, for alone they take no
#: further ones.
OWN = (
    (1 / 3, 0.0, 2 / 3, 1.0),
    (1 / 3, 0.0, 2 / 3, 0.0),
    (1 / 3, 1.0, 2 / 3, 1.0),
    (1 / 3, 0.0, 2 / 3, 1 / 3),
    (1 / 3, 2 / 3, 2 / 3, 1.0),
)

#: Easings that are nowhere farther apart than this are one: telling them apart needs displacements
#: so large that rounding them shows.
APART = 0.02

#: Halvings that solve an easing for its parameter: to a millionth of a share.
HALVINGS = 24

#: Times within a movement at which it may turn a corner that are taken for windows' ends. More cost
#: time for each pair of them, and windows that are half right help little.
MOST_TURNS = 2

#: By how much the acceleration changes at a corner, beside the greatest change there is. Smaller
#: and bends are taken for corners.
SHARP = 0.3

#: The least leap beside the tolerance: what comes or goes over so many tolerances' way is given a
#: window. Larger and short ways do without; smaller and bends are taken for corners.
OVERLOOKED = 16

#: Samples between corners at least.
ASUNDER = 4

#: Decimals of a window's ends, shares of the whole.
DECIMALS = 4


@dataclass(frozen=True, slots=True)
class Eased:
    """An easing: its handles x1, y1, x2, y2, and the part of the time that it runs from 0 to 1 in.

    Before it is 0, and after it 1.
    """

    handles: Handles
    window: tuple[float, float] = (0.0, 1.0)


def eased_shares(easing: Eased, clock: Floats) -> Floats:
    """What an easing is at some times (S,)."""
    return np.asarray(_shares((easing.handles,), easing.window, clock)[:, 0])


def _shares(handles: Sequence[Handles], window: tuple[float, float], clock: Floats) -> Floats:
    """What easings over a window are at some times (S,), (S, L)."""
    start, end = window
    times = np.clip((clock - start) / (end - start), 0.0, 1.0)[:, None]
    x1, y1, x2, y2 = np.array(handles).T
    # Many easings have the same abscissae, which are what takes the time.
    abscissae, which = np.unique(np.array([x1, x2]), axis=1, return_inverse=True)
    x1, x2 = abscissae
    low, high = np.zeros((len(clock), len(x1))), np.ones((len(clock), len(x1)))
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        before = bezier_share(middle, x1, x2) < times
        low, high = np.where(before, middle, low), np.where(before, high, middle)
    share = bezier_share(((low + high) / 2)[:, which.ravel()], y1, y2)
    return np.asarray(np.where(times <= 0, 0.0, np.where(times >= 1, 1.0, share)))


def library(clock: Floats, turns: tuple[float, ...]) -> tuple[tuple[Eased, ...], Floats]:
    """All easings over all windows between some times, and what they are at others (S,), (S, L)."""
    ends = (0.0, *turns, 1.0)
    windows = [(a, b) for a, b in product(ends, ends) if a < b]
    windows.sort(key=lambda window: window[0] - window[1])
    tables = [_table(clock.tobytes(), window) for window in windows]
    choices = tuple(choice for table in tables for choice in table[0])
    return choices, np.concatenate([table[1] for table in tables], axis=1)


def turning_times(points: Floats, clock: Floats, tolerance: float) -> tuple[float, ...]:
    """When points (S, K, 2) at times (S,) set off, stop or turn a corner, few at most.

    A corner is where the acceleration leaps, or the speed: more than it does on either side, and by
    more than can be overlooked.
    """
    gaps = np.diff(clock)
    even = gaps.max(initial=0.0)
    # Samples near both ends are closer, and tell nothing of corners in between.
    inner = np.flatnonzero(np.concatenate([[True], gaps > even / 16]))
    times, places = clock[inner], points[inner]
    if len(times) < 2 * ASUNDER + 1:
        return ()
    steps = np.diff(times)[:, None, None]
    speeds = np.diff(places, axis=0) / steps
    middles = (times[1:] + times[:-1]) / 2
    accelerations = np.diff(speeds, axis=0) / np.diff(middles)[:, None, None]
    # What is before a sample and after it, where the acceleration leaps; and where the speed does,
    # what it is there beside both.
    before, here, after = accelerations[:-2], accelerations[1:-1], accelerations[2:]
    leaps = np.maximum(_longest(after - before), _longest(2 * here - before - after)) * even**2
    at = times[2:-2]
    found: list[float] = []
    enough = max(SHARP * float(leaps.max(initial=0.0)), tolerance / OVERLOOKED)
    # The greatest first; of those alike the first.
    for k in np.argsort(-np.round(leaps / enough, 6), kind="stable").tolist():
        if leaps[k] < enough or len(found) == MOST_TURNS:
            break
        if all(abs(at[k] - other) >= ASUNDER * even for other in found):
            found.append(float(at[k]))
    return tuple(sorted(round(time, DECIMALS) for time in found))


def _longest(vectors: Floats) -> Floats:
    """The greatest length at each time, (S, K, 2) to (S,)."""
    return np.asarray(np.sqrt((vectors**2).sum(-1)).max(axis=1))


@lru_cache(maxsize=64)
def _table(clock: bytes, window: tuple[float, float]) -> tuple[tuple[Eased, ...], Floats]:
    """Easings over one window, and what they are at times."""
    times = np.frombuffer(clock, np.float64)
    handles = _handles() if window == (0.0, 1.0) else (*_handles(), *OWN)
    choices = tuple(Eased(each, window) for each in handles)
    shares = _shares(handles, window, times)
    shares.setflags(write=False)
    return choices, shares


@lru_cache(maxsize=1)
def _handles() -> tuple[Handles, ...]:
    """Easings no two of which are alike."""
    choices = [(1 / 3, 1 / 3, 2 / 3, 2 / 3)]
    choices += [
        (x1, y1, x2, y2)
        for x1, y1, x2, y2 in product(HANDLES_X, HANDLES_Y, HANDLES_X, HANDLES_Y)
        if y1 <= y2 or x1 <= x2
    ]
    shapes = _shares(choices, (0.0, 1.0), np.linspace(0, 1, 101)).T
    kept = [0]
    for k in range(1, len(choices)):
        if np.abs(shapes[kept] - shapes[k]).max(axis=1).min() > APART:
            kept.append(k)
    return tuple(choices[k] for k in kept)
