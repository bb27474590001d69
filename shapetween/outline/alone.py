"""Moving one body in a plane of its own; where its strands would cross they are parted."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import islice

import numpy as np

from shapetween.base.observe import Observer
from shapetween.deform.schedule import CHECKED_TIMES
from shapetween.geometry.polygon import polygon_area
from shapetween.outline.body import Carried, RingMatch
from shapetween.outline.even import evened
from shapetween.outline.fairing import faired
from shapetween.outline.matching import next_matches
from shapetween.outline.seen import NOT_SEEN, seen_crossings
from shapetween.outline.straight import straightened
from shapetween.outline.unfold import DETAIL_TIMES, MOST_NODES, TOLERANCES, unfolded

__all__ = ["looked_at", "moved_alone"]

#: Next best matchings tried where the best one is seen to cross. More cost seconds.
OTHER_MATCHINGS = 2

#: How many times the best matching's cost another one may cost that is taken because it does not
#: cross. What means something is worth more than what is hardly seen: more, and an eagle turns a
#: quarter to become a bat; 1, and no tie is ever decided by it.
LITTLE_MORE = 1.05

#: Frames in which crossings are looked at, of those that have any. Fewer miss the worst.
LOOKED = 8


def moved_alone(
    rings: Sequence[RingMatch],
    method: str,
    quads: int | None,
    observe: Observer,
    *,
    rough: bool,
    decided: bool,
) -> Carried:
    """Move one body.

    Parameters
    ----------
    rings : sequence of RingMatch
        The outer ring and its holes.
    method : str
    quads : int or None
    observe : Observer
    rough : bool
        Whether it has so many curves that one setting is all there is time for.
    decided : bool
        Whether its matching is what the user asked for.
    """
    outer, holes = rings[0], rings[1:]
    body = unfolded(rings, method, TOLERANCES[:1] if rough else TOLERANCES)
    best = looked_at(straightened(evened(faired(body))))
    if rough or outer.coarse or best.seen.nothing:
        return best
    from shapetween.outline.parting import parted

    # Strands that touch say nothing against a matching.
    without = parted(best)
    if without is not None:
        return replace(without, seen=NOT_SEEN)
    if decided or len(body.nodes.ends[0]) > MOST_NODES:
        return best
    for other in _others(outer, quads, observe):
        moved = unfolded([other, *holes], method, TOLERANCES[:2])
        found = looked_at(straightened(evened(faired(moved))))
        if found.seen.nothing:
            return replace(found, other_matching=True)
    return best


def _others(outer: RingMatch, quads: int | None, observe: Observer) -> Iterator[RingMatch]:
    """The next best matchings that cost little more."""
    for other in islice(next_matches(outer, quads, observe), OTHER_MATCHINGS):
        if other.matching.cost > LITTLE_MORE * outer.matching.cost:
            return
        yield other


def looked_at(body: Carried) -> Carried:
    """The body with what is seen of its crossings at the times at which it was looked at."""
    if not body.crossing:
        return body
    coarse = any(ring.coarse for ring in body.nodes.rings)
    t = np.linspace(0, 1, DETAIL_TIMES if coarse else CHECKED_TIMES)[1:-1]
    vertices = body.path.vertices(t)
    crossing = np.flatnonzero(~body.nodes.simple(t, vertices))
    some = crossing[np.unique(np.linspace(0, len(crossing) - 1, LOOKED).round().astype(np.intp))]
    curves = body.nodes.curves(vertices[some], t[some])
    rings = [ring for ring in body.nodes.rings if not ring.hole]
    ends = [[getattr(ring.samples, end) for ring in rings] for end in ("source", "target")]
    area = min(sum(abs(float(polygon_area(p))) for p in points) for points in ends)
    size = min(float(np.ptp(np.concatenate(points), axis=0).max()) for points in ends)
    return replace(body, seen=seen_crossings(curves, body.counts, area, size))
