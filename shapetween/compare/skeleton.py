"""What moves inside a body: the faces of its mesh, or the triangles of the plane it lies in."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from shapetween.base.arrays import Floats, Index, Points
from shapetween.deform.deformation import VertexPath
from shapetween.geometry.homography import triangle_affinities
from shapetween.geometry.polygon import polygon_area
from shapetween.interpolate import INTERIORS, tween
from shapetween.interpolate.inside import Inside
from shapetween.outline.body import Carried, joined_meshes

__all__ = ["Skeleton"]

#: Places along the side of a quad at which its Jacobian is read. More cost time; fewer miss what
#: a homography does near its corners.
PLACES = 4


@dataclass(frozen=True, eq=False)
class Skeleton:
    """Faces in motion.

    Attributes
    ----------
    path : VertexPath
        Moves their vertices.
    faces : tuple of (N_k, corners_k) intp
        What is drawn: quads, triangles.
    inside : Inside or None
        How the faces carry what is in them; None for triangles of a moving plane.
    source : (V, 2) float64
    """

    path: VertexPath
    faces: tuple[Index, ...]
    inside: Inside | None
    source: Points

    @classmethod
    def of(cls, body: Carried, method: str) -> "Skeleton":
        """The skeleton of a body that `method` moves, alone or by leading a plane."""
        mesh = body.path.mesh
        if mesh is not None:
            triangles = mesh.triangles[mesh.inside & ~mesh.inverted]
            return cls(body.path, (triangles,), None, mesh.source)
        pair = joined_meshes(body.nodes.rings)
        inside = Inside.of(pair, INTERIORS[method])
        quads = pair.quads if inside.interior == "homography" else pair.quads[:0]
        return cls(tween(pair, method), (quads, inside.triangles), inside, pair.source)

    @cached_property
    def edges(self) -> Index:
        """Sides of the faces, each once, (E, 2)."""
        sides = [np.stack([f, np.roll(f, -1, axis=1)], axis=-1).reshape(-1, 2) for f in self.faces]
        return np.unique(np.sort(np.concatenate(sides), axis=1), axis=0)

    def jacobians(self, t: Floats) -> tuple[Floats, Floats]:
        """Jacobians from the source all over the inside (F, N, 2, 2), and areas around (N,)."""
        vertices = self.path.vertices(t)
        if self.inside is not None:
            return self.inside.jacobians(vertices, PLACES)
        (triangles,) = self.faces
        moved = vertices[:, triangles]
        start = self.source[triangles]
        flat = triangle_affinities(np.broadcast_to(start, moved.shape), moved)
        return flat, np.abs(polygon_area(start))
