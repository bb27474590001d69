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
from shapetween.geometry.linearmaps import LinearMaps, as_complex
from shapetween.geometry.polygon import cross
from shapetween.geometry.rotation import rotations
from shapetween.riding.nearby import Parts, turn_between
from shapetween.riding.planes import Held, Plane

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
        similar = np.stack([np.stack([a, -b], axis=-1), np.stack([b, a], axis=-1)], axis=-2)
        turned = self.offsets @ np.swapaxes(similar, 1, 2)[:, None]
        return np.asarray(moved[:, None, :1] + turned)


@dataclass(frozen=True, slots=True, eq=False)
class _Soft:
    """Curves carried joint by joint."""

    held: Held
    handles: Points
    reach: Floats
    closed: bool
    straight: Mask
    shares: Floats

    @classmethod
    def of(cls, curves: Curves, plane: Plane, arrives: bool, closed: bool) -> "_Soft":
        joints = curves[:, 0] if closed else np.concatenate([curves[:, 0], curves[-1:, 3]])
        lengths = np.linalg.norm(np.diff(curves, axis=1), axis=2).sum(axis=1)
        before = np.roll(lengths, 1) if closed else np.concatenate([lengths[:1], lengths])
        after = lengths if closed else np.concatenate([lengths, lengths[-1:]])
        reach = REACH * np.maximum((before + after) / 2, 1e-3 * float(lengths.max()))
        star = joints[:, None] + reach[:, None, None] * _STAR
        held = plane.hold(np.concatenate([joints, star.reshape(-1, 2)]), arrives)
        handles = np.stack([curves[:, 1] - curves[:, 0], curves[:, 2] - curves[:, 3]], axis=1)
        chord = curves[:, 3] - curves[:, 0]
        size = (chord**2).sum(-1)
        shares = ((curves[:, 1:3] - curves[:, :1]) * chord[:, None]).sum(-1)
        shares = shares / np.where(size > 0, size, 1.0)[:, None]
        return cls(held, handles, reach, closed, _straight(curves), shares)

    def at(self, t: Floats) -> Curves:
        moved = self.held.at(t)
        count = len(self.reach)
        joints, star = moved[:, :count], moved[:, count:].reshape(len(t), count, STAR, 2)
        linear = _linear(star, self.reach)
        pieces = len(self.handles)
        first, last = np.arange(pieces), (np.arange(pieces) + 1) % count
        start, end = joints[:, first], joints[:, last]
        one = start + (linear[:, first] @ self.handles[:, 0, :, None])[..., 0]
        two = end + (linear[:, last] @ self.handles[:, 1, :, None])[..., 0]
        on = start[:, :, None] + self.shares[..., None] * (end - start)[:, :, None]
        one = np.where(self.straight[:, None], on[:, :, 0], one)
        two = np.where(self.straight[:, None], on[:, :, 1], two)
        return np.stack([start, one, two, end], axis=2)


def _linear(star: Points, reach: Floats) -> Floats:
    """Linear map about each joint that best takes the star there, (F, J, 2, 2)."""
    scale = 2 / STAR / np.where(reach > 0, reach, 1.0)
    return np.asarray(np.einsum("fjkd,ke->fjde", star, _STAR) * scale[:, None, None])


def _carriage(curves: Curves, plane: Plane, arrives: bool, closed: bool, compact: bool) -> Carriage:
    if compact:
        return _Whole.of(curves, plane, arrives)
    return _Soft.of(curves, plane, arrives, closed)


def is_compact(curves: Curves, extent: float) -> bool:
    """Whether curves are small beside a plane of an extent."""
    return float(np.linalg.norm(np.ptp(curves.reshape(-1, 2), axis=0))) <= COMPACT * extent


@dataclass(frozen=True, slots=True, eq=False)
class Rider:
    """A line or ring that rides on a plane and becomes another on the way.

    Attributes
    ----------
    source, target : (P, 4, 2) float64
        Matched parts of the two outlines' own curves.
    closed : bool
    angle : float
        Angle by which it turns more than its plane, radians.
    """

    source: Curves
    target: Curves
    closed: bool
    angle: float
    _carriages: tuple[Carriage, Carriage]

    @property
    def counts(self) -> tuple[int, ...]:
        """Number of curves in its one ring."""
        return (len(self.source),)

    def curves(self, t: Floats) -> Curves:
        """Control points at the times (F,), (F, P, 4, 2); the outlines' own at 0 and 1."""
        result = self._blended(t)[0]
        result[:, 1:, 0] = result[:, :-1, 3]  # equal but for rounding
        if self.closed:
            result[:, 0, 0] = result[:, -1, 3]
        result[t == 0], result[t == 1] = self.source, self.target
        return result

    def leads(self, points: Points, t: Floats, arrives: bool) -> Points:
        """Points (F, K, 2) that the plane alone has brought there, where the rider takes them.

        What lies on a rider goes with it also where it leaves the plane's way: by the affine map
        that takes what the plane makes of the rider's own end to the rider as it is.
        """
        result, ends = self._blended(t)
        given = ends[arrives].reshape(len(t), -1, 2)
        middles = given.mean(axis=1, keepdims=True), result.mean(axis=(1, 2))[:, None]
        linear = _affine(given - middles[0], result.reshape(len(t), -1, 2) - middles[1])
        return np.asarray((points - middles[0]) @ np.swapaxes(linear, 1, 2) + middles[1])

    def _blended(self, t: Floats) -> tuple[Curves, tuple[Curves, Curves]]:
        """The curves at the times (F,), and both ends as the plane alone carries them."""
        time = t[:, None, None, None]
        start, end = ends = self._carriages[0].at(t), self._carriages[1].at(t)
        if self.angle:
            start = _about(start, t * self.angle)
            end = _about(end, (t - 1) * self.angle)
        return np.asarray((1 - time) * start + time * end), ends


def _affine(source: Points, target: Points) -> Floats:
    """Linear maps that best take points (F, N, 2) about 0 to others, (F, 2, 2).

    Where such a map would turn the plane over, or stretch one way far more than the other, the
    similarity that does.
    """
    p, q = as_complex(source), as_complex(target)
    spread = (np.abs(p) ** 2).sum(axis=1)
    ratio = (np.conj(p) * q).sum(axis=1) / np.where(spread > 0, spread, 1.0)
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
    brought = carriages[0].at(np.ones(1))[0]
    angle = turn_between(brought.reshape(-1, 2), target.reshape(-1, 2))
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


@dataclass(frozen=True, slots=True, eq=False)
class Leaver:
    """Rings that ride on a plane, whole at one end of the movement and a point at the other.

    Or whole all the way, if it is their stroke alone that fades.

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
    _shrinks: bool

    @classmethod
    def of(
        cls,
        rings: tuple[Curves, ...],
        centre: Points,
        arrives: bool,
        plane: Plane,
        extent: float,
        host: Rider | None = None,
        *,
        shrinks: bool = True,
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
        return cls(home, tuple(len(ring) for ring in rings), arrives, carriage, held, host, shrinks)

    def curves(self, t: Floats) -> Curves:
        """Control points at the times (F,), (F, P, 4, 2)."""
        size = t if self.arrives else 1 - t
        moved = np.concatenate(
            [self._carriage.at(t).reshape(len(t), -1, 2), self._centre.at(t)], axis=1
        )
        if self._host is not None:
            moved = self._host.leads(moved, t, self.arrives)
        centre = moved[:, -1:]
        scale = size[:, None, None] if self._shrinks else 1.0
        shrunk = centre + scale * (moved[:, :-1] - centre)
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
