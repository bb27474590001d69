"""Stroked lines becoming other lines: matched end to end, turned as a whole, the rest straight."""

from dataclasses import dataclass

import numpy as np

from shapetween.arclength import ArcLength
from shapetween.arrays import Curves, Floats, Index, Points
from shapetween.correspond import correspond
from shapetween.errors import OutlineError
from shapetween.geometry.bezier import sub_curves
from shapetween.geometry.polygon import cross
from shapetween.geometry.rotation import rotations
from shapetween.matched import MatchedOutlines
from shapetween.outline import Outline

__all__ = ["LineMorph", "morph_line", "morph_speck"]

#: Samples by which lines are compared.
SAMPLES = 128

#: Share of the length within which joints of two lines become one.
SNAP = 0.04

#: Share of the distance between two lines, laid on each other, that a turn must save to be made.
#: Lines that fit no better when turned go straight.
TURN_SAVES = 0.3


@dataclass(frozen=True, slots=True, eq=False)
class LineMorph:
    """A line through the whole movement.

    Attributes
    ----------
    source, target : (P, 4, 2) float64
        Matched parts of the two lines' own curves.
    closed : bool
    angle : float
        Angle by which the line turns as a whole, radians.
    """

    source: Curves
    target: Curves
    closed: bool
    angle: float

    @property
    def counts(self) -> tuple[int, ...]:
        """Number of curves in its one ring."""
        return (self.count,)

    @property
    def count(self) -> int:
        """Number of curves."""
        return len(self.source)

    def curves(self, t: Floats) -> Curves:
        """Control points at the times (F,), (F, P, 4, 2); the line's own at 0 and 1."""
        ends = [curves.reshape(-1, 2).mean(axis=0) for curves in (self.source, self.target)]
        start, end = self.source - ends[0], self.target - ends[1]
        back = end @ rotations(np.asarray(-self.angle)).T
        time = t[:, None, None, None]
        local = (1 - time) * start + time * back
        turn = np.swapaxes(rotations(t * self.angle), 1, 2)[:, None]
        centre = (1 - t)[:, None] * ends[0] + t[:, None] * ends[1]
        result = local @ turn + centre[:, None, None]
        result[:, 1:, 0] = result[:, :-1, 3]  # equal but for rounding
        if self.closed:
            result[:, 0, 0] = result[:, -1, 3]
        result[t == 0], result[t == 1] = self.source, self.target
        return np.asarray(result)


def morph_line(source: Outline, target: Outline) -> LineMorph:
    """Prepare the movement of one line.

    Parameters
    ----------
    source, target : Outline
        Open or closed; if one is open the other is cut open where that fits best.
    """
    if source.closed and target.closed:
        pieces = _closed_pieces(source, target)
        if pieces is not None:
            return _turned(*pieces, closed=True)
    first, second = _opened(source, target)
    return _turned(*_open_pieces(first, second), closed=False)


def morph_speck(source: Outline, target: Outline) -> LineMorph:
    """Prepare the movement of a ring too small for a mesh of its own.

    Parameters
    ----------
    source, target : Outline
        Closed, and running the same way round.
    """
    first = _cut_open(source, 0.0)
    ring, other = ArcLength(target), _samples(first)
    points, order = _starts(ring)
    start = int(((points[order] - other) ** 2).sum(axis=(1, 2)).argmin())
    opened = _cut_open(target, start / SAMPLES)
    return _turned(*_open_pieces(first, opened), closed=True)


def _starts(ring: ArcLength) -> tuple[Points, Index]:
    """Even points of a closed line about their mean, and their order from each of them on."""
    points = ring.point(np.arange(SAMPLES) / SAMPLES)
    order = (np.arange(SAMPLES)[:, None] + np.arange(SAMPLES)) % SAMPLES
    return points - points.mean(axis=0), order


def _closed_pieces(source: Outline, target: Outline) -> tuple[Curves, Curves] | None:
    """Matched parts of two closed lines; None where they enclose nothing to be matched by."""
    rings = [ring if ring.area >= 0 else ring.reversed() for ring in (source, target)]
    try:
        matching = correspond(rings[0], rings[1])
    except OutlineError:
        return None
    places = [ArcLength(ring) for ring in rings]
    exact = matching.affine is not None
    matched = MatchedOutlines(places[0], places[1], matching.u, matching.v, exact=exact)
    pieces = matched.cut(np.zeros(0))
    return pieces.source, pieces.target


