"""Two matched contours: chords across them, and arcs of them cut off by a chord.

Both contours have area 1 here, so lengths and areas are shares of a shape's size.
"""

from dataclasses import dataclass

import numpy as np

from shapetween.base.arrays import Floats, Index, Mask, Points
from shapetween.geometry.polygon import cross

__all__ = ["Contours", "arc_waste", "left_out", "outside_lengths", "rounded"]

#: Step to which numbers that decide something are rounded. Larger, and it shows in the mesh;
#: smaller, and symmetric shapes get another mesh when they are turned.
STEP = 2.0**-30

#: Step to which the mean squared distance of an arc from its chord is rounded before its root is
#: taken: sums over a straight arc leave 1e-14 of nothing, whose root would show. Larger, and
#: shallow bends count as straight; smaller, and what straight sides cost is noise.
SQUARED_STEP = 2.0**-40

#: Twice the area by which a corner of samples may turn and still count as straight. Larger, and
#: chords pass outside at shallow bends; smaller, and rounding says on which side of a straight
#: outline a chord between two of its samples runs.
STRAIGHT = 2.0**-33

#: Samples, about, that chords are tested against. More take longer; with fewer, thin slits close.
SIGHT = 256

#: Sine of the angle by which a chord may set out to the outside of a contour and still be looked
#: at. Larger only costs time; smaller, and ripples of the outline hide useful chords.
LEANING = 0.6

#: Chords tested at once against all samples. More fall out of the processor's caches and take half
#: as long again; with fewer, calls take longer than the work they do.
AT_ONCE = 256


@dataclass(frozen=True, slots=True, eq=False)
class Contours:
    """Matched samples of two closed contours and sums over them that make arcs cheap to measure.

    Attributes
    ----------
    points : (2, N, 2) float64
        Samples, running clockwise as drawn.
    coordinates : (2, 2, N) float64
        Their x, and then their y.
    moments : (6, 2, 2 * N + 1) float64
        Running sums along the contour, gone round twice: length; and the integrals over length of
        x, y, x^2, xy, y^2.
    """

    points: Points
    coordinates: Floats
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
        sums = np.zeros((len(each), 2, length.shape[1] + 1))
        np.cumsum([length * term for term in each], axis=-1, out=sums[..., 1:])
        return cls(points, np.ascontiguousarray(np.moveaxis(points, -1, 0)), sums)

    def __len__(self) -> int:
        """Number of samples."""
        return int(self.points.shape[1])


def rounded(values: Floats, step: float = STEP) -> Floats:
    """Round to a fixed step, so that what is equal but for rounding is equal.

    Between equals the first is taken then, whatever the unit and turn of the shapes. Sums of such
    numbers are exact.
    """
    return np.asarray(np.round(values / step) * step)


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
    after = contours.moments.take(np.where(last < first, last + count, last), axis=-1)
    length, sx, sy, sxx, sxy, syy = after - contours.moments.take(first, axis=-1)
    start = contours.coordinates.take(first, axis=-1)
    along = contours.coordinates.take(last, axis=-1) - start
    (x, y), (dx, dy) = start, along
    size = np.sqrt(dx * dx + dy * dy)
    size[size == 0] = 1.0
    nx, ny = -dy / size, dx / size  # unit normal of the chord
    offset = nx * x + ny * y
    squared = (
        nx * nx * sxx
        + 2 * nx * ny * sxy
        + ny * ny * syy
        - 2 * offset * (nx * sx + ny * sy)
        + offset * offset * length
    )
    return np.asarray(np.sqrt(np.maximum(rounded(squared * length, SQUARED_STEP), 0)))


def left_out(contours: Contours, nodes: Index) -> Floats:
    """Area between each contour and the polygon of the nodes, (2,).

    Parameters
    ----------
    contours : Contours
    nodes : (n,) intp
        Increasing.
    """
    count = len(contours)
    side = np.searchsorted(nodes, np.arange(count), side="right") - 1
    first, last = nodes[side], np.roll(nodes, -1)[side]
    start = contours.points[:, first]
    chord = contours.points[:, last] - start
    size = np.sqrt((chord**2).sum(-1))
    unit = chord / np.where(size > 0, size, 1.0)[..., None]
    here = contours.points - start
    there = np.roll(contours.points, -1, axis=1) - start
    along = ((there - here) * unit).sum(-1)
    a, b = cross(unit, here), cross(unit, there)
    # Mean of the distance to the chord over a segment that may cross it.
    total = abs(a) + abs(b)
    crossing = (a * a + b * b) / (2 * np.where(total > 0, total, 1.0))
    distance = np.where(a * b < 0, crossing, total / 2)
    return np.asarray((abs(along) * distance).sum(axis=-1))


