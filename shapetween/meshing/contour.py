"""Two matched contours: chords across them, and stretches of them cut off by a chord.

Both contours have area 1 here, so lengths and areas are shares of a shape's size.
"""

from dataclasses import dataclass

import numpy as np

from shapetween.arrays import Floats, Index, Points
from shapetween.geometry.polygon import cross

__all__ = ["Contours", "arc_waste", "outside_lengths"]


@dataclass(frozen=True, slots=True, eq=False)
class Contours:
    """Matched samples of two closed contours and sums over them that make arcs cheap to measure.

    Attributes
    ----------
    points : (2, N, 2) float64
        Samples, running clockwise as drawn.
    moments : (2, 2 * N + 1, 7) float64
        Running sums along the contour, gone round twice: length; and the integrals over length of
        x, y, x^2, xy, y^2; and twice the signed area swept from the origin.
    """

    points: Points
    moments: Floats

    @classmethod
    def of(cls, points: Points) -> "Contours":
        """Prepare contours of area 1, (2, N, 2)."""
        start = np.concatenate([points, points], axis=1)
        step = np.roll(start, -1, axis=1) - start
        length = np.sqrt((step**2).sum(-1))
        end = start + step
        (x0, y0), (x1, y1) = np.moveaxis(start, -1, 0), np.moveaxis(end, -1, 0)
        each = [
            np.ones_like(length),
            (x0 + x1) / 2,
            (y0 + y1) / 2,
            (x0 * x0 + x0 * x1 + x1 * x1) / 3,
            (2 * x0 * y0 + x0 * y1 + x1 * y0 + 2 * x1 * y1) / 6,
            (y0 * y0 + y0 * y1 + y1 * y1) / 3,
        ]
        terms = np.stack([length * term for term in each] + [cross(start, end)], axis=-1)
        sums = np.concatenate([np.zeros_like(terms[:, :1]), np.cumsum(terms, axis=1)], axis=1)
        return cls(points, sums)

    def __len__(self) -> int:
        """Number of samples."""
        return int(self.points.shape[1])


def arc_waste(contours: Contours, first: Index, last: Index) -> Floats:
    """How much of each shape is lost where the arc between two samples is taken for its chord.

    Parameters
    ----------
    contours : Contours
    first, last : (...,) intp
        Samples 0 to N - 1; the arc runs onwards from `first`, round past the start if it must.

    Returns
    -------
    (2, ...) float64
        Arc length times the root mean square distance to the chord's line: at least the area
        between them, and more for a limb, whose two sides lie close together.
    """
    count = len(contours)
    last = np.where(last < first, last + count, last)
    length, sx, sy, sxx, sxy, syy, _ = np.moveaxis(
        contours.moments[:, last] - contours.moments[:, first], -1, 0
    )
    start = contours.points[:, first]
    along = contours.points[:, last % count] - start
    size = np.sqrt((along**2).sum(-1))
    nx, ny = np.moveaxis(along / np.where(size > 0, size, 1.0)[..., None], -1, 0)
    nx, ny = -ny, nx  # unit normal of the chord
    offset = nx * start[..., 0] + ny * start[..., 1]
    squared = (
        nx * nx * sxx
        + 2 * nx * ny * sxy
        + ny * ny * syy
        - 2 * offset * (nx * sx + ny * sy)
        + offset * offset * length
    )
    return np.asarray(np.sqrt(np.maximum(squared, 0) * length))


def outside_lengths(ring: Points, nodes: Index) -> Floats:
    """Length of every chord between nodes that runs outside the polygon.

    Parameters
    ----------
    ring : (N, 2) float64
        Polygon, clockwise as drawn.
    nodes : (n,) intp
        Corners of it.

    Returns
    -------
    (n, n) float64
        Symmetric, 0 for a chord that stays inside.
    """
    count = len(ring)
    i, j = np.triu_indices(len(nodes), 1)
    ends = ring[nodes]
    following = np.roll(ring, -1, axis=0)

    # Side of every sample from every chord's line, and of every node from every segment's line.
    node_by_sample = ends[:, None, 0] * ring[None, :, 1] - ends[:, None, 1] * ring[None, :, 0]
    across = node_by_sample[j] - node_by_sample[i] + node_by_sample[i, nodes[j]][:, None]
    beyond = across >= 0
    step = following - ring
    node_side = cross(step[None], ends[:, None] - ring[None])  # (n, N)
    before = node_side >= 0

    hit = beyond != np.roll(beyond, -1, axis=1)
    hit &= before[i] != before[j]
    own = np.arange(len(i))
    for node in (nodes[i], nodes[j]):  # the segments at a chord's own ends touch it, no more
        hit[own, node] = False
        hit[own, node - 1] = False
    chord, segment = np.nonzero(hit)
    reached = node_side[i[chord], segment]
    t = reached / (reached - node_side[j[chord], segment])
    order = np.lexsort((t, chord))
    chord, t = chord[order], t[order]

    hits = np.bincount(chord, minlength=len(i))
    nth = np.arange(len(chord)) - (np.cumsum(hits) - hits)[chord]
    # From inside, the outer stretches are t1..t2, t3..t4, ..., the last one up to the end.
    outer = np.bincount(chord, np.where(nth % 2 == 0, -t, t), minlength=len(i)) + hits % 2
    start = ends[i]
    towards = ends[j] - start
    leaving = following[nodes[i]] - start
    reaching = start - ring[(nodes[i] - 1) % count]
    left = cross(leaving, towards) >= 0
    right = cross(towards, -reaching) >= 0
    inward = np.where(cross(reaching, leaving) >= 0, left & right, left | right)
    share = np.where(inward, outer, 1 - outer)
    lengths = np.zeros((len(nodes), len(nodes)))
    lengths[i, j] = share * np.sqrt((towards**2).sum(-1))
    return lengths + lengths.T
