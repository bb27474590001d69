"""Lines cut where what they lie on changes, so that what lies together becomes each other.

One drawing's lines follow an outline in other stretches than another's: the back of a cat is one
line, and lies where the fox has an ear, a brow and another ear. Once the first drawing is brought
onto the second, stretches of lines that lie on each other become each other; the rest comes and
goes.
"""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from shapetween.base.arrays import Floats, Index, Points
from shapetween.elastic.flow import Flow
from shapetween.elastic.naming import common_names
from shapetween.elastic.pairing import Settled
from shapetween.model.arclength import ArcLength
from shapetween.model.drawing import Shape
from shapetween.model.outline import Outline
from shapetween.model.paint import Gradient
from shapetween.outline.matched import cut_curves

__all__ = ["share_lines"]

#: Distance between stations on lines, and of two stretches up to which they lie on each other, as
#: shares of the drawing.
STEP, NEAR = 0.012, 0.05

#: Cosine of the angle between two lines from which on they run alike.
ALIKE = 0.7

#: Least length of a stretch that becomes another, and of what is left beside it, as a share of the
#: drawing; shorter rests go with their neighbours.
LEAST, REST = 0.07, 0.05

#: Stations that one line may skip while the other goes on by one.
SKIP = 4

#: Share of a line that shared stretches cover for it to be cut; less, and it moves as a whole.
COVERED = 0.4

#: Share of both lines from which on they are one and stay whole; and where neither shares anything
#: with another line.
WHOLE, WHOLE_ALONE = 0.7, 0.5

#: Stations of one drawing past which nothing is cut.
MOST_STATIONS = 2500


@dataclass(frozen=True, slots=True, eq=False)
class _Line:
    """A line with stations at even lengths, where both drawings lie on each other.

    Attributes
    ----------
    shape : int
    outline : Outline
    shares : (N,) float64
        Of its length.
    points, ways : (N, 2) float64
        Where the stations are, and the direction there.
    length : float
    """

    shape: int
    outline: Outline
    shares: Floats
    points: Points
    ways: Points
    length: float


@dataclass(frozen=True, slots=True)
class _Stretch:
    """Parts of two lines that lie on each other, as shares of their lengths.

    Attributes
    ----------
    lines : (int, int)
    spans : ((float, float), (float, float))
    """

    lines: tuple[int, int]
    spans: tuple[tuple[float, float], tuple[float, float]]


def share_lines(
    first: Sequence[Shape],
    second: Sequence[Shape],
    flow: Flow,
    settled: Sequence[tuple[int, int]],
) -> Settled:
    """Cut lines of two drawings into stretches that become each other, and what is left of them.

    Only where a silhouette moves: its plane lays one drawing on the other.

    Parameters
    ----------
    first, second : sequence of Shape
        In paint order and one frame.
    flow : Flow
        Brings the first drawing's shapes onto the second's.
    settled : sequence of (int, int)
        Shapes that become each other anyway, and are not cut; nor are those of one name.
    """
    same = tuple(first), tuple(second), tuple(settled)
    if not flow.bodies:
        return same
    extent = max(lane.extents[1] for lane in flow.lanes)
    kept = common_names(first, second)
    sides = []
    for end, shapes in enumerate((first, second)):
        whole = {pair[end] for pair in settled}
        sides.append(
            [
                _line(k, shape.rings[0], flow if end == 0 else None, extent)
                for k, shape in enumerate(shapes)
                if k not in whole and shape.name not in kept and _may_be_cut(shape)
            ]
        )
    if not all(sides) or max(sum(len(x.shares) for x in side) for side in sides) > MOST_STATIONS:
        return same
    stretches = _worth_cutting(_chosen(sides, extent), sides)
    if not stretches:
        return same
    cuts = [_pieces(side, stretches, end, extent) for end, side in enumerate(sides)]
    return _cut((first, second), settled, sides, cuts, stretches)


def _may_be_cut(shape: Shape) -> bool:
    """Whether a shape is one line of which no cut is seen: round, opaque and without dashes."""
    stroke = shape.style.stroke
    if shape.style.fill is not None or stroke is None or len(shape.rings) > 1 or stroke.dashes:
        return False
    if not np.ptp(shape.rings[0].box, axis=0).any():
        return False
    if isinstance(stroke.paint, Gradient) or stroke.paint.alpha * shape.style.opacity < 1:
        return False
    return stroke.cap == stroke.join == "round"


