"""A matched mesh made finer: every face in four, with inner points."""

import numpy as np

from shapetween.base.arrays import Index
from shapetween.geometry.polygon import corner_sines
from shapetween.interpolate.faces import mesh_edges, split_quads
from shapetween.mesh.pair import MeshPair

__all__ = ["refined"]


def refined(pair: MeshPair) -> MeshPair:
    """Cut every face in four, through the middles of its edges and of quads.

    Returns
    -------
    MeshPair
        Its first vertices are the pair's own. Quads that are not convex at both ends are two
        triangles first.

    Raises
    ------
    DegenerateQuadError, MeshError
        What `split_quads` refuses.

    Notes
    -----
    The four parts of a convex quad are convex, so that whatever is valid stays so.
    """
    halves = split_quads(pair)
    sines = np.stack([corner_sines(x[pair.quads]) for x in (pair.source, pair.target)])
    turning = np.sign(sines[:1].sum(axis=-1, keepdims=True))
    convex = (sines * turning > 0).all(axis=(0, 2))
    own = 2 * len(pair.quads)
    quads = pair.quads[convex]
    cut = halves[:own].reshape(-1, 2, 3)[~convex].reshape(-1, 3)
    triangles = np.concatenate([cut, halves[own:]])
    edges, _ = mesh_edges([quads, triangles])
    count = len(pair.source)
    code = edges @ [count, 1]

    def middles(faces: Index) -> Index:
        """Vertex in the middle of each face's edge from a corner to the next."""
        ends = np.sort(np.stack([faces, np.roll(faces, -1, axis=1)], axis=-1), axis=-1)
        return np.asarray(count + np.searchsorted(code, ends @ [count, 1]))

    centres = count + len(edges) + np.arange(len(quads))
    m = middles(quads)
    quarters = [np.stack([quads[:, k], m[:, k], centres, m[:, k - 1]], axis=1) for k in range(4)]
    n = middles(triangles)
    outer = [np.stack([triangles[:, k], n[:, k], n[:, k - 1]], axis=1) for k in range(3)]
    source, target = (
        np.concatenate([x, x[edges].mean(axis=1), x[quads].mean(axis=1)])
        for x in (pair.source, pair.target)
    )
    return MeshPair(source, target, np.concatenate(quarters), np.concatenate([*outer, n]))
