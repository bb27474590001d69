"""The track of a pair of items, by what they are."""

from dataclasses import dataclass

import numpy as np

from shapetween.base.arrays import Floats
from shapetween.base.errors import OutlineError
from shapetween.base.notices import Notice
from shapetween.deform.check import LOOKED, crossing_frames
from shapetween.fill.morph import morph_fill
from shapetween.fill.settings import FillSettings
from shapetween.geometry.polygon import cross
from shapetween.match.candidate import agrees
from shapetween.match.frames import MIN_TURN
from shapetween.match.matcher import registered
from shapetween.model.outline import Outline
from shapetween.model.part import CurveTrack
from shapetween.outline.matching import upright_of
from shapetween.scene.doubtful import only_turns, own_matching
from shapetween.scene.forms import Dot, Form, OpenLine, RoundedBox, Segment
from shapetween.scene.items import Item
from shapetween.scene.motion.anchors import anchors
from shapetween.scene.motion.bend_knots import along_knots, ring_knots
from shapetween.scene.motion.boxes import HALF_TIE, box_blend
from shapetween.scene.motion.holes import hole_tracks
from shapetween.scene.motion.knots import graph_knots, kinks_of, without_points
from shapetween.scene.motion.mirrored import even_knots, mirrored_knots
from shapetween.scene.motion.mouths import mouth_track
from shapetween.scene.motion.opening import closing_pieces, opened_pieces
from shapetween.scene.motion.tracks import Blend
from shapetween.scene.motion.turned import turned_ring
from shapetween.scene.motion.turning import MOST_TURNS, total_turning, turning_excess
from shapetween.scene.places import Pieces, Places, cut_alike
from shapetween.scene.torn import folds

__all__ = [
    "SAME",
    "Ends",
    "corner_tracks",
    "corners_suffice",
    "elastic",
    "open_track",
    "tracks_of",
]

#: Residual of a line's best similarity, as shares: what a turn must leave at most, what part of the
#: residual without one, and what that must be at least, for a line to turn on its way.
TURNED, TURNED_PART, UNTURNED = 0.25, 0.45, 0.08

#: Farthest that a line turns by itself, radians: farther, and it goes end over end.
FARTHEST = np.deg2rad(100.0)

#: What distance of ends costs beside an outline's own matching when a line's direction is chosen.
ENDS = 0.5

#: Distance of two places, as a share of the drawing, that are one.
SAME = 2e-3

#: Least size of an outline, as a share of the drawing, for which the engine is worth its time.
LARGE = 0.22

#: Turning, in whole turns, of an outline that is plainly beyond `MOST_TURNS`, wherever it is begun
#: and cut. Less, and rounding would decide; more, and corners are matched for nothing.
TOO_MANY = 1.15 * MOST_TURNS

#: Share of its convex hull that an outline without limbs has.
CONVEX = 0.95


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
) -> tuple[tuple[CurveTrack, ...], tuple[Notice, ...]]:
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
    ring, line = (first, second) if first.closed else (second, first)
    if not ring.filled and folds(ring, line, ends.scale):
        pieces = closing_pieces(Places(ring.outer), Places(line.outer))
    else:
        pieces = opened_pieces(Places(ring.outer), Places(line.outer), ends.symmetric)
    if second.closed:
        pieces = Pieces(pieces.target, pieces.source, pieces.closed)
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
) -> tuple[tuple[CurveTrack, ...], tuple[Notice, ...]]:
    first, second = ends.first, ends.second
    places = Places(first.outer.clockwise()), Places(second.outer.clockwise())
    one, other = ends.forms
    if (opening := mouth_track(first, second)) is not None:
        return (opening,), ()
    if isinstance(one, RoundedBox) and isinstance(other, RoundedBox):
        outer = box_blend(one, other, *places)
        return (outer, *hole_tracks(first, second, outer)), ()
    turned = turned_ring(*places)
    if turned is not None:
        return (turned, *hole_tracks(first, second, turned)), ()
    anchored = anchors(first, second, SAME * ends.scale)
    if anchored is not None:
        found = _blend(cut_alike(*places, *anchored), first, second, 0.0)
        if _sound(found):
            return (found, *hole_tracks(first, second, found)), ()
    if ends.symmetric >= 0:
        halves = mirrored_knots(*places, ends.symmetric)
        if halves is not None:
            found = _blend(cut_alike(*places, *halves), first, second, 0.0)
            if _sound(found):
                return (found, *hole_tracks(first, second, found)), ()
    corners = _by_corners(first, second)
    simple = (corners.track, *hole_tracks(first, second, corners.track))
    if not (ends.root and min(first.extent, second.extent) > LARGE * ends.scale):
        return simple, ()
    turning = turning_excess(corners.track)
    agreed = turning.simple and _as_matched(corners, first, second, upright=True)
    if agreed and (turning.smooth or _blobs(first, second)):
        return simple, ()
    if turning.simple and only_turns(first, second):
        return simple, ()
    try:
        by_engine, notices = elastic(ends, settings, names)
    except OutlineError as error:
        name = first.name or second.name
        return simple, (Notice("by-corners", str(error), name, "it moves by its corners"),)
    if agreed and turning_excess(by_engine[0]).excess > turning.excess:
        return simple, ()
    return by_engine, notices


