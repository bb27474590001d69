"""Matching two outlines that already lie on each other: by where they are, not by what they are.

Shapes that ride on one plane have been brought together by it. What then lies near belongs
together; so an outline and the area it goes round are matched alike.
"""

from dataclasses import dataclass

import numpy as np

from shapetween.attach.planes import Plane
from shapetween.base.arrays import Curves, Floats, Points
from shapetween.geometry.bezier import sub_curves
from shapetween.geometry.polygon import cross
from shapetween.geometry.rotation import rotations
from shapetween.match.dynamic import cyclic_paths, open_path
from shapetween.model.arclength import ArcLength
from shapetween.model.outline import Outline
from shapetween.outline.matched import MatchedOutlines, cut_curves

__all__ = ["Parts", "cut_alike", "cut_open", "matched_nearby", "turn_between"]

#: Stations two outlines are matched by. Fewer lose fingers, more cost time with the square.
STATIONS = 64

#: Starts of a closed outline that are tried, next to the one that fits best when spread evenly.
STARTS = 5

#: What a right angle between two directions costs against a distance of their whole size.
DIRECTION = 0.08

#: Distance of their middles, as a share of their size, past which outlines are laid on each other
#: before they are matched: what only moved is not matched askew.
APART = 0.25

#: Share of the distance between two outlines, laid on each other, that a turn must save to be made.
#: Lines that fit no better when turned go straight.
TURN_SAVES = 0.3

#: Distance of every control point, as a share of the size, up to which two outlines are one.
SAME = 1e-6

#: Share of the length within which joints of two lines become one, and within which nothing else
#: of the matching stands beside such a joint.
SNAP = 0.04


def matched_nearby(source: Outline, target: Outline, plane: Plane, *, fine: bool = True) -> "Parts":
    """Two outlines as equally many parts of their own curves.

    Parameters
    ----------
    source, target : Outline
        If one is open the other is cut open where that fits best. Closed ones run either way.
    plane : Plane
        Brings the source near the target.
    fine : bool
        Whether to match them place by place; else by even lengths, which is cheap.
    """
    brought = _brought(source, plane)
    extent = float(np.ptp(target.curves.reshape(-1, 2), axis=0).max())
    for way in (target, target.reversed()):
        alike = brought.shape == way.curves.shape and source.closed == way.closed
        if alike and np.abs(brought - way.curves).max() <= SAME * extent:
            return Parts(source.curves, way.curves, source.closed)
    places = ArcLength(source), ArcLength(target)
    if source.closed and target.closed:
        return _closed(places, plane, fine)
    return _open(places, plane, fine)


@dataclass(frozen=True, slots=True, eq=False)
class Parts:
    """Parts of two outlines that become each other.

    Attributes
    ----------
    source, target : (P, 4, 2) float64
    closed : bool
    """

    source: Curves
    target: Curves
    closed: bool


def _brought(source: Outline, plane: Plane) -> Curves:
    """Control points of the source where the plane brings them."""
    moved = plane.hold(source.curves.reshape(-1, 2), False).at(np.ones(1))[0]
    return np.asarray(moved.reshape(-1, 4, 2))


