"""Triangulations of points in the plane that contain given edges.

Delaunay first, then edges are flipped until every given one is there [Slo93]_. Triangles hold
indices into the points and run clockwise as drawn, so that their signed area is positive.

.. [Slo93] S. W. Sloan, *A fast algorithm for generating constrained Delaunay triangulations*,
   Computers & Structures 47(3), 1993.
"""

from collections import deque
from collections.abc import Iterable

import numpy as np

from shapetween.arrays import Index, Mask, Points
from shapetween.errors import MeshError

__all__ = ["constrained_delaunay", "split_edges", "triangle_edges"]

Edge = tuple[int, int]

#: Twice the area, over the square of the extent, below which three points lie on a line. Smaller
#: is rounding error; larger refuses thin but sound outlines.
ROUNDING = 1e-13


def constrained_delaunay(points: Points, edges: Index) -> Index:
    """Triangulate points so that given edges are edges of the triangulation.

    Parameters
    ----------
    points : (V, 2) float64
    edges : (E, 2) intp
        Pairs of points. They must not cross each other nor pass through a point.

    Returns
    -------
    (T, 3) intp
        Triangles of the convex hull, of positive area. All but `edges` and what they block is
        Delaunay.

    Raises
    ------
    MeshError
        If the points lie on a line, or the edges cross.
    """
    from scipy.spatial import Delaunay, QhullError

    try:
        triangles = Delaunay(points).simplices.astype(np.intp)
    except QhullError as error:
        raise MeshError("the points to triangulate lie on a line") from error
    a, b, c = np.moveaxis(points[triangles], 1, 0)
    turned = (b - a)[:, 0] * (c - a)[:, 1] < (b - a)[:, 1] * (c - a)[:, 0]
    triangles[turned] = triangles[turned][:, ::-1]
    halves = _Halves(points, triangles)
    wanted = [(int(i), int(j)) for i, j in edges]
    fixed = {(min(edge), max(edge)) for edge in wanted}
    for edge in wanted:
        if edge not in halves.apex and edge[::-1] not in halves.apex:
            halves.make_delaunay(halves.insert(edge, fixed), fixed)
    return halves.triangles()


def triangle_edges(triangles: Index) -> tuple[Index, Index]:
    """Edges of a triangulation and the triangles on both sides.

    Parameters
    ----------
    triangles : (T, 3) intp
        All of the same orientation, no edge in more than two.

    Returns
    -------
    edges : (E, 2) intp
        The smaller index first, in ascending order.
    sides : (E, 2) intp
        The triangles beside each edge; the second is -1 on the border.
    """
    half = triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
    owner = np.repeat(np.arange(len(triangles)), 3)
    edges, which = np.unique(np.sort(half, axis=1), axis=0, return_inverse=True)
    order = np.argsort(which.ravel(), kind="stable")
    which = which.ravel()[order]
    first = np.r_[True, which[1:] != which[:-1]]
    sides = np.full((len(edges), 2), -1, dtype=np.intp)
    sides[which[first], 0] = owner[order][first]
    sides[which[~first], 1] = owner[order][~first]
    return edges, sides