@dataclass(frozen=True, slots=True, eq=False)
class _Corners:
    """How an outer ring becomes another by its corners alone, and the knots of both.

    It is `even` where both rings are their own mirror images.
    """

    track: Blend
    u: Floats
    v: Floats
    even: bool


def _by_corners(first: Item, second: Item) -> _Corners:
    places = Places(first.outer.clockwise()), Places(second.outer.clockwise())
    mirrored = even_knots(*places)
    knots = ring_knots(*places) if mirrored is None else mirrored
    track = _blend(cut_alike(*places, *knots), first, second, 0.0)
    if mirrored is not None and not _sound(track):
        knots = ring_knots(*places)
        track = _blend(cut_alike(*places, *knots), first, second, 0.0)
    return _Corners(track, *knots, even=mirrored is not None)


def corner_tracks(first: Item, second: Item) -> tuple[CurveTrack, ...]:
    """An area and its holes by their corners alone."""
    found = _by_corners(first, second).track
    return (found, *hole_tracks(first, second, found))


def corners_suffice(first: Item, second: Item) -> bool:
    """Whether an area of no simple form becomes another by its corners alone.

    It does so where the outlines' own matching turns neither, and the corners throw no waves and
    go where that matching says, which knows more of the outlines; or where both are even.
    """
    blobs = _blobs(first, second)
    if not blobs and max(total_turning(item.outer.curves) for item in (first, second)) > TOO_MANY:
        return False
    if registered(first.outer.clockwise(), second.outer.clockwise()) is not None:
        return False
    corners = _by_corners(first, second)
    turning = turning_excess(corners.track)
    # What is even stays so by its corners, whatever waves it throws and wherever they go.
    even = turning.simple and corners.even
    if not (even or turning.smooth or blobs):
        return False
    return _as_matched(corners, first, second, anywhere=even)


def _as_matched(
    corners: _Corners,
    first: Item,
    second: Item,
    *,
    upright: bool = False,
    anywhere: bool = False,
) -> bool:
    """Whether the outlines' own matching neither turns nor evens them, and goes as corners do.

    Parameters
    ----------
    corners : _Corners
    first, second : Item
    upright : bool
        Whether they are parts of larger drawings, and so are not turned by themselves.
    anywhere : bool
        Whether it matters no more where it goes.
    """
    found = own_matching(first.outer.clockwise(), second.outer.clockwise())
    if found is None:
        return True
    found = upright_of(found) if upright else found
    as_drawn = abs(found.turn) < MIN_TURN and not found.lopsided
    return as_drawn and (anywhere or agrees(corners.u, corners.v, found))


def _blobs(first: Item, second: Item) -> bool:
    return _is_blob(first) and _is_blob(second)


def _is_blob(item: Item) -> bool:
    """Whether an outline is round all over, without limbs that could swing."""
    area = item.enclosed
    sharp = len(kinks_of(Places(item.outer))[0])
    return bool(
        item.closed and not item.holes and not sharp and area.area > CONVEX * area.convex_hull.area
    )


def elastic(
    ends: Ends, settings: FillSettings, names: tuple[str, str]
) -> tuple[tuple[CurveTrack, ...], tuple[Notice, ...]]:
    """The track of a pair of areas by the outline engine."""
    shapes = [
        item.replaced((item.outer.clockwise(), *item.holes)).as_shape
        for item in (ends.first, ends.second)
    ]
    part, notices = morph_fill(shapes[0], shapes[1], settings, names, alone=False)
    return (part,), notices


def _sound(track: Blend) -> bool:
    """Whether a ring never crosses itself on its way."""
    counts, closed = list(track.counts), list(track.closed)
    return not crossing_frames(track.curves(LOOKED), counts, closed).any()


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
