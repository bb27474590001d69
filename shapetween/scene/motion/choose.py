"""The track of a pair of items, by what they are."""

from dataclasses import dataclass

import numpy as np

from shapetween.base.arrays import Floats, Points
from shapetween.base.errors import OutlineError
from shapetween.base.notices import Notice
from shapetween.deform.check import crossing_frames
from shapetween.elastic.fill import FillSettings, morph_fill
from shapetween.geometry.bezier import sub_curves
from shapetween.geometry.polygon import cross
from shapetween.model.drawing import Shape
from shapetween.model.outline import Outline
from shapetween.scene.forms import Form, OpenLine, RoundedBox, Segment
from shapetween.scene.items import Item
from shapetween.scene.motion.knots import (
    along_knots,
    graph_knots,
    half_knots,
    ring_knots,
)
from shapetween.scene.motion.tracks import Blend, Elastic, Track
from shapetween.scene.places import Pieces, Places, cut_alike

__all__ = ["Ends", "tracks_of"]

#: Sides' ratio from which on a box is long and turns the short way, its length staying its length.
LONG = 1.5

#: Turn that is a tie between both ways, radians: it goes clockwise.
HALF_TIE = 1e-6

#: Residual of a line's best similarity, as shares: what a turn must leave at most, what part of the
#: residual without one, and what that must be at least, for a line to turn on its way.
TURNED, TURNED_PART, UNTURNED = 0.25, 0.45, 0.08

#: Farthest that a line turns by itself, radians: farther, and it goes end over end.
FARTHEST = np.deg2rad(100.0)

#: What distance of ends costs beside an outline's own matching when a line's direction is chosen.
ENDS = 0.15

#: Starts at which a ring may be cut to become a line.
CUTS = 48

#: Distance of two places, as a share of the drawing, that are one.
SAME = 2e-3

#: Least size of an outline, as a share of the drawing, for which the engine is worth its time.
LARGE = 0.22

#: Times at which a blend is looked at for crossings.
LOOKED = np.array([0.25, 0.5, 0.75])


@dataclass(frozen=True, slots=True, eq=False)
class Ends:
    """Two items that become each other, and how they are seen.

    Attributes
    ----------
    first, second : Item
    forms : (Form, Form)
    scale : float
        Of the drawing.
    symmetric : int
        Of what axis both are their own mirror images: 0 an upright one, 1 a level one, -1 none.
    root : bool
        Whether neither lies in another item.
    """

    first: Item
    second: Item
    forms: tuple[Form, Form]
    scale: float
    symmetric: int = -1
    root: bool = True


def tracks_of(
    ends: Ends, settings: FillSettings, names: tuple[str, str]
) -> tuple[tuple[Track, ...], tuple[Notice, ...]]:
    """Tracks of all rings of a pair, and warnings."""
    first, second = ends.first, ends.second
    if settings.meshed and first.filled and second.filled:
        return _elastic(ends, settings, names)
    if _same(first, second):
        return tuple(_still(ring, other) for ring, other in _rings(first, second)), ()
    if first.closed and second.closed:
        return _closed(ends, settings, names)
    if not first.closed and not second.closed:
        return (_open(ends),), ()
    if first.closed:
        pieces = _opening(Places(first.outer), Places(second.outer))
    else:
        back = _opening(Places(second.outer), Places(first.outer))
        pieces = Pieces(back.target, back.source, False)
    return (_blend(pieces, first, second, 0.0),), ()


def _rings(first: Item, second: Item) -> list[tuple[Outline, Outline]]:
    pairs = list(zip(first.rings, second.rings, strict=True))
    return pairs[:1] + [(one.reversed(), other.reversed()) for one, other in pairs[1:]]


def _same(first: Item, second: Item) -> bool:
    """Whether two items are drawn of the very same curves."""
    if len(first.rings) != len(second.rings) or first.closed != second.closed:
        return False
    reach = 1e-6 * first.extent
    return all(
        one.curves.shape == other.curves.shape
        and float(np.abs(one.curves - other.curves).max()) <= reach
        for one, other in zip(first.rings, second.rings, strict=True)
    )


def _still(ring: Outline, other: Outline) -> Blend:
    centres = np.stack([ring.curves[0, 0], other.curves[0, 0]])
    return Blend(Pieces(ring.curves, other.curves, ring.closed), centres)


