"""What options take: how a value is read, and how a wrong one is answered."""

import math
from pathlib import Path
from typing import Any, NamedTuple

import click

from shapetween.timing.defaults import MOST_KEYFRAMES

__all__ = ["PATH", "Keyframes", "Match", "Name", "OfLeg", "Pin", "Real", "Size", "Whole"]

PATH = click.Path(path_type=Path)


class Real(click.FloatRange):
    """A number within bounds. What is not a number is in none, which click's own type lets pass."""

    def __init__(self, low: float, high: float) -> None:
        super().__init__(low, high)
        self._bounds = low, high

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Read the number."""
        low, high = self._bounds
        try:
            number = float(value)
        except ValueError:
            number = math.nan
        if not low <= number <= high:
            self.fail(f"{value!r} is not a number from {low:g} to {high:g}")
        return number


class Whole(click.IntRange):
    """A whole number within bounds."""

    def __init__(self, low: int, high: int) -> None:
        super().__init__(low, high)
        self._bounds = low, high

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Read the number."""
        low, high = self._bounds
        try:
            number = int(value)
        except ValueError:
            number = low - 1
        if not low <= number <= high:
            self.fail(f"{value!r} is not a whole number from {low} to {high}")
        return number


class OfLeg(NamedTuple):
    """What is said of one leg of a chain, counted from 1, or of a pair, which has no other."""

    leg: int | None
    value: tuple[float, float, float, float]


class Pin(click.ParamType[Any]):
    """``AX,AY:BX,BY``, a point of A and the point of B that it becomes; before it ``2/``, a leg."""

    name = "[LEG/]AX,AY:BX,BY"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Read the four numbers, and the leg."""
        if isinstance(value, tuple):
            return value
        leg, slash, pair = str(value).rpartition("/")
        halves = [half.split(",") for half in pair.split(":")]
        counted = not slash or (leg.isascii() and leg.isdecimal() and int(leg) > 0)
        try:
            (ax, ay), (bx, by) = ([float(x) for x in half] for half in halves)
        except ValueError:
            counted = False
        if not counted:
            self.fail(f"{value!r} is not AX,AY:BX,BY, such as 12,30.5:14,28, nor LEG/AX,AY:BX,BY")
        return OfLeg(int(leg) if slash else None, (ax, ay, bx, by))


class Match(click.ParamType[Any]):
    """``IDA:IDB``: a shape of A and the shape of B that it becomes, several, or none."""

    name = "IDA:IDB"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Split at the colon."""
        if isinstance(value, tuple):
            return value
        first, colon, second = str(value).partition(":")
        if not colon or not (first or second):
            self.fail(f"{value!r} is not IDA:IDB, such as tail:tail-fin")
        return first, second


class Name(click.ParamType[Any]):
    """One of a few names; a wrong one is answered with the nearest."""

    name = "name"

    def __init__(self, *choices: str) -> None:
        self.choices = choices

    def get_metavar(self, param: click.Parameter, ctx: click.Context) -> str:
        """List the names in the help."""
        return "[" + "|".join(self.choices) + "]"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Check the name."""
        if value in self.choices:
            return value
        import difflib  # only for what is misspelt

        near = difflib.get_close_matches(str(value), self.choices, n=1, cutoff=0.4)
        hint = f"did you mean {near[0]}?" if near else f"expected {', '.join(self.choices)}"
        return self.fail(f"{value!r} is not known; {hint}")


class Keyframes(click.ParamType[Any]):
    """``auto``, or how many keyframes."""

    name = "auto|N"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Read the number."""
        if value == "auto" or isinstance(value, int):
            return value
        try:
            number = int(value)
        except ValueError:
            number = 0
        if not 2 <= number <= MOST_KEYFRAMES:
            self.fail(f"{value!r} is neither 'auto' nor a number from 2 to {MOST_KEYFRAMES}")
        return number


class Size(click.ParamType[Any]):
    """``WIDTHxHEIGHT`` or ``WIDTH``."""

    name = "WIDTH[xHEIGHT]"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Read the one or two numbers."""
        if isinstance(value, tuple):
            return value
        parts = str(value).lower().split("x")
        if len(parts) > 2 or not all(p.isdecimal() and len(p) < 6 and int(p) for p in parts):
            self.fail(f"{value!r} is neither WIDTHxHEIGHT, such as 1280x720, nor WIDTH")
        return tuple(int(part) for part in parts)
