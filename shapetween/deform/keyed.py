"""The motion of an ambient mesh by a few solved times and a smooth way between them.

Solving is dear and its motion is smooth, so it is solved at a few even times and a cubic
spline goes through them. The spline runs in the frame that moves along with the shapes as wholes:
what moves with that frame stands still in it, and similar or affine images come out exactly.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from shapetween.base.arrays import Complex, Floats, Points, times
from shapetween.deform.mesh import AmbientMesh
from shapetween.geometry.spline import spline_weights

__all__ = ["KeyedMotion"]


@dataclass(frozen=True, slots=True, eq=False)
class KeyedMotion:
    """A mesh in motion, ready to be asked for any times.

    Attributes
    ----------
    mesh : AmbientMesh
    keys : (K, V) complex128
        Its vertices at K even times, in the frame of its body's motion.
    """

    mesh: AmbientMesh
    keys: Complex

    @classmethod
    def of(cls, mesh: AmbientMesh, posed: Complex) -> "KeyedMotion":
        """From vertices at even times, 0 and 1 among them, from pose to pose, (K, V)."""
        frame = mesh.body.at(np.linspace(0, 1, len(posed)))
        return cls(mesh, frame.inverse()[:, None](posed))

    def vertices(self, t: ArrayLike) -> Points:
        """Vertices at the times (F,), in user units, (F, V, 2); the mesh's own at 0 and 1."""
        at = times(t)
        return self.mesh.placed(self.posed(at), at)

    def nodes(self, t: Floats) -> Points:
        """The first vertices only, those on the outlines, (F, N, 2)."""
        return self.mesh.placed(self._posed(t, self.keys[:, : self.mesh.nodes]), t)

    def posed(self, t: Floats) -> Complex:
        """Vertices at the times (F,), from pose to pose, (F, V)."""
        return self._posed(t, self.keys)

    def _posed(self, t: Floats, keys: Complex) -> Complex:
        weights = spline_weights(len(keys), t)
        between = weights @ np.ascontiguousarray(keys).view(np.float64)
        return self.mesh.body.at(t)[:, None](between.view(np.complex128))
