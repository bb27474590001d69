"""A spring as an easing: pulled from 0 to 1, and let go.

Mass m, stiffness k and damping c move by m x'' = -k (x - 1) - c x', from rest. A way is as long as
it takes until that is at rest again, whatever its seconds are said to be.
"""

import math
from collections.abc import Callable

import numpy as np

from shapetween.base.arrays import Floats
from shapetween.base.errors import OptionError

__all__ = ["spring"]

#: How far from its end a spring counts as at rest. Larger, and what is left is seen as a jump at
#: the end; smaller, and most of the time nothing is seen to move.
AT_REST = 2e-3

#: Least damping, as a share of that from which on nothing swings. Less swings for so long that a
#: way is a blur.
LEAST_DAMPING = 0.05

#: How near to 1 a share of damping counts as 1, where the two formulas around it lose all digits.
CRITICAL = 1e-6


def spring(mass: float, stiffness: float, damping: float) -> Callable[[Floats], Floats]:
    """The easing of a spring, from a clock that runs from 0 to 1.

    Raises
    ------
    OptionError
        If it is no spring, or swings all but for ever.

    Examples
    --------
    >>> spring(1, 100, 10)(np.array([0.0, 0.3, 1.0])).round(2)
    array([0.  , 1.16, 1.  ])
    """
    if not all(math.isfinite(v) and v > 0 for v in (mass, stiffness, damping)):
        raise OptionError("easing spring(mass, stiffness, damping): expected numbers above 0")
    pace = math.sqrt(stiffness / mass)
    share = damping / (2 * math.sqrt(stiffness * mass))
    if not LEAST_DAMPING <= share <= 1 / LEAST_DAMPING:
        low, high = (2 * math.sqrt(stiffness * mass) * s for s in (LEAST_DAMPING, 20.0))
        raise OptionError(
            f"easing spring(...): with a damping of {damping:g} it all but never rests; "
            f"expected from {low:.3g} to {high:.3g}"
        )
    if abs(share - 1) < CRITICAL:
        share = 1.0
    # The slowest part dies away as exp(-decay * time).
    decay = pace * (share if share <= 1 else share - math.sqrt(share * share - 1))
    length = _rest(lambda time: _away(np.array([time]), pace, share)[0], 1 / decay)

    def ease(u: Floats) -> Floats:
        clock = np.asarray(u, np.float64)
        left = _away(clock * length, pace, share)
        # What is left at the end, too little to be seen, is taken away all along the way.
        last = float(_away(np.array([length]), pace, share)[0])
        value = 1 - left + last * clock
        return np.asarray(np.where((clock <= 0) | (clock >= 1), clock, value))

    return ease


def _away(time: Floats, pace: float, share: float) -> Floats:
    """How far the spring is from its rest, 1 at first."""
    if share < 1:
        turn = pace * math.sqrt(1 - share * share)
        swing = np.cos(turn * time) + share * pace / turn * np.sin(turn * time)
        return np.asarray(np.exp(-share * pace * time) * swing)
    if share == 1:
        return np.asarray(np.exp(-pace * time) * (1 + pace * time))
    root = math.sqrt(share * share - 1)
    slow, fast = pace * (share - root), pace * (share + root)
    return np.asarray((fast * np.exp(-slow * time) - slow * np.exp(-fast * time)) / (fast - slow))


def _rest(away: Callable[[float], float], unit: float) -> float:
    """When it is at rest, to a hundredth of the time in which what is left falls by e."""
    times = np.arange(1, 3000) * unit / 100
    far = [abs(away(float(time))) > AT_REST for time in times]
    return float(times[max(k for k, is_far in enumerate(far) if is_far) + 1])
