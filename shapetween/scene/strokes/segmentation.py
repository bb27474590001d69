"""A region's outline shared out among the centre lines it runs beside."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from shapetween.base.arrays import Curves, Floats, Index, Mask, Points
from shapetween.fill.regions import Region
from shapetween.geometry.bezier import evaluate, sub_curves
from shapetween.model.outline import Outline
from shapetween.scene.strokes.centrelines import CentreLine, centre_lines
from shapetween.scene.strokes.contour import contour_part
from shapetween.scene.strokes.frame import CAP, WALL, StrokeFrame
from shapetween.scene.strokes.walk import follows

if TYPE_CHECKING:
    import shapely

__all__ = ["OutlinedStroke", "outlined_strokes"]

#: Places on each curve at which it is asked which line it runs beside.
LOOKS = 12

#: Parameter of a curve, from either end, within which a change of lines is at that end.
AT_JOINT = 0.03

#: Parameter of a curve, from either end, at which it is asked where on the contour it runs.
NEAR = 0.02

#: Way along the contour between two places, as multiples of half the width and of their distance,
#: beyond which the outline does not follow the contour from one to the other. It is 2 round the cap
#: of a line that ends on another.
JUMP, BENT = 3.0, 1.6

#: Steps of the grid, in the size of a region, on which its centre lines are looked for. A coarser
#: one bends them, a finer one lets through what rounding leaves.
GRID = 2.0**30

#: Difference of two lines' distances, as a share of their width, up to which neither is nearer.
EQUAL = 1e-6

#: Halvings by which the place of a change on a curve is found.
HALVINGS = 20

#: Share of the region's area by which the lines' outlines together may differ from it. Lines whose
#: outlines were sorted wrongly differ by whole limbs.
DIFFERENT = 2e-3


@dataclass(frozen=True, slots=True, eq=False)
class OutlinedStroke:
    """A centre line with the part of a region's outline that runs beside it.

    Attributes
    ----------
    line : CentreLine
    width : float
    rings : tuple of Outline
        Of the region's own curves, closed inside of it: one for an open line, two for a ring. All
        lines' rings together, filled by the rule nonzero, are the region.
    """

    line: CentreLine
    width: float
    rings: tuple[Outline, ...]


def outlined_strokes(region: Region) -> tuple[OutlinedStroke, ...] | None:
    """The strokes that a region consists of, or None for a body.

    Parameters
    ----------
    region : Region

    Notes
    -----
    Nothing is lost: all curves of the region's outline are in the rings, as they are.
    """
    polygon = _polygon(region)
    if not polygon.is_valid:
        return None
    found = _centre_lines(polygon)
    if found is None:
        return None
    lines, width = found
    rings = [region.outer, *(hole.reversed() for hole in region.holes)]
    runs = _runs(rings, lines, width)
    strokes = []
    for k, item in enumerate(lines):
        frame = StrokeFrame(item.line.curves, item.line.closed)
        own = _rings(frame, width / 2, [run for run, owner in runs if owner == k])
        if own is None or not all(follows(frame, ring) for ring in own):
            return None
        strokes.append(OutlinedStroke(item, width, own))
    return tuple(strokes) if _same(strokes, polygon) else None


def _centre_lines(polygon: "shapely.Polygon") -> tuple[tuple[CentreLine, ...], float] | None:
    """Centre lines of a region, found in a frame of its own.

    Where a stroke ends or two cross, many samples lie on one circle, and rounding would decide how
    they are joined: in its own frame, on a grid, a region looks alike in any unit and place.
    """
    import shapely

    low, high = np.array(polygon.bounds).reshape(2, 2)
    centre, size = (low + high) / 2, float((high - low).max())
    if not size > 0:
        return None
    own = shapely.transform(
        polygon, lambda points: np.round((points - centre) / size * GRID) / GRID
    )
    found = centre_lines(own) if own.is_valid else None
    if found is None:
        return None
    back = np.column_stack([size * np.eye(2), centre])
    lines = tuple(replace(line, line=line.line.transformed(back)) for line in found[0])
    return lines, size * found[1]


def _polyline(outline: Outline) -> Points:
    return evaluate(outline.curves, np.arange(LOOKS) / LOOKS).reshape(-1, 2)


def _polygon(region: Region) -> "shapely.Polygon":
    import shapely

    return shapely.Polygon(_polyline(region.outer), [_polyline(hole) for hole in region.holes])


def _runs(
    rings: Sequence[Outline], lines: Sequence[CentreLine], width: float
) -> list[tuple[Curves, int]]:
    """Parts of rings in a row that run beside one line, and which."""
    import shapely

    drawn = [shapely.LineString(_open(item.line)) for item in lines]

    def owners(points: Points) -> Index:
        away = np.stack([shapely.distance(line, shapely.points(points)) for line in drawn])
        least = away.min(axis=0)
        return np.asarray(np.argmax(away <= least + EQUAL * width, axis=0))

    found = []
    for ring in rings:
        parts, whose = _cut(ring.curves, owners)
        changes = np.flatnonzero(whose != np.roll(whose, 1))
        if not len(changes):
            found.append((parts, int(whose[0])))
            continue
        parts, whose = np.roll(parts, -changes[0], axis=0), np.roll(whose, -changes[0])
        for a, b in zip(changes, [*changes[1:], changes[0] + len(whose)], strict=True):
            low, high = a - changes[0], b - changes[0]
            found.append((parts[low:high], int(whose[low])))
    return found


def _open(line: Outline) -> Points:
    return np.concatenate([_polyline(line), line.curves[-1:, 3]])


def _cut(curves: Curves, owners: Callable[[Points], Index]) -> tuple[Curves, Index]:
    """Curves cut where their owner changes, and each part's owner."""
    looks = (np.arange(LOOKS) + 0.5) / LOOKS
    seen = owners(evaluate(curves, looks).reshape(-1, 2)).reshape(-1, LOOKS)
    parts: list[Curves] = []
    whose: list[int] = []
    for curve, row in zip(curves, seen, strict=True):
        cuts, owned = [0.0], [int(row[0])]
        for k in np.flatnonzero(np.diff(row)):
            low, high = looks[k], looks[k + 1]
            for _ in range(HALVINGS):
                middle = (low + high) / 2
                if owners(evaluate(curve, np.array([middle])))[0] == row[k]:
                    low = middle
                else:
                    high = middle
            if low < AT_JOINT:
                owned[-1] = int(row[k + 1])
            elif low <= 1 - AT_JOINT:
                cuts.append(low)
                owned.append(int(row[k + 1]))
        parts.append(_pieces(curve, cuts))
        whose += owned
    return np.concatenate(parts), np.array(whose, dtype=np.intp)


