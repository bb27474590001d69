"""Rings that are cut open and become lines."""

import numpy as np

from shapetween.base.arrays import Points
from shapetween.geometry.bezier import sub_curves
from shapetween.model.outline import Outline
from shapetween.scene.motion.bend_knots import along_knots
from shapetween.scene.motion.mirrored import axis_crossings
from shapetween.scene.places import Pieces, Places, cut_alike, run_of

__all__ = ["closing_pieces", "opened", "opened_pieces"]

#: Starts at which a ring may be cut to become a line.
CUTS = 48

#: Shares of a ring that a line may become, the rest growing out of its ends; and what part of the
#: distance of all of it that of a part must be at most.
PARTS, PART_BETTER = (1.0, 0.85, 0.7, 0.55), 0.75


def opened_pieces(ring: Places, line: Places, flips: int) -> Pieces:
    """A ring that is cut and becomes a line, where it is nearest to it, each in its own box.

    If only a part of it is near the line, that becomes the line, and the rest goes into its ends.
    Of their own mirror images about one axis the ring is cut on it.
    """
    crossings = axis_crossings(ring, flips) if flips >= 0 else None
    mirrored = crossings is not None
    cuts = np.arange(CUTS) / CUTS if crossings is None else np.array(crossings) % 1.0
    steps = np.linspace(0.0, 1.0, 33)
    there = _in_box(line.point(steps))
    best: tuple[float, float, bool, float] | None = None
    for part in PARTS[:1] if mirrored else PARTS:
        for backwards in (False, True):
            ahead = (-1 if backwards else 1) * part * steps
            every = ring.point((cuts[:, None] + ahead).ravel()).reshape(len(cuts), -1, 2)
            costs = np.linalg.norm(_in_box(every) - there, axis=-1).mean(axis=1)
            k = int(np.round(costs, 6).argmin())
            cost = float(costs[k]) if part == 1.0 else float(costs[k]) / PART_BETTER
            if best is None or cost < best[0] - 1e-6:
                best = cost, float(cuts[k]), backwards, part
    assert best is not None
    _, start, backwards, part = best
    rest = (1 - part) / 2
    outline = opened(ring, (start + rest if backwards else start - rest) % 1.0)
    source = Places(outline.reversed() if backwards else outline)
    if part == 1.0:
        u, v, _ = along_knots(source, line, mirrored=mirrored)
        return cut_alike(source, line, u, v)
    inner = np.array([0.0, rest, 1 - rest, 1.0])
    return cut_alike(source, line, inner, np.array([0.0, 0.0, 1.0, 1.0]))


def closing_pieces(ring: Places, line: Places) -> Pieces:
    """A ring whose two sides become a line there and back, as the lids of an eye do."""
    start, end = ring.nearest(line.point(np.array([0.0, 1.0]))).tolist()
    found = []
    sides = (start, end, line), (end, start, Places(line.outline.reversed()))
    for low, high, goal in sides:
        side = Places(run_of(ring, low, high if high > low else high + 1))
        u, v, _ = along_knots(side, goal)
        found.append(cut_alike(side, goal, u, v))
    curves = [
        np.concatenate(own) for own in zip(*((p.source, p.target) for p in found), strict=True)
    ]
    for own in curves:
        own[:, 0] = np.roll(own[:, 3], 1, axis=0)
    return Pieces(curves[0], curves[1], True)


def opened(ring: Places, share: float) -> Outline:
    """A ring cut open at a share of its length."""
    where, at = ring.locate(np.array([share]))
    curve, t = int(where[0]), float(at[0])
    curves = ring.outline.curves
    if t == 0:
        return Outline(np.roll(curves, -curve, axis=0), False)
    parts = sub_curves(curves[[curve, curve]], np.array([t, 0.0]), np.array([1.0, t]))
    run = np.concatenate([parts[:1], np.roll(curves, -curve - 1, axis=0)[:-1], parts[1:]])
    run[1:, 0] = run[:-1, 3]
    return Outline(run, False)


def _in_box(points: Points) -> Points:
    low, high = points.min(axis=-2, keepdims=True), points.max(axis=-2, keepdims=True)
    size = (high - low).max(axis=-1, keepdims=True)
    return np.asarray((points - (low + high) / 2) / np.where(size > 0, size, 1.0))
