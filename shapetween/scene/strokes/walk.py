"""Two outlines of one stroke cut alike, at each other's joints, by their places on its contour."""

from dataclasses import dataclass

import numpy as np

from shapetween.base.arrays import Curves, Floats, Index, Mask
from shapetween.geometry.bezier import curve_lengths, evaluate, sub_curves
from shapetween.model.outline import Outline
from shapetween.scene.strokes.frame import StrokeFrame

__all__ = ["Walk", "cut_alike", "follows", "walk_of"]

#: Places on each curve of an outline at which it is asked where on the contour it runs.
LOOKS = 12

#: Difference of two places on a contour, in zones, up to which they are one. Smaller and an outline
#: is cut in slivers beside its own joints; larger and what is cut together does not lie together.
SAME = 0.04

#: What a ring's way round the contour adds to its places there, in zones: far below what is seen.
SLOPE = 1e-6

#: Distance of an open line's ends, as a share of its extent, at which they are one place.
MEET = 1e-6

#: Share of a ring's length that may be missing from its parts. They are its own curves, so that any
#: more is a place where the line lies beside itself and a place was taken for another.
MISSING = 1e-3

#: By how much a ring's way round the contour may differ from once, in zones.
ROUND = 0.5


@dataclass(frozen=True, slots=True, eq=False)
class Walk:
    """Where a ring runs along a stroke's contour.

    Attributes
    ----------
    curves : (C, 4, 2) float64
        The ring, clockwise as the contour runs.
    side : {-1, 1}
        Of a closed line's contours which; -1 for an open line.
    total : int
        Zones of the contour.
    place : (K,) float64
        Curve and parameter in one number, from 0 to C, the joints twice: as the curves before them
        end and as the ones after them start.
    contour : (K,) float64
        Place on the contour at each, never decreasing.
    """

    curves: Curves
    side: int
    total: int
    place: Floats
    contour: Floats

    def joints(self) -> tuple[Floats, Floats]:
        """Places on the contour where curves start, as the one before ends and this one starts."""
        after = np.arange(len(self.curves)) * (LOOKS + 2)
        reached = np.roll(self.contour[after + LOOKS + 1], 1)
        reached[0] -= self.total
        return reached, self.contour[after]

    def at(self, contour: Floats) -> Floats:
        """Curve and parameter in one number at places of the contour."""
        count = len(self.curves)
        turns = np.arange(-2, 3)[:, None]
        known = (self.contour + turns * self.total).ravel()
        place = (self.place + turns * count).ravel()
        return np.asarray(np.interp(contour, known, place))


def walk_of(frame: StrokeFrame, ring: Outline) -> Walk | None:
    """Where a ring runs along a stroke's contour; None if it does not run round it once."""
    count, total = len(ring.curves), frame.zones.total
    looks = (np.arange(LOOKS) + 0.5) / LOOKS
    found = frame.locate(evaluate(ring.curves, looks).reshape(-1, 2))
    steps = _steps(frame, found.contour)
    if steps is None:
        return None
    if abs(abs(float(steps.sum())) - total) > ROUND:
        return None
    if steps.sum() < 0:
        return walk_of(frame, ring.reversed())
    side = 1 if frame.closed and int((found.side > 0).sum()) * 2 > len(steps) else -1
    # A step back is noise of what lies as near to two places.
    first = int(np.argmax(steps != 0))
    contour = np.concatenate([[0.0], np.cumsum(steps[:-1])])
    contour += found.contour[first] - contour[first]
    contour = np.minimum(np.maximum.accumulate(contour), contour[0] + total)
    rows = contour.reshape(count, LOOKS)
    ahead = np.append(rows[1:, 0], rows[0, 0] + total)
    behind = np.insert(rows[:-1, -1], 0, rows[-1, -1] - total)
    # Half a step on each curve's end, but never past where the other curve is.
    start = np.maximum(rows[:, 0] - (rows[:, 1] - rows[:, 0]) / 2, behind)
    end = np.minimum(rows[:, -1] + (rows[:, -1] - rows[:, -2]) / 2, ahead)
    reached = np.insert(end[:-1], 0, end[-1] - total)
    start = np.maximum(start, reached)
    known = np.concatenate([start[:, None], rows, end[:, None]], axis=1).ravel()
    place = np.arange(count)[:, None] + np.concatenate([[0.0], looks, [1.0]])
    # Joints that lie together keep their order.
    known += SLOPE * (place.ravel() / count - 0.5)
    return Walk(ring.curves, side, total, place.ravel(), known)


