"""What every motion of prepared points is asked for."""

from typing import Protocol

from shapetween.base.arrays import Floats, Points
from shapetween.deform.mesh import AmbientMesh

__all__ = ["Deformation", "VertexPath"]


class VertexPath(Protocol):
    """Where points that were prepared together are at any time."""

    def vertices(self, t: Floats) -> Points:
        """All of them at the times (F,), (F, V, 2)."""


class Deformation(VertexPath, Protocol):
    """A motion of vertices that may be those of an ambient mesh, to which other points bind."""

    @property
    def mesh(self) -> AmbientMesh | None:
        """The mesh whose vertices move; None if nothing else can be bound to them."""
