"""Whether one outline seems to face the other way than the other."""

import numpy as np

from shapetween.match.correspondence import Correspondence
from shapetween.match.costs import Prepared, prepare
from shapetween.match.match import upright_matching_cost

__all__ = ["faces_other_way"]

#: Share of its cost at which the mirror image must match. On 330 pairs looked at half of those that
#: face opposite ways lie below, and hardly another. Higher hints at what only looks alike from both
#: sides; lower misses more.
MIRRORED_RATIO = 0.75

FLIP = np.array([[-1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])


def faces_other_way(a: Prepared, b: Prepared, found: Correspondence) -> bool:
    """Whether the first outline's mirror image would match far better as drawn.

    Parameters
    ----------
    a, b : Prepared
    found : Correspondence
        Their best matching. If it turns them, that is what is meant.
    """
    if found.affine is not None or found.turn != 0 or a.axes.present or b.axes.present:
        return False
    mirrored = prepare(a.samples.arcs.outline.transformed(FLIP).reversed())
    return upright_matching_cost(mirrored, b) < MIRRORED_RATIO * found.cost