def _line(shape: int, outline: Outline, flow: Flow | None, extent: float) -> _Line:
    """A line's stations, brought along by a flow if there is one."""
    place = ArcLength(outline)
    count = max(8, round(place.length / (STEP * extent)))
    shares = (np.arange(count) + 0.5) / count
    points = place.point(shares)
    if flow is not None:
        low, high = outline.box
        middle = (low + high) / 2
        if flow.carries(middle):
            points = flow.lane(middle, None).plane.hold(points, False).at(np.ones(1))[0]
    steps = np.gradient(points, axis=0)
    sizes = np.linalg.norm(steps, axis=1)
    ways = steps / np.where(sizes > 0, sizes, 1.0)[:, None]
    return _Line(shape, outline, shares, points, ways, float(sizes.sum()))


def _chosen(sides: Sequence[Sequence[_Line]], extent: float) -> list[_Stretch]:
    """Stretches of two drawings' lines that lie on each other, the longest first; none overlap."""
    runs = []
    near = NEAR * extent
    boxes = [
        np.array([[line.points.min(axis=0), line.points.max(axis=0)] for line in side])
        for side in sides
    ]
    meet = boxes[0][:, None, 0] <= boxes[1][:, 1] + near
    meet &= boxes[1][:, 0] <= boxes[0][:, None, 1] + near
    for i, j in np.argwhere(meet.all(axis=2)).tolist():
        found = _runs(sides[0][i], sides[1][j], near)
        runs += [(i, j, stations, there) for stations, there in found]
    free = [[np.ones(len(line.shares), dtype=bool) for line in side] for side in sides]
    # The longest first; of each the longest stretch that none has taken yet.
    runs.sort(key=lambda run: -len(run[2]))
    stretches = []
    for i, j, stations, there in runs:
        open_ = free[0][i][stations] & free[1][j][there]
        edges = np.flatnonzero(np.diff(np.concatenate([[False], open_, [False]]).astype(np.int8)))
        if not len(edges):
            continue
        k = int(np.diff(edges)[::2].argmax()) * 2
        some = slice(int(edges[k]), int(edges[k + 1]))
        ends = [(int(x[some].min()), int(x[some].max()) + 1) for x in (stations, there)]
        lines = sides[0][i], sides[1][j]
        spans = [
            (low / len(line.shares), high / len(line.shares))
            for (low, high), line in zip(ends, lines, strict=True)
        ]
        lengths = [(b - a) * line.length for (a, b), line in zip(spans, lines, strict=True)]
        if min(lengths) < LEAST * extent or max(lengths) > 2 * min(lengths):
            continue
        for side, line, (low, high) in zip(free, (i, j), ends, strict=True):
            side[line][low:high] = False
        stretches.append(_Stretch((i, j), (spans[0], spans[1])))
    return stretches


def _runs(one: _Line, other: _Line, near: float) -> list[tuple[Index, Index]]:
    """Runs of stations of a line that lie beside one run of another's, either way along it."""
    away = np.linalg.norm(one.points[:, None] - other.points, axis=2)
    away[np.abs(one.ways @ other.ways.T) < ALIKE] = np.inf
    there = away.argmin(axis=1)
    beside = away[np.arange(len(there)), there] <= near
    steps = np.diff(there)
    way = np.sign(steps)
    way = way[np.maximum.accumulate(np.where(way != 0, np.arange(len(way)), 0))]
    breaks = (np.abs(steps) > SKIP) | ~(beside[1:] & beside[:-1])
    breaks[1:] |= way[1:] * way[:-1] < 0
    parts = np.split(np.arange(len(there)), np.flatnonzero(breaks) + 1)
    runs = []
    for part in parts:
        # Past the other's end all of the rest is nearest to that end.
        ahead = np.flatnonzero(there[part] != there[part[0]])
        back = np.flatnonzero(there[part] != there[part[-1]])
        if len(ahead) and beside[part].all():
            kept = part[ahead[0] - 1 : back[-1] + 2]
            runs.append((kept, there[kept]))
    return runs


