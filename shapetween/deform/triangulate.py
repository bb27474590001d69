"""Triangulations of points in the plane that contain given edges.

Delaunay first, then edges are flipped until every given one is there [Slo93]_. Triangles hold
indices into the points and run clockwise as drawn, so that their signed area is positive.

.. [Slo93] S. W. Sloan, *A fast algorithm for generating constrained Delaunay triangulations*,
   Computers & Structures 47(3), 1993.
"""

from collections import deque
from collections.abc import Iterable, Iterator, Sequence

import numpy as np

from shapetween.base.arrays import Index, Mask, Points
from shapetween.base.errors import MeshError
from shapetween.geometry.linearmaps import as_complex
from shapetween.geometry.polygon import polygon_area

__all__ = ["constrained_delaunay", "split_edges", "triangle_edges"]

Edge = tuple[int, int]

#: Twice the area, over the square of the extent, below which three points lie on a line. Smaller
#: is rounding error; larger refuses thin but valid outlines.
ROUNDING = 1e-13


#: Steps of the grid, across the points' extent, that points are put on to be triangulated: four
#: points on a circle are then triangulated the same way in any unit, whatever rounding does to
#: them. More and rounding shows again; fewer and points that lie close become one.
GRID = 2.0**40


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
    triangles = _delaunay(points)
    halves = _Halves(points, triangles)
    flat = triangles[polygon_area(points[triangles]) <= halves.least]
    halves.make_delaunay(map(_undirected, triangle_edges(flat)[0].tolist()), set())
    wanted = [(int(i), int(j)) for i, j in edges]
    fixed = {_undirected(edge) for edge in wanted}
    for edge in wanted:
        if edge not in halves.apex and edge[::-1] not in halves.apex:
            halves.make_delaunay(halves.insert(edge, fixed), fixed)
    return halves.triangles()


def _delaunay(points: Points) -> Index:
    """Delaunay triangles of points in the plane, (T, 3); of points in line, some without area."""
    import shapely

    low = points.min(axis=0)
    extent = float((points.max(axis=0) - low).max())
    points = np.round((points - low) * (GRID / (extent or 1.0)))
    try:
        found = shapely.get_coordinates(shapely.delaunay_triangles(shapely.multipoints(points)))
    except shapely.errors.GEOSException:  # it loses its way among some points nearly on circles
        return _delaunay_by_hull(points)
    if not len(found):
        raise MeshError("the points to triangulate lie on a line")
    known = as_complex(points)
    order = np.argsort(known)
    corners = order[np.searchsorted(known[order], as_complex(found))]
    triangles = corners.reshape(-1, 4)[:, :3]  # a ring's last point is its first
    # All run the same way round, those without an area too.
    return triangles if polygon_area(points[triangles]).sum() > 0 else triangles[:, ::-1]


def _delaunay_by_hull(points: Points) -> Index:
    """The same by a convex hull one dimension up: slower, and never lost."""
    from scipy.spatial import Delaunay

    triangles = Delaunay(points).simplices.astype(np.intp)
    turned = polygon_area(points[triangles]) < 0
    triangles[turned] = triangles[turned][:, ::-1]
    return triangles


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
    low, high = np.sort(np.stack([triangles, np.roll(triangles, -1, axis=1)]), axis=0)
    count = int(triangles.max(initial=-1)) + 1
    codes = (low * count + high).ravel()
    order = np.argsort(codes, kind="stable")
    codes = codes[order]
    first = np.append(True, codes[1:] != codes[:-1])[: len(codes)]
    edges = np.stack(np.divmod(codes[first], max(count, 1)), axis=1)
    sides = np.full((len(edges), 2), -1, dtype=np.intp)
    sides[:, 0] = order[first] // 3
    sides[(np.cumsum(first) - 1)[~first], 1] = order[~first] // 3
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
    ends = np.sort(np.stack([triangles, np.roll(triangles, -1, axis=1)], axis=-1), axis=-1)
    codes, wanted = (e @ [first, 1] for e in (edges[marked], ends))
    place = np.searchsorted(codes, wanted)
    split = np.append(codes, -1)[place] == wanted  # (T, 3): which sides have a new vertex
    number = split.sum(axis=1)
    # Turned so that split sides come first: one alone, and two in a row.
    lead = np.where(number == 2, (~split).argmax(axis=1) + 1, split.argmax(axis=1))
    turn = (lead[:, None] + np.arange(3)) % 3
    a, b, c = np.take_along_axis(triangles, turn, axis=1).T
    ab, bc, ca = first + np.take_along_axis(place, turn, axis=1).T
    pieces = np.full((len(triangles), 4, 3), -1, dtype=np.intp)
    for count, parts in enumerate(
        (
            [(a, b, c)],
            [(a, ab, c), (ab, b, c)],
            [(a, ab, c), (ab, bc, c), (ab, b, bc)],
            [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)],
        )
    ):
        some = number == count
        pieces[some, : len(parts)] = np.moveaxis(np.array(parts), 2, 0)[some]
    parent = np.repeat(np.arange(len(triangles)), number + 1)
    return pieces[pieces[:, :, 0] >= 0], parent


