"""A shape that moves, as animations of its path data.

Where the movement is smooth it is a sum of easings (`shapetween.timing.sums`): the first animation
runs from the first place to another, and replaces what the path holds at rest; the others add to
it. So the numbers at rest take no part in it, and a program that rewrites them changes nothing.
Else, and where a number of keyframes is asked for, one animation runs through keyframes.
"""

import xml.etree.ElementTree as ET
from dataclasses import dataclass, replace
from functools import cache
from itertools import pairwise

import numpy as np

from shapetween.base.arrays import Curves, Floats, Index
from shapetween.geometry.merging import merged_curves
from shapetween.model.part import Part
from shapetween.svg.write.animate import add_animation
from shapetween.svg.write.clock import Clock
from shapetween.svg.write.paths import Grid, PathForm, on_grid, straight_curves
from shapetween.timing.schedule import Schedule
from shapetween.timing.sums import EasingSum, sum_of_easings, united
from shapetween.timing.windows import turning_times

__all__ = ["ShapeMotion", "add_motion", "shape_motion"]

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

#: Bytes of an animation besides its attributes.
ELEMENT = 16

#: Curves of all keyframes of a path that are written, about 30 bytes each, before keyframes become
#: fewer by ever looser tolerances; but so many keyframes there are. More and browsers stall on it.
MOST_WRITTEN, LEAST_KEYFRAMES, LOOSER = 300_000, 9, 1.5

#: Curves of all samples that are held at once, and the strides of samples that may be left out for
#: it: parts of the steps on which keyframes may lie.
MOST_SAMPLED, STRIDES = 1_500_000, (2, 3, 4, 5, 6)

#: Curves of all samples past which no corners of what meshes move are looked for, and of all else
#: only in some of its points: to find out when they are it is sampled hundreds of times more. More
#: takes minutes and gigabytes; with fewer, drawings whose pieces go one after another take many
#: more easings.
MOST_LOOKED = 100_000


#: With so many animations or fewer it is not tried whether rings by themselves take fewer bytes.
#: More, and long files stay so; fewer, and it takes time for nothing.
SHORT = 5

#: Rings that are looked at by themselves. More take seconds.
MOST_RINGS = 40

#: By how much the acceleration of a ring changes at a corner, beside the greatest change there is.
#: Larger, and what sets off slowly and stops at once is seen to stop only.
NARROWLY = 0.005


@dataclass(frozen=True, slots=True)
class ShapeMotion:
    """How a path moves.

    Attributes
    ----------
    rest : str
        Path data at rest.
    animations : tuple of dict
        Attributes of the animations that move it, often none.
    looser : float
        How many times farther than the tolerance points may be off, for there would be too much to
        write.
    """

    rest: str
    animations: tuple[dict[str, str], ...]
    looser: float = 1.0

    @property
    def bytes(self) -> int:
        """About how many it takes."""
        texts = [text for each in self.animations for pair in each.items() for text in pair]
        return (
            len(self.rest) + sum(len(text) + 2 for text in texts) + ELEMENT * len(self.animations)
        )


def add_motion(path: ET.Element, motion: ShapeMotion) -> None:
    """Let a path move."""
    path.set("d", motion.rest)
    for attributes in motion.animations:
        add_animation(path, attributes)


def shape_motion(
    part: Part,
    clock: Clock,
    decimals: int,
    tolerance: float,
    seen: tuple[float, float] = (0.0, 1.0),
) -> ShapeMotion:
    """How a part moves.

    Parameters
    ----------
    part : Part
    clock : Clock
    decimals : int
        Of coordinates.
    tolerance : float
        How far points may be off on the way, in user units.
    seen : (float, float)
        From when until when anything is seen of it: where it goes before and after is not told.
    """
    clock = _for_so_many(clock, sum(part.rings))
    plan = _Plan(part, clock, decimals, tolerance, seen)
    moved = plan.as_one()
    if not clock.adaptive or not 1 < len(part.rings) <= MOST_RINGS:
        return moved
    if _is_short(moved) or not plan.looks:
        return moved
    apart = plan.by_rings()
    return moved if apart is None or apart.bytes >= moved.bytes else apart


