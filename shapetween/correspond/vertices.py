"""The few points of an outline that a person would name: tips, corners, notches.

.. [Lat99] L. J. Latecki, R. Lakämper, *Convexity rule for shape decomposition based on discrete
   contour evolution*, CVIU 73, 1999.
"""

from dataclasses import dataclass

import numpy as np

from shapetween.arrays import Floats, Index, Mask, Points
from shapetween.geometry.polygon import cross

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
    index = np.arange(0, len(points), EVOLVED_STEP)
    relevance, _ = _relevance(points, index)
    while len(index) > KEPT:
        # Of equally irrelevant ones, as along a straight side, the first: rounding has no say.
        least = int(np.argmax(relevance <= relevance.min() + EQUAL))
        index, relevance = np.delete(index, least), np.delete(relevance, least)
        beside = np.array([least - 1, least]) % len(index)
        relevance[beside], _ = _relevance(points, index, beside)
    relevance, convex = _relevance(points, index)
    weight = np.sqrt(relevance)
    return Vertices(index, weight / weight.mean(), convex)


def _relevance(points: Points, index: Index, which: Index | None = None) -> tuple[Floats, Mask]:
    """Relevance of vertices of a polygon, and whether it is convex there."""
    at = np.arange(len(index)) if which is None else which
    before, here, after = (points[index[(at + step) % len(index)]] for step in (-1, 0, 1))
    arriving, leaving = here - before, after - here
    turn = np.arctan2(cross(arriving, leaving), (arriving * leaving).sum(-1))
    first, second = np.linalg.norm(arriving, axis=-1), np.linalg.norm(leaving, axis=-1)
    whole = first + second
    return np.abs(turn) * first * second / np.where(whole > 0, whole, 1.0), turn > 0
