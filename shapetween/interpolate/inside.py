"""What happens inside the faces of a moving mesh.

A mesh's movement is that of its vertices; what lies inside a face goes along by its homography or,
for methods that know triangles only, by the affine maps of these.
"""

from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np

from shapetween.base.arrays import Floats, Index, Points
from shapetween.geometry.homography import (
    apply_homography,
    homogeneous_weights,
    homography_jacobians,
    quad_homographies,
    triangle_affinities,
)
from shapetween.geometry.polygon import cross, polygon_area
from shapetween.interpolate.faces import split_quads
from shapetween.mesh.pair import MeshPair

__all__ = ["Inside", "Interior", "quad_places"]

Interior: TypeAlias = Literal["homography", "triangles"]
"""How the inside of a quad goes along with its corners."""


def quad_places(quads: Points, count: int) -> tuple[Points, Floats]:
    """Even places inside quads, and the area around each.

    Parameters
    ----------
    quads : (Q, 4, 2) float64
    count : int
        Places along a side; none lies on it.

    Returns
    -------
    places : (Q, count^2, 2) float64
    areas : (Q, count^2) float64
        They add up to the area of the quad.
    """
    step = (np.arange(count) + 0.5) / count
    u, v = (x.reshape(-1, 1) for x in np.meshgrid(step, step))
    a, b, c, d = (x[:, None] for x in np.moveaxis(quads, 1, 0))
    places = (1 - v) * ((1 - u) * a + u * b) + v * ((1 - u) * d + u * c)
    along = (1 - v) * (b - a) + v * (c - d)
    down = (1 - u) * (d - a) + u * (c - b)
    return places, np.abs(cross(along, down)) / count**2


@dataclass(frozen=True, slots=True, eq=False)
class Inside:
    """The faces of a mesh pair, ready to carry what is inside them.

    Attributes
    ----------
    pair : MeshPair
    interior : {"homography", "triangles"}
    triangles : (T, 3) intp
        The pair's own, or two of every quad and then these.
    """

    pair: MeshPair
    interior: Interior
    triangles: Index

    @classmethod
    def of(cls, pair: MeshPair, interior: Interior) -> "Inside":
        """Prepare a pair; what `split_quads` raises if quads are split and one cannot be."""
        return cls(
            pair, interior, pair.triangles if interior == "homography" else split_quads(pair)
        )

    def _homographies(self, vertices: Points) -> tuple[Floats, Points]:
        """Of each quad about its source's centroid, (F, Q, 3, 3), and the centroids (Q, 1, 2)."""
        source = self.pair.source[self.pair.quads]
        centres = source.mean(axis=1, keepdims=True)
        target = vertices[:, self.pair.quads]
        local = np.broadcast_to(source - centres, target.shape)
        return quad_homographies(local, target), centres

    def points(self, vertices: Points, places: Points) -> Points:
        """Points inside the quads while the vertices move.

        Parameters
        ----------
        vertices : (F, V, 2) float64
        places : (Q, K, 2) float64
            Where they are in the source, each inside its quad.

        Returns
        -------
        (F, Q, K, 2) float64
        """
        if self.interior == "homography":
            matrix, centres = self._homographies(vertices)
            shape = (len(vertices), *places.shape)
            return apply_homography(matrix, np.broadcast_to(places - centres, shape))
        halves = self.triangles[: 2 * len(self.pair.quads)].reshape(-1, 2, 3)
        a, b, c = np.moveaxis(self.pair.source[halves], 2, 0)[:, :, :, None]  # (Q, 2, 1, 2)
        offset = places[:, None] - a
        u, v = (
            cross(offset, c - a) / cross(b - a, c - a),
            cross(b - a, offset) / cross(b - a, c - a),
        )
        shares = np.stack([1 - u - v, u, v], axis=-1)  # (Q, 2, K, 3)
        within = shares.min(axis=-1).argmax(axis=1)[:, None, :, None]
        moved = shares @ vertices[:, halves]
        return np.asarray(np.take_along_axis(moved, within[None], axis=2)[:, :, 0])

    def jacobians(self, vertices: Points, count: int) -> tuple[Floats, Floats]:
        """Jacobians from the source at even places inside all faces.

        Parameters
        ----------
        vertices : (F, V, 2) float64
        count : int
            Places along the side of a quad; a triangle needs one.

        Returns
        -------
        jacobians : (F, N, 2, 2) float64
        areas : (N,) float64
            Area around each place in the source.
        """
        pair, frames = self.pair, len(vertices)
        start = pair.source[self.triangles]
        moved = vertices[:, self.triangles]
        flat = triangle_affinities(np.broadcast_to(start, moved.shape), moved)
        areas = np.abs(polygon_area(start))
        if self.interior == "triangles":
            return flat, areas
        places, around = quad_places(pair.source[pair.quads], count)
        matrix, centres = self._homographies(vertices)
        local = np.broadcast_to(places - centres, (frames, *places.shape))
        inner = homography_jacobians(matrix, local).reshape(frames, -1, 2, 2)
        return np.concatenate([inner, flat], axis=1), np.concatenate([around.ravel(), areas])

    def least_weights(self, vertices: Points) -> Floats:
        """Least w at a quad's corners over the largest, in the worst quad, (F,).

        1 where all quads move affinely, 0 or less where one meets infinity; 1 for triangles.
        """
        if self.interior == "triangles" or not len(self.pair.quads):
            return np.ones(len(vertices))
        matrix, centres = self._homographies(vertices)
        local = self.pair.source[self.pair.quads] - centres
        weights = homogeneous_weights(matrix, np.broadcast_to(local, (len(vertices), *local.shape)))
        return np.asarray((weights.min(axis=-1) / weights.max(axis=-1)).min(axis=-1))
