"""The projective method: every quad by its homography, the whole by force equilibrium.

.. [WKD07] K. H. Wong, P. Kovesi, A. Datta, "Projective Transformations for Image Transition
   Animations", ICIAP 2007.
"""

from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from shapetween.align import Alignment
from shapetween.arrays import Floats, Points, times
from shapetween.geometry.homography import triangle_affinities
from shapetween.geometry.polygon import polygon_area
from shapetween.geometry.rotation import coherent_angles, linear_between, polar
from shapetween.interpolate.faces import check_triangles, shared_edges
from shapetween.interpolate.quads import QuadMotion
from shapetween.mesh import MeshPair

__all__ = ["Projective"]


class Projective:
    """A mesh pair moved by the projective method.

    Parameters
    ----------
    pair : MeshPair
        Quads convex and turning the same way at both ends; triangles move affinely.
    scale : float, optional
        Source radius of the paper's own turning line (see `interpolate_quads`); by default its
        limit, which needs no scale and does at least as well.

    Raises
    ------
    DegenerateQuadError
        If a quad has no projective in-between.
    MeshError
        If a triangle has no area at one end, or is turned over.

    Notes
    -----
    [WKD07]_, sections 3 to 5. Rotation angles are made coherent over the mesh first; the paper
    takes each alone, and quads near a half turn then part ways.
    """

    def __init__(self, pair: MeshPair, scale: float | None = None) -> None:
        check_triangles(pair)
        self.pair = pair
        quads, triangles = pair.quads, pair.triangles
        faces = [f for f in (quads, triangles) if len(f)]
        motion = QuadMotion.between(pair.source[quads], pair.target[quads], scale)
        p, q = pair.source[triangles], pair.target[triangles]
        angles, self._stretches = polar(triangle_affinities(p, q))
        areas = np.concatenate([np.abs(polygon_area(pair.source[f])) for f in faces])
        angles = coherent_angles(
            np.concatenate([motion.angles, angles]), shared_edges(faces), areas
        )
        self._motion = replace(motion, angles=angles[: len(quads)])
        self._angles = angles[len(quads) :]
        self._alignment = Alignment(pair, areas)

    def loose_corners(self, t: Floats) -> Points:
        """Corners of every face moved on its own, face after face, (F, C, 2)."""
        frames = len(t)
        corners = self._motion.corners(self.pair.source[self.pair.quads], t)
        p, q = self.pair.source[self.pair.triangles], self.pair.target[self.pair.triangles]
        centre, end = p.mean(axis=1, keepdims=True), q.mean(axis=1, keepdims=True)
        linear = linear_between(self._angles, self._stretches, t)
        moved = (p - centre) @ np.swapaxes(linear, -1, -2)
        moved += centre + t[:, None, None, None] * (end - centre)
        return np.concatenate(
            [corners.reshape(frames, -1, 2), moved.reshape(frames, -1, 2)], axis=1
        )

    def vertices(self, t: ArrayLike) -> Points:
        """All vertices at the times (F,), shape (F, V, 2); exactly the pair's own at 0 and 1."""
        moments = times(t)
        result = self._alignment.vertices(self.loose_corners(moments))
        result[moments == 0] = self.pair.source
        result[moments == 1] = self.pair.target
        return result

    def residual(self, t: ArrayLike) -> Floats:
        """How much the faces disagree after alignment, root mean square in user units, (F,)."""
        corners = self.loose_corners(times(t))
        return self._alignment.residual(corners, self._alignment.vertices(corners))
