"""A piece of a closed line that becomes a closed line itself: a seam is drawn across first."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TypeAlias

import numpy as np

from shapetween.base.arrays import Curves, Floats, Points
from shapetween.base.notices import Notice
from shapetween.geometry.bezier import line_curves, sub_curves
from shapetween.model.outline import Outline
from shapetween.model.part import CurveTrack
from shapetween.scene.forms import form_of
from shapetween.scene.items import Item
from shapetween.scene.motion.choose import Ends
from shapetween.scene.motion.tracks import OfTrack
from shapetween.scene.places import Places

__all__ = ["Seamed", "seamed_tracks"]

#: Share of the time in which the seam is drawn. Longer, and two open lines part whose ends swing;
#: shorter, and it is there at once.
DRAWN = 0.4

Found: TypeAlias = tuple[tuple[CurveTrack, ...], tuple[Notice, ...]]


@dataclass(frozen=True, eq=False)
class Seamed(OfTrack):
    """A ring of which a part is drawn as time goes on, from both its ends to its middle.

    Its track is one closed ring.

    Attributes
    ----------
    middle : (int, float)
        Curve and parameter of the seam's middle.
    line : Places
        The ring cut open there, at the end at which the seam is wanting.
    ends : (float, float)
        Where on that, as shares of its length, begins and ends what is there all the time.
    last : bool
        Whether the seam is wanting at the end instead of at the start.
    """

    middle: tuple[int, float]
    line: Places
    ends: tuple[float, float]
    last: bool

    @property
    def counts(self) -> tuple[int, ...]:
        """One curve more than the ring has, as it is cut in one."""
        return (self.track.counts[0] + 1,)

    @property
    def closed(self) -> tuple[bool, ...]:
        """It is an open line."""
        return (False,)

    def curves(self, t: Floats) -> Curves:
        """Control points at the times (F,), (F, N, 4, 2)."""
        whole = _cut_at(self.track.curves(t), *self.middle)
        count = whole.shape[1]
        drawn = np.clip((1 - t if self.last else t) / DRAWN, 0.0, 1.0)
        low, high = self.ends
        begins = self.line.locate(low * (1 - drawn))
        stops = self.line.locate(1 - (1 - high) * (1 - drawn))
        first, last = begins[0] + begins[1], stops[0] + stops[1]
        index = np.arange(count)
        start = np.clip(first[:, None] - index, 0.0, 1.0)
        stop = np.clip(last[:, None] - index, 0.0, 1.0)
        flat = whole.reshape(-1, 4, 2)
        parts = sub_curves(flat, start.ravel(), np.maximum(start, stop).ravel())
        parts = parts.reshape(whole.shape)
        # What is not drawn yet lies on the ends of what is.
        frames = np.arange(len(t))
        begun = np.minimum(first.astype(np.intp), count - 1)
        ended = np.minimum(np.ceil(last).astype(np.intp) - 1, count - 1)
        tips = parts[frames, begun, 0], parts[frames, ended, 3]
        before, after = index < begun[:, None], index > ended[:, None]
        parts = np.where(before[..., None, None], tips[0][:, None, None], parts)
        parts = np.where(after[..., None, None], tips[1][:, None, None], parts)
        parts[:, 1:, 0] = parts[:, :-1, 3]
        return np.asarray(parts)


def _cut_at(curves: Curves, curve: int, at: float) -> Curves:
    """Rings (F, N, 4, 2) cut open in one of their curves, (F, N + 1, 4, 2)."""
    own = curves[:, curve]
    whole, cut = np.ones(len(own)), np.full(len(own), at)
    head, tail = sub_curves(own, cut, whole), sub_curves(own, np.zeros(len(own)), cut)
    rolled = np.roll(curves, -curve, axis=1)[:, 1:]
    return np.concatenate([head[:, None], rolled, tail[:, None]], axis=1)


def seamed_tracks(ends: Ends, tracks: Callable[[Ends], Found]) -> Found | None:
    """Tracks of a piece of a closed line and a closed line; None of any other pair.

    Parameters
    ----------
    ends : Ends
    tracks : callable
        Finds those of two closed lines.
    """
    last = ends.first.closed
    piece, ring = (ends.second, ends.first) if last else (ends.first, ends.second)
    if piece.filled or ring.filled or piece.closed or not ring.closed or not piece.cut:
        return None
    if piece.style.stroke is not None and piece.style.stroke.dashes:
        return None
    tips = piece.outer.curves[[-1, 0], [3, 0]]
    if not np.linalg.norm(tips[1] - tips[0]) > piece.width:
        return None
    cell = _cell(piece, tips)
    pair = (ring, cell) if last else (cell, ring)
    found, notices = tracks(
        replace(ends, first=pair[0], second=pair[1], forms=(form_of(pair[0]), form_of(pair[1])))
    )
    if len(found) != 1 or len(found[0].counts) != 1:
        return None
    there = found[0].curves(np.array([float(last)]))[0]
    places = Places(Outline(there))
    middle = places.locate(places.nearest(tips.mean(axis=0)[None]))
    cut = int(middle[0][0]), float(middle[1][0])
    line = Places(Outline(_cut_at(there[None], *cut)[0], False))
    first, second = np.sort(line.nearest(tips)).tolist()
    return (Seamed(found[0], cut, line, (first, second), last),), notices


def _cell(piece: Item, tips: Points) -> Item:
    """A line with its ends joined straight."""
    seam = line_curves(tips[:1], tips[1:])
    return piece.replaced((Outline(np.concatenate([piece.outer.curves, seam])),))
