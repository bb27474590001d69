"""Curves carried by a moving plane: soft ones bend with it, small ones ride as a whole.

Handles ride on the plane as it turns and stretches about their joint, so that smooth joints stay
smooth; small shapes are turned and scaled only, so that an eye stays round.
"""

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from shapetween.attach.nearby import Parts
from shapetween.attach.planes import Held, Plane
from shapetween.base.arrays import Curves, Floats, Mask, Points
from shapetween.geometry.bezier import evaluate, sub_curves
from shapetween.geometry.polygon import cross

__all__ = ["Carriage", "Several", "bendable", "carriage", "is_compact"]

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


def carriage(
    curves: Curves, plane: Plane, arrives: bool, *, closed: bool, compact: bool
) -> Carriage:
    """Take a ring's or line's curves (P, 4, 2) aboard a plane, as a whole or joint by joint."""
    if compact:
        return _Whole.of(curves, plane, arrives)
    return _Soft.of(curves, plane, arrives, closed)


def is_compact(curves: Curves, extent: float) -> bool:
    """Whether curves are small beside a plane of an extent."""
    return float(np.linalg.norm(np.ptp(curves.reshape(-1, 2), axis=0))) <= COMPACT * extent


def bendable(parts: Parts, plane: Plane, extents: tuple[float, float]) -> Parts:
    """Parts of two outlines cut finely enough to bend as their plane does between their joints."""
    source, target = parts.source, parts.target
    for _ in range(CUTS):
        late = _off(source, plane, False, parts.closed, extents[0])
        late |= _off(target, plane, True, parts.closed, extents[1])
        late &= ~(_straight(source) & _straight(target))
        if not late.any():
            break
        source, target = _halved(source, late), _halved(target, late)
    return Parts(source, target, parts.closed)


def _straight(curves: Curves) -> Mask:
    chord = curves[:, 3] - curves[:, 0]
    off = np.abs(cross(curves[:, 1:3] - curves[:, :1], chord[:, None])).max(axis=1)
    return np.asarray(off <= STRAIGHT * (chord**2).sum(-1))


def _off(curves: Curves, plane: Plane, arrives: bool, closed: bool, extent: float) -> Mask:
    """Which curves miss where the plane carries their middles, (P,)."""
    half = np.full(1, 0.5)
    carried = evaluate(_Soft.of(curves, plane, arrives, closed).at(half)[0], half)[:, 0]
    middles = plane.hold(evaluate(curves, half)[:, 0], arrives).at(half)[0]
    return np.asarray(np.linalg.norm(carried - middles, axis=1) > OFF * extent)


def _halved(curves: Curves, which: Mask) -> Curves:
    """The curves with some of them as two halves each."""
    index = np.repeat(np.arange(len(curves)), 1 + which)
    second = np.append(False, index[1:] == index[:-1])
    first = np.append(second[1:], False)
    parts = sub_curves(curves[index], np.where(second, 0.5, 0.0), np.where(first, 0.5, 1.0))
    parts[1:, 0] = parts[:-1, 3]
    return parts


@dataclass(frozen=True, slots=True, eq=False)
class Several:
    """Curves carried ring by ring."""

    carriages: tuple[Carriage, ...]

    def at(self, t: Floats) -> Curves:
        """Their control points at the times (F,), ring after ring, (F, P, 4, 2)."""
        return np.concatenate([carriage.at(t) for carriage in self.carriages], axis=1)
