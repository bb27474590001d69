"""What options take: how a value is read, and how a wrong one is answered."""

import math
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import click

from shapetween.timing.defaults import MOST_KEYFRAMES

__all__ = ["PATH", "Keyframes", "Name", "Real", "Size", "Whole", "nearest"]

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


def nearest(word: str, choices: Iterable[str]) -> str:
    """What to say to a word that is none of some: the most like it, else all of them."""
    import difflib  # only for what is misspelt

    known = tuple(choices)
    near = difflib.get_close_matches(word, known, n=1, cutoff=0.4)
    return f"did you mean {near[0]}?" if near else f"expected {', '.join(known)}"


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
        return self.fail(f"{value!r} is not known; {nearest(str(value), self.choices)}")


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
