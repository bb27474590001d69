"""Neighbouring curves that are one curve at all times, written as one.

A movement cuts its outlines at the joints of both ends and, where it bends, in between. Where it
then moves all of an arc alike, the pieces stay pieces of one cubic: each of them takes part of
its parameters, s and 1 - s, and de Casteljau's construction read backwards gives the whole
([Far02]_, section 4.6): P0 + (P1 - P0) / s and Q3 + (Q2 - Q3) / (1 - s), s from how far the handles
on both sides of the joint reach.

.. [Far02] G. Farin, *Curves and Surfaces for CAGD*, 5th ed., 2002.
"""

import numpy as np

from shapetween.base.arrays import Curves, Floats, Index, Mask
from shapetween.geometry.bezier import bernstein, velocity_weights

__all__ = ["merged_curves"]

#: Shares of the distance allowed up to which neighbours become one, first the surest. With the last
#: alone, two arcs that are nearly one at first take pieces from those that are one exactly.
SHARES = (1 / 16, 1.0)

#: Least share of the parameters that a piece may take. Handles grow by its inverse, and with less
#: the rounding of their coordinates shows.
LEAST = 1e-3

#: Parameters at which the distance of a piece from the whole is looked at.
LOOKED = np.array([0.25, 0.5, 0.75, 1.0])[:, None, None]

#: What counts of a distance along the curve, which hardly anybody sees. At 1 half as many curves
#: merge; at 0 a curve may pass its own end and come back.
ALONG = 0.25

#: Samples that are looked at before all are: most neighbours are seen not to be one at once.
FIRST_LOOK = 5

#: Pairs, each at each time, that are looked at together. More no longer fit in a processor's cache;
#: with fewer most of the time goes to calls.
AT_ONCE = 4_000


def merged_curves(
    curves: Curves, rings: tuple[int, ...], between: float, ends: float
) -> tuple[Curves, tuple[int, ...]]:
    """Merge neighbours within rings wherever that is allowed at all times.

    Parameters
    ----------
    curves : (F, N, 4, 2) float64
        Ring after ring, at times of which the first and the last are the ends.
    rings : tuple of int
        Number of curves in each.
    between, ends : float
        How far a point may be from its place then, on the way and at the ends.

    Returns
    -------
    curves : (F, M, 4, 2) float64
    rings : tuple of int
        Each at least one curve; those without any stay so.
    """
    allowed = np.full(len(curves), between)
    allowed[[0, -1]] = ends
    ring = np.repeat(np.arange(len(rings)), rings)
    off = np.zeros(curves.shape[:2])
    held = _by_coordinate(curves)
    # Most neighbours are seen at the start not to be one, and are none until one of them changes.
    possible = np.append(ring[1:] == ring[:-1], np.zeros(len(ring[:1]), bool))
    pairs = np.flatnonzero(possible)
    possible[pairs] = _all_near(held, off, pairs, SHARES[-1] * allowed, slice(1))
    for share in SHARES:
        tried = possible.copy()
        while len(ring) > 1:
            first = _disjoint(_near(held, off, np.flatnonzero(tried), share * allowed))
            if not len(first):
                break
            whole, away = _whole(held[..., first], held[..., first + 1])
            off[:, first] = away + np.maximum(off[:, first], off[:, first + 1])
            held = held.copy()
            held[..., first] = whole
            changed = np.zeros(len(ring), bool)
            changed[first] = True
            kept = np.ones(len(ring), bool)
            kept[first + 1] = False
            held, off, ring, changed = held[..., kept], off[:, kept], ring[kept], changed[kept]
            # Neighbours that were not one, and have not changed since, are none now.
            together = np.append(ring[1:] == ring[:-1], False)
            tried = (changed | np.append(changed[1:], False)) & together
            possible = (possible[kept] | tried) & together
    merged = np.moveaxis(held, (0, 1), (2, 3))
    return np.ascontiguousarray(merged), tuple(np.bincount(ring, minlength=len(rings)).tolist())


