"""Keyframes no denser than the eye needs."""

import numpy as np

from shapetween.base.arrays import Floats, Index

__all__ = ["KEYFRAME_TOLERANCE", "keyframes"]

#: How far a control point may be from its place between two keyframes, as a share of the view
#: box's larger side: 0.18 px at 1000 px, which with the default rounding stays within a quarter of
#: a pixel. Larger and the in-betweens drift visibly; smaller and the file grows for nothing seen.
KEYFRAME_TOLERANCE = 1.8e-4


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
    while chosen[-1] < last and (most is None or len(chosen) <= most):
        start = chosen[-1]
        end = start + 1
        while end < last:
            some, when = samples[start : end + 2], times[start : end + 2]
            if watched and _farthest(some[:, watched], when)[1] > tolerance:
                break
            point, distance = _farthest(some, when)
            if distance > tolerance:
                watched.append(point)
                break
            end += 1
        chosen.append(end)
    return np.array(chosen, np.intp)


def _farthest(samples: Floats, times: Floats) -> tuple[int, float]:
    """The point farthest from its straight way from the first to the last sample, and how far."""
    span = times[-1] - times[0]
    share = ((times[1:-1] - times[0]) / (span if span > 0 else 1.0))[:, None, None]
    straight = (1 - share) * samples[0] + share * samples[-1]
    away = ((samples[1:-1] - straight) ** 2).sum(-1).max(axis=0)
    point = int(away.argmax())
    return point, float(np.sqrt(away[point]))