def _opened(source: Outline, target: Outline) -> tuple[Outline, Outline]:
    """Both lines open and running the same way, cut and turned round where that fits best."""
    if source.closed:
        source = _cut_open(source, 0.0) if target.closed else source
    lines = [source, target]
    loop = next((k for k in (0, 1) if lines[k].closed), None)
    if loop is None:
        a, b = (_samples(line) for line in lines)
        backwards = ((a - b[::-1]) ** 2).sum() < ((a - b) ** 2).sum()
        return source, target.reversed() if backwards else target
    ring, other = ArcLength(lines[loop]), _samples(lines[1 - loop])
    # Every start and both directions of the closed line against the open one.
    points, order = _starts(ring)
    costs = [((points[k] - other) ** 2).sum(axis=(1, 2)) for k in (order, order[:, ::-1])]
    start = min(range(SAMPLES), key=lambda k: min(costs[0][k], costs[1][k]))
    opened = _cut_open(lines[loop], start / SAMPLES)
    if costs[1][start] < costs[0][start]:
        opened = opened.reversed()
    lines[loop] = opened
    return lines[0], lines[1]


def _samples(line: Outline) -> Points:
    """Even points about their mean, (SAMPLES, 2)."""
    points = ArcLength(line).point(np.linspace(0, 1, SAMPLES))
    return np.asarray(points - points.mean(axis=0))


def _cut_open(ring: Outline, fraction: float) -> Outline:
    """A closed line as an open one that starts and ends at a place on it."""
    index, t = ArcLength(ring).locate(fraction)
    first, at = int(index), float(t)
    curves = np.roll(ring.curves, -first, axis=0)
    if at <= 0:
        return Outline(curves, closed=False)
    head, one, zero = curves[:1], np.ones(1), np.zeros(1)
    cut = np.full(1, at)
    parts = [sub_curves(head, cut, one), curves[1:], sub_curves(head, zero, cut)]
    joined = np.concatenate(parts)
    joined[1:, 0] = joined[:-1, 3]
    return Outline(joined, closed=False)


def _open_pieces(source: Outline, target: Outline) -> tuple[Curves, Curves]:
    """Two open lines as equally many parts of their own curves, (P, 4, 2) each."""
    places = ArcLength(source), ArcLength(target)
    joints = [place.joints[1:] for place in places]
    pairs: list[tuple[float, float]] = [(0.0, 0.0), (1.0, 1.0)]
    apart = np.abs(joints[0][:, None] - joints[1])
    for k in np.argsort(apart, axis=None, kind="stable").tolist():
        i, j = divmod(k, max(len(joints[1]), 1))
        if apart[i, j] > SNAP:
            break
        u, v = float(joints[0][i]), float(joints[1][j])
        if all((u - a) * (v - b) > 0 for a, b in pairs):
            pairs.append((u, v))
    pairs.sort()
    u, v = np.array(pairs).T
    alone_a, alone_b = joints[0][~np.isin(joints[0], u)], joints[1][~np.isin(joints[1], v)]
    first = np.sort(np.concatenate([joints[0], np.interp(alone_b, v, u)]))
    second = np.sort(np.concatenate([joints[1], np.interp(alone_a, u, v)]))
    return _parts(places[0], first), _parts(places[1], second)


def _parts(place: ArcLength, cuts: Floats) -> Curves:
    """An open line's curves cut at fractions, every joint among them."""
    bounds = np.concatenate([[0.0], cuts])
    index, start = place.locate(bounds)
    following = np.append(start[1:], 1.0)
    same = np.append(index[1:] == index[:-1], False)
    end = np.where(same, following, 1.0)
    parts = sub_curves(place.outline.curves[index], start, end)
    parts[1:, 0] = parts[:-1, 3]
    return parts


def _turned(source: Curves, target: Curves, *, closed: bool) -> LineMorph:
    a = source.reshape(-1, 2) - source.reshape(-1, 2).mean(axis=0)
    b = target.reshape(-1, 2) - target.reshape(-1, 2).mean(axis=0)
    angle = float(np.arctan2(cross(a, b).sum(), (a * b).sum()))
    turned = a @ rotations(np.asarray(angle)).T
    straight = ((a - b) ** 2).sum()
    saves = straight - ((turned - b) ** 2).sum() > TURN_SAVES * straight
    return LineMorph(source, target, closed, angle if saves else 0.0)
