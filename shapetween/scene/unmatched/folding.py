"""Lines without a partner that hang on one line by both ends fold down onto it, and rise from it.

A handle, a shackle, a dome: drawn along its length it would leave one of its joints, and from both
ends it would break into prongs.
"""

import numpy as np

from shapetween.scene.cuts.lines import opaque
from shapetween.scene.forms import Segment
from shapetween.scene.motion.fold import Fold
from shapetween.scene.places import Places, cut_alike, run_between
from shapetween.scene.unmatched.going import Side

__all__ = ["fold_onto"]

#: Greatest length of what a line folds onto, as a share of its own, for straight lines to stay
#: straight, and else. Larger, and lines across a thing swing aside to its border instead of going
#: to their middle; smaller, and a hill in a picture comes loose.
STRAIGHT_RUN, RUN = 1.02, 1.25

#: Difference of colours of what folds and what it folds onto, and share of width by which it may
#: be wider: more, and it is seen to vanish.
COLOUR, WIDER = 0.05, 1.1


def fold_onto(k: int, anchor: int, side: Side) -> Fold | None:
    """How a line folds onto what both its ends lie on; None if it does not lie along that.

    Parameters
    ----------
    k : int
        An open line.
    anchor : int
        What both its ends lie on; if it goes as well, it does so later.
    side : Side
    """
    item, other = side.scene.items[k], side.scene.items[anchor]
    tracks = side.anchors.get(anchor, ())
    if other.filled or len(tracks) > 1 or not opaque(other):
        return None
    if np.abs(item.colour - other.colour).max() > COLOUR or item.width > WIDER * other.width:
        return None
    places = Places(other.outer)
    low, high = places.nearest(item.outer.curves[[0, -1], [0, 3]]).tolist()
    run = Places(run_between(places, low, high))
    straight = isinstance(side.scene.forms[k], Segment)
    if run.length > (STRAIGHT_RUN if straight else RUN) * item.length:
        return None
    knots = np.array([0.0, 1.0])
    pieces = cut_alike(Places(item.outer), run, knots, knots)
    return Fold(pieces, tracks[0] if tracks else None, side.end, side.scene.scale)
