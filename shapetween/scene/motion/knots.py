"""Which place of one outline becomes which of the other, where the frame does the turning.

Places are shares of the lengths; knots are places that correspond, (u, v), and between them both
go evenly.
"""

import numpy as np

from shapetween.base.arrays import Floats, Index, Points
from shapetween.geometry.bezier import end_tangents
from shapetween.geometry.circlemap import SAME, turn
from shapetween.geometry.polygon import cross
from shapetween.scene.motion.bend_knots import along_knots
from shapetween.scene.places import Places, run_of

__all__ = ["anchored_knots", "graph_knots", "kinks_of", "without_points"]

#: Steps at which a line is looked at for being a graph.
STEPS = 192

#: Least angle of a corner, radians.
CORNER = np.deg2rad(22.0)

#: Difference of the turns at two corners that are one, radians.
ALIKE = np.deg2rad(60.0)

#: Shares of two lines, of which one becomes the other: below the first a part is a point, below the
#: second what becomes one is small enough to go with what is beside it.
LEAST_STEP, SMALL_STEP = 1e-3, 0.03


def kinks_of(places: Places) -> tuple[Floats, Floats]:
    """Where an outline has corners, as shares of its length, and by how much it turns there."""
    curves = places.outline.curves
    some = np.flatnonzero(np.ptp(curves, axis=1).max(axis=1) > 0)
    if not len(some):
        return np.zeros(0), np.zeros(0)
    leaving, reaching = end_tangents(curves[some])
    before = np.roll(reaching, 1, axis=0)
    kinks = np.arctan2(cross(before, leaving), (before * leaving).sum(-1))
    at = places.joints[some]
    if not places.outline.closed:
        kinks, at = kinks[1:], at[1:]
    sharp = np.abs(kinks) > CORNER
    return at[sharp], kinks[sharp]


def graph_knots(source: Places, target: Places, same: float) -> tuple[Floats, Floats] | None:
    """Knots of two lines that are graphs over one range of x, at equal x; None of others.

    Parameters
    ----------
    source, target : Places
        Open lines.
    same : float
        Distance of two x that are one.
    """
    found = []
    for places in (source, target):
        graph = _graph(places)
        if graph is None:
            return None
        found.append(graph)
    (at_a, x_a), (at_b, x_b) = found
    if max(abs(x_a[0] - x_b[0]), abs(x_a[-1] - x_b[-1])) > same:
        return None
    if (x_a[0] < x_a[-1]) != (x_b[0] < x_b[-1]):
        return None
    # At every corner of either, the place of the other that lies over it.
    sign = 1.0 if x_a[0] < x_a[-1] else -1.0
    own = [
        np.interp(places.joints, at, sign * x, left=np.nan, right=np.nan)
        for places, at, x in ((source, at_a, x_a), (target, at_b, x_b))
    ]
    wanted = np.unique(np.concatenate([*own, sign * x_a[[0, -1]]]))
    wanted = wanted[np.isfinite(wanted)]
    wanted = wanted[np.append(True, np.diff(wanted) > same / 10)]
    u, v = np.interp(wanted, sign * x_a, at_a), np.interp(wanted, sign * x_b, at_b)
    u[0], u[-1], v[0], v[-1] = at_a[0], at_a[-1], at_b[0], at_b[-1]
    first, last = np.zeros(int(max(u[0], v[0]) > 0)), np.ones(int(min(u[-1], v[-1]) < 1))
    return np.concatenate([first, u, last]), np.concatenate([first, v, last])


def _graph(places: Places) -> tuple[Floats, Floats] | None:
    """Shares and their x of the part of an open line that is a graph, upright ends apart."""
    at = np.union1d(np.linspace(0.0, 1.0, STEPS + 1), places.joints)
    at = at[np.append(True, np.diff(at) > SAME)]  # a joint on a step is one place with it
    x = places.point(at)[:, 0]
    extent = float(np.ptp(x))
    if extent == 0:
        return None
    inner = np.flatnonzero((np.abs(x - x[0]) > 1e-6 * extent) & (np.abs(x - x[-1]) > 1e-6 * extent))
    if not len(inner):
        return None
    first, last = inner[0] - 1, inner[-1] + 1
    at, x = at[first : last + 1], x[first : last + 1]
    if first < 0 or len(x) < 3:
        return None
    steps = np.diff(x) * (1.0 if x[-1] > x[0] else -1.0)
    return None if (steps <= 1e-7 * extent).any() else (at, x)


def without_points(u: Floats, v: Floats) -> tuple[Floats, Floats]:
    """Knots of lines without those by which a small part of one becomes a point of the other.

    A curve that is a point has no direction for a stroke's outline to follow.
    """
    kept = [0]
    last = len(u) - 1
    for k in range(1, last):
        steps = [(u[j] - u[i], v[j] - v[i]) for i, j in ((kept[-1], k), (k, last))]
        if all(min(step) > LEAST_STEP or max(step) > SMALL_STEP for step in steps):
            kept.append(k)
    kept.append(last)
    return u[kept], v[kept]


def _near(first: Points, second: Points, reach: float) -> tuple[Index, Index]:
    """Pairs of points no farther apart than so.

    A table of the corners of two coasts would fill the memory.
    """
    import shapely

    more = 1.001 * reach
    around = shapely.box(*(first - more).T, *(first + more).T)
    one, other = shapely.STRtree(shapely.points(second)).query(around)
    near = np.linalg.norm(first[one] - second[other], axis=-1) <= reach
    return one[near], other[near]


def anchored_knots(source: Places, target: Places, same: float) -> tuple[Floats, Floats] | None:
    """Knots of two rings that have corners in common, which stay; None of others.

    Parameters
    ----------
    source, target : Places
        Closed, both clockwise.
    same : float
        Distance of two corners that are one.
    """
    (at_a, kinks_a), (at_b, kinks_b) = kinks_of(source), kinks_of(target)
    if len(at_a) < 2 or len(at_b) < 2:
        return None
    first, second = _near(source.point(at_a), target.point(at_b), same)
    alike = np.abs(kinks_a[first] - kinks_b[second]) < ALIKE
    pairs = list(zip(at_a[first[alike]].tolist(), at_b[second[alike]].tolist(), strict=True))
    if len(pairs) < 2:
        return None
    pairs.sort()
    u = np.array([p for p, _ in pairs])
    v = np.array([q for _, q in pairs])
    v = v[0] + turn(v - v[0])  # unwrapping would leave it to rounding which way half a turn goes
    if (np.diff(u) <= 0).any() or (np.diff(v) <= 0).any():
        return None
    u, v = np.append(u, u[0] + 1), np.append(v, v[0] + 1)
    knots: list[tuple[float, float]] = []
    for k in range(len(u) - 1):
        runs = [
            Places(run_of(places, low, high))
            for places, low, high in ((source, u[k], u[k + 1]), (target, v[k], v[k + 1]))
        ]
        found = graph_knots(runs[0], runs[1], same)
        inner = along_knots(runs[0], runs[1])[:2] if found is None else found
        ends = (u[k], u[k + 1] - u[k]), (v[k], v[k + 1] - v[k])
        shares = [low + size * part for (low, size), part in zip(ends, inner, strict=True)]
        knots += list(zip(*(x.tolist() for x in shares), strict=True))
    rows = np.array(knots)
    keep = np.append(True, (np.diff(rows, axis=0) > 0).any(axis=1))
    rows = rows[keep]
    rows[-1] = rows[0] + 1.0
    return rows[:, 0], rows[:, 1]
