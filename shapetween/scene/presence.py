"""How what has no partner comes and goes: drawn along its length, grown at a contact, or faded.

Everything is told as leaving; what comes does the same backwards.
"""

from dataclasses import dataclass, replace
from typing import Literal, TypeAlias

import numpy as np

from shapetween.base.arrays import Affine, Curves, Floats, Points
from shapetween.geometry.bezier import sub_curves
from shapetween.geometry.linearmaps import as_complex
from shapetween.model.gradients import has_gradient, moved_style
from shapetween.model.paint import Style
from shapetween.scene.motion.tracks import Frame, Track
from shapetween.scene.places import Places

__all__ = ["Carry", "Kept", "Leaving", "LonePart", "smooth_step"]

#: How soon a contour's own movement counts less the farther it is, as a share of the drawing.
NEAR = 0.02

#: Share of leaving from which on what shrinks or is retracted also fades: no dot is left.
LAST = 0.9

Kept: TypeAlias = Literal["start", "end", "middle", "both", "none"]
"""Which end of a line stays longest."""


def smooth_step(t: Floats) -> Floats:
    """From 0 to 1 without a jerk."""
    s = np.clip(t, 0.0, 1.0)
    return np.asarray(s * s * (3 - 2 * s))


@dataclass(frozen=True, slots=True, eq=False)
class Carry:
    """What goes along with the outline of a part that moves.

    Attributes
    ----------
    track : Track
        The part's.
    weights : (H,) float64
        What each of its curves' starts counts, together 1.
    end : float
        When the item is whole: 0 or 1.
    """

    track: Track
    weights: Floats
    end: float

    @classmethod
    def near(cls, track: Track, place: Points, scale: float, end: float) -> "Carry":
        """Carried as what of the part's outline is near a place (2,)."""
        starts = track.curves(np.array([end]))[0, :, 0]
        away = np.linalg.norm(starts - place, axis=1)
        weights = 1 / (away + NEAR * scale) ** 3
        return cls(track, weights / weights.sum(), end)

    def shift(self, t: Floats) -> Points:
        """How far it is from its own place at the times (F,), (F, 2)."""
        starts = self.track.curves(np.append(t, self.end))[:, :, 0]
        places = np.einsum("h,fhd->fd", self.weights, starts)
        return np.asarray(places[:-1] - places[-1])


@dataclass(frozen=True, slots=True, eq=False)
class Leaving:
    """How an item goes.

    Attributes
    ----------
    window : (float, float)
        From when until when.
    place : (2,) float64 or None
        Where it shrinks to.
    smallest : float
        Its size at last, beside its own.
    drawn : str
        Which end of a line stays longest: "start", "end", "middle", "both" for both ends, or
        "none" if it is not retracted.
    shortest : float
        Share of a retracted line that is left at last.
    fades : bool
        Whether it fades all the time; else only at last.
    last : float
        Share of leaving from which on it fades, if only at last.
    """

    window: tuple[float, float]
    place: Points | None = None
    smallest: float = 1.0
    drawn: Kept = "none"
    shortest: float = 0.0
    fades: bool = True
    last: float = LAST


