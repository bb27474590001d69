"""Two meshes of the same topology: where every vertex is at the start, and where at the end."""

from dataclasses import dataclass, field

import numpy as np

from shapetween.base.arrays import Index, Points, frozen
from shapetween.base.errors import MeshError, ShapeError

__all__ = ["MeshPair"]


def _no_triangles() -> Index:
    return np.zeros((0, 3), dtype=np.intp)


@dataclass(frozen=True, slots=True, eq=False)
class MeshPair:
    """Quads, and triangles where no quad fits, over two arrays of vertices.

    Attributes
    ----------
    source, target : (V, 2) float64
        Vertices at t = 0 and at t = 1.
    quads : (Q, 4) intp
        Corner indices, clockwise as drawn in both shapes.
    triangles : (T, 3) intp
        The same for triangles, which move affinely.

    Raises
    ------
    MeshError
        If an index names no vertex, a face names one twice, or no face is left.
    ShapeError
        If an array has the wrong shape or a number is not finite.
    """

    source: Points
    target: Points
    quads: Index
    triangles: Index = field(default_factory=_no_triangles)

    def __post_init__(self) -> None:
        """Copy, check and lock all arrays."""
        for name in ("source", "target"):
            object.__setattr__(self, name, frozen(getattr(self, name), np.float64, last=(2,)))
        for name, corners in (("quads", 4), ("triangles", 3)):
            faces = frozen(getattr(self, name), np.intp, last=(corners,))
            object.__setattr__(self, name, faces)
            if faces.size and (faces.min() < 0 or faces.max() >= len(self.source)):
                raise MeshError(
                    f"{name}: an index names no vertex, of which there are {len(self.source)}"
                )
            ordered = np.sort(faces, axis=1)
            twice = np.flatnonzero((ordered[:, 1:] == ordered[:, :-1]).any(axis=1))
            if twice.size:
                raise MeshError(f"{name}: face {twice[0]} names a vertex twice")
        if self.source.shape != self.target.shape:
            raise ShapeError(
                f"{len(self.source)} source vertices and {len(self.target)} target vertices; "
                "they must be as many"
            )
        if not len(self.quads) and not len(self.triangles):
            raise MeshError("a mesh needs at least one quad or triangle")

    def reversed(self) -> "MeshPair":
        """The same mesh from target to source."""
        return MeshPair(self.target, self.source, self.quads, self.triangles)
