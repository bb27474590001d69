"""Target Jacobians of a finer mesh, from the quads it lies in, at every time.

A quad says how the plane moves within it: by the homography onto the place that alignment gives
it. A triangle of the finer mesh is to move with its quad, and to make good, evenly in time,
the difference between where its quad takes it and where it ends. So it starts as it was, ends as
it must, and follows the projective movement on the way.
"""

from dataclasses import dataclass

import numpy as np

from shapetween.base.arrays import (
    Complex,
    Floats,
    Index,
    Mask,
    Points,
    Quads,
    row_lengths,
    row_sums,
)
from shapetween.deform.jacobians import AREA_EXPONENT, gradients, jacobians
from shapetween.geometry.homography import corner_weights
from shapetween.geometry.linearmaps import LinearMaps, as_complex, as_points
from shapetween.geometry.polygon import corner_sines
from shapetween.interpolate import Tween
from shapetween.mesh.pair import MeshPair

__all__ = ["QuadJacobianTarget", "usable_quads"]

#: Least corner sine, at both ends and on the way, and largest ratio of w, of a quad that is used.
#: Worse ones throw about what follows them.
LEAST_SINE, LARGEST_RATIO = 0.12, 6.0

#: Even times at which a quad's shape, and at which its perspective, is sampled.
SHAPE_TIMES, RATIO_TIMES = 33, 5

#: Most that a triangle may differ from its quad at the end: turn in radians, ratio of areas.
LARGEST_TURN, LARGEST_AREA = 1.0, 6.0

#: Share of the way from a quad's nearest point to its centroid at which a triangle outside it
#: reads the homography: on the very edge it may belong to no side.
INWARD = 0.02

#: Relative difference below which two distances are the same.
SAME = 1e-9


