"""Neighbouring curves that are one curve at all times, written as one.

A movement cuts its outlines at the joints of both ends and, where it bends, in between. Where it
then moves all of a stretch alike, the pieces stay pieces of one cubic: each of them takes part of
its parameters, s and 1 - s, and de Casteljau's construction read backwards gives the whole
([Far02]_, section 4.6): P0 + (P1 - P0) / s and Q3 + (Q2 - Q3) / (1 - s), s from how far the handles
on both sides of the joint reach.

.. [Far02] G. Farin, *Curves and Surfaces for CAGD*, 5th ed., 2002.
"""

import numpy as np

from shapetween.base.arrays import Curves, Floats, Index, Mask
from shapetween.geometry.bezier import derivatives, evaluate

__all__ = ["merged_curves"]

#: Shares of the distance allowed up to which neighbours become one, first the surest. With the last
#: alone, two stretches that are nearly one at first take pieces from those that are one exactly.
SHARES = (1 / 16, 1.0)

#: Least share of the parameters that a piece may take. Handles grow by its inverse, and with less
#: the rounding of their coordinates shows.
LEAST = 1e-3

#: Parameters at which the distance of a piece from the whole is looked at.
LOOKED = np.array([0.25, 0.5, 0.75, 1.0])

#: What counts of a distance along the curve, which hardly anybody sees. At 1 half as many curves
#: merge; at 0 a curve may pass its own end and come back.
ALONG = 0.25

#: Samples that are looked at before all are: most neighbours are seen not to be one at once.
FIRST_LOOK = 5

#: Control points of pairs that are looked at together; more fill the memory.
MOST_HELD = 2_000_000


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
    for share in SHARES:
        changed = np.ones(len(ring), bool)
        while len(ring) > 1:
            # Neighbours that were not one, and have not changed since, are none now.
            pairs = np.flatnonzero((ring[1:] == ring[:-1]) & (changed[1:] | changed[:-1]))
            first = _disjoint(_near(curves, off, pairs, share * allowed))
            if not len(first):
                break
            whole, away = _whole(curves[:, first], curves[:, first + 1])
            off[:, first] = away + np.maximum(off[:, first], off[:, first + 1])
            curves = curves.copy()
            curves[:, first] = whole
            kept = np.ones(len(ring), bool)
            kept[first + 1] = False
            changed = np.zeros(len(ring), bool)
            changed[first] = True
            changed = changed[kept]
            curves, off, ring = curves[:, kept], off[:, kept], ring[kept]
    return curves, tuple(np.bincount(ring, minlength=len(rings)).tolist())


def _near(curves: Curves, off: Floats, pairs: Index, allowed: Floats) -> Index:
    """Those of some pairs, each named by its first curve, that are near one curve at all times."""
    some = np.unique(np.linspace(0, len(curves) - 1, FIRST_LOOK).round().astype(np.intp))
    for look in (some[:1], some):
        pairs = pairs[_all_near(curves[look], off[look], pairs, allowed[look])]
    step = max(1, MOST_HELD // (8 * len(curves)))
    parts = [pairs[k : k + step] for k in range(0, len(pairs), step)]
    return np.concatenate(
        [part[_all_near(curves, off, part, allowed)] for part in parts] or [pairs]
    )


def _all_near(curves: Curves, off: Floats, pairs: Index, allowed: Floats) -> Mask:
    _, away = _whole(curves[:, pairs], curves[:, pairs + 1])
    total = away + np.maximum(off[:, pairs], off[:, pairs + 1])
    return np.asarray((total <= allowed[:, None]).all(axis=0))


def _disjoint(pairs: Index) -> Index:
    """Of pairs k, k + 1 the first, and each next that shares nothing with the one before."""
    chosen: list[int] = []
    for pair in pairs.tolist():
        if not chosen or pair > chosen[-1] + 1:
            chosen.append(pair)
    return np.array(chosen, np.intp)


def _whole(first: Curves, second: Curves) -> tuple[Curves, Floats]:
    """The curve that two (F, K, 4, 2) are pieces of, and how far they are from it, (F, K)."""
    before = _length(first[..., 3, :] - first[..., 2, :])
    after = _length(second[..., 1, :] - second[..., 0, :])
    total = before + after
    share = np.where(total > 0, before / np.where(total > 0, total, 1.0), 0.5)
    known = (share >= LEAST) & (share <= 1 - LEAST)
    share = np.where(known, share, 0.5)[..., None]
    start, end = first[..., 0, :], second[..., 3, :]
    leaving = start + (first[..., 1, :] - start) / share
    arriving = end + (second[..., 2, :] - end) / (1 - share)
    whole = np.stack([start, leaving, arriving, end], axis=-2)
    away = np.maximum(
        _distance(whole, share * LOOKED, first),
        _distance(whole, share + (1 - share) * LOOKED, second),
    )
    return whole, np.where(known, away, np.inf)


def _distance(whole: Curves, shares: Floats, piece: Curves) -> Floats:
    """The greatest distance of a piece from its share of the whole, (F, K)."""
    away = evaluate(whole, shares) - evaluate(piece, LOOKED)
    tangents = derivatives(piece, LOOKED)
    speed = _length(tangents)
    across = np.abs(away[..., 0] * tangents[..., 1] - away[..., 1] * tangents[..., 0])
    far = _length(away)
    across = np.where(speed > 0, across / np.where(speed > 0, speed, 1.0), far)
    return np.asarray(np.maximum(across, ALONG * far).max(axis=-1))


def _length(vectors: Floats) -> Floats:
    return np.asarray(np.sqrt((vectors**2).sum(axis=-1)))
