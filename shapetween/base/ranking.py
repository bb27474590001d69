"""Values as they may be compared: what is equal but for rounding comes out equal."""

import numpy as np
from numpy.typing import ArrayLike

from shapetween.base.arrays import Floats

__all__ = ["comparable"]

#: Steps in the greatest of the values. Fewer call what differs equal; more let rounding, and so the
#: unit and the processor, put equal things in order.
STEPS = 1e9


def comparable(values: ArrayLike) -> Floats:
    """Values in whole steps of a billionth of the greatest one, by which they may be sorted.

    Parameters
    ----------
    values : (...,) float64
        Finite, of any unit.
    """
    numbers = np.asarray(values, dtype=np.float64)
    greatest = float(np.abs(numbers).max(initial=0.0))
    return np.asarray(np.round(numbers / greatest * STEPS)) if greatest > 0 else numbers
