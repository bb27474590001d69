"""A shape that moves, as animations of its path data.

Where the movement is smooth it is a sum of easings (`shapetween.timing.sums`): the first animation
runs from the first place to another, and replaces what the path holds at rest; the others add to
it. So the numbers at rest take no part in it, and a program that rewrites them changes nothing.
Else, and where a number of keyframes is asked for, one animation runs through keyframes.
"""

from dataclasses import dataclass, replace
from functools import cache

import numpy as np

from shapetween.base.arrays import Floats
from shapetween.geometry.merging import merged_curves
from shapetween.model.part import Part, shown_while
from shapetween.svg.write.clock import Clock
from shapetween.svg.write.paths import Grid, PathForm, on_grid, straight_curves
from shapetween.timing.sums import EasingSum, sum_of_easings
from shapetween.timing.windows import turning_times

__all__ = ["ShapeMotion", "shape_motion"]

#: How far a handle may be from the chord of a curve that is written as a line, for the tolerance of
#: points: less than half of it. Larger and curves that bulge on the way are flattened.
STRAIGHT = 0.45

#: How far a point may be from its place where curves become one, for the tolerance of points.
#: Larger and both together are seen; smaller and curves stay two that nobody can tell from one.
MERGED = 0.25

#: How far a handle may be off for a point of the outline: no point of a curve moves by more than
#: three quarters of what both of its handles do.
HANDLE = 0.75

#: Share of the last decimal below which nothing moves: rounding hides it.
STILL = 0.25

#: Bytes of a keyframe and of one more animation besides path data, and the data of a sum's term
#: beside that of a keyframe. They only decide between the two, whichever file is smaller.
KEYFRAME, ANIMATION, TERM = 8, 130, 0.5

#: Curves of all keyframes of a path that are written, about 30 bytes each, before keyframes become
#: fewer by ever looser tolerances; but so many keyframes there are. More and browsers stall on it.
MOST_WRITTEN, LEAST_KEYFRAMES, LOOSER = 300_000, 9, 1.5

#: Curves of all samples that are held at once, and the strides of samples that may be left out for
#: it: parts of the steps on which keyframes may lie.
MOST_SAMPLED, STRIDES = 1_500_000, (2, 3, 4, 5, 6)

#: Curves of all samples past which no corners of the movement are looked for: to find out when they
#: are it is sampled hundreds of times more. More takes minutes and gigabytes; with fewer, drawings
#: whose pieces go one after another take many more easings.
MOST_LOOKED = 100_000


#: Control points that are looked at for when they turn a corner: some of more, and those only at
#: the samples. More take seconds; with fewer a corner that few of them turn is not found.
MOST_LOOKED = 10_000


@dataclass(frozen=True, slots=True)
class ShapeMotion:
    """Path data at rest, and the attributes of the animations that move it, often none."""

    rest: str
    animations: tuple[dict[str, str], ...]


