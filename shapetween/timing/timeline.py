"""When movements in a row are played: one after another, with rests, there or there and back.

Everything in an animated file runs on one clock, as long as the whole, so that all of it stays in
step wherever a player is moved to. What belongs to one movement of the row, a leg, knows its own
passages through that clock.
"""

import math
from dataclasses import dataclass
from typing import Literal, TypeAlias, get_args

from shapetween.base.arrays import Floats
from shapetween.base.errors import OptionError

__all__ = ["Loop", "Passage", "Timeline"]

Loop: TypeAlias = Literal["once", "repeat", "alternate"]

#: Seconds of the shortest way: a shorter one is over before any screen shows it.
SHORTEST = 1e-3


@dataclass(frozen=True, slots=True)
class Passage:
    """One way through a leg, in shares of the whole.

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
        """Shares of the whole at which rising moments (M,) of the leg's own clock come, rising."""
        length = self.end - self.start
        return self.end - clock[::-1] * length if self.back else self.start + clock * length


@dataclass(frozen=True, slots=True)
class Timeline:
    """The plan of the whole.

    Attributes
    ----------
    duration : float
        Seconds of one way through a leg.
    loop : {"once", "repeat", "alternate"}
        Stay at the end, start over, or go back and start over.
    hold : float
        Seconds that each drawing stands still.
    legs : int
        How many movements follow each other.
    closed : bool
        Whether the last drawing is the first: starting over with it, they are one rest.

    Raises
    ------
    OptionError
        If a time or the loop is none.
    """

    duration: float
    loop: Loop
    hold: float = 0.0
    legs: int = 1
    closed: bool = False

    def __post_init__(self) -> None:
        """Check what an option may have asked for."""
        if not (math.isfinite(self.duration) and self.duration >= SHORTEST):
            raise OptionError(f"duration {self.duration}: expected seconds, at least {SHORTEST}")
        if not (math.isfinite(self.hold) and self.hold >= 0):
            raise OptionError(f"hold {self.hold}: expected seconds, 0 or more")
        if self.loop not in get_args(Loop):
            raise OptionError(f"loop {self.loop!r}: expected {', '.join(get_args(Loop))}")

    @property
    def seconds(self) -> float:
        """Length of the whole, until it ends or starts over."""
        ways = 2 * self.legs if self.loop == "alternate" else self.legs
        # Once, the last drawing stays anyway; back at the first, the rest is the one to come.
        last = self.hold if self.loop == "repeat" and not self.closed else 0.0
        return ways * self._step + last

    def passages(self, leg: int) -> tuple[Passage, ...]:
        """When one of the legs is to be seen, in order."""
        there = self._passage(leg, back=False)
        if self.loop != "alternate":
            return (there,)
        return there, self._passage(2 * self.legs - 1 - leg, back=True)

    def shown(self, seconds: float) -> tuple[int, float]:
        """What a moment shows, from 0 to `seconds`: a leg, and its time on an even clock.

        Once, the last drawing stays; else, before the whole starts over, it is still there.
        """
        place = min(int(seconds // self._step), len(self._order) - 1)
        leg, back = self._order[place]
        share = (seconds - place * self._step - self.hold) / self.duration
        share = min(max(share, 0.0), 1.0)
        return leg, 1.0 - share if back else share

    @property
    def _order(self) -> list[tuple[int, bool]]:
        """The legs in the order they are played, and whether backwards."""
        there = [(leg, False) for leg in range(self.legs)]
        back = [(leg, True) for leg in reversed(range(self.legs))]
        return there + back if self.loop == "alternate" else there

    @property
    def _step(self) -> float:
        """Seconds from one rest to the next."""
        return self.hold + self.duration

    def _passage(self, place: int, *, back: bool) -> Passage:
        """The one that comes at some place among all."""
        shown, end = (n * self._step / self.seconds for n in (place, place + 1))
        start = (place * self._step + self.hold) / self.seconds
        last = self.loop == "repeat" and place == self.legs - 1
        return Passage(shown, start, end, 1.0 if last else end, back)
