"""Every letter and digit of a plain sans becomes every other one: stems stay stems."""

from itertools import combinations

import numpy as np

from shapetween.base.arrays import Curves, Floats, Index
from shapetween.geometry.bezier import evaluate
from shapetween.outline.body import Carried
from shapetween.pipeline import prepare
from tests.match.alphabet import GLYPHS, drawn

#: Every how many-th pair is moved here: all 630 take minutes.
EVERY = 9

TIMES = np.linspace(0, 1, 11)

#: Least length of a stem, of letters 19 tall, and greatest angle of its edge off straight, degrees.
STEM, STRAIGHT = 4.0, 2.0


def stems(curves: Curves) -> list[Index]:
    """Runs of one ring's curves, (F, P, 4, 2), that are upright straight edges at both ends."""
    ways = np.stack([curves[k, :, 3] - curves[k, :, 0] for k in (0, -1)])
    straight = np.abs(ways[..., 0]) <= 0.01 * np.abs(ways[..., 1]) + 1e-3
    upright = straight.all(axis=0) & (np.abs(ways[..., 1]) > 1e-9).all(axis=0)
    upright &= (ways[0, :, 1] * ways[1, :, 1]) > 0
    runs: list[list[int]] = [[]]
    for k in np.roll(np.arange(len(upright)), -int(np.argmin(upright))).tolist():
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


def kept(body: Carried) -> tuple[int, int]:
    """How many stems a movement keeps, of how many."""
    first, good, count = 0, 0, 0
    every = body.curves(TIMES)
    for size in body.counts:
        ring = every[:, first : first + size]
        first += size
        for run in stems(ring):
            count += 1
            good += bool(off_straight(ring[:, run]).max() <= STRAIGHT)
    return good, count


def test_stems_stay_stems_and_nothing_crosses() -> None:
    good = count = 0
    crossing = []
    for first, second in list(combinations(GLYPHS, 2))[::EVERY]:
        found = prepare(drawn(first), drawn(second))
        for part in found.filled:
            for body in part.bodies:
                if body.crossing and not body.seen.nothing:
                    crossing.append(first + second)
                some = kept(body)
                good, count = good + some[0], count + some[1]
    assert count >= 12
    assert good >= 0.9 * count, f"{good} of {count}"
    assert not crossing
