"""The medial axis of a region: its middle lines, with the distance to the border everywhere.

.. [Ogn95] R. L. Ogniewicz, O. Kübler, *Hierarchic Voronoi skeletons*, Pattern Recognition 28(3),
   1995.
"""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from shapetween.base.arrays import Floats, Index, Points

if TYPE_CHECKING:
    import shapely

__all__ = ["Chain", "MedialAxis", "medial_axis"]

#: Distance of border samples, as a share of the region's mean width. Larger and the axis of a
#: straight stroke is a saw; smaller costs time in proportion.
SPACING = 1 / 7

#: Most samples: a border that asks for more is no icon's stroke.
MOST_SAMPLES = 3000

#: Distance of the two border points nearest to an end of the axis, as a multiple of the radius
#: there. A right-angled corner's spoke has 1.41, a stroke's middle 2, and where a stroke leaves
#: another one at right angles 1.6: between them, corners have no spokes and strokes lose nothing.
APART = 1.5

#: Distance to the border, as a share of the mean width, below which a Voronoi vertex is no place of
#: the axis: beside a notch some lie within, as the samples are too few to tell its two sides.
SHALLOW = 0.15

#: Distance, as a share of the mean width, within which Voronoi vertices are one: those of a round
#: cap all fall on its centre.
SAME = 1e-3


@dataclass(frozen=True, slots=True, eq=False)
class Chain:
    """A run of the axis between two nodes.

    Attributes
    ----------
    points : (N, 2) float64
    radii : (N,) float64
        Distance of each point to the border.
    ends : (int, int)
        The nodes at its start and end; a loop of its own has the same node twice.
    """

    points: Points
    radii: Floats
    ends: tuple[int, int]

    @property
    def length(self) -> float:
        """Its length."""
        return float(np.hypot(*np.diff(self.points, axis=0).T).sum())


@dataclass(frozen=True, slots=True, eq=False)
class MedialAxis:
    """The axis as a graph.

    Attributes
    ----------
    chains : tuple of Chain
    degrees : dict
        How many chains' ends meet at each node.
    """

    chains: tuple[Chain, ...]
    degrees: dict[int, int]


def medial_axis(polygon: "shapely.Polygon") -> MedialAxis | None:
    """Middle lines of a polygon, without the spokes that run into its corners.

    Parameters
    ----------
    polygon : shapely.Polygon
        Valid, of many short sides where it is curved.

    Returns
    -------
    MedialAxis or None
        None if the border is too long for its area to be sampled.

    Notes
    -----
    The Voronoi diagram of samples of the border ([Ogn95]_): ridges inside, whose ends are cut back
    while the two samples they part lie near each other.
    """
    import shapely
    from scipy.spatial import Voronoi

    width = 2 * polygon.area / polygon.length
    if polygon.length > MOST_SAMPLES * SPACING * width:
        return None
    border = np.concatenate([_samples(ring, SPACING * width) for ring in _rings(polygon)])
    diagram = Voronoi(border)
    shapely.prepare(polygon)
    inside = shapely.contains_xy(polygon, *diagram.vertices.T)
    ridges = np.asarray(diagram.ridge_vertices)
    depths = np.full(len(inside), np.nan)
    outline = polygon.boundary

    def measure(which: Index) -> None:
        depths[which] = shapely.distance(outline, shapely.points(diagram.vertices[which]))

    measure(np.flatnonzero(inside))
    inside &= np.nan_to_num(depths) > SHALLOW * width
    kept = (ridges >= 0).all(axis=1) & inside[ridges].all(axis=1)
    parted = border[np.asarray(diagram.ridge_points)[kept]]
    index = _merged(diagram.vertices, SAME * width)
    edges = index[ridges[kept]]
    ends = np.unique(edges)
    measure(ends[np.isnan(depths[ends])])
    points, radii = diagram.vertices, depths
    apart = np.hypot(*(parted[:, 1] - parted[:, 0]).T)
    loop = edges[:, 0] == edges[:, 1]
    edges, apart = edges[~loop], apart[~loop]
    within = np.maximum(radii[edges[:, 0]], radii[edges[:, 1]])
    edges = _cut_back(edges, apart < APART * within)
    return _chained(edges, points, radii)


