"""As-rigid-as-possible movement of triangles, as it was published and as it does best.

Every triangle is asked for the Jacobian R(t angle) ((1 - t) I + t S), where R(angle) S is the one
that takes it to its target, and the vertices are those that come nearest to it in least squares.

.. [ACL00] M. Alexa, D. Cohen-Or, D. Levin, "As-rigid-as-possible shape interpolation",
   SIGGRAPH 2000.
.. [BBA08] W. Baxter, P. Barla, K. Anjyo, "Rigid shape interpolation using normal equations",
   NPAR 2008.
.. [CS03] J. Choi, A. Szymczak, "On coherent rotation angles for as-rigid-as-possible shape
   interpolation", CCCG 2003.
"""

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from shapetween.base.arrays import Floats, Index, Points, times
from shapetween.deform.jacobians import gradients
from shapetween.geometry.homography import triangle_affinities
from shapetween.geometry.linearmaps import as_complex, as_points
from shapetween.geometry.polygon import polygon_area
from shapetween.geometry.rotation import coherent_angles, linear_between, polar
from shapetween.interpolate.faces import both_areas, shared_edges, split_quads
from shapetween.interpolate.refine import refined
from shapetween.mesh.pair import MeshPair

if TYPE_CHECKING:
    from scipy.sparse import csr_array

__all__ = ["AlexaArap", "Arap", "JacobianFit"]


class JacobianFit:
    """Vertices whose triangles come nearest to wanted Jacobians, factored once for all times.

    The energy is ``sum_T w_A |J_A(x) - W|^2 + w_B |J_B(x) - W J^-1|^2``: J_A and J_B are a
    triangle's Jacobians seen from its source and from its target, J the one between these.

    Parameters
    ----------
    pair : MeshPair
    triangles : (T, 3) intp
        Valid at both ends.
    weights : (2, T) float64
        w_A and w_B, not negative; w_A + w_B is positive.

    Attributes
    ----------
    jacobians : (T, 2, 2) float64
        J.

    Notes
    -----
    The normal equations of [BBA08]_: their matrix does not depend on time, so that each frame
    costs a back-substitution. The energy does not know where the whole is; the mean of each
    connected part, weighted by the area around every vertex at both ends, goes straight.
    """

    def __init__(self, pair: MeshPair, triangles: Index, weights: Floats) -> None:
        from scipy.sparse import coo_array
        from scipy.sparse.csgraph import connected_components
        from scipy.sparse.linalg import splu

        self._pair, self._triangles = pair, triangles
        ends = [pair.source[triangles], pair.target[triangles]]
        shapes_a, shapes_b = (as_points(gradients(as_complex(corners))[0]) for corners in ends)
        self.jacobians = triangle_affinities(*ends)
        back = np.swapaxes(np.linalg.inv(self.jacobians), 1, 2)
        pull_a, pull_b = weights[0, :, None, None] * shapes_a, weights[1, :, None, None] * shapes_b
        self._pulls = pull_a + pull_b @ back
        blocks = pull_a @ np.swapaxes(shapes_a, 1, 2) + pull_b @ np.swapaxes(shapes_b, 1, 2)
        count = len(pair.source)
        rows = np.broadcast_to(triangles[:, :, None], blocks.shape).ravel()
        columns = np.broadcast_to(triangles[:, None, :], blocks.shape).ravel()
        matrix = coo_array((blocks.ravel(), (rows, columns)), shape=(count, count)).tocsc()
        part = connected_components(matrix, directed=False)[1].astype(np.intp)
        self._scatter = _scatter(triangles, count)
        share = both_areas(pair, [triangles], part[triangles[:, 0]])
        mass: Floats = np.asarray(self._scatter @ np.repeat(share, 3))
        # A vertex of no triangle is a part of its own and goes straight.
        mass = np.where(mass > 0, mass, 1.0)
        self._part = part
        self._mass = mass / np.bincount(part, weights=mass)[part]
        held = np.unique(part, return_index=True)[1]
        self._free = np.setdiff1d(np.arange(count), held)
        self._factor = splu(
            matrix[self._free][:, self._free].tocsc(),
            permc_spec="MMD_AT_PLUS_A",
            diag_pivot_thresh=0.0,
            options={"SymmetricMode": True},
        )

    def vertices(self, wanted: Floats, t: Floats) -> Points:
        """Vertices nearest to wanted Jacobians (F, T, 2, 2) at the times (F,), (F, V, 2)."""
        frames, count = len(t), len(self._pair.source)
        parts = self._pulls @ np.swapaxes(wanted, 2, 3)  # (F, T, 3, 2)
        right = self._scatter @ np.moveaxis(parts, 0, 2).reshape(-1, frames * 2)
        found = np.zeros((count, frames * 2))
        found[self._free] = self._factor.solve(right[self._free])
        time = t[:, None, None]
        straight = (1 - time) * self._pair.source + time * self._pair.target
        lack = self._mass[:, None] * (np.moveaxis(straight, 0, 1).reshape(count, -1) - found)
        means = np.zeros((int(self._part.max()) + 1, frames * 2))
        np.add.at(means, self._part, lack)
        found += means[self._part]
        result = np.moveaxis(found.reshape(count, frames, 2), 1, 0)
        result[t == 0], result[t == 1] = self._pair.source, self._pair.target
        return result


