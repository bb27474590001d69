"""Centre lines of filled regions that are outlined strokes: bars, crosses, arrows, rings, letters.

A stroke that was turned into its outline still moves like a stroke: by its centre line, at constant
width. What a region's medial axis says is put together into as few lines as a person would draw:
lines go straight on through crossings, and turn at corners.
"""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from shapetween.base.arrays import Curves, Points
from shapetween.geometry.bezier import end_tangents, evaluate, line_curves
from shapetween.geometry.polygon import cross
from shapetween.model.outline import Outline
from shapetween.scene.strokes.axis_fit import fit_curves
from shapetween.scene.strokes.branches import Limb, limbs_of
from shapetween.scene.strokes.medial_axis import MedialAxis, medial_axis

if TYPE_CHECKING:
    import shapely

__all__ = ["CentreLine", "centre_lines", "is_broad", "run_into"]

#: Difference of the distance to the border from the median one, as a share of it, up to which a
#: place of the axis lies on a centre line. Strokes' corners and crossings are beyond it.
EVEN = 0.04

#: Share of the axis that must be so even. Bodies have a fifth to a half, letters with many
#: crossings three quarters.
LEAST_EVEN = 0.55

#: Greatest distance to the border, as a multiple of the median one. Where lines cross slantwise it
#: is 1.5; beyond it there is a body.
WIDEST = 1.8

#: Radius of a disc, as a multiple of a region's area per length of border, and the share of its
#: area where the disc's centre may lie. Half a stroke's width is about the area per length, so of
#: strokes only crossings and the like are left, 3 % at most of all icons' and letters'; of bodies 8
#: % in the median. A smaller share refuses strokes, a larger one saves no time.
BROAD, LEAST_BROAD = 1.3, 0.05

#: Least length of all lines together, as a multiple of the width: a shorter one is a dot or a box.
LEAST_LENGTH = 2.5

#: Least length of a straight line by itself, and of a ring by itself, as multiples of the width. A
#: shorter bar moves better as a box, and a thicker ring is a body with a hole.
BAR, RING = 5.0, 11.0

#: Least share that the region and the strokes along its lines have in common of both together.
ALIKE = 0.93

#: Length at a line's end, as a multiple of half the width, on which it cannot end itself.
CLEAR = 4.0

#: How far a centre line may lie off the axis, as a share of half the width.
TOLERANCE = 0.02


@dataclass(frozen=True, slots=True, eq=False)
class CentreLine:
    """A line that a region's strokes follow.

    Attributes
    ----------
    line : Outline
        Open, or closed where it is a ring.
    free : (bool, bool)
        Whether its start and end stick out, and do not end in another line.
    """

    line: Outline
    free: tuple[bool, bool]


def centre_lines(polygon: "shapely.Polygon") -> tuple[tuple[CentreLine, ...], float] | None:
    """Centre lines of a region and the width of its strokes, if it is an outlined stroke.

    Parameters
    ----------
    polygon : shapely.Polygon
        The region, with many short sides where it is curved.

    Returns
    -------
    lines : tuple of CentreLine
    width : float
        Both, or None for a body.
    """
    axis = None if is_broad(polygon) else medial_axis(polygon)
    if axis is None or not axis.chains:
        return None
    half = _median_radius(axis)
    if half is None:
        return None
    limbs = limbs_of(axis, half, EVEN * half)
    if limbs is None:
        return None
    lines = tuple(_line_of(limb, half) for limb in limbs)
    lines = _ended(lines, limbs, half)
    if len(lines) == 1 and not _long(lines[0].line, half):
        return None
    return (lines, 2 * half) if _alike(lines, half, polygon) else None


def is_broad(polygon: "shapely.Polygon") -> bool:
    """Whether a region is plainly too broad for its border to be a stroke: a quick look.

    Parameters
    ----------
    polygon : shapely.Polygon
    """
    mean = float(polygon.area) / float(polygon.length)
    inner = polygon.buffer(-BROAD * mean, quad_segs=4)
    return bool(inner.area > LEAST_BROAD * polygon.area)


def _median_radius(axis: MedialAxis) -> float | None:
    """Half the width, if the axis is of one width almost everywhere."""
    radii = np.concatenate([(c.radii[1:] + c.radii[:-1]) / 2 for c in axis.chains])
    steps = np.concatenate([np.hypot(*np.diff(c.points, axis=0).T) for c in axis.chains])
    order = np.argsort(radii, kind="stable")
    run = np.cumsum(steps[order])
    total = float(run[-1])
    if total == 0:
        return None
    half = float(radii[order][np.searchsorted(run, total / 2)])
    even = float(steps[np.abs(radii - half) <= EVEN * half].sum())
    if even < LEAST_EVEN * total or radii.max() > WIDEST * half:
        return None
    return half if total >= 2 * half * LEAST_LENGTH else None


def _long(line: Outline, half: float) -> bool:
    """Whether a line by itself is long enough for its width to be one."""
    points = _chords(line)
    length = float(np.hypot(*np.diff(points, axis=0).T).sum())
    if line.closed:
        return length >= RING * 2 * half
    straight = length <= 1.001 * float(np.hypot(*(points[-1] - points[0])))
    return not straight or length >= BAR * 2 * half


