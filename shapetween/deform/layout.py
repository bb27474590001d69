"""Triangles around a set of outlines, out to a round frame.

Nodes of the outlines come first, then the corners of the frame, then free vertices on hexagonal
grids that coarsen away from the outlines. No edge but those of the outlines and the frame joins
two fixed vertices, or the triangles could not follow where these go.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from shapetween.base.arrays import Floats, Index, Mask, Points, row_lengths
from shapetween.deform.triangulate import constrained_delaunay, split_edges, triangle_edges
from shapetween.geometry.linearmaps import as_complex, squared
from shapetween.geometry.rotation import rotations

__all__ = ["FRAME_CORNERS", "Layout", "ring_edges"]

#: Corners of the frame. Fewer, and it cuts into the plane near the shapes.
FRAME_CORNERS = 16
#: Ratio of the spacings of successive grids. Larger saves triangles and makes thin ones.
GRID_GROWTH = 1.8
#: Distances to the outlines, in spacings, between which a grid is used.
GRID_BAND = (0.75, 2.2)
#: Least distance between vertices of different grids, in spacings; and half that to the frame.
GRID_THINNING = 0.8


@dataclass(frozen=True, slots=True, eq=False)
class Layout:
    """A triangulation of the plane around outlines.

    Attributes
    ----------
    points : (V, 2) float64
    triangles : (T, 3) intp
        All of positive area.
    inside : (T,) bool
        Triangles inside the outlines.
    fixed : int
        Vertices of the outlines and the frame, which come first.
    """

    points: Points
    triangles: Index
    inside: Mask
    fixed: int

    @classmethod
    def around(cls, nodes: Points, rings: Sequence[Index], radius: float) -> "Layout":
        """Triangulate a disc of a radius about the origin that holds all nodes (N, 2).

        Raises
        ------
        MeshError
            If the rings cross.
        """
        edges = ring_edges(rings)
        starts, ends = nodes[edges[:, 0]], nodes[edges[:, 1]]
        lengths = np.linalg.norm(ends - starts, axis=1)
        # The longest edge gives the direction, so that a turned drawing gets a turned mesh.
        axis = (ends - starts)[np.argmax(lengths > (1 - 1e-9) * lengths.max())]
        turn = rotations(np.arctan2(axis[1], axis[0]))
        angles = 2 * np.pi * np.arange(FRAME_CORNERS) / FRAME_CORNERS
        frame = radius * np.stack([np.cos(angles), np.sin(angles)], axis=1) @ turn.T
        grid = _grids(starts, ends, radius * np.cos(np.pi / FRAME_CORNERS), lengths.mean(), turn)
        points = np.concatenate([nodes, frame, grid])
        triangles = constrained_delaunay(points, edges)
        fixed = len(nodes) + FRAME_CORNERS
        inside = _inside(points[triangles].mean(axis=1), starts, ends)
        whole = cls(points, triangles, inside, fixed)
        chords, sides = triangle_edges(triangles)
        ring = np.isin(_keys(chords), _keys(np.sort(edges, axis=1)))
        return whole._split(chords, (chords < fixed).all(axis=1) & ~ring & (sides[:, 1] >= 0))

    def refined(self, bad: Mask, rings: int) -> "Layout":
        """Split every edge near triangles (T,), up to `rings` neighbours away, but no fixed one."""
        for _ in range(rings):
            near = np.zeros(len(self.points), dtype=bool)
            near[self.triangles[bad]] = True
            bad = np.asarray(near[self.triangles].any(axis=1))
        edges, sides = triangle_edges(self.triangles)
        free = (edges >= self.fixed).any(axis=1)
        return self._split(edges, np.asarray(bad[sides].any(axis=1) & free))

    def _split(self, edges: Index, marked: Mask) -> "Layout":
        triangles, parent = split_edges(self.triangles, edges, marked, len(self.points))
        points = np.concatenate([self.points, self.points[edges[marked]].mean(axis=1)])
        return Layout(points, triangles, self.inside[parent], self.fixed)


def ring_edges(rings: Sequence[Index]) -> Index:
    """Edges between successive nodes of closed rings, (N, 2)."""
    return np.concatenate([np.stack([ring, np.roll(ring, -1)], axis=1) for ring in rings])


def _keys(edges: Index) -> Index:
    """One number for each edge, the smaller index first."""
    return np.asarray(edges[:, 0] * np.iinfo(np.int32).max + edges[:, 1])


def _grids(starts: Points, ends: Points, radius: float, spacing: float, turn: Floats) -> Points:
    """Vertices of hexagonal grids about segments, finest next to them, within a radius."""
    kept = np.zeros((0, 2))
    while spacing < radius:
        count = int(np.ceil(radius / spacing)) + 1
        i, j = np.meshgrid(*[np.arange(-2 * count, 2 * count + 1)] * 2)
        grid = spacing * np.stack([i + j / 2, j * np.sqrt(0.75)], axis=-1).reshape(-1, 2)
        grid = grid[row_lengths(grid) < radius - GRID_THINNING * spacing / 2] @ turn.T
        away = _distances(grid, starts, ends) / spacing
        grid = grid[(away > GRID_BAND[0]) & (away < GRID_BAND[1])]
        apart = squared(as_complex(grid)[:, None] - as_complex(kept)).min(axis=1, initial=np.inf)
        kept = np.concatenate([kept, grid[apart > (GRID_THINNING * spacing) ** 2]])
        spacing *= GRID_GROWTH
    return kept


def _distances(points: Points, starts: Points, ends: Points) -> Floats:
    """Distance of each point to the nearest of some segments."""
    start = as_complex(starts)
    along = as_complex(ends) - start
    offset = as_complex(points)[:, None] - start
    share = np.clip((offset * (along.conj() / squared(along))).real, 0, 1)
    return np.asarray(np.sqrt(squared(offset - share * along).min(axis=1, initial=np.inf)))


def _inside(points: Points, starts: Points, ends: Points) -> Mask:
    """Which points lie inside closed outlines, by the parity of a ray's crossings."""
    height = points[:, None, 1]
    spans = (starts[:, 1] > height) != (ends[:, 1] > height)
    rise = ends[:, 1] - starts[:, 1]
    share = (height - starts[:, 1]) / np.where(rise == 0, 1, rise)
    crossing = starts[:, 0] + share * (ends[:, 0] - starts[:, 0])
    return np.asarray((spans & (points[:, None, 0] < crossing)).sum(axis=1) % 2 == 1)
