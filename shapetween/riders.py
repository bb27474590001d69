"""Curves that ride on a moving plane while they become others, open, or close.

A rider is where the plane carries its start, blended into where the plane carries its end: both
are exact at their own end, and what does not fit the plane fades from one into the other. Handles
ride on the plane as it turns and stretches about their joint, so that smooth joints stay smooth;
small shapes ride as a whole, so that an eye stays round.
"""

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from shapetween.arrays import Curves, Floats, Mask, Points
from shapetween.geometry.bezier import evaluate, sub_curves
from shapetween.geometry.linearmaps import as_complex
from shapetween.geometry.polygon import cross
from shapetween.geometry.rotation import rotations
from shapetween.nearby import Parts
from shapetween.riding import Held, Plane

__all__ = ["Leaver", "Rider", "Tip", "riding"]

#: Extent of a rider, as a share of its plane's, up to which it rides as a whole. Larger, and
#: patches do not bend with what they lie on; smaller, and eyes are squeezed.
COMPACT = 0.16

#: Directions a plane's turn and stretch about a joint are taken from, and how far out, as a share
#: of the curves' lengths at that joint.
STAR, REACH = 6, 0.3

#: Share of its length that a curve's handles may lie off its chord and the curve count as a line.
STRAIGHT = 1e-3

#: Distance, as a share of the plane's extent, by which a curve may miss where the plane carries
#: its middle, before it is cut in two; and how often.
OFF, CUTS = 0.008, 3

#: Spread of points across a line, as a share of that along it, below which they say nothing of what
#: happens across it; and greatest ratio of stretches that what lies on a rider follows.
FLAT, MAX_STRETCH = 1e-4, 3.0

#: Share of the distance between two riders, laid on each other, that a turn must save to be made.
TURN_SAVES = 0.3

_ANGLES = np.arange(STAR) * (2 * np.pi / STAR)
_STAR = np.stack([np.cos(_ANGLES), np.sin(_ANGLES)], axis=1)


class Carriage(Protocol):
    """Curves that a plane carries."""

    def at(self, t: Floats) -> Curves:
        """Their control points at the times (F,), (F, P, 4, 2)."""


@dataclass(frozen=True, slots=True, eq=False)
class _Whole:
    """Curves carried as one, turned and scaled as the plane is about their middle."""

    held: Held
    offsets: Curves
    reach: float

    @classmethod
    def of(cls, curves: Curves, plane: Plane, arrives: bool) -> "_Whole":
        points = curves.reshape(-1, 2)
        low, high = points.min(axis=0), points.max(axis=0)
        centre, reach = (low + high) / 2, float(np.linalg.norm(high - low)) / 2
        held = plane.hold(np.concatenate([centre[None], centre + reach * _STAR]), arrives)
        return cls(held, curves - centre, reach)

    def at(self, t: Floats) -> Curves:
        moved = self.held.at(t)
        linear = _linear(moved[:, None, 1:], np.full(1, self.reach))[:, 0]
        a = (linear[:, 0, 0] + linear[:, 1, 1]) / 2
        b = (linear[:, 1, 0] - linear[:, 0, 1]) / 2
        similar = LinearMaps(ratio, np.zeros_like(ratio)).matrices

    moments = np.swapaxes(source, 1, 2) @ source
    low, high = np.moveaxis(np.linalg.eigvalsh(moments), -1, 0)
    known = low > FLAT * high
    moments[~known] = np.eye(2)
    general = np.swapaxes(target, 1, 2) @ source @ np.linalg.inv(moments)
    stretch = np.linalg.svd(general, compute_uv=False)
    sound = known & (np.linalg.det(general) > 0) & (stretch[:, 0] <= MAX_STRETCH * stretch[:, 1])
    return np.where(sound[:, None, None], general, similar)


