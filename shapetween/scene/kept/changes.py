"""How the pieces that only one of two areas has come and go beside what both have."""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from shapetween.base.arrays import Curves, Points
from shapetween.base.ranking import comparable
from shapetween.model.outline import Outline
from shapetween.model.part import CurveTrack
from shapetween.scene.kept.appearing import HalfPlaneClip, Telescoped, extent_along
from shapetween.scene.kept.bars import Bar, bar_of, round_stroke, slot_of
from shapetween.scene.kept.holes import unmatched_hole_track
from shapetween.scene.kept.outlines import outline_tracks
from shapetween.scene.kept.pieces import Overlay, Piece
from shapetween.scene.kept.strips import Strip, Tip
from shapetween.scene.kept.symmetry import Reflection, reflections
from shapetween.scene.motion.tracks import Blend, InTurn
from shapetween.scene.places import Pieces

if TYPE_CHECKING:
    import shapely

__all__ = ["tracks_of_pieces"]

#: Least share of a piece's border that is free for it to be open to the outside.
OPEN = 0.02

#: Distance of the middles of a piece's free border and of its contact, as a share of its size, from
#: which on it lies between them.
ONE_SIDED = 0.12

#: Areas, as a share of what is kept, of pieces beside no bar that come and that go: more of both,
#: and something moves.
MOVED = 0.06

#: The same where outlines have most of their length in common, so that whatever differs is seen as
#: parts. Smaller, and a screen leaves for one with an arrow; larger, and half a drawing is wiped.
MOVED_PARTS = 0.12

#: Share of a piece half sunk into what it stands on that may come out elsewhere.
STRAY = 0.03

#: Cosine of the angle within which a border runs straight up, and least share of it that does so,
#: for a piece to slide into what it stands on as it is; others are clipped.
WALL, WALLS = 0.96, 0.35

#: Least area, as a share of what is kept, that comes or goes for whole outlines to move.
LARGE = 0.15

#: Greatest ratio of what is free of the borders of gaps beside a bar, and what is not. A gap is
#: free at its ends; edges that move leave pieces free along all their length.
GAP = 0.8

#: Share of a slash that may be missing in the area that has it, and least share that is cleared of
#: what was beside it: on one side at least most is. Less, and wings that a body gets on both sides
#: are a slash; more, and the slash through an outline comes in chunks.
BARRED, CLEARED = 0.03, 0.2

#: Cosine of the angle of a stroke and of the bar that it is drawn with. Smaller, and tips leave it.
ALONG = 0.999

#: Least ratio of what a piece touches and what is free of it, for it to be a notch.
NOTCH = 2.0

#: Least ratio of the distance between the ends of what a piece stands on and its length.
STRAIGHT = 0.95

#: Least ratio of the distance between the ends of what a piece touches and its length, for it to be
#: one edge. Smaller, and a bay is one; larger, and one with round corners is none.
EDGE = 0.85

#: Least mean height of a piece over what it stands on, as a share of its foot, to be a part by
#: itself. A corner has a quarter; larger, and corners are rounded from all along their edges.
FLAT = 0.15

#: Part of a direction across an axis of symmetry up to which it is along that. Larger, and a flap
#: opens from one side; at 0 rounding decides.
ASKEW = 0.1

#: Area, as a share of what is kept, of a flat piece that is the rounding of a corner. Larger, and
#: edges that move are clipped; at 0 an envelope whose flap opens is drawn anew for its corners.
TINY = 0.005

#: Most pieces besides holes and what lies beside bars.
MOST_PIECES = 6


