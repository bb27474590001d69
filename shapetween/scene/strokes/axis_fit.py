"""Points along a line as few straight lines and smooth cubic curves.

.. [Sch90] P. J. Schneider, *An algorithm for automatically fitting digitized curves*, Graphics
   Gems, 1990.
"""

import numpy as np

from shapetween.base.arrays import Curves, Floats, Index, Points
from shapetween.base.ranking import comparable
from shapetween.geometry.bezier import derivatives, evaluate, line_curves
from shapetween.geometry.polygon import cross

__all__ = ["end_motion", "fit_curves"]

#: Length, as a multiple of the reach, from which points that lie straight are a straight line.
#: Below, a round corner's points pass for many short ones.
STRAIGHT = 1.6

#: Rounds in which points slide along the curve fitted to them; a few more change nothing seen.
ROUNDS = 4

#: Points that a curve's handles are fitted to at least: fewer say nothing of how it bends.
FEWEST = 5


def end_motion(points: Points, reach: float, at: int) -> tuple[Points, float]:
    """Unit direction along a line at its first (0) or last (-1) point, and its curvature there.

    Parameters
    ----------
    points : (N, 2) float64
        In order, N at least 2.
    reach : float
        Length next to that end that is looked at.
    at : {0, -1}
    """
    run = points if at == 0 else points[::-1]
    along = _along(run)
    near = max(int(np.searchsorted(along, reach, side="right")), min(3, len(run)))
    s, near_points = along[:near], run[:near]
    if near < 3:
        motion, bend = near_points[-1] - near_points[0], 0.0
    else:
        x, y = (np.polynomial.polynomial.polyfit(s, near_points[:, k], 2) for k in (0, 1))
        motion, acceleration = np.array([x[1], y[1]]), 2 * np.array([x[2], y[2]])
        bend = float(cross(motion, acceleration)) / max(float(np.hypot(*motion)) ** 3, 1e-300)
    direction = motion / max(float(np.hypot(*motion)), 1e-300)
    return (direction, bend) if at == 0 else (-direction, -bend)


def fit_curves(points: Points, tolerance: float, reach: float, *, closed: bool) -> Curves:
    """Straight lines where points lie straight, and cubic curves that leave them smoothly.

    Parameters
    ----------
    points : (N, 2) float64
        In order; of a closed line without the first one again.
    tolerance : float
        Greatest distance of a point from the line.
    reach : float
        Length over which a direction shows.
    closed : bool
        Whether the line goes on from its last point to its first.

    Returns
    -------
    (C, 4, 2) float64
    """
    points = points[np.append(True, (np.diff(points, axis=0) != 0).any(axis=1))]
    if closed:
        points = _from_a_straight(points, tolerance, reach)
    straights = _straights(points, tolerance / 2, STRAIGHT * reach)
    if not straights and not closed and _off_chord(points) <= tolerance / 2:
        straights = [(0, len(points) - 1)]
    lines = {span: _fitted_line(points[span[0] : span[1] + 1]) for span in straights}
    pieces: list[Curves] = []
    at = 0
    start, leaving = points[0], None
    if closed and not straights:
        leaving = _smooth_direction(points, reach, 0, closed=True)
    for span in [*straights, (len(points) - 1, len(points) - 1)]:
        line = lines.get(span)
        end = points[-1] if line is None else line[0]
        if span[0] > at:
            reaching = None if line is None else _unit(line[1] - line[0])
            if line is None and closed:
                first = lines.get(straights[0]) if straights else None
                reaching = leaving if first is None else _unit(first[1] - first[0])
                end = points[0] if first is None else first[0]
            run = np.concatenate([start[None], points[at + 1 : span[0]], end[None]])
            pieces.append(_smooth(run, leaving, reaching, tolerance, reach))
        elif pieces and line is not None:
            pieces, end = _meet(pieces, line)
        if line is not None:
            pieces.append(line_curves(end, line[1])[None])
            start, leaving, at = line[1], _unit(line[1] - line[0]), span[1]
    curves = np.concatenate(pieces)
    curves[1:, 0] = curves[:-1, 3]
    if closed:
        curves[-1, 3] = curves[0, 0]
    return curves


def _unit(vector: Points) -> Points:
    return np.asarray(vector / max(float(np.hypot(*vector)), 1e-300))


def _along(points: Points) -> Floats:
    return np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))])


def _off_chord(points: Points) -> float:
    """Greatest distance of points from the chord of the first and the last."""
    chord = points[-1] - points[0]
    length = float(np.hypot(*chord))
    away = points - points[0]
    if length == 0:
        return float(np.hypot(*away.T).max())
    part = away @ chord / length**2
    if part.min() < -1e-6 or part.max() > 1 + 1e-6:
        return np.inf
    return float(np.abs(cross(away, chord)).max()) / length