@dataclass(frozen=True, eq=False)
class LonePart:
    """An item without a partner.

    Attributes
    ----------
    name : str
    whole : Style
    curves_at_home : tuple of (N, 4, 2) float64
        Its rings.
    closed : tuple of bool
    leaving : Leaving
    arrives : bool
        Whether it comes instead.
    carry : Carry or None
    frame : Frame or None
        What the whole drawing moves in.
    """

    name: str
    whole: Style
    curves_at_home: tuple[Curves, ...]
    closed: tuple[bool, ...]
    leaving: Leaving
    arrives: bool
    carry: Carry | None = None
    frame: Frame | None = None

    @property
    def rings(self) -> tuple[int, ...]:
        """Number of curves in each ring."""
        return tuple(len(curves) for curves in self.curves_at_home)

    def _gone(self, t: Floats) -> Floats:
        """How far it has left at the times (F,), from 0 to 1."""
        low, high = self.leaving.window
        time = 1 - t if self.arrives else t
        return smooth_step((time - low) / (high - low))

    def curves(self, t: Floats) -> Curves:
        """Control points at the times (F,), (F, N, 4, 2)."""
        gone = self._gone(t)
        leaving = self.leaving
        kept: list[Kept] = [leaving.drawn] * len(self.curves_at_home)
        if leaving.drawn == "both":
            kept = ["start", "end"]
        left = 1 - (1 - leaving.shortest) * gone
        rings = [
            np.repeat(curves[None], len(t), axis=0)
            if end == "none"
            else retracted(curves, left, end)
            for curves, end in zip(self.curves_at_home, kept, strict=True)
        ]
        result = np.concatenate(rings, axis=1)
        if leaving.place is not None:
            size = 1 - (1 - leaving.smallest) * gone
            result = leaving.place + size[:, None, None, None] * (result - leaving.place)
        if self.carry is not None:
            result = result + self.carry.shift(t)[:, None, None]
        if self.frame is not None:
            result = self.frame.carried(result, t)
        home = np.concatenate(self.curves_at_home)
        end = float(self.arrives)
        if self.frame is None or not self.arrives:
            result[t == end] = home
        return np.asarray(result)

    def style(self, t: float) -> Style:
        """Paint at one time: whole at its own end, and nothing from when it is gone."""
        gone = float(self._gone(np.array([t]))[0])
        if t == float(self.arrives):
            return self.whole
        if self.leaving.fades:
            seen = 1 - gone
        else:
            last = self.leaving.last
            seen = float(1 - smooth_step(np.array([(gone - last) / (1 - last)]))[0])
        style = self.whole
        if has_gradient(style):
            curves = self.curves(np.array([t, float(self.arrives)])).reshape(2, -1, 2)
            style = moved_style(style, _similarity(curves[1], curves[0]))
        return replace(style, opacity=style.opacity * seen)


def _similarity(home: Points, now: Points) -> Affine:
    """The similarity that best takes points (N, 2) to others, (2, 3)."""
    one, other = as_complex(home), as_complex(now)
    offsets = one - one.mean()
    spread = float((np.abs(offsets) ** 2).sum())
    ratio = complex((offsets.conj() @ (other - other.mean())) / spread) if spread > 0 else 0j
    shift = complex(other.mean() - ratio * one.mean())
    return np.array([[ratio.real, -ratio.imag, shift.real], [ratio.imag, ratio.real, shift.imag]])


def retracted(curves: Curves, left: Floats, kept: Kept) -> Curves:
    """Some share (F,) of a line (N, 4, 2) at one of its ends or its middle, (F, N, 4, 2)."""
    from shapetween.model.outline import Outline

    low, high = (1 - left) / 2, (1 + left) / 2
    if kept == "start":
        low, high = np.zeros_like(left), left
    elif kept == "end":
        low, high = 1 - left, np.ones_like(left)
    places = Places(Outline(curves, False))
    count = len(curves)
    first, begin = places.locate(low)
    last, end = places.locate(high)
    index = np.arange(count)
    start = np.where(
        index < first[:, None], 1.0, np.where(index > first[:, None], 0.0, begin[:, None])
    )
    stop = np.where(index < last[:, None], 1.0, np.where(index > last[:, None], 0.0, end[:, None]))
    whole_end = high >= 1.0
    stop[whole_end] = 1.0
    repeated = np.broadcast_to(curves, (len(left), *curves.shape)).reshape(-1, 4, 2)
    parts = sub_curves(repeated, start.ravel(), np.maximum(stop, start).ravel())
    parts = parts.reshape(len(left), count, 4, 2)
    # What is cut off lies on the ends of what is left.
    before = index < first[:, None]
    after = (index > last[:, None]) & ~whole_end[:, None]
    frames = np.arange(len(left))
    heads, tails = parts[frames, first, 0], parts[frames, np.minimum(last, count - 1), 3]
    parts = np.where(before[..., None, None], heads[:, None, None], parts)
    return np.where(after[..., None, None], tails[:, None, None], parts)
