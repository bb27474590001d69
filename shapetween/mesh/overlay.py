"""Faces for two polygons that no common diagonal can cut: one triangulation laid over the other.

Both triangulations have the same corners in the same cyclic order, so both can be drawn inside one
convex polygon. Where a diagonal of one crosses a diagonal of the other there is a new vertex, and
the faces of the drawing lie in one triangle of each. In either shape, put the new vertices evenly
along that shape's own diagonals: the other's diagonals then cross every triangle in straight,
separate chords, and all faces are strictly convex in both. Which diagonals cross, and in which
order, follows from the numbers of their ends alone, so nothing here is rounded.

.. [ASS93] B. Aronov, R. Seidel, D. Souvaine, "On compatible triangulations of simple polygons",
   Computational Geometry 3(1), 1993.
"""

from itertools import pairwise

import numpy as np

from shapetween.base.arrays import Floats, Index, Points
from shapetween.base.errors import OutlineError
from shapetween.mesh.simple import cheapest_triangulation, inner_diagonals

__all__ = ["overlay"]


def _crossings(count: int, diagonals: Index) -> Floats:
    """How many of the given diagonals each pair of corners crosses, (n, n)."""
    corner = np.arange(count)[:, None, None, None]
    other = np.arange(count)[:, None, None]
    between = (corner < diagonals) & (diagonals < other)  # (n, n, K, 2)
    beyond = (diagonals < corner) | (diagonals > other)
    inside = (between[..., 0] & beyond[..., 1]) | (between[..., 1] & beyond[..., 0])
    return np.asarray(inside.sum(axis=-1), dtype=np.float64)


def _two_triangulations(polygons: Points) -> tuple[Index, Index]:
    """Triangulations of two polygons that cross each other seldom."""
    count = polygons.shape[1]
    allowed = [inner_diagonals(ring) for ring in polygons]
    crossings = np.zeros((count, count))
    found = [np.zeros((0, 2), dtype=np.intp)] * 2
    for shape in (0, 1, 0):  # each against the last of the other
        found[shape] = cheapest_triangulation(polygons[shape], allowed[shape], crossings)
        if len(found[shape]) != count - 3:
            raise OutlineError("an outline touches itself, so that its inside cannot be meshed")
        crossings = _crossings(count, found[shape])
    return found[0], found[1]


def overlay(polygons: Points) -> tuple[list[list[int]], Points]:
    """Faces of 3 to 6 corners, strictly convex in both polygons.

    Parameters
    ----------
    polygons : (2, n, 2) float64
        Simple, clockwise as drawn, without a common inner diagonal.

    Returns
    -------
    faces : list of list of int
        Corners; from n on they are inner vertices.
    inner : (2, m, 2) float64

    Raises
    ------
    OutlineError
        If a polygon has no triangulation, which a simple one always has.

    Notes
    -----
    The compatible triangulation of [ASS93]_, with its faces left whole.
    """
    count = polygons.shape[1]
    pair = [diagonals.tolist() for diagonals in _two_triangulations(polygons)]
    chains: list[dict[tuple[int, int], list[int]]] = [{}, {}]
    number: dict[tuple[int, int, int, int], int] = {}

    def vertex(a: int, b: int, c: int, d: int) -> int:
        ends = sorted((a, b, c, d))
        return number.setdefault((ends[0], ends[1], ends[2], ends[3]), count + len(number))

    # Along a diagonal a-c those that cross it come in the order of their ends between a and c,
    # and, from one common end, in the order of their other ends backwards from a.
    for own, others, chain in ((pair[0], pair[1], chains[0]), (pair[1], pair[0], chains[1])):
        for a, c in own:
            crossing = []
            for ends in others:
                for b, d in (ends, ends[::-1]):
                    if a < b < c and not a <= d <= c:
                        crossing.append((b, -((d - a) % count), d))
            chain[a, c] = [a, *(vertex(a, b, c, d) for b, _, d in sorted(crossing)), c]

    inner_points = np.zeros((2, len(number), 2))
    around: dict[int, list[tuple[int, int]]] = {v: [] for v in range(count + len(number))}
    for shape, chain in enumerate(chains):
        for (a, c), run in chain.items():
            share = np.linspace(0, 1, len(run))[1:-1, None]
            start, end = polygons[shape, a], polygons[shape, c]
            inner_points[shape, np.array(run[1:-1], dtype=np.intp) - count] = start + share * (
                end - start
            )
            for before, after in pairwise(run):
                around[before].append((c, after))
                around[after].append((a, before))
    for v in range(count):
        around[v] += [((v + 1) % count, (v + 1) % count), ((v - 1) % count, (v - 1) % count)]

    # Round every vertex its neighbours in the order of the corners they lead to; a face turns
    # into the neighbour just before the one it came from.
    turn: dict[tuple[int, int], int] = {}
    for v, towards in around.items():
        reference = v if v < count else 0
        ring = [n for _, n in sorted(towards, key=lambda e: (e[0] - reference) % count)]
        for at, came_from in enumerate(ring):
            turn[came_from, v] = ring[at - 1]
    for v in range(count):
        del turn[(v + 1) % count, v]  # the outer face
    faces = []
    while turn:
        start = next(iter(turn))
        face, edge = [], start
        while edge in turn:
            face.append(edge[1])
            edge = (edge[1], turn.pop(edge))
        faces.append(face)
    return faces, inner_points
