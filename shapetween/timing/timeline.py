"""When movements in a row are played: one after another, with rests, there or there and back.

Everything in an animated file runs on one clock, as long as the whole, so that all of it stays in
step wherever a player is moved to. What belongs to one movement of the row, a leg, knows its own
iterations on that clock.
"""

import math
from dataclasses import dataclass, replace
from typing import Literal, TypeAlias, get_args

from shapetween.base.arrays import Floats
from shapetween.base.errors import OptionError

__all__ = ["Iteration", "Loop", "Timeline"]

Loop: TypeAlias = Literal["once", "repeat", "alternate"]

#: Seconds of the shortest way: a shorter one is over before any screen shows it.
SHORTEST = 1e-3


@dataclass(frozen=True, slots=True)
class Iteration:
    """One playing of a leg, there or back, in seconds.

    Attributes
    ----------
    shown, until : float
        While it is to be seen; it stands still before it sets off, and after it has arrived.
    start, end : float
        While it moves.
    back : bool
        Whether it runs from its end to its start.
    """

    shown: float
    start: float
    end: float
    until: float
    back: bool

    def at(self, clock: Floats) -> Floats:
        """Seconds at which rising moments (M,) of the leg's own clock come, rising."""
        length = self.end - self.start
        return self.end - clock[::-1] * length if self.back else self.start + clock * length


@dataclass(frozen=True, slots=True)
class Timeline:
    """The plan of the whole.

    Attributes
    ----------
    ways : tuple of float
        Seconds of one way through each leg: of the movements that follow each other.
    loop : {"once", "repeat", "alternate"}
        Stay at the end, start over, or go back and start over.
    hold : float
        Seconds that each drawing stands still.
    closed : bool
        Whether the last drawing is the first: starting over with it, they are one rest.

    Raises
    ------
    OptionError
        If a time or the loop is none.
    """

    ways: tuple[float, ...]
    loop: Loop
    hold: float = 0.0
    closed: bool = False

    def __post_init__(self) -> None:
        """Check what an option may have asked for."""
        for way in self.ways:
            if not (math.isfinite(way) and way >= SHORTEST):
                raise OptionError(f"duration {way}: expected seconds, at least {SHORTEST}")
        if not (math.isfinite(self.hold) and self.hold >= 0):
            raise OptionError(f"hold {self.hold}: expected seconds, 0 or more")
        if self.loop not in get_args(Loop):
            raise OptionError(f"loop {self.loop!r}: expected {', '.join(get_args(Loop))}")

    @property
    def seconds(self) -> float:
        """Length of the whole, until it ends or starts over."""
        iterations = self._iterations
        # Once, the last drawing stays anyway; back at the first, the rest is the one to come.
        last = self.hold if self.loop == "repeat" and not self.closed else 0.0
        return iterations[-1][1].end + last

    def iterations(self, leg: int) -> tuple[Iteration, ...]:
        """When one of the legs is to be seen, in order."""
        return tuple(iteration for other, iteration in self._iterations if other == leg)

    def shown(self, seconds: float) -> tuple[int, float]:
        """What a moment shows, from 0 to `seconds`: a leg, and its time on an even clock.

        Once, the last drawing stays; else, before the whole starts over, it is still there.
        """
        iterations = self._iterations
        place = sum(iteration.until <= seconds for _, iteration in iterations[:-1])
        leg, iteration = iterations[place]
        share = (seconds - iteration.start) / (iteration.end - iteration.start)
        share = min(max(share, 0.0), 1.0)
        return leg, 1.0 - share if iteration.back else share

    @property
    def _iterations(self) -> list[tuple[int, Iteration]]:
        """The legs in the order they are played, each with when that is."""
        order = [(leg, False) for leg in range(len(self.ways))]
        if self.loop == "alternate":
            order += [(leg, True) for leg in reversed(range(len(self.ways)))]
        found = []
        now = 0.0
        for leg, back in order:
            start = now + self.hold
            end = start + self.ways[leg]
            found.append((leg, Iteration(now, start, end, end, back)))
            now = end
        if self.loop == "repeat" and not self.closed:
            leg, last = found[-1]
            found[-1] = leg, replace(last, until=last.end + self.hold)
        return found
