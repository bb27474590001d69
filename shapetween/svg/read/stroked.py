"""The outline of what a stroke paints, in curves: for strokes under a transform that is uneven.

A stroke is as wide everywhere, so that one which is stretched along one way is no stroke any more.
Its outline is put together in the coordinates that it is drawn in: a piece beside each part of a
curve, one at each join and cap, and all of them united (as strokes are defined, [SVG2]_).

.. [SVG2] *Scalable Vector Graphics 2*, section 13.5.6, computing the shape of the stroke.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from shapetween.base.arrays import Curves, Floats, Points
from shapetween.boolean.chords import chords_of
from shapetween.boolean.trace import traced
from shapetween.geometry.bezier import curve_lengths, end_tangents, line_curves, sub_curves
from shapetween.geometry.polygon import cross
from shapetween.model.outline import Outline
from shapetween.model.paint import Stroke

__all__ = ["MOST_PIECES", "stroke_rings"]

#: Pieces that a stroke's outline is put together from. More take seconds.
MOST_PIECES = 4000

#: Radians that a part of a curve turns by. Larger and what is beside it is no cubic.
TURN = np.pi / 6

#: Area of a ring, in squares of the stroke's width, up to which it is what rounding leaves between
#: two pieces. Larger and holes that are seen are filled.
SLIVER = 1e-6

#: Most parts of a curve, which only hooks need.
MOST_PARTS = 16

#: Handle of a quarter of a unit circle that touches it in its middle.
_QUARTER = 4 / 3 * (np.sqrt(2) - 1)


def stroke_rings(lines: Sequence[Outline], stroke: Stroke) -> tuple[Outline, ...] | None:
    """The rings round what a stroke paints, to be filled by the rule nonzero.

    Parameters
    ----------
    lines : sequence of Outline
    stroke : Stroke
        In the lines' units.

    Returns
    -------
    tuple of Outline or None
        None if there are more pieces than `MOST_PIECES`.
    """
    import shapely

    pieces: list[Outline] = []
    for line in lines:
        parts = _dashed(line, stroke) if stroke.dashes else [line]
        if parts is None:
            return None
        for part in parts:
            pieces += _pieces(part, stroke)
            if len(pieces) > MOST_PIECES:
                return None
    if not pieces:
        return ()
    chords = chords_of(pieces)
    areas = shapely.make_valid(
        np.array([shapely.Polygon(line) for line in chords.polylines]),
        method="structure",
        keep_collapsed=False,
    )
    found = traced(shapely.union_all(areas), chords)
    least = SLIVER * stroke.width**2
    return tuple(ring for rings in found for ring in rings if abs(ring.area) > least)


def _pieces(line: Outline, stroke: Stroke) -> Iterator[Outline]:
    """Closed pieces whose union is what the stroke paints of one line."""
    half = stroke.width / 2
    curves = line.curves[np.ptp(line.curves, axis=1).max(axis=1) > 0]
    if not len(curves):
        yield from _dot(line.curves[0, 0], half, stroke.cap)
        return
    leaving, reaching = end_tangents(curves)
    for curve, first, last in zip(curves, leaving, reaching, strict=True):
        yield from _sides(curve, first, last, half)
    joints = list(zip(curves[:-1, 3], reaching[:-1], leaving[1:], strict=True))
    if line.closed:
        joints.append((curves[-1, 3], reaching[-1], leaving[0]))
    for point, before, after in joints:
        yield from _join(point, before, after, half, stroke)
    if not line.closed:
        for point, outward in ((curves[0, 0], -leaving[0]), (curves[-1, 3], reaching[-1])):
            if stroke.cap == "round":
                yield _disc(point, half)
            elif stroke.cap == "square":
                aside = half * _left(outward)
                beyond = point + half * outward
                yield _polygon(point + aside, beyond + aside, beyond - aside, point - aside)


def _dot(point: Points, half: float, cap: str) -> Iterator[Outline]:
    """What is painted of a line of no length."""
    if cap == "round":
        yield _disc(point, half)
    elif cap == "square":
        yield _polygon(*(point + half * np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]])))


def _sides(curve: Curves, first: Points, last: Points, half: float) -> Iterator[Outline]:
    """What lies beside a curve, part by part, (4, 2) with its directions at both ends."""
    arms = np.diff(curve, axis=0)
    bends = np.arctan2(cross(arms[:-1], arms[1:]), (arms[:-1] * arms[1:]).sum(axis=-1))
    count = int(np.clip(np.ceil(np.abs(bends).sum() / TURN), 1, MOST_PARTS))
    t = np.arange(count + 1) / count
    parts = sub_curves(np.repeat(curve[None], count, axis=0), t[:-1], t[1:])
    parts[1:, 0] = parts[:-1, 3]
    ways = np.concatenate([first[None], end_tangents(parts)[1][:-1], last[None]])
    aside = half * _left(ways)
    for k, part in enumerate(parts):
        if count == 1 and not bends.any():
            yield _polygon(
                part[0] + aside[0], part[3] + aside[1], part[3] - aside[1], part[0] - aside[0]
            )
            continue
        there = _beside(part, ways[k : k + 2], aside[k : k + 2], half)
        back = _beside(part, ways[k : k + 2], -aside[k : k + 2], -half)[::-1]
        ends = line_curves(there[3], back[0]), line_curves(back[3], there[0])
        yield Outline(np.stack([there, ends[0], back, ends[1]]))


def _beside(part: Curves, ways: Points, aside: Points, away: float) -> Curves:
    """The curve at a distance from one that turns little: its ends, and directions and pace there.

    The pace along an offset is (1 - curvature * distance) times that of the curve.
    """
    start, end = part[0] + aside[0], part[3] + aside[1]
    reach = part[1] - part[0], part[3] - part[2]
    middle = part[2] - part[1]
    handles = []
    for arm, other, way in ((reach[0], middle, ways[0]), (reach[1], middle, ways[1])):
        length = float(np.hypot(*arm))
        turn = float(cross(arm, other)) if arm is reach[0] else float(cross(other, arm))
        bend = 2 / 3 * turn / length**3 if length > 0 else 0.0
        handles.append(length * max(1 - bend * away, 0.0) * way)
    return np.stack([start, start + handles[0], end - handles[1], end])


def _join(
    point: Points, before: Points, after: Points, half: float, stroke: Stroke
) -> Iterator[Outline]:
    """What is painted at a corner, outside of what lies beside its curves."""
    turn = float(np.arctan2(cross(before, after), before @ after))
    if turn == 0:
        return
    if stroke.join == "round":
        yield _disc(point, half)
        return
    outward = -np.sign(turn) * half
    one, other = point + outward * _left(before), point + outward * _left(after)
    within = np.cos(turn / 2)  # one over how far a miter reaches, in half widths
    if stroke.join == "miter" and within * stroke.miter_limit >= 1:
        tip = point + outward * (_left(before) + _left(after)) / (2 * within**2)
        yield _polygon(point, one, tip, other)
    else:
        yield _polygon(point, one, other)


def _left(ways: Points) -> Points:
    return np.stack([-ways[..., 1], ways[..., 0]], axis=-1)


def _polygon(*corners: Points) -> Outline:
    points = np.stack(corners)
    return Outline(line_curves(points, np.roll(points, -1, axis=0)))


def _disc(centre: Points, radius: float) -> Outline:
    out = np.array([[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]])
    to, along = np.roll(out, -1, axis=0), _QUARTER
    return Outline(centre + radius * np.stack([out, out + along * to, to + along * out, to], 1))


def _dashed(line: Outline, stroke: Stroke) -> list[Outline] | None:
    """The dashes of a line, each an open line; None if there are too many."""
    pattern = np.array(stroke.dashes)
    period = float(pattern.sum())
    curves = line.curves
    lengths = curve_lengths(curves)
    along = np.concatenate([[0.0], np.cumsum(lengths)])
    total = float(along[-1])
    if period <= 0:
        return [line]
    if total / period * len(pattern) > MOST_PIECES:
        return None
    dashes = []
    phase = stroke.dash_offset % period
    edges = np.cumsum(np.concatenate([[0.0], pattern]))
    for turn in range(int(np.floor((total + phase) / period)) + 1):
        for start, end in zip(edges[:-1:2], edges[1::2], strict=True):
            low, high = start + turn * period - phase, end + turn * period - phase
            if (high > 0 and low < total) or 0 <= low == high <= total:
                dashes.append(_run(curves, along, max(low, 0.0), min(high, total)))
    return dashes


def _run(curves: Curves, along: Floats, low: float, high: float) -> Outline:
    """The part of a line between two lengths along it."""
    first, last = (
        int(np.clip(np.searchsorted(along, s, side="right") - 1, 0, len(curves) - 1))
        for s in (low, high)
    )
    picked = curves[first : last + 1]
    start, end = np.zeros(len(picked)), np.ones(len(picked))
    start[0] = _parameter(curves[first], low - along[first])
    end[-1] = _parameter(curves[last], high - along[last])
    return Outline(sub_curves(picked, start, end), closed=False)


def _parameter(curve: Curves, length: float) -> float:
    """The parameter at a length along one curve."""
    t = np.linspace(0.0, 1.0, 33)
    steps = curve_lengths(np.repeat(curve[None], 32, axis=0), t[:-1], t[1:])
    return float(np.interp(length, np.concatenate([[0.0], np.cumsum(steps)]), t))
