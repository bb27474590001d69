"""Better faces where a mesh has inner vertices: vertices moved, triangles joined in pairs."""

import numpy as np

from shapetween.base.arrays import Floats, Index, Points
from shapetween.geometry.polygon import corner_sines
from shapetween.mesh.quality import MIN_CORNER_SINE, face_figures

__all__ = ["is_too_large", "joined_triangles", "smoothed"]

#: Shares of the way to the middle of its neighbours that a vertex is tried at.
STEPS = np.array([0.0, 0.15, 0.4, 0.8])

#: Most sweeps over all inner vertices.
SWEEPS = 12

#: Most vertices of a mesh that is smoothed; time grows with their square. Meshes with more are of
#: shapes that have nothing in common.
MOST_VERTICES = 600

#: Least gain in a corner's sine that a vertex is moved for.
LEAST_GAIN = 1e-3


def is_too_large(count: int, first: int) -> bool:
    """Whether the inner vertices of a mesh, from the first of them on, stay where they are."""
    return first < count > MOST_VERTICES


def smoothed(points: Points, first: int, faces: list[Index]) -> Points:
    """Move inner vertices, in each shape alone, so that the sharpest corners round them widen.

    Parameters
    ----------
    points : (2, V, 2) float64
        Vertices; all faces are convex in both shapes, and stay as convex as they must be.
    first : int
        The first inner vertex; those before it stay.
    faces : list of (F, K) intp
        Faces of each kind.

    Returns
    -------
    (2, V, 2) float64
    """
    if is_too_large(points.shape[1], first):
        return points
    count = points.shape[1]
    points = points.copy()
    together = np.eye(count, dtype=bool)
    near = np.zeros((count, count))
    for kind in faces:
        together[kind[:, :, None], kind[:, None, :]] = True
        near[kind, np.roll(kind, 1, axis=1)] = near[np.roll(kind, 1, axis=1), kind] = 1.0
    degree = near.sum(axis=1)[:, None]
    for _ in range(SWEEPS):
        places = points[:, :, None] + STEPS[:, None] * (near @ points / degree - points)[:, :, None]
        sharpest = np.full((2, count, len(STEPS)), np.inf)
        for kind in faces:
            floor = MIN_CORNER_SINE if kind.shape[1] == 4 else 0.0
            for corner in range(kind.shape[1]):
                moving = kind[:, corner] >= first
                face, vertex = kind[moving], kind[moving, corner]
                corners = np.repeat(points[:, face][:, :, None], len(STEPS), axis=2)
                corners[:, :, :, corner] = places[:, vertex]
                sines = corner_sines(corners).min(axis=-1) - floor
                for shape in (0, 1):
                    np.minimum.at(sharpest[shape], vertex, sines[shape])
        sharpest[:, :first] = 0
        gains = sharpest.max(axis=-1) - sharpest[..., 0]
        if not (gains > LEAST_GAIN).any():
            break
        for shape, gain in enumerate(gains):
            free = gain > LEAST_GAIN
            for vertex in np.argsort(-gain, kind="stable")[: free.sum()].tolist():
                if free[vertex]:
                    best = sharpest[shape, vertex].argmax()
                    points[shape, vertex] = places[shape, vertex, best]
                    free &= ~together[vertex]
    return points


def joined_triangles(points: Points, triangles: Index) -> tuple[Index, Index]:
    """Join triangles in pairs to quads that move well, the roundest quads first.

    Parameters
    ----------
    points : (2, V, 2) float64
    triangles : (T, 3) intp

    Returns
    -------
    quads : (Q, 4) intp
    triangles : (T - 2 * Q, 3) intp
        Those left over.
    """
    count = points.shape[1]
    start, end = triangles, np.roll(triangles, -1, axis=1)
    there, back = (start * count + end).ravel(), (end * count + start).ravel()
    order = np.argsort(there)
    at = np.minimum(np.searchsorted(there[order], back), len(there) - 1)
    other = order[at]  # the same edge, run the other way
    edges = np.flatnonzero((there[other] == back) & (there < back))
    one, two = edges // 3, other[edges] // 3
    apex, far = np.roll(triangles, -2, axis=1).ravel()[[edges, other[edges]]]
    quads = np.stack([start.ravel()[edges], far, end.ravel()[edges], apex], axis=1)

    figures = face_figures(points[:, quads])
    usable: Floats = np.where(figures.usable, figures.sine, 0.0)
    free = np.ones(len(triangles), dtype=bool)
    chosen = []
    for pair in np.argsort(-usable, kind="stable")[: (usable > 0).sum()].tolist():
        if free[one[pair]] and free[two[pair]]:
            free[one[pair]] = free[two[pair]] = False
            chosen.append(pair)
    return quads[chosen], triangles[free]