def _scatter(triangles: Index, count: int) -> "csr_array":
    """Sums of what the corners of triangles hold at each vertex, as a (V, 3 T) matrix."""
    from scipy.sparse import csr_array

    corners = triangles.ravel()
    ones = np.ones(len(corners))
    return csr_array((ones, (corners, np.arange(len(corners)))), shape=(count, len(corners)))


class AlexaArap:
    """The method of [ACL00]_ as it was published, on the two triangles of every quad.

    Parameters
    ----------
    pair : MeshPair

    Raises
    ------
    MeshError
        If a face cannot be split into triangles that are valid at both ends.

    Notes
    -----
    All triangles count the same, whatever their area, and the energy sees the source only, so
    the way back is another one. Each angle is taken alone, in (-pi, pi]: neighbours on both sides
    of a half turn go opposite ways round. The paper moves one vertex straight without saying
    which; here it is the mean, as for `Arap`, so that the two can be compared.
    """

    def __init__(self, pair: MeshPair) -> None:
        triangles = split_quads(pair)
        weights = np.stack([np.ones(len(triangles)), np.zeros(len(triangles))])
        self._fit = JacobianFit(pair, triangles, weights)
        self._angles, self._stretches = polar(self._fit.jacobians)

    def vertices(self, t: ArrayLike) -> Points:
        """All vertices at the times (F,), shape (F, V, 2); exactly the pair's own at 0 and 1."""
        moments = times(t)
        return self._fit.vertices(linear_between(self._angles, self._stretches, moments), moments)


class Arap:
    """As-rigid-as-possible movement of triangles, with what was learnt since [ACL00]_.

    Parameters
    ----------
    pair : MeshPair

    Raises
    ------
    MeshError
        If a face cannot be split into triangles that are valid at both ends.

    Notes
    -----
    Triangles count by their area [BBA08]_, which makes the energy an integral over the shape;
    angles are coherent [CS03]_; the energy takes source and target alike, so that the way back is
    the same; and the triangles are those of a mesh with inner points (`refined`), on which limbs
    bend more evenly.
    """

    def __init__(self, pair: MeshPair) -> None:
        self._count = len(pair.source)
        finer = refined(pair)
        triangles = split_quads(finer)
        areas = np.abs([polygon_area(points[triangles]) for points in (finer.source, finer.target)])
        self._fit = JacobianFit(finer, triangles, areas)
        angles, self._stretches = polar(self._fit.jacobians)
        self._angles = coherent_angles(angles, shared_edges([triangles]), areas.sum(axis=0))

    def vertices(self, t: ArrayLike) -> Points:
        """All vertices at the times (F,), shape (F, V, 2); exactly the pair's own at 0 and 1."""
        moments = times(t)
        wanted = linear_between(self._angles, self._stretches, moments)
        return self._fit.vertices(wanted, moments)[:, : self._count]
