"""Holes of a region whose outer ring is blended: each moves in the frame of that ring."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from shapetween.base.arrays import Affine, Curves, Floats, Points
from shapetween.geometry.affine import mapped
from shapetween.geometry.assignment import cheapest_pairs
from shapetween.model.part import CurveTrack
from shapetween.scene.forms import RoundedBox, form_of
from shapetween.scene.items import Item
from shapetween.scene.motion.bend_knots import ring_knots
from shapetween.scene.motion.boxes import box_blend
from shapetween.scene.motion.pinned import pinned_pieces
from shapetween.scene.motion.tracks import Blend, OfTrack
from shapetween.scene.places import Pieces, Places, cut_alike

__all__ = ["Opening", "hole_tracks", "matched_holes", "opened"]

#: Greatest distance of two holes that become each other, as a share of the outer ring's box. More,
#: and a hole crosses the region that another would have opened in.
APART = 0.4

#: What a factor e in size costs beside that distance. Without it, two holes that swap sizes go
#: to what is a little nearer; much more, and a hole that grows in place becomes another one.
SIZE = 0.15

#: Share of the time in which a hole opens. More, and it is a speck for long; less, and it is there
#: before what it belongs to.
OPENS = 0.85

#: Greatest such distance of two holes that are the only round ones: an eye, wherever it is.
EYES_APART = 0.8


def hole_tracks(
    first: Item, second: Item, outer: Blend, pins: Mapping[tuple[int, int], Points] | None = None
) -> tuple[CurveTrack, ...]:
    """Holes to the nearest ones, or closing where they are.

    Parameters
    ----------
    first, second : Item
        The region at both ends.
    outer : Blend
        Its outer ring's track.
    pins : mapping of (int, int) to (K, 4) float64, optional
        Of holes that become each other what else does, ax, ay, bx, by.
    """
    pinned = pins or {}
    if not first.holes and not second.holes:
        return ()
    forth = _affine(outer.pieces.source, outer.pieces.target)
    back = _affine(outer.pieces.target, outer.pieces.source)
    holes = [[Item((hole,), item.style) for hole in item.holes] for item in (first, second)]
    free = [
        [k for k in range(len(own)) if all(pair[s] != k for pair in pinned)]
        for s, own in enumerate(holes)
    ]
    rest = [[own[k] for k in some] for own, some in zip(holes, free, strict=True)]
    pairs = [(free[0][i], free[1][j]) for i, j in _nearest(rest[0], rest[1], forth, second)]
    pairs = sorted([*pairs, *pinned])
    tracks: list[CurveTrack] = [
        _in_frame(matched_holes(holes[0][i], holes[1][j], pinned.get((i, j))), outer)
        for i, j in pairs
    ]
    for side, (own, matrix) in enumerate(zip(holes, (forth, back), strict=True)):
        known = {pair[side] for pair in pairs}
        for k, hole in enumerate(own):
            if k not in known:
                there = mapped(hole.outer.curves, matrix)
                ends = (there, hole.outer.curves) if side else (hole.outer.curves, there)
                tracks.append(Opening(_in_frame(Pieces(*ends, True), outer), closes=not side))
    return tuple(tracks)


@dataclass(frozen=True, eq=False)
class Opening(OfTrack):
    """A hole that opens about its middle, soon at a decent size, or closes.

    Its track is the hole's as if that were open all the time.

    Attributes
    ----------
    closes : bool
    """

    closes: bool

    def curves(self, t: Floats) -> Curves:
        """Control points at the times (F,), (F, N, 4, 2)."""
        curves = self.track.curves(t)
        size = 1 - (1 - opened(t, self.closes)) ** 2
        middle = (curves.min(axis=(1, 2)) + curves.max(axis=(1, 2))) / 2
        middle = middle[:, None, None]
        grown = middle + size[:, None, None, None] * (curves - middle)
        return np.where((size == 1)[:, None, None, None], curves, grown)


def opened(t: Floats, closes: bool) -> Floats:
    """How far a hole has opened at the times (F,), from 0 to 1, or is still to close."""
    return np.clip((1 - t if closes else t) / OPENS, 0.0, 1.0)


def _affine(source: Points, target: Points) -> Affine:
    """The affine map that best takes curves (P, 4, 2) to others, (2, 3)."""
    one, other = source.reshape(-1, 2), target.reshape(-1, 2)
    middle = one.mean(axis=0)
    found = np.linalg.lstsq(one - middle, other - other.mean(axis=0), rcond=1e-9)[0].T
    return np.column_stack([found, other.mean(axis=0) - found @ middle])


def _nearest(
    first: list[Item], second: list[Item], forth: Affine, region: Item
) -> list[tuple[int, int]]:
    if not first or not second:
        return []
    size = np.maximum(region.box[1] - region.box[0], 1e-12)
    there = mapped(np.array([hole.centre for hole in first]), forth)
    away = (there[:, None] - np.array([hole.centre for hole in second])) / size
    apart = np.linalg.norm(away, axis=-1)
    eyes = _only_round(first), _only_round(second)
    growth = float(np.sqrt(abs(np.linalg.det(forth[:, :2]))))
    sizes = [np.array([hole.size for hole in side]) for side in (first, second)]
    change = np.abs(np.log(np.maximum(growth * sizes[0][:, None], 1e-12) / sizes[1]))
    cost = np.round(apart + SIZE * change, 9)
    reach = np.full(cost.shape, APART)
    if eyes[0] is not None and eyes[1] is not None:
        reach[eyes] = EYES_APART
        cost[eyes] -= EYES_APART
    rows, columns = cheapest_pairs(cost)
    pairs = zip(rows.tolist(), columns.tolist(), strict=True)
    return [(i, j) for i, j in pairs if apart[i, j] < reach[i, j]]


def _only_round(holes: list[Item]) -> int | None:
    """Which of some holes is the only round one."""
    forms = [form_of(hole) for hole in holes]
    found = [k for k, form in enumerate(forms) if isinstance(form, RoundedBox) and form.round]
    return found[0] if len(found) == 1 else None


def matched_holes(one: Item, other: Item, pins: Points | None = None) -> Pieces:
    """Two holes' outer rings, clockwise, by the boxes they are or place by place."""
    places = Places(one.outer.clockwise()), Places(other.outer.clockwise())
    forms = form_of(one), form_of(other)
    if isinstance(forms[0], RoundedBox) and isinstance(forms[1], RoundedBox):
        pieces = box_blend(forms[0], forms[1], *places).pieces
    else:
        pieces = cut_alike(*places, *ring_knots(*places))
    return pieces if pins is None else pinned_pieces(one, other, pins, pieces)


def _in_frame(pieces: Pieces, outer: Blend) -> Blend:
    """A hole in the frame of its outer ring, run the other way round than that."""
    back = Pieces(pieces.source[::-1, ::-1], pieces.target[::-1, ::-1], pieces.closed)
    return Blend(back, outer.centres, outer.turn)
