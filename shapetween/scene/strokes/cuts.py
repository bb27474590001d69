"""A stroke's outline cut with its line: rings cut open, lines cut in two."""

from collections.abc import Sequence

import numpy as np

from shapetween.base.arrays import Curves, Points
from shapetween.geometry.bezier import end_tangents, line_curves, sub_curves
from shapetween.model.outline import Outline
from shapetween.scene.places import Places
from shapetween.scene.strokes.frame import StrokeFrame
from shapetween.scene.strokes.walk import walk_of

__all__ = ["opened_ring", "parted_ring"]

#: Distance from a joint, as a share of a ring's length, at which it is cut there.
AT_JOINT = 1e-3


def opened_ring(line: Outline, rings: Sequence[Outline]) -> Outline | None:
    """One ring that shows what two do, with a slit of no width where the line starts and ends.

    Parameters
    ----------
    line : Outline
        Open, but its ends meet.
    rings : sequence of Outline
        Inside and outside of it.

    Returns
    -------
    Outline or None
        None if it does not follow the line.
    """
    start = line.curves[0, 0]
    ahead = end_tangents(line.curves[0])[0]
    across = np.array([-ahead[1], ahead[0]])
    sides = []
    for ring in rings:
        point = _crossing(ring, start)
        sides.append((float((point - start) @ across), _cut(ring, point)))
    (_, left), (_, right) = sorted(sides, key=lambda side: side[0])
    # The left wall runs along the line, the right one back.
    left = left if _along(left, ahead) else left[::-1, ::-1]
    right = right[::-1, ::-1] if _along(right, ahead) else right
    bridges = line_curves(left[-1, 3], right[0, 0]), line_curves(right[-1, 3], left[0, 0])
    curves = np.concatenate([left, bridges[0][None], right, bridges[1][None]])
    curves[1:, 0] = curves[:-1, 3]
    curves[0, 0] = curves[-1, 3]
    whole = Outline(curves)
    frame = StrokeFrame(line.curves, closed=False)
    return whole if walk_of(frame, whole) is not None else None


def _crossing(ring: Outline, start: Points) -> Points:
    places = Places(ring)
    return np.asarray(places.point(places.nearest(start[None]))[0])


def _cut(ring: Outline, point: Points) -> Curves:
    """The curves of a ring from a point of it round to that point."""
    places = Places(ring)
    share = places.nearest(point[None])
    joint = int(np.abs(places.joints - share).argmin())
    if abs(places.joints[joint] - share[0]) < AT_JOINT:
        share = places.joints[joint : joint + 1] % 1.0
    where, at = places.locate(share)
    k, t = int(where[0]), float(at[0])
    curves = ring.curves
    if t == 0:
        return np.roll(curves, -k, axis=0)
    halves = sub_curves(curves[[k, k]], np.array([t, 0.0]), np.array([1.0, t]))
    run = np.concatenate([halves[:1], np.roll(curves, -k - 1, axis=0)[:-1], halves[1:]])
    run[1:, 0] = run[:-1, 3]
    return run


def _along(curves: Curves, ahead: Points) -> bool:
    return float(end_tangents(curves[0])[0] @ ahead) > 0


def parted_ring(line: Outline, ring: Outline, node: int) -> tuple[Outline, Outline] | None:
    """The rings round both parts of an open line, straight where it is cut.

    Parameters
    ----------
    line : Outline
    ring : Outline
        Round all of it.
    node : int
        The line is cut before this curve.

    Returns
    -------
    pair of Outline, or None
        Round what comes before and round the rest; None if the ring does not follow the line.
    """
    walk = walk_of(StrokeFrame(line.curves, closed=False), ring)
    if walk is None:
        return None
    count = len(line.curves)
    # The left wall at the cut and the right one: places on the contour.
    left, right = float(2 * node), float(4 * count - 2 * node - 1)
    places = walk.at(np.array([left, right, left + walk.total]))
    found = []
    for low, high in ((places[1], places[2]), (places[0], places[1])):
        run = _between(walk.curves, float(low), float(high))
        bridge = line_curves(run[-1, 3], run[0, 0])
        bridge[0], bridge[3] = run[-1, 3], run[0, 0]
        found.append(Outline(np.concatenate([run, bridge[None]])))
    return found[0], found[1]


def _between(curves: Curves, low: float, high: float) -> Curves:
    """A ring's curves between two places, each a curve and a parameter in one number."""
    cuts = np.unique(np.concatenate([[low], np.arange(np.ceil(low), np.floor(high) + 1), [high]]))
    first = np.floor(cuts[:-1])
    index = first.astype(np.intp) % len(curves)
    parts = sub_curves(curves[index], cuts[:-1] - first, cuts[1:] - first)
    parts[1:, 0] = parts[:-1, 3]
    return parts
