"""Point location in an ambient mesh, and points bound to its triangles by barycentric weights."""

from dataclasses import dataclass, field

import numpy as np

from shapetween.base.arrays import Floats, Index, Mask, Points
from shapetween.base.ends import End
from shapetween.deform.mesh import AmbientMesh
from shapetween.geometry.polygon import cross

__all__ = ["BoundPoints", "MeshBinder", "PointLocator"]

#: How far outside its triangle, in barycentric weight, a point may lie and still be bound to it.
#: Smaller, and handles that stick out a little are let go; larger, and what lies beyond the mesh
#: is flung about.
BEYOND = 0.5

#: Triangles about each point that are searched before all are. More cost time; with fewer all are
#: searched more often.
NEIGHBOURS = 12

#: Points times triangles that are searched at once; more cost memory and are no quicker.
CELLS_AT_ONCE = 2_000_000


class PointLocator:
    """Finds the triangles of an ambient mesh that hold points.

    Parameters
    ----------
    mesh : AmbientMesh
    end : End
        Which end the points are places at.
    """

    def __init__(self, mesh: AmbientMesh, end: End) -> None:
        from scipy.spatial import KDTree  # slow to import

        corners = (mesh.source, mesh.target)[end][mesh.triangles]
        first, second = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
        valid = (np.abs(cross(first, second)) > 0) & ~mesh.inverted
        self._triangles = mesh.triangles[valid]
        self._origins = corners[valid, 0]
        inverses = np.linalg.inv(np.stack([first, second], axis=-1)[valid])
        self._inverses = np.ascontiguousarray(np.moveaxis(inverses, 0, -1))
        self._near = KDTree(corners[valid].mean(axis=1))

    def locate(self, points: Points) -> tuple[Index, Floats]:
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
class BoundPoints:
    """Points as they lie in the triangles of a mesh.

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
        """Which points lie too far outside the mesh to go with it, (K,)."""
        return np.asarray(self.weights.min(axis=1) < -BEYOND)

    def at(self, vertices: Points) -> Points:
        """Where they are when the mesh's vertices are at (F, V, 2), (F, K, 2)."""
        return np.asarray(np.einsum("pk,fpkd->fpd", self.weights, vertices[:, self.corners]))


@dataclass(frozen=True, slots=True, eq=False)
class MeshBinder:
    """Binds points at either end to a mesh; each end's locator is made once."""

    mesh: AmbientMesh
    _known: dict[End, PointLocator] = field(default_factory=dict)

    def bind(self, points: Points, end: End) -> BoundPoints:
        """Bind points (K, 2) where they lie in the mesh at an end."""
        if end not in self._known:
            self._known[end] = PointLocator(self.mesh, end)
        return BoundPoints(*self._known[end].locate(points))
