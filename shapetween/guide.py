"""What the quads ask of a finer mesh inside them, at every time.

A quad says how the plane moves within it: by the homography onto the place that alignment gives
it. A triangle of the finer mesh is told to move with its quad, and to make good, evenly in time,
the difference between where its quad takes it and where it ends. So it starts as it was, ends as
it must, and follows the projective movement on the way.
"""

from dataclasses import dataclass

import numpy as np

from shapetween.arrays import Floats, Index, Mask, Points, Quads
from shapetween.geometry.homography import (
    homogeneous_weights,
    homography_jacobians,
    quad_homographies,
    triangle_affinities,
)
from shapetween.geometry.polygon import corner_sines
from shapetween.geometry.rotation import linear_between, polar
from shapetween.interpolate import Tween
from shapetween.mesh import MeshPair
from shapetween.plane.jacobians import AREA_EXPONENT

__all__ = ["QuadGuide", "usable_quads"]

#: Least corner sine, at both ends and on the way, and largest ratio of w, of a quad that guides.
#: Worse ones throw what they carry about.
LEAST_SINE, LARGEST_RATIO = 0.12, 6.0

#: Even times at which a quad's shape, and at which its perspective, is looked at.
SHAPE_TIMES, RATIO_TIMES = 33, 5

#: Most that a triangle may differ from its quad at the end: turn in radians, ratio of areas.
LARGEST_TURN, LARGEST_AREA = 1.0, 6.0

#: Share of the way from a quad's nearest point to its centroid at which a triangle outside it
#: reads the homography: on the very edge it may belong to no side.
INWARD = 0.02


