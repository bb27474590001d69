"""Two matched outlines -> one mesh of quads over both."""

from shapetween.mesh.matched import MatchedMesh, mesh_matched

__all__ = ["MatchedMesh", "mesh_matched"]