def _steps(frame: StrokeFrame, contour: Floats) -> Floats | None:
    """By how much each place is farther on the contour than the one before; the last: the first."""
    total = frame.zones.total
    known = np.ones(len(contour), dtype=bool)
    curves = frame.curves
    if not frame.closed and np.hypot(*(curves[0, 0] - curves[-1, 3])) < MEET * np.ptp(curves):
        # Where both ends are one place, either cap may be meant: what is beside them tells.
        beyond = np.mod(contour + 1 + SAME, total / 2)
        known = beyond > 1 + 2 * SAME
    at = np.flatnonzero(known)
    if len(at) < 2:
        return None
    steps = np.diff(contour[at], append=contour[at[:1]])
    steps -= total * np.round(steps / total)
    walked = np.concatenate([[0.0], np.cumsum(steps)])
    whole = np.arange(at[0], at[0] + len(contour) + 1)
    every = np.interp(whole, np.append(at, at[0] + len(contour)), walked)
    return np.asarray(np.roll(np.diff(every), at[0]), dtype=np.float64)


def follows(frame: StrokeFrame, ring: Outline) -> bool:
    """Whether a ring runs round a stroke's contour once, and nothing of it is lost."""
    walk = walk_of(frame, ring)
    return walk is not None and cut_alike(walk, walk) is not None


def cut_alike(one: Walk, other: Walk) -> tuple[tuple[Floats, Curves], tuple[Floats, Curves]] | None:
    """Two rings in equally many parts, each beside the same part of the contour.

    None if that leaves something out, as where a line runs into itself.

    Returns
    -------
    places : (P + 1,) float64
        On the contour, from 0 on, for each of the two.
    parts : (P, 4, 2) float64
        Exact parts of the rings' own curves, for each of the two; some are points.
    """
    zones = [float(z) for z in range(one.total)]
    # Each entry: place, and the joint of either ring that it is, or -1.
    entries: list[list[float]] = [[zone, -1.0, -1.0] for zone in zones]
    for k, walk in enumerate((one, other)):
        _claim(entries, walk, k + 1)
    entries.sort(key=lambda entry: entry[0])
    table = np.array(entries)
    places = np.append(table[:, 0], float(one.total))
    parts = [_parts(walk, table[:, 0], table[:, k + 1]) for k, walk in enumerate((one, other))]
    for walk, own in zip((one, other), parts, strict=True):
        whole = float(curve_lengths(walk.curves).sum())
        if abs(float(curve_lengths(own).sum()) - whole) > MISSING * whole:
            return None
    return (places, parts[0]), (places, parts[1])


def _claim(entries: list[list[float]], walk: Walk, column: int) -> None:
    """Let each of a ring's joints be an entry that is near, or else one of its own."""
    reached, left = walk.joints()
    wishes: list[tuple[float, int, int]] = []
    total = walk.total
    for j, (low, high) in enumerate(zip(reached.tolist(), left.tolist(), strict=True)):
        for e, entry in enumerate(entries):
            for turn in (-total, 0, total, 2 * total):
                at = entry[0] + turn
                off = max(low - at, at - high, 0.0)
                if off <= SAME:
                    wishes.append((round(off, 9), j, e))
    claimed: set[int] = set()
    for _, j, e in sorted(wishes):
        if entries[e][column] < 0:
            inner = entries[e][0] != round(entries[e][0])
            if inner and j in claimed:
                continue
            entries[e][column] = float(j)
            claimed.add(j)
    for j in sorted(set(range(len(walk.curves))) - claimed):
        at = float((reached[j] + left[j]) / 2) % total
        new = [at, -1.0, -1.0]
        new[column] = float(j)
        entries.append(new)


def _parts(walk: Walk, contour: Floats, joint: Floats) -> Curves:
    """A ring's parts between places on the contour, the last one back to the first, (P, 4, 2)."""
    count = len(walk.curves)
    place = walk.at(contour)
    own = joint >= 0
    # The joint itself, a whole number of turns away at most.
    near = joint + count * np.round((place - joint) / count)
    place = np.where(own, near, place)
    place = _ordered(place, own)
    ends = np.append(place[1:], place[0] + count)
    return _between(walk.curves, place, ends)


def _ordered(place: Floats, own: Mask) -> Floats:
    """Places that never decrease, with the joints among them as they are."""
    fixed = np.flatnonzero(own)
    if not len(fixed):
        return np.maximum.accumulate(place)
    low = np.where(own, place, -np.inf)
    high = np.where(own, place, np.inf)
    low = np.maximum.accumulate(low)
    high = np.minimum.accumulate(high[::-1])[::-1]
    return np.maximum.accumulate(np.clip(place, low, high))


def _between(curves: Curves, start: Floats, end: Floats) -> Curves:
    count = len(curves)
    first = np.floor(start + 1e-9)
    still = end - start <= 1e-9
    low, high = np.clip(start - first, 0.0, 1.0), np.clip(end - first, 0.0, 1.0)
    high = np.where(still, low, high)
    index: Index = (first.astype(np.intp)) % count
    parts = sub_curves(curves[index], low, high)
    whole = (low == 0.0) & (high == 1.0)
    parts[whole] = curves[index[whole]]
    parts[:-1, 3] = parts[1:, 0]
    parts[-1, 3] = parts[0, 0]
    for k in np.flatnonzero(still):
        parts[k] = parts[k, 0]
    for k in np.flatnonzero(still):
        parts[k, 3] = parts[(k + 1) % len(parts), 0]
    return parts
