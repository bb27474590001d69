"""Badges: a part that comes with a bite cut out of the body round it, which opens as it grows."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from shapetween.base.arrays import Curves, Floats, Points
from shapetween.geometry.bezier import evaluate, sub_curves
from shapetween.geometry.polygon import cross
from shapetween.model.outline import Outline
from shapetween.model.part import CurveTrack, Leaf
from shapetween.scene.items import Item
from shapetween.scene.kept.appearing import OfRings, linked, unit_circle
from shapetween.scene.kept.pieces import Overlay, Piece, drawn_rings

if TYPE_CHECKING:
    import shapely

__all__ = ["Badge", "Grown", "badge_tracks", "badges_of", "blunt_badges", "meets"]

#: Widest gap between a badge and the body, as a share of the drawing.
WIDEST = 0.15

#: Most by which that gap varies, as a share of its mean: a bite is the badge's own offset shape.
VARIES = 0.35

#: Most that is bitten off, as a share of what is left. Larger, and a globe's lines are what an
#: arrow in its ring had bitten off; smaller, and a badge as large as half a bell pushes it aside.
MOST_BITTEN = 0.8

#: Least ratio of the distance between the ends of an edge and its length, for it to be no bite.
#: Smaller, and a shallow bite is none; at 1 rounding makes a bite of a straight edge.
STRAIGHT = 0.985

#: Directions round a badge's middle in which the reach of its bite is known, and between how many
#: of them the border of a bite that opens is straight. Fewer of these, and its corners are seen;
#: more, and files grow.
AROUND, STRAIGHTS = 720, 90

#: Angle, radians, by which a bite's border may run back as seen from there, at its very ends.
BACK = 0.01

#: Places on a curve by which it is known what directions it passes.
LOOKED = 17

#: Distance of the middle from the bite's border, as a share of its size, below which it is moved
#: away by as much: a border through the middle has no direction there.
ASIDE = 0.02

#: Share of its reach by which what is bitten off may lie beyond it.
BEYOND = 0.03

#: Size, as a share of its reach, of a bite that is not open yet.
POINT = 1e-9

#: Power of the time that is left by which a badge is still to grow. At 1 it comes evenly, a dot
#: for long; much larger, and it snaps.
GROWS = 2.0


@dataclass(frozen=True, slots=True, eq=False)
class Badge:
    """A part beside what is kept, and what is bitten out of that round it.

    Attributes
    ----------
    items : tuple of int
        Its own, among those that were looked at.
    comes : bool
        Whether the second drawing has it.
    pieces : tuple of Piece
        What is bitten off.
    centre, middle : (2,) float64
        What it grows about, and what the bite opens about, which is next to that.
    reach : (AROUND,) float64
        How far the bite reaches from its middle, by direction.
    """

    items: tuple[int, ...]
    comes: bool
    pieces: tuple[Piece, ...]
    centre: Points
    middle: Points
    reach: Floats


def badges_of(
    laid: Overlay, beside: tuple[Sequence[Item], Sequence[Item]], scale: float
) -> list[Badge]:
    """Which items beside what is kept have a bite round them.

    Parameters
    ----------
    laid : Overlay
    beside : (sequence of Item, sequence of Item)
        Items of both drawings that are in neither of the areas.
    scale : float
        Size of the drawing.
    """
    import shapely

    found: dict[tuple[bool, tuple[int, ...]], list[Piece]] = {}
    for piece in laid.pieces:
        if piece.contact.is_empty or piece.free.is_empty or _is_straight(piece.contact):
            continue
        comes = not piece.comes
        items = beside[int(comes)]
        drawn = np.array([item.drawn for item in items], dtype=object)
        edge = shapely.points(
            shapely.get_coordinates(shapely.segmentize(piece.contact, scale / 200))
        )
        near = tuple(
            k
            for k, area in enumerate(drawn)
            if shapely.distance(area, piece.contact) < WIDEST * scale
        )
        if not near:
            continue
        away = shapely.distance(shapely.union_all(drawn[list(near)]), edge)
        if away.min() > 0 and np.ptp(away) <= VARIES * 2 * away.mean():
            found.setdefault((comes, near), []).append(piece)
    badges = []
    for (comes, near), pieces in found.items():
        if sum(piece.area.area for piece in pieces) > MOST_BITTEN * laid.kept.area:
            continue
        boxes = np.array([beside[int(comes)][k].box for k in near])
        centre = (boxes[:, 0].min(axis=0) + boxes[:, 1].max(axis=0)) / 2
        middle = _aside(centre, pieces)
        reach = _reach(pieces, middle)
        if reach is not None:
            badges.append(Badge(near, comes, tuple(pieces), centre, middle, reach))
    return badges


def _is_straight(contact: "shapely.Geometry") -> bool:
    """Whether lines are one straight edge: no badge has such a border."""
    import shapely

    line = shapely.line_merge(contact)
    if line.geom_type != "LineString":
        return False
    ends = shapely.get_coordinates(line)[[0, -1]]
    return bool(np.hypot(*(ends[1] - ends[0])) > STRAIGHT * line.length)


def badge_tracks(badge: Badge, items: Sequence[Item], laid: Overlay) -> list[CurveTrack]:
    """Tracks of a badge's items and of what is bitten off.

    Parameters
    ----------
    badge : Badge
    items : sequence of Item
        Those that were looked at.
    laid : Overlay
    """
    import shapely

    rings = drawn_rings([items[k] for k in badge.items])
    tracks: list[CurveTrack] = [Grown(tuple(rings), badge.centre, badge.comes)]
    for piece in badge.pieces:
        holds = bool(piece.area.contains(shapely.Point(badge.middle)))
        tracks.append(Bitten(laid.rings_of(piece), badge.middle, badge.reach, badge.comes, holds))
    return tracks


def meets(badge: Badge, beside: tuple[Sequence[Item], Sequence[Item]]) -> bool:
    """Whether something of the other drawing lies where a badge is: one waits for the other."""
    boxes = np.array([beside[int(badge.comes)][k].box for k in badge.items])
    low, high = boxes[:, 0].min(axis=0), boxes[:, 1].max(axis=0)
    return any(
        bool((item.box[0] < high).all() and (item.box[1] > low).all())
        for item in beside[1 - int(badge.comes)]
    )


def blunt_badges(
    laid: Overlay, beside: tuple[Sequence[Item], Sequence[Item]], badges: Sequence[Badge]
) -> tuple[list[tuple[int, bool]], list[Piece]]:
    """Items that come where something is cut off straight, and what is.

    Returns
    -------
    list of (int, bool)
        Which items, and whether the second drawing has them.
    list of Piece
        What goes before they come, or comes after they have gone.
    """
    bitten = [piece for badge in badges for piece in badge.pieces]
    taken = {(badge.comes, k) for badge in badges for k in badge.items}
    items: list[tuple[int, bool]] = []
    pieces: list[Piece] = []
    for piece in laid.pieces:
        comes = not piece.comes
        found = [
            (k, comes)
            for k, item in enumerate(beside[comes])
            if (comes, k) not in taken and item.drawn.intersects(piece.area)
        ]
        if found and not any(piece is own for own in bitten):
            pieces.append(piece)
            items += [one for one in found if one not in items]
    return items, pieces


def _aside(centre: Points, pieces: Sequence[Piece]) -> Points:
    """A place next to a centre that lies on no border of what is bitten off."""
    import shapely

    for piece in pieces:
        size = float(np.sqrt(piece.area.area))
        if piece.area.boundary.distance(shapely.Point(centre)) < ASIDE * size:
            inner = piece.area.representative_point()
            away = centre - np.array([inner.x, inner.y])
            centre = centre + ASIDE * size * away / float(np.hypot(*away))
    return centre


def _reach(pieces: Sequence[Piece], centre: Points) -> Floats | None:
    """How far a bite reaches from its middle, by direction; None if it is not seen from there."""
    import shapely

    table = np.full(AROUND, np.nan)
    for piece in pieces:
        lines = shapely.get_parts(shapely.line_merge(piece.contact)).tolist()
        for line in lines:
            angle, away = _polar(_dense(line), centre)
            steps = np.diff(angle)
            if min(steps.clip(min=0).sum(), -steps.clip(max=0).sum()) > BACK:
                return None
            if steps.sum() < 0:
                angle, away = angle[::-1], away[::-1]
            place = np.maximum.accumulate(angle) / (2 * np.pi) * AROUND
            inner = np.arange(np.ceil(place[0]), np.floor(place[-1]) + 1)
            table[inner.astype(int) % AROUND] = np.interp(inner, place, away)
    known = np.flatnonzero(~np.isnan(table))
    if not len(known):
        return None
    every = np.arange(AROUND)
    reach = np.interp(every, known, table[known], period=AROUND)
    free = np.isnan(table)
    for piece in pieces:
        angle, away = _polar(_dense(piece.area.boundary), centre)
        at = np.round(angle / (2 * np.pi) * AROUND).astype(int) % AROUND
        if (away > (1 + BEYOND) * np.interp(at, every, reach))[~free[at]].any():
            return None
        np.maximum.at(reach, at[free[at]], away[free[at]])
    return np.asarray(reach)


def _dense(line: "shapely.Geometry") -> Points:
    import shapely

    return np.asarray(shapely.get_coordinates(shapely.segmentize(line, line.length / AROUND)))


def _polar(points: Points, centre: Points) -> tuple[Floats, Floats]:
    """Directions of points, going on from one to the next, and distances from a centre."""
    offsets = points - centre
    angle = np.unwrap(np.arctan2(offsets[..., 1], offsets[..., 0]))
    return angle, np.hypot(offsets[..., 0], offsets[..., 1])


def _grown(t: Floats, comes: bool) -> Floats:
    return np.asarray(1 - (1 - t if comes else t) ** GROWS)


@dataclass(frozen=True, eq=False)
class Grown(OfRings):
    """Rings that grow about a place, or shrink into it.

    Attributes
    ----------
    centre : (2,) float64
    comes : bool
    """

    centre: Points
    comes: bool

    def curves(self, t: Floats) -> Curves:
        """Control points at the times (F,), (F, N, 4, 2)."""
        whole = np.concatenate([ring.curves for ring in self.rings])
        size = _grown(t, self.comes)[:, None, None, None]
        grown = self.centre + size * (whole - self.centre)
        return np.where(size == 1, whole, grown)


@dataclass(frozen=True, eq=False)
class Bitten(Leaf):
    """Rings of which what lies near a place is pushed away from it, as far as a bite reaches.

    Attributes
    ----------
    rings : tuple of Outline
    centre : (2,) float64
    reach : (AROUND,) float64
        How far the whole bite reaches, by direction.
    comes : bool
        Whether the bite opens.
    holds : bool
        Whether the place is inside of the rings: the bite is a hole there at first.

    Notes
    -----
    A point at the distance r in the direction u goes to max(r, s R(u)) u, R being the reach and s
    the bite's size. That leaves all outside of the bite where it is; what is inside is pushed onto
    its border, where it encloses nothing.
    """

    rings: tuple[Outline, ...]
    centre: Points
    reach: Floats
    comes: bool
    holds: bool

    @cached_property
    def _curves(self) -> tuple[Curves, tuple[int, ...]]:
        parts = [_sectors(ring.curves, self.centre) for ring in self.rings]
        if self.holds:
            hole = Outline(unit_circle(STRAIGHTS)).reversed().curves
            parts.append(self.centre + POINT * self.reach.min() * hole)
        return np.concatenate(parts), tuple(len(part) for part in parts)

    @property
    def counts(self) -> tuple[int, ...]:
        """Number of curves in each ring."""
        return self._curves[1]

    @property
    def closed(self) -> tuple[bool, ...]:
        """All of them."""
        return (True,) * len(self.counts)

    def _border(self, offsets: Points) -> Floats:
        """How far the bite's border is from its middle in curves' (N, 4, 2) directions, (N, 4)."""
        middle = evaluate(offsets, np.array([0.5]))[:, 0]
        turn = np.arctan2(middle[:, 1], middle[:, 0]) / (2 * np.pi) * STRAIGHTS
        corners = np.stack([np.floor(turn), np.floor(turn) + 1])
        reach = np.interp(
            corners / STRAIGHTS * AROUND, np.arange(AROUND), self.reach, period=AROUND
        )
        first, second = reach[..., None] * _corners(corners)
        ahead = second - first
        away = np.hypot(offsets[..., 0], offsets[..., 1])
        unit = offsets / np.maximum(away, 1e-300)[..., None]
        return np.asarray(cross(first, ahead)[:, None] / cross(unit, ahead[:, None]))

    def curves(self, t: Floats) -> Curves:
        """Control points at the times (F,), (F, N, 4, 2)."""
        whole, _ = self._curves
        size = _grown(t, self.comes)[:, None, None]
        offsets = whole - self.centre
        away = np.hypot(offsets[..., 0], offsets[..., 1])
        reach = self._border(offsets)
        pushed = np.maximum(away, size * reach)
        result = self.centre + (pushed / np.maximum(away, 1e-300))[..., None] * offsets
        result = linked(np.where((away >= size * reach)[..., None], whole, result), self.counts)
        # What is all bitten off is a point: renderers show a line that encloses nothing as a hair.
        return np.where(size[..., None] == 1, whole[0, 0], result)


def _corners(directions: Floats) -> Points:
    """Unit vectors of directions counted in straights of a bite's border."""
    angle = directions * (2 * np.pi / STRAIGHTS)
    return np.stack([np.cos(angle), np.sin(angle)], axis=-1)


