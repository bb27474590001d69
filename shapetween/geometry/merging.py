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
from shapetween.base.ranking import comparable
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

_ON_PIECE, _VELOCITIES = bernstein(LOOKED, 0), velocity_weights(LOOKED, 0)

#: What counts of a distance along the curve, which hardly anybody sees. At 1 half as many curves
#: merge; at 0 a curve may pass its own end and come back.
ALONG = 0.25

#: Share of the distance allowed up to which curves that differ from one form, moved and sized, are
#: of that form. Smaller and rounding tells them apart; larger and slow turns are taken for none.
ALIKE = 1e-8

#: Times up to which all are looked at, whatever the form, and curves that are asked for it first.
FEW, SOME = 3, 16

#: Samples that are looked at before all are: most neighbours are seen not to be one at once.
FIRST_LOOK = 5

#: Pairs, each at each time, that are looked at together. More no longer fit in a processor's cache;
#: with fewer most of the time goes to calls.
AT_ONCE = 4_000

#: Coordinates that are looked at together, over some of the times. More no longer fit in a
#: processor's cache; with fewer most of the time goes to calls.
FITS = 20_000


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
    reach = ALIKE * min(between, ends)
    alike = _alike(curves[:, :SOME], reach)
    if alike is not None and curves.shape[1] > SOME:
        alike = _alike(curves, reach)
    if alike is not None:
        return _merged_alike(curves, rings, between, ends, alike)
    allowed = np.full(len(curves), between)
    allowed[[0, -1]] = ends
    ring = np.repeat(np.arange(len(rings)), rings)
    off = np.zeros(curves.shape[:2])
    held = _by_coordinate(curves)
    # The curves that are left, in order, and of all but the last whether the next is of its ring.
    left = np.arange(len(ring))
    together = ring[1:] == ring[:-1]
    # Most neighbours are seen at the start not to be one, and are none until one of them changes.
    possible = together.copy()
    pairs = np.flatnonzero(possible)
    possible[pairs] = _all_near(held, off, (pairs, pairs + 1), SHARES[-1] * allowed, slice(1))
    for share in SHARES:
        tried = np.flatnonzero(possible)
        while len(tried):
            near, whole, total = _near(held, off, (left[tried], left[tried + 1]), share * allowed)
            some = _disjoint(tried[near])
            if not len(some):
                break
            first = tried[near][some]
            held[..., left[first]], off[:, left[first]] = whole[..., some], total[:, some]
            changed = np.zeros(len(left), bool)
            changed[first] = True
            kept = np.ones(len(left), bool)
            kept[first + 1] = False
            left, changed = left[kept], changed[kept]
            together = ring[left[1:]] == ring[left[:-1]]
            # Neighbours that were not one, and have not changed since, are none now.
            again = (changed[:-1] | changed[1:]) & together
            possible = (np.append(possible, False)[kept][:-1] | again) & together
            tried = np.flatnonzero(again)
    merged = np.zeros((len(curves), len(left), 4, 2))
    step = max(1, FITS // max(8 * len(left), 1))  # all times at once are another copy
    for k in range(0, len(curves), step):
        merged[k : k + step] = held[:, :, k : k + step][..., left].transpose(2, 3, 0, 1)
    counts = np.bincount(ring[left], minlength=len(rings)).tolist()
    return merged, tuple(counts)


def _alike(curves: Curves, reach: float) -> Floats | None:
    """How large all curves are at each time, (F,), if they only move and grow as a whole.

    Beside what they are when they are largest; None if they turn or change.
    """
    if len(curves) <= FEW or not curves.size:
        return None
    local = curves.reshape(len(curves), -1).copy()
    for axis in (0, 1):  # arithmetic on pairs takes three times as long
        local[:, axis::2] -= curves[:, :1, 0, axis]
    most = local[int(comparable(np.einsum("ij,ij->i", local, local)).argmax())].copy()
    square = float(most @ most)
    if not square > 0:
        return None
    sizes = local @ most / square
    step = max(1, FITS // len(most))  # all times at once are another copy
    for k in range(0, len(local), step):
        local[k : k + step] -= sizes[k : k + step, None] * most
    return sizes if max(local.max(), -local.min()) <= reach else None


def _merged_alike(
    curves: Curves, rings: tuple[int, ...], between: float, ends: float, sizes: Floats
) -> tuple[Curves, tuple[int, ...]]:
    """The same of curves that are of one form at all times, by when they are largest."""
    inner = 1 + int(comparable(np.abs(sizes[1:-1])).argmax())
    looked = [0, inner, len(curves) - 1]
    few, counts = merged_curves(curves[looked], rings, between, ends)
    k = int(comparable(np.abs(sizes[looked])).argmax())
    start = curves[:, 0, 0]
    form = (few[k] - start[looked[k]]) / sizes[looked[k]]
    merged = sizes[:, None, None, None] * form
    for axis in (0, 1):
        merged[..., axis] += start[:, axis, None, None]
    merged[looked] = few
    return merged, counts


def _by_coordinate(curves: Curves) -> Floats:
    """A copy of curves (F, N, 4, 2) as (4, 2, F, N), in which arithmetic runs through long rows."""
    return np.array(np.moveaxis(curves, (2, 3), (0, 1)), order="C")


def _near(
    held: Floats, off: Floats, pairs: tuple[Index, Index], allowed: Floats
) -> tuple[Index, Floats, Floats]:
    """Which of some pairs, first and second curves, are near one curve at all times.

    And those curves, (4, 2, F, K), and how far they are off, (F, K).
    """
    some = np.unique(np.linspace(0, len(off) - 1, FIRST_LOOK).round().astype(np.intp))
    found = np.arange(len(pairs[0]))
    looks: tuple[slice | Index, ...] = (slice(1), some) if len(off) > FIRST_LOOK else ()
    for look in looks:
        here = pairs[0][found], pairs[1][found]
        found = found[_all_near(held, off, here, allowed, look)]
    if not len(found):
        return found, np.zeros((4, 2, len(off), 0)), np.zeros((len(off), 0))
    step = max(1, AT_ONCE // len(off))
    kept: list[tuple[Index, Floats, Floats]] = []
    for k in range(0, len(found), step):
        own = found[k : k + step]
        whole, total = _together(held, off, (pairs[0][own], pairs[1][own]))
        near = (total <= allowed[:, None]).all(axis=0)
        kept.append((own[near], whole[..., near], total[:, near]))
    indices, wholes, totals = zip(*kept, strict=True)
    return np.concatenate(indices), np.concatenate(wholes, axis=-1), np.concatenate(totals, axis=1)


def _all_near(
    held: Floats, off: Floats, pairs: tuple[Index, Index], allowed: Floats, look: slice | Index
) -> Mask:
    """Whether pairs are near one curve at some of the times."""
    held, off, allowed = held[:, :, look], off[look], allowed[look]
    step = max(1, AT_ONCE // len(off))
    near = np.zeros(len(pairs[0]), bool)
    for k in range(0, len(near), step):
        _, total = _together(held, off, (pairs[0][k : k + step], pairs[1][k : k + step]))
        near[k : k + step] = (total <= allowed[:, None]).all(axis=0)
    return near


def _together(held: Floats, off: Floats, pairs: tuple[Index, Index]) -> tuple[Floats, Floats]:
    """The curves that pairs are pieces of, (4, 2, F, K), and how far off those are, (F, K)."""
    first, second = pairs
    whole, away = _whole(held[..., first], held[..., second])
    return whole, away + np.maximum(off[:, first], off[:, second])


def _disjoint(pairs: Index) -> Index:
    """Which of pairs k, k + 1 are the first, or share nothing with the last one that is."""
    chosen: list[int] = []
    last = -2
    for place, pair in enumerate(pairs.tolist()):
        if pair > last + 1:
            chosen.append(place)
            last = pair
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
    away = _summed(bernstein(shares, 0), whole) - _summed(_ON_PIECE, piece)
    tangents = _summed(_VELOCITIES, 3 * np.diff(piece, axis=0))
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
