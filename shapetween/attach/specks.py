"""Pieces too small for meshes of their own: closed lines that become others in place."""

import math

import numpy as np

from shapetween.attach.nearby import matched_nearby
from shapetween.attach.planes import AffinePlane
from shapetween.attach.riders import Rider, riding
from shapetween.model.outline import Outline

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
