"""What is asked of the studio: drawings in a row, what is known of each leg, and the options.

It comes from a page or a file, so everything in it is checked here, once.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from shapetween.base.errors import OptionError
from shapetween.studio.settings import checked_settings

__all__ = ["Job", "Leg", "job_of"]

#: Most drawings of a chain, pins and matches of a leg, and letters of a match: more are a mistake.
MOST_DRAWINGS, MOST_PINS, MOST_LETTERS = 100, 500, 1000


@dataclass(frozen=True, slots=True)
class Leg:
    """What is settled of one drawing and the next.

    Attributes
    ----------
    pins : tuple of (ax, ay, bx, by)
        Each in its own drawing's user units.
    matches : tuple of str
        As the command line has them.
    matching : int
        Which of the best matchings, from 1.
    """

    pins: tuple[tuple[float, float, float, float], ...] = ()
    matches: tuple[str, ...] = ()
    matching: int = 1

    def plain(self) -> dict[str, Any]:
        """For JSON, without what is as usual."""
        pins = [[_shortest(x) for x in pin] for pin in self.pins]
        whole = {"pins": pins, "matches": list(self.matches)}
        result = {key: value for key, value in whole.items() if value}
        return result | ({"matching": self.matching} if self.matching != 1 else {})


@dataclass(frozen=True, slots=True)
class Job:
    """One movement.

    Attributes
    ----------
    drawings : tuple of str
        Names, at least two; one may come again.
    legs : tuple of Leg
        One less than drawings.
    options : dict
        By the names of `shapetween.studio.settings.SETTINGS`, what differs from the defaults.
    """

    drawings: tuple[str, ...]
    legs: tuple[Leg, ...]
    options: dict[str, Any] = field(default_factory=dict)

    @property
    def closed(self) -> bool:
        """Whether the last drawing is the first one again."""
        return len(self.drawings) > 2 and self.drawings[0] == self.drawings[-1]

    def leg(self, k: int) -> "Job":
        """One leg by itself."""
        return Job(self.drawings[k : k + 2], self.legs[k : k + 1], self.options)

    def plain(self) -> dict[str, Any]:
        """For JSON."""
        legs = [leg.plain() for leg in self.legs]
        return {"drawings": list(self.drawings), "legs": legs, "options": self.options}


def job_of(data: object, known: Mapping[str, object]) -> Job:
    """Check what came from outside.

    Parameters
    ----------
    data : object
        Of JSON.
    known : Mapping
        The drawings that there are, by name.

    Raises
    ------
    OptionError
        If anything in it is not as it should be; one line that names the place.
    """
    whole = _object(data, "", {"drawings", "legs", "options"})
    names = _list(whole.get("drawings"), "drawings", MOST_DRAWINGS)
    if len(names) < 2:
        raise OptionError("drawings: expected two or more")
    for k, name in enumerate(names):
        if not isinstance(name, str) or name not in known:
            raise OptionError(f"drawings[{k}]: there is no drawing {name!r}")
    given = _list(whole.get("legs", []), "legs", MOST_DRAWINGS)
    if given and len(given) != len(names) - 1:
        raise OptionError(f"legs: {len(given)} for {len(names)} drawings; expected one less")
    legs = [_leg(leg, f"legs[{k}]") for k, leg in enumerate(given)]
    options = whole.get("options", {})
    if not isinstance(options, dict):
        raise OptionError("options: expected an object")
    whole_legs = tuple(legs) or (Leg(),) * (len(names) - 1)
    return Job(tuple(names), whole_legs, checked_settings(options))


def _leg(data: object, place: str) -> Leg:
    leg = _object(data, f"{place}.", {"pins", "matches", "matching"})
    pins = _list(leg.get("pins", []), f"{place}.pins", MOST_PINS)
    matches = _list(leg.get("matches", []), f"{place}.matches", MOST_PINS)
    for k, match in enumerate(matches):
        if not isinstance(match, str) or ":" not in match or len(match) > MOST_LETTERS:
            raise OptionError(f"{place}.matches[{k}]: {match!r} is not IDA:IDB")
    matching = leg.get("matching", 1)
    if isinstance(matching, bool) or not isinstance(matching, int) or not 1 <= matching <= 100:
        raise OptionError(f"{place}.matching: {matching!r} is not a number from 1 to 100")
    found = tuple(_pin(pin, f"{place}.pins[{k}]") for k, pin in enumerate(pins))
    return Leg(found, tuple(matches), matching)


def _pin(data: object, place: str) -> tuple[float, float, float, float]:
    numbers = _list(data, place, 4)
    good = [isinstance(x, int | float) and not isinstance(x, bool) for x in numbers]
    if len(numbers) != 4 or not all(good) or not all(math.isfinite(x) for x in numbers):
        raise OptionError(f"{place}: expected [ax, ay, bx, by]")
    ax, ay, bx, by = (float(x) for x in numbers)
    return ax, ay, bx, by


def _object(data: object, place: str, allowed: set[str]) -> dict[str, Any]:
    if not isinstance(data, dict):
        raise OptionError(f"{place or 'request'}: expected an object")
    unknown = sorted(set(data) - allowed)
    if unknown:
        raise OptionError(f"{place}{unknown[0]}: expected only {', '.join(sorted(allowed))}")
    return data


def _list(data: object, place: str, most: int) -> list[Any]:
    if not isinstance(data, list):
        raise OptionError(f"{place}: expected a list")
    if len(data) > most:
        raise OptionError(f"{place}: {len(data)} entries; expected at most {most}")
    return data


def _shortest(number: float) -> float | int:
    """A number as JSON writes it shortest."""
    return int(number) if number == int(number) else number