def usable_quads(pair: MeshPair, tween: Tween) -> Mask:
    """Which quads move well enough by their homographies to be followed, (Q,).

    Decided once for the whole movement: a quad given up half way would jolt.
    """
    moving = tween.vertices(np.linspace(0, 1, SHAPE_TIMES))[:, pair.quads]
    formed = (corner_sines(moving) > LEAST_SINE).all(axis=(0, 2))
    sampled = moving[:: (SHAPE_TIMES - 1) // (RATIO_TIMES - 1)]
    # Seen from both ends, or backwards in time other quads would be used.
    ends, sampled = np.broadcast_arrays(sampled[[0, -1], None], sampled)
    weights = corner_weights(ends, sampled)
    least, most = weights.min(axis=-1), weights.max(axis=-1)
    return np.asarray(formed & ((least > 0) & (most < LARGEST_RATIO * least)).all(axis=(0, 1)))


@dataclass(frozen=True, slots=True, eq=False)
class QuadJacobianTarget:
    """Jacobians wanted of triangles by the usable quads, at any time.

    Attributes
    ----------
    tween : Tween
        Moves the quads' vertices.
    follows : (T,) bool
        Which triangles follow a quad; the others' Jacobians are their own.
    """

    tween: Tween
    follows: Mask
    _forth: "_FromOneEnd"
    _back: "_FromOneEnd"
    _whole: LinearMaps

    @classmethod
    def of(
        cls, pair: MeshPair, tween: Tween, source: Points, target: Points
    ) -> "QuadJacobianTarget | None":
        """Find the quad that each triangle follows; None if no quad is usable.

        Parameters
        ----------
        pair : MeshPair
        tween : Tween
            The pair's movement.
        source, target : (T, 3, 2) float64
            Corners of the triangles, at both ends.
        """
        good = pair.quads[usable_quads(pair, tween)]
        if not len(good):
            return None
        whole = jacobians(gradients(as_complex(source))[0], as_complex(target))
        forth = _FromOneEnd.of(good, pair.source, pair.target, source.mean(axis=1), whole)
        back = _FromOneEnd.of(good, pair.target, pair.source, target.mean(axis=1), whole.inverse())
        return cls(tween, forth.valid & back.valid, forth, back, whole)

    def __call__(self, t: Floats, own: LinearMaps) -> LinearMaps:
        """Wanted Jacobians at the times (F,), (F, T).

        What the quads want seen from the start fades into what they want seen from the end, so that
        backwards in time the same is wanted.

        Parameters
        ----------
        t : (F,) float64
        own : (F, T) linear maps
            What the triangles would do by themselves; those that follow no quad keep to it.
        """
        vertices, time = as_complex(self.tween.vertices(t)), t[:, None]
        forth = self._forth.jacobians(vertices, t)
        back = self._back.jacobians(vertices, 1 - t).after(self._whole)
        wanted = LinearMaps(
            (1 - time) * forth.a + time * back.a, (1 - time) * forth.b + time * back.b
        )
        size = np.sqrt(np.abs(wanted.determinants))
        straight = (1 - time) + time * np.sqrt(self._whole.determinants)
        wanted = wanted.turned((straight / np.where(size > 0, size, 1.0)) ** AREA_EXPONENT)
        return LinearMaps(
            np.where(self.follows, wanted.a, own.a), np.where(self.follows, wanted.b, own.b)
        )


@dataclass(frozen=True, slots=True, eq=False)
class _FromOneEnd:
    """What quads want of triangles, seen from one end of the movement.

    Where a homography is read its Jacobian is, in barycentric coordinates b_k of three corners q_k
    and with their weights w_k, the sum of w_k (q_k - y) grad(b_k) over w, y the image and w the
    sum of w_k b_k.

    Attributes
    ----------
    quads : (Q, 4) intp
        Quads that are followed.
    start : (Q, 4, 2) float64
        Their corners at this end.
    followed : (T,) intp
        The quad that each triangle follows.
    shares : (T, 3) float64
        Where its homography is read, in barycentric coordinates of its first three corners.
    slopes : (T, 3) complex128
        Gradients of these coordinates.
    valid : (T,) bool
        Triangles that end near where their quad takes them.
    residual : (T,) linear maps
        What they have to make good.
    """

    quads: Index
    start: Quads
    followed: Index
    shares: Floats
    slopes: Complex
    valid: Mask
    residual: LinearMaps

    @classmethod
    def of(
        cls, quads: Index, here: Points, there: Points, centroids: Points, whole: LinearMaps
    ) -> "_FromOneEnd":
        start = here[quads]
        followed, places = _nearest_quads(centroids, start)
        corners = as_complex(start)[:, :3]
        slopes = gradients(corners)[0][followed]
        offset = as_complex(places)[:, None] - corners.mean(axis=1)[followed][:, None]
        shares = 1 / 3 + (slopes.conj() * offset).real
        moved = as_complex(there)[None]
        end = _read_jacobians(quads, start, followed, shares, slopes, moved)[0]
        residual = end.inverse().after(whole)
        areas = residual.determinants
        valid = (areas < LARGEST_AREA) & (areas > 1 / LARGEST_AREA)
        residual = LinearMaps(np.where(valid, residual.a, 1), np.where(valid, residual.b, 0))
        valid &= np.abs(residual.angles) < LARGEST_TURN
        return cls(quads, start, followed, shares, slopes, valid, residual)

    def jacobians(self, vertices: Complex, t: Floats) -> LinearMaps:
        """Jacobians from this end to the vertices (F, V), `t` from this end, (F, T)."""
        moved = _read_jacobians(
            self.quads, self.start, self.followed, self.shares, self.slopes, vertices
        )
        return moved.after(self.residual.between(self.residual.angles, t))


def _read_jacobians(
    quads: Index, start: Quads, followed: Index, shares: Floats, slopes: Complex, vertices: Complex
) -> LinearMaps:
    """Jacobians of the quads' homographies to vertices (F, V), where they are read, (F, T)."""
    moved = vertices[:, quads]
    ends = as_points(moved)
    weights = corner_weights(np.broadcast_to(start, ends.shape), ends)[:, followed, :3]
    corners = moved[:, followed, :3]
    weighted = weights * shares
    total = row_sums(weighted)[..., None]
    image = row_sums(weighted * corners)[..., None] / total
    return jacobians(slopes, weights * (corners - image) / total)


def _nearest_quads(points: Points, quads: Quads) -> tuple[Index, Points]:
    """For each point the quad that holds it, or the nearest one, and a place within that quad."""
    side = np.roll(quads, -1, axis=1) - quads  # (Q, 4, 2)
    offset = points[:, None, None] - quads  # (P, Q, 4, 2)
    across = side[..., 0] * offset[..., 1] - side[..., 1] * offset[..., 0]
    within = np.asarray((across >= 0).all(axis=-1))  # (P, Q)
    share = np.clip(row_sums(offset * side) / row_sums(side**2), 0.0, 1.0)
    foot = quads + share[..., None] * side
    away = row_lengths(points[:, None, None] - foot)
    distance = np.where(within, 0.0, away.min(axis=-1))
    # Quads that share a corner are as near to what lies beyond it: the first of them is taken.
    nearest = np.argmax(distance <= (1 + SAME) * distance.min(axis=1, keepdims=True), axis=1)
    row = np.arange(len(points))
    edge = foot[row, nearest, away[row, nearest].argmin(axis=-1)]
    place = np.where(within[row, nearest, None], points, edge)
    centre = quads.mean(axis=1)[nearest]
    return nearest, np.asarray(place + INWARD * (centre - place))
