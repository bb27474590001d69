"""Planes that move, and points that ride on them from either end of the movement.

A drawing of many shapes moves as one because all of them ride on the same plane.
"""

from dataclasses import dataclass, field
from typing import Protocol

import numpy as np

from shapetween.arrays import Affine, Floats, Index, Mask, Points
from shapetween.body import VertexPath
from shapetween.fit import inverted, mapped
from shapetween.geometry.rotation import linear_between, polar
from shapetween.plane.mesh import PlaneMesh

__all__ = ["BEYOND", "AffinePlane", "Held", "MeshPlane", "Plane", "held_by"]

#: How far outside its triangle, in barycentric weight, a point may lie and still ride on it. Its
#: handles may stick out a little; what lies beyond the mesh would be flung about.
BEYOND = 0.5

#: Points times triangles that are looked at at once; more cost memory and are no quicker.
CELLS_AT_ONCE = 2_000_000


class Held(Protocol):
    """Points that a plane carries."""

    def at(self, t: Floats) -> Points:
        """Where they are at the times (F,), (F, K, 2)."""


class Plane(Protocol):
    """A plane that moves from the source's place to the target's."""

    def hold(self, points: Points, arrives: bool) -> Held:
        """Take points (K, 2) aboard, as they are at the end if they arrive, else at the start."""


def held_by(mesh: PlaneMesh, points: Points, arrives: bool) -> tuple[Index, Floats, Mask]:
    """Triangles that hold points, and the points' weights in them.

    Parameters
    ----------
    mesh : PlaneMesh
    points : (K, 2) float64
    arrives : bool
        Whether they are places at the end; else at the start.

    Returns
    -------
    corners : (K, 3) intp
    weights : (K, 3) float64
    beyond : (K,) bool
        Which lie so far outside the mesh that no triangle holds them.
    """
    vertices = mesh.target if arrives else mesh.source
    corners = vertices[mesh.triangles]
    first, second = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    area = first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]
    sound = (np.abs(area) > 0) & ~mesh.turned
    inverse = np.zeros((len(area), 2, 2))
    inverse[sound] = np.linalg.inv(np.stack([first, second], axis=-1)[sound])
    # What lies in a triangle lies in its box: few of them are near points that lie together.
    near = sound & (corners.min(axis=1) <= points.max(axis=0)).all(axis=1)
    near &= (corners.max(axis=1) >= points.min(axis=0)).all(axis=1)
    index = np.zeros(len(points), dtype=np.intp)
    weights = np.full((len(points), 3), -np.inf)
    for faces in (np.flatnonzero(near), np.flatnonzero(sound)):
        left = np.flatnonzero(weights.min(axis=1) < 0)
        if not len(left) or not len(faces):
            continue
        for some in np.array_split(left, 1 + len(left) * len(faces) // CELLS_AT_ONCE):
            offsets = points[some, None] - corners[faces, 0]
            local = np.einsum("tij,ptj->pti", inverse[faces], offsets)
            shares = np.concatenate([1 - local.sum(-1, keepdims=True), local], axis=-1)
            # The triangle whose least weight is greatest holds the point, or is nearest to it.
            chosen = shares.min(axis=-1).argmax(axis=1)
            index[some], weights[some] = faces[chosen], shares[np.arange(len(some)), chosen]
    return mesh.triangles[index], weights, np.asarray(weights.min(axis=1) < -BEYOND)


@dataclass(frozen=True, slots=True, eq=False)
class AffinePlane:
    """A plane that turns, stretches and shifts evenly.

    Attributes
    ----------
    matrix : (2, 3) float64
        Where it ends; its determinant is positive.
    centre : (2,) float64
        The point that goes straight.
    """

    matrix: Affine
    centre: Points

    def hold(self, points: Points, arrives: bool) -> "Held":
        """Take points (K, 2) aboard."""
        return _AffineHeld(self, mapped(points, inverted(self.matrix)) if arrives else points)

    def carried(self, points: Points, t: Floats) -> Points:
        """Points of the start (K, 2) at the times (F,), (F, K, 2)."""
        angle, stretch = polar(self.matrix[:, :2])
        linear = linear_between(np.reshape(angle, (1,)), stretch[None], t)[:, 0]
        goal = mapped(self.centre, self.matrix)
        centre = (1 - t)[:, None] * self.centre + t[:, None] * goal
        return np.asarray((points - self.centre) @ np.swapaxes(linear, 1, 2) + centre[:, None])


@dataclass(frozen=True, slots=True, eq=False)
class _AffineHeld:
    plane: AffinePlane
    points: Points

    def at(self, t: Floats) -> Points:
        return self.plane.carried(self.points, t)


@dataclass(slots=True, eq=False)
class MeshPlane:
    """A plane of triangles. Solving it costs most, so the last answer is kept for all that ride.

    Attributes
    ----------
    mesh : PlaneMesh
    path : VertexPath
        Moves the mesh's vertices.
    """

    mesh: PlaneMesh
    path: VertexPath
    _known: tuple[bytes, Points] | None = field(default=None)

    def hold(self, points: Points, arrives: bool) -> "Held":
        """Take points (K, 2) aboard; those beyond the mesh go with it as a whole."""
        corners, weights, beyond = held_by(self.mesh, points, arrives)
        loose = np.flatnonzero(beyond)
        start, end = self.mesh.poses
        local = (end if arrives else start).normalise(points[loose])
        if arrives:
            local = local @ np.linalg.inv(self.mesh.body.matrix).T
        return _MeshHeld(self, corners, weights, loose, local)

    def vertices(self, t: Floats) -> Points:
        """All vertices at the times (F,), (F, V, 2)."""
        key = t.tobytes()
        if self._known is None or self._known[0] != key:
            self._known = key, self.path.vertices(t)
        return self._known[1]


@dataclass(frozen=True, slots=True, eq=False)
class _MeshHeld:
    plane: MeshPlane
    corners: Index
    weights: Floats
    loose: Index
    local: Points

    def at(self, t: Floats) -> Points:
        vertices = self.plane.vertices(t)
        result = np.einsum("pk,fpkd->fpd", self.weights, vertices[:, self.corners])
        if len(self.loose):
            mesh = self.plane.mesh
            start, end = mesh.poses
            size = (1 - t) * start.size + t * end.size
            centre = (1 - t)[:, None] * start.centre + t[:, None] * end.centre
            whole = self.local @ np.swapaxes(mesh.body.at(t).matrices, 1, 2)
            result[:, self.loose] = size[:, None, None] * whole + centre[:, None]
        return np.asarray(result)