def _blend(pieces: Pieces, first: Item, second: Item, turn: float) -> Blend:
    return Blend(pieces, np.stack([first.centre, second.centre]), turn)


def clockwise(ring: Outline) -> Outline:
    """A closed outline run clockwise as drawn."""
    return ring.reversed() if ring.closed and ring.area < 0 else ring


def _closed(
    ends: Ends, settings: FillSettings, names: tuple[str, str]
) -> tuple[tuple[Track, ...], tuple[Notice, ...]]:
    first, second = ends.first, ends.second
    places = Places(clockwise(first.outer)), Places(clockwise(second.outer))
    one, other = ends.forms
    if isinstance(one, RoundedBox) and isinstance(other, RoundedBox):
        outer = _boxes(one, other, *places)
        return (outer, *_holes(ends, outer)), ()
    if ends.symmetric >= 0:
        found = _halves(ends, *places)
        if found is not None and _sound(found):
            return (found, *_holes(ends, found)), ()
    simple = None
    if not (ends.root and min(first.extent, second.extent) > LARGE * ends.scale):
        knots = ring_knots(*places)
        simple = _blend(cut_alike(*places, *knots), first, second, 0.0)
        if _sound(simple):
            return (simple, *_holes(ends, simple)), ()
    try:
        return _elastic(ends, settings, names)
    except OutlineError:
        if simple is None:
            simple = _blend(cut_alike(*places, *ring_knots(*places)), first, second, 0.0)
        return (simple, *_holes(ends, simple)), ()


def _elastic(
    ends: Ends, settings: FillSettings, names: tuple[str, str]
) -> tuple[tuple[Track, ...], tuple[Notice, ...]]:
    shapes = [
        Shape(tuple(clockwise(ring) for ring in item.rings), item.style, item.name)
        for item in (ends.first, ends.second)
    ]
    part, said = morph_fill(shapes[0], shapes[1], settings, names, alone=False)
    return (Elastic(part),), said


def _sound(track: Blend) -> bool:
    """Whether a ring never crosses itself on its way."""
    counts, closed = list(track.counts), list(track.closed)
    return not crossing_frames(track.curves(LOOKED), counts, closed).any()


def _boxes(one: RoundedBox, other: RoundedBox, source: Places, target: Places) -> Blend:
    """Sides to sides and corners to corners, by the turn that is least."""
    if one.round and not other.round:
        one = RoundedBox(one.centre, one.sides, other.angle, one.radii)
    if other.round:
        other = RoundedBox(other.centre, other.sides, one.angle, other.radii)
    long = all(box.sides.max() > LONG * box.sides.min() for box in (one, other))
    choices = []
    for quarter in range(-1, 3):
        turn = other.angle - one.angle + quarter * np.pi / 2
        turn = float((turn + np.pi) % (2 * np.pi) - np.pi)
        turn += np.pi * 2 * (turn < HALF_TIE - np.pi)
        crossed = long and (one.sides[0] > one.sides[1]) != (
            (other.sides[0] > other.sides[1]) != bool(quarter % 2)
        )
        choices.append((crossed, round(abs(turn), 6), turn < 0, turn, quarter))
    _, _, _, turn, quarter = min(choices)
    knots = []
    for box, places, rolled in ((one, source, 0), (other, target, 2 * quarter)):
        shares = places.nearest(np.roll(box.joints, -rolled, axis=0))
        ahead = (shares - shares[0]) % 1.0
        # Joints of no distance may come out in either order.
        ahead[ahead > 0.98] = 0.0
        ahead[0] = 0.0
        ahead = np.maximum.accumulate(ahead)
        knots.append(shares[0] + np.append(ahead, 1.0))
    pieces = cut_alike(source, target, *knots)
    return Blend(pieces, np.stack([one.centre, other.centre]), turn)


def _halves(ends: Ends, source: Places, target: Places) -> Blend | None:
    """Two rings that are their own mirror images, so that they stay so."""
    crossings = [
        _crossings(places, item.box.mean(axis=0), ends.symmetric)
        for places, item in ((source, ends.first), (target, ends.second))
    ]
    if crossings[0] is None or crossings[1] is None:
        return None
    knots = half_knots(source, target, crossings[0], crossings[1])
    if knots is None:
        return None
    return _blend(cut_alike(source, target, *knots), ends.first, ends.second, 0.0)


