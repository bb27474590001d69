"""Every vertex along a straight line: the plainest movement there is."""

import numpy as np
from numpy.typing import ArrayLike

from shapetween.base.arrays import Points, times
from shapetween.mesh.pair import MeshPair

__all__ = ["Linear"]


class Linear:
    """A mesh pair moved in straight lines, the yardstick that other methods must beat.

    Parts that turn shrink on the way, to nothing at half a turn. No face is refused, not even one
    that is inverted or has no area.

    Parameters
    ----------
    pair : MeshPair
    """

    def __init__(self, pair: MeshPair) -> None:
        self.pair = pair

    def vertices(self, t: ArrayLike) -> Points:
        """All vertices at the times (F,), shape (F, V, 2); exactly the pair's own at 0 and 1."""
        time = times(t)[:, None, None]
        return np.asarray((1 - time) * self.pair.source + time * self.pair.target)
