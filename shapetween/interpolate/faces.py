"""Faces of a mesh: which of them meet, quads as pairs of triangles, and faces that cannot move."""

import numpy as np

from shapetween.base.arrays import Floats, Index
from shapetween.base.errors import DegenerateQuadError, MeshError
from shapetween.geometry.polygon import corner_sines, polygon_area
from shapetween.mesh.pair import MeshPair

__all__ = [
    "both_areas",
    "check_triangles",
    "connected_parts",
    "mesh_edges",
    "shared_edges",
    "split_quads",
]

#: Least sine of a triangle's corner. Larger refuses thin but valid triangles; smaller lets the
#: rotation that is read off the matrix be rounding error.
MIN_CORNER_SINE = 1e-9


def shared_edges(faces: list[Index]) -> Index:
    """Pairs of faces that share an edge, (E, 2).

    Parameters
    ----------
    faces : list of (N_k, corners_k) intp
        Faces are counted through all arrays.
    """
    edges, owner, first = [], [], 0
    for group in faces:
        edges.append(np.stack([group, np.roll(group, -1, axis=1)], axis=-1).reshape(-1, 2))
        owner.append(np.repeat(np.arange(first, first + len(group)), group.shape[1]))
        first += len(group)
    ends = np.sort(np.concatenate(edges), axis=1)
    faces_of = np.concatenate(owner)
    order = np.lexsort((faces_of, ends[:, 1], ends[:, 0]))
    same = np.flatnonzero((ends[order[1:]] == ends[order[:-1]]).all(axis=1))
    return np.stack([faces_of[order[same]], faces_of[order[same + 1]]], axis=1)


def connected_parts(faces: list[Index], vertices: int) -> Index:
    """Connected part that each face belongs to, (N,); faces that share a vertex are connected.

    Parameters
    ----------
    faces : list of (N_k, corners_k) intp
    vertices : int
        How many vertices the faces index.
    """
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    first = np.concatenate([np.repeat(f[:, 0], f.shape[1]) for f in faces])
    corners = np.concatenate([f.ravel() for f in faces])
    graph = coo_array((np.ones(len(corners)), (first, corners)), shape=(vertices, vertices))
    owner = connected_components(graph, directed=False)[1]
    return np.asarray(np.concatenate([owner[f[:, 0]] for f in faces]), dtype=np.intp)


def both_areas(pair: MeshPair, faces: list[Index], parts: Index) -> Floats:
    """Area of each face as a share of its part's, summed over both ends, (N,).

    Both ends count alike, whatever their sizes, so that the way back is the same.
    """
    total = np.zeros(len(parts))
    for points in (pair.source, pair.target):
        areas = np.concatenate([np.abs(polygon_area(points[f])) for f in faces])
        total += areas / np.bincount(parts, weights=areas)[parts]
    return total


def mesh_edges(faces: list[Index]) -> tuple[Index, Index]:
    """Edges of faces, (E, 2) in ascending order, and how many faces each belongs to, (E,)."""
    sides = [np.stack([f, np.roll(f, -1, axis=1)], axis=-1).reshape(-1, 2) for f in faces]
    edges, count = np.unique(np.sort(np.concatenate(sides), axis=1), axis=0, return_counts=True)
    return edges, count


def _least_sines(pair: MeshPair, triangles: Index) -> Floats:
    """Least corner sine of triangles (..., 3) over both ends, (...,); negative if inverted.

    Meshes that run anticlockwise at both ends are as good as clockwise ones.
    """
    sines = np.stack([corner_sines(pair.source[triangles]), corner_sines(pair.target[triangles])])
    turning = np.sign(sines[0].sum(axis=-1, keepdims=True))
    return np.asarray((sines * turning).min(axis=(0, -1)))


def check_triangles(pair: MeshPair) -> None:
    """Refuse triangles that no linear map of positive determinant takes to their target.

    Raises
    ------
    MeshError
        If a triangle of the pair has no area at one end, or is inverted between them.
    """
    bad = np.flatnonzero(_least_sines(pair, pair.triangles) < MIN_CORNER_SINE)
    if bad.size:
        raise MeshError(
            f"triangle {bad[0]}: without area at one end, or inverted between the two; "
            "move its corners"
        )


def split_quads(pair: MeshPair) -> Index:
    """Triangles of a mesh: every quad cut by its better diagonal, then the pair's own.

    Returns
    -------
    (2 Q + T, 3) intp
        Triangles 2 k and 2 k + 1 are those of quad k.

    Raises
    ------
    DegenerateQuadError
        If neither diagonal of a quad gives triangles that are valid at both ends.
    MeshError
        If a triangle of the pair is not valid.

    Notes
    -----
    Better is the diagonal whose triangles have the larger least corner sine over both ends, so
    that the same one is chosen in both directions of time.
    """
    check_triangles(pair)
    first = pair.quads[:, [[0, 1, 2], [0, 2, 3]]]
    second = pair.quads[:, [[1, 2, 3], [1, 3, 0]]]
    choices = np.stack([first, second])  # (2, Q, 2, 3)
    least = _least_sines(pair, choices).min(axis=-1)
    # One quad's two triangles must also turn the same way, or a folded quad passes for valid.
    sides = np.stack(
        [corner_sines(points[choices]).sum(axis=-1) for points in (pair.source, pair.target)]
    )
    least = np.where((np.sign(sides) == np.sign(sides[..., :1])).all(axis=(0, -1)), least, -1.0)
    better = least.argmax(axis=0)
    bad = np.flatnonzero(least.max(axis=0, initial=-1.0) < MIN_CORNER_SINE)
    if bad.size:
        raise DegenerateQuadError(
            bad, "no diagonal splits it into triangles that are valid at both ends"
        )
    chosen = choices[better, np.arange(len(better))].reshape(-1, 3)
    return np.concatenate([chosen, pair.triangles])
