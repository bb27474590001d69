"""Tracks of what appears beside what stands still: clipped by a moving line, or slid into it."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from shapetween.base.arrays import Curves, Floats, Mask, Points
from shapetween.base.ranking import comparable
from shapetween.geometry.bezier import sub_curves
from shapetween.model.outline import Outline
from shapetween.model.part import Leaf
from shapetween.scene.motion.holes import opened
from shapetween.scene.motion.tracks import OfTrack
from shapetween.scene.unmatched.presence import smooth_step

__all__ = [
    "Against",
    "HalfPlaneClip",
    "OfRings",
    "Slot",
    "Telescoped",
    "extent_along",
    "linked",
    "unit_circle",
]

#: Share of the time that a slot opens in, in which it opens round. Longer, and there is
#: a dot for long.
POINTED = 0.2

#: Bisections that a place on a curve is found by, to the last digit.
BISECTIONS = 54


@dataclass(frozen=True, eq=False)
class OfRings(Leaf):
    """Closed rings, curve by curve.

    Attributes
    ----------
    rings : tuple of Outline
        As they are where they are whole.
    """

    rings: tuple[Outline, ...]

    @property
    def counts(self) -> tuple[int, ...]:
        """Number of curves in each ring."""
        return tuple(len(ring.curves) for ring in self.rings)

    @property
    def closed(self) -> tuple[bool, ...]:
        """All of them."""
        return (True,) * len(self.rings)


@dataclass(frozen=True, eq=False)
class HalfPlaneClip(Leaf):
    """Rings of which only what lies on one side of a moving straight line is left.

    Attributes
    ----------
    rings : tuple of Outline
        Closed, as they are where nothing is clipped.
    ahead : (2,) float64
        Direction in which the line moves, of length 1, square to it.
    ends : (float, float)
        Where it is at times 0 and 1, along that direction.
    behind : bool
        Whether what is behind the line is left, else what is before it.

    Notes
    -----
    It is the clipping of polygons by a half plane [SH74]_ with every step kept: each curve that
    runs one way along the direction gives its part on the line's side and a straight way along the
    line, either of which may be a point.

    .. [SH74] I. E. Sutherland, G. W. Hodgman, *Reentrant polygon clipping*, Communications of the
       ACM 17(1), 1974.
    """

    rings: tuple[Outline, ...]
    ahead: Points
    ends: tuple[float, float]
    behind: bool

    @cached_property
    def _runs(self) -> tuple[Curves, tuple[int, ...]]:
        """All rings' curves, each running one way along the direction; how many of each ring."""
        parts = [_one_way(ring.curves, self.ahead) for ring in self.rings]
        return np.concatenate(parts), tuple(len(part) for part in parts)

    @property
    def counts(self) -> tuple[int, ...]:
        """Number of curves in each ring."""
        return tuple(2 * count for count in self._runs[1])

    @property
    def closed(self) -> tuple[bool, ...]:
        """All of them."""
        return (True,) * len(self.rings)

    def _reached(self, aside: Floats, crossing: Mask) -> tuple[Floats, Floats]:
        """From where to where along the line (F, N) each ring is cut, for each of its curves.

        A ring that is clipped away is cut nowhere, and at one place.
        """
        counts = self._runs[1]
        starts = np.cumsum([0, *counts])[:-1]
        low = np.minimum.reduceat(np.where(crossing, aside, np.inf), starts, axis=1)
        high = np.maximum.reduceat(np.where(crossing, aside, -np.inf), starts, axis=1)
        none = low > high
        low, high = np.where(none, aside[:, starts], low), np.where(none, aside[:, starts], high)
        return np.repeat(low, counts, axis=1), np.repeat(high, counts, axis=1)

    def curves(self, t: Floats) -> Curves:
        """Control points at the times (F,), (F, N, 4, 2)."""
        curves, _ = self._runs
        sign = -1.0 if self.behind else 1.0
        ahead = sign * self.ahead
        line = sign * ((1 - t) * self.ends[0] + t * self.ends[1])
        shape = (len(t), len(curves))
        place = np.broadcast_to(curves @ ahead, (*shape, 4))
        limit = np.broadcast_to(line[:, None], shape)
        rising = place[..., 3] >= place[..., 0]
        low, high = place[..., [0, 3]].min(axis=-1), place[..., [0, 3]].max(axis=-1)
        at = _crossing(place, np.clip(limit, low, high), rising)
        many = np.broadcast_to(curves, (*shape, 4, 2)).reshape(-1, 4, 2)
        ones = np.ones(at.size)
        head = sub_curves(many, 0 * ones, at.ravel()).reshape(*shape, 4, 2)
        tail = sub_curves(many, at.ravel(), ones).reshape(*shape, 4, 2)
        left, gone = low >= limit, high <= limit
        whole = np.broadcast_to(curves, (*shape, 4, 2))
        met = np.where(rising[..., None], tail[..., 0, :], head[..., 3, :])
        reached = self._reached(met @ _square(ahead), ~(left | gone))
        start, end = (
            _on_line(whole[..., k, :], np.maximum(limit - place[..., k], 0.0), ahead, reached)
            for k in (0, 3)
        )
        # What runs up to the line's side of the plane comes off it, what runs down ends on it.
        meet = np.where(gone[..., None], np.where(rising[..., None], end, start), met)
        meet = np.where(left[..., None], np.where(rising[..., None], start, end), meet)
        drawn = np.where(rising[..., None, None], tail, head)
        drawn = np.where(left[..., None, None], whole, drawn)
        drawn = np.where(gone[..., None, None], meet[..., None, :], drawn)
        along = np.where(rising[..., None, None], _straight(start, meet), _straight(meet, end))
        first = np.where(rising[..., None, None], along, drawn)
        second = np.where(rising[..., None, None], drawn, along)
        result = np.stack([first, second], axis=2).reshape(len(t), -1, 4, 2)
        # What is clipped away is a point: renderers show a line that encloses nothing as a hair.
        ends = curves[:, [0, 3]].reshape(-1, 2)
        last = ends[int(comparable(ends @ ahead).argmax())]
        result[line >= float((ends @ ahead).max())] = last
        return linked(result, self.counts)