def _rings(frame: StrokeFrame, half: float, runs: Sequence[Curves]) -> tuple[Outline, ...] | None:
    """Runs beside a line closed to rings along its contour."""
    total = frame.zones.total
    placed: dict[int, list[tuple[float, float, Curves]]] = {-1: [], 1: []}
    for run in (part for whole in runs for part in _parted(frame, half, whole)):
        start, length, side = _span(frame, run)
        if length < 0:
            return None
        placed[side if frame.closed else -1].append((start % total, start % total + length, run))
    rings = []
    for side in (-1, 1) if frame.closed else (-1,):
        rows = sorted(placed[side], key=lambda row: round(row[0], 6))
        curves = _closed_up(frame, half, rows, side)
        rings.append(Outline(curves))
    return tuple(rings)


def _parted(frame: StrokeFrame, half: float, run: Curves) -> list[Curves]:
    """A run cut where it leaves the line's contour and comes back to it at another place.

    That is where the line ends on itself, as a P's bowl on its stem.
    """
    run = _cut_at_jumps(frame, half, run)
    points = evaluate(run, np.array([NEAR, 1 - NEAR]))
    jumps = _jumps(frame, half, points[:, 1], np.roll(points[:, 0], -1, axis=0))
    cuts = np.flatnonzero(jumps)
    ring = bool((run[-1, 3] == run[0, 0]).all())
    cuts = cuts if ring else cuts[cuts < len(run) - 1]
    if not len(cuts):
        return [run]
    if ring:
        run = np.roll(run, -(cuts[0] + 1), axis=0)
        return np.split(run, np.sort((cuts[1:] - cuts[0]) % len(run)))
    return np.split(run, cuts + 1)


def _jumps(frame: StrokeFrame, half: float, one: Points, other: Points) -> Mask:
    """Whether outlines that go from some points to others leave the contour between them."""
    gap = _apart(frame, half, one, other)
    return np.asarray(gap > JUMP * half + BENT * np.hypot(*(other - one).T))


