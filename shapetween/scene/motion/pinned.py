"""Pins: points of a pair that belong together, whatever its forms say."""

import numpy as np

from shapetween.base.arrays import Floats, Points
from shapetween.model.outline import Outline
from shapetween.scene.items import Item
from shapetween.scene.motion.bend_knots import along_knots, ring_knots
from shapetween.scene.motion.opening import opened
from shapetween.scene.places import Pieces, Places, cut_alike
from shapetween.scene.relations import Scene

__all__ = ["pinned_items", "pinned_pieces"]

#: Distance of a pin from the line or outline that it belongs to, as a share of that one's extent.
REACH = 0.05


def pinned_items(pins: Points, a: Scene, b: Scene) -> dict[int, tuple[int, int]]:
    """The items that each pin lies on, the nearest ones; pins that lie on none are left out."""
    found = {}
    for k, pin in enumerate(pins):
        ends = _nearest(a, pin[:2]), _nearest(b, pin[2:])
        if ends[0] is not None and ends[1] is not None:
            found[k] = ends[0], ends[1]
    return found


def _nearest(scene: Scene, point: Points) -> int | None:
    best: tuple[float, int] | None = None
    for k, item in enumerate(scene.items):
        for ring in item.rings:
            places = Places(ring)
            there = places.point(places.nearest(point[None]))[0]
            away = float(np.hypot(*(there - point)))
            reach = REACH * item.extent + item.width / 2
            if away <= reach and (best is None or away < best[0] - 1e-9 * scene.scale):
                best = away, k
    return None if best is None else best[1]


def pinned_pieces(first: Item, second: Item, pins: Points, free: Pieces | None = None) -> Pieces:
    """Outer rings or lines cut alike so that pins (K, 4) become each other.

    Of rings the rest goes as `free` says, the pieces without pins, if they are given.
    """
    source, target = Places(first.outer.clockwise()), Places(second.outer.clockwise())
    pu, pv = source.nearest(pins[:, :2]), target.nearest(pins[:, 2:])
    if first.closed and second.closed:
        u, v = _knots_of(free, source, target) if free is not None else ring_knots(source, target)
        at = np.interp(u[0] + (pu[:1] - u[0]) % 1.0, u, v)
        v = v + float(pv[0] - at[0])
        return cut_alike(source, target, *_through(u, v, pu, pv, closed=True))
    if not first.closed and not second.closed:
        wanted = [float(np.abs(pu - pv).sum()), float(np.abs(pu - (1 - pv)).sum())]
        if wanted[1] < wanted[0]:
            target = Places(second.outer.reversed())
            pv = 1 - pv
        u, v, _ = along_knots(source, target)
        return cut_alike(source, target, *_through(u, v, pu, pv, closed=False))
    ring, line, on, to = (source, target, pu, pv) if first.closed else (target, source, pv, pu)
    costs = []
    for sign in (1.0, -1.0):
        cut = float(on[0] - sign * to[0])
        rest = (sign * (on - cut)) % 1.0 - to
        costs.append((round(float(np.abs(rest).sum()), 9), sign < 0, cut % 1.0))
    _, backwards, cut = min(costs)
    outline = opened(ring, cut)
    run = Places(outline.reversed() if backwards else outline)
    even = np.array([0.0, 1.0])
    pieces = cut_alike(run, line, even, even)
    return pieces if first.closed else Pieces(pieces.target, pieces.source, False)


def _knots_of(pieces: Pieces, source: Places, target: Places) -> tuple[Floats, Floats]:
    """Places of the ends of pieces on the two rings that they are cut from, a turn of them."""
    found = []
    for curves, places in ((pieces.source, source), (pieces.target, target)):
        run = Places(Outline(curves, True)).joints
        found.append(float(places.nearest(curves[:1, 0])[0]) + run)
    return found[0], found[1]


def _through(
    u: Floats, v: Floats, pu: Floats, pv: Floats, *, closed: bool
) -> tuple[Floats, Floats]:
    """Knots bent so that they go through pins; those that would cross others are left out."""
    if closed:
        pu = u[0] + (pu - u[0]) % 1.0
        image = np.interp(pu, u, v)
        pv = image + (pv - image + 0.5) % 1.0 - 0.5
    else:
        pu = np.where(pu < 1e-6, 0.0, np.where(pu > 1 - 1e-6, 1.0, pu))
    kept: list[tuple[float, float]] = []
    for pair in zip(pu.tolist(), pv.tolist(), strict=True):
        if all((pair[0] - p) * (pair[1] - q) > 0 for p, q in kept):
            kept.append(pair)
    kept.sort()
    at, to = np.array(kept).T
    shift = to - np.interp(at, u, v)
    if closed:
        around = np.concatenate([at[-1:] - 1, at, at[:1] + 1])
        offsets = np.concatenate([shift[-1:], shift, shift[:1]])
    else:
        around = np.concatenate([[-1e-9], at, [1 + 1e-9]])
        offsets = np.concatenate([[0.0], shift, [0.0]])
    both = np.unique(np.concatenate([u, at]))
    bent = np.maximum.accumulate(np.interp(both, u, v) + np.interp(both, around, offsets))
    for p, q in kept:
        k = int(np.searchsorted(both, p))
        bent[:k] = np.minimum(bent[:k], q)
        bent[k:] = np.maximum(bent[k:], q)
        bent[k] = q
    if closed:
        bent[-1] = bent[0] + 1.0
        return both, np.minimum(bent, bent[-1])
    bent[0], bent[-1] = 0.0, 1.0
    return both, np.clip(bent, 0.0, 1.0)
