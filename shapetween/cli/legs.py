"""Options about what becomes what, each of one leg of a chain: ``2/...`` is of the second leg."""

from collections.abc import Iterable
from typing import Any, NamedTuple

import click

from shapetween.base.errors import OptionError

__all__ = ["MOST_MATCHINGS", "Match", "Matching", "OfLeg", "Pin", "by_leg"]

#: Largest number of a matching: no two outlines have nearly as many that are distinct.
MOST_MATCHINGS = 100


class OfLeg(NamedTuple):
    """What is said of one leg of a chain, counted from 1, or of a pair, which has no other."""

    leg: int | None
    value: Any


class _OfLegType(click.ParamType[Any]):
    """A value, before it perhaps a leg and a slash."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Read the value, and the leg."""
        if isinstance(value, tuple):
            return value
        leg, slash, rest = str(value).partition("/")
        counted = bool(slash) and leg.isascii() and leg.isdecimal()
        found = self.read(rest if counted else str(value))
        if found is None or (counted and int(leg) < 1):
            self.fail(f"{value!r} is not {self.expected}")
        return OfLeg(int(leg) if counted else None, found)

    def read(self, text: str) -> Any:
        """The value; None if it is none."""
        raise NotImplementedError

    expected = ""


class Pin(_OfLegType):
    """``AX,AY:BX,BY``, a point of A and the point of B that it becomes."""

    name = "[LEG/]AX,AY:BX,BY"
    expected = "AX,AY:BX,BY, such as 12,30.5:14,28, nor LEG/AX,AY:BX,BY"

    def read(self, text: str) -> tuple[float, float, float, float] | None:
        """The four numbers."""
        try:
            (ax, ay), (bx, by) = ([float(x) for x in half.split(",")] for half in text.split(":"))
        except ValueError:
            return None
        return ax, ay, bx, by


class Match(_OfLegType):
    """``IDA:IDB``: a shape of A and the shape of B that it becomes, several, or none."""

    name = "[LEG/]IDA:IDB"
    expected = "IDA:IDB, such as tail:tail-fin, nor LEG/IDA:IDB"

    def read(self, text: str) -> tuple[str, str] | None:
        """Both sides of the colon."""
        first, colon, second = text.partition(":")
        return (first, second) if colon and (first or second) else None


class Matching(_OfLegType):
    """``K``: which of the distinct matchings."""

    name = "[LEG/]K"
    expected = f"a number from 1 to {MOST_MATCHINGS}, nor LEG/K"

    def read(self, text: str) -> int | None:
        """The number."""
        good = text.isascii() and text.isdecimal() and 1 <= int(text) <= MOST_MATCHINGS
        return int(text) if good else None


def by_leg(flag: str, given: Iterable[OfLeg], count: int) -> dict[int, list[Any]]:
    """What an option says of each leg, counted from 1.

    Parameters
    ----------
    flag : str
        The option, for messages.
    given : iterable of OfLeg
    count : int
        How many legs there are.

    Raises
    ------
    OptionError
        If a leg is not told where there are several, or is none.
    """
    found: dict[int, list[Any]] = {}
    for leg, value in given:
        if leg is None and count > 1:
            raise OptionError(
                f"{flag}: of which of the {count} legs? Expected it before, such as {flag} "
                f"1/{_shown(value)}"
            )
        if (leg or 1) > count:
            legs = "is but one leg" if count == 1 else f"are {count} legs"
            raise OptionError(f"{flag} {leg}/...: there {legs}")
        found.setdefault(leg or 1, []).append(value)
    return found


def _shown(value: Any) -> str:
    """A value as it was written."""
    if not isinstance(value, tuple):
        return str(value)
    if len(value) == 2:
        return ":".join(value)
    ax, ay, bx, by = value
    return f"{ax:g},{ay:g}:{bx:g},{by:g}"