def outside_lengths(points: Points, nodes: Index, most: float) -> Floats:
    """Length of every chord between nodes that runs outside each contour.

    Parameters
    ----------
    points : (2, N, 2) float64
        Contours, clockwise as drawn.
    nodes : (n,) intp
    most : float
        Chords that have as much outside the first contour are not measured in the second.

    Returns
    -------
    (2, n, n) float64
        For pairs ``i < j``: 0 for a chord that stays inside, infinite for one that is not measured
        or that starts or ends plainly outwards in either contour; infinite for all other pairs.

    Notes
    -----
    Of many samples every second or third is enough, and left out of it are the others.
    """
    stride = max(1, points.shape[1] // SIGHT)
    kept = np.union1d(np.arange(0, points.shape[1], stride), nodes)
    points, nodes = points[:, kept], np.searchsorted(kept, nodes)
    count = len(nodes)
    leaning = [_inward(ring, nodes, LEANING) for ring in points]
    i, j = np.nonzero(np.triu(leaning[0] & leaning[0].T & leaning[1] & leaning[1].T, 1))
    lengths = np.full((2, count, count), np.inf)
    for shape, ring in enumerate(points):
        outside = _outside(ring, nodes, i, j)
        lengths[shape, i, j] = outside
        i, j = i[outside < most], j[outside < most]
    return lengths


def _inward(ring: Points, nodes: Index, leaning: float) -> Mask:
    """Which chords leave their first node into the polygon, (n, n).

    They may lean outwards over a side by an angle of this sine.
    """
    here = ring[nodes]
    x, y = (here[:, axis] - here[:, axis, None] for axis in (0, 1))  # towards each, (n, n)
    on = ring[(nodes + 1) % len(ring)] - here
    back = ring[nodes - 1] - here
    left = on[:, :1] * y - on[:, 1:] * x
    right = x * back[:, 1:] - y * back[:, :1]
    if leaning:
        size = np.sqrt(x * x + y * y)
        left += leaning * np.hypot(on[:, :1], on[:, 1:]) * size
        right += leaning * np.hypot(back[:, :1], back[:, 1:]) * size
    convex = cross(on, back)[:, None] >= -STRAIGHT
    both, either = np.minimum(left, right), np.maximum(left, right)
    return np.asarray(np.where(convex, both, either) >= -STRAIGHT)


def _outside(ring: Points, nodes: Index, i: Index, j: Index) -> Floats:
    """Length of chords between nodes i and j, both (K,), outside a polygon.

    What lies on a chord's line counts as being on its one side, so that a chord along a straight
    arc of the outline runs inside.
    """
    count, ends = len(ring), ring[nodes]
    x, y = ends[:, :1], ends[:, 1:]

    # Which side of each chord's line the samples are on, and of each segment's line the nodes.
    product = x * ring[:, 1] - y * ring[:, 0]
    least = -product[i, nodes[j]] - STRAIGHT
    step = np.roll(ring, -1, axis=0) - ring
    from_segment = step[:, 0] * (y - ring[:, 1]) - step[:, 1] * (x - ring[:, 0])
    before = from_segment >= -STRAIGHT
    found = []
    for first in range(0, max(len(i), 1), AT_ONCE):
        some = slice(first, first + AT_ONCE)
        off = product.take(j[some], axis=0)
        off -= product.take(i[some], axis=0)
        beyond = off >= least[some, None]
        hit = before.take(i[some], axis=0)
        hit ^= before.take(j[some], axis=0)
        hit[:, :-1] &= beyond[:, 1:] ^ beyond[:, :-1]
        hit[:, -1] &= beyond[:, 0] ^ beyond[:, -1]
        found.append(np.flatnonzero(hit) + first * count)  # quicker than along two axes
    chord, segment = np.divmod(np.concatenate(found), count)
    following = (segment + 1) % count
    touching = np.zeros(len(chord), dtype=bool)  # at a chord's own ends, where it does no more
    for node in (nodes[i[chord]], nodes[j[chord]]):
        touching |= (segment == node) | (following == node)
    chord, segment = chord[~touching], segment[~touching]
    reached = from_segment[i[chord], segment]
    t = reached / (reached - from_segment[j[chord], segment])
    order = np.lexsort((t, chord))
    chord, t = chord[order], t[order]

    hits = np.bincount(chord, minlength=len(i))
    nth = np.arange(len(chord)) - (np.cumsum(hits) - hits)[chord]
    # From inside, the outer arcs are t1..t2, t3..t4, ..., the last one up to the end.
    outer = np.bincount(chord, np.where(nth % 2 == 0, -t, t), minlength=len(i)) + hits % 2
    share = np.where(_inward(ring, nodes, 0.0)[i, j], outer, 1 - outer)
    return np.asarray(share * np.sqrt(((ends[j] - ends[i]) ** 2).sum(-1)))
