"""Points along a line as few straight lines and smooth cubic curves.

.. [Sch90] P. J. Schneider, *An algorithm for automatically fitting digitized curves*, Graphics
   Gems, 1990.
"""

import numpy as np

from shapetween.base.arrays import Curves, Floats, Points
from shapetween.base.ranking import comparable
from shapetween.geometry.bezier import derivatives, evaluate, line_curves, sub_curves
from shapetween.geometry.polygon import cross

__all__ = ["end_motion", "fit_curves"]

#: Length, as a multiple of the reach, from which points that lie straight are a straight line.
#: Below, a round corner's points pass for many short ones.
STRAIGHT = 1.6

#: Rounds in which points slide along the curve fitted to them; a few more change nothing seen.
#: Where an end is free it takes more: with fewer, quarters of circles are cut;
#: with more nothing changes but the time taken.
ROUNDS, FREE_ROUNDS = 4, 12

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
    """Smooth cubic curves through points, with directions at the ends where those are given.

    Where none is, points near the end tell one; or the end is left free, if that takes fewer
    curves: noise near the end of an arc bends its direction off, and it is cut to come back.
    """
    guessed = (
        end_motion(points, reach, 0)[0] if leaving is None else leaving,
        end_motion(points, reach, -1)[0] if reaching is None else reaching,
    )
    curves = _divided(points, *guessed, tolerance, reach)
    if len(curves) == 1 or (leaving is not None and reaching is not None):
        return curves
    free = _divided(points, leaving, reaching, tolerance, reach)
    return free if len(free) < len(curves) else curves


def _divided(
    points: Points, leaving: Points | None, reaching: Points | None, tolerance: float, reach: float
) -> Curves:
    """One curve through points or, where that is not near enough, those through two parts."""
    if len(points) < 2 * FEWEST:  # too few to say where an end is
        leaving = end_motion(points, reach, 0)[0] if leaving is None else leaving
        reaching = end_motion(points, reach, -1)[0] if reaching is None else reaching
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
            _divided(points[: middle + 1], leaving, through, tolerance, reach),
            _divided(points[middle:], through, reaching, tolerance, reach),
        ]
    )


def _turns(points: Points) -> Floats:
    steps = np.diff(points[:: max(1, len(points) // 12)], axis=0)
    return np.asarray(np.arctan2(cross(steps[:-1], steps[1:]), (steps[:-1] * steps[1:]).sum(-1)))


def _one_curve(
    points: Points, leaving: Points | None, reaching: Points | None
) -> tuple[Curves, Floats]:
    """The cubic curve nearest to points, and each point's distance ([Sch90]_).

    It begins and ends on the first and the last point where its direction there is given. Where
    none is, an end is a point like any other, no more exact than they are.
    """
    along = _along(points)
    chord = along[-1]
    t = along / chord
    ends = (points[0], leaving), (points[-1], None if reaching is None else -reaching)
    curve = line_curves(points[0], points[-1])
    for _ in range(FREE_ROUNDS if leaving is None or reaching is None else ROUNDS):
        s = 1 - t
        weights = (s**3, 3 * s * s * t), (t**3, 3 * s * t * t)
        (first, start), (last, end) = (
            _ways(*own, *given) for own, given in zip(weights, ends, strict=True)
        )
        ways = np.concatenate([first, last], axis=1)
        gram = np.einsum("nik,njk->ij", ways, ways)
        found = np.full(len(gram), chord / 3)  # two points tell no length; nor are they free
        if np.linalg.det(gram) > 1e-9 * np.prod(np.diag(gram)):
            found = np.linalg.solve(gram, np.einsum("nik,nk->i", ways, points - start - end))
        sides = np.split(found, [first.shape[1]])
        both = [_placed(own, *given, chord) for own, given in zip(sides, ends, strict=True)]
        curve = np.concatenate([both[0], both[1][::-1]])
        t = _slid(curve, points, t)
    errors = np.hypot(*(evaluate(curve, t) - points).T)
    if t[0] > 0 or t[-1] < 1:  # a free end may lie past the points
        curve = sub_curves(curve[None], t[:1], t[-1:])[0]
    return curve, np.asarray(errors)


def _ways(
    end: Floats, handle: Floats, point: Points, direction: Points | None
) -> tuple[Points, Points]:
    """What an end of a curve and its handle may add to points (N, K, 2), and what they do (N, 2).

    Both are wherever they fit best, or the end is a point and its handle in a direction from it.
    """
    if direction is None:
        ways = np.concatenate(
            [end[:, None, None] * np.eye(2), handle[:, None, None] * np.eye(2)], 1
        )
        return ways, np.zeros((len(end), 2))
    return handle[:, None, None] * direction, (end + handle)[:, None] * point


def _placed(found: Floats, point: Points, direction: Points | None, chord: float) -> Points:
    """An end of a curve and its handle, which is neither next to nothing nor longer than it."""
    if direction is None:
        point, arm = found[:2], found[2:] - found[:2]
        length = max(float(np.hypot(*arm)), 1e-300)
        return np.array([point, point + arm * (np.clip(length, 0.05 * chord, chord) / length)])
    return np.array([point, point + np.clip(found[0], 0.05 * chord, chord) * direction])


def _slid(curve: Curves, points: Points, t: Floats) -> Floats:
    """Parameters of the curve's points nearest to points, one Newton step from a guess."""
    away = evaluate(curve, t) - points
    velocity = derivatives(curve, t)
    size = (velocity**2).sum(-1)
    step = (away * velocity).sum(-1) / np.where(size > 0, size, 1.0)
    return np.asarray(np.maximum.accumulate(np.clip(t - step, 0.0, 1.0)))