def riding(parts: Parts, plane: Plane, extents: tuple[float, float]) -> Rider:
    """Let matched parts ride on a plane.

    Parameters
    ----------
    parts : Parts
    plane : Plane
    extents : (float, float)
        How large what the plane carries is at both ends.
    """
    source, target = parts.source, parts.target
    compact = is_compact(source, extents[0]) and is_compact(target, extents[1])
    for _ in range(CUTS if not compact else 0):
        late = _off(source, plane, False, parts.closed, extents[0])
        late |= _off(target, plane, True, parts.closed, extents[1])
        late &= ~(_straight(source) & _straight(target))
        if not late.any():
            break
        source, target = _halved(source, late), _halved(target, late)
    carriages = (
        _carriage(source, plane, False, parts.closed, compact),
        _carriage(target, plane, True, parts.closed, compact),
    )
    angle = _angle(carriages[0].at(np.ones(1))[0], target)
    return Rider(source, target, parts.closed, angle, carriages)


def _off(curves: Curves, plane: Plane, arrives: bool, closed: bool, extent: float) -> Mask:
    """Which curves miss where the plane carries their middles, (P,)."""
    half = np.full(1, 0.5)
    carried = evaluate(_Soft.of(curves, plane, arrives, closed).at(half)[0], half)[:, 0]
    middles = plane.hold(evaluate(curves, half)[:, 0], arrives).at(half)[0]
    return np.asarray(np.linalg.norm(carried - middles, axis=1) > OFF * extent)


def _straight(curves: Curves) -> Mask:
    chord = curves[:, 3] - curves[:, 0]
    off = np.abs(cross(curves[:, 1:3] - curves[:, :1], chord[:, None])).max(axis=1)
    return np.asarray(off <= STRAIGHT * (chord**2).sum(-1))


def _halved(curves: Curves, which: Mask) -> Curves:
    """The curves with some of them as two halves each."""
    index = np.repeat(np.arange(len(curves)), 1 + which)
    second = np.append(False, index[1:] == index[:-1])
    first = np.append(second[1:], False)
    parts = sub_curves(curves[index], np.where(second, 0.5, 0.0), np.where(first, 0.5, 1.0))
    parts[1:, 0] = parts[:-1, 3]
    return parts


def _about(curves: Curves, angles: Floats) -> Curves:
    """Curves (F, P, 4, 2) turned about their means by angles (F,)."""
    centre = curves.mean(axis=(1, 2), keepdims=True)
    return np.asarray((curves - centre) @ np.swapaxes(rotations(angles), 1, 2)[:, None] + centre)


def _angle(source: Curves, target: Curves) -> float:
    """Angle that lays one on the other far better than none does, else 0."""
    a = source.reshape(-1, 2) - source.reshape(-1, 2).mean(axis=0)
    b = target.reshape(-1, 2) - target.reshape(-1, 2).mean(axis=0)
    angle = float(np.arctan2(cross(a, b).sum(), (a * b).sum()))
    straight = ((a - b) ** 2).sum()
    saves = straight - ((a @ rotations(np.asarray(angle)).T - b) ** 2).sum()
    return angle if saves > TURN_SAVES * straight else 0.0


