"""Polygons cut from curves' chords, back to the curves.

A polygon's side lies on chords that know their curves. A run of sides along one curve becomes the
part of that curve between the run's ends. Whatever no chord explains stays a line.
"""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from shapetween.base.arrays import Floats, Index, Points
from shapetween.boolean.chords import Chords
from shapetween.boolean.joints import Run, pieces
from shapetween.model.outline import Outline
from shapetween.model.tidy import tidy

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry

__all__ = ["traced"]

#: Distance from a chord, in units of its flatness, at which a side still lies on its curve. Below
#: 1, one curve drawn twice with other cuts counts as two, and what they show is cut wherever their
#: chords cross.
NEAR = 2.5


def traced(area: BaseGeometry, chords: Chords) -> list[tuple[Outline, ...]]:
    """Rings of an area's polygons, in the curves whose chords they were cut from.

    Parameters
    ----------
    area : shapely geometry
        What is no polygon of it, where areas only touch, is left out.
    chords : Chords
        Of all curves that bound the area.

    Returns
    -------
    list of tuple of Outline
        For each polygon its outer ring, which runs clockwise as drawn, and its holes, which run
        the other way.
    """
    import shapely

    polygons = [
        part
        for part in shapely.get_parts(shapely.get_parts(shapely.orient_polygons(area)))
        if part.geom_type == "Polygon" and not part.is_empty
    ]
    if not polygons:
        return []
    lines, owners = shapely.get_rings(polygons, return_index=True)
    rings = [shapely.get_coordinates(line)[:-1] for line in lines]
    groups: list[list[Outline]] = [[] for _ in polygons]
    for outline, owner in zip(_outlines(rings, chords), owners.tolist(), strict=True):
        groups[owner].append(outline)
    return [tuple(group) for group in groups]


def _outlines(rings: list[Points], chords: Chords) -> list[Outline]:
    points = np.concatenate(rings)
    firsts = np.cumsum([0, *map(len, rings)])
    after = _successors(firsts)
    sides = _Sides.of(points, after, chords)
    runs = [sides.runs(range(low, high)) for low, high in pairwise(firsts.tolist())]
    bounds = np.cumsum([0, *map(len, runs)])
    every = [run for ring in runs for run in ring]
    curves = pieces(every, _successors(bounds), points, chords)
    return [tidy(Outline(curves[low:high])) for low, high in pairwise(bounds.tolist())]


def _successors(bounds: Index) -> Index:
    """What follows each item of cycles that lie one after another, given where each starts."""
    after = np.arange(1, bounds[-1] + 1)
    after[bounds[1:] - 1] = bounds[:-1]
    return after


