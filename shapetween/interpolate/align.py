"""Force equilibrium: loose faces pulled together into one mesh.

.. [WKD07] K. H. Wong, P. Kovesi, A. Datta, "Projective Transformations for Image Transition
   Animations", ICIAP 2007, section 5.
"""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from shapetween.base.arrays import Floats, Index, Points
from shapetween.mesh.pair import MeshPair

if TYPE_CHECKING:
    from scipy.sparse import csr_array

__all__ = ["Alignment", "Equilibrium"]


@dataclass(frozen=True, slots=True, eq=False)
class Equilibrium:
    """The linear system of [WKD07]_ equations (11) to (15), before any frame is known.

    Attributes
    ----------
    incidence : (C, V) sparse
        1 where a loose corner stands for a vertex; corners run face after face.
    membership : (C, N) sparse
        1 where a loose corner belongs to a face.
    matrix : (N, N) sparse
        Equation (13): the graph Laplacian of vertex sharing.
    components : (N,) intp
        Connected component of each face; faces that share a vertex are connected.
    """

    incidence: "csr_array"
    membership: "csr_array"
    matrix: "csr_array"
    components: Index

    @classmethod
    def of(cls, faces: list[Index], vertices: int) -> "Equilibrium":
        """Build the system of a mesh.

        Parameters
        ----------
        faces : list of (N_k, corners_k) intp
            Quads, triangles: one array for each number of corners.
        vertices : int

        Notes
        -----
        The sum in equation (12) leaves out k = i. Counting it, as printed, gives the matrix of
        the paper's Figure 3 rank 3, where the paper itself says 2.
        """
        from scipy.sparse import csr_array, diags_array
        from scipy.sparse.csgraph import connected_components

        corner_vertex = np.concatenate([f.ravel() for f in faces])
        sizes = np.concatenate([np.full(len(f), f.shape[1]) for f in faces])
        corner_face = np.repeat(np.arange(len(sizes)), sizes)
        ones, corners = np.ones(len(corner_vertex)), np.arange(len(corner_vertex))
        incidence = csr_array((ones, (corners, corner_vertex)), shape=(len(ones), vertices))
        membership = csr_array((ones, (corners, corner_face)), shape=(len(ones), len(sizes)))
        sharing = (membership.T @ incidence).tocsr()  # (N, V): vertices of each face
        valence: Floats = np.asarray(incidence.sum(axis=0)).ravel()
        common = (sharing @ sharing.T).tocsr()
        degree: Floats = np.asarray(sharing @ valence)
        matrix = (diags_array(degree) - common).tocsr()
        components = connected_components(common, directed=False)[1].astype(np.intp)
        return cls(incidence, membership, matrix, components)

    def forces(self, corners: Points) -> Points:
        """Resultant force on each face, (N, 2), for loose corners (C, 2): equation (11)."""
        valence = np.asarray(self.incidence.sum(axis=0)).ravel()
        pull = self.incidence @ (self.incidence.T @ corners)
        count = (self.incidence @ valence)[:, None]
        return np.asarray(self.membership.T @ (pull - count * corners))


class Alignment:
    """Equilibrium prepared for one mesh, so that every frame costs two back-substitutions.

    Parameters
    ----------
    pair : MeshPair
        Faces in the order quads, triangles.
    weights : (N,) float64
        Positive weight of each face, its area, in the condition that fixes the translations.
    """

    def __init__(self, pair: MeshPair, weights: Floats) -> None:
        from scipy.sparse.linalg import splu

        faces = [f for f in (pair.quads, pair.triangles) if len(f)]
        self._system = Equilibrium.of(faces, len(pair.source))
        self._weights = weights
        self._valence = np.asarray(self._system.incidence.sum(axis=0)).ravel()
        # The matrix knows no difference between translations of a whole component. One face of
        # each is held for the solution, which leaves a positive definite matrix to factor; the
        # component is then moved as the constraint asks. Same result as the bordered system.
        _, held = np.unique(self._system.components, return_index=True)
        self._free = np.setdiff1d(np.arange(len(weights)), held)
        free = self._system.matrix[self._free][:, self._free].tocsc()
        self._factor = (
            splu(
                free,
                permc_spec="MMD_AT_PLUS_A",
                diag_pivot_thresh=0.0,
                options={"SymmetricMode": True},
            )
            if len(self._free)
            else None
        )

    def vertices(self, corners: Points) -> Points:
        """Vertices of the aligned mesh.

        Parameters
        ----------
        corners : (F, C, 2) float64
            Loose corners in every frame, face after face.

        Returns
        -------
        (F, V, 2) float64
            Mean of the moved corners at each vertex.

        Notes
        -----
        The translations t of the faces solve C t = F, equation (14), with the weighted sum of t
        over each connected component zero. Equilibrium and averaging together minimise
        sum_j n_j sum_i |P_ij + t_i - x_j|^2 over t and the vertices x, n_j the number of faces
        at vertex j.
        """
        frames = len(corners)
        side = np.moveaxis(corners, 0, 1).reshape(corners.shape[1], frames * 2)  # (C, 2F)
        moves = np.zeros((len(self._weights), frames * 2))
        if self._factor is not None:
            moves[self._free] = self._factor.solve(self._system.forces(side)[self._free])
        part = self._system.components
        total = np.bincount(part, weights=self._weights)
        share = (self._weights / total[part])[:, None] * moves
        mean = np.zeros((len(total), frames * 2))
        np.add.at(mean, part, share)
        moved = side + self._system.membership @ (moves - mean[part])
        vertices = (self._system.incidence.T @ moved) / np.maximum(self._valence, 1)[:, None]
        return np.moveaxis(vertices.reshape(-1, frames, 2), 1, 0)

    def residual(self, corners: Points, vertices: Points) -> Floats:
        """Root mean square distance of moved corners to their vertex in each frame, (F,).

        Parameters
        ----------
        corners : (F, C, 2) float64
        vertices : (F, V, 2) float64
            What `vertices` gave for them.
        """
        index = self._system.incidence.indices
        offsets = vertices[:, index] - corners
        faces = self._system.membership.indices
        # The face's own translation is what brings its mean offset to zero.
        moves = np.stack([self._system.membership.T @ frame for frame in offsets])
        moves /= np.bincount(faces)[:, None]
        return np.asarray(np.sqrt(((offsets - moves[:, faces]) ** 2).sum(-1).mean(-1)))