def _from_a_straight(points: Points, tolerance: float, reach: float) -> Points:
    """A closed line's points from within its longest straight part, the first one again at last."""
    doubled = np.concatenate([points, points])
    spans = _straights(doubled, tolerance / 2, STRAIGHT * reach)
    if spans:
        length = [round(float(np.hypot(*(doubled[b] - doubled[a]))) / reach, 3) for a, b in spans]
        a, b = spans[int(np.argmax(length))]
        points = np.roll(points, -((a + b) // 2), axis=0)
    return np.concatenate([points, points[:1]])


def _straights(points: Points, tolerance: float, least: float) -> list[tuple[int, int]]:
    """Longest runs of points, first and last index, that lie straight."""
    along = _along(points)
    found, at, last = [], 0, len(points) - 1
    while at < last:
        low = int(np.searchsorted(along, along[at] + least))
        if low > last:
            break
        if _off_chord(points[at : low + 1]) > tolerance:
            at += 1
            continue
        high = last
        while low < high:
            middle = (low + high + 1) // 2
            if _off_chord(points[at : middle + 1]) <= tolerance:
                low = middle
            else:
                high = middle - 1
        found.append((at, low))
        at = low
    return found


def _fitted_line(points: Points) -> tuple[Points, Points]:
    """Ends of the straight line nearest to points."""
    centre = points.mean(axis=0)
    away = points - centre
    direction = _unit(points[-1] - points[0])
    spread = away.T @ away
    # Principal axis by the double angle; the chord says which way.
    angle = 0.5 * np.arctan2(2 * spread[0, 1], spread[0, 0] - spread[1, 1])
    axis = np.array([np.cos(angle), np.sin(angle)])
    axis = axis if axis @ direction >= 0 else -axis
    first, last = away[0] @ axis, away[-1] @ axis
    return centre + first * axis, centre + last * axis


def _meet(pieces: list[Curves], line: tuple[Points, Points]) -> tuple[list[Curves], Points]:
    """Two straight lines in a row end where they meet, unless that is far."""
    a, b = pieces[-1][-1, 0], pieces[-1][-1, 3]
    d, e = _unit(b - a), _unit(line[1] - line[0])
    turn = float(cross(d, e))
    meet = (b + line[0]) / 2
    if abs(turn) > 0.02:
        there = b + d * float(cross(line[0] - b, e)) / turn
        if np.hypot(*(there - meet)) < 0.3 * min(np.hypot(*(b - a)), np.hypot(*np.subtract(*line))):
            meet = there
    return [*pieces[:-1], line_curves(a, meet)[None]], meet


def _smooth_direction(points: Points, reach: float, k: int, *, closed: bool) -> Points:
    """Direction of a smooth run at an inner point; a closed one repeats its first point."""
    if closed:
        points, k = np.concatenate([points[:-1], points]), k + len(points) - 1
    before, _ = end_motion(points[: k + 1], reach, -1)
    after, _ = end_motion(points[k:], reach, 0)
    return _unit(before + after)


def _smooth(
    points: Points, leaving: Points | None, reaching: Points | None, tolerance: float, reach: float
) -> Curves:
    """Smooth cubic curves through points, with directions at the ends where those are given."""
    if leaving is None:
        leaving = end_motion(points, reach, 0)[0]
    if reaching is None:
        reaching = end_motion(points, reach, -1)[0]
    curve, errors = _one_curve(points, leaving, reaching)
    turn = np.sum(np.abs(_turns(points)))
    if (errors.max() <= tolerance and turn < 0.75 * np.pi) or len(points) < 2 * FEWEST:
        return curve[None]
    along = _along(points)
    middle = int(np.searchsorted(along, along[-1] / 2))
    middle = min(max(middle, FEWEST - 1), len(points) - FEWEST)
    if errors.max() > tolerance:
        worst = int(comparable(errors).argmax())
        middle = min(max(worst, FEWEST - 1), len(points) - FEWEST)
    through = _smooth_direction(points, reach, middle, closed=False)
    return np.concatenate(
        [
            _smooth(points[: middle + 1], leaving, through, tolerance, reach),
            _smooth(points[middle:], through, reaching, tolerance, reach),
        ]
    )


def _turns(points: Points) -> Floats:
    steps = np.diff(points[:: max(1, len(points) // 12)], axis=0)
    return np.asarray(np.arctan2(cross(steps[:-1], steps[1:]), (steps[:-1] * steps[1:]).sum(-1)))


def _one_curve(points: Points, leaving: Points, reaching: Points) -> tuple[Curves, Floats]:
    """The cubic curve with given ends nearest to points, and each point's distance ([Sch90]_)."""
    start, end = points[0], points[-1]
    along = _along(points)
    chord = along[-1]
    t = along / chord
    curve = line_curves(start, end)
    for _ in range(ROUNDS):
        s = 1 - t
        b0, b1, b2, b3 = s**3, 3 * s * s * t, 3 * s * t * t, t**3
        rest = points - (b0 + b1)[:, None] * start - (b2 + b3)[:, None] * end
        a1, a2 = b1[:, None] * leaving, -b2[:, None] * reaching
        gram = np.array([[np.sum(a1 * a1), np.sum(a1 * a2)], [np.sum(a1 * a2), np.sum(a2 * a2)]])
        side = np.array([np.sum(a1 * rest), np.sum(a2 * rest)])
        determinant = gram[0, 0] * gram[1, 1] - gram[0, 1] ** 2
        if determinant > 1e-9 * gram[0, 0] * gram[1, 1]:
            handles = np.linalg.solve(gram, side)
        else:
            handles = np.full(2, chord / 3)
        handles = np.clip(handles, 0.05 * chord, chord)
        curve = np.array([start, start + handles[0] * leaving, end - handles[1] * reaching, end])
        t = _slid(curve, points, t)
    errors = np.hypot(*(evaluate(curve, t) - points).T)
    return curve, np.asarray(errors)


def _slid(curve: Curves, points: Points, t: Floats) -> Floats:
    """Parameters of the curve's points nearest to points, one Newton step from a guess."""
    away = evaluate(curve, t) - points
    velocity = derivatives(curve, t)
    size = (velocity**2).sum(-1)
    step = (away * velocity).sum(-1) / np.where(size > 0, size, 1.0)
    moved: Index | Floats = np.clip(t - step, 0.0, 1.0)
    moved[0], moved[-1] = 0.0, 1.0
    return np.asarray(np.maximum.accumulate(moved))