def _crossings(places: Places, middle: Points, flips: int) -> tuple[float, float] | None:
    """Where a ring crosses its axis, first and last along it, as increasing shares."""
    steps = 8 * 48
    shares = np.arange(steps + 1) / steps
    shares = np.union1d(shares, places.joints)
    points = places.point(shares)
    side = points[:, flips] - middle[flips]
    side[np.abs(side) < 1e-9 * float(np.ptp(points, axis=0).max())] = 0.0
    sign = np.sign(side)
    found = []
    for k in np.flatnonzero(sign[:-1] * sign[1:] < 0):
        part = side[k] / (side[k] - side[k + 1])
        found.append(shares[k] + part * (shares[k + 1] - shares[k]))
    for k in np.flatnonzero(sign[:-1] == 0):
        before, after = sign[k - 1 if k else -2], sign[k + 1]
        if before * after < 0:
            found.append(shares[k])
    if len(found) < 2:
        return None
    along = places.point(np.array(found))[:, 1 - flips]
    first, last = found[int(along.argmin())], found[int(along.argmax())]
    return first, last + (last < first)


def _holes(ends: Ends, outer: Blend) -> tuple[Track, ...]:
    """Holes of a blended region: to the nearest one in its box, or closing where they are."""
    first, second = ends.first, ends.second
    if not first.holes and not second.holes:
        return ()
    items = [[Item((hole,), item.style) for hole in item.holes] for item in (first, second)]
    boxes = first.box, second.box
    local = [
        np.array([(hole.centre - box[0]) / np.maximum(box[1] - box[0], 1e-12) for hole in side])
        for side, box in zip(items, boxes, strict=True)
    ]
    pairs: list[tuple[int, int]] = []
    if items[0] and items[1]:
        from scipy.optimize import linear_sum_assignment

        cost = np.linalg.norm(local[0][:, None] - local[1], axis=-1)
        pairs = [(int(i), int(j)) for i, j in zip(*linear_sum_assignment(cost), strict=True)]
        pairs = [(i, j) for i, j in pairs if cost[i, j] < 0.4]
    tracks: list[Track] = []
    for i, j in pairs:
        one, other = items[0][i], items[1][j]
        places = Places(one.outer), Places(other.outer)
        from shapetween.scene.forms import form_of

        forms = form_of(one), form_of(other)
        if isinstance(forms[0], RoundedBox) and isinstance(forms[1], RoundedBox):
            found = _boxes(forms[0], forms[1], *places)
        else:
            knots = ring_knots(*places)
            found = _blend(cut_alike(*places, *knots), one, other, 0.0)
        tracks.append(_backwards(found))
    for side, (own, others) in enumerate(((items[0], boxes[1]), (items[1], boxes[0]))):
        known = {pair[side] for pair in pairs}
        for k, hole in enumerate(own):
            if k in known:
                continue
            there = others[0] + local[side][k] * (others[1] - others[0])
            point = np.broadcast_to(there, hole.outer.curves.shape).copy()
            sides = (hole.outer.curves, point)
            centres = np.stack([hole.centre, there])
            if side:
                sides, centres = sides[::-1], centres[::-1]
            tracks.append(_backwards(Blend(Pieces(*sides, True), centres, outer.turn)))
    return tuple(tracks)


def _backwards(track: Blend) -> Blend:
    """A hole is drawn the other way round than the ring about it."""
    pieces = track.pieces
    back = Pieces(pieces.source[::-1, ::-1], pieces.target[::-1, ::-1], pieces.closed)
    return Blend(back, track.centres, track.turn)


def _open(ends: Ends) -> Blend:
    """Two open lines, from one end to the other."""
    first, second = ends.first, ends.second
    one, other = ends.forms
    if isinstance(one, Segment) and isinstance(other, Segment):
        return _segments(first, second)
    source = Places(first.outer)
    best: tuple[float, Blend] | None = None
    for backwards in (False, True):
        outline = second.outer.reversed() if backwards else second.outer
        target = Places(outline)
        knots = graph_knots(source, target, SAME * ends.scale)
        if knots is not None:
            return _blend(cut_alike(source, target, *knots), first, second, 0.0)
        u, v, cost = along_knots(source, target)
        if isinstance(one, OpenLine) and isinstance(other, OpenLine):
            corners = other.corners, other.turns
            if backwards:
                corners = 1 - other.corners[::-1], -other.turns[::-1]
            alike = len(one.corners) == len(corners[0]) > 0
            if alike and (one.turns * corners[1] > 0).all():
                u = np.concatenate([[0.0], one.corners, [1.0]])
                v = np.concatenate([[0.0], corners[0], [1.0]])
                cost *= 0.6
        way = np.linalg.norm(source.point(np.array([0.0, 1.0])) - outline.curves[[0, -1], [0, 3]])
        pieces = cut_alike(source, target, u, v)
        turn, rest = _turn(source, target, u, v)
        cost = (rest if turn else cost) + ENDS * float(way) / ends.scale
        if best is None or cost < best[0] - 1e-6:
            best = cost, _blend(pieces, first, second, turn)
    assert best is not None
    return best[1]


