"""Pushing the nodes of a moving body, the mesh around them following."""

from dataclasses import replace

import numpy as np

from shapetween.base.arrays import Complex, Index
from shapetween.deform.keyed import KeyedMotion
from shapetween.deform.mesh import AmbientMesh
from shapetween.deform.schedule import CHECKED_TIMES
from shapetween.outline.body import Carried

__all__ = ["pushed"]

#: Passes that spread the pushes to the mesh around, whose free vertices follow their neighbours.
SPREADING = 20


def pushed(body: Carried, motion: KeyedMotion, pushes: Complex) -> Carried:
    """The body with its nodes moved further, and how often it crosses then.

    Parameters
    ----------
    body : Carried
    motion : KeyedMotion
        Its path.
    pushes : (CHECKED_TIMES, N) complex128
        Of each node, in user units, nothing at both ends.
    """
    t = np.linspace(0, 1, CHECKED_TIMES)
    mesh = motion.mesh
    sizes = (1 - t) * mesh.poses[0].size + t * mesh.poses[1].size
    path = KeyedMotion.of(mesh, motion.posed(t) + _spread(mesh, pushes / sizes[:, None]))
    crossing = int((~body.nodes.simple(t, path.nodes(t))[1:-1]).sum())
    return replace(body, path=path, crossing=crossing)


def _spread(mesh: AmbientMesh, pushes: Complex) -> Complex:
    """Pushes of the nodes, (F, N), carried on to the free vertices around, (F, V)."""
    count, fixed = len(mesh.source), mesh.nodes + len(mesh.frame)
    result = np.zeros((len(pushes), count), dtype=np.complex128)
    result[:, : mesh.nodes] = pushes
    if fixed == count:
        return result
    from scipy.sparse import csr_array

    one, other = _edges(mesh)
    number = np.bincount(one, minlength=count)
    starts = np.concatenate([[0], np.cumsum(number)])
    # Rows of the free vertices alone, in all frames at once: a pass is one product.
    sums = csr_array((np.ones(len(other)), other, starts), shape=(count, count))[fixed:]
    share = 1.0 / np.maximum(number[fixed:, None], 1)
    moving = np.flatnonzero((np.abs(pushes) > 0).any(axis=1))
    values = np.ascontiguousarray(result[moving].T).view(np.float64)
    for _ in range(SPREADING):
        values[fixed:] = (sums @ values) * share
    result[moving] = values.view(np.complex128).T
    return result


def _edges(mesh: AmbientMesh) -> tuple[Index, Index]:
    """Both ends of every edge of the triangles, once from either, in order."""
    count = len(mesh.source)
    sides = np.concatenate([mesh.triangles[:, [k, (k + 1) % 3]] for k in range(3)])
    return np.divmod(np.unique(np.concatenate([sides, sides[:, ::-1]]) @ [count, 1]), count)
