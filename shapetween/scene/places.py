"""Places along an outline by shares of its length, and two outlines cut alike at such places."""

from dataclasses import dataclass

import numpy as np

from shapetween.base.arrays import Curves, Floats, Index, Points
from shapetween.geometry.bezier import evaluate, sub_curves
from shapetween.model.outline import Outline

__all__ = ["Pieces", "Places", "cut_alike", "run_between", "run_of"]

#: Chords that each curve's length is taken from, and an outline's about, where it is of so many
#: curves that each has fewer. Places only have to correspond, so a few do; more cost time.
CHORDS, MOST_CHORDS = 24, 40_000

#: Share of the length that a curve of no length counts as, so that every place has one curve.
LEAST = 1e-9

#: Distance of two places, as a share of the length, up to which they are one.
SAME = 1e-7

#: Parameter nearer than this to a curve's end is that end.
END = 1e-6

#: Points times chords that are compared at once. More do not stay in the processor's cache, and
#: take twice as long; far fewer, and each step waits for its start.
AT_ONCE = 20_000


class Places:
    """Shares of an outline's length, and where they are on its curves.

    Parameters
    ----------
    outline : Outline
        Also one that is a single point.

    Attributes
    ----------
    outline : Outline
    joints : (N + 1,) float64
        Share at which each curve starts, and 1.
    """

    def __init__(self, outline: Outline) -> None:
        self.outline = outline
        self._each = each = min(CHORDS, -(-MOST_CHORDS // len(outline.curves)))
        points = evaluate(outline.curves, np.arange(each + 1) / each)
        steps = np.hypot(*np.moveaxis(np.diff(points, axis=1), -1, 0))
        total = float(steps.sum())
        steps = steps + LEAST * (total or 1.0)
        self._along = np.concatenate([[0.0], np.cumsum(steps.ravel())])
        self._along /= self._along[-1]
        self.length = total
        self.joints = self._along[::each].copy()

    def locate(self, share: Floats) -> tuple[Index, Floats]:
        """Curve and parameter at shares of the length; a joint belongs to the curve after it."""
        s = share - np.floor(share) if self.outline.closed else np.clip(share, 0.0, 1.0)
        place = np.interp(s, self._along, np.arange(len(self._along)) / self._each)
        count = len(self.outline.curves)
        curve = np.minimum(place.astype(np.intp), count - 1)
        t = place - curve
        late = t > 1 - END
        if self.outline.closed:
            curve = np.where(late, (curve + 1) % count, curve)
        else:
            late &= curve < count - 1
            curve = np.where(late, curve + 1, curve)
        return curve, np.where(late | (t < END), 0.0, t)

    def at_joints(self, share: Floats) -> Floats:
        """Shares of the length, those next to a joint that joint's own, to the last digit."""
        after = np.clip(np.searchsorted(self.joints, share), 1, len(self.joints) - 1)
        first, second = self.joints[after - 1], self.joints[after]
        joint = np.where(share - first <= second - share, first, second)
        return np.where(np.abs(joint - share) < SAME, joint, share)

    def share(self, curve: Index, t: Floats) -> Floats:
        """Share of the length at parameters of curves."""
        whole = np.arange(len(self._along)) / self._each
        return np.asarray(np.interp(curve + t, whole, self._along))

    def point(self, share: Floats) -> Points:
        """Points at shares of the length, (N, 2)."""
        curve, t = self.locate(share)
        return np.asarray(evaluate(self.outline.curves[curve], t[:, None])[:, 0])

    def nearest(self, points: Points) -> Floats:
        """Shares of the length nearest to points (N, 2)."""
        t = np.arange(self._each) / self._each
        chords = evaluate(self.outline.curves, t).reshape(-1, 2)
        ends = np.concatenate([chords[1:], self.outline.curves[-1:, 3]])
        step = ends - chords
        size = (step**2).sum(axis=1)
        size = np.where(size > 0, size, 1.0)
        scale = float(np.ptp(chords, axis=0).max()) ** 2
        found = np.zeros(len(points))
        (u, v), (p, q) = np.ascontiguousarray(step.T), np.ascontiguousarray(chords.T)
        some = max(1, AT_ONCE // len(chords))
        for first in range(0, len(points), some):
            x, y = points[first : first + some].T
            x, y = x[:, None] - p, y[:, None] - q
            part = np.clip((x * u + y * v) / size, 0.0, 1.0)
            x, y = x - part * u, y - part * v
            distance = x * x + y * y
            # Equal up to rounding: the first one.
            least = distance.min(axis=1, keepdims=True)
            best = (distance <= least + 1e-12 * scale).argmax(axis=1)
            rest = part[np.arange(len(best)), best]
            along = self._along[best]
            found[first : first + some] = along + rest * (self._along[best + 1] - along)
        return found


@dataclass(frozen=True, slots=True, eq=False)
class Pieces:
    """Two outlines as equally many curves, each becoming its counterpart.

    Attributes
    ----------
    source, target : (P, 4, 2) float64
        Exact parts of the outlines' own curves, in order; a part may be a point.
    closed : bool
        Whether they are rings.
    """

    source: Curves
    target: Curves
    closed: bool


def cut_alike(source: Places, target: Places, u: Floats, v: Floats) -> Pieces:
    """Cut two outlines where either one has a joint or a knot.

    Parameters
    ----------
    source, target : Places
        Both closed or both open.
    u, v : (K,) float64
        Shares that correspond, neither ever decreasing. Of closed outlines the last knot is the
        first one a turn later; of open ones they run from 0 to 1.
    """
    k = np.arange(len(u), dtype=np.float64)
    at = [k]
    for places, knots in ((source, u), (target, v)):
        turns = np.floor(knots[0]) + np.arange(2.0) if source.outline.closed else np.zeros(1)
        joints = (places.joints[:-1] + turns[:, None]).ravel()
        joints = joints[(joints > knots[0] + SAME) & (joints < knots[-1] - SAME)]
        span = np.clip(np.searchsorted(knots, joints, side="right") - 1, 0, len(knots) - 2)
        room = knots[span + 1] - knots[span]
        part = (joints - knots[span]) / np.where(room > 0, room, 1.0)
        near = np.minimum(part, 1 - part) * room < SAME
        at.append((span + part)[~near])
    w = np.unique(np.concatenate(at))
    ends = [np.interp(w, k, knots) for knots in (u, v)]
    # Places that are one on both outlines are one.
    moved = np.maximum(np.diff(ends[0]), np.diff(ends[1])) > SAME
    keep = np.append(True, moved)
    keep[-1] = True
    ends = [places[keep] for places in ends]
    first, second = (
        _parts(places, shares) for places, shares in zip((source, target), ends, strict=True)
    )
    some = (np.ptp(first, axis=1) > 0).any(axis=1) | (np.ptp(second, axis=1) > 0).any(axis=1)
    if some.any() and not some.all():
        first, second = first[some], second[some]
    return Pieces(first, second, source.outline.closed)


def _parts(places: Places, shares: Floats) -> Curves:
    """Parts of an outline between shares (N + 1,) of its length, each within one curve."""
    curves = places.outline.curves
    turns = np.floor(shares) if places.outline.closed else np.zeros(len(shares))
    rest = shares - turns
    rest = places.at_joints(rest)
    curve, t = places.locate(rest)
    count = len(curves)
    if not places.outline.closed:
        last = rest >= 1.0
        curve, t = np.where(last, count, curve), np.where(last, 0.0, t)
    start, begin, after, end = curve[:-1], t[:-1], curve[1:], t[1:]
    still = (np.diff(shares) <= SAME) | ((start == after) & (begin == end) & (count > 1))
    still |= (start == after) & (begin >= end) & (np.diff(shares) < 0.5 / max(count, 2))
    whole = np.where((end == 0.0) & ~still, 1.0, np.where(still, begin, end))
    index = np.minimum(start, count - 1)
    begin = np.where(start == count, 1.0, begin)
    whole = np.where(start == count, 1.0, whole)
    parts = sub_curves(curves[index], begin, whole)
    full = (begin == 0.0) & (whole == 1.0)
    parts[full] = curves[index[full]]
    # Each part starts at the very point where the one before it ends.
    parts[:-1, 3] = parts[1:, 0]
    if places.outline.closed:
        parts[-1, 3] = parts[0, 0]
    for k in np.flatnonzero(still):
        parts[k] = parts[k, 0]
        if k + 1 < len(parts):
            parts[k, 3] = parts[k + 1, 0]
        elif places.outline.closed:
            parts[k, 3] = parts[0, 0]
    return parts


def run_of(places: Places, start: float, end: float) -> Outline:
    """An outline's part between two shares, ``start < end``, past its start if it is closed."""
    if not places.outline.closed:
        knots = np.unique(np.array([0.0, start, end, 1.0]))
        curves = cut_alike(places, places, knots, knots).source
        own = Places(Outline(curves, False))
        first = int(np.abs(own.joints - start).argmin())
        last = int(np.abs(own.joints - end).argmin())
        return Outline(curves[first : max(last, first + 1)], False)
    # What goes all round but for rounding goes all round, or a point would be left over.
    end = end if start + 1.0 - end > SAME else start + 1.0
    knots = np.unique(np.array([start, end, start + 1.0]))
    curves = cut_alike(places, places, knots, knots).source
    own = Places(Outline(curves, False))
    last = int(np.abs(own.joints - (end - start)).argmin())
    return Outline(curves[: max(last, 1)], False)


def run_between(places: Places, start: float, end: float) -> Outline:
    """An outline from one share to another, backwards if need be; of a closed one the short way."""
    if not places.outline.closed:
        run = run_of(places, min(start, end), max(start, end))
        return run if end > start else run.reversed()
    ahead = end - start - np.floor(end - start)
    if ahead > 0.5 + SAME:
        return run_of(places, end, end + 1 - ahead).reversed()
    return run_of(places, start, start + ahead)
