"""What is left of a line that is retracted: a share of it, about a place that stays."""

import numpy as np

from shapetween.base.arrays import Curves, Floats, Index, Points
from shapetween.geometry.bezier import derivatives, end_tangents, line_curves, sub_curves
from shapetween.scene.places import Places

__all__ = ["shortened"]

#: Share of a line's length that lines without any length are given, for their direction. Larger and
#: they are seen; smaller and their direction is lost in rounding.
SHORTEST = 1e-5


def shortened(places: Places, left: Floats, kept: float) -> Curves:
    """A share (F,) of a line of N curves about a share of its length that stays, (F, N, 4, 2).

    What is cut off lies at the ends of what is left as lines too short to be seen, which go on in
    its direction: an outline that follows the line has caps there, and a point has no direction.
    """
    left = np.maximum(left, SHORTEST)
    low, high = kept * (1 - left), 1 - (1 - kept) * (1 - left)
    curves = places.outline.curves
    count = len(curves)
    first, begin = places.locate(low)
    last, end = places.locate(high)
    index = np.arange(count)
    start = np.where(
        index < first[:, None], 1.0, np.where(index > first[:, None], 0.0, begin[:, None])
    )
    stop = np.where(index < last[:, None], 1.0, np.where(index > last[:, None], 0.0, end[:, None]))
    whole_end = high >= 1.0
    stop[whole_end] = 1.0
    repeated = np.broadcast_to(curves, (len(left), *curves.shape)).reshape(-1, 4, 2)
    parts = sub_curves(repeated, start.ravel(), np.maximum(stop, start).ravel())
    parts = parts.reshape(len(left), count, 4, 2)
    last = np.minimum(last, count - 1)
    frames = np.arange(len(left))
    leaving = _directions(curves[first], begin)[:, None]
    reaching = _directions(curves[last], np.where(whole_end, 1.0, end))[:, None]
    step = SHORTEST * places.length
    gone = stop <= start
    # How many such lines there are from what is left to the far end of each.
    over = first[:, None] - index + gone[frames, first][:, None]
    beyond = index - last[:, None] + gone[frames, last][:, None]
    head, tail = parts[frames, first, 0][:, None], parts[frames, last, 3][:, None]

    def out(place: Points, count: Index, way: Points) -> Points:
        return np.asarray(place + count[..., None] * step * way)

    heads = line_curves(out(head, -over, leaving), out(head, 1 - over, leaving))
    tails = line_curves(out(tail, beyond - 1, reaching), out(tail, beyond, reaching))
    before, after = gone & (index <= first[:, None]), gone & (index >= last[:, None])
    parts = np.where(before[..., None, None], heads, parts)
    return np.where(after[..., None, None], tails, parts)


def _directions(curves: Curves, at: Floats) -> Points:
    """Unit directions of curves (F, 4, 2) at a parameter each, (F, 2)."""
    velocity = derivatives(curves, at[:, None])[:, 0]
    speed = np.sqrt((velocity**2).sum(axis=1))[:, None]
    size = np.abs(np.diff(curves, axis=1)).max(axis=(1, 2))[:, None]
    leaving, reaching = end_tangents(curves)
    ends = np.where(at[:, None] < 0.5, leaving, reaching)
    moves = speed > 1e-9 * size
    return np.asarray(np.where(moves, velocity / np.where(moves, speed, 1.0), ends))