def _segments(first: Item, second: Item) -> Blend:
    """Two straight lines: the middle goes straight, and it turns the short way."""
    outline = second.outer
    ways = [o.curves[-1, 3] - o.curves[0, 0] for o in (first.outer, outline)]
    turn = float(np.arctan2(cross(ways[0], ways[1]), ways[0] @ ways[1]))
    if abs(turn) > np.pi / 2 + HALF_TIE:
        outline = outline.reversed()
        turn -= np.pi * np.sign(turn)
    if turn < HALF_TIE - np.pi / 2:  # a right angle either way is one clockwise
        outline = outline.reversed()
        turn += np.pi
    knots = np.array([0.0, 1.0])
    pieces = cut_alike(Places(first.outer), Places(outline), knots, knots)
    middles = [(o.curves[0, 0] + o.curves[-1, 3]) / 2 for o in (first.outer, outline)]
    return Blend(pieces, np.stack(middles), turn)


def _turn(source: Places, target: Places, u: Floats, v: Floats) -> tuple[float, float]:
    """The turn of a line if its form asks for one, and what is left of it after that."""
    shares = np.linspace(0, 1, 65)
    at = np.interp(shares, (u + v) / 2, u), np.interp(shares, (u + v) / 2, v)
    one, other = source.point(at[0]), target.point(at[1])
    one, other = one - one.mean(axis=0), other - other.mean(axis=0)
    sizes = np.linalg.norm(one), np.linalg.norm(other)
    if not min(sizes) > 0:
        return 0.0, 1.0
    one, other = one / sizes[0], other / sizes[1]
    along, across = (one * other).sum(), cross(one, other).sum()
    rest, unturned = 1 - np.hypot(along, across) ** 2, 1 - along * abs(along)
    angle = float(np.arctan2(across, along))
    asked = rest < TURNED and rest < TURNED_PART * unturned and unturned > UNTURNED
    if asked and abs(angle) < FARTHEST:
        return angle, float(rest)
    return 0.0, float(unturned)


def _opening(ring: Places, line: Places) -> Pieces:
    """A ring that is cut and becomes a line, where it is nearest to it, each in its own box."""
    shares = np.linspace(0.0, 1.0, 33)
    there = _in_box(line.point(shares))
    every = _in_box(ring.point(np.arange(CUTS * 4) / (CUTS * 4)))
    best: tuple[float, float, bool] | None = None
    for k in range(CUTS):
        for backwards in (False, True):
            at = (4 * k + (-1 if backwards else 1) * np.arange(33) * CUTS * 4 // 32) % (CUTS * 4)
            cost = float(np.linalg.norm(every[at] - there, axis=1).mean())
            if best is None or cost < best[0] - 1e-6:
                best = cost, k / CUTS, backwards
    assert best is not None
    outline = opened(ring, best[1])
    if best[2]:
        outline = outline.reversed()
    source = Places(outline)
    u, v, _ = along_knots(source, line)
    return cut_alike(source, line, u, v)


def _in_box(points: Points) -> Points:
    low, high = points.min(axis=0), points.max(axis=0)
    return np.asarray((points - (low + high) / 2) / (float((high - low).max()) or 1.0))


def opened(ring: Places, share: float) -> Outline:
    """A ring cut open at a share of its length."""
    where, at = ring.locate(np.array([share]))
    curve, t = int(where[0]), float(at[0])
    curves = ring.outline.curves
    if t == 0:
        return Outline(np.roll(curves, -curve, axis=0), False)
    parts = sub_curves(curves[[curve, curve]], np.array([t, 0.0]), np.array([1.0, t]))
    run = np.concatenate([parts[:1], np.roll(curves, -curve - 1, axis=0)[:-1], parts[1:]])
    run[1:, 0] = run[:-1, 3]
    return Outline(run, False)
