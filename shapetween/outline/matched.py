"""Two outlines read as one: places that correspond, and curves cut where either one has a joint."""

from bisect import bisect
from dataclasses import dataclass

import numpy as np

from shapetween.base.arrays import Curves, Floats, Index, Mask, Points
from shapetween.geometry.bezier import end_tangents, sub_curves
from shapetween.geometry.circlemap import CircleMap, turn, wrapped
from shapetween.geometry.polygon import cross
from shapetween.model.arclength import ArcLength

__all__ = ["MatchedOutlines", "Pieces", "Samples", "cut_curves", "kinks_of"]

#: Share of the length within which a joint of one outline is taken for a joint of the other.
#: Smaller leaves corners matched beside corners: slivers and bevels; larger joins unlike ones.
SNAP = 0.012

#: The same where the correspondence is exact, and no joint may be moved along its outline.
SNAP_EXACT = 1e-6

#: Share of the sample spacing that the even samples keep from a joint.
CLEARANCE = 0.25

#: Share of the sample spacing within which a joint is on a sample, or as far from one as may be: on
#: regular outlines both are common, and rounding must not decide. Larger moves what is seen.
TIE = 1e-6

#: Share of the length that a piece of one outline has at least, where only the other outline's
#: joints cut it: shorter ones are less than the last printed digit, and look like knots.
LEAST_PIECE = 1e-4

#: Parameter of a curve nearer than this to its end is the joint there: a shorter piece would be
#: smaller than any printed digit.
END_PARAMETER = 1e-7


@dataclass(frozen=True, slots=True, eq=False)
class Samples:
    """Matched points of two outlines, in order.

    Attributes
    ----------
    w : (N,) float64
        Places in the common parameter, strictly increasing in [0, 1).
    source, target : (N, 2) float64
    joints : (N,) bool
        Where a curve of either outline ends.
    """

    w: Floats
    source: Points
    target: Points
    joints: Mask


@dataclass(frozen=True, slots=True, eq=False)
class Pieces:
    """The two outlines as equally many curves, each becoming its counterpart.

    Attributes
    ----------
    w : (P,) float64
        Where each piece starts, in the common parameter, increasing.
    source, target : (P, 4, 2) float64
        Exact parts of the outlines' own curves.
    """

    w: Floats
    source: Curves
    target: Curves


