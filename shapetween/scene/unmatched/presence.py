"""How what has no partner comes and goes: drawn along its length, or grown, and rarely faded.

Everything is told as leaving; what comes does the same backwards.
"""

from dataclasses import dataclass, replace
from functools import cached_property, lru_cache

import numpy as np

from shapetween.base.arrays import Affine, Complex, Curves, Floats, Points
from shapetween.base.ends import End
from shapetween.geometry.bezier import evaluate
from shapetween.geometry.linearmaps import as_complex, as_points
from shapetween.model.gradients import has_gradient, moved_style
from shapetween.model.outline import Outline
from shapetween.model.paint import Stroke, Style
from shapetween.model.part import CurveTrack, Leaf
from shapetween.scene.motion.fold import Fold
from shapetween.scene.places import Places
from shapetween.scene.unmatched.shortened import shortened

__all__ = ["BOTH", "Carry", "Leaving", "LeavingPaint", "LeavingTrack", "smooth_step"]

#: How soon a contour's own movement counts less the farther it is, as a share of the drawing.
NEAR = 0.02

#: Share of leaving from which on what is retracted also fades: no dot is left. Smaller, and ghosts
#: of lines are seen; at 1, round caps vanish at once.
LAST = 0.96

#: Powers of time by which parts shrink and lines are retracted. At 1 what comes is a dot too
#: long; much larger, and it snaps into place.
SHRINKS, RETRACTS = 2.4, 2.0

#: Share of its size from which on what shrinks keeps the weight of its strokes. At 1 they thin from
#: the start; at 0 what is small is a blot.
HEAVY = 0.5

#: Least and greatest growth of what carries a part along that the part takes up. Farther, and what
#: leaves a thing that itself collapses would be a dot, or as large as the drawing.
GROWTH = (0.3, 3.0)

#: Curves of a part past which what it carries follows it at even times, so many, by so many places
#: of its outline, found once for all that it carries. With fewer curves nothing is gained; fewer
#: times and places are seen to lag, and more cost seconds for each thing on a map.
MANY_CURVES, EVEN_TIMES, MOST_PLACES = 1000, 161, 4000

#: What stays longest of a line that is retracted to both its ends, which is cut in its middle.
BOTH = (0.0, 1.0)


def smooth_step(t: Floats) -> Floats:
    """From 0 to 1 without a jerk."""
    s = np.clip(t, 0.0, 1.0)
    return np.asarray(s * s * (3 - 2 * s))


@dataclass(frozen=True, eq=False)
class Carry:
    """What goes along with the outline of a part that moves.

    Attributes
    ----------
    track : CurveTrack
        The part's.
    place : (2,) float64
        What is carried, at home.
    reach : float
        Distance within which an outline's own movement counts fully, in the drawing's units.
    end : End
        The end at which the item exists.
    grows : bool
        Whether what is carried turns and grows as the part does, or is only moved.
    """

    track: CurveTrack
    place: Points
    reach: float
    end: End
    grows: bool = True

    def moved(self, t: Floats) -> tuple[Points, Complex]:
        """Where the place is at the times (F,), (F, 2), and turn and growth, (F,) complex128.

        Notes
        -----
        The place moves with the similarity that fits the whole outline best, the nearer parts
        better, and by what is left of the movement of what is next to it.
        """
        if sum(self.track.counts) <= MANY_CURVES:
            return self._along(_outline_at(self.track, np.append(t, float(self.end))))
        even = np.linspace(0.0, 1.0, EVEN_TIMES)
        places, ratios = self._evenly
        place = np.stack([np.interp(t, even, places[:, axis]) for axis in (0, 1)], axis=1)
        return place, np.interp(t, even, ratios)

    @cached_property
    def _evenly(self) -> tuple[Points, Complex]:
        """The same at even times."""
        return self._along(_outline_evenly(self.track, float(self.end)))  # type: ignore[arg-type]  # by identity

    def _along(self, points: Points) -> tuple[Points, Complex]:
        """The same along with places of the outline (F + 1, M, 2), the last ones at home."""
        home = points[-1]
        away = np.linalg.norm(home - self.place, axis=1) + self.reach
        near = away**-3
        near /= near.sum()
        if not self.grows:
            shift = np.einsum("h,fhd->fd", near, points[:-1] - home)
            return self.place + shift, np.ones(len(points) - 1, dtype=complex)
        wide = 1 / away
        wide /= wide.sum()
        own, there = as_complex(home), as_complex(points[:-1])
        middle, middles = wide @ own, there @ wide
        offsets = own - middle
        spread = float(wide @ np.abs(offsets) ** 2)
        ratio = np.ones(len(points) - 1, dtype=complex)
        if spread > 0:
            ratio = ((there - middles[:, None]) * (wide * offsets.conj())).sum(axis=1) / spread
            size = np.abs(ratio)
            ratio = ratio / np.where(size > 0, size, 1.0) * np.clip(size, *GROWTH)
        fitted = middles[:, None] + ratio[:, None] * (np.append(own, _one(self.place)) - middle)
        left = (there - fitted[:, :-1]) @ near
        return np.asarray(as_points(fitted[:, -1] + left)), ratio


