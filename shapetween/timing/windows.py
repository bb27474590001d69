"""Easings to choose among, each over the whole of a movement or over a window of it.

What comes or goes moves in a part of the time, and is still for the rest; what is carried along
meanwhile turns a corner there. Easings that know those times need no others to undo them.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import product
from typing import TypeAlias

import numpy as np

from shapetween.base.arrays import Floats
from shapetween.timing.easing import LINEAR, bezier_share

__all__ = ["Eased", "eased_shares", "exact_shares", "library", "turning_times"]

Handles: TypeAlias = tuple[float, float, float, float]

#: Handles of the easings to choose among. A finer set saves no easing on the pairs it was tried on;
#: a coarser one costs one or two.
HANDLES_X = (0.0, 0.2, 0.4, 0.6, 0.8, 1.0)
HANDLES_Y = (0.0, 0.5, 1.0)

#: What parts do that come and go: set off and arrive without a jerk, or go as a power of time, its
#: third, second or 2.4th, which is met to 2e-4. Over a window these are there besides all others,
#: however like one they are, for alone they take no further ones.
OWN = (
    (1 / 3, 0.0, 2 / 3, 1.0),
    (1 / 3, 0.0, 2 / 3, 0.0),
    (1 / 3, 1.0, 2 / 3, 1.0),
    (1 / 3, 0.0, 2 / 3, 1 / 3),
    (1 / 3, 2 / 3, 2 / 3, 1.0),
    (0.2525, 0.0, 0.6056, 0.0522),
    (0.3944, 0.9478, 0.7475, 1.0),
)

#: Easings that are nowhere farther apart than this are one: telling them apart needs displacements
#: so large that rounding them shows.
APART = 0.02

#: Halvings that solve an easing for its parameter, to a millionth of a share; and where places are
#: looked at so closely that they must not shake.
HALVINGS, EXACTLY = 24, 54

#: Easings at times that are remembered: parts that go together turn corners at the same times, and
#: all are looked at there. Fewer, and a thousand of them take half as long again; more is memory.
KNOWN = 256

#: Libraries at some times that are remembered, a megabyte each: the parts of a map that go together
#: all choose from the same. Fewer, and they are put together for each; more is memory.
RECENT = 6

#: Cells of the table from which Newton's method starts, its steps, and the halvings that they stand
#: in for. With fewer cells or steps, or more halvings, more is left to all of them.
CELLS, NEWTON, SKIPPED = 1024, 3, 44

#: Times within a movement at which it may turn a corner that are taken for windows' ends, the most
#: and those between which there are all easings, not just straight ones and `OWN`. More cost time
#: for each pair of them; with fewer, what goes piece by piece takes keyframes.
MOST_TURNS, OFTEN = 32, 2

#: By how much the acceleration changes at a corner, beside the greatest change there is, and where
#: corners are looked at closer. Smaller and bends are taken for corners.
SHARP, LOOKED = 0.3, 0.05

#: The least leap beside the tolerance: what comes or goes over so many tolerances' way is given a
#: window. Larger and short ways do without; smaller and bends are taken for corners.
OVERLOOKED = 16

#: Samples between corners at least. Fewer, and one corner is taken for two.
ASUNDER = 2

#: Steps around a corner that are looked at closer: with fewer, another beside it that from afar is
#: one with it is seen at the rim alone, where it is not.
AROUND = 3

#: How many times smaller the steps are by which corners are looked at closer, and the share of what
#: it was from afar by which a corner is one still: a little less than the square of that step, by
#: which what sets off as a third power is one too. Larger, and that is overlooked, and takes
#: keyframes; smaller, and all bends are corners.
NEARER, BEND = 8, 1 / 70

#: Share by which leaps may differ and be as good.
NEAR = 1e-6

#: What a leap must be beside its neighbours. More, and where something sets off it is overlooked if
#: it goes on a little faster; less, and beside a corner another is seen.
PEAK = 0.9

#: How many times less a leap must be within so many steps on one side. Less, and all that bends
#: has corners; more, and what sets off slowly has none.
LESS, SOON = 3.0, 4

#: Share of what it was by which a corner is no sharper from nearer. Between one and what steps
#: become less by.
BLUNT = 0.7

#: Decimals of a window's ends, shares of the whole: what is fast goes a tenth of a pixel meanwhile.
DECIMALS = 5

#: How a corner between samples is found: places looked at, and how often those next to the sharpest
#: are looked at closer at most, until it is known to its decimals: so near on either side.
CLOSER, ROUNDS, EXACT = 9, 12, 2e-5


@dataclass(frozen=True, slots=True)
class Eased:
    """An easing: its handles x1, y1, x2, y2, and the part of the time that it runs from 0 to 1 in.

    Before it is 0, and after it 1.
    """

    handles: Handles
    window: tuple[float, float] = (0.0, 1.0)


Library: TypeAlias = tuple[tuple[Eased, ...], Floats]
"""Easings, and what they are at some times, (S, L), read only."""


def eased_shares(easing: Eased, clock: Floats) -> Floats:
    """What an easing is at some times (S,)."""
    return np.asarray(_shares((easing.handles,), easing.window, clock)[:, 0])


def exact_shares(handles: Handles, clock: Floats) -> Floats:
    """What an easing over the whole is at some times (S,), to the last digits; read only.

    As `EXACTLY` halvings have it, the first of which Newton's method stands in for.
    """
    return _known_shares(handles, clock.tobytes())


@lru_cache(maxsize=KNOWN)
def _known_shares(handles: Handles, clock: bytes) -> Floats:
    x1, y1, x2, y2 = handles
    times = np.clip(np.frombuffer(clock, np.float64), 0.0, 1.0)
    s = np.interp(times, _abscissae(x1, x2), np.linspace(0.0, 1.0, CELLS + 1))
    for _ in range(NEWTON):
        r = 1 - s
        slope = 3 * (r * r * x1 + 2 * r * s * (x2 - x1) + s * s * (1 - x2))
        step = (bezier_share(s, x1, x2) - times) / np.where(slope > 0, slope, np.inf)
        s = np.clip(s - step, 0.0, 1.0)
    size = 2.0**-SKIPPED
    low = np.minimum(np.floor(s / size) * size, 1.0 - size)
    low = low - size * ((low > 0) & (bezier_share(low, x1, x2) >= times))
    low = low + size * ((low + size < 1) & (bezier_share(low + size, x1, x2) < times))
    within = ((low <= 0) | (bezier_share(low, x1, x2) < times)) & (
        (low + size >= 1) | (bezier_share(low + size, x1, x2) >= times)
    )
    s = _halved(x1, x2, times, EXACTLY - SKIPPED, low, size)
    if not within.all():  # where the easing stands, Newton's steps lead nowhere
        s[~within] = _halved(x1, x2, times[~within], EXACTLY)
    share = bezier_share(s, y1, y2)
    shares = np.where(times <= 0, 0.0, np.where(times >= 1, 1.0, share))
    shares.setflags(write=False)
    return shares


@lru_cache(maxsize=16)
def _abscissae(x1: float, x2: float) -> Floats:
    """Those of an easing at even parameters, not falling."""
    return np.maximum.accumulate(bezier_share(np.linspace(0.0, 1.0, CELLS + 1), x1, x2))


def _halved(
    x1: float | Floats,
    x2: float | Floats,
    times: Floats,
    halvings: int,
    start: float | Floats = 0.0,
    size: float = 1.0,
) -> Floats:
    """Parameters at which easings have some abscissae, by halving what begins at a start."""
    shape = np.broadcast_shapes(np.shape(x1), times.shape)
    low = np.broadcast_to(np.asarray(start), shape)
    high = low + size
    for _ in range(halvings):
        middle = (low + high) / 2
        before = bezier_share(middle, x1, x2) < times
        low, high = np.where(before, middle, low), np.where(before, high, middle)
    return np.asarray((low + high) / 2)


def _shares(handles: Sequence[Handles], window: tuple[float, float], clock: Floats) -> Floats:
    """What easings over a window are at some times (S,), (S, L)."""
    start, end = window
    times = np.clip((clock - start) / (end - start), 0.0, 1.0)[:, None]
    x1, y1, x2, y2 = np.array(handles).T
    # Many easings have the same abscissae, which are what takes the time.
    abscissae, which = np.unique(np.array([x1, x2]), axis=1, return_inverse=True)
    s = _halved(abscissae[0], abscissae[1], times, HALVINGS)
    share = bezier_share(s[:, which.ravel()], y1, y2)
    return np.asarray(np.where(times <= 0, 0.0, np.where(times >= 1, 1.0, share)))


def library(clock: Floats, turns: tuple[float, ...], *, own: bool = False) -> Library:
    """Easings over all windows between some times; of `own` ones only straight ones and `OWN`."""
    return _library(clock.tobytes(), turns, own)


@lru_cache(maxsize=RECENT)
def _library(clock: bytes, turns: tuple[float, ...], own: bool) -> Library:
    ends = sorted((0.0, *turns, 1.0))
    windows = [(a, b) for a, b in product(ends, ends) if a < b]
    windows.sort(key=lambda window: window[0] - window[1])
    often: set[float] = set() if own else {0.0, *turns[:OFTEN], 1.0}
    tables = [_table(clock, window, often.issuperset(window)) for window in windows]
    choices = tuple(choice for table in tables for choice in table[0])
    shares = np.concatenate([table[1] for table in tables], axis=1)
    shares.setflags(write=False)
    return choices, shares


def turning_times(
    points: Floats,
    clock: Floats,
    tolerance: float,
    look: Callable[[Floats], Floats] | None = None,
    least: float = LOOKED,
) -> tuple[float, ...]:
    """When points (S, K, 2) at times (S,) set off, stop or turn a corner, the sharpest first.

    A corner is where the acceleration leaps, or the speed: more than it does on either side, and by
    more than can be overlooked.

    Parameters
    ----------
    points, clock, tolerance
    look : callable, optional
        Where points are at any times (M,), (M, P, 2), to find out when between two samples it is.
    least : float
        By how much the acceleration changes at a corner that is looked at closer.
    """
    gaps = np.diff(clock)
    even = gaps.max(initial=0.0)
    # Samples near both ends are closer, and tell nothing of corners in between.
    inner = np.flatnonzero(np.concatenate([[True], gaps > even / 16]))
    times, places = clock[inner], points[inner]
    if len(times) < 2 * ASUNDER + 1:
        return ()
    leaps, bends = (seen * even**2 for seen in _leaps(times, places))
    sharp = SHARP if look is None else least
    enough = max(sharp * float(leaps.max(initial=0.0)), tolerance / OVERLOOKED)
    found = _corners(times, leaps, bends, enough)
    if look is not None and found:
        at = times[2:-2]
        sharpness = [float(leaps[int(np.abs(at - time).argmin())]) for time in found]
        found = _closer(found, sharpness, even, tolerance, look)
    return tuple(round(time, DECIMALS) for time in found[:MOST_TURNS])


def _corners(times: Floats, leaps: Floats, bends: Floats, enough: float) -> list[float]:
    """Where leaps are great enough at times but two at either end, some samples from each other.

    And about the greatest among their neighbours: beside a corner one is seen that is not there.
    """
    at, even = times[2:-2], float(np.diff(times).max())
    around = np.pad(leaps, 1)
    peaks = leaps >= PEAK * np.maximum(around[:-2], around[2:])
    found: list[float] = []
    # The greatest first; of those alike where it bends most, and then the first.
    keys = (np.round(leaps / enough, 3), np.round(bends / enough, 3))
    for k in np.lexsort((-keys[1], -keys[0])).tolist():
        if leaps[k] < enough or len(found) == MOST_TURNS:
            break
        if peaks[k] and all(abs(at[k] - other) >= (ASUNDER + 0.5) * even for other in found):
            found.append(float(at[k]))
    return found


def _standing_out(leaps: Floats, ends: tuple[bool, bool]) -> Floats:
    """Leaps where on some side they soon are much less, 0 elsewhere: what bends evenly does not.

    `ends` tells whether the movement ends where they do; else what is beyond is not known, and the
    outermost are none.
    """
    around = np.pad(leaps, SOON, constant_values=np.inf)
    sides = np.lib.stride_tricks.sliding_window_view(around, SOON).min(axis=1)
    less = np.minimum(sides[: len(leaps)], sides[SOON + 1 :])
    known = np.ones(len(leaps), bool)
    known[[0, -1]] = ends
    return np.where(known & (less * LESS <= leaps), leaps, 0.0)


def _closer(
    times: Sequence[float],
    sharpness: Sequence[float],
    width: float,
    tolerance: float,
    look: Callable[[Floats], Floats],
) -> list[float]:
    """When corners are that lie within a width of some times, each maybe two close together.

    Seen from nearer a corner of the speed is as sharp, one of the acceleration as much less as the
    steps are smaller, and where a third power sets off by the square of that; a bend by more.
    """
    step = width / NEARER
    looked = np.array(times)[:, None] + step * np.arange(-AROUND * NEARER, AROUND * NEARER + 1)
    looked = np.clip(looked, 0.0, 1.0)
    places = look(looked.ravel()).reshape(*looked.shape, -1, 2)
    found: list[float] = []
    for own, there, sharp in zip(looked, places, sharpness, strict=True):
        first = np.flatnonzero(np.append(True, own[1:] > own[:-1]))
        own = own[first]
        if len(own) <= NEARER:
            continue
        leaps, bends = (seen * step * width for seen in _leaps(own, there[first]))
        enough = max(BEND * sharp, tolerance / OVERLOOKED / NEARER / 2)
        ends = bool(own[0] == 0), bool(own[-1] == 1)
        near = _corners(own, _standing_out(leaps, ends), bends, enough)
        found += [t for t in near if all(abs(t - other) > 2 * step for other in found)]
    return _exactly(np.array(found), 2 * step, look) if found else []


def _exactly(times: Floats, width: float, look: Callable[[Floats], Floats]) -> list[float]:
    """When corners near some times (T,) are, each within half a width of its own.

    Where it is sharpest at the rim of what is looked at, that is moved along, and else narrowed, as
    long as it is as sharp from nearer: where a third power sets off it is less and less.
    """
    around = np.linspace(-1.0, 1.0, CLOSER)
    widths, sharpest = np.full(len(times), width), np.zeros(len(times))
    for _ in range(ROUNDS):
        left = np.flatnonzero(widths > EXACT)
        if not len(left):
            break
        times[left] = np.clip(times[left], widths[left], 1 - widths[left])
        looked = times[left, None] + widths[left, None] * around
        places = look(looked.ravel()).reshape(len(left), CLOSER, -1, 2)
        every, _ = _leaps(looked, places)
        for k, own, leaps in zip(left.tolist(), looked, every, strict=True):
            if leaps.max() < BLUNT * sharpest[k]:
                widths[k] = 0.0
                continue
            sharpest[k] = leaps.max()
            # As good ones side by side count as one, whose middle it is.
            best = np.flatnonzero(leaps >= leaps.max() * (1 - NEAR))
            best = best[: int(np.append(np.diff(best) > 1, True).argmax()) + 1]
            now, before = float(own[2:-2][best].mean()), times[k]
            times[k] = now
            rim = best[0] == 0 or best[-1] == len(leaps) - 1
            if not rim or abs(np.clip(now, widths[k], 1 - widths[k]) - before) < widths[k] / CLOSER:
                widths[k] *= 1.5 / (CLOSER // 2)
    return list(times.tolist())


def _leaps(times: Floats, places: Floats) -> tuple[Floats, Floats]:
    """How far the acceleration leaps at all times but two at either end, and what it is.

    Of times (..., S) and places (..., S, K, 2) then, each (..., S - 4). What is before a sample and
    after it, where the acceleration leaps; and where the speed does, what it is there beside both.
    """
    speeds = places[..., 1:, :, :] - places[..., :-1, :, :]
    speeds /= np.diff(times)[..., None, None]
    middles = (times[..., 1:] + times[..., :-1]) / 2
    accelerations = speeds[..., 1:, :, :] - speeds[..., :-1, :, :]
    accelerations /= np.diff(middles)[..., None, None]
    before, here, after = (accelerations[..., k : k - 2 or None, :, :] for k in (0, 1, 2))
    leaps = np.maximum(_longest(after - before), _longest(2 * here - before - after))
    return leaps, _longest(here)


def _longest(vectors: Floats) -> Floats:
    """The greatest length at each time, (..., K, 2) to (...)."""
    x, y = vectors[..., 0], vectors[..., 1]  # sums along short axes are slow
    return np.asarray(np.sqrt((x * x + y * y).max(axis=-1)))


@lru_cache(maxsize=256)
def _table(clock: bytes, window: tuple[float, float], every: bool) -> Library:
    """Easings over one window, all or few, and what they are at times."""
    times = np.frombuffer(clock, np.float64)
    whole = window == (0.0, 1.0) and every
    handles = (*(_handles() if every else (LINEAR,)), *(() if whole else OWN))
    choices = tuple(Eased(each, window) for each in handles)
    shares = _shares(handles, window, times)
    shares.setflags(write=False)
    return choices, shares


@lru_cache(maxsize=1)
def _handles() -> tuple[Handles, ...]:
    """Easings no two of which are alike."""
    choices = [LINEAR]
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