def _sectors(curves: Curves, centre: Points) -> Curves:
    """Curves cut where they pass a direction in which the border of a bite has a corner."""
    places = evaluate(curves, np.linspace(0.0, 1.0, LOOKED)) - centre
    turns = np.unwrap(np.arctan2(places[..., 1], places[..., 0]), axis=1) / (2 * np.pi) * STRAIGHTS
    parts = []
    for curve, turn in zip(curves, turns, strict=True):
        passed = np.arange(np.ceil(turn.min()), np.floor(turn.max()) + 1)
        cuts = [0.0, 1.0]
        for corner in _corners(passed):
            cuts += _passes(curve - centre, corner)
        at = np.unique(cuts)
        own = sub_curves(np.repeat(curve[None], len(at) - 1, axis=0), at[:-1], at[1:])
        own[0, 0], own[-1, 3] = curve[0], curve[3]
        parts.append(own)
    return np.concatenate(parts)


def _passes(offsets: Points, corner: Points) -> list[float]:
    """Parameters at which a curve about the origin (4, 2) lies in a direction."""
    aside = offsets @ np.array([-corner[1], corner[0]])
    steps = np.diff(aside)
    roots = np.roots([steps @ [1, -2, 1], 3 * (steps[1] - steps[0]), 3 * steps[0], aside[0]])
    real = roots[np.abs(roots.imag) < 1e-9].real
    real = real[(real > 1e-6) & (real < 1 - 1e-6)]
    return [float(t) for t in real if evaluate(offsets[None], np.array([t]))[0, 0] @ corner > 0]
