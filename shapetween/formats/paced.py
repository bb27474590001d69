"""Paces that no format has by itself, put into the movement, so that every format shows them.

A spring, an easing that overshoots or runs in pieces, parts that set off one after another, and one
easing over a whole chain: each part is given a clock of its own, and the format an even one.
"""

from dataclasses import replace
from itertools import pairwise

import numpy as np

from shapetween.base.arrays import Floats
from shapetween.base.errors import OptionError
from shapetween.formats.options import WriteOptions
from shapetween.formats.segments import Segments
from shapetween.model.movement import Movement
from shapetween.timing import defaults
from shapetween.timing.easing import Easing, easing_function, is_plain

__all__ = ["paced"]

#: Share of the view box by which places are told apart where parts are ordered: less is one place,
#: whatever the last bit is.
APART = 1e-6

#: Moments of a chain among which those are looked for at which one leg passes on to the next.
MOMENTS = 10_001


def paced(segments: Segments, options: WriteOptions) -> tuple[Segments, WriteOptions]:
    """The same with a plain easing and no staggering, which are in the movements instead.

    Raises
    ------
    OptionError
        If one easing over all of a chain is asked for, and there is no chain.
    """
    if options.easing_over == "chain":
        if len(segments.movements) == 1:
            raise OptionError("easing_over: changes nothing, for there is one way alone")
        segments = _over_the_chain(segments, options)
        options = replace(options, easing=defaults.EASING, easing_over="leg")
    if options.stagger == 0 and is_plain(options.easing):
        return segments, options
    ease = easing_function(options.easing)
    ranks = [_ranks(movement, options.stagger_by) for movement in segments.movements]
    last = max((rank for each in ranks for rank in each), default=0)
    way = options.duration + options.stagger * last
    movements = []
    for movement, each in zip(segments.movements, ranks, strict=True):
        starts = [rank * options.stagger / way for rank in each]
        share = options.duration / way
        parts = [
            part.retimed(_windowed(ease, start, min(start + share, 1.0)))
            for part, start in zip(movement.parts, starts, strict=True)
        ]
        movements.append(replace(movement, parts=tuple(parts)))
    ways = tuple(each * way / options.duration for each in segments.ways)
    return (
        replace(segments, movements=tuple(movements), ways=ways),
        replace(options, easing=defaults.EASING, duration=way, stagger=0.0, stagger_by="order"),
    )


def _windowed(ease: Easing, start: float, end: float) -> Easing:
    """An easing that is run through between two moments."""
    if (start, end) == (0.0, 1.0):
        return ease
    return lambda u: ease(np.clip((np.asarray(u) - start) / (end - start), 0.0, 1.0))


def _ranks(movement: Movement, by: str) -> list[int]:
    """Place of each part among those that set off one after another.

    What belongs together shares it. What stands still takes no place.
    """
    box = movement.box
    size = max(box.width, box.height)
    middle = np.array([box.x + box.width / 2, box.y + box.height / 2])
    keys: list[object | None] = []
    named: dict[str, object] = {}
    for part in movement.parts:
        ends = part.curves(np.array([0.0, 0.5, 1.0])).reshape(3, -1, 2)
        if np.ptp(ends, axis=0).max() <= APART * size and part.style(0.0) == part.style(1.0):
            keys.append(None)
            continue
        low, high = ends[0].min(axis=0), ends[0].max(axis=0)
        box_key = tuple(np.rint(np.concatenate([low, high]) / (APART * size)).astype(int).tolist())
        if by == "distance":
            away = float(np.linalg.norm((low + high) / 2 - middle))
            keys.append(round(away / (APART * size)))
        elif by == "left":
            keys.append(box_key[0])
        else:
            keys.append(named.setdefault(part.name, box_key) if part.name else box_key)
    known = [key for key in dict.fromkeys(keys) if key is not None]
    if by != "order":
        known.sort()
    place = {key: k for k, key in enumerate(known)}
    return [0 if key is None else place[key] for key in keys]


def _over_the_chain(segments: Segments, options: WriteOptions) -> Segments:
    """Legs whose lengths and paces are those of one easing over all of them."""
    count = len(segments.movements)
    ease = easing_function(options.easing)
    clock = np.linspace(0.0, 1.0, MOMENTS)
    reached = np.maximum.accumulate(ease(clock)) * count
    edges = [0.0, *(float(clock[np.argmax(reached >= k)]) for k in range(1, count)), 1.0]
    movements = []
    for k, movement in enumerate(segments.movements):
        pace = _part_of(ease, edges[k], edges[k + 1], k, count)
        parts = tuple(part.retimed(pace) for part in movement.parts)
        movements.append(replace(movement, parts=parts))
    ways = tuple((b - a) * count * options.duration for a, b in pairwise(edges))
    return replace(segments, movements=tuple(movements), ways=ways)


def _part_of(ease: Easing, start: float, end: float, leg: int, count: int) -> Easing:
    """One leg's share of an easing over a chain; at both ends it is there exactly."""

    def pace(u: Floats) -> Floats:
        clock = np.asarray(u, np.float64)
        times = ease(start + (end - start) * clock) * count - leg
        return np.asarray(np.where(clock <= 0, 0.0, np.where(clock >= 1, 1.0, times)))

    return pace
