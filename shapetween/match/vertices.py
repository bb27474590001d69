"""The few points of an outline that a person would name: tips, corners, notches.

.. [Lat99] L. J. Latecki, R. Lakämper, *Convexity rule for shape decomposition based on discrete
   contour evolution*, CVIU 73, 1999.
"""

import cmath
from dataclasses import dataclass

import numpy as np

from shapetween.base.arrays import Floats, Index, Mask, Points

__all__ = ["Vertices", "salient_vertices"]

#: Vertices kept. Fewer lose limbs; more are ripples and the corners of blunt tips, which have no
#: counterpart in a shape drawn with another pen.
KEPT = 14

#: Every how many-th sample the evolution starts from; the vertices found are samples still.
EVOLVED_STEP = 2

#: Relevances closer than this, in roots of the area, are equal.
EQUAL = 1e-9


@dataclass(frozen=True, slots=True, eq=False)
class Vertices:
    """Salient points of one outline, in order.

    Attributes
    ----------
    index : (K,) intp
        The samples they are.
    weight : (K,) float64
        Root of the relevance, 1 on average: a limb twice as long is not twice as important.
    convex : (K,) bool
        Tips and corners, not notches.
    """

    index: Index
    weight: Floats
    convex: Mask


def salient_vertices(points: Points) -> Vertices:
    """Vertices left when the least relevant ones of a closed polygon are taken out one by one.

    Notes
    -----
    Relevance is the turn angle times l1 l2 / (l1 + l2) of the two sides at the vertex [Lat99]_.
    """
    # One vertex at a time: plain numbers are quicker than arrays of three points.
    index = list(range(0, len(points), EVOLVED_STEP))
    place = [complex(x, y) for x, y in points[::EVOLVED_STEP]]
    relevance = [abs(_relevance(place, k)) for k in range(len(place))]
    while len(index) > KEPT:
        # Of equally irrelevant ones, as along a straight side, the first: rounding has no say.
        limit = min(relevance) + EQUAL
        least = next(k for k, value in enumerate(relevance) if value <= limit)
        del index[least], place[least], relevance[least]
        for beside in (least - 1, least % len(place)):
            relevance[beside] = abs(_relevance(place, beside))
    signed = np.array([_relevance(place, k) for k in range(len(place))])
    signed[np.abs(signed) <= EQUAL] = 0.0  # on a straight side; rounding has no say which way
    weight = np.sqrt(np.abs(signed))
    return Vertices(np.array(index, dtype=np.intp), weight / weight.mean(), signed > 0)


def _relevance(place: list[complex], k: int) -> float:
    """Relevance of one vertex of a closed polygon, negative where it is a notch."""
    arriving = place[k] - place[k - 1]
    leaving = place[(k + 1) % len(place)] - place[k]
    first, second = abs(arriving), abs(leaving)
    if first == 0 or second == 0:
        return 0.0
    return cmath.phase(leaving / arriving) * first * second / (first + second)
