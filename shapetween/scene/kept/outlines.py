"""Two areas whose outlines leave one another and come back in one order: what is between moves."""

from collections.abc import Mapping, Sequence

import numpy as np

from shapetween.base.arrays import Curves, Floats
from shapetween.deform.check import crossing_frames
from shapetween.model.outline import Outline
from shapetween.scene.forms import is_straight
from shapetween.scene.kept.shared_arcs import SharedArc
from shapetween.scene.motion.bend_knots import along_knots
from shapetween.scene.motion.knots import graph_knots
from shapetween.scene.motion.tracks import Blend
from shapetween.scene.places import Pieces, Places, cut_alike, run_of

__all__ = ["outline_tracks"]

#: Times at which rings are looked at for crossings.
LOOKED = np.linspace(0.0, 1.0, 9)[1:-1]


def outline_tracks(
    first: Mapping[int, Outline],
    second: Mapping[int, Outline],
    arcs: Sequence[SharedArc],
    reach: float,
) -> list[Blend] | None:
    """Tracks of all rings, each of which becomes one ring of the other area.

    Parameters
    ----------
    first, second : mapping of int to Outline
        Rings of both areas, as they are drawn, by their numbers.
    arcs : sequence of SharedArc
        What they have in common.
    reach : float
        Distance within which outlines are one.

    Returns
    -------
    list of Blend or None
        None if rings divide or join, their arcs follow in another order, or a ring would cross
        itself or another one on its way.
    """
    arcs = [s for s in arcs if s.rings[0] in first and s.rings[1] in second]
    partner = {arc.rings for arc in arcs}
    if not len(partner) == len(first) == len(second):
        return None
    if any(len({pair[side] for pair in partner}) != len(partner) for side in (0, 1)):
        return None
    tracks = []
    for i, j in sorted(partner):
        own = sorted((s for s in arcs if s.rings == (i, j)), key=lambda s: s.own[0] % 1.0)
        starts = np.array([s.other[0] % 1.0 for s in own])
        if np.count_nonzero(np.diff(np.append(starts, starts[0])) < 0) > 1:
            return None
        tracks.append(_ring_track(Places(first[i]), Places(second[j]), own, reach))
    counts = [n for track in tracks for n in track.counts]
    curves = np.concatenate([track.curves(LOOKED) for track in tracks], axis=1)
    if crossing_frames(curves, counts, [True] * len(counts)).any():
        return None
    return tracks


def _ring_track(source: Places, target: Places, own: Sequence[SharedArc], reach: float) -> Blend:
    first: list[Curves] = []
    second: list[Curves] = []
    for k, arc in enumerate(own):
        following = own[(k + 1) % len(own)]
        first.append(arc.pieces.source)
        second.append(arc.pieces.target)
        runs = [
            _between(places, end, start)
            for places, end, start in (
                (source, arc.own[1], following.own[0]),
                (target, arc.other[1], following.other[0]),
            )
        ]
        one, other = _alike(runs[0], runs[1], first[-1], second[-1], reach)
        first.append(one)
        second.append(other)
    ends = [np.concatenate(side) for side in (first, second)]
    for curves in ends:
        curves[1:, 0] = curves[:-1, 3]
        curves[0, 0] = curves[-1, 3]
    return Blend(Pieces(ends[0], ends[1], True), np.stack([e[0, 0] for e in ends]))


def _between(places: Places, end: float, start: float) -> Outline | None:
    """A ring's run from the end of an arc to the start of the next one; None if they meet."""
    way = (start - end) % 1.0
    if min(way, 1.0 - way) < 1e-7:
        return None
    return run_of(places, end % 1.0, end % 1.0 + way)


def _alike(
    one: Outline | None, other: Outline | None, before: Curves, there: Curves, reach: float
) -> tuple[Curves, Curves]:
    """Two runs as equally many curves; one that is missing is a point."""
    if one is None and other is None:
        return np.zeros((0, 4, 2)), np.zeros((0, 4, 2))
    if one is None:
        assert other is not None
        return np.broadcast_to(before[-1, 3], other.curves.shape), other.curves
    if other is None:
        return one.curves, np.broadcast_to(there[-1, 3], one.curves.shape)
    source, target = Places(one), Places(other)
    if is_straight(other):
        u, v = _beside(source, target)
    elif is_straight(one):
        v, u = _beside(target, source)
    else:
        found = graph_knots(source, target, reach)
        u, v = along_knots(source, target)[:2] if found is None else found
    pieces = cut_alike(source, target, u, v)
    return pieces.source, pieces.target


def _beside(bent: Places, straight: Places) -> tuple[Floats, Floats]:
    """Knots by which every corner of a run goes square to a straight line that it becomes."""
    start, end = straight.point(np.array([0.0, 1.0]))
    along = (end - start) / float(((end - start) ** 2).sum())
    at = bent.joints
    share = np.clip((bent.point(at) - start) @ along, 0.0, 1.0)
    share[0], share[-1] = 0.0, 1.0
    low, high = np.maximum.accumulate(share), np.minimum.accumulate(share[::-1])[::-1]
    return at, np.asarray((low + high) / 2)