class MatchedOutlines:
    """A correspondence carried over to the curves themselves.

    The common parameter w is the mean of both arc-length fractions, counted from the first knot.
    Joints of the two outlines that nearly coincide are made to coincide, by shifting the
    correspondence a little on either side; corners then become corners.

    Parameters
    ----------
    source, target : ArcLength
    u, v : (K,) float64
        Matched fractions of the lengths, strictly increasing over one turn; the last knot is the
        first one, a turn later.
    anchors : (M, 2) float64, optional
        Pairs of fractions that belong together whatever the joints say; they become joints.
    exact : bool
        Whether the correspondence is exact and joints may only be joined where they coincide.
    """

    def __init__(
        self,
        source: ArcLength,
        target: ArcLength,
        u: Floats,
        v: Floats,
        *,
        anchors: Floats | None = None,
        exact: bool = False,
    ) -> None:
        self.source, self.target = source, target
        w = (u - u[0] + v - v[0]) / 2
        to_u, to_v = CircleMap(w, u), CircleMap(w, v)
        held = np.zeros((0, 2)) if anchors is None else anchors
        joints_a, kinks_a = _with_anchors(source, held[:, 0])
        joints_b, kinks_b = _with_anchors(target, held[:, 1])
        at_a, at_b = turn(to_u.inverse()(joints_a)), turn(to_v.inverse()(joints_b))
        first, second = _joined(
            at_a, at_b, kinks_a, kinks_b, SNAP_EXACT if exact else SNAP, len(held)
        )
        middle = at_a[first] + wrapped(at_b[second] - at_a[first]) / 2
        self._to_u = to_u.bent(at_a[first], middle)
        self._to_v = to_v.bent(at_b[second], middle)
        alone_a = np.setdiff1d(np.arange(len(joints_a)), first)
        alone_b = np.setdiff1d(np.arange(len(joints_b)), second)
        own_a = turn(self._to_u.inverse()(joints_a[alone_a]))
        own_b = turn(self._to_v.inverse()(joints_b[alone_b]))
        # Rows w, u, v of every joint; the side that has the joint keeps its exact fraction.
        rows = np.concatenate(
            [
                np.stack([turn(middle), joints_a[first], joints_b[second]]),
                np.stack([own_a, joints_a[alone_a], turn(self._to_v(own_a))]),
                np.stack([own_b, turn(self._to_u(own_b)), joints_b[alone_b]]),
            ],
            axis=1,
        )
        order = np.argsort(rows[0], kind="stable")
        counts = len(first), len(alone_a), len(alone_b)
        own = np.repeat([[True, True, False], [True, False, True]], counts, axis=1)[:, order]
        rows = rows[:, order]
        rows[1], rows[2] = _spaced(rows[1], own[0]), _spaced(rows[2], own[1])
        self._joints = rows
        sharp = np.concatenate(
            [
                np.maximum(np.abs(kinks_a[first]), np.abs(kinks_b[second])),
                np.abs(kinks_a[alone_a]),
                np.abs(kinks_b[alone_b]),
            ]
        )
        sharp[: len(held)] = np.inf  # anchors stand first among the joined, and count most
        self._sharpness = sharp[order]

    @property
    def joints(self) -> Floats:
        """Parameter and both fractions of every joint of either outline, (3, N), in order."""
        return self._joints

    def points(self, w: Floats) -> tuple[Points, Points]:
        """Matched points of source and target at the parameters (N,)."""
        return (
            self.source.point(turn(self._to_u(w))),
            self.target.point(turn(self._to_v(w))),
        )

    def parameter(self, u: Floats) -> Floats:
        """Common parameter of fractions of the source's length, in [0, 1)."""
        return turn(self._to_u.inverse()(u))

    def samples(self, count: int) -> Samples:
        """About `count` even samples, and as many joints at most among them, the sharpest."""
        joints = self._joints[0]
        if len(joints) > count:
            # Of every short interval its sharpest joint, so that none of it goes unseen.
            interval = np.floor(joints * count + TIE).astype(np.intp)
            order = np.lexsort((-self._sharpness, interval))
            joints = joints[np.sort(order[np.unique(interval[order], return_index=True)[1]])]
        even = np.arange(count) / count
        around = np.concatenate([joints[-1:] - 1, joints, joints[:1] + 1])
        after = np.searchsorted(around, even)
        gap = np.minimum(even - around[after - 1], around[after] - even)
        even = even[gap * count > CLEARANCE + TIE]
        w = np.concatenate([joints, even])
        order = np.argsort(w, kind="stable")
        is_joint = np.arange(len(w)) < len(joints)
        w, is_joint = w[order], is_joint[order]
        # Joints of the two outlines that lie closer than a sample can tell are one sample.
        keep = np.append(True, np.diff(w) > 1e-3 / count)
        w, is_joint = w[keep], is_joint[keep]
        return Samples(w, *self.points(w), is_joint)

    def cut(self, w: Floats) -> Pieces:
        """Both outlines cut at their joints and at the parameters `w`."""
        w = np.setdiff1d(w, self._joints[0])
        extra = np.stack([w, turn(self._to_u(w)), turn(self._to_v(w))])
        rows = np.concatenate([self._joints, extra], axis=1)
        rows = rows[:, np.argsort(rows[0], kind="stable")]
        place_a, place_b = _places(self.source, rows[1]), _places(self.target, rows[2])
        # Two cuts at one place of both outlines would leave a piece without extent.
        same = [(np.roll(p, -1, axis=1) == p).all(axis=0) for p in (place_a, place_b)]
        keep = ~(same[0] & same[1])
        return Pieces(
            rows[0, keep],
            cut_curves(self.source.outline.curves, place_a[:, keep]),
            cut_curves(self.target.outline.curves, place_b[:, keep]),
        )


def _with_anchors(places: ArcLength, anchors: Floats) -> tuple[Floats, Floats]:
    """Anchors, then all other joints of an outline, and the kink at each of them."""
    joints, kinks = places.joints, kinks_of(places)
    apart = np.abs(wrapped(joints[:, None] - anchors))
    same = apart < SNAP_EXACT
    # An anchor on a joint is that joint, to the last digit, so that no sliver is cut beside it.
    on = same.any(axis=0)
    nearest = apart.argmin(axis=0)
    place = np.where(on, joints[nearest], turn(anchors))
    rest = ~same.any(axis=1)
    return np.append(place, joints[rest]), np.append(np.where(on, kinks[nearest], 0.0), kinks[rest])


def kinks_of(places: ArcLength) -> Floats:
    """Turn of the outline at the start of each of its curves, (N,), in (-pi, pi]."""
    leaving, reaching = end_tangents(places.outline.curves)
    before = np.roll(reaching, 1, axis=0)
    return np.asarray(np.arctan2(cross(before, leaving), (before * leaving).sum(-1)))


