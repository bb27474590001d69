"""Whether one outline is plainly the other one, bent a little: it bends at the same places."""

import numpy as np

from shapetween.base.arrays import Floats
from shapetween.match.candidate import PLACES, Candidate
from shapetween.match.costs import Prepared, sample_features

__all__ = ["bends_alike", "plainly_the_same"]

#: Of the windows that turning is measured in, how many of the finest count. Outlines of two things
#: of one kind turn alike over a limb's length; only those of one thing also do so at every corner.
FINEST = 2

#: Likeness of the bends, and half of what it is more than in the other frame, from which on two
#: outlines begin to be plainly the same, and are. Lower takes a bell on its head for a bell; higher
#: leaves upright what is plainly turned but was bent on the way.
PLAIN_FROM, PLAIN_TO = 0.8, 0.9


def bends_alike(a: Prepared, b: Prepared, candidate: Candidate) -> float:
    """Correlation of the turning of two outlines at the places matched, at most 1."""
    knots = (candidate.a - candidate.a[0] + candidate.b - candidate.b[0]) / 2
    even = np.arange(PLACES) / PLACES
    turns = [
        sample_features(side, np.interp(even, knots, at)).turns[:FINEST]
        for side, at in ((a, candidate.a), (b, candidate.b))
    ]
    first, second, both = _sums(turns[0], turns[0]), _sums(turns[1], turns[1]), _sums(*turns)
    return float((both / np.sqrt(first * second)).mean())


def _sums(first: Floats, second: Floats) -> Floats:
    return np.asarray((first * second).sum(axis=1))


def plainly_the_same(alike: float, otherwise: float) -> float:
    """From 0 to 1, by the likeness of bends in one frame and in another."""
    clear = alike + (alike - otherwise) / 2
    return min(max((clear - PLAIN_FROM) / (PLAIN_TO - PLAIN_FROM), 0.0), 1.0)