def _closed(places: tuple[ArcLength, ArcLength], plane: Plane, fine: bool) -> Parts:
    even = np.arange(STATIONS) / STATIONS
    first = plane.hold(places[0].point(even), False).at(np.ones(1))[0]
    best: tuple[float, int, tuple[ArcLength, ArcLength], Floats] | None = None
    rolled = (np.arange(STATIONS)[:, None] + np.arange(STATIONS)) % STATIONS
    for target in _ways(places, fine):
        there = places[1] if target is places[1].outline else ArcLength(target)
        costs = _costs(first, there.point(even), closed=True)
        shifts = costs[np.arange(STATIONS), rolled].sum(axis=1)
        k = int(shifts.argmin())
        if best is None or shifts[k] < best[0] * (1 - SAME):
            best = float(shifts[k]), k, (places[0], there), costs
    assert best is not None
    _, shift, pair, costs = best
    if fine:
        starts = np.unique((shift + np.arange(STARTS) - STARTS // 2) % STATIONS)
        none = np.zeros(0, dtype=np.intp)
        paths = cyclic_paths(costs, np.zeros_like(costs), none, starts)
        which = int(paths.costs.argmin())
        rows, columns = paths.trace(which)
        u, v = rows / STATIONS, (columns + int(starts[which])) / STATIONS
    else:
        u = np.array([0.0, 0.5, 1.0])
        v = u + shift / STATIONS
    pieces = MatchedOutlines(pair[0], pair[1], u, v).cut(np.zeros(0))
    return Parts(pieces.source, pieces.target, True)


def _ways(places: tuple[ArcLength, ArcLength], fine: bool) -> list[Outline]:
    """The second of two closed outlines in the directions it may run; if it matters little, one."""
    source, target = (place.outline for place in places)
    ways = [target, target.reversed()]
    if fine:
        return ways
    return ways[:1] if (source.area > 0) == (target.area > 0) else ways[1:]


def _open(places: tuple[ArcLength, ArcLength], plane: Plane, fine: bool) -> Parts:
    pair = _opened(places, plane)
    even = np.linspace(0, 1, STATIONS)
    first = plane.hold(pair[0].point(even), False).at(np.ones(1))[0]
    costs = [
        _costs(first, place.point(even), closed=False)
        for place in (pair[1], ArcLength(pair[1].outline.reversed()))
    ]
    if np.trace(costs[1]) < np.trace(costs[0]) * (1 - SAME):
        pair, costs = (pair[0], ArcLength(pair[1].outline.reversed())), costs[::-1]
    if fine:
        turned = _laid_on(first, pair[1].point(even))
        rows, columns = open_path(costs[0] if turned is None else turned)
        u, v = rows / (STATIONS - 1), columns / (STATIONS - 1)
    else:
        u = v = np.array([0.0, 1.0])
    return cut_alike(pair, u, v)


def _opened(places: tuple[ArcLength, ArcLength], plane: Plane) -> tuple[ArcLength, ArcLength]:
    """Both lines open; a closed one is cut where it comes nearest to the other's ends."""
    loop = next((k for k in (0, 1) if places[k].outline.closed), None)
    if loop is None:
        return places
    even, along = np.arange(STATIONS) / STATIONS, np.linspace(0, 1, STATIONS)
    points = [places[k].point(even if k == loop else along) for k in (0, 1)]
    points[0] = plane.hold(points[0], False).at(np.ones(1))[0]
    ring, line = points[loop], points[1 - loop]
    order = (np.arange(STATIONS)[:, None] + np.arange(STATIONS)) % STATIONS
    apart = [((ring[k] - line) ** 2).sum(axis=(1, 2)) for k in (order, order[:, ::-1])]
    cut = ArcLength(cut_open(places[loop], int(np.minimum(*apart).argmin()) / STATIONS))
    return (cut, places[1]) if loop == 0 else (places[0], cut)


def cut_open(place: ArcLength, fraction: float) -> Outline:
    """A closed line as an open one that starts and ends at a place on it."""
    index, t = place.locate(fraction)
    first, at = int(index), float(t)
    curves = np.roll(place.outline.curves, -first, axis=0)
    if at <= 0:
        return Outline(curves, closed=False)
    head, one, zero = curves[:1], np.ones(1), np.zeros(1)
    cut = np.full(1, at)
    parts = [sub_curves(head, cut, one), curves[1:], sub_curves(head, zero, cut)]
    joined = np.concatenate(parts)
    joined[1:, 0] = joined[:-1, 3]
    return Outline(joined, closed=False)


def _costs(first: Points, second: Points, *, closed: bool) -> Floats:
    """Cost of matching each station of one outline with each of the other, (n, n)."""
    sizes = [float(np.linalg.norm(np.ptp(p, axis=0))) for p in (first, second)]
    size = max(*sizes) or 1.0
    middles = [p.mean(axis=0) for p in (first, second)]
    if np.linalg.norm(middles[0] - middles[1]) > APART * size:
        first, second = first - middles[0], second - middles[1]
    away = ((first[:, None] - second) ** 2).sum(-1) / size**2
    directions = [_directions(p, closed) for p in (first, second)]
    return np.asarray(away + DIRECTION * (1 - directions[0] @ directions[1].T))


def _laid_on(first: Points, second: Points) -> Floats | None:
    """Costs of two open lines once the first is turned to lie on the second, if that tells more."""
    angle = turn_between(first, second)
    if not angle:
        return None
    turned = (first - first.mean(axis=0)) @ rotations(np.asarray(angle)).T
    return _costs(turned, second - second.mean(axis=0), closed=False)


def turn_between(first: Points, second: Points) -> float:
    """Angle about their means that lays points (N, 2) on others far better than none does, or 0."""
    a, b = first - first.mean(axis=0), second - second.mean(axis=0)
    angle = float(np.arctan2(cross(a, b).sum(), (a * b).sum()))
    straight = ((a - b) ** 2).sum()
    saves = straight - ((a @ rotations(np.asarray(angle)).T - b) ** 2).sum()
    return angle if saves > TURN_SAVES * straight else 0.0


def _directions(points: Points, closed: bool) -> Points:
    ahead = np.roll(points, -1, axis=0) - np.roll(points, 1, axis=0)
    if not closed:
        ahead[0], ahead[-1] = points[1] - points[0], points[-1] - points[-2]
    size = np.linalg.norm(ahead, axis=1, keepdims=True)
    return np.asarray(ahead / np.where(size > 0, size, 1.0))


def cut_alike(places: tuple[ArcLength, ArcLength], u: Floats, v: Floats) -> Parts:
    """Two open lines cut at both lines' joints, given matched places (K,) of both."""
    joints = [place.joints[1:] for place in places]
    brought = np.interp(joints[1], v, u)
    pairs: list[tuple[float, float]] = [(0.0, 0.0), (1.0, 1.0)]
    apart = np.abs(joints[0][:, None] - brought)
    for k in np.argsort(apart, axis=None, kind="stable").tolist():
        i, j = divmod(k, max(len(joints[1]), 1))
        if apart[i, j] > SNAP:
            break
        x, y = float(joints[0][i]), float(joints[1][j])
        if all((x - a) * (y - b) > 0 for a, b in pairs):
            pairs.append((x, y))
    held = np.array(sorted(pairs))
    # The rest of the matching stands where it does not come near a joint or out of order.
    free = (np.abs(u[:, None] - held[:, 0]) > SNAP) & (np.abs(v[:, None] - held[:, 1]) > SNAP)
    order = (u[:, None] > held[:, 0]) == (v[:, None] > held[:, 1])
    keep = (free & order).all(axis=1)
    knots = np.concatenate([held, np.stack([u[keep], v[keep]], axis=1)])
    x, y = knots[np.argsort(knots[:, 0], kind="stable")].T
    alone = [np.setdiff1d(joints[k], held[:, k]) for k in (0, 1)]
    inner = held[1:-1]
    first = np.concatenate([inner[:, 0], alone[0], np.interp(alone[1], y, x)])
    second = np.concatenate([inner[:, 1], np.interp(alone[0], x, y), alone[1]])
    return Parts(_parts(places[0], np.sort(first)), _parts(places[1], np.sort(second)), False)


def _parts(place: ArcLength, cuts: Floats) -> Curves:
    """An open line's curves cut at fractions, every joint among them."""
    places = np.array(place.locate(np.append(0.0, cuts)), dtype=np.float64)
    return cut_curves(place.outline.curves, places, closed=False)
