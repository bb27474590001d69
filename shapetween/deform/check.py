"""Whether outlines in motion stay simple."""

from collections.abc import Sequence

import numpy as np
import shapely

from shapetween.base.arrays import Curves, Floats, Index, Mask, Points
from shapetween.geometry.bezier import flatten
from shapetween.geometry.polygon import polygon_area

__all__ = ["LOOKED", "crossing_frames", "simple_frames"]

#: Times at which rings that are only attached are checked. More are dear where there are hundreds.
LOOKED = np.linspace(0, 1, 11)[1:-1]

#: Chords of a curve of such a ring.
CHORDS = 4


#: Distance, as a share of the extent, by which strands cross that do; and the area, as a share of
#: that of the extent, where corners lie on other strands. None, and where strands touch rounding
#: says, and so the processor, whether they cross; much more, and what is seen to cross does not.
DEPTH, LEAST_AREA = 1e-6, 1e-8

#: Of how many frames that are not known to cross one is looked at, round after round, and how many
#: pairs of strands that cross there others are asked of. They say the same whatever these are;
#: other ones cost more time, and more pairs memory.
STRIDES, MOST_PAIRS = (32, 8, 2, 1), 400


def simple_frames(points: Points, rings: tuple[int, ...] | None = None) -> Mask:
    """Which frames show closed polylines that cross neither themselves nor each other.

    Those that only touch, or cross by less than can be seen, do not cross.

    Parameters
    ----------
    points : (F, M, 2) float64
        Points of all rings, one ring after the other.
    rings : tuple of int, optional
        Number of points of each ring; by default all are of one.

    Returns
    -------
    (F,) bool
    """
    frames, count, _ = points.shape
    sizes = rings or (count,)
    owner = np.repeat(np.arange(frames * len(sizes)), np.tile(sizes, frames))
    loops = shapely.linearrings(points.reshape(-1, 2), indices=owner)
    if len(sizes) > 1:
        groups = np.repeat(np.arange(frames), len(sizes))
        simple = np.asarray(shapely.is_simple(shapely.multilinestrings(loops, indices=groups)))
    else:
        simple = np.asarray(shapely.is_simple(loops))
    doubtful = np.flatnonzero(~simple)
    if len(doubtful):
        simple[doubtful] = ~_crossing(points[doubtful], sizes)
    return simple


def _crossing(points: Points, sizes: tuple[int, ...]) -> Mask:
    """In which frames (F, M, 2) rings of so many points cross, and do not only touch."""
    x, y = (np.ascontiguousarray(points[..., k]) for k in (0, 1))
    low = np.array([x.min(), y.min()])
    extent = max(float(x.max() - low[0]), float(y.max() - low[1])) or 1.0
    frames, count, _ = points.shape
    first = np.cumsum([0, *sizes])[:-1]
    following = np.arange(1, count + 1)
    following[first + np.array(sizes) - 1] = first
    start = np.stack([(x - low[0]) / extent, (y - low[1]) / extent])
    edges = np.stack([start, start[..., following]], axis=1)
    found = np.zeros(frames, dtype=bool)
    for stride in STRIDES:
        looked = np.flatnonzero(~found)[::stride]
        frame, one, other = _near(edges[:, :, looked], following)
        frame = looked[frame]
        through = _through(edges[:, :, frame, one], edges[:, :, frame, other])
        found[frame[through]] = True
        if stride > 1:
            # What crosses in one frame mostly does so in those about it.
            pairs = np.unique(np.stack([one[through], other[through]]), axis=1)[:, :MOST_PAIRS]
            rest = np.flatnonzero(~found)
            strands = (edges[:, :, rest[:, None], side] for side in pairs)
            found[rest] = _through(*strands).any(axis=1)
    # What crosses just where a corner is does so by no edge alone.
    for k in np.flatnonzero(~found).tolist():
        found[k] = _overlapping(np.split(start[:, k].T, first[1:]))
    return found


def _near(edges: Floats, following: Index) -> tuple[Index, Index, Index]:
    """Frames of edges (2, 2, F, M), and two whose boxes meet there and that are no neighbours."""
    frames, count = edges.shape[2:]
    # Side by side, so that one tree finds the pairs of each frame.
    beside = np.stack([edges[0] + 2.0 * np.arange(frames)[:, None], edges[1]])
    segments = shapely.linestrings(beside.reshape(2, 2, -1).T)
    i, j = shapely.STRtree(segments).query(segments)
    frame, one, other = i // count, i % count, j % count
    kept = (one < other) & (following[one] != other) & (following[other] != one)
    return frame[kept], one[kept], other[kept]


def _through(one: Floats, other: Floats) -> Mask:
    """Which segments cross others, and do not only touch them, (...,).

    Both as x and y of their starts and ends, (2, 2, ...).
    """
    found = np.ones(one.shape[2:], dtype=bool)
    for segments, lines in ((one, other), (other, one)):
        first, second = _from_line(segments, lines)
        found &= np.maximum(first, second) > DEPTH
        found &= np.minimum(first, second) < -DEPTH
    return found


def _from_line(segments: Floats, lines: Floats) -> tuple[Floats, Floats]:
    """Signed distances of the ends of segments from lines through others' ends, (...,) each."""
    (x, right), (y, down) = lines
    way_x, way_y = right - x, down - y
    length = np.hypot(way_x, way_y)
    length = np.where(length > 0, length, np.inf)
    first, second = (
        (way_x * (segments[1, end] - y) - way_y * (segments[0, end] - x)) / length for end in (0, 1)
    )
    return first, second


def _overlapping(rings: Sequence[Points]) -> bool:
    """Whether rings enclose an area twice or inside out, or lie on each other in part."""
    polygons = shapely.make_valid(np.array([shapely.Polygon(ring) for ring in rings]))
    areas = shapely.area(polygons)
    enclosed = np.array([abs(float(polygon_area(ring))) for ring in rings])
    if (np.abs(areas - enclosed) > LEAST_AREA).any():
        return True
    i, j = np.triu_indices(len(rings), 1)
    common = shapely.area(shapely.intersection(polygons[i], polygons[j]))
    return bool((np.minimum(common, np.minimum(areas[i], areas[j]) - common) > LEAST_AREA).any())


def crossing_frames(curves: Curves, counts: Sequence[int], closed: Sequence[bool]) -> Mask:
    """In which frames one of the closed rings crosses itself; one may lie across another.

    Parameters
    ----------
    curves : (F, P, 4, 2) float64
        Curves of all rings, one ring after the other.
    counts : sequence of int
        Number of curves of each ring.
    closed : sequence of bool
        Which of the rings are closed; others are not looked at.

    Returns
    -------
    (F,) bool
    """
    found = np.zeros(len(curves), dtype=bool)
    last = np.cumsum(counts)
    for end, count, is_closed in zip(last, counts, closed, strict=True):
        if is_closed and count:
            found |= ~simple_frames(flatten(curves[:, end - count : end], CHORDS))
    return found