def _line_of(limb: Limb, half: float) -> CentreLine:
    """A limb's runs as straight lines and curves, that meet where it turns sharply."""
    runs, corners = list(limb.runs), list(limb.corners)
    if limb.closed and any(corners):
        first = corners.index(True) + 1
        runs, corners = runs[first:] + runs[:first], corners[first:] + corners[:first]
    groups: list[list[Points]] = [[]]
    for run, corner in zip(runs, corners, strict=True):
        groups[-1].append(run)
        if corner:
            groups.append([])
    groups = [group for group in groups if group]
    ring = limb.closed and not any(corners)
    parts = [
        fit_curves(np.concatenate(group), TOLERANCE * half, 1.5 * half, closed=ring)
        for group in groups
    ]
    if ring:
        return CentreLine(Outline(parts[0]), (False, False))
    for k in range(len(parts) - (0 if limb.closed else 1)):
        _meet(parts, k, (k + 1) % len(parts), half)
    curves = np.concatenate(parts)
    return CentreLine(
        Outline(curves, limb.closed),
        (not limb.closed and limb.meets[0] == -1, not limb.closed and limb.meets[1] == -1),
    )


def _meet(parts: list[Curves], one: int, other: int, half: float) -> None:
    """Let two parts of a line end where their directions meet."""
    end, start = parts[one][-1, 3], parts[other][0, 0]
    leaving, onward = end_tangents(parts[one][-1])[1], end_tangents(parts[other][0])[0]
    turn = float(cross(leaving, onward))
    meet = (end + start) / 2
    if abs(turn) > 0.05:
        there = end + leaving * float(cross(start - end, onward)) / turn
        if np.hypot(*(there - meet)) < 4 * half:
            meet = there
    parts[one] = _lengthened(parts[one], meet, half)
    parts[other] = _lengthened(parts[other][::-1, ::-1], meet, half)[::-1, ::-1]


def _lengthened(curves: Curves, end: Points, half: float) -> Curves:
    """Curves that go on, or stop before, to end in a point about straight ahead."""
    last = curves[-1]
    chord = last[3] - last[0]
    off = float(np.abs(cross(last[1:3] - last[0], chord)).max()) / float(np.hypot(*chord))
    straight = off <= 1e-9 * half * 1e6
    if straight and (end - last[0]) @ chord > 0:
        return np.concatenate([curves[:-1], line_curves(last[0], end)[None]])
    if np.hypot(*(end - last[3])) <= 1e-3 * half:
        moved = last.copy()
        moved[2:] += end - last[3]
        return np.concatenate([curves[:-1], moved[None]])
    return np.concatenate([curves, line_curves(last[3], end)[None]])


def _ended(
    lines: tuple[CentreLine, ...], limbs: tuple[Limb, ...], half: float
) -> tuple[CentreLine, ...]:
    """Lines that end on the others they run into."""
    import shapely

    drawn = [shapely.LineString(_chords(item.line)) for item in lines]
    found = []
    for k, (item, limb) in enumerate(zip(lines, limbs, strict=True)):
        curves = item.line.curves
        others = [line for j, line in enumerate(drawn) if j != k]
        for end in (0, 1):
            if limb.meets[end] == -1 or limb.closed:
                continue
            forward = curves if end == 1 else curves[::-1, ::-1]
            tip, ahead = forward[-1, 3], end_tangents(forward[-1])[1]
            own = _without_end(forward, CLEAR * half)
            meet = run_into(tip, ahead, [*others, *own], half)
            if meet is not None:
                forward = _lengthened(forward, meet, half)
            curves = forward if end == 1 else forward[::-1, ::-1]
        found.append(CentreLine(Outline(curves, item.line.closed), item.free))
    return tuple(found)


def _without_end(curves: Curves, length: float) -> "list[shapely.LineString]":
    """A line without a length at its end: what it may end on itself."""
    import shapely
    from shapely.ops import substring

    line = shapely.LineString(_chords(Outline(curves, closed=False)))
    if line.length <= length:
        return []
    return [substring(line, 0.0, line.length - length)]


def run_into(
    tip: Points, ahead: Points, others: "list[shapely.LineString]", half: float
) -> Points | None:
    """Where a line that goes straight ahead first meets another, or comes nearest to one."""
    import shapely

    if not others:  # one line, too short to end on itself
        return None
    ray = shapely.LineString([tip, tip + 4 * half * ahead])
    union = shapely.union_all(others)
    crossing = shapely.get_coordinates(ray.intersection(union))
    if len(crossing):
        away = np.hypot(*(crossing - tip).T)
        return np.asarray(crossing[int(np.argmin(away))])
    near = shapely.get_coordinates(shapely.shortest_line(ray, union))
    if np.hypot(*(near[1] - near[0])) < 0.4 * half:
        return np.asarray(near[1])
    return None


def _chords(line: Outline) -> Points:
    points = evaluate(line.curves, np.arange(16) / 16).reshape(-1, 2)
    return np.concatenate([points, line.curves[-1:, 3]])


def _alike(lines: tuple[CentreLine, ...], half: float, polygon: "shapely.Polygon") -> bool:
    """Whether strokes along the lines are the region."""
    import shapely

    strokes = shapely.union_all(
        [shapely.LineString(_chords(item.line)).buffer(half, quad_segs=6) for item in lines]
    )
    both = float(strokes.intersection(polygon).area)
    return both >= ALIKE * (float(strokes.area) + float(polygon.area) - both)