def usable_quads(pair: MeshPair, tween: Tween) -> Mask:
    """Which quads move well enough by their homographies to lead others, (Q,).

    Decided once for the whole movement: a quad that stopped leading half way would jolt.
    """
    moving = tween.vertices(np.linspace(0, 1, SHAPE_TIMES))[:, pair.quads]
    good: Mask = np.asarray((corner_sines(moving) > LEAST_SINE).all(axis=(0, 2)))
    source = pair.source[pair.quads[good]]
    for corners in moving[:: (SHAPE_TIMES - 1) // (RATIO_TIMES - 1)][1:]:
        weights = homogeneous_weights(quad_homographies(source, corners[good]), source)
        ratio = weights.max(axis=1) / weights.min(axis=1)
        held = (weights.min(axis=1) > 0) & (ratio < LARGEST_RATIO)
        good[np.flatnonzero(good)[~held]] = False
        source = source[held]
    return good


@dataclass(frozen=True, slots=True, eq=False)
class QuadGuide:
    """Jacobians that the usable quads ask of triangles, at any time.

    Attributes
    ----------
    tween : Tween
        Moves the quads' vertices.
    follows : (T,) bool
        Which triangles are led; the others' Jacobians are their own.
    """

    tween: Tween
    follows: Mask
    _forth: "_Lead"
    _back: "_Lead"
    _whole: Floats

    @classmethod
    def of(cls, pair: MeshPair, tween: Tween, source: Points, target: Points) -> "QuadGuide | None":
        """Find the quad that leads each triangle; None if no quad is fit to lead.

        Parameters
        ----------
        pair : MeshPair
        tween : Tween
            The pair's movement.
        source, target : (T, 3, 2) float64
            Corners of the triangles to be led, at both ends.
        """
        good = pair.quads[usable_quads(pair, tween)]
        if not len(good):
            return None
        whole = triangle_affinities(source, target)
        forth = _Lead.of(good, pair.source, pair.target, source.mean(axis=1), whole)
        inverse = triangle_affinities(target, source)
        back = _Lead.of(good, pair.target, pair.source, target.mean(axis=1), inverse)
        return cls(tween, forth.sound & back.sound, forth, back, whole)

    def __call__(self, t: Floats, own: Floats) -> Floats:
        """Wanted Jacobians at the times (F,), (F, T, 2, 2).

        What the quads ask seen from the start fades into what they ask seen from the end, so that
        backwards in time the same is asked.

        Parameters
        ----------
        t : (F,) float64
        own : (F, T, 2, 2) float64
            What the triangles would do by themselves; those that are not led keep to it.
        """
        vertices = self.tween.vertices(t)
        time = t[:, None, None, None]
        wanted = (1 - time) * self._forth.jacobians(vertices, t)
        wanted += time * (self._back.jacobians(vertices, 1 - t) @ self._whole)
        size = np.sqrt(np.abs(np.linalg.det(wanted)))
        straight = (1 - t)[:, None] + t[:, None] * np.sqrt(np.linalg.det(self._whole))
        factor = (straight / np.where(size > 0, size, 1.0)) ** AREA_EXPONENT
        return np.where(self.follows[:, None, None], factor[..., None, None] * wanted, own)


@dataclass(frozen=True, slots=True, eq=False)
class _Lead:
    """What quads ask of triangles, seen from one end of the movement.

    Attributes
    ----------
    quads : (Q, 4) intp
        Quads that lead.
    start : (Q, 4, 2) float64
        Their corners at this end.
    leader : (T,) intp
        The quad that leads each triangle.
    places : (T, 2) float64
        Where its homography is read.
    sound : (T,) bool
        Triangles that end near where their quad takes them.
    angles, stretches : (T,), (T, 2, 2) float64
        What they have to make good, taken apart.
    """

    quads: Index
    start: Quads
    leader: Index
    places: Points
    sound: Mask
    angles: Floats
    stretches: Floats

    @classmethod
    def of(
        cls, quads: Index, here: Points, there: Points, centroids: Points, whole: Floats
    ) -> "_Lead":
        start = here[quads]
        leader, places = _nearest_quads(centroids, start)
        end = homography_jacobians(quad_homographies(start, there[quads])[leader], places[:, None])[
            :, 0
        ]
        residual = np.linalg.inv(end) @ whole
        areas = np.linalg.det(residual)
        sound = (areas < LARGEST_AREA) & (areas > 1 / LARGEST_AREA)
        angles, stretches = polar(np.where(sound[:, None, None], residual, np.eye(2)))
        sound &= np.abs(angles) < LARGEST_TURN
        return cls(quads, start, leader, places, sound, angles, stretches)

    def jacobians(self, vertices: Points, t: Floats) -> Floats:
        """Jacobians from this end to the vertices (F, V, 2), `t` from this end, (F, T, 2, 2)."""
        moved = vertices[:, self.quads]
        matrices = quad_homographies(np.broadcast_to(self.start, moved.shape), moved)
        led = homography_jacobians(matrices[:, self.leader], self.places[:, None])[:, :, 0]
        return np.asarray(led @ linear_between(self.angles, self.stretches, t))


def _nearest_quads(points: Points, quads: Quads) -> tuple[Index, Points]:
    """For each point the quad that holds it, or the nearest one, and a place within that quad."""
    side = np.roll(quads, -1, axis=1) - quads  # (Q, 4, 2)
    offset = points[:, None, None] - quads  # (P, Q, 4, 2)
    across = side[..., 0] * offset[..., 1] - side[..., 1] * offset[..., 0]
    within = np.asarray((across >= 0).all(axis=-1))  # (P, Q)
    share = np.clip((offset * side).sum(-1) / (side**2).sum(-1), 0.0, 1.0)
    foot = quads + share[..., None] * side
    away = np.linalg.norm(points[:, None, None] - foot, axis=-1)
    distance = np.where(within, 0.0, away.min(axis=-1))
    nearest = distance.argmin(axis=1)
    row = np.arange(len(points))
    edge = foot[row, nearest, away[row, nearest].argmin(axis=-1)]
    place = np.where(within[row, nearest, None], points, edge)
    centre = quads.mean(axis=1)[nearest]
    return nearest, np.asarray(place + INWARD * (centre - place))
