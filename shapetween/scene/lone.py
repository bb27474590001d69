"""The drawn path of an item without a partner."""

import numpy as np

from shapetween.base.arrays import Curves
from shapetween.model.outline import Outline
from shapetween.scene.going import Going
from shapetween.scene.items import Item
from shapetween.scene.motion.tracks import Frame
from shapetween.scene.places import Places, cut_alike
from shapetween.scene.presence import Leaving, LonePart
from shapetween.scene.strokes import StrokedLonePart, stroked_lone_part

__all__ = ["lone_part"]


def lone_part(
    item: Item, going: Going, arrives: bool, frame: Frame | None
) -> LonePart | StrokedLonePart:
    """The part of an item without a partner.

    Parameters
    ----------
    item : Item
    going : Going
    arrives : bool
        Whether it comes.
    frame : Frame or None
        What the whole drawing moves in.
    """
    leaving, carries = going.leaving, going.carries
    painted = item.painted
    fold = going.fold
    if painted is not None and leaving.kept is None and fold is None:  # nothing asks for its line
        rings = [ring.curves for ring in painted.rings]
        closed = (True,) * len(rings)
        return LonePart(
            item.name, painted.style, tuple(rings), closed, leaving, arrives, carries, frame
        )
    rings = [ring.curves for ring in item.rings]
    closed = tuple(ring.closed for ring in item.rings)
    if item.filled:
        rings[1:] = [curves[::-1, ::-1] for curves in rings[1:]]
    if isinstance(leaving.kept, tuple):
        rings, closed = _halves(item.outer, going.cut), (False, False)
    if fold is not None:
        rings = [fold.pieces.source]
    if painted is not None:
        line = LonePart(
            item.name, painted.style, tuple(rings), closed, leaving, arrives, carries, fold=fold
        )
        stroked = stroked_lone_part(line, item, frame)
        if stroked is not None:
            return stroked
        rings, closed = [ring.curves for ring in painted.rings], (True,) * len(painted.rings)
        leaving = Leaving(leaving.window, item.centre)
        return LonePart(
            item.name, painted.style, tuple(rings), closed, leaving, arrives, carries[:1], frame
        )
    return LonePart(
        item.name, item.style, tuple(rings), closed, leaving, arrives, carries, frame, fold
    )


def _halves(line: Outline, at: float) -> list[Curves]:
    """A line cut at a share of its length."""
    cut = np.array([0.0, at, 1.0])
    places = Places(line)
    pieces = cut_alike(places, places, cut, cut).source
    middle = places.point(np.array([at]))[0]
    k = int(np.linalg.norm(pieces[:, 0] - middle, axis=1).argmin())
    return [pieces[:k], pieces[k:]]
