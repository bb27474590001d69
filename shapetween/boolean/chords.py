"""Chords of curves, each of which knows the part of the curve it stands for."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from shapetween.base.arrays import Curves, Floats, Index, Points
from shapetween.geometry.bezier import evaluate
from shapetween.geometry.polygon import cross
from shapetween.model.outline import Outline

__all__ = ["Chords", "chords_of", "joined"]

#: Distance of a curve from its chords, as a share of the extent of all rings. Larger and chords
#: cross where their curves do not; smaller and there are more of them, by its square root.
FLATNESS = 2e-5

#: Most chords of a curve. Only handles far outside of what is drawn ask for more.
MOST_CHORDS = 500

#: Angle through which an arc may turn: below half a turn no arc meets itself.
ARC_TURN = np.pi / 2


@dataclass(frozen=True, slots=True, eq=False)
class Chords:
    """Chords of some rings.

    Attributes
    ----------
    curves : (C, 4, 2) float64
        Of all rings.
    ends : (N, 2, 2) float64
        Start and end of each chord.
    curve : (N,) intp
        The curve that each chord belongs to.
    t : (N, 2) float64
        Parameters of its start and end on that curve.
    arc : (N,) intp
        Part of the curve that it belongs to, counted through all curves: a run of chords that does
        not meet itself.
    flatness : (N,) float64
        Greatest distance of each chord from its curve.
    polylines : tuple of (M, 2) float64
        The rings, each with its last point.
    """

    curves: Curves
    ends: Points
    curve: Index
    t: Floats
    arc: Index
    flatness: Floats
    polylines: tuple[Points, ...]


def chords_of(rings: Sequence[Outline]) -> Chords:
    """Chords of rings, as many as each curve needs.

    Parameters
    ----------
    rings : sequence of Outline
        At least one.

    Notes
    -----
    A curve lies within max |B''| / (8 n^2) of n chords, and |B''| is at most six times the largest
    second difference of its control points.
    """
    curves = np.concatenate([ring.curves for ring in rings])
    flatness = FLATNESS * float(np.ptp(curves[:, [0, 3]].reshape(-1, 2), axis=0).max())
    if flatness == 0:  # one curve that ends where it starts
        flatness = FLATNESS * float(np.ptp(curves.reshape(-1, 2), axis=0).max())
    bend = np.linalg.norm(np.diff(curves, n=2, axis=1), axis=-1).max(axis=1)
    needed = np.sqrt(0.75 * bend / flatness) if flatness > 0 else np.zeros(len(curves))
    count = np.ceil(np.clip(needed, 1, MOST_CHORDS)).astype(np.intp)
    first = np.concatenate([[0], np.cumsum(count)])
    curve = np.repeat(np.arange(len(curves)), count)
    step = np.arange(first[-1]) - first[curve]
    t = np.stack([step, step + 1], axis=1) / count[curve, None]
    ends = evaluate(curves[curve], t)
    closing = np.cumsum([0, *(len(ring.curves) for ring in rings)])
    polylines = tuple(
        np.concatenate([ends[first[low] : first[high], 0], curves[high - 1 : high, 3]])
        for low, high in pairwise(closing.tolist())
    )
    arc = _arcs(ends, curve)
    return Chords(curves, ends, curve, t, arc, np.full(len(curve), flatness), polylines)


def joined(all_chords: Sequence[Chords]) -> Chords:
    """Chords of several groups of rings, each as fine as its own group needs.

    Parameters
    ----------
    all_chords : sequence of Chords
        At least one.
    """
    curves = np.cumsum([0, *(len(chords.curves) for chords in all_chords)])
    arcs = np.cumsum([0, *(chords.arc[-1] + 1 for chords in all_chords)])
    return Chords(
        np.concatenate([chords.curves for chords in all_chords]),
        np.concatenate([chords.ends for chords in all_chords]),
        np.concatenate([chords.curve + n for chords, n in zip(all_chords, curves, strict=False)]),
        np.concatenate([chords.t for chords in all_chords]),
        np.concatenate([chords.arc + n for chords, n in zip(all_chords, arcs, strict=False)]),
        np.concatenate([chords.flatness for chords in all_chords]),
        tuple(line for chords in all_chords for line in chords.polylines),
    )


def _arcs(ends: Points, curve: Index) -> Index:
    """The arc of each chord: a new one where the curve changes or has turned too far."""
    along = ends[:, 1] - ends[:, 0]
    before = np.roll(along, 1, axis=0)
    turn = np.abs(np.arctan2(cross(before, along), (before * along).sum(axis=1)))
    first = np.concatenate([[True], np.diff(curve) > 0])
    turn[first] = 0.0
    turned = np.cumsum(turn)
    turned -= turned[np.flatnonzero(first)][curve]
    quarter = (turned // ARC_TURN).astype(np.intp)
    starts = first | np.concatenate([[True], np.diff(quarter) > 0])
    return np.asarray(np.cumsum(starts) - 1)
