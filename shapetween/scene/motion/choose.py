"""The track of a pair of items, by what they are."""

from dataclasses import dataclass

import numpy as np

from shapetween.base.arrays import Floats, Points
from shapetween.base.errors import OutlineError
from shapetween.base.notices import Notice
from shapetween.deform.check import crossing_frames
from shapetween.fill.morph import morph_fill
from shapetween.fill.settings import FillSettings
from shapetween.geometry.bezier import sub_curves
from shapetween.geometry.polygon import cross
from shapetween.model.outline import Outline
from shapetween.scene.forms import Dot, Form, OpenLine, RoundedBox, Segment
from shapetween.scene.items import Item
from shapetween.scene.motion.bend_knots import along_knots, half_knots, ring_knots
from shapetween.scene.motion.boxes import HALF_TIE, box_blend
from shapetween.scene.motion.holes import hole_tracks
from shapetween.scene.motion.knots import anchored_knots, graph_knots, kinks_of, without_points
from shapetween.scene.motion.tracks import Blend, Elastic, Track
from shapetween.scene.places import Pieces, Places, cut_alike

__all__ = ["SAME", "Ends", "elastic", "is_blob", "open_track", "tracks_of"]

#: Residual of a line's best similarity, as shares: what a turn must leave at most, what part of the
#: residual without one, and what that must be at least, for a line to turn on its way.
TURNED, TURNED_PART, UNTURNED = 0.25, 0.45, 0.08

#: Farthest that a line turns by itself, radians: farther, and it goes end over end.
FARTHEST = np.deg2rad(100.0)

#: What distance of ends costs beside an outline's own matching when a line's direction is chosen.
ENDS = 0.5

#: Starts at which a ring may be cut to become a line.
CUTS = 48

#: Shares of a ring that a line may become, the rest growing out of its ends; and what part of the
#: distance of all of it that of a part must be at most.
PARTS, PART_BETTER = (1.0, 0.85, 0.7, 0.55), 0.75

#: Distance of two places, as a share of the drawing, that are one.
SAME = 2e-3

#: Least size of an outline, as a share of the drawing, for which the engine is worth its time.
LARGE = 0.22

#: Share of its convex hull that an outline without limbs has.
CONVEX = 0.95

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
        return elastic(ends, settings, names)
    if _same(first, second):
        return tuple(_still(ring, other) for ring, other in _rings(first, second)), ()
    if first.closed and second.closed:
        return _closed(ends, settings, names)
    if not first.closed and not second.closed:
        return (open_track(ends),), ()
    dots = [isinstance(form, Dot) for form in ends.forms]
    if any(dots) and _round(first) and _round(second):
        source, target = (
            Places(item.outer if item.closed else _folded(item.outer)) for item in (first, second)
        )
        one, other = _as_box(first, ends.forms[0]), _as_box(second, ends.forms[1])
        if one is not None and other is not None:
            return (box_blend(one, other, source, target),), ()
        pieces = cut_alike(source, target, *ring_knots(source, target))
        return (_blend(pieces, first, second, 0.0),), ()
    if first.closed:
        pieces = _opening(Places(first.outer), Places(second.outer), ends.symmetric)
    else:
        back = _opening(Places(second.outer), Places(first.outer), ends.symmetric)
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


def _closed(
    ends: Ends, settings: FillSettings, names: tuple[str, str]
) -> tuple[tuple[Track, ...], tuple[Notice, ...]]:
    first, second = ends.first, ends.second
    places = Places(first.outer.clockwise()), Places(second.outer.clockwise())
    one, other = ends.forms
    if isinstance(one, RoundedBox) and isinstance(other, RoundedBox):
        outer = box_blend(one, other, *places)
        return (outer, *hole_tracks(first, second, outer)), ()
    anchored = anchored_knots(*places, SAME * ends.scale)
    if anchored is not None:
        found = _blend(cut_alike(*places, *anchored), first, second, 0.0)
        if _sound(found):
            return (found, *hole_tracks(first, second, found)), ()
    if ends.symmetric >= 0:
        halves = _halves(ends, *places)
        if halves is not None and _sound(halves):
            return (halves, *hole_tracks(first, second, halves)), ()
    simple = None
    blobs = is_blob(first) and is_blob(second)
    if blobs or not (ends.root and min(first.extent, second.extent) > LARGE * ends.scale):
        knots = ring_knots(*places)
        simple = _blend(cut_alike(*places, *knots), first, second, 0.0)
        small = min(first.extent, second.extent) <= LARGE * ends.scale
        if blobs or small or _sound(simple):
            return (simple, *hole_tracks(first, second, simple)), ()
    try:
        return elastic(ends, settings, names)
    except OutlineError:
        if simple is None:
            simple = _blend(cut_alike(*places, *ring_knots(*places)), first, second, 0.0)
        return (simple, *hole_tracks(first, second, simple)), ()


def is_blob(item: Item) -> bool:
    """Whether an outline is round all over, without limbs that could swing."""
    area = item.enclosed
    sharp = len(kinks_of(Places(item.outer))[0])
    return bool(
        item.closed and not item.holes and not sharp and area.area > CONVEX * area.convex_hull.area
    )


def elastic(
    ends: Ends, settings: FillSettings, names: tuple[str, str]
) -> tuple[tuple[Track, ...], tuple[Notice, ...]]:
    """The track of a pair of areas by the outline engine."""
    shapes = [
        item.replaced((item.outer.clockwise(), *item.holes)).as_shape
        for item in (ends.first, ends.second)
    ]
    part, said = morph_fill(shapes[0], shapes[1], settings, names, alone=False)
    return (Elastic(part),), said


