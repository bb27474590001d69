"""From a player's clock to the movement's time.

A player's clock `u` goes evenly from 0 to 1; the movement's time `t` is what an easing makes of it,
a Bezier curve through both: (u, t) = (x(s), y(s)).

.. [Css] CSS Easing Functions Level 1, section 2.2, W3C.
"""

from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import TypeAlias

import numpy as np

from shapetween.base.arrays import Floats
from shapetween.base.errors import OptionError

__all__ = [
    "EASINGS",
    "LINEAR",
    "Easing",
    "bezier_share",
    "easing_function",
    "even_times",
    "handles_of",
]

Easing: TypeAlias = Callable[[Floats], Floats]
"""From a player's clock to the movement's time, both from 0 to 1."""

#: Handles x1, y1, x2, y2 of the named easings, as CSS has them.
EASINGS: Mapping[str, tuple[float, float, float, float]] = MappingProxyType(
    {
        "linear": (0.0, 0.0, 1.0, 1.0),
        "ease": (0.25, 0.1, 0.25, 1.0),
        "ease-in": (0.42, 0.0, 1.0, 1.0),
        "ease-out": (0.0, 0.0, 0.58, 1.0),
        "ease-in-out": (0.42, 0.0, 0.58, 1.0),
    }
)

LINEAR = EASINGS["linear"]

#: Halvings with which a Bezier easing is solved for its parameter: to the last bit of a double.
BISECTIONS = 60


def easing_function(name: str) -> Easing:
    """The easing of that name, or of a ``cubic-bezier(x1,y1,x2,y2)``.

    Parameters
    ----------
    name : str
        One of `EASINGS`, or four numbers from 0 to 1 in CSS's notation. CSS lets y1 and y2 run
        past 0 and 1; a movement has nothing to show before its start and after its end, so here
        they may not.

    Raises
    ------
    OptionError
        If there is no such easing.

    Examples
    --------
    >>> easing_function("ease-in")(np.array([0.0, 0.5, 1.0])).round(3)
    array([0.   , 0.315, 1.   ])
    """
    x1, y1, x2, y2 = handles_of(name)
    if (x1, x2) == (y1, y2):
        return np.asarray

    def ease(u: Floats) -> Floats:
        """Solve x(s) = u, which rises with s, by halving; the answer is y(s) ([Css]_)."""
        clock = np.asarray(u, np.float64)
        low, high = np.zeros_like(clock), np.ones_like(clock)
        for _ in range(BISECTIONS):
            middle = (low + high) / 2
            before = bezier_share(middle, x1, x2) < clock
            low, high = np.where(before, middle, low), np.where(before, high, middle)
        time = np.clip(bezier_share((low + high) / 2, y1, y2), 0.0, 1.0)
        return np.where((clock <= 0) | (clock >= 1), clock, time)

    return ease


def bezier_share(s: Floats, first: float, second: float) -> Floats:
    """A cubic Bezier from 0 to 1 with the two handles given."""
    r = 1 - s
    return 3 * r * r * s * first + 3 * r * s * s * second + s**3


def handles_of(name: str) -> tuple[float, float, float, float]:
    """The handles x1, y1, x2, y2 of an easing."""
    if name in EASINGS:
        return EASINGS[name]
    compact = "".join(name.split()).lower()
    inner = compact.removeprefix("cubic-bezier(").removesuffix(")")
    try:
        x1, y1, x2, y2 = (float(part) for part in inner.split(","))
    except ValueError:
        pass
    else:
        if compact == f"cubic-bezier({inner})" and all(0 <= v <= 1 for v in (x1, y1, x2, y2)):
            return x1, y1, x2, y2
    raise OptionError(
        f"easing {name!r}: expected {', '.join(EASINGS)}, or cubic-bezier(x1,y1,x2,y2) "
        "with numbers from 0 to 1"
    )


def even_times(count: int) -> Floats:
    """Times k / (count - 1), (count,); a single frame is the first.

    Raises
    ------
    OptionError
        If no frame is asked for.
    """
    if count < 1:
        raise OptionError(f"{count} frames: expected at least 1")
    return np.arange(count) / max(count - 1, 1)
