"""Keyframes no denser than the eye needs."""

import numpy as np

from shapetween.base.arrays import Floats, Index

__all__ = ["KEYFRAME_TOLERANCE", "keyframes", "looser_keyframes"]

#: Coordinates that are looked at in one go. More no longer fit in a processor's cache; with fewer
#: most of the time goes to calls.
AT_ONCE = 20_000

#: How far a control point may be from its place between two keyframes, as a share of the view
#: box's larger side: 0.18 px at 1000 px, which with the default rounding stays within a quarter of
#: a pixel. Larger and the in-betweens drift visibly; smaller and the file grows for nothing seen.
KEYFRAME_TOLERANCE = 1.8e-4


def looser_keyframes(looser: float) -> str:
    """What to tell of outlines too long for as many keyframes as the tolerance asks for."""
    return (
        f"between keyframes long outlines may be {looser:.2g} times as far off as usual; more "
        "keyframes would be too much for players"
    )


def keyframes(samples: Floats, times: Floats, tolerance: float, most: int | None = None) -> Index:
    """Choose samples between which straight lines stay near all the others.

    Parameters
    ----------
    samples : (S, K, D) float64
        K points, or colours.
    times : (S,) float64
        The movement's time of each sample, not falling.
    tolerance : float
        Greatest distance allowed between a point and the straight line in time that stands for it.
        Moving a Bezier's control points moves no point of the curve farther.
    most : int, optional
        How many keyframes are of use; with one more than that the search ends, the last sample not
        among them.

    Returns
    -------
    (M,) intp
        Rising indices, the first and the last sample among them.

    Notes
    -----
    From each keyframe the next one is put as far on as every shorter step was still near enough.
    That takes about as few as any choice could, and the same ones every time.
    """
    last = len(samples) - 1
    if not np.ptp(samples, axis=0).any():
        return np.unique([0, last])
    chosen = [0]
    # The points that were too far before are the likeliest to be so again.
    watched: list[int] = []
    step = 1
    while chosen[-1] < last and (most is None or len(chosen) <= most):
        start = chosen[-1]
        end = start + 1
        while end < last:
            # As far as the last step went, then twice as far, as long as it fits.
            fit = AT_ONCE // (samples[0].size * (end - start + step))
            ends = max(1, min(step, fit, last - end))
            some, when = samples[start : end + ends + 1], times[start : end + ends + 1]
            if ends == 1 and watched and _farthest(some[:, watched], when, 1)[1][0] > tolerance:
                break
            points, distances = _farthest(some, when, ends)
            over = distances > tolerance
            if over.any():
                first = int(over.argmax())
                watched.append(int(points[first]))
                end += first
                break
            end += ends
            step = 2 * step
        step = end - start
        chosen.append(end)
    return np.array(chosen, np.intp)


def _farthest(samples: Floats, times: Floats, ends: int) -> tuple[Index, Floats]:
    """The point farthest from its straight way from the first sample on, and how far it is.

    On the ways to each of so many samples at the end: (ends,) and (ends,).
    """
    inner, span = times[1:-1] - times[0], times[-ends:] - times[0]
    if not (span > 0).all():
        span = np.where(span > 0, span, 1.0)
    share = (inner / span[:, None])[..., None, None]
    away = _squares(samples[1:-1] - ((1 - share) * samples[0] + share * samples[-ends:, None]))
    if ends > 1:  # what comes after an end is none of its way
        away[np.tri(len(inner), ends, ends - len(inner) - 1, dtype=bool).T] = 0.0
    away = away.max(axis=1)
    points = away.argmax(axis=1)
    return points, np.sqrt(away.max(axis=1))


def _squares(vectors: Floats) -> Floats:
    """Squares of lengths, (..., D) to (...,); sums along short axes are slow."""
    squares = vectors * vectors
    total = squares[..., 0]
    for k in range(1, vectors.shape[-1]):
        total = total + squares[..., k]
    return np.asarray(total)
