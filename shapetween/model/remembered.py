"""Results of functions of outlines, remembered by what the outlines' curves are.

Stages cut, clean and turn round what they are given, and so hold many outlines of the same curves:
what one has found about them the next one need not find again.
"""

from collections.abc import Callable
from functools import lru_cache, wraps
from typing import TypeVar

import numpy as np

from shapetween.model.outline import Outline

__all__ = ["by_curves"]

T = TypeVar("T")


def by_curves(maxsize: int) -> Callable[[Callable[..., T]], Callable[..., T]]:
    """Remember the last results of a function of outlines alone.

    Parameters
    ----------
    maxsize : int
        So many results.

    Notes
    -----
    The function gets outlines of the same curves, not the very ones it was asked about.
    """

    def remembered(function: Callable[..., T]) -> Callable[..., T]:
        @lru_cache(maxsize)
        def found(*curves: tuple[bytes, bool]) -> T:
            numbers = [(np.frombuffer(own, np.float64), closed) for own, closed in curves]
            return function(*(Outline(n.reshape(-1, 4, 2), closed) for n, closed in numbers))

        @wraps(function)
        @lru_cache(maxsize)  # outlines are frozen: the very same one is known at once
        def again(*outlines: Outline) -> T:
            return found(*((own.curves.tobytes(), own.closed) for own in outlines))

        return again

    return remembered
