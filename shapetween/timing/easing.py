"""When frames are taken: easing, even frames, and keyframes no denser than the eye needs.

Two clocks run here. A player's clock `u` goes evenly from 0 to 1; the movement's time `t` is what
an easing makes of it, a Bezier curve through both: (u, t) = (x(s), y(s)). Between keyframes a
player moves straight; but it can be told to ease on the way exactly as the whole does. So keyframes
are needed only where the movement is not straight in `t`.

.. [Css] CSS Easing Functions Level 1, section 2.2, W3C.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import TypeAlias

import numpy as np

from shapetween.base.arrays import Floats, Index
from shapetween.base.errors import OptionError
from shapetween.geometry.bezier import sub_curves

__all__ = [
    "EASINGS",
    "KEYFRAME_TOLERANCE",
    "Easing",
    "Schedule",
    "easing_function",
    "even_times",
    "keyframes",
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

#: How far a control point may be from its place between two keyframes, as a share of the view
#: box's larger side: 0.18 px at 1000 px, which with the default rounding stays within a quarter of
#: a pixel. Larger and the in-betweens drift visibly; smaller and the file grows for nothing seen.
KEYFRAME_TOLERANCE = 1.8e-4

#: Steps on which keyframes may lie. Fewer miss quick turns between two of them; more cost time.
#: 120 has the halves, thirds, quarters, fifths and sixths of a chain of movements.
SAMPLE_STEPS = 120

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
    x1, y1, x2, y2 = _handles(name)
    if (x1, x2) == (y1, y2):
        return np.asarray

    def ease(u: Floats) -> Floats:
        """Solve x(s) = u, which rises with s, by halving; the answer is y(s) ([Css]_)."""
        clock = np.asarray(u, np.float64)
        low, high = np.zeros_like(clock), np.ones_like(clock)
        for _ in range(BISECTIONS):
            middle = (low + high) / 2
            before = _bezier(middle, x1, x2) < clock
            low, high = np.where(before, middle, low), np.where(before, high, middle)
        time = np.clip(_bezier((low + high) / 2, y1, y2), 0.0, 1.0)
        return np.where((clock <= 0) | (clock >= 1), clock, time)

    return ease


def _bezier(s: Floats, first: float, second: float) -> Floats:
    """A cubic Bezier from 0 to 1 with the two handles given."""
    r = 1 - s
    return 3 * r * r * s * first + 3 * r * s * s * second + s**3


def _handles(name: str) -> tuple[float, float, float, float]:
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


@dataclass(frozen=True, slots=True, eq=False)
class Schedule:
    """Samples of a movement as a player shows them, even along the easing's curve.

    So a steep easing leaves no gap in either clock.

    Attributes
    ----------
    clock : (S,) float64
        When the player shows each sample, from 0 to 1.
    time : (S,) float64
        The movement's time then.
    handles : tuple of float
        x1, y1, x2, y2 of the easing.
    """

    clock: Floats
    time: Floats
    handles: tuple[float, float, float, float]

    @classmethod
    def of(cls, easing: str, count: int = SAMPLE_STEPS + 1) -> "Schedule":
        """The schedule of an easing, `count` samples long."""
        x1, y1, x2, y2 = _handles(easing)
        s = even_times(count)
        if (x1, x2) == (y1, y2):
            return cls(s, s, LINEAR)
        # Rounding must neither leave [0, 1] nor turn the clock back where it all but stands.
        clock = np.maximum.accumulate(np.clip(_bezier(s, x1, x2), 0.0, 1.0))
        return cls(clock, np.clip(_bezier(s, y1, y2), 0.0, 1.0), (x1, y1, x2, y2))

    def thinned(self, stride: int) -> "Schedule":
        """Every so manieth sample."""
        return Schedule(self.clock[::stride], self.time[::stride], self.handles)

    @property
    def stops(self) -> list[int]:
        """Samples that must be keyframes, besides the ends, for `parts` to stay in their square.

        Notes
        -----
        The speed along either axis is a parabola that is nowhere negative; in Bernstein form over
        the whole its coefficients are a, b, c. A part that has its lowest point inside may have a
        negative b, and then a handle outside; no other part can.
        """
        x1, y1, x2, y2 = self.handles
        lowest = []
        for first, second in ((x1, x2), (y1, y2)):
            a, b, c = first, second - first, 1 - second
            if b < 0:
                lowest.append(round((a - b) / (a - 2 * b + c) * (len(self.time) - 1)))
        return sorted(set(lowest))

    def parts(self, picks: Index) -> Floats:
        """The easing between each two of the samples picked, (M - 1, 4), as handles x1 y1 x2 y2.

        Any part of a Bezier is a Bezier, and every coordinate is from 0 to 1 if the `stops` are
        among the picks.
        """
        s = picks / max(len(self.clock) - 1, 1)
        whole = np.array([0.0, 0.0, *self.handles, 1.0, 1.0]).reshape(1, 4, 2)
        curves = sub_curves(np.repeat(whole, len(s) - 1, axis=0), s[:-1], s[1:])
        start, size = curves[:, :1], curves[:, 3:] - curves[:, :1]
        inner = (curves[:, 1:3] - start) / np.where(size > 0, size, 1.0)
        return np.clip(inner, 0.0, 1.0).reshape(-1, 4)


def keyframes(samples: Floats, times: Floats, tolerance: float) -> Index:
    """Choose samples between which straight lines stay near all the others.

    Parameters
    ----------
    samples : (S, K, D) float64
        K points, or colours.
    times : (S,) float64
        The movement's time of each sample, not falling.
    tolerance : float
        Greatest distance allowed between a point and the straight line in time that stands for it.
        Moving a Bezier's control points moves no point of the curve farther.

    Returns
    -------
    (M,) intp
        Rising indices, the first and the last sample among them.

    Notes
    -----
    From each keyframe the next one is put as far on as every shorter step was still near enough.
    That takes about as few as any choice could, and the same ones every time.
    """
    last = len(samples) - 1
    if not np.ptp(samples, axis=0).any():
        return np.unique([0, last])
    chosen = [0]
    # The points that were too far before are the likeliest to be so again.
    watched: list[int] = []
    while chosen[-1] < last:
        start = chosen[-1]
        end = start + 1
        while end < last:
            some, when = samples[start : end + 2], times[start : end + 2]
            if watched and _farthest(some[:, watched], when)[1] > tolerance:
                break
            point, distance = _farthest(some, when)
            if distance > tolerance:
                watched.append(point)
                break
            end += 1
        chosen.append(end)
    return np.array(chosen, np.intp)


def _farthest(samples: Floats, times: Floats) -> tuple[int, float]:
    """The point farthest from its straight way from the first to the last sample, and how far."""
    span = times[-1] - times[0]
    share = ((times[1:-1] - times[0]) / (span if span > 0 else 1.0))[:, None, None]
    straight = (1 - share) * samples[0] + share * samples[-1]
    away = ((samples[1:-1] - straight) ** 2).sum(-1).max(axis=0)
    point = int(away.argmax())
    return point, float(np.sqrt(away[point]))
