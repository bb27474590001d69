"""How finely matchings are looked for, what a salient vertex earns, and what counts as equal."""

import numpy as np

from shapetween.base.arrays import Floats

__all__ = ["BAND", "FINE_SAMPLES", "MATCH_SAMPLES", "VERTEX_REWARD", "rounded"]

#: Samples a matching is chosen with. Fewer lose fingers; more cost time with the cube and match no
#: better.
MATCH_SAMPLES = 64

#: Samples a chosen matching is refined with, and how far it may move, as a share of them.
FINE_SAMPLES, BAND = 192, 0.04

#: Reward of a salient vertex that meets its like, as a share of what all samples cost at a cost of
#: 1. Less, and a limb counts by its length alone, or its tip comes to lie beside the other's; more,
#: and what lies between is not listened to.
VERTEX_REWARD = 2.8 / MATCH_SAMPLES

#: What costs are rounded to. Libraries differ in their last digits from processor to processor;
#: sums of rounded costs do not, and equal ones stay equal. Coarser would make unequal ones equal.
GRAIN = 2.0**-30


def rounded(costs: Floats) -> Floats:
    """Costs rounded, so that no processor's last digit decides between two paths."""
    return np.asarray(np.round(costs / GRAIN) * GRAIN)