def _rings(polygon: "shapely.Polygon") -> list[Points]:
    import shapely

    rings = [polygon.exterior, *polygon.interiors]
    return [shapely.get_coordinates(ring) for ring in rings]


def _samples(ring: Points, spacing: float) -> Points:
    """Even points along a closed ring whose last point is its first, corners among them."""
    steps = np.hypot(*np.diff(ring, axis=0).T)
    counts = np.maximum(np.ceil(steps / spacing - 1e-6), 1).astype(int)
    start = np.repeat(np.arange(len(steps)), counts)
    part = (np.arange(len(start)) - np.repeat(np.cumsum(counts) - counts, counts)) / counts[start]
    return np.asarray(ring[start] + part[:, None] * (ring[start + 1] - ring[start]))


def _merged(points: Points, size: float) -> Index:
    """Which point each of some became where those closer than a size are one, the first."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components
    from scipy.spatial import cKDTree

    pairs = cKDTree(points).query_pairs(size, output_type="ndarray")
    links = coo_array((np.ones(len(pairs)), pairs.T), shape=(len(points),) * 2)
    count, label = connected_components(links, directed=False)
    first = np.full(count, len(points))
    np.minimum.at(first, label, np.arange(len(points)))
    return np.asarray(first[label], dtype=np.intp)


def _cut_back(edges: Index, loose: Floats) -> Index:
    """Edges without the loose ones at the ends, again and again."""
    at: dict[int, set[int]] = {}
    seen: set[tuple[int, int]] = set()
    kept: dict[int, tuple[int, int]] = {}
    for k, (a, b) in enumerate(edges.tolist()):
        pair = (min(a, b), max(a, b))
        if pair in seen:
            continue
        seen.add(pair)
        kept[k] = (a, b)
        at.setdefault(a, set()).add(k)
        at.setdefault(b, set()).add(k)
    ends = [node for node, found in at.items() if len(found) == 1]
    while ends:
        node = ends.pop()
        if len(at[node]) != 1:
            continue
        k = next(iter(at[node]))
        if not loose[k]:
            continue
        a, b = kept.pop(k)
        other = b if a == node else a
        at[node].discard(k)
        at[other].discard(k)
        if len(at[other]) == 1:
            ends.append(other)
    return np.array([kept[k] for k in sorted(kept)], dtype=np.intp).reshape(-1, 2)


def _chained(edges: Index, vertices: Points, radii: Floats) -> MedialAxis:
    """Runs of edges between nodes where other than two meet; rings start anywhere."""
    at: dict[int, list[int]] = {}
    for k, (a, b) in enumerate(edges.tolist()):
        at.setdefault(a, []).append(k)
        at.setdefault(b, []).append(k)
    used = np.zeros(len(edges), dtype=bool)
    chains: list[Chain] = []

    def follow(node: int, k: int) -> None:
        nodes = [node]
        while True:
            used[k] = True
            a, b = edges[k].tolist()
            node = b if a == node else a
            nodes.append(node)
            onward = [e for e in at[node] if not used[e]]
            if len(at[node]) != 2 or not onward:
                break
            k = onward[0]
        chains.append(Chain(vertices[nodes], radii[nodes], (nodes[0], nodes[-1])))

    for node in sorted(at):
        if len(at[node]) != 2:
            for k in at[node]:
                if not used[k]:
                    follow(node, k)
    for k in range(len(edges)):
        if not used[k]:
            follow(int(edges[k, 0]), k)
    degrees = {node: len(found) for node, found in at.items() if len(found) != 2}
    return MedialAxis(tuple(chains), degrees)
