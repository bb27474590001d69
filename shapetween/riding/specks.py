"""Pieces too small for meshes of their own: closed lines that become others in place."""

import math

import numpy as np

from shapetween.outline import Outline
from shapetween.riding.nearby import matched_nearby
from shapetween.riding.planes import AffinePlane
from shapetween.riding.riders import Rider, riding

__all__ = ["morph_speck"]

_RESTING = AffinePlane(np.eye(2, 3), np.zeros(2))


def morph_speck(source: Outline, target: Outline) -> Rider:
    """Prepare the movement of a ring too small for a mesh of its own.

    Parameters
    ----------
    source, target : Outline
        Closed.
    """
    parts = matched_nearby(source, target, _RESTING, fine=False)
    return riding(parts, _RESTING, (math.inf, math.inf))
