"""Keyframes whose values are free: not on the way, but fitted to it.

Where a point runs in an arc, keyframes on the arc leave all chords inside of it; keyframes a little
outside halve the greatest distance. Formats that hold nothing but keyframes need a fifth fewer.
"""

import numpy as np

from shapetween.base.arrays import Floats
from shapetween.timing.keyframes import keyframes

__all__ = ["fitted_keyframes", "hat_functions"]

#: How much of the knots is spread evenly, as a share of the mean bend; the rest goes where the
#: movement bends. With none, what hardly moves has no knots at all, and one jump takes them all.
EVEN_SHARE = 0.05

#: What the nearest sample must weigh at a knot. With less a value there is anybody's guess, none at
#: all between two samples, and the error at samples does not tell; more, and jumps have no knots.
KNOWN = 0.5

#: Decimals that knots are rounded to, as shares of the whole: what hangs on the last bit of a
#: root, or of a solve, must not reach a file.
KNOT_DECIMALS = 6


def fitted_keyframes(samples: Floats, times: Floats, tolerance: float) -> tuple[Floats, Floats]:
    """Knots in time and values there, between which straight lines stay near all samples.

    Parameters
    ----------
    samples : (S, K, D) float64
        K points.
    times : (S,) float64
        When each sample is, rising from the first to the last.
    tolerance : float
        Greatest distance allowed between a point and the straight line in time that stands for it.

    Returns
    -------
    knots : (M,) float64
        From the first to the last time.
    values : (M, K, D) float64
        At both ends exactly the samples.

    Notes
    -----
    Knots are spread by the square root of the greatest acceleration, which evens out the error of
    chords (their sagitta grows with the square of a step), and values are least squares with both
    ends held. Where a movement jumps that is worth nothing; then keyframes are chosen among the
    samples, as `keyframes` does it, and always if they are as few.
    """
    chosen = keyframes(samples, times, tolerance)
    best = times[chosen], samples[chosen]
    if len(chosen) <= 3:
        return best
    flat = samples.reshape(len(samples), -1)
    cumulated = _cumulated_bend(samples, times)
    low, high = 2, len(chosen)
    while high - low > 1:
        count = (low + high) // 2
        knots = _spread(cumulated, times, count)
        weights = hat_functions(times, knots)
        if weights.max(axis=0).min() < KNOWN:
            low = count
            continue
        values = _fitted(flat, weights)
        off = weights @ values
        off -= flat
        off *= off
        if np.sqrt(off.reshape(*samples.shape[:2], -1).sum(axis=-1).max()) <= tolerance:
            best, high = (knots, values.reshape(-1, *samples.shape[1:])), count
        else:
            low = count
    return best


def hat_functions(times: Floats, knots: Floats) -> Floats:
    """Weights of the values at knots, straight between them, at each time: (S, M)."""
    spans = np.clip(np.searchsorted(knots, times, side="right") - 1, 0, len(knots) - 2)
    share = (times - knots[spans]) / (knots[spans + 1] - knots[spans])
    weights = np.zeros((len(times), len(knots)))
    rows = np.arange(len(times))
    weights[rows, spans] = 1 - share
    weights[rows, spans + 1] = share
    return weights


def _cumulated_bend(samples: Floats, times: Floats) -> Floats:
    """How much bending has come by each sample, rising from 0 to 1."""
    steps = np.diff(times)
    speeds = np.diff(samples, axis=0) / np.where(steps > 0, steps, 1.0)[:, None, None]
    turns = np.sqrt((np.diff(speeds, axis=0) ** 2).sum(-1)).max(axis=1)
    bend = np.sqrt(np.concatenate([turns[:1], (turns[1:] + turns[:-1]) / 2, turns[-1:]]))
    bend = bend + EVEN_SHARE * bend.mean() + 1e-300
    total = np.concatenate([[0.0], np.cumsum(bend * np.sqrt(np.maximum(steps, 0.0)))])
    return np.asarray(total / total[-1])


def _spread(cumulated: Floats, times: Floats, count: int) -> Floats:
    """Knots that part the bending evenly, at most so many: where they crowd, samples are knots."""
    order = np.arange(len(times))
    place = np.interp(np.arange(count) / (count - 1), cumulated, order)
    crowded = np.diff(place) < 1
    crowded = np.append(crowded, False) | np.append(False, crowded)
    place[crowded] = np.rint(place[crowded])
    knots = np.interp(np.unique(place), order, times)
    span = times[-1] - times[0]
    rounded = times[0] + np.round((knots - times[0]) / span, KNOT_DECIMALS) * span
    rounded[0], rounded[-1] = times[0], times[-1]
    return np.asarray(rounded)


def _fitted(flat: Floats, weights: Floats) -> Floats:
    """Values (M, K) at the knots of least squares, those at both ends given."""
    values = np.zeros((weights.shape[1], flat.shape[1]))
    values[0], values[-1] = flat[0], flat[-1]
    rest = flat - weights[:, [0, -1]] @ values[[0, -1]]
    inner = weights[:, 1:-1]
    if inner.shape[1]:
        # Solved for each sample once: there are far more points than samples.
        values[1:-1] = np.linalg.lstsq(inner, np.eye(len(inner)), rcond=None)[0] @ rest
    return values
