"""What every method offers: prepared once, then asked for all vertices at many times."""

from typing import Protocol

from numpy.typing import ArrayLike

from shapetween.base.arrays import Points

__all__ = ["Tween"]


class Tween(Protocol):
    """A movement of a mesh's vertices."""

    def vertices(self, t: ArrayLike) -> Points:
        """All vertices at the times (F,), shape (F, V, 2); exactly the pair's own at 0 and 1."""