def _sound(track: Blend) -> bool:
    """Whether a ring never crosses itself on its way."""
    counts, closed = list(track.counts), list(track.closed)
    return not crossing_frames(track.curves(LOOKED), counts, closed).any()


def _halves(ends: Ends, source: Places, target: Places) -> Blend | None:
    """Two rings that are their own mirror images, so that they stay so."""
    crossings = [
        _crossings(places, item.box.mean(axis=0), ends.symmetric)
        for places, item in ((source, ends.first), (target, ends.second))
    ]
    if crossings[0] is None or crossings[1] is None:
        return None
    knots = half_knots(source, target, crossings[0], crossings[1])
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
        # Halved until rounding: what is a little off the axis leans.
        low, high = shares[k], shares[k + 1]
        for _ in range(40):
            half = (low + high) / 2
            there = places.point(np.array([half]))[0, flips] - middle[flips]
            low, high = (half, high) if there * side[k] > 0 else (low, half)
        found.append((low + high) / 2)
    for k in np.flatnonzero(sign[:-1] == 0):
        before, after = sign[k - 1 if k else -2], sign[k + 1]
        if before * after < 0:
            found.append(shares[k])
    if len(found) < 2:
        return None
    along = places.point(np.array(found))[:, 1 - flips]
    first, last = found[int(along.argmin())], found[int(along.argmax())]
    return first, last + (last < first)


def open_track(ends: Ends) -> Blend:
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
            knots = without_points(*knots)
            return _blend(cut_alike(source, target, *knots), first, second, 0.0)
        u, v, cost = along_knots(source, target, mirrored=ends.symmetric >= 0)
        if isinstance(one, OpenLine) and isinstance(other, OpenLine):
            corners = other.corners, other.turns
            if backwards:
                corners = 1 - other.corners[::-1], -other.turns[::-1]
            alike = len(one.corners) == len(corners[0]) > 0
            # One corner may turn over, as an arrow's head does that points the other way.
            if alike and (len(corners[0]) == 1 or (one.turns * corners[1] > 0).all()):
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


def _opening(ring: Places, line: Places, flips: int) -> Pieces:
    """A ring that is cut and becomes a line, where it is nearest to it, each in its own box.

    If only a part of it is near the line, that becomes the line, and the rest goes into its ends.
    Of their own mirror images about one axis the ring is cut on it.
    """
    crossings = None
    if flips >= 0:
        box = ring.outline.curves.reshape(-1, 2)
        crossings = _crossings(ring, (box.min(axis=0) + box.max(axis=0)) / 2, flips)
    mirrored = crossings is not None
    cuts = np.arange(CUTS) / CUTS if crossings is None else np.array(crossings) % 1.0
    steps = np.linspace(0.0, 1.0, 33)
    there = _in_box(line.point(steps))
    best: tuple[float, float, bool, float] | None = None
    for part in PARTS[:1] if mirrored else PARTS:
        for backwards in (False, True):
            ahead = (-1 if backwards else 1) * part * steps
            every = ring.point((cuts[:, None] + ahead).ravel()).reshape(len(cuts), -1, 2)
            costs = np.linalg.norm(_in_box(every) - there, axis=-1).mean(axis=1)
            k = int(np.round(costs, 6).argmin())
            cost = float(costs[k]) if part == 1.0 else float(costs[k]) / PART_BETTER
            if best is None or cost < best[0] - 1e-6:
                best = cost, float(cuts[k]), backwards, part
    assert best is not None
    _, start, backwards, part = best
    rest = (1 - part) / 2
    outline = opened(ring, (start + rest if backwards else start - rest) % 1.0)
    source = Places(outline.reversed() if backwards else outline)
    if part == 1.0:
        u, v, _ = along_knots(source, line, mirrored=mirrored)
        return cut_alike(source, line, u, v)
    inner = np.array([0.0, rest, 1 - rest, 1.0])
    return cut_alike(source, line, inner, np.array([0.0, 0.0, 1.0, 1.0]))


def _round(item: Item) -> bool:
    """Whether ends of a line look as its corners do."""
    stroke = item.style.stroke
    return stroke is not None and stroke.cap == stroke.join == "round" and not stroke.dashes


def _folded(line: Outline) -> Outline:
    """A line there and back, which looks the same under round caps."""
    return Outline(np.concatenate([line.curves, line.reversed().curves]), True)


def _as_box(item: Item, form: Form) -> RoundedBox | None:
    """A straight line as a box of no height, and a dot as the disc that it is."""
    if isinstance(form, Segment):
        way = form.end - form.start
        sides = np.array([float(np.hypot(*way)), 0.0])
        angle = float(np.arctan2(way[1], way[0]))
        return RoundedBox((form.start + form.end) / 2, sides, angle, np.zeros(2))
    if isinstance(form, Dot):
        sides = np.asarray(np.ptp(item.box, axis=0))
        return RoundedBox(item.box.mean(axis=0), sides, 0.0, sides / 2)
    return None


def _in_box(points: Points) -> Points:
    low, high = points.min(axis=-2, keepdims=True), points.max(axis=-2, keepdims=True)
    size = (high - low).max(axis=-1, keepdims=True)
    return np.asarray((points - (low + high) / 2) / np.where(size > 0, size, 1.0))


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
