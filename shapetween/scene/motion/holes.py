"""Holes of a region whose outer ring is blended: each moves in the frame of that ring."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from shapetween.base.arrays import Affine, Curves, Floats, Points
from shapetween.deform.check import LOOKED
from shapetween.geometry.affine import mapped
from shapetween.geometry.bezier import flatten
from shapetween.model.part import CurveTrack
from shapetween.scene.forms import RoundedBox, form_of
from shapetween.scene.items import Item
from shapetween.scene.motion.bend_knots import ring_knots
from shapetween.scene.motion.boxes import box_blend
from shapetween.scene.motion.hole_pairs import distances, divided_hole, paired_holes
from shapetween.scene.motion.mirrored import even_knots
from shapetween.scene.motion.pinned import pinned_pieces
from shapetween.scene.motion.tracks import Blend, OfTrack
from shapetween.scene.places import Pieces, Places, cut_alike

__all__ = ["Opening", "hole_tracks", "matched_holes", "opened"]

#: Greatest distance of two holes that become each other, as a share of the outer ring's box. More,
#: and a hole crosses the region that another would have opened in.
APART = 0.4

#: Share of the time in which a hole opens. More, and it is a dot for long; less, and it is there
#: before what it belongs to.
OPENS = 0.85

#: Shares of the time in which an unmatched hole closes or opens, the first that keeps it inside.
#: Longer than the first, and it is a dot among what has become something else; shorter than the
#: last, and it snaps.
WINDOWS = (0.5, 0.3, 0.18)

#: Share of an area that its hole covers from which on it is a frame round that. Larger, and thin
#: frames are filled before they open again; smaller, and a window is held to be one.
FRAME = 0.4

#: Share of an area by which a hole may lie outside of it. With none, rounding counts.
OUT = 1e-3

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
    if not first.holes and not second.holes:
        return ()
    pinned: Mapping[tuple[int, int], Points | None] = pins or _frame(first, second)
    forth = _affine(outer.pieces.source, outer.pieces.target)
    back = _affine(outer.pieces.target, outer.pieces.source)
    holes = [[Item((hole,), item.style) for hole in item.holes] for item in (first, second)]
    if not pinned:
        pinned = _divided(holes, (forth, back))
    free = [
        [k for k in range(len(own)) if all(pair[s] != k for pair in pinned)]
        for s, own in enumerate(holes)
    ]
    rest = [[own[k] for k in some] for own, some in zip(holes, free, strict=True)]
    pairs = [(free[0][i], free[1][j]) for i, j in _pairs(rest[0], rest[1], forth, second)]
    moved = {
        (i, j): _in_frame(matched_holes(holes[0][i], holes[1][j], pinned.get((i, j))), outer)
        for i, j in sorted([*pairs, *pinned])
    }
    inside = _Inside(outer)
    moved = {pair: t for pair, t in moved.items() if pair in pinned or inside.keeps(t)}
    unmatched = [
        [k for k in range(len(own)) if all(pair[s] != k for pair in moved)]
        for s, own in enumerate(holes)
    ]
    tracks: list[CurveTrack] = list(moved.values())
    alone = (forth, back) if outer.turn else _upright(outer)
    for side, (own, matrix) in enumerate(zip(holes, alone, strict=True)):
        for k in unmatched[side]:
            there = mapped(own[k].outer.curves, matrix)
            ends = (there, own[k].outer.curves) if side else (own[k].outer.curves, there)
            whole = _in_frame(Pieces(*ends, True), outer)
            tracks.append(_unmatched(whole, inside, closes=not side, waits=bool(unmatched[0])))
    return tuple(tracks)


def _divided(
    holes: list[list[Item]], maps: tuple[Affine, Affine]
) -> dict[tuple[int, int], Points | None]:
    """Cut a hole that becomes several by a bar, or that several become; and which become which."""
    for side in (0, 1):
        other = 1 - side
        there = [hole.transformed(maps[other]) for hole in holes[other]]
        found = divided_hole(holes[side], there)
        if found is None:
            continue
        k, parts, cells = found
        first = len(holes[side]) - 1
        holes[side] = [
            *holes[side][:k],
            *holes[side][k + 1 :],
            *(holes[side][k].replaced((cell.outer,)) for cell in cells),
        ]
        pairs = [(first + n, j) for n, j in enumerate(parts)]
        return {((j, i) if side else (i, j)): None for i, j in pairs}
    return {}


def _frame(first: Item, second: Item) -> Mapping[tuple[int, int], Points | None]:
    """The holes that make frames of both areas: they are those, whatever becomes of their form."""
    found = []
    for item in (first, second):
        shares = [Item((hole,), item.style).area / item.enclosed.area for hole in item.holes]
        large = [k for k, share in enumerate(shares) if share > FRAME]
        found.append(large)
    return {(found[0][0], found[1][0]): None} if all(len(side) == 1 for side in found) else {}


def _unmatched(whole: Blend, inside: "_Inside", *, closes: bool, waits: bool) -> "Opening":
    """A hole that closes early or opens late, so that it stays in what moves round it.

    One that opens where others close waits for them.
    """
    found = []
    for share in WINDOWS:
        window = (0.0, share) if closes else (1.0 - share, 1.0)
        if not (closes or waits) and share == WINDOWS[0]:
            window = (0.0, 1.0)
        found.append(Opening(whole, closes, window))
        if inside.keeps(found[-1]):
            return found[-1]
    return found[0]


class _Inside:
    """What an area covers on its way, but for its holes.

    Parameters
    ----------
    outer : Blend
        Its outer ring's track.
    """

    def __init__(self, outer: Blend) -> None:
        self.areas = _areas(outer)

    def keeps(self, hole: CurveTrack) -> bool:
        """Whether a hole never leaves the area."""
        import shapely

        holes = _areas(hole)
        out = shapely.area(shapely.difference(holes, self.areas))
        return bool((out <= OUT * shapely.area(self.areas)).all())


def _areas(track: CurveTrack) -> "NDArray[np.object_]":
    """What a track of one ring encloses at several times."""
    import shapely

    points = flatten(track.curves(LOOKED), 4)
    return np.array([shapely.make_valid(shapely.Polygon(ring)) for ring in points])


@dataclass(frozen=True, eq=False)
class Opening(OfTrack):
    """A hole that opens about its middle, soon at a decent size, or closes.

    Its track is the hole's as if that were open all the time.

    Attributes
    ----------
    closes : bool
    window : (float, float)
        From when until when, as shares of the time.
    """

    closes: bool
    window: tuple[float, float] = (0.0, 1.0)

    def curves(self, t: Floats) -> Curves:
        """Control points at the times (F,), (F, N, 4, 2)."""
        curves = self.track.curves(t)
        low, high = self.window
        size = 1 - (1 - opened((t - low) / (high - low), self.closes)) ** 2
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


def _upright(outer: Blend) -> tuple[Affine, Affine]:
    """The maps that take the box of a ring to that of the other one, and back.

    What lies in a ring that does not turn stays upright: bars in a bubble whose tail changes sides
    would slant by the map that fits its outline best.
    """
    boxes = [
        (points.min(axis=0), np.maximum(np.ptp(points, axis=0), 1e-300))
        for points in (outer.pieces.source.reshape(-1, 2), outer.pieces.target.reshape(-1, 2))
    ]
    maps = []
    for (low, size), (there, grown) in (boxes, boxes[::-1]):
        scale = grown / size
        maps.append(np.column_stack([np.diag(scale), there - scale * low]))
    return maps[0], maps[1]


def _pairs(
    first: list[Item], second: list[Item], forth: Affine, region: Item
) -> list[tuple[int, int]]:
    """Holes that become each other, as they lie in the second region."""
    if not first or not second:
        return []
    there = [hole.transformed(forth) for hole in first]
    apart = distances(there, second, np.maximum(region.box[1] - region.box[0], 1e-12))
    allowed = apart < APART
    eyes = _only_round(first), _only_round(second)
    if eyes[0] is not None and eyes[1] is not None and apart[eyes] < EYES_APART:
        allowed[eyes[0]] = allowed[:, eyes[1]] = False
        allowed[eyes] = True
    return paired_holes(there, second, apart, allowed)


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
        even = even_knots(*places)
        pieces = cut_alike(*places, *(ring_knots(*places) if even is None else even))
    return pieces if pins is None else pinned_pieces(one, other, pins, pieces)


def _in_frame(pieces: Pieces, outer: Blend) -> Blend:
    """A hole in the frame of its outer ring, run the other way round than that."""
    back = Pieces(pieces.source[::-1, ::-1], pieces.target[::-1, ::-1], pieces.closed)
    return Blend(back, outer.centres, outer.turn)
