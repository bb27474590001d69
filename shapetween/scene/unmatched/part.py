"""The drawn path of an item without a partner."""

import numpy as np

from shapetween.base.arrays import Curves
from shapetween.base.ends import End
from shapetween.base.notices import Notice
from shapetween.model.outline import Outline
from shapetween.model.paint import Style
from shapetween.model.part import CurveTrack, Part
from shapetween.scene.cuts.lines import opaque
from shapetween.scene.items import Item
from shapetween.scene.motion.carried import Following
from shapetween.scene.motion.tracks import Frame, Framed
from shapetween.scene.places import Places, cut_alike, run_of
from shapetween.scene.strokes.outlined import stroke_notice, stroked_leaving
from shapetween.scene.unmatched.going import Going
from shapetween.scene.unmatched.presence import Carry, Leaving, LeavingPaint, LeavingTrack

__all__ = ["unmatched_part"]

#: Cosine of the turn of a line within its width where it is cut, from which on it has a corner
#: there. Smaller, and joins are lost that are seen; larger, and halves of bends stay together
#: longer than those of straight lines.
STRAIGHT = 0.9


def unmatched_part(
    item: Item, going: Going, end: End, frame: Frame | None
) -> tuple[Part, tuple[Notice, ...]]:
    """The part of an item without a partner, and what there is to tell.

    Parameters
    ----------
    item : Item
    going : Going
    end : End
        The end at which it exists.
    frame : Frame or None
        What the whole drawing moves in.
    """
    leaving, carries, painted, fold = going.leaving, going.carries, item.painted, going.fold

    def part(track: CurveTrack, style: Style, leaving: Leaving) -> Part:
        seen = track if frame is None else Framed(track, frame)
        return Part(item.name, (seen,), LeavingPaint(style, leaving, end, seen), end)

    if going.along is not None:
        return part(Following.of(item.outer, end, going.along), item.style, leaving), ()
    if painted is not None and leaving.kept is None and fold is None:  # nothing asks for its line
        return part(_rings(painted.rings, leaving, end, carries), painted.style, leaving), ()
    rings = [ring.curves for ring in item.rings]
    closed = tuple(ring.closed for ring in item.rings)
    if item.filled:
        rings[1:] = [curves[::-1, ::-1] for curves in rings[1:]]
    if leaving.kept is not None and item.closed:
        rings, closed = [run_of(Places(item.outer), going.cut, going.cut + 1).curves], (False,)
    elif isinstance(leaving.kept, tuple):
        rings, closed = _halves(item, going.cut), (False, False)
    if fold is not None:
        rings = [fold.pieces.source]
    lines = LeavingTrack(tuple(rings), closed, leaving, end, carries, fold)
    if painted is None:
        return part(lines, item.style, leaving), ()
    stroked = stroked_leaving(lines, painted)
    if stroked is not None:
        return part(stroked, painted.style, leaving), ()
    shrinking = Leaving(leaving.window, item.centre)
    alone = part(_rings(painted.rings, shrinking, end, carries[:1]), painted.style, shrinking)
    return alone, (stroke_notice(item.name, "it shrinks"),)


def _rings(
    rings: tuple[Outline, ...], leaving: Leaving, end: End, carries: tuple[Carry, ...]
) -> LeavingTrack:
    """Closed rings as they are."""
    whole = tuple(ring.curves for ring in rings)
    return LeavingTrack(whole, (True,) * len(whole), leaving, end, carries)


def _halves(item: Item, at: float) -> list[Curves]:
    """A line cut at a share of its length.

    At a corner both run over each other by its width, where that is not seen: it keeps its join.
    """
    stroke, places = item.style.stroke, Places(item.outer)
    back = at
    if stroke is not None and opaque(item) and stroke.width < item.length * at / 2:
        near = stroke.width / item.length
        before, middle, after = places.point(np.array([at - near / 2, at, at + near / 2]))
        leaving, arriving = middle - before, after - middle
        straight = float(leaving @ arriving) > STRAIGHT * float(np.hypot(*leaving) ** 2)
        back = at if straight else at - near
    cuts = np.array([0.0, at, 1.0] if back == at else [0.0, back, at, 1.0])
    pieces = cut_alike(places, places, cuts, cuts).source
    first, second = (
        int(np.linalg.norm(pieces[:, 0] - places.point(np.array([share]))[0], axis=1).argmin())
        for share in (at, back)
    )
    return [pieces[:first], pieces[second:]]
