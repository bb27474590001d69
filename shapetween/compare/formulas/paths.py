"""How quantities and points go through time: evenly, or by detours.

Every measure is a share of a size of the shape, so that it has no unit.
"""

import numpy as np

from shapetween.base.arrays import Floats, Points

__all__ = ["detour", "overshoot", "reversibility", "roughness", "straightness", "travel"]


def straightness(values: Floats, t: Floats) -> float:
    """Largest distance of a quantity from its straight path, as a share of its larger end.

    Parameters
    ----------
    values : (F,) float64
        Positive, such as areas or perimeters; the first and last are those at 0 and 1.
    t : (F,) float64

    Notes
    -----
    max |A_t - ((1 - t) A_0 + t A_1)| / max(A_0, A_1).
    """
    straight = (1 - t) * values[0] + t * values[-1]
    return float(np.abs(values - straight).max() / max(values[0], values[-1]))


def detour(values: Floats) -> float:
    """Total variation beyond what the ends need, as a share of the larger end, values (F,).

    Notes
    -----
    (sum |A_{k+1} - A_k| - |A_1 - A_0|) / max(A_0, A_1): 0 for a monotone path.
    """
    needed = abs(values[-1] - values[0])
    return float((np.abs(np.diff(values)).sum() - needed) / max(values[0], values[-1]))


def overshoot(lengths: Floats) -> float:
    """How far a length leaves the range of its two ends, as a share of that end; the worst.

    Parameters
    ----------
    lengths : (F, E) float64
        Positive at both ends.

    Notes
    -----
    max over edges and times of l_t / max(l_0, l_1) - 1 and 1 - l_t / min(l_0, l_1), at least 0.
    """
    longer, shorter = np.maximum(lengths[0], lengths[-1]), np.minimum(lengths[0], lengths[-1])
    return float(max((lengths / longer - 1).max(), (1 - lengths / shorter).max(), 0.0))


def roughness(points: Points, t: Floats, size: float) -> float:
    """Mean size of the second derivative in time, as a share of a size.

    Parameters
    ----------
    points : (F, V, 2) float64
    t : (F,) float64
        Even.
    size : float
        Diameter of the shape.

    Notes
    -----
    mean |x(t + h) - 2 x(t) + x(t - h)| / h^2 / size.
    """
    step = float(t[1] - t[0])
    second = points[2:] - 2 * points[1:-1] + points[:-2]
    return float(np.linalg.norm(second, axis=-1).mean() / step**2 / size)


def travel(points: Points, size: float) -> float:
    """Mean length of the points' paths (F, V, 2), as a share of a size."""
    return float(np.linalg.norm(np.diff(points, axis=0), axis=-1).sum(axis=0).mean() / size)


def reversibility(there: Points, back: Points, radius: float) -> float:
    """How much the way back differs from the way there, root mean square over a radius.

    Parameters
    ----------
    there : (F, V, 2) float64
        From source to target at times t.
    back : (F, V, 2) float64
        From target to source at times 1 - t.
    radius : float
        Root mean square radius of the shape.
    """
    return float(np.sqrt(((there - back) ** 2).sum(axis=-1).mean()) / radius)
