"""Which place of one outline becomes which of the other, where the frame does the turning.

Places are shares of the lengths; knots are places that correspond, (u, v), and between them both
go evenly.
"""

import numpy as np

from shapetween.base.arrays import Floats, Index, Points
from shapetween.geometry.bezier import end_tangents
from shapetween.geometry.polygon import cross
from shapetween.scene.places import Places, run_of

__all__ = [
    "along_knots",
    "anchored_knots",
    "graph_knots",
    "half_knots",
    "kinks_of",
    "ring_knots",
    "snapped",
]

#: Steps of an outline that are compared with those of the other. More follow detail more closely
#: and cost time with their square.
STEPS = 48

#: What a place's shift costs beside the turn of its direction, and a step of two to one.
SHIFT, SLOPE = 0.8, 0.06

#: Least angle of a corner, radians, and greatest distance of two corners, as a share of the length,
#: that become each other.
CORNER, SNAP = np.deg2rad(22.0), 0.06

#: Difference of the turns at two corners that are one, radians.
ALIKE = np.deg2rad(60.0)

#: Rotations of a ring that are looked at closely.
STARTS = 4


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


def along_knots(source: Places, target: Places) -> tuple[Floats, Floats, float]:
    """Knots of two open lines run in one direction, and what they cost."""
    even = np.linspace(0.0, 1.0, STEPS + 1)
    costs = _costs(_features(source, even), _features(target, even))
    path, cost = _path(costs)
    u, v = even[path[:, 0]], _smooth(even[path[:, 1]])
    return *snapped(source, target, u, v), cost


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
    at = np.union1d(np.linspace(0.0, 1.0, 4 * STEPS + 1), places.joints)
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
    away = np.linalg.norm(source.point(at_a)[:, None] - target.point(at_b), axis=-1)
    alike = (away <= same) & (np.abs(kinks_a[:, None] - kinks_b) < ALIKE)
    pairs = [(float(at_a[i]), float(at_b[j])) for i, j in np.argwhere(alike).tolist()]
    if len(pairs) < 2:
        return None
    pairs.sort()
    u = np.array([p for p, _ in pairs])
    v = np.unwrap(np.array([q for _, q in pairs]), period=1.0)
    if (np.diff(u) <= 0).any() or (np.diff(v) <= 0).any() or v[-1] - v[0] >= 1:
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


def ring_knots(source: Places, target: Places) -> tuple[Floats, Floats]:
    """Knots of two closed outlines, both clockwise, of which neither turns."""
    even = np.arange(STEPS) / STEPS
    first, second = _features(source, even), _features(target, even)
    every = _costs(first, second)
    index = np.arange(STEPS)
    sums = np.array([every[index, (index + k) % STEPS].sum() for k in range(STEPS)])
    best: tuple[float, Floats, Floats] | None = None
    for shift in np.argsort(np.round(sums, 6), kind="stable")[:STARTS].tolist():
        # Begin where the two are most alike.
        start = int(every[index, (index + shift) % STEPS].argmin())
        rows = np.append(index + start, start + STEPS)
        columns = np.append(index + start + shift, start + shift + STEPS)
        costs = every[rows[:, None] % STEPS, columns % STEPS]
        path, cost = _path(costs)
        if best is None or cost < best[0] - 1e-9:
            best = cost, rows[path[:, 0]] / STEPS, _smooth(columns[path[:, 1]] / STEPS)
    assert best is not None
    return snapped(source, target, best[1], best[2])


def half_knots(
    source: Places, target: Places, first: tuple[float, float], second: tuple[float, float]
) -> tuple[Floats, Floats] | None:
    """Knots of two rings that are their own mirror images, themselves mirror images.

    Parameters
    ----------
    source, target : Places
        Closed.
    first, second : (float, float)
        Shares at which each crosses its axis: where the half begins and ends, increasing.
    """
    even = np.linspace(0.0, 1.0, STEPS + 1)
    ends = (first, second)
    features = [
        _features(places, low + (high - low) * even)
        for places, (low, high) in zip((source, target), ends, strict=True)
    ]
    path, _ = _path(_costs(*features))
    u, v = even[path[:, 0]], _smooth(even[path[:, 1]])
    corners = []
    for places, (low, high) in zip((source, target), ends, strict=True):
        at, kinks = kinks_of(places)
        part = ((at - low) % 1.0) / (high - low)
        inner = (part > 1e-3) & (part < 1 - 1e-3)
        corners.append((part[inner], kinks[inner]))
    u, v = _bent(u, v, corners[0], corners[1], closed=False)
    halves = []
    for knots, (low, high) in zip((u, v), ends, strict=True):
        there = low + (high - low) * knots
        # The other half, run the other way: its length is what is left of the turn.
        back = high + (1 - (high - low)) * (1 - knots[::-1])
        halves.append(np.concatenate([there, back[1:]]))
    return halves[0], halves[1]


def snapped(source: Places, target: Places, u: Floats, v: Floats) -> tuple[Floats, Floats]:
    """Knots bent so that corners nearly matched become each other."""
    return _bent(u, v, kinks_of(source), kinks_of(target), closed=source.outline.closed)