def _undirected(edge: Sequence[int]) -> Edge:
    """The smaller end first."""
    return min(edge), max(edge)


class _Halves:
    """Triangles, clockwise as drawn, as directed edges, each with the corner opposite."""

    def __init__(self, points: Points, triangles: Index) -> None:
        self.points: list[list[float]] = points.tolist()
        self.least = ROUNDING * float(np.abs(points).max()) ** 2
        self.apex: dict[Edge, int] = {}
        self.spoke: dict[int, int] = {}  # of each point, one that an edge leads to
        for a, b, c in triangles.tolist():
            self._add(a, b, c)

    def _add(self, a: int, b: int, c: int) -> None:
        self.apex[a, b], self.apex[b, c], self.apex[c, a] = c, a, b
        self.spoke[a], self.spoke[b], self.spoke[c] = b, c, a

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

    def crossed(self, edge: Edge) -> list[Edge]:
        """Edges that cross one that is not there, in order along it."""
        a, b = edge
        facing = [side for side in self._around(a) if self._opens(edge, side)]
        found = []
        while facing:
            p, q = facing[0]
            found.append(_undirected((p, q)))
            apex = self.apex[q, p]
            if apex == b:
                return found
            facing = [side for side in ((p, apex), (apex, q)) if self._opens(edge, side)]
        raise MeshError("an outline runs through one of its own nodes")

    def _opens(self, edge: Edge, side: Edge) -> bool:
        """Whether an edge leaves through a side that has its start to the left."""
        (a, b), (p, q) = edge, side
        return self.turn(a, b, p) < -self.least and self.turn(a, b, q) > self.least

    def _around(self, a: int) -> Iterator[Edge]:
        """Sides opposite to a point, in the triangles about it."""
        for turn in (0, 1):  # one way round, and from a border the other
            first = other = self.spoke[a]
            while True:
                half = (a, other) if turn == 0 else (other, a)
                apex = self.apex.get(half)
                if apex is None:
                    break
                yield (other, apex) if turn == 0 else (apex, other)
                other = apex
                if other == first:
                    return

    def flip(self, edge: Edge) -> Edge | None:
        """Replace an edge by the other diagonal of its quad, or None if that is not convex."""
        (a, b), c = edge, self.apex[edge]
        d = self.apex[b, a]
        if self.turn(c, a, d) <= self.least or self.turn(d, b, c) <= self.least:
            return None
        del self.apex[a, b], self.apex[b, a]
        self._add(a, d, c)
        self._add(d, b, c)
        return _undirected((c, d))

    def insert(self, edge: Edge, fixed: set[Edge]) -> list[Edge]:
        """Flip edges, but no fixed one, until `edge` is there; returns the new edges."""
        crossing = deque(self.crossed(edge))
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
                queue += map(_undirected, ((a, c), (c, b), (b, d), (d, a)))

    def _in_circle(self, a: int, b: int, c: int, d: int) -> bool:
        """Whether `d` lies within the circle through a triangle, by more than rounding."""
        x, y = self.points[d]
        rows = [(px - x, py - y) for px, py in (self.points[a], self.points[b], self.points[c])]
        (ax, ay), (bx, by), (cx, cy) = rows
        aa, bb, cc = ax * ax + ay * ay, bx * bx + by * by, cx * cx + cy * cy
        value = aa * (bx * cy - by * cx) - bb * (ax * cy - ay * cx) + cc * (ax * by - ay * bx)
        return value > 1e-9 * (aa + bb + cc) ** 2
