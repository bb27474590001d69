"""A smooth movement in few numbers: a straight way, and a few fields of points times functions.

All control points as one vector X run as X(t) = A + t (B - A) + sum of C_k b_k(t) with few terms: a
singular value decomposition of many samples finds the fewest. The functions b_k are kept at even
knots, between which a reader draws Catmull-Rom splines; the fields C_k are rounded as coarsely as
the error allows.
"""

from dataclasses import dataclass

import numpy as np

from shapetween.base.arrays import Floats, Index

__all__ = ["Basis", "fit_basis", "spline_weights"]

#: Steps between knots that are tried, fewest first. The last has a knot at each sample, which takes
#: even jumps.
KNOTS = (8, 10, 12, 15, 20, 24, 30, 40, 60, 120)

#: Shares of the error allowed that are used up by leaving terms out, and by then also the splines;
#: rounding has the rest. More for the one is less for the next, and all together is fewest bytes.
BY_RANK, BY_SPLINES = 0.7, 0.85

#: Steps of the fields that are tried, and what a step of a function may move the farthest point,
#: as shares of the error allowed. Coarser steps are never within the error.
STEPS, KNOT_STEP = (1.6, 1.3, 1.1, 0.9, 0.75, 0.6, 0.5, 0.4, 0.3, 0.2, 0.1), 0.16


@dataclass(frozen=True, slots=True, eq=False)
class Basis:
    """The terms besides the straight way.

    Attributes
    ----------
    fields : (R, P, 2) int64
        One vector a point.
    functions : (R, M + 1) int64
        Each field's share of time at even knots.
    scales : (R,) float64
        What the product of both is worth, in units of the points.
    """

    fields: Index
    functions: Index
    scales: Floats

    def at(self, times: Floats) -> Floats:
        """What the terms add to the points, (S, P, 2)."""
        weights = spline_weights(times, self.functions.shape[1]) @ self.functions.T
        fields = self.fields.astype(np.float64)
        return np.asarray(np.einsum("sr,rpd->spd", weights * self.scales, fields))


def fit_basis(rest: Floats, times: Floats, weights: Floats, tolerance: float) -> Basis:
    """Find terms that stay near what is left of a movement without its straight way.

    Parameters
    ----------
    rest : (S, P, 2) float64
        Of every point at every time.
    times : (S,) float64
        Evenly from 0 to 1.
    weights : (P,) float64
        What a point's distance counts.
    tolerance : float
        Greatest distance allowed.
    """
    flat = (rest * weights[:, None]).reshape(len(rest), -1)
    functions, fields = _decomposed(flat, tolerance * BY_RANK)
    if not len(fields):
        return _rounded(np.zeros((2, 0)), fields, weights, 1.0, tolerance)
    for steps in KNOTS:
        matrix = spline_weights(times, steps + 1)
        knots = np.asarray(np.linalg.lstsq(matrix, functions, rcond=None)[0], np.float64)
        last = steps == KNOTS[-1]
        if last or _error(matrix @ knots @ fields - flat) <= tolerance * BY_SPLINES:
            break
    for step in STEPS:
        basis = _rounded(knots, fields, weights, step * tolerance, tolerance)
        off = (basis.at(times) - rest) * weights[:, None]
        if _error(off.reshape(len(rest), -1)) <= tolerance:
            break
    return basis


def spline_weights(times: Floats, knots: int) -> Floats:
    """Weights of even knots at each time, (S, knots), of a Catmull-Rom spline.

    Before the first and after the last knot lies one more in a straight line.
    """
    place = times * (knots - 1)
    span = np.clip(place.astype(np.intp), 0, knots - 2)
    s = (place - span)[:, None]
    cubic = np.concatenate(
        [
            ((2 - s) * s - 1) * s,
            (3 * s - 5) * s * s + 2,
            ((4 - 3 * s) * s + 1) * s,
            (s - 1) * s * s,
        ],
        axis=1,
    )
    padded = np.zeros((len(times), knots + 2))
    rows = np.arange(len(times))[:, None]
    padded[rows, span[:, None] + np.arange(4)] = cubic / 2
    inner = padded[:, 1:-1].copy()
    inner[:, 0] += 2 * padded[:, 0]
    inner[:, 1] -= padded[:, 0]
    inner[:, -1] += 2 * padded[:, -1]
    inner[:, -2] -= padded[:, -1]
    return inner


def _decomposed(flat: Floats, tolerance: float) -> tuple[Floats, Floats]:
    """The fewest terms within a distance: functions (S, R) and fields (R, 2 P).

    From the eigenvectors of the samples' products, for there may be far more points than samples;
    which of two opposite vectors is taken hangs on its largest entry.
    """
    values, vectors = np.linalg.eigh(flat @ flat.T)
    vectors = vectors[:, ::-1]
    left = flat.copy()
    rank = 0
    while rank < len(values) and _error(left) > tolerance:
        left -= np.outer(vectors[:, rank], vectors[:, rank] @ flat)
        rank += 1
    functions = vectors[:, :rank]
    peaks = np.abs(np.round(functions, 9)).argmax(axis=0)
    functions = functions * np.sign(functions[peaks, np.arange(rank)])
    return functions, functions.T @ flat


def _error(off: Floats) -> float:
    """The greatest distance of points whose coordinates stand in pairs, (S, 2 P)."""
    return float(np.sqrt(off[:, ::2] ** 2 + off[:, 1::2] ** 2).max(initial=0.0))


def _rounded(
    knots: Floats, fields: Floats, weights: Floats, step: float, tolerance: float
) -> Basis:
    """Terms in whole numbers: of `step` in the fields, of what can be seen in the functions."""
    heights = np.abs(knots).max(axis=0, initial=0.0)
    vectors = (
        fields.reshape(len(fields), len(weights), 2) / weights[:, None] * heights[:, None, None]
    )
    farthest = np.abs(vectors).max(axis=(1, 2), initial=0.0)
    shares = np.maximum(np.ceil(farthest / (KNOT_STEP * tolerance)), 1.0)
    return Basis(
        np.rint(vectors / step).astype(np.int64),
        np.rint((knots / np.where(heights > 0, heights, 1.0) * shares).T).astype(np.int64),
        step / shares,
    )