@dataclass(frozen=True, slots=True, eq=False)
class _Sides:
    """What sides of polygons lie on; a side has the number of its first point.

    Attributes
    ----------
    chords : Chords
    after : (P,) intp
        The point that follows each point.
    ways : tuple of dict
        For each side the arcs that it lies on, as twice the arc's number, and one more where the
        side runs against it; with the distance of the side's middle in units of flatness.
    t : dict
        Parameter of each point on each arc near it.
    """

    chords: Chords
    after: Index
    ways: tuple[dict[int, float], ...]
    t: dict[tuple[int, int], float]

    @classmethod
    def of(cls, points: Points, after: Index, chords: Chords) -> _Sides:
        """Place both ends and the middle of every side on the arcs near them."""
        count = len(points)
        middles = (points + points[after]) / 2
        point, arc, t, away = _places(np.concatenate([points, middles]), chords)
        split = int(np.searchsorted(point, count))
        known = zip(point[:split].tolist(), arc[:split].tolist(), strict=True)
        at = dict(zip(known, t[:split].tolist(), strict=True))
        lengths = np.linalg.norm(points[after] - points, axis=1)
        # The direction of a side so short says nothing.
        short = (lengths <= NEAR * chords.flatness.max()).tolist()
        following = after.tolist()
        ways: list[dict[int, float]] = [{} for _ in range(count)]
        middle = zip(
            (point[split:] - count).tolist(),
            arc[split:].tolist(),
            away[split:].tolist(),
            strict=True,
        )
        for side, k, distance in middle:
            start, end = at.get((side, k)), at.get((following[side], k))
            if start is None or end is None:
                continue
            if end > start or short[side]:
                ways[side][2 * k] = distance
            if end < start or short[side]:
                ways[side][2 * k + 1] = distance
        return cls(chords, after, tuple(ways), at)

    def runs(self, ring: range) -> list[Run]:
        """One ring's sides in as few runs as there can be."""
        ways = self.ways
        fresh = (
            k for k in ring if not ways[k].keys() & ways[k - 1 if k > ring[0] else ring[-1]].keys()
        )
        start = next(fresh, ring[0])
        order = [*range(start, ring.stop), *range(ring.start, start)]
        runs: list[Run] = []
        first = 0
        while first < len(order):
            shared: Collection[int] = ways[order[first]].keys()
            last = first + 1
            while last < len(order) and (left := ways[order[last]].keys() & shared):
                shared = left
                last += 1
            runs.append(self._run(order[first:last], shared))
            first = last
        return _merged(runs)

    def _run(self, sides: list[int], ways: Collection[int]) -> Run:
        if not ways:
            return Run(sides[0])
        # Two arcs that are one are equally near; rounded, as else the last digit decides.
        way = min(ways, key=lambda w: (round(sum(self.ways[side][w] for side in sides), 6), w))
        arc = way // 2
        curve = int(self.chords.curve[np.searchsorted(self.chords.arc, arc)])
        start, end = (self.t[p, arc] for p in (sides[0], int(self.after[sides[-1]])))
        return Run(sides[0], curve, arc, bool(way % 2), start, end)


def _merged(runs: list[Run]) -> list[Run]:
    """Runs along the arcs of one curve, put together."""
    kept: list[Run] = []
    for run in runs:
        if kept and _goes_on(kept[-1], run):
            kept[-1] = replace(kept[-1], arc=run.arc, end=run.end)
        else:
            kept.append(run)
    if len(kept) > 1 and _goes_on(kept[-1], runs[0]):
        last = kept.pop()
        kept[0] = replace(kept[0], point=last.point, start=last.start)
    return kept


def _goes_on(one: Run, other: Run) -> bool:
    """Whether a run is along the next arc of the same curve, in the same direction."""
    return (
        one.curve == other.curve >= 0
        and one.back == other.back
        and other.arc - one.arc == (-1 if one.back else 1)
    )


def _places(points: Points, chords: Chords) -> tuple[Index, Index, Floats, Floats]:
    """Where points lie on the arcs near them: point, arc, parameter, distance in flatnesses.

    Sorted by point, then arc, each pair once.
    """
    import shapely

    tree = shapely.STRtree(shapely.points(points))
    chord, point = tree.query(
        shapely.linestrings(chords.ends), predicate="dwithin", distance=NEAR * chords.flatness
    )
    start = chords.ends[chord, 0]
    along = chords.ends[chord, 1] - start
    offset = points[point] - start
    square = (along * along).sum(axis=1)
    share = np.clip((offset * along).sum(axis=1) / np.where(square > 0, square, 1.0), 0.0, 1.0)
    away = np.linalg.norm(offset - share[:, None] * along, axis=1) / chords.flatness[chord]
    t = chords.t[chord, 0] + share * (chords.t[chord, 1] - chords.t[chord, 0])
    arc = chords.arc[chord]
    order = np.lexsort((away, arc, point))
    point, arc, t, away = point[order], arc[order], t[order], away[order]
    first = np.concatenate([[True], (np.diff(point) > 0) | (np.diff(arc) > 0)])[: len(point)]
    return point[first], arc[first], t[first], away[first]
