"""Small contours, which get no meshes of their own: closed lines that become others in place."""

from dataclasses import dataclass

import numpy as np

from shapetween.base.arrays import Curves, Floats, Points
from shapetween.base.ranking import comparable
from shapetween.geometry.polygon import cross
from shapetween.geometry.rotation import rotations
from shapetween.model.arclength import arc_length
from shapetween.model.outline import Outline
from shapetween.outline.matched import MatchedOutlines

__all__ = ["BlendedCurve", "blend_small"]

#: Samples two contours are compared at. Fewer, and a contour starts off where it should not; more
#: cost time with the square.
SAMPLES = 64

#: Share of the distance between two contours with one centre that a turn must save to be made.
#: Lower, and round ones turn for nothing; higher, and long ones shrink on their way.
TURN_SAVES = 0.3


@dataclass(frozen=True, slots=True, eq=False)
class BlendedCurve:
    """A closed run of curves blended between its two ends, turning evenly.

    Attributes
    ----------
    source, target : (P, 4, 2) float64
        Matched parts of the two contours' own curves.
    angle : float
        Angle by which it turns, radians.
    """

    source: Curves
    target: Curves
    angle: float

    @property
    def counts(self) -> tuple[int, ...]:
        """Number of curves in its one ring."""
        return (len(self.source),)

    def curves(self, t: Floats) -> Curves:
        """Control points at the times (F,), (F, P, 4, 2); the contours' own at 0 and 1."""
        time = t[:, None, None, None]
        start = _about(self.source, t * self.angle)
        end = _about(self.target, (t - 1) * self.angle)
        result = np.asarray((1 - time) * start + time * end)
        result[:, :, 0] = np.roll(result[:, :, 3], 1, axis=1)  # equal but for rounding
        result[t == 0], result[t == 1] = self.source, self.target
        return result


def blend_small(source: Outline, target: Outline) -> BlendedCurve:
    """Prepare the movement of a contour too small for a mesh of its own.

    Parameters
    ----------
    source, target : Outline
        Closed, in one frame. They are matched by even lengths, from the starts at which they lie
        nearest to each other.
    """
    for way in (target, target.reversed()):
        if source.curves.shape == way.curves.shape:
            one, other = comparable(np.stack([source.curves, way.curves]))
            if (one == other).all():
                return BlendedCurve(source.curves, way.curves, 0.0)
    way = target if (source.area > 0) == (target.area > 0) else target.reversed()
    places = arc_length(source), arc_length(way)
    even = np.arange(SAMPLES) / SAMPLES
    first, second = (place.point(even) for place in places)
    first, second = first - first.mean(axis=0), second - second.mean(axis=0)
    away = ((first[:, None] - second) ** 2).sum(-1)
    rolled = (np.arange(SAMPLES)[:, None] + np.arange(SAMPLES)) % SAMPLES
    sums = away[np.arange(SAMPLES), rolled].sum(axis=1)
    start = int(comparable(sums).argmin())  # of equals the first
    u = np.array([0.0, 0.5, 1.0])
    pieces = MatchedOutlines(*places, u, u + start / SAMPLES).cut(np.zeros(0))
    points = (curves.reshape(-1, 2) for curves in (pieces.source, pieces.target))
    return BlendedCurve(pieces.source, pieces.target, _turn_between(*points))


def _turn_between(first: Points, second: Points) -> float:
    """Angle about their means that lays points (N, 2) on others far better than none does, or 0."""
    a, b = first - first.mean(axis=0), second - second.mean(axis=0)
    angle = float(np.arctan2(cross(a, b).sum(), (a * b).sum()))
    straight = ((a - b) ** 2).sum()
    saves = straight - ((a @ rotations(np.asarray(angle)).T - b) ** 2).sum()
    return angle if saves > TURN_SAVES * straight else 0.0


def _about(curves: Curves, angles: Floats) -> Curves:
    """Curves (P, 4, 2) turned about their mean by angles (F,), (F, P, 4, 2)."""
    centre = curves.mean(axis=(0, 1))
    return np.asarray((curves - centre) @ np.swapaxes(rotations(angles), 1, 2)[:, None] + centre)
