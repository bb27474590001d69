"""The outline of a stroke, or a part of it, from its line and width."""

from collections.abc import Sequence
from typing import Literal

import numpy as np

from shapetween.base.arrays import Curves, Points
from shapetween.geometry.bezier import end_tangents, line_curves
from shapetween.geometry.rotation import rotations
from shapetween.model.outline import Outline
from shapetween.scene.strokes.frame import CAP, JOIN, WALL, StrokeFrame

__all__ = ["contour_part", "stroke_rings"]

Cap = Literal["butt", "round", "square"]
Join = Literal["miter", "round", "bevel"]

#: Angle, radians, that one cubic curve of a round cap or join turns through at most.
ARC = np.pi / 2

#: Ratio of a mitred corner's reach to half the width up to which it is drawn, as SVG has it.
MITRE = 4.0


def stroke_rings(line: Outline, width: float, cap: Cap, join: Join) -> tuple[Outline, ...]:
    """A stroke's outline: one ring for an open line, two for a closed one.

    Parameters
    ----------
    line : Outline
    width : float
    cap, join : str
        As SVG names them.

    Returns
    -------
    tuple of Outline
        Filled by the rule nonzero they show the stroke; they may overlap themselves where the line
        bends more sharply than its width allows.
    """
    frame = StrokeFrame(line.curves, line.closed)
    total = float(frame.zones.total)
    rings = []
    for side in (-1, 1) if line.closed else (-1,):
        curves = contour_part(frame, width / 2, 0.0, total, side, (cap, cap), join)
        rings.append(Outline(_sealed(curves, None, None, ring=True)))
    return tuple(rings)


def contour_part(
    frame: StrokeFrame,
    half: float,
    start: float,
    end: float,
    side: int,
    caps: tuple[Cap, Cap],
    join: Join,
    ends: tuple[Points, Points] | None = None,
) -> Curves:
    """A stroke's outline between two places on its contour.

    Parameters
    ----------
    frame : StrokeFrame
        At one time.
    half : float
        Half the width.
    start, end : float
        Places on the contour, `start` the smaller; beyond the last zone they go on from the first.
    side : {-1, 1}
        Which contour of a closed line.
    caps : (str, str)
        At the line's start and end.
    join : str
    ends : pair of (2,) float64, optional
        Points to start and end in, near those places.

    Returns
    -------
    (C, 4, 2) float64
        Following one another; none where the part has no length.
    """
    zones = frame.zones
    parts: list[Curves] = []
    for zone in range(int(np.floor(start)), int(np.ceil(end))):
        low, high = max(start - zone, 0.0), min(end - zone, 1.0)
        kind, curve, way = zones.of(zone % zones.total, side)
        if kind == WALL and high > low:
            parts.append(_wall(frame, half, curve, way, low, high))
        elif kind == JOIN and low == 0.0 and high == 1.0:
            parts.append(_join(frame, half, curve, way, join))
        elif kind == CAP and low == 0.0 and high == 1.0:
            parts.append(_cap(frame, half, way, caps[1 if way > 0 else 0]))
    kept = [part for part in parts if len(part)]
    curves = np.concatenate(kept) if kept else np.zeros((0, 4, 2))
    if ends is None:
        return _sealed(curves, None, None, ring=False)
    if not len(curves):
        same = bool((ends[0] == ends[1]).all())
        return np.zeros((0, 4, 2)) if same else line_curves(ends[0], ends[1])[None]
    return _sealed(curves, ends[0], ends[1], ring=False)


def _sealed(curves: Curves, start: Points | None, end: Points | None, *, ring: bool) -> Curves:
    """Curves without gaps: straight lines where one ends apart from the next, moved ends else."""
    pieces: list[Curves] = []
    size = float(np.ptp(curves.reshape(-1, 2), axis=0).max()) if len(curves) else 0.0
    chain = list(curves)
    if start is not None:
        chain = _moved_start(chain, start, size)
    for curve in chain:
        before = pieces[-1][3] if pieces else None
        if before is not None and (before != curve[0]).any():
            if np.hypot(*(before - curve[0])) > 1e-6 * size:
                pieces.append(line_curves(before, curve[0]))
                pieces[-1][0], pieces[-1][3] = before, curve[0]
            else:
                curve = np.concatenate([before[None], curve[1:]])
        pieces.append(curve)
    goal = pieces[0][0] if ring else end
    if goal is not None and (pieces[-1][3] != goal).any():
        if np.hypot(*(pieces[-1][3] - goal)) > 1e-6 * size:
            pieces.append(line_curves(pieces[-1][3], goal))
            pieces[-1][0], pieces[-1][3] = pieces[-2][3], goal
        else:
            pieces[-1] = np.concatenate([pieces[-1][:3], goal[None]])
    return np.array(pieces).reshape(-1, 4, 2)