def tracks_of_pieces(
    laid: Overlay,
    bars: Sequence[Bar],
    bitten: Collection[Piece],
    cleared: Collection[Piece],
    first: Mapping[int, Outline],
    second: Mapping[int, Outline],
    unmatched: int,
    reach: float,
    *,
    parts: bool,
) -> tuple[CurveTrack, ...] | None:
    """Tracks of what is kept, first its largest ring, and of all pieces.

    Parameters
    ----------
    laid : Overlay
    bars : sequence of Bar
        Bars that one of the areas has and the other has not.
    bitten : collection of Piece
        What badges bite off, which is moved with those.
    cleared : collection of Piece
        What goes before something comes in its place, or comes after that has gone.
    first, second : mapping of int to Outline
        Rings of both areas but for loose holes, as they are drawn, by their numbers.
    unmatched : int
        How many loose holes open or close by themselves.
    reach : float
        Distance within which outlines are one.
    parts : bool
        Whether what differs comes and goes as parts even where edges look as if they moved.

    Returns
    -------
    tuple of CurveTrack or None
        None if what differs has rather moved.
    """
    import shapely

    axes = reflections(laid)
    holes: list[Piece] = []
    others: list[Piece] = []
    for piece in laid.pieces:
        if any(piece is own for own in bitten):
            continue
        closed = piece.free.length < OPEN * piece.area.length and not len(piece.area.interiors)
        (holes if closed else others).append(piece)
    slivers = [p for p in others if 2 * p.area.area < reach * p.area.length]
    others = [p for p in others if all(p is not own for own in slivers)]
    groups, rest = _beside(others, bars)
    if not any(groups):
        bars = _common_bar(others, laid.kept)
        bars = [bar for bar in bars if not any(_across(bar, axis) for axis in axes)]
        groups, rest = _beside(others, bars)
    openings = [unmatched_hole_track(laid.rings_of(piece)[0], piece.comes) for piece in holes]
    areas = [sum(p.area.area for p in rest if p.comes == comes) for comes in (False, True)]
    large = max(areas) > LARGE * laid.kept.area
    # A hole that opens to the outside is none by itself: outlines alone would leave it out.
    whole = len(openings) == unmatched
    if large and whole and not any(groups) and not all(_stands(piece, laid) for piece in rest):
        outlines = outline_tracks(first, second, laid.snapped.arcs, reach)
        if outlines is not None:
            return (*outlines, *openings)
    if min(areas) > (MOVED_PARTS if parts else MOVED) * laid.kept.area or len(rest) > MOST_PIECES:
        return None
    if not parts and _edges_move(rest, laid.kept.area, reach):
        return None
    solid = shapely.union_all([laid.kept, *(p.area for p in holes)])
    rings = sorted(laid.outlines(solid), key=lambda r: -round(abs(r.area) / laid.scale**2, 9))
    tracks: list[CurveTrack] = [_blend(ring.curves, laid.at_last(ring)) for ring in rings]
    for bar, group in zip(bars, groups, strict=True):
        tracks += _along(bar, group, laid)
    for piece in (*rest, *slivers):
        waits = any(piece is own for own in cleared)
        track = _at_contact(piece, _even_way(piece, laid.pieces, axes), laid, cut=waits)
        tracks.append(InTurn(track, first=not piece.comes) if waits else track)
    return (*tracks, *openings)


def _beside(pieces: Sequence[Piece], bars: Sequence[Bar]) -> tuple[list[list[Piece]], list[Piece]]:
    """Pieces that lie beside each bar, and the others."""
    import shapely

    groups: list[list[Piece]] = [[] for _ in bars]
    rest: list[Piece] = []
    for piece in pieces:
        points = shapely.get_coordinates(piece.area)
        found = [
            k
            for k, bar in enumerate(bars)
            if bar.holds(points) or (piece.comes != bar.comes and bar.touches(piece.area))
        ]
        (groups[found[0]] if found else rest).append(piece)
    return groups, rest


def _edges_move(rest: Sequence[Piece], kept: float, reach: float) -> bool:
    """Whether what comes and goes lies along edges that move, rather than being parts by itself."""
    import shapely

    for piece in rest:
        if piece.contact.is_empty:
            continue
        ends = shapely.get_coordinates(shapely.line_merge(piece.contact).boundary)
        across = float(np.hypot(*(ends[-1] - ends[0]))) if len(ends) == 2 else np.inf
        bent = across < STRAIGHT * piece.contact.length < STRAIGHT * piece.free.length
        notch = piece.contact.length > NOTCH * piece.free.length
        flat = piece.area.area < FLAT * piece.contact.length**2 and not notch
        if bent or (flat and piece.area.area > TINY * kept):
            return True
    come, go = ([p.area for p in rest if p.comes == comes] for comes in (True, False))
    return bool(
        come and go and shapely.distance(shapely.union_all(come), shapely.union_all(go)) < reach
    )