def _square(ahead: Points) -> Points:
    return np.array([-ahead[1], ahead[0]])


def _on_line(
    points: Points, short: Floats, ahead: Points, reached: tuple[Floats, Floats]
) -> Points:
    """Points (F, N, 2) that fall short of a line on it, no farther out than it cuts anything.

    There and back along it they enclose nothing, but renderers show a hair.
    """
    square = _square(ahead)
    aside = points @ square
    within = np.where(short > 0, np.clip(aside, *reached) - aside, 0.0)
    return np.asarray(points + short[..., None] * ahead + within[..., None] * square)


def extent_along(rings: Sequence[Outline], ahead: Points) -> tuple[float, float]:
    """Where rings begin and end along a direction: a line there cuts nothing off their curves."""
    places = np.concatenate([_one_way(ring.curves, ahead)[:, [0, 3]] for ring in rings]) @ ahead
    return float(places.min()), float(places.max())


def unit_circle(count: int) -> Curves:
    """A circle about the origin as so many curves, clockwise as drawn."""
    angle = 2 * np.pi * np.arange(count + 1) / count
    points = np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    points[-1] = points[0]
    handles = 4 / 3 * np.tan(np.pi / 2 / count) * np.stack([-points[:, 1], points[:, 0]], axis=-1)
    curves = np.stack(
        [
            points[:-1],
            points[:-1] + handles[:-1],
            points[1:] - handles[1:],
            points[1:],
        ],
        axis=1,
    )
    return Outline(curves).clockwise().curves


def _straight(start: Points, end: Points) -> Curves:
    thirds = np.linspace(0.0, 1.0, 4)[:, None]
    return np.asarray((1 - thirds) * start[..., None, :] + thirds * end[..., None, :])


def linked(curves: Curves, counts: tuple[int, ...]) -> Curves:
    """Curves (F, N, 4, 2) each of which starts where the one before it ends, to the last digit."""
    first = 0
    for count in counts:
        own = curves[:, first : first + count]
        own[:, :, 0] = np.roll(own[:, :, 3], 1, axis=1)
        first += count
    return curves