def _moved_start(chain: Sequence[Curves], start: Points, size: float) -> list[Curves]:
    first = chain[0]
    if (first[0] == start).all():
        return list(chain)
    if np.hypot(*(first[0] - start)) > 1e-6 * size:
        line = line_curves(start, first[0])
        line[0], line[3] = start, first[0]
        return [line, *chain]
    return [np.concatenate([start[None], first[1:]]), *chain[1:]]


def _wall(
    frame: StrokeFrame, half: float, curve: int, side: int, low: float, high: float
) -> Curves:
    """A part of the wall beside one curve, (1, 4, 2), in the contour's direction."""
    offset = side * half
    head, tail = (shear[curve] for shear in frame.shears(np.full(frame.zones.count, float(side))))
    length = max(float(frame.lengths[curve]), 1e-300)
    ends = np.array([low, high]) if side < 0 else 1 - np.array([low, high])
    t = np.clip(ends + offset * ((1 - ends) * head + ends * tail) / length, 0.0, 1.0)
    index = np.full(2, curve)
    points, tangents, normals, speed, bend = frame.frames(index, t)
    corner = points + offset * normals
    pace = (t[1] - t[0]) * np.maximum(speed * (1 - bend * offset), 0.0)
    handle = tangents * pace[:, None] / 3
    return np.stack([corner[0], corner[0] + handle[0], corner[1] - handle[1], corner[1]])[None]


def _arc(centre: Points, start: Points, angle: float) -> Curves:
    """An arc of a circle about a point, from another one through an angle."""
    count = max(1, int(np.ceil(abs(angle) / ARC - 1e-9)))
    step = angle / count
    handle = 4 / 3 * np.tan(step / 4)
    spokes = np.array(
        [rotations(np.asarray(k * step)) @ (start - centre) for k in range(count + 1)]
    )
    along = np.stack([-spokes[:, 1], spokes[:, 0]], axis=1) * handle
    p = spokes + centre
    return np.stack([p[:-1], p[:-1] + along[:-1], p[1:] - along[1:], p[1:]], axis=1)


def _join(frame: StrokeFrame, half: float, curve: int, side: int, join: Join) -> Curves:
    """The outer side of a corner, in the contour's direction; nothing on the inner side."""
    turn = float(frame.turns[curve])
    if turn * side >= 0 or abs(turn) < 1e-9:
        return np.zeros((0, 4, 2))
    node = frame.curves[curve, 0]
    leaving, reaching = end_tangents(frame.curves)
    before, after = reaching[curve - 1], leaving[curve]
    sides = [side * half * np.array([-d[1], d[0]]) for d in (before, after)]
    if side > 0:
        sides, turn = sides[::-1], -turn
    start, end = node + sides[0], node + sides[1]
    if join == "round":
        return _arc(node, start, turn)
    reach = 1 / max(float(np.cos(turn / 2)), 1e-9)
    if join == "miter" and reach <= MITRE:
        middle = sides[0] + sides[1]
        tip = node + middle / max(float(np.hypot(*middle)), 1e-300) * half * reach
        return np.stack([line_curves(start, tip), line_curves(tip, end)])
    return line_curves(start, end)[None]


def _cap(frame: StrokeFrame, half: float, way: int, cap: Cap) -> Curves:
    """The cap at a line's end (1) or start (-1), in the contour's direction."""
    leaving, reaching = end_tangents(frame.curves)
    node, ahead = (
        (frame.curves[-1, 3], reaching[-1]) if way > 0 else (frame.curves[0, 0], -leaving[0])
    )
    aside = half * np.array([-ahead[1], ahead[0]])
    start, end = node - aside, node + aside
    if cap == "round":
        return _arc(node, start, np.pi)
    if cap == "butt":
        return line_curves(start, end)[None]
    corners = np.stack([start, start + half * ahead, end + half * ahead, end])
    return line_curves(corners[:-1], corners[1:])