def _common_bar(pieces: Sequence[Piece], kept: "shapely.Geometry") -> list[Bar]:
    """The bar that several pieces are parts of together, as those of a slash are.

    They are those beside it too, or the slash alone: what both have may be some of that. Or they
    are a slot that nothing is in.
    """
    import shapely

    sides = [[p for p in pieces if p.comes == comes] for comes in (False, True)]
    ratios = [
        sum(p.free.length for p in side) / max(sum(p.contact.length for p in side), 1e-300)
        for side in sides
    ]
    if not all(sides):
        gaps = shapely.union_all([piece.area for piece in pieces])
        slot = slot_of(gaps) if max(ratios) <= GAP else None
        return [] if slot is None else [replace(slot, comes=not pieces[0].comes)]
    if min(ratios) <= GAP:
        together = shapely.union_all([piece.area for piece in pieces])
        bar = bar_of(together.convex_hull)
        if bar is not None:
            # Which of the areas has it: what reaches farthest.
            far = [
                float(np.abs((shapely.get_coordinates(p.area) - bar.centre) @ bar.ahead).max())
                for p in pieces
            ]
            return [replace(bar, comes=pieces[int(comparable(far).argmax())].comes)]
    for comes, side in enumerate(sides):
        hull = shapely.union_all([piece.area for piece in side]).convex_hull
        bar = bar_of(hull, comes=bool(comes))
        whole = shapely.union_all([kept, *(piece.area for piece in side)])
        if bar is None or hull.difference(whole).area > BARRED * hull.area:
            continue
        if bar.clears(kept, shapely.union_all([p.area for p in sides[1 - comes]])) > CLEARED:
            return [bar]
    return []


def _blend(source: Curves, target: Curves) -> Blend:
    return Blend(Pieces(source, target, True), np.stack([source[0, 0], target[0, 0]]))


def _along(bar: Bar, group: Sequence[Piece], laid: Overlay) -> list[CurveTrack]:
    """Pieces clipped as a bar is drawn, or undrawn."""
    import shapely

    if not group:
        return []
    rings = [laid.rings_of(p) for p in group]
    reaches = [bar.ends, *(extent_along(own, bar.ahead) for own in rings)]
    low, high = min(low for low, _ in reaches), max(high for _, high in reaches)
    ends = (low, high) if bar.comes else (high, low)
    stroke = round_stroke([p for p in group if p.comes == bar.comes], laid)
    tipped = stroke is not None and float(stroke.ahead @ bar.ahead) > ALONG
    tip: Tip | None = None
    if stroke is not None and tipped:
        reach = (stroke.length / 2 - stroke.half) * stroke.ahead
        centres = np.stack([stroke.centre - reach, stroke.centre + reach])
        first, last = ((centres @ bar.ahead - low) / (high - low)).tolist()
        tip = Tip(centres, stroke.half, (first, last), bar.comes)
    tracks: list[CurveTrack] = []
    for p, own in zip(group, rings, strict=True):
        behind = p.comes == bar.comes
        beside = behind or bar.holds(shapely.get_coordinates(p.area))
        if behind and tip is not None:
            tracks.append(tip.under(own))
        elif beside and (strip := Strip(own, bar.ahead, ends, behind)).keeps_to(p.area):
            tracks.append(strip)
        else:  # It is no strip: what becomes of one is a claw of it.
            tracks.append(HalfPlaneClip(own, bar.ahead, ends, behind))
    return tracks if tip is None else [*tracks, tip]


def _across(bar: Bar, axis: Reflection) -> bool:
    """Whether a bar is drawn from one side to the other of what is symmetric."""
    return bool(abs(bar.ahead[axis.flips]) > ASKEW)