def _outline_at(track: CurveTrack, t: Floats) -> Points:
    """Ends and middles of a track's curves at the times (F,), (F, 3 N, 2)."""
    return evaluate(track.curves(t), np.array([0.0, 0.5, 1.0])).reshape(len(t), -1, 2)


@lru_cache(maxsize=2)
def _outline_evenly(track: CurveTrack, end: float) -> Points:
    """Some of these at even times, and at last at an end, (EVEN_TIMES + 1, M, 2)."""
    points = _outline_at(track, np.append(np.linspace(0.0, 1.0, EVEN_TIMES), end))
    return np.ascontiguousarray(points[:, :: -(-points.shape[1] // MOST_PLACES)])


def _one(point: Points) -> complex:
    return complex(point[0], point[1])


@dataclass(frozen=True, slots=True, eq=False)
class Leaving:
    """How an item goes.

    Attributes
    ----------
    window : (float, float)
        From when until when, as shares of the movement.
    place : (2,) float64 or None
        Where it shrinks to, stroke and all, if it does.
    kept : float, (float, float) or None
        What stays longest of a line that is retracted, as a share of its length; `BOTH` of a line
        that is cut in two and goes into both its ends.
    fades : bool
        Whether it fades all the time; else only at last, where it is retracted.
    thins : float
        Power of its size by which its stroke thins, wherever it is; 0 where only blots do.
    least : float
        Share of its size or length at which it is first or last seen: not as a dot.
    steady : bool
        Whether it goes evenly; else ever faster, and what comes does ever slower.
    """

    window: tuple[float, float]
    place: Points | None = None
    kept: float | tuple[float, float] | None = None
    fades: bool = False
    thins: float = 0.0
    least: float = 0.0
    steady: bool = False

    def size(self, gone: Floats) -> Floats:
        """Of what shrinks or is retracted, as a share of its own, when it has gone so far."""
        return np.asarray(self.least + (1 - self.least) * (1 - gone))

    def gone(self, t: Floats, end: End) -> Floats:
        """How far it has gone at the times (F,), from 0 to 1."""
        low, high = self.window
        time = np.clip((t - low) / (high - low), 0.0, 1.0)
        if end is End.TARGET:
            time = 1 - time
        if self.fades:
            return smooth_step(time)
        if self.steady:
            return np.asarray(time)
        return np.asarray(time ** (SHRINKS if self.kept is None else RETRACTS))

    def time(self, gone: float, end: End) -> float:
        """When a line has been retracted by a share."""
        low, high = self.window
        time = gone if self.steady else gone ** (1 / RETRACTS)
        return low + (high - low) * (1 - time if end is End.TARGET else time)


@dataclass(frozen=True, eq=False)
class LeavingTrack(Leaf):
    """Rings and lines of an item without a partner.

    Attributes
    ----------
    whole : tuple of (N, 4, 2) float64
        As they are at their own end.
    closed : tuple of bool
    leaving : Leaving
    end : End
        The end at which they exist.
    carries : tuple of Carry
        What each ring goes along with, or all of them, or nothing; of one line two things, which
        its ends go along with.
    fold : Fold or None
        How it folds, if it does.
    """

    whole: tuple[Curves, ...]
    closed: tuple[bool, ...]
    leaving: Leaving
    end: End
    carries: tuple[Carry, ...] = ()
    fold: Fold | None = None

    @property
    def counts(self) -> tuple[int, ...]:
        """Number of curves in each ring."""
        return tuple(len(curves) for curves in self.whole)

    @cached_property
    def _places(self) -> tuple[Places, ...]:
        """Where places of each line are along it."""
        return tuple(Places(Outline(curves, False)) for curves in self.whole)

    def curves(self, t: Floats) -> Curves:
        """Control points at the times (F,), (F, N, 4, 2)."""
        gone = self.leaving.gone(t, self.end)
        kept = self.leaving.kept
        shares = kept if isinstance(kept, tuple) else (kept,) * len(self.whole)
        rings = [
            self.fold.curves(t, gone)
            if self.fold is not None
            else curves[None]
            if share is None
            else shortened(self._places[k], self.leaving.size(gone), share)
            for k, (curves, share) in enumerate(zip(self.whole, shares, strict=True))
        ]
        place = self.leaving.place
        if place is not None:
            rings = [_shrunk(ring, place, self.leaving.size(gone)) for ring in rings]
        else:
            rings = [np.array(np.broadcast_to(ring, (len(t), *ring.shape[1:]))) for ring in rings]
        if len(self.carries) == len(rings) > 1:
            pairs = zip(rings, self.carries, strict=True)
            rings = [_carried(ring, *carry.moved(t), carry) for ring, carry in pairs]
            result = np.concatenate(rings, axis=1)
        else:
            result = rings[0] if len(rings) == 1 else np.concatenate(rings, axis=1)
            if len(self.carries) > 1:
                result = _spanned(result, self.carries, t)
            elif self.carries:
                result = _carried(result, *self.carries[0].moved(t), self.carries[0])
        result[t == self.end] = np.concatenate(self.whole)
        return np.asarray(result)


@dataclass(frozen=True, slots=True, eq=False)
class LeavingPaint:
    """The paint of an item without a partner: whole at its own end, nothing from when it is gone.

    Attributes
    ----------
    whole : Style
        As it is at its own end.
    leaving : Leaving
    end : End
        The end at which it exists.
    track : CurveTrack
        What gradients follow.
    """

    whole: Style
    leaving: Leaving
    end: End
    track: CurveTrack

    def at(self, t: float) -> Style:
        """How it is painted at one time."""
        gone = float(self.leaving.gone(np.array([t]), self.end)[0])
        if t == self.end:
            return self.whole
        style = self.whole
        if self.leaving.fades:
            seen = 1 - gone
        elif self.leaving.kept is not None and not self.leaving.least:
            seen = float(1 - smooth_step(np.array([(gone - LAST) / (1 - LAST)]))[0])
        else:
            seen = float(gone < 1)
        smaller = self.leaving.place is not None or self.leaving.thins > 0
        if smaller and style.stroke is not None and gone < 1:
            size = float(self.leaving.size(np.array(gone)))
            thinner = size**self.leaving.thins if self.leaving.thins else min(1.0, size / HEAVY)
            style = replace(style, stroke=_scaled_stroke(style.stroke, thinner))
        if has_gradient(style):
            curves = self.track.curves(np.array([t, float(self.end)])).reshape(2, -1, 2)
            style = moved_style(style, _similarity(curves[1], curves[0]))
        return replace(style, opacity=style.opacity * seen) if seen != 1 else style


def _shrunk(curves: Curves, place: Points, size: Floats) -> Curves:
    """Curves (F, N, 4, 2), or the same at all times, (1, N, 4, 2), of sizes (F,) about a place."""
    shape = curves.shape[1:]
    # Row by row of all coordinates: arithmetic on pairs of them takes three times as long.
    local = (curves - place).reshape(len(curves), -1)
    shrunk = size[:, None] * local
    shrunk += np.tile(place, local.shape[1] // 2)
    return np.asarray(shrunk.reshape(len(size), *shape))


def _carried(curves: Curves, places: Points, ratio: Complex, carry: Carry) -> Curves:
    """Curves (F, N, 4, 2) about a place that has moved, turned and grown."""
    local = as_complex(curves - carry.place) * ratio[:, None, None]
    return np.asarray(as_points(local) + places[:, None, None])


def _spanned(curves: Curves, carries: tuple[Carry, ...], t: Floats) -> Curves:
    """Curves (F, N, 4, 2) between two places that have moved."""
    one, other = (_one(carry.place) for carry in carries)
    starts, ends = (as_complex(carry.moved(t)[0]) for carry in carries)
    ratio = (ends - starts) / (other - one)
    local = (as_complex(curves) - one) * ratio[:, None, None]
    return np.asarray(as_points(local + starts[:, None, None]))


def _scaled_stroke(stroke: Stroke, size: float) -> Stroke:
    """A stroke drawn smaller."""
    return replace(
        stroke,
        width=stroke.width * size,
        dashes=tuple(dash * size for dash in stroke.dashes),
        dash_offset=stroke.dash_offset * size,
    )


def _similarity(home: Points, now: Points) -> Affine:
    """The similarity that best takes points (N, 2) to others, (2, 3)."""
    one, other = as_complex(home), as_complex(now)
    offsets = one - one.mean()
    spread = float((np.abs(offsets) ** 2).sum())
    ratio = complex((offsets.conj() @ (other - other.mean())) / spread) if spread > 0 else 0j
    shift = complex(other.mean() - ratio * one.mean())
    return np.array([[ratio.real, -ratio.imag, shift.real], [ratio.imag, ratio.real, shift.imag]])
