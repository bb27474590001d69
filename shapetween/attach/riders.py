"""Curves that ride on a moving plane while they become others, open, or close.

A rider is where the plane carries its start, blended into where the plane carries its end: both
are exact at their own end, and what does not fit the plane fades from one into the other.
"""

from dataclasses import dataclass

import numpy as np

from shapetween.attach.carriages import Carriage, Several, bendable, carriage, is_compact
from shapetween.attach.nearby import Parts, turn_between
from shapetween.attach.planes import Held, Plane
from shapetween.attach.unroll import Turns
from shapetween.base.arrays import Curves, Floats, Mask, Points
from shapetween.geometry.bezier import sub_curves
from shapetween.geometry.linearmaps import LinearMaps, as_complex
from shapetween.geometry.rotation import rotations

__all__ = ["Leaver", "Rider", "Tip", "riding"]

#: Spread of points across a line, as a share of that along it, below which they say nothing of what
#: happens across it; and greatest ratio of stretches that what lies on a rider follows.
FLAT, MAX_STRETCH = 1e-4, 3.0


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
    _turns: Turns | None = None

    @property
    def counts(self) -> tuple[int, ...]:
        """Number of curves in its one ring."""
        return (len(self.source),)

    @property
    def bounds(self) -> Floats:
        """Shares of its length at which its curves start and end, mean of both ends, (P + 1,)."""
        return (_bounds(self.source) + _bounds(self.target)) / 2

    def at_home(self, t: Floats) -> Mask:
        """At which times (F,) it is what was drawn."""
        return np.asarray((t == 0) | (t == 1))

    def whole(self, t: Floats) -> Curves:
        """The same as `curves`."""
        return self.curves(t)

    def shown(self, whole: Curves, t: Floats) -> Curves:
        """What is seen of it: the whole."""
        return whole

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
        if self._turns is not None:
            return self._turns.between(start, end, t), ends
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


def riding(
    parts: Parts, plane: Plane, extents: tuple[float, float], *, unrolls: bool = False
) -> Rider:
    """Let matched parts ride on a plane.

    Parameters
    ----------
    parts : Parts
    plane : Plane
    extents : (float, float)
        How large what the plane carries is at both ends.
    unrolls : bool
        Whether the parts of a line turn by themselves.
    """
    compact = is_compact(parts.source, extents[0]) and is_compact(parts.target, extents[1])
    if not compact:
        parts = bendable(parts, plane, extents)
    carriages = (
        carriage(parts.source, plane, False, closed=parts.closed, compact=compact),
        carriage(parts.target, plane, True, closed=parts.closed, compact=compact),
    )
    brought = carriages[0].at(np.ones(1))[0]
    angle = turn_between(brought.reshape(-1, 2), parts.target.reshape(-1, 2))
    turns = Turns.of(brought, parts.target) if unrolls else None
    return Rider(parts.source, parts.target, parts.closed, angle, carriages, turns)


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
        # What is small rides as a whole, with its holes.
        parts = (home,) if is_compact(home, extent) else rings
        rides = [
            carriage(
                part,
                plane,
                arrives,
                closed=bool((part[0, 0] == part[-1, 3]).all()),
                compact=is_compact(home, extent),
            )
            for part in parts
        ]
        held = plane.hold(centre[None], arrives)
        return cls(
            home,
            tuple(len(ring) for ring in rings),
            arrives,
            Several(tuple(rides)),
            held,
            host,
            shrinks,
        )

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
        compact = is_compact(curves, extent)
        ride = carriage(curves, plane, arrives, closed=False, compact=compact)
        return cls(curves, arrives, _bounds(curves), ride, host)

    @property
    def counts(self) -> tuple[int, ...]:
        """Number of curves in its one line."""
        return (len(self.home),)

    def curves(self, t: Floats) -> Curves:
        """Control points at the times (F,), (F, P, 4, 2)."""
        return self.shown(self.whole(t), t)

    @property
    def closed(self) -> bool:
        """Its ends are apart."""
        return False

    def at_home(self, t: Floats) -> Mask:
        """At which times (F,) it is what was drawn."""
        return np.asarray(t == float(self.arrives))

    def whole(self, t: Floats) -> Curves:
        """Control points of all of it, also where it has not grown yet."""
        moved = self._carriage.at(t)
        if self._host is not None:
            flat = moved.reshape(len(t), -1, 2)
            moved = self._host.leads(flat, t, self.arrives).reshape(moved.shape)
        moved[self.at_home(t)] = self.home
        return moved

    def shown(self, whole: Curves, t: Floats) -> Curves:
        """What is seen of it where it is as a whole at the times (F,), both (F, P, 4, 2)."""
        size = t if self.arrives else 1 - t
        span = np.diff(self.bounds)
        shown = (size[:, None] - self.bounds[:-1]) / np.where(span > 0, span, 1.0)
        shown = np.clip(np.where(span > 0, shown, size[:, None] >= self.bounds[1:]), 0.0, 1.0)
        cut = sub_curves(whole.reshape(-1, 4, 2), np.zeros(shown.size), shown.ravel())
        result = cut.reshape(whole.shape)
        # What is not shown yet lies on the tip.
        last = np.minimum((size[:, None] > self.bounds[1:]).sum(axis=1), len(span) - 1)
        tip = result[np.arange(len(t)), last, 3]
        hidden = np.arange(len(span)) > last[:, None]
        result = np.where(hidden[..., None, None], tip[:, None, None], result)
        result[size == 1] = whole[size == 1]
        return np.asarray(result)


def _bounds(curves: Curves) -> Floats:
    """Shares of a line's length, about, at which its curves start and end, (P + 1,)."""
    lengths = np.linalg.norm(np.diff(curves, axis=1), axis=2).sum(axis=1)
    bounds = np.concatenate([[0.0], np.cumsum(lengths)])
    return bounds / bounds[-1] if bounds[-1] > 0 else np.linspace(0, 1, len(bounds))