def _apart(frame: StrokeFrame, half: float, one: Points, other: Points) -> Floats:
    """Way along the contour between points beside it."""
    zones, lengths = frame.zones, frame.lengths
    kinds = [zones.of(zone) for zone in range(zones.total)]
    size = [
        lengths[k] if kind == WALL else (0.0, np.pi * half)[kind == CAP] for kind, k, _ in kinds
    ]
    along = np.concatenate([[0.0], np.cumsum(size)])
    places = frame.locate(np.concatenate([one, other])).contour
    at = np.interp(places, np.arange(len(along)), along)
    gap = np.subtract(*np.split(at, 2))
    return np.asarray(np.abs(gap - along[-1] * np.round(gap / along[-1])))


def _cut_at_jumps(frame: StrokeFrame, half: float, run: Curves) -> Curves:
    """Curves of a run cut where they pass from one place of the contour to another within."""
    looks = np.concatenate([[NEAR], (np.arange(LOOKS) + 0.5) / LOOKS, [1 - NEAR]])
    seen = evaluate(run, looks)
    one, other = seen[:, :-1].reshape(-1, 2), seen[:, 1:].reshape(-1, 2)
    jumps = _jumps(frame, half, one, other).reshape(len(run), -1)
    if not jumps.any():
        return run
    parts = []
    for curve, row, jump in zip(run, seen, jumps, strict=True):
        cuts = [0.0]
        for k in np.flatnonzero(jump):
            low, high = looks[k], looks[k + 1]
            for _ in range(HALVINGS):
                middle = (low + high) / 2
                there = evaluate(curve, np.array([middle]))
                back, onward = (_apart(frame, half, there, row[j : j + 1])[0] for j in (k, k + 1))
                low, high = (middle, high) if back < onward else (low, middle)
            cuts.append(low)
        parts.append(_pieces(curve, cuts))
    return np.concatenate(parts)


def _pieces(curve: Curves, cuts: Sequence[float]) -> Curves:
    """A curve cut at parameters, the first of them 0."""
    if len(cuts) == 1:
        return curve[None]
    ends = np.array([*cuts[1:], 1.0])
    pieces = sub_curves(np.repeat(curve[None], len(cuts), 0), np.array(cuts), ends)
    pieces[1:, 0] = pieces[:-1, 3]
    pieces[0, 0], pieces[-1, 3] = curve[0], curve[3]
    return pieces


def _span(frame: StrokeFrame, run: Curves) -> tuple[float, float, int]:
    """Where a run starts on the contour, how far it goes, and on which side."""
    # Its very ends may lie beside two places of the line alike: they are where it heads.
    points = evaluate(run, (np.arange(LOOKS) + 0.5) / LOOKS).reshape(-1, 2)
    places = frame.locate(points)
    total = frame.zones.total
    steps = np.diff(places.contour)
    steps -= total * np.round(steps / total)
    start = float(places.contour[0] - steps[0] / 2)
    length = float(steps.sum() + steps[0] / 2 + steps[-1] / 2)
    side = 1 if int((places.side > 0).sum()) * 2 > len(points) else -1
    return start, length, side


def _closed_up(
    frame: StrokeFrame, half: float, rows: list[tuple[float, float, Curves]], side: int
) -> Curves:
    """Runs in their order with the contour's own parts between them."""
    total = float(frame.zones.total)
    if not rows:
        curves = contour_part(frame, half, 0.0, total, side, ("butt", "butt"), "bevel")
        return _sealed(curves)
    parts: list[Curves] = []
    for k, (_, end, run) in enumerate(rows):
        after, _, onward = rows[(k + 1) % len(rows)]
        after += total if k + 1 == len(rows) else 0.0
        parts.append(run)
        ends = run[-1, 3], onward[0, 0]
        if (ends[0] == ends[1]).all():
            continue
        start = min(end, after)
        parts.append(contour_part(frame, half, start, after, side, ("butt", "butt"), "bevel", ends))
    return np.concatenate([part for part in parts if len(part)])


def _sealed(curves: Curves) -> Curves:
    curves = curves.copy()
    curves[-1, 3] = curves[0, 0]
    return curves


def _same(strokes: Sequence[OutlinedStroke], polygon: "shapely.Polygon") -> bool:
    """Whether the strokes' rings together are the region."""
    import shapely

    areas = []
    for stroke in strokes:
        rings = [shapely.Polygon(_polyline(ring)) for ring in stroke.rings]
        rings = [
            ring if ring.is_valid else shapely.make_valid(ring, method="structure")
            for ring in rings
        ]
        area = rings[0]
        if len(rings) == 2:
            large, small = sorted(rings, key=shapely.area, reverse=True)
            area = large.difference(small)
        areas.append(area)
    union = shapely.union_all(areas)
    apart = union.symmetric_difference(polygon).area
    return bool(apart <= DIFFERENT * polygon.area)