def _bent(
    u: Floats,
    v: Floats,
    first: tuple[Floats, Floats],
    second: tuple[Floats, Floats],
    *,
    closed: bool,
) -> tuple[Floats, Floats]:
    (at, kinks), (other, bends) = first, second
    if not len(at) or not len(other):
        return u, v
    here = u[0] + (at - u[0]) % 1.0 if closed else at
    image = np.interp(here, u, v)
    away = other - image[:, None]
    if closed:
        away = (away + 0.5) % 1.0 - 0.5
    score = np.abs(away) / SNAP + 0.5 * np.abs(kinks[:, None] - bends)
    fine = (np.abs(away) < SNAP) & (kinks[:, None] * bends > 0)
    score = np.where(fine, score, np.inf)
    chosen: list[tuple[float, float]] = []
    for k in np.argsort(np.round(score, 9), axis=None, kind="stable").tolist():
        i, j = divmod(k, len(other))
        if not np.isfinite(score[i, j]):
            break
        pair = float(here[i]), float(image[i] + away[i, j])
        if all((pair[0] - p) * (pair[1] - q) > 0 for p, q in chosen):
            chosen.append(pair)
    if not chosen:
        return u, v
    chosen.sort()
    anchors = np.array(chosen)
    shift = anchors[:, 1] - np.interp(anchors[:, 0], u, v)
    if closed:
        around = np.concatenate([anchors[-1:, 0] - 1, anchors[:, 0], anchors[:1, 0] + 1])
        offsets = np.concatenate([shift[-1:], shift, shift[:1]])
    else:
        around = np.concatenate([u[:1], anchors[:, 0], u[-1:]])
        offsets = np.concatenate([[0.0], shift, [0.0]])
    both = np.unique(np.concatenate([u, anchors[:, 0]]))
    bent = np.interp(both, u, v) + np.interp(both, around, offsets)
    # No knot may lie on the wrong side of an anchor.
    bent = np.maximum.accumulate(bent)
    exact = np.searchsorted(both, anchors[:, 0])
    for k, value in zip(exact.tolist(), anchors[:, 1].tolist(), strict=True):
        bent[:k] = np.minimum(bent[:k], value)
        bent[k] = value
        bent[k + 1 :] = np.maximum(bent[k + 1 :], value)
    if closed:
        bent[-1] = bent[0] + 1.0
        bent = np.minimum(bent, bent[-1])
    return both, bent


def _features(places: Places, shares: Floats) -> tuple[Floats, Points]:
    """Directions, and places in the outline's own box, at shares of its length."""
    points = places.point(shares)
    step = 0.25 / STEPS
    ends = places.point(np.concatenate([shares - step, shares + step])).reshape(2, -1, 2)
    ahead = ends[1] - ends[0]
    every = places.point(np.arange(STEPS) / STEPS)
    low, high = every.min(axis=0), every.max(axis=0)
    size = np.maximum(high - low, 0.25 * float((high - low).max()) or 1.0)
    return np.arctan2(ahead[:, 1], ahead[:, 0]), (points - (low + high) / 2) / size


def _costs(first: tuple[Floats, Points], second: tuple[Floats, Points]) -> Floats:
    turn = 1 - np.cos(first[0][:, None] - second[0])
    shift = np.sqrt(((first[1][:, None] - second[1]) ** 2).sum(axis=-1))
    return np.asarray(turn + SHIFT * shift)


def _path(costs: Floats) -> tuple[Index, float]:
    """The cheapest monotone path from corner to corner of a table, its steps 1:3 to 3:1."""
    rows, columns = costs.shape
    steps = ((1, 1, 0.0), (1, 2, SLOPE), (2, 1, SLOPE), (1, 3, 2 * SLOPE), (3, 1, 2 * SLOPE))
    total = np.full((rows, columns), np.inf)
    came = np.zeros((rows, columns), dtype=np.intp)
    total[0, 0] = costs[0, 0]
    for i in range(1, rows):
        found = np.full((len(steps), columns), np.inf)
        for k, (down, right, price) in enumerate(steps):
            if i >= down:
                weight = max(down, right)
                found[k, right:] = total[i - down, : columns - right] + price
                found[k, right:] += (weight - 1) * costs[i, right:] / 2
        came[i] = found.argmin(axis=0)
        total[i] = found.min(axis=0) + costs[i]
    if not np.isfinite(total[-1, -1]):
        even = np.arange(rows)
        return np.stack([even, np.round(even * (columns - 1) / (rows - 1)).astype(int)], 1), np.inf
    i, j = rows - 1, columns - 1
    path = [(i, j)]
    while (i, j) != (0, 0):
        down, right, _ = steps[came[i, j]]
        i, j = i - down, j - right
        path.append((i, j))
    return np.array(path[::-1]), float(total[-1, -1]) / (len(path))


def _smooth(values: Floats) -> Floats:
    """Increasing values without the steps of the table, ends kept."""
    if len(values) < 5:
        return values
    result = values.copy()
    for _ in range(2):
        result[1:-1] = (result[:-2] + 2 * result[1:-1] + result[2:]) / 4
    return result