def shape_motion(part: Part, clock: Clock, decimals: int, tolerance: float) -> ShapeMotion:
    """How a part moves.

    Parameters
    ----------
    part : Part
    clock : Clock
    decimals : int
        Of coordinates.
    tolerance : float
        How far points may be off on the way, in user units.
    """
    clock = _for_so_many(clock, sum(part.rings))
    step = 10.0**-decimals
    finer, kept = clock.schedule.finer()
    seen = shown_while(part) if clock.adaptive else (0.0, 1.0)

    def places(clock: Floats) -> Floats:
        curves = part.curves(np.clip(finer.time_at(clock), *seen))
        return curves.reshape(len(clock), -1, 2)

    stack, rings = part.curves(np.clip(finer.time, *seen)), part.rings
    turns: tuple[float, ...] = ()
    if clock.adaptive and stack[:, :, 0, 0].size <= MOST_LOOKED:
        every = stack.reshape(len(stack), -1, 2)
        apart = 1 + every.shape[1] // MOST_LOOKED
        nearer = places if apart == 1 else None
        turns = turning_times(every[:, ::apart], finer.clock, tolerance, nearer)
        if turns:
            finer, own = finer.with_corners(turns)
            kept = own[kept]
            stack = part.curves(np.clip(finer.time, *seen))
        stack, rings = merged_curves(stack, rings, MERGED * tolerance, step / 2)
    form = PathForm.of(rings, part.closed, straight_curves(stack, STRAIGHT * tolerance, step))
    points = form.points(stack)
    first = on_grid(points[:1], decimals)
    rest = form.texts(first, decimals)[0]
    if np.ptp(points, axis=0).max(initial=0.0) <= STILL * step:
        return ShapeMotion(rest, ())
    importance = np.where(form.handles, HANDLE, 1.0)
    if clock.adaptive:

        @cache
        def most() -> int:
            return _terms_of_use(len(rest), clock.keyframes_needed(points[kept], tolerance))

        late = seen != (0.0, 1.0)
        found = sum_of_easings(
            points, finer.clock, step, tolerance, importance, most, turns, late=late
        )
        if found is not None:
            return ShapeMotion(rest, _summed(found, first, form, clock, decimals))
    points = points[kept]
    moments, values, easing = _keyframes(points, importance, clock, tolerance)
    texts = form.texts(on_grid(values, decimals), decimals)
    if len(set(texts)) == 1:
        return ShapeMotion(rest, ())
    running = clock.running(moments, texts, easing)
    return ShapeMotion(rest, tuple({"attributeName": "d", **timing} for timing in running))


def _terms_of_use(length: int, keyframes: int) -> int:
    """How many easings take fewer bytes than so many keyframes of some length each."""
    return int((keyframes - 2) * (length + KEYFRAME) / (ANIMATION + TERM * length)) + 1


def _summed(
    found: EasingSum, first: Grid, form: PathForm, clock: Clock, decimals: int
) -> tuple[dict[str, str], ...]:
    """The animations of a sum of easings; the first replaces, and the others add."""
    rest, *_ = form.texts(first, decimals)
    start, *added = form.texts(np.concatenate([first + found.terms[:1], found.terms[1:]]), decimals)
    head, *tail = found.easings
    ways = [[{"attributeName": "d", **timing}] for timing in clock.eased(head, rest, start)]
    alone = form.texts(found.terms[:1], decimals)[0]
    if clock.is_one_way and len(alone) + ANIMATION < len(start):
        # What stays is told once: it is set, and all that moves adds to it.
        ways, tail, added = (
            [[{"attributeName": "d", "to": rest}]],
            list(found.easings),
            [alone, *added],
        )
    # All of one way together: what sets off with the first, which replaces, adds to it.
    zero = form.zero()
    for easing, text in zip(tail, added, strict=True):
        for way, timing in zip(ways, clock.eased(easing, zero, text), strict=True):
            if clock.is_one_way and timing["values"].count(";") == 1:
                del timing["values"]
                timing["by"] = text
            way.append({"attributeName": "d", "additive": "sum", **timing})
    return tuple(attributes for way in ways for attributes in way)


def _keyframes(
    points: Floats, importance: Floats, clock: Clock, tolerance: float
) -> tuple[Floats, Floats, Floats | None]:
    """Keyframes, fewer by looser tolerances where there would be too much to write."""
    weighed = points * importance[:, None]
    moments, values, easing = clock.fitted(weighed, tolerance)
    most = max(LEAST_KEYFRAMES, MOST_WRITTEN * 3 // max(points.shape[1], 1))
    while clock.adaptive and len(moments) > most:
        tolerance *= LOOSER
        moments, values, easing = clock.fitted(weighed, tolerance)
    return moments, values / importance[:, None], easing


def _for_so_many(clock: Clock, count: int) -> Clock:
    """The clock with fewer samples, where so many curves at all of them would not fit in memory."""
    steps = len(clock.schedule.time) - 1
    if not clock.adaptive or steps * count <= MOST_SAMPLED:
        return clock
    stride = next(k for k in STRIDES if steps * count <= k * MOST_SAMPLED or k == STRIDES[-1])
    return replace(clock, schedule=clock.schedule.strided(stride))
