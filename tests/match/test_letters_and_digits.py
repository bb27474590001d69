"""Every letter and digit of a plain sans becomes every other one: stems stay stems."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from shapetween.base.arrays import Curves, Floats, Index
from shapetween.deform.check import crossing_frames
from shapetween.geometry.bezier import evaluate
from shapetween.pipeline import Prepared, prepare
from tests.match.alphabet import GLYPHS, drawn

#: Every how many-th pair is moved here: all 630 take minutes.
EVERY = 9

TIMES = np.linspace(0, 1, 11)

#: Least length of a stem, of letters 19 tall, and greatest angle of its edge off straight, degrees.
STEM, STRAIGHT = 4.0, 2.0


def stems(curves: Curves, closed: bool = True) -> list[Index]:
    """Upright straight edges, at both ends, of a ring or a line, (F, P, 4, 2), as its curves."""
    ways = np.stack([curves[k, :, 3] - curves[k, :, 0] for k in (0, -1)])
    straight = np.abs(ways[..., 0]) <= 0.01 * np.abs(ways[..., 1]) + 1e-3
    upright = straight.all(axis=0) & (np.abs(ways[..., 1]) > 1e-9).all(axis=0)
    upright &= (ways[0, :, 1] * ways[1, :, 1]) > 0
    runs: list[list[int]] = [[]]
    start = int(np.argmin(upright)) if closed else 0
    for k in np.roll(np.arange(len(upright)), -start).tolist():
        turned = runs[-1] and ways[0, runs[-1][-1], 1] * ways[0, k, 1] < 0
        if not upright[k] or turned:
            runs.append([])
        if upright[k]:
            runs[-1].append(k)
    long = [np.array(run) for run in runs if run]
    return [run for run in long if np.abs(ways[:, run, 1].sum(axis=1)).min() > STEM]


def off_straight(curves: Curves) -> Floats:
    """How far the pieces of an edge, (F, P, 4, 2), are off its own direction, degrees, (F,)."""
    points = evaluate(curves, np.linspace(0, 1, 5))[:, :, :-1].reshape(len(curves), -1, 2)
    points = np.concatenate([points, curves[:, -1:, 3]], axis=1) @ [1, 1j]
    steps = np.diff(points, axis=1)
    whole = points[:, -1:] - points[:, :1]
    long = np.abs(steps) > 0.02 * np.abs(whole)
    return np.asarray(np.degrees(np.where(long, np.abs(np.angle(steps / whole)), 0.0).max(axis=1)))


def kept(every: Curves, counts: Sequence[int], closed: Sequence[bool]) -> tuple[int, int]:
    """How many stems rings and lines (F, P, 4, 2) keep on their way, of how many."""
    first, good, count = 0, 0, 0
    for size, whole in zip(counts, closed, strict=True):
        ring = every[:, first : first + size]
        first += size
        for run in stems(ring, whole):
            count += 1
            good += bool(off_straight(ring[:, run]).max() <= STRAIGHT)
    return good, count


@dataclass(frozen=True)
class Way:
    """Rings and lines (F, P, 4, 2) at all times, and whether one is seen to cross itself."""

    curves: Curves
    counts: Sequence[int]
    closed: Sequence[bool]
    crossing: bool


def ways(found: Prepared) -> list[Way]:
    """All that moves, whatever moves it: corners, what both have in common, lines, the engine."""
    result = []
    for part in found.filled:
        for body in part.bodies:
            crossing = bool(body.crossing) and not body.seen.nothing
            closed = [True] * len(body.counts)
            result.append(Way(body.curves(TIMES), body.counts, closed, crossing))
    for tracks in found.scene.tracks.values() if found.scene is not None else ():
        for track in tracks:
            if not track.areas:
                every = track.curves(TIMES)
                crossed = crossing_frames(every[1:-1], list(track.counts), list(track.closed))
                result.append(Way(every, track.counts, track.closed, bool(crossed.any())))
    return result


def test_stems_stay_stems_and_nothing_crosses() -> None:
    good = count = 0
    crossing = []
    for first, second in list(combinations(GLYPHS, 2))[::EVERY]:
        for way in ways(prepare(drawn(first), drawn(second))):
            if way.crossing:
                crossing.append(first + second)
            some = kept(way.curves, way.counts, way.closed)
            good, count = good + some[0], count + some[1]
    assert count >= 20
    assert good >= 0.9 * count, f"{good} of {count}"
    assert not crossing
