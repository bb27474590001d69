"""Planes that move, and points that ride on them from either end of the movement.

A drawing of many shapes moves as one because all of them ride on the same plane.
"""

from dataclasses import dataclass, field
from typing import Protocol

import numpy as np

from shapetween.base.arrays import Affine, Floats, Index, Mask, Points
from shapetween.deform.mesh import AmbientMesh
from shapetween.geometry.affine import inverted, mapped
from shapetween.geometry.polygon import cross
from shapetween.geometry.rotation import linear_between, polar
from shapetween.outline.body import VertexPath

__all__ = ["AffinePlane", "Finder", "Finders", "Held", "MeshPlane", "Plane", "Spots"]

#: How far outside its triangle, in barycentric weight, a point may lie and still ride on it. Its
#: handles may stick out a little; what lies beyond the mesh would be flung about.
BEYOND = 0.5

#: Triangles about each point that are looked at before all are.
NEIGHBOURS = 12

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


class Finder:
    """Finds the triangles of a plane mesh that hold points.

    Parameters
    ----------
    mesh : AmbientMesh
    arrives : bool
        Whether the points are places at the end; else at the start.
    """

    def __init__(self, mesh: AmbientMesh, arrives: bool) -> None:
        from scipy.spatial import KDTree  # slow to import

        corners = (mesh.target if arrives else mesh.source)[mesh.triangles]
        first, second = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
        sound = (np.abs(cross(first, second)) > 0) & ~mesh.inverted
        self._triangles = mesh.triangles[sound]
        self._origins = corners[sound, 0]
        inverses = np.linalg.inv(np.stack([first, second], axis=-1)[sound])
        self._inverses = np.ascontiguousarray(np.moveaxis(inverses, 0, -1))
        self._near = KDTree(corners[sound].mean(axis=1))

    def find(self, points: Points) -> tuple[Index, Floats]:
        """Corners (K, 3) of the triangles that hold points, and the points' weights in them.

        Where no triangle does, the one that comes nearest to it, its weights reaching below 0.
        """
        count = min(NEIGHBOURS, len(self._triangles))
        _, near = self._near.query(points, k=count)
        chosen, weights = self._best(points, near.reshape(len(points), count))
        missed = np.flatnonzero(weights.min(axis=1) < 0)
        every = np.arange(len(self._triangles))
        for some in np.array_split(missed, 1 + len(missed) * len(every) // CELLS_AT_ONCE):
            among = np.broadcast_to(every, (len(some), len(every)))
            chosen[some], weights[some] = self._best(points[some], among)
        return self._triangles[chosen], weights

    def _best(self, points: Points, among: Index) -> tuple[Index, Floats]:
        """Of some triangles each, (K, T), those whose least weight is greatest."""
        # Number by number: products of 2 x 2 matrices in a stack take five times as long.
        x, y = np.moveaxis(points[:, None] - self._origins[among], -1, 0)
        (a, b), (c, d) = self._inverses
        first, second = a[among] * x + b[among] * y, c[among] * x + d[among] * y
        best = np.minimum(np.minimum(first, second), 1 - first - second).argmax(axis=1)
        row = np.arange(len(points))
        u, v = first[row, best], second[row, best]
        return among[row, best], np.stack([1 - u - v, u, v], axis=1)


@dataclass(frozen=True, slots=True, eq=False)
class Spots:
    """Points as they lie in the triangles of a plane mesh.

    Attributes
    ----------
    corners : (K, 3) intp
        Vertices of each point's triangle.
    weights : (K, 3) float64
    """

    corners: Index
    weights: Floats

    @property
    def beyond(self) -> Mask:
        """Which points lie too far outside the mesh to ride on it, (K,)."""
        return np.asarray(self.weights.min(axis=1) < -BEYOND)

    def at(self, vertices: Points) -> Points:
        """Where they are when the mesh's vertices are at (F, V, 2), (F, K, 2)."""
        return np.asarray(np.einsum("pk,fpkd->fpd", self.weights, vertices[:, self.corners]))


class Finders:
    """A plane mesh at both ends, ready to find what holds points there."""

    def __init__(self, mesh: AmbientMesh) -> None:
        self._mesh = mesh
        self._known: dict[bool, Finder] = {}

    def spots(self, points: Points, arrives: bool) -> Spots:
        """Where points (K, 2) lie in the mesh at its end, or else at its start."""
        if arrives not in self._known:
            self._known[arrives] = Finder(self._mesh, arrives)
        return Spots(*self._known[arrives].find(points))


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
    mesh : AmbientMesh
    path : VertexPath
        Moves the mesh's vertices.
    """

    mesh: AmbientMesh
    path: VertexPath
    _known: tuple[bytes, Points] | None = None
    _finders: Finders = field(init=False)

    def __post_init__(self) -> None:
        """Make ready to find what holds points."""
        self._finders = Finders(self.mesh)

    def hold(self, points: Points, arrives: bool) -> "Held":
        """Take points (K, 2) aboard; those beyond the mesh go with it as a whole."""
        spots = self._finders.spots(points, arrives)
        loose = np.flatnonzero(spots.beyond)
        start, end = self.mesh.poses
        local = (end if arrives else start).normalise(points[loose])
        if arrives:
            local = local @ np.linalg.inv(self.mesh.body.matrix).T
        return _MeshHeld(self, spots, loose, local)

    def vertices(self, t: Floats) -> Points:
        """All vertices at the times (F,), (F, V, 2)."""
        key = t.tobytes()
        if self._known is None or self._known[0] != key:
            self._known = key, self.path.vertices(t)
        return self._known[1]


@dataclass(frozen=True, slots=True, eq=False)
class _MeshHeld:
    plane: MeshPlane
    spots: Spots
    loose: Index
    local: Points

    def at(self, t: Floats) -> Points:
        result = self.spots.at(self.plane.vertices(t))
        if len(self.loose):
            mesh = self.plane.mesh
            start, end = mesh.poses
            size = (1 - t) * start.size + t * end.size
            centre = (1 - t)[:, None] * start.centre + t[:, None] * end.centre
            whole = self.local @ np.swapaxes(mesh.body.at(t).matrices, 1, 2)
            result[:, self.loose] = size[:, None, None] * whole + centre[:, None]
        return result