def split_edges(triangles: Index, edges: Index, marked: Mask, first: int) -> tuple[Index, Index]:
    """Split marked edges of a triangulation in two, and the triangles beside them with them.

    Parameters
    ----------
    triangles : (T, 3) intp
    edges : (E, 2) intp
        As `triangle_edges` gives them.
    marked : (E,) bool
        Edges that get a new vertex in the middle.
    first : int
        Index of the first new vertex.

    Returns
    -------
    triangles : (T', 3) intp
        One to four for every old one, next to each other.
    parent : (T',) intp
        The old triangle each lies in.
    """
    middle = {(i, j): first + n for n, (i, j) in enumerate(edges[marked].tolist())}
    split: list[tuple[int, int, int]] = []
    parent: list[int] = []
    for index, (i, j, k) in enumerate(triangles.tolist()):
        corners = (i, j, k)
        mids = [middle.get((min(p, q), max(p, q))) for p, q in ((i, j), (j, k), (k, i))]
        count = 3 - mids.count(None)
        if count == 1:
            turn = next(n for n in range(3) if mids[n] is not None)
        elif count == 2:
            turn = (next(n for n in range(3) if mids[n] is None) + 1) % 3
        else:
            turn = 0
        a, b, c = (corners[(turn + n) % 3] for n in range(3))
        ab, bc, ca = (mids[(turn + n) % 3] for n in range(3))
        pieces = [(a, b, c)]
        if ab is not None:
            pieces = [(a, ab, c), (ab, b, c)]
            if bc is not None:
                pieces = [(a, ab, c), (ab, bc, c), (ab, b, bc)]
                if ca is not None:
                    pieces = [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
        split += pieces
        parent += [index] * len(pieces)
    return np.array(split, dtype=np.intp), np.array(parent, dtype=np.intp)


class _Halves:
    """Triangles as directed edges, each with the corner opposite."""

    def __init__(self, points: Points, triangles: Index) -> None:
        self.points: list[list[float]] = points.tolist()
        self.least = ROUNDING * float(np.abs(points).max()) ** 2
        self.apex: dict[Edge, int] = {}
        for a, b, c in triangles.tolist():
            self._add(a, b, c)

    def _add(self, a: int, b: int, c: int) -> None:
        self.apex[a, b], self.apex[b, c], self.apex[c, a] = c, a, b

    def triangles(self) -> Index:
        """Triangles, each once, in ascending order of its least corner."""
        least = ((a, b, c) for (a, b), c in self.apex.items() if a < b and a < c)
        return np.array(sorted(least), dtype=np.intp).reshape(-1, 3)

    def turn(self, a: int, b: int, c: int) -> float:
        """Twice the signed area of a triangle."""
        (ax, ay), (bx, by), (cx, cy) = self.points[a], self.points[b], self.points[c]
        return (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)

    def crosses(self, edge: Edge, other: Edge) -> bool:
        """Whether two edges cross in their interiors."""
        (a, b), (c, d) = edge, other
        if a in other or b in other:
            return False
        return self._parts(a, b, c, d) and self._parts(c, d, a, b)

    def _parts(self, a: int, b: int, c: int, d: int) -> bool:
        """Whether `c` and `d` lie on different sides of the line through `a` and `b`."""
        low, high = sorted((self.turn(a, b, c), self.turn(a, b, d)))
        return low < -self.least and high > self.least

    def flip(self, edge: Edge) -> Edge | None:
        """Replace an edge by the other diagonal of its quad, or None if that is not convex."""
        (a, b), c = edge, self.apex[edge]
        d = self.apex[b, a]
        if self.turn(c, a, d) <= self.least or self.turn(d, b, c) <= self.least:
            return None
        del self.apex[a, b], self.apex[b, a]
        self._add(a, d, c)
        self._add(d, b, c)
        return (min(c, d), max(c, d))

    def insert(self, edge: Edge, fixed: set[Edge]) -> list[Edge]:
        """Flip edges, but no fixed one, until `edge` is there; returns the new edges."""
        crossing = deque(h for h in self.apex if h[0] < h[1] and self.crosses(edge, h))
        if not fixed.isdisjoint(crossing):
            raise MeshError("the edges of an outline cross each other")
        new: list[Edge] = []
        left = 4 * len(crossing) ** 2 + 16
        while crossing:
            left -= 1
            if left < 0:
                raise MeshError("an outline all but touches itself; its edges cannot be told apart")
            old = crossing.popleft()
            flipped = self.flip(old)
            if flipped is None:
                crossing.append(old)
            elif self.crosses(edge, flipped):
                crossing.append(flipped)
            else:
                new.append(flipped)
        if edge not in self.apex and edge[::-1] not in self.apex:
            raise MeshError("an outline runs through one of its own nodes")
        return new

    def make_delaunay(self, edges: Iterable[Edge], fixed: set[Edge]) -> None:
        """Lawson's flips, from the given edges outwards."""
        queue = deque(edges)
        left = 64 * len(queue) + 64
        while queue and left:
            left -= 1
            a, b = queue.popleft()
            if (a, b) in fixed or (a, b) not in self.apex or (b, a) not in self.apex:
                continue
            c, d = self.apex[a, b], self.apex[b, a]
            if self._in_circle(a, b, c, d) and self.flip((a, b)):
                queue += [(min(e), max(e)) for e in ((a, c), (c, b), (b, d), (d, a))]

    def _in_circle(self, a: int, b: int, c: int, d: int) -> bool:
        """Whether `d` lies within the circle through a triangle, by more than rounding."""
        x, y = self.points[d]
        rows = [(px - x, py - y) for px, py in (self.points[a], self.points[b], self.points[c])]
        (ax, ay), (bx, by), (cx, cy) = rows
        aa, bb, cc = ax * ax + ay * ay, bx * bx + by * by, cx * cx + cy * cy
        value = aa * (bx * cy - by * cx) - bb * (ax * cy - ay * cx) + cc * (ax * by - ay * bx)
        return value > 1e-9 * (aa + bb + cc) ** 2