@dataclass(frozen=True, slots=True, eq=False)
class Leaver:
    """Rings that ride on a plane, whole at one end of the movement and a point at the other.

    Attributes
    ----------
    home : (P, 4, 2) float64
        All their curves where they are whole.
    counts : tuple of int
        Number of curves in each ring.
    arrives : bool
        Whether they are whole at the end; else at the start.
    """

    home: Curves
    counts: tuple[int, ...]
    arrives: bool
    _carriage: Carriage
    _centre: Held
    _host: Rider | None

    @classmethod
    def of(
        cls,
        rings: tuple[Curves, ...],
        centre: Points,
        arrives: bool,
        plane: Plane,
        extent: float,
        host: Rider | None = None,
    ) -> "Leaver":
        """Take rings aboard that open from, or close to, a centre (2,), perhaps on a host."""
        home = np.concatenate(rings)
        compact = is_compact(home, extent)
        carriage: Carriage
        if compact or len(rings) == 0:
            carriage = _Whole.of(home, plane, arrives)
        else:
            closed = [bool((ring[0, 0] == ring[-1, 3]).all()) for ring in rings]
            carriage = _Several(
                tuple(_Soft.of(r, plane, arrives, c) for r, c in zip(rings, closed, strict=True))
            )
        held = plane.hold(centre[None], arrives)
        return cls(home, tuple(len(ring) for ring in rings), arrives, carriage, held, host)

    def curves(self, t: Floats) -> Curves:
        """Control points at the times (F,), (F, P, 4, 2)."""
        size = t if self.arrives else 1 - t
        moved = np.concatenate(
            [self._carriage.at(t).reshape(len(t), -1, 2), self._centre.at(t)], axis=1
        )
        if self._host is not None:
            moved = self._host.leads(moved, t, self.arrives)
        centre = moved[:, -1:]
        shrunk = centre + size[:, None, None] * (moved[:, :-1] - centre)
        result = shrunk.reshape(len(t), *self.home.shape)
        result[size == 1] = self.home
        return np.asarray(result)


@dataclass(frozen=True, slots=True, eq=False)
class _Several:
    carriages: tuple[Carriage, ...]

    def at(self, t: Floats) -> Curves:
        return np.concatenate([carriage.at(t) for carriage in self.carriages], axis=1)


@dataclass(frozen=True, slots=True, eq=False)
class Tip:
    """An open line that grows from one of its ends, or shrinks back to it, riding on a plane.

    Attributes
    ----------
    home : (P, 4, 2) float64
        Where it is whole, from the end that it grows from on.
    arrives : bool
        Whether it is whole at the end; else at the start.
    bounds : (P + 1,) float64
        Shares of its length at which its curves start and end.
    """

    home: Curves
    arrives: bool
    bounds: Floats
    _carriage: Carriage
    _host: Rider | None

    @classmethod
    def of(
        cls,
        curves: Curves,
        arrives: bool,
        plane: Plane,
        extent: float,
        host: Rider | None = None,
    ) -> "Tip":
        """Take a line aboard that grows from its first point, perhaps on a host."""
        lengths = np.linalg.norm(np.diff(curves, axis=1), axis=2).sum(axis=1)
        bounds = np.concatenate([[0.0], np.cumsum(lengths)])
        bounds = bounds / bounds[-1] if bounds[-1] > 0 else np.linspace(0, 1, len(bounds))
        carriage = _carriage(curves, plane, arrives, False, is_compact(curves, extent))
        return cls(curves, arrives, bounds, carriage, host)

    @property
    def counts(self) -> tuple[int, ...]:
        """Number of curves in its one line."""
        return (len(self.home),)

    def curves(self, t: Floats) -> Curves:
        """Control points at the times (F,), (F, P, 4, 2)."""
        size = t if self.arrives else 1 - t
        moved = self._carriage.at(t)
        if self._host is not None:
            flat = moved.reshape(len(t), -1, 2)
            moved = self._host.leads(flat, t, self.arrives).reshape(moved.shape)
        span = np.diff(self.bounds)
        shown = (size[:, None] - self.bounds[:-1]) / np.where(span > 0, span, 1.0)
        shown = np.clip(np.where(span > 0, shown, size[:, None] >= self.bounds[1:]), 0.0, 1.0)
        cut = sub_curves(moved.reshape(-1, 4, 2), np.zeros(shown.size), shown.ravel())
        result = cut.reshape(moved.shape)
        # What is not shown yet lies on the tip.
        last = np.minimum((size[:, None] > self.bounds[1:]).sum(axis=1), len(span) - 1)
        tip = result[np.arange(len(t)), last, 3]
        hidden = np.arange(len(span)) > last[:, None]
        result = np.where(hidden[..., None, None], tip[:, None, None], result)
        result[size == 1] = self.home
        return np.asarray(result)