def _is_short(motion: ShapeMotion) -> bool:
    """Whether a movement is a sum of few easings, or none."""
    count = len(motion.animations)
    return count <= SHORT and (count > 1 or motion.bytes < (ANIMATION + len(motion.rest)) * SHORT)


@dataclass(frozen=True, slots=True, eq=False)
class _Plan:
    """A part that is to be written, its clock, decimals and tolerance, and when it is seen."""

    part: Part
    clock: Clock
    decimals: int
    tolerance: float
    seen: tuple[float, float]

    @property
    def looks(self) -> bool:
        """Whether corners of the movement are looked for."""
        few = self._samples <= MOST_LOOKED
        return self.clock.adaptive and (few or not self.part.areas)

    @property
    def _samples(self) -> int:
        """Curves of all samples together."""
        finer, _ = self.clock.schedule.finer()
        return len(finer.clock) * sum(self.part.rings)

    @property
    def step(self) -> float:
        """Of the grid that places are written on."""
        return 10.0**-self.decimals

    def curves(self, schedule: Schedule) -> Curves:
        """Curves at the samples of a schedule, (S, N, 4, 2)."""
        return self.part.curves(np.clip(schedule.time, *self.seen))

    def places(self, clock: Floats) -> Curves:
        """Curves at any times of the player's clock (M,), (M, N, 4, 2)."""
        return self.part.curves(np.clip(self.clock.schedule.time_at(clock), *self.seen))

    def places_of_some(self, clock: Floats) -> Floats:
        """Of many points only some, (M, K, 2), at any times (M,), found a few times at once."""
        times = np.array_split(clock, 1 + len(clock) * sum(self.part.rings) // MOST_LOOKED)
        return np.concatenate([self.some(self.places(few)) for few in times])

    def some(self, curves: Curves) -> Floats:
        """Of all points of curves (S, N, 4, 2) those in which corners are looked for."""
        every = curves.reshape(len(curves), -1, 2)
        return every[:, :: 1 + self._samples // MOST_LOOKED].copy()

    def laid_out(self, stack: Curves) -> tuple[PathForm, Floats, tuple[int, ...]]:
        """The path of curves (S, N, 4, 2), its points (S, K, 2), and the curves of each ring."""
        rings = self.part.rings
        if self.clock.adaptive:
            stack, rings = merged_curves(stack, rings, MERGED * self.tolerance, self.step / 2)
        straight = straight_curves(stack, STRAIGHT * self.tolerance, self.step)
        form = PathForm.of(rings, self.part.closed, straight)
        return form, form.points(stack), rings

    def as_one(self) -> ShapeMotion:
        """All points as one sum of easings, or through keyframes."""
        clock, decimals, tolerance = self.clock, self.decimals, self.tolerance
        finer, kept = clock.schedule.finer()
        # Of long outlines a hundred megabytes: nobody keeps them while they are laid out.
        stacks = [self.curves(finer)]
        turns: tuple[float, ...] = ()
        if self.looks:
            places = self.some(stacks[0])
            turns = turning_times(places, finer.clock, tolerance, self.places_of_some)
            if turns:
                finer, own = finer.with_corners(turns)
                kept = own[kept]
                stacks = []
                stacks = [self.curves(finer)]
        form, points, _ = self.laid_out(stacks.pop())
        first = on_grid(points[:1], decimals)
        rest = form.texts(first, decimals)[0]
        if not _moves(points, STILL * self.step):
            return ShapeMotion(rest, ())
        importance = np.where(form.handles, HANDLE, 1.0)
        if clock.adaptive:

            @cache
            def most() -> int:
                return _terms_of_use(len(rest), clock.keyframes_needed(points[kept], tolerance))

            late = self.seen != (0.0, 1.0)
            found = sum_of_easings(
                points, finer.clock, self.step, tolerance, importance, most, turns, late=late
            )
            if found is not None:
                return ShapeMotion(rest, _summed(found, first, form, clock, decimals))
        points = points[kept]
        moments, values, easing, looser = _keyframes(points, importance, clock, tolerance)
        texts = form.texts(on_grid(values, decimals), decimals)
        if len(set(texts)) == 1:
            return ShapeMotion(rest, ())
        running = clock.running(moments, texts, easing)
        moved = tuple({"attributeName": "d", **timing} for timing in running)
        return ShapeMotion(rest, moved, looser)

    def by_rings(self) -> ShapeMotion | None:
        """A sum of easings for each ring that turns corners at times of its own.

        Those of the same corners, and those of none, are one. None if some ring has no sum.
        """
        turns = self._turns()
        groups = sorted(set(turns))
        finer, _ = self.clock.schedule.finer()
        finer, _ = finer.with_corners(sorted({turn for group in groups for turn in group}))
        form, points, rings = self.laid_out(self.curves(finer))
        ring = np.repeat(np.arange(len(rings)), np.array(rings) * 4)[form.kept]
        group_of = np.array([groups.index(own) for own in turns])[ring]
        first = on_grid(points[:1], self.decimals)
        importance = np.where(form.handles, HANDLE, 1.0)
        sums: list[tuple[Index, EasingSum]] = []
        for k, group in enumerate(groups):
            own = np.flatnonzero(group_of == k)
            if not _moves(points[:, own], STILL * self.step):
                continue
            found = sum_of_easings(
                points[:, own],
                finer.clock,
                self.step,
                self.tolerance,
                importance[own],
                turns=group,
                late=self.seen != (0.0, 1.0),
            )
            if found is None:
                return None
            sums.append((own, found))
        if not sums:
            return None
        whole = united(sums, points.shape[1])
        summed = _summed(whole, first, form, self.clock, self.decimals)
        return ShapeMotion(form.texts(first, self.decimals)[0], summed)

    def _turns(self) -> list[tuple[float, ...]]:
        """When each ring sets off, stops or turns a corner."""
        finer, _ = self.clock.schedule.finer()
        stack = self.curves(finer)
        ends = np.cumsum(self.part.rings).tolist()
        found = []
        for start, end in pairwise([0, *ends]):

            def places(clock: Floats, first: int = start, last: int = end) -> Floats:
                return self.places(clock)[:, first:last].reshape(len(clock), -1, 2)

            own = stack[:, start:end].reshape(len(stack), -1, 2)
            found.append(turning_times(own, finer.clock, self.tolerance, places, NARROWLY))
        return found


def _moves(points: Floats, most: float) -> bool:
    """Whether any coordinate of points (S, K, 2) covers more than so much."""
    # Mostly they are seen to by one sample.
    if np.abs(points[len(points) // 2] - points[0]).max(initial=0.0) > most:
        return True
    return bool(np.ptp(points, axis=0).max(initial=0.0) > most)


def _terms_of_use(length: int, keyframes: int) -> int:
    """How many easings take fewer bytes than so many keyframes of some length each."""
    return int((keyframes - 2) * (length + KEYFRAME) / (ANIMATION + TERM * length)) + 1


def _summed(
    found: EasingSum, first: Grid, form: PathForm, clock: Clock, decimals: int
) -> tuple[dict[str, str], ...]:
    """The animations of a sum of easings; the first replaces, and the others add."""
    every = np.concatenate([first, first + found.terms[:1], found.terms])
    rest, start, alone, *added = form.texts(every, decimals)
    head, *tail = found.easings
    ways = [[{"attributeName": "d", **timing}] for timing in clock.eased(head, rest, start)]
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
) -> tuple[Floats, Floats, Floats | None, float]:
    """Keyframes, fewer by a tolerance so much looser where there would be too much to write."""
    weighed = points * importance[:, None]
    moments, values, easing = clock.fitted(weighed, tolerance)
    most = max(LEAST_KEYFRAMES, MOST_WRITTEN * 3 // max(points.shape[1], 1))
    looser = 1.0
    while clock.adaptive and len(moments) > most:
        looser *= LOOSER
        moments, values, easing = clock.fitted(weighed, looser * tolerance)
    return moments, values / importance[:, None], easing, looser


def _for_so_many(clock: Clock, count: int) -> Clock:
    """The clock with fewer samples, where so many curves at all of them would not fit in memory."""
    steps = len(clock.schedule.time) - 1
    if not clock.adaptive or steps * count <= MOST_SAMPLED:
        return clock
    stride = next(k for k in STRIDES if steps * count <= k * MOST_SAMPLED or k == STRIDES[-1])
    return replace(clock, schedule=clock.schedule.strided(stride))