def _worth_cutting(
    stretches: Sequence[_Stretch], sides: Sequence[Sequence[_Line]]
) -> list[_Stretch]:
    """Without those of lines that are one with another line, or share too little."""
    pairs: dict[tuple[int, int], list[float]] = {}
    for stretch in stretches:
        total = pairs.setdefault(stretch.lines, [0.0, 0.0])
        for end, (low, high) in enumerate(stretch.spans):
            total[end] += high - low
    partners = Counter((end, pair[end]) for pair in pairs for end in (0, 1))
    one = set()
    for pair, total in pairs.items():
        ends = {(end, pair[end]) for end in (0, 1)}
        # Where neither has anyone else, less is enough: what is cut off would come and go.
        alone = all(partners[end] == 1 for end in ends)
        if min(total) >= (WHOLE_ALONE if alone else WHOLE):
            one |= ends
    left = [s for s in stretches if not any((end, s.lines[end]) in one for end in (0, 1))]
    while True:
        covered = [[0.0] * len(side) for side in sides]
        for stretch in left:
            for end, (low, high) in enumerate(stretch.spans):
                covered[end][stretch.lines[end]] += high - low
        enough = [s for s in left if all(covered[k][s.lines[k]] >= COVERED for k in (0, 1))]
        if len(enough) == len(left):
            return left
        left = enough


_Piece = tuple[float, float, int | None]
"""From where to where along a line, as shares of its length, and which stretch it is, if any."""


def _pieces(
    side: Sequence[_Line], stretches: Sequence[_Stretch], end: int, extent: float
) -> dict[int, list[_Piece]]:
    """What each line that shares something is cut into, by number of the line."""
    spans: dict[int, list[tuple[float, float, int]]] = {}
    for number, stretch in enumerate(stretches):
        spans.setdefault(stretch.lines[end], []).append((*stretch.spans[end], number))
    result = {}
    for k, known in spans.items():
        known.sort()
        short = REST * extent / side[k].length
        bounds = [[low, high] for low, high, _ in known]
        if bounds[0][0] < short:
            bounds[0][0] = 0.0
        if bounds[-1][1] > 1 - short:
            bounds[-1][1] = 1.0
        for before, after in pairwise(bounds):
            if after[0] - before[1] < short:
                before[1] = after[0] = (before[1] + after[0]) / 2
        pieces: list[_Piece] = []
        reached = 0.0
        for (low, high), (_, _, number) in zip(bounds, known, strict=True):
            if low > reached:
                pieces.append((reached, low, None))
            pieces.append((low, high, number))
            reached = high
        if reached < 1:
            pieces.append((reached, 1.0, None))
        result[k] = pieces
    return result


def _cut(
    shapes: tuple[Sequence[Shape], Sequence[Shape]],
    settled: Sequence[tuple[int, int]],
    sides: Sequence[Sequence[_Line]],
    cuts: Sequence[dict[int, list[_Piece]]],
    stretches: Sequence[_Stretch],
) -> Settled:
    """Both drawings' shapes with their lines in pieces."""
    made: list[tuple[Shape, ...]] = []
    places: list[dict[int, int]] = []
    of_stretch: list[dict[int, int]] = []
    for every, lines, cut in zip(shapes, sides, cuts, strict=True):
        pieces = {lines[k].shape: (lines[k].outline, some) for k, some in cut.items()}
        fresh: list[Shape] = []
        place, stretch = {}, {}
        for k, shape in enumerate(every):
            place[k] = len(fresh)
            if k not in pieces:
                fresh.append(shape)
                continue
            outline, some = pieces[k]
            for n, (ring, (_, _, number)) in enumerate(
                zip(_apart(outline, some), some, strict=True)
            ):
                if number is not None:
                    stretch[number] = len(fresh)
                name = shape.name if n == 0 else ""
                fresh.append(shape if len(some) == 1 else replace(shape, rings=(ring,), name=name))
        made.append(tuple(fresh))
        places.append(place)
        of_stretch.append(stretch)
    pairs = [(places[0][i], places[1][j]) for i, j in settled]
    pairs += [(of_stretch[0][n], of_stretch[1][n]) for n in range(len(stretches))]
    return made[0], made[1], tuple(pairs)


def _apart(outline: Outline, pieces: Sequence[_Piece]) -> list[Outline]:
    """A line cut into pieces, one after another."""
    if len(pieces) == 1:
        return [outline]
    place = ArcLength(outline)
    bounds = np.array([low for low, _, _ in pieces])
    every = np.union1d(place.joints, bounds)
    places = np.array(place.locate(every), dtype=np.float64)
    curves = cut_curves(outline.curves, places, closed=False)
    starts = np.searchsorted(every, bounds)
    return [Outline(part, closed=False) for part in np.split(curves, starts[1:])]