def _even_way(piece: Piece, pieces: Sequence[Piece], axes: Sequence[Reflection]) -> Points:
    """As `_way`, so that what is symmetric stays so."""
    for axis in axes:
        mate = axis.mate(piece, pieces)
        if mate is None:
            continue
        if mate is not piece:
            first = next(own for own in pieces if own is piece or own is mate)
            way = _way(first)
            return way if first is piece else axis.of_way(way)
        way = axis.along(_way(piece))
        length = float(np.hypot(*way))
        if length <= ASKEW:  # it lies across the axis, and comes from its foot
            way = axis.along(_from_foot(piece))
            length = float(np.hypot(*way))
        if length > 0:
            return np.asarray(way / length)
    return _way(piece)


def _from_foot(piece: Piece) -> Points:
    """From the middle of what a piece touches to that of its free border."""
    middles = [np.array([g.centroid.x, g.centroid.y]) for g in (piece.contact, piece.free)]
    return np.asarray(middles[1] - middles[0])


def _at_contact(piece: Piece, way: Points, laid: Overlay, *, cut: bool) -> CurveTrack:
    """A piece that comes out of what it touches, or goes into it; or is cut off by a line."""
    rings = laid.rings_of(piece)
    low, high = extent_along(rings, way)
    if not cut and _stands(piece, laid) and _has_walls(piece, way):
        return Telescoped(rings, way, low, high - low, piece.comes)
    ends = (low, high) if piece.comes else (high, low)
    return HalfPlaneClip(rings, way, ends, True)


def _stands(piece: Piece, laid: Overlay) -> bool:
    """Whether a piece stands on what is kept, and slides into it without coming out elsewhere."""
    import shapely

    if piece.contact.is_empty or piece.contact.length > piece.free.length:
        return False
    way = _way(piece)
    points = shapely.get_coordinates(piece.area.exterior)
    places = points @ way
    low, high = float(places.min()), float(places.max())
    half = np.minimum((high - low) / 2, places - low)
    sunk = shapely.make_valid(shapely.Polygon(points - half[:, None] * way))
    stray = sunk.difference(shapely.union(piece.area, laid.kept))
    return bool(stray.area < STRAY * piece.area.area)


def _has_walls(piece: Piece, way: Points) -> bool:
    """Whether much of a piece's free border runs straight up from what it stands on."""
    import shapely

    steps = [
        np.diff(shapely.get_coordinates(line), axis=0)
        for line in shapely.get_parts(shapely.line_merge(piece.free)).tolist()
    ]
    every = np.concatenate(steps)
    lengths = np.linalg.norm(every, axis=1)
    upright = np.abs(every @ way) > WALL * lengths
    return bool(lengths[upright].sum() > WALLS * lengths.sum())


def _edge_way(piece: Piece) -> Points | None:
    """Direction square to the one nearly straight edge that a piece touches; None without one."""
    import shapely

    line = shapely.line_merge(piece.contact)
    if line.geom_type != "LineString":
        return None
    ends = shapely.get_coordinates(line)[[0, -1]]
    along = ends[1] - ends[0]
    length = float(np.hypot(*along))
    if length < EDGE * line.length:
        return None
    way = np.array([-along[1], along[0]]) / length
    middle = np.array([piece.area.centroid.x, piece.area.centroid.y])
    return np.asarray(way if (middle - ends[0]) @ way > 0 else -way)


def _way(piece: Piece) -> Points:
    """Direction from where a piece touches what is kept to its free end, of length 1."""
    size = float(np.sqrt(piece.area.area))
    if not piece.contact.is_empty and not piece.free.is_empty:
        edge = _edge_way(piece)
        if edge is not None:
            return edge
        way = _from_foot(piece)
        length = float(np.hypot(*way))
        if length > ONE_SIDED * size:
            return np.asarray(way / length)
    import shapely

    corners = shapely.get_coordinates(piece.area.minimum_rotated_rectangle)
    sides = np.diff(corners[:3], axis=0)
    lengths = np.linalg.norm(sides, axis=1)
    return np.asarray(sides[int(comparable(lengths).argmax())] / lengths.max())