def _by_coordinate(curves: Curves) -> Floats:
    """Curves (F, N, 4, 2) as (4, 2, F, N), in which arithmetic runs through long rows."""
    return np.ascontiguousarray(np.moveaxis(curves, (2, 3), (0, 1)))


def _near(held: Floats, off: Floats, pairs: Index, allowed: Floats) -> Index:
    """Those of some pairs, each named by its first curve, that are near one curve at all times."""
    some = np.unique(np.linspace(0, len(off) - 1, FIRST_LOOK).round().astype(np.intp))
    for look in (slice(1), some, slice(None)):
        pairs = pairs[_all_near(held, off, pairs, allowed, look)]
    return pairs


def _all_near(
    held: Floats, off: Floats, pairs: Index, allowed: Floats, look: slice | Index
) -> Mask:
    """Whether pairs are near one curve at some of the times."""
    held, off, allowed = held[:, :, look], off[look], allowed[look]
    step = max(1, AT_ONCE // len(off))
    near = [_together(held, off, pairs[k : k + step], allowed) for k in range(0, len(pairs), step)]
    return np.concatenate([np.zeros(0, bool), *near])


def _together(held: Floats, off: Floats, pairs: Index, allowed: Floats) -> Mask:
    _, away = _whole(held[..., pairs], held[..., pairs + 1])
    total = away + np.maximum(off[:, pairs], off[:, pairs + 1])
    return np.asarray((total <= allowed[:, None]).all(axis=0))


def _disjoint(pairs: Index) -> Index:
    """Of pairs k, k + 1 the first, and each next that shares nothing with the one before."""
    chosen: list[int] = []
    for pair in pairs.tolist():
        if not chosen or pair > chosen[-1] + 1:
            chosen.append(pair)
    return np.array(chosen, np.intp)


def _whole(first: Floats, second: Floats) -> tuple[Floats, Floats]:
    """The curves that pairs (4, 2, F, K) are pieces of, and how far they are from them, (F, K)."""
    before = _length(first[3] - first[2])
    after = _length(second[1] - second[0])
    total = before + after
    share = np.where(total > 0, before / np.where(total > 0, total, 1.0), 0.5)
    known = (share >= LEAST) & (share <= 1 - LEAST)
    share = np.where(known, share, 0.5)
    start, end = first[0], second[3]
    leaving = start + (first[1] - start) / share
    arriving = end + (second[2] - end) / (1 - share)
    whole = np.stack([start, leaving, arriving, end])
    away = np.maximum(
        _distance(whole, share * LOOKED, first),
        _distance(whole, share + (1 - share) * LOOKED, second),
    )
    return whole, np.where(known, away, np.inf)


def _distance(whole: Floats, shares: Floats, piece: Floats) -> Floats:
    """The greatest distance of pieces from their shares (L, F, K) of the whole, (F, K)."""
    away = _summed(bernstein(shares, 0), whole) - _summed(bernstein(LOOKED, 0), piece)
    tangents = _summed(velocity_weights(LOOKED, 0), 3 * np.diff(piece, axis=0))
    speed = _length(tangents)
    across = np.abs(away[0] * tangents[1] - away[1] * tangents[0])
    far = _length(away)
    across = np.where(speed > 0, across / np.where(speed > 0, speed, 1.0), far)
    return np.asarray(np.maximum(across, ALONG * far).max(axis=0))


def _summed(weights: Floats, points: Floats) -> Floats:
    """Sums of weighted points, (M, L, F, K) and (M, 2, F, K) to (2, L, F, K), in one order."""
    total = weights[0] * points[0, :, None]
    for weight, point in zip(weights[1:], points[1:], strict=True):
        total += weight * point[:, None]
    return np.asarray(total)


def _length(vectors: Floats) -> Floats:
    """Lengths of vectors (2, ...)."""
    return np.asarray(np.sqrt(vectors[0] ** 2 + vectors[1] ** 2))
