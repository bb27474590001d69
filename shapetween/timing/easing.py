"""From a player's clock to the movement's time.

A player's clock `u` goes evenly from 0 to 1; the movement's time `t` is what an easing makes of it,
a Bezier curve through both: (u, t) = (x(s), y(s)).

.. [Css] CSS Easing Functions Level 1, section 2.2, W3C.
.. [Css2] CSS Easing Functions Level 2, W3C.
"""

import re
from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import TypeAlias

import numpy as np

from shapetween.base.arrays import Floats
from shapetween.base.errors import OptionError
from shapetween.timing.springs import spring

__all__ = [
    "EASINGS",
    "LINEAR",
    "Easing",
    "bezier_share",
    "easing_function",
    "even_times",
    "handles_of",
    "is_plain",
    "overshoots",
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

#: How far an easing may run past 0 and 1: what movement there is beyond its ends.
FARTHEST = 1.0

_CALL = re.compile(r"(cubic-bezier|spring|linear)\((.*)\)", re.DOTALL)

#: Halvings with which a Bezier easing is solved for its parameter: to the last bit of a double.
BISECTIONS = 60


def easing_function(name: str) -> Easing:
    """The easing of that name.

    Parameters
    ----------
    name : str
        One of `EASINGS`; or in CSS's notation ``cubic-bezier(x1,y1,x2,y2)``, y1 and y2 of which may
        run past 0 and 1, and ``linear(0, .3 20%, 1)``; or ``spring(mass, stiffness, damping)``.

    Raises
    ------
    OptionError
        If there is no such easing, or it overshoots by more than `FARTHEST`.

    Examples
    --------
    >>> easing_function("ease-in")(np.array([0.0, 0.5, 1.0])).round(3)
    array([0.   , 0.315, 1.   ])
    >>> easing_function("linear(0, 1 25%, .5, 1)")(np.array([0.125, 0.25, 0.625]))
    array([0.5, 1. , 0.5])
    """
    kind, numbers = _parsed(name)
    ease = _piecewise(name, numbers) if kind == "linear" else _smooth(name, kind, numbers)
    times = ease(np.linspace(0.0, 1.0, 1001))
    if times.min() < -FARTHEST or times.max() > 1 + FARTHEST:
        raise OptionError(
            f"easing {name!r}: runs to {times.min():.3g} and {times.max():.3g}; expected to stay "
            f"from {-FARTHEST:g} to {1 + FARTHEST:g}"
        )
    return ease


def is_plain(name: str) -> bool:
    """Whether an easing is a single Bezier curve that stays from 0 to 1, as SMIL's are.

    Raises
    ------
    OptionError
        If there is no such easing.
    """
    kind, numbers = _parsed(name)
    return kind == "cubic-bezier" and all(0 <= v <= 1 for v in numbers)


def overshoots(name: str) -> bool:
    """Whether an easing leaves what is from 0 to 1."""
    times = easing_function(name)(np.linspace(0.0, 1.0, 1001))
    return bool(times.min() < 0 or times.max() > 1)


def _smooth(name: str, kind: str, numbers: tuple[float, ...]) -> Easing:
    """A spring, or a Bezier curve."""
    if kind == "spring":
        if len(numbers) != 3:
            raise _unknown(name)
        return spring(*numbers)
    x1, y1, x2, y2 = numbers
    if (x1, x2) == (y1, y2):
        return np.asarray
    low_time, high_time = (-np.inf, np.inf) if min(y1, y2) < 0 or max(y1, y2) > 1 else (0.0, 1.0)

    def ease(u: Floats) -> Floats:
        """Solve x(s) = u, which rises with s, by halving; the answer is y(s) ([Css]_)."""
        clock = np.asarray(u, np.float64)
        low, high = np.zeros_like(clock), np.ones_like(clock)
        for _ in range(BISECTIONS):
            middle = (low + high) / 2
            before = bezier_share(middle, x1, x2) < clock
            low, high = np.where(before, middle, low), np.where(before, high, middle)
        time = np.clip(bezier_share((low + high) / 2, y1, y2), low_time, high_time)
        return np.where((clock <= 0) | (clock >= 1), clock, time)

    return ease


def _piecewise(name: str, numbers: tuple[float, ...]) -> Easing:
    """Straight from point to point ([Css2]_, section 2.2): times, then clocks, NaN where not said.

    The ends are 0 and 1 whatever is said, for a movement starts and ends with its drawings.
    """
    values, given = np.array(numbers).reshape(2, -1)
    given[0] = 0.0 if np.isnan(given[0]) else given[0]
    given[-1] = 1.0 if np.isnan(given[-1]) else given[-1]
    known = np.flatnonzero(~np.isnan(given))
    clocks = np.interp(np.arange(len(given)), known, np.maximum.accumulate(given[known]))
    if values[0] != 0 or values[-1] != 1 or clocks[0] != 0 or clocks[-1] != 1:
        raise OptionError(f"easing {name!r}: expected it to run from 0 to 1")
    return lambda u: np.asarray(np.interp(u, clocks, values))


def bezier_share(s: Floats, first: float | Floats, second: float | Floats) -> Floats:
    """A cubic Bezier from 0 to 1 with the two handles given."""
    r = 1 - s
    return 3 * r * r * s * first + 3 * r * s * s * second + s**3


def handles_of(name: str) -> tuple[float, float, float, float]:
    """The handles x1, y1, x2, y2 of an easing that is plain.

    Raises
    ------
    OptionError
        If it is not, or none at all.
    """
    kind, numbers = _parsed(name)
    if kind != "cubic-bezier" or not all(0 <= v <= 1 for v in numbers):
        raise OptionError(f"easing {name!r}: is no single curve from 0 to 1, which is needed here")
    x1, y1, x2, y2 = numbers
    return x1, y1, x2, y2


def _parsed(name: str) -> tuple[str, tuple[float, ...]]:
    """The function of an easing and its numbers; those of ``linear`` are times, then clocks."""
    if name in EASINGS:
        return "cubic-bezier", EASINGS[name]
    found = _CALL.fullmatch(name.strip().lower())
    if found is None:
        raise _unknown(name)
    kind, inner = found.groups()
    try:
        if kind == "linear":
            return kind, _stops(inner)
        numbers = tuple(float(part) for part in inner.split(","))
    except ValueError as error:
        raise _unknown(name) from error
    if not np.isfinite(numbers).all():
        raise _unknown(name)
    if kind == "cubic-bezier" and not (
        len(numbers) == 4 and 0 <= numbers[0] <= 1 and 0 <= numbers[2] <= 1
    ):
        raise _unknown(name)
    return kind, numbers


def _stops(text: str) -> tuple[float, ...]:
    """Times and clocks of ``linear``'s points, each with one clock, with two, or with none."""
    times, clocks = [], []
    for stop in text.split(","):
        value, *shares = stop.split()
        if len(shares) > 2 or not all(share.endswith("%") for share in shares):
            raise ValueError(stop)
        for share in shares or ["nan%"]:
            times.append(float(value))
            clocks.append(float(share[:-1]) / 100)
    if len(times) < 2 or not np.isfinite(times).all():
        raise ValueError(text)
    return (*times, *clocks)


def _unknown(name: str) -> OptionError:
    return OptionError(
        f"easing {name!r}: expected {', '.join(EASINGS)}, cubic-bezier(x1,y1,x2,y2) with x1 and x2 "
        "from 0 to 1, spring(mass,stiffness,damping) or linear(0, .3 20%, 1)"
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