def _joined(
    at_a: Floats, at_b: Floats, kinks_a: Floats, kinks_b: Floats, reach: float, held: int
) -> tuple[Index, Index]:
    """Pairs of joints that become one, the most alike first, in the same cyclic order.

    Parameters
    ----------
    at_a, at_b : (N,), (M,) float64
        Places on the circle.
    kinks_a, kinks_b : (N,), (M,) float64
    reach : float
        Greatest distance of a pair.
    held : int
        So many first places of both are pairs already.
    """
    by_place = np.argsort(at_b, kind="stable")
    around = np.concatenate([at_b[by_place] - 1, at_b[by_place], at_b[by_place] + 1])
    low = np.searchsorted(around, at_a - reach)
    high = np.searchsorted(around, at_a + reach, side="right")
    count = high - low
    a = np.repeat(np.arange(len(at_a)), count)
    position = (
        np.arange(len(a)) - np.repeat(np.cumsum(count) - count, count) + np.repeat(low, count)
    )
    b = by_place[position % len(at_b)]
    place_b = around[position]
    sharp_a, sharp_b = np.abs(kinks_a[a]), np.abs(kinks_b[b])
    score = np.abs(place_b - at_a[a]) / reach
    score += 0.8 * np.abs(sharp_a - sharp_b) - 0.5 * np.minimum(sharp_a, sharp_b)
    taken_a, taken_b = np.arange(len(at_a)) < held, np.arange(len(at_b)) < held
    place = at_a[:held] + wrapped(at_b[:held] - at_a[:held])
    chosen = sorted((float(at_a[i]), float(place[i]), i, i) for i in range(held))
    for k in np.lexsort((b, a, score)).tolist():
        i, j = int(a[k]), int(b[k])
        if taken_a[i] or taken_b[j]:
            continue
        x, y = float(at_a[i]), float(place_b[k])
        # A pair crosses another one only if both lie near, so its neighbours tell; near the seam
        # of the circle the neighbour is on the other side of it.
        at = bisect(chosen, (x, y))
        before = chosen[at - 1] if at else _shifted(chosen[-1:], -1.0)
        after = chosen[at] if at < len(chosen) else _shifted(chosen[:1], 1.0)
        if (before and not (before[0] < x and before[1] < y)) or (
            after and not (after[0] > x and after[1] > y)
        ):
            continue
        chosen.insert(at, (x, y, i, j))
        taken_a[i] = taken_b[j] = True
    first = np.array([c[2] for c in chosen], dtype=np.intp)
    second = np.array([c[3] for c in chosen], dtype=np.intp)
    return first, second


def _spaced(places: Floats, own: Mask) -> Floats:
    """Places on the circle with those that are not an outline's own kept a little apart.

    Parameters
    ----------
    places : (N,) float64
        In cyclic order.
    own : (N,) bool
        Joints of the outline itself, which stay.
    """
    fixed = np.flatnonzero(own)
    if len(fixed) == 0 or own.all():
        return places
    result = places.copy()
    for k, start in enumerate(fixed.tolist()):
        end = int(fixed[(k + 1) % len(fixed)])
        count = (end - start - 1) % len(places)
        if not count:
            continue
        index = (start + 1 + np.arange(count)) % len(places)
        room = float(turn(places[end] - places[start])) or 1.0
        gap = min(LEAST_PIECE, room / (count + 1))
        step = np.arange(count) * gap
        # Forward each keeps its distance from the one before, backward from the one after.
        along = np.maximum.accumulate(np.maximum(turn(places[index] - places[start]), gap) - step)
        latest = room - gap - step[::-1]
        along = np.minimum(along + step, latest)
        result[index] = turn(places[start] + along)
    return result


def _shifted(pairs: list[tuple[float, float, int, int]], by: float) -> tuple[float, ...]:
    return tuple(value + by for pair in pairs for value in pair[:2])


def _places(places: ArcLength, fractions: Floats) -> Floats:
    """Curve index and parameter at each fraction, (2, N); just before a joint counts as on it."""
    curve, t = places.locate(fractions)
    late = t > 1 - END_PARAMETER
    curve = np.where(late, (curve + 1) % len(places.outline.curves), curve)
    return np.stack([curve, np.where(late | (t < END_PARAMETER), 0.0, t)])


def cut_curves(curves: Curves, places: Floats, *, closed: bool = True) -> Curves:
    """Parts of a run of curves from each place to the next one, from the last on to its end.

    Parameters
    ----------
    places : (2, N) float64
        Curve indices and parameters, in order, among them the start of every curve.
    closed : bool
        Whether the run ends where it starts, and places may begin anywhere on it.
    """
    index = places[0].astype(np.intp)
    start = places[1]
    following = np.roll(places, -1, axis=1)
    if not closed:
        following[:, -1] = len(curves), 0
    end = np.where(following[1] > 0, following[1], 1.0)
    still = (following == places).all(axis=0) & (places.shape[1] > 1)
    parts = sub_curves(curves[index], start, np.where(still, start, end))
    whole = (start == 0) & (end == 1) & ~still
    parts[whole] = curves[index[whole]]
    # Each part starts at the very point where the one before it ends.
    parts[:-1, 3] = parts[1:, 0]
    if closed:
        parts[-1, 3] = parts[0, 0]
    return parts