def _one_way(curves: Curves, ahead: Points) -> Curves:
    """Curves cut where they turn back along a direction."""
    place = curves @ ahead
    steps = np.diff(place, axis=1)
    # The derivative's coefficients over t squared, t and 1.
    a, b, c = (
        steps[:, 0] - 2 * steps[:, 1] + steps[:, 2],
        2 * (steps[:, 1] - steps[:, 0]),
        steps[:, 0],
    )
    scale = np.abs(steps).max(axis=1)
    parts = []
    for k, curve in enumerate(curves):
        if np.abs(a[k]) > 1e-9 * scale[k]:
            roots = np.roots([a[k], b[k], c[k]])
        elif np.abs(b[k]) > 1e-9 * scale[k]:
            roots = np.array([-c[k] / b[k]])
        else:
            roots = np.zeros(0)
        real = roots[np.abs(np.imag(roots)) < 1e-9].real
        cuts = np.sort(real[(real > 1e-6) & (real < 1 - 1e-6)])
        cuts = np.concatenate([[0.0], cuts, [1.0]])
        own = sub_curves(np.repeat(curve[None], len(cuts) - 1, axis=0), cuts[:-1], cuts[1:])
        own[0, 0], own[-1, 3] = curve[0], curve[3]
        parts.append(own)
    return np.concatenate(parts)


def _crossing(place: Floats, limit: Floats, rising: Mask) -> Floats:
    """Where curves' places along a direction, which rise or fall all along, reach a limit."""
    low, high = np.zeros(limit.shape), np.ones(limit.shape)
    for _ in range(BISECTIONS):
        middle = (low + high) / 2
        rest = 1 - middle
        found = (
            rest**3 * place[..., 0]
            + 3 * rest**2 * middle * place[..., 1]
            + 3 * rest * middle**2 * place[..., 2]
            + middle**3 * place[..., 3]
        )
        before = (found < limit) == rising
        low, high = np.where(before, middle, low), np.where(before, high, middle)
    return (low + high) / 2


@dataclass(frozen=True, eq=False)
class Slot(Leaf):
    """A hole that opens round in its middle and is drawn out from there, or does so backwards.

    Attributes
    ----------
    begun, whole : (N, 4, 2) float64
        Where it is round, and all of it.
    closes : bool
    """

    begun: Curves
    whole: Curves
    closes: bool

    @property
    def counts(self) -> tuple[int, ...]:
        """It is one ring."""
        return (len(self.whole),)

    @property
    def closed(self) -> tuple[bool, ...]:
        """It is closed."""
        return (True,)

    def curves(self, t: Floats) -> Curves:
        """Control points at the times (F,), (F, N, 4, 2)."""
        share = opened(t, self.closes)[:, None, None, None]
        corners = self.begun.reshape(-1, 2)
        middle = (corners.min(axis=0) + corners.max(axis=0)) / 2
        round_one = middle + np.minimum(share / POINTED, 1.0) * (self.begun - middle)
        drawn = smooth_step((share - POINTED) / (1 - POINTED))
        longer = (1 - drawn) * self.begun + drawn * self.whole
        return np.asarray(np.where(share < POINTED, round_one, longer))


@dataclass(frozen=True, eq=False)
class Telescoped(OfRings):
    """Rings that slide into what they stand on: no point goes below their foot.

    Attributes
    ----------
    ahead : (2,) float64
        Direction out of what they stand on, of length 1.
    foot, height : float
        Where they stand along it, and how far they reach from there.
    comes : bool
        Whether they slide out.
    """

    ahead: Points
    foot: float
    height: float
    comes: bool

    def curves(self, t: Floats) -> Curves:
        """Control points at the times (F,), (F, N, 4, 2)."""
        whole = np.concatenate([ring.curves for ring in self.rings])
        sunk = ((1 - t) if self.comes else t)[:, None, None] * self.height
        room = np.maximum(whole @ self.ahead - self.foot, 0.0)
        return np.asarray(whole - np.minimum(sunk, room)[..., None] * self.ahead)


@dataclass(frozen=True, eq=False)
class Against(OfTrack):
    """A track whose rings run the other way round."""

    def curves(self, t: Floats) -> Curves:
        """Control points at the times (F,), (F, N, 4, 2)."""
        own = np.split(self.track.curves(t), np.cumsum(self.counts)[:-1], axis=1)
        return np.concatenate([ring[:, ::-1, ::-1] for ring in own], axis=1)
