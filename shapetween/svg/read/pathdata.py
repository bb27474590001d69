"""Path data (the ``d`` attribute) to cubic Bezier curves.

One pass of regular expressions cuts the data into runs of one command with its numbers, and finds
where it stops being path data: browsers draw what comes before that place, and so does this
reader. Subpaths of lines, cubics and arcs, which nearly all drawings consist of, then become
arrays at once; those with quadratic curves are parsed by svgpathtools, which is slow to import and
is imported only then.

.. [SVG2] *Scalable Vector Graphics 2*, chapter 9 and appendix B.2.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from itertools import groupby, islice, pairwise, takewhile

import numpy as np

from shapetween.base.arrays import Curves, Points
from shapetween.svg.read.arcs import Arc, arc_curves
from shapetween.svg.read.transform import NUMBER
from shapetween.svg.read.units import GREATEST

__all__ = ["PathData", "Subpath", "parse_path_data"]

_GAP = r"[\s,]*"
_FLAG = r"[01]"
_KINDS = {  # the arguments of each command: numbers n and flags f
    "M": "nn",
    "L": "nn",
    "T": "nn",
    "H": "n",
    "V": "n",
    "C": "nnnnnn",
    "S": "nnnn",
    "Q": "nnnn",
    "A": "nnnffnn",
    "Z": "",
}
_COMMAND = re.compile(r"[\s,]*([MmLlHhVvCcSsQqTtAaZz])\s*", re.ASCII)
_NUMBER = re.compile(NUMBER, re.ASCII)


def _group(kinds: str) -> str:
    return _GAP.join(NUMBER if kind == "n" else _FLAG for kind in kinds)


@cache
def _run(letter: str) -> re.Pattern[str]:
    """All sets of arguments that follow a command, and the same command again with more of them.

    Atomic, so that no number is cut in two to make one more set. Compiled when first asked for:
    all of them together take as long as reading an icon.
    """
    one = _group(_KINDS[letter.upper()])
    again = "" if letter in "Mm" else rf"(?:{letter}\s*)?"
    return re.compile(f"(?>{one})(?:{_GAP}{again}(?>{one}))*+{_GAP}", re.ASCII)


#: One set of an arc's arguments, each caught by itself: flags may be packed without gaps.
_ARC = re.compile(
    _GAP.join(f"({NUMBER})" if kind == "n" else f"({_FLAG})" for kind in _KINDS["A"]), re.ASCII
)

_Point = tuple[float, float]
_Arguments = list[tuple[float, ...]]


@dataclass(frozen=True, slots=True, eq=False)
class Subpath:
    """Curves that follow one another, from one moveto to the next.

    Attributes
    ----------
    curves : (N, 4, 2) float64
        N is 0 when a single point is closed.
    start : (2,) float64
    closed : bool
        Whether a closepath ends it. The line that it draws to the start is not among the curves.
    """

    curves: Curves
    start: Points
    closed: bool


@dataclass(frozen=True, slots=True, eq=False)
class PathData:
    """What path data draws.

    Attributes
    ----------
    subpaths : tuple of Subpath
    commands : int
        Commands read, counting every set of arguments.
    problem : str
        Where and why reading stopped early; empty if it did not.
    """

    subpaths: tuple[Subpath, ...]
    commands: int
    problem: str = ""


@dataclass(frozen=True, slots=True)
class _Run:
    """A command with all the argument sets given for it."""

    letter: str  # in upper case
    relative: bool
    arguments: _Arguments

    def ends(self, start: _Point) -> Iterator[_Point]:
        """Where each argument set ends, for a run that starts at `start`."""
        x, y = start
        for arguments in self.arguments:
            origin_x, origin_y = (x, y) if self.relative else (0.0, 0.0)
            if self.letter != "V":
                x = origin_x + arguments[0 if self.letter == "H" else -2]
            if self.letter != "H":
                y = origin_y + arguments[-1]
            yield x, y


class _Stopped(Exception):
    """Raised where the text stops being path data."""


def parse_path_data(text: str, most: int) -> PathData:
    """Parse path data as far as it is sound.

    Parameters
    ----------
    text : str
    most : int
        Drawing commands after which to stop; ``commands`` is then greater than `most`.
    """
    subpaths: list[Subpath] = []
    pending: list[_Run] = []
    start: _Point | None = None
    current: _Point = (0.0, 0.0)
    commands = 0
    problem = ""

    def finish(closed: bool) -> None:
        if start is not None and (pending or closed):
            subpaths.append(_subpath(start, pending, closed))
        pending.clear()

    try:
        for run in _runs(text, most):
            commands += max(1, len(run.arguments))
            if commands > most:
                break
            if run.letter == "M":
                finish(closed=False)
                start, *_ = run.ends(current)
                if len(run.arguments) > 1:  # what follows the first point are lines
                    pending.append(_Run("L", run.relative, run.arguments[1:]))
            elif run.letter == "Z":
                finish(closed=True)
                assert start is not None  # data begins with a moveto
                current = start
                continue
            else:
                pending.append(run)
            *_, current = run.ends(current)
    except _Stopped as stopped:
        problem = str(stopped)
    finish(closed=False)
    return PathData(tuple(subpaths), commands, problem)


def _runs(text: str, most: int) -> Iterator[_Run]:
    """Commands in order; raises `_Stopped` at the first thing that is not one."""
    end = len(text.rstrip(" \t\r\n\f,"))
    position = 0
    while position < end:
        command = _COMMAND.match(text, position)
        if command is None or (position == 0 and command[1] not in "Mm"):
            raise _Stopped(_place(text, position, "a command" if position else "a moveto"))
        letter = command[1].upper()
        position = command.end()
        if letter == "Z":
            yield _Run("Z", False, [])
            continue
        found = _run(command[1]).match(text, position)
        if found is None:
            raise _Stopped(_place(text, position, f"the numbers of {command[1]}"))
        arguments = _arguments(letter, text, position, found.end(), most)
        sound = list(takewhile(_in_range, arguments))
        if sound:
            yield _Run(letter, command[1].islower(), sound)
        if len(sound) < len(arguments):
            raise _Stopped(_place(text, position, f"numbers of a sound size for {command[1]}"))
        position = found.end()


def _in_range(values: tuple[float, ...]) -> bool:
    return all(-GREATEST <= value <= GREATEST for value in values)


def _arguments(letter: str, text: str, start: int, end: int, most: int) -> _Arguments:
    """Argument sets of a run, at most one more than `most`."""
    if letter == "A":
        sets = islice(_ARC.finditer(text, start, end), most + 1)
        return [tuple(map(float, found.groups())) for found in sets]
    width = len(_KINDS[letter])
    found = islice(_NUMBER.finditer(text, start, end), (most + 1) * width)
    values = [float(number[0]) for number in found]
    return list(zip(*(values[i::width] for i in range(width)), strict=True))


def _place(text: str, position: int, wanted: str) -> str:
    found = text[position : position + 12].strip()
    shown = f"{found!r}" if found else "its end"
    return f"expected {wanted} at character {position + 1} of the path data, found {shown}"


def _subpath(start: _Point, runs: list[_Run], closed: bool) -> Subpath:
    pieces, current = [np.zeros((0, 4, 2))], start
    for quadratic, like in groupby(runs, lambda run: run.letter in "QT"):
        curves = (_quadratic_curves if quadratic else _plain_curves)(current, list(like))
        if len(curves):
            pieces.append(curves)
            current = float(curves[-1, 3, 0]), float(curves[-1, 3, 1])
    return Subpath(np.concatenate(pieces), np.array(start), closed)


def _plain_curves(start: _Point, runs: list[_Run]) -> Curves:
    """Lines, cubics and arcs."""
    ends = [start]
    handles: list[tuple[float, ...]] = []
    before = ""
    for run in runs:
        points = [ends[-1], *run.ends(ends[-1])]
        if run.letter == "A":
            drawn = _arcs(run.arguments, points)
            ends += [(x, y) for x, y in drawn[:, 3].tolist()]
            handles += [(a, b, c, d) for a, b, c, d in drawn[:, 1:3].reshape(-1, 4).tolist()]
        else:
            ends += points[1:]
            mirrored = handles[-1][2:] if before in ("C", "S") else points[0]
            handles += _handles(run, points, mirrored)
        before = run.letter
    joints = np.array(ends)[:, None]
    inner = np.array(handles).reshape(-1, 2, 2)
    return np.concatenate([joints[:-1], inner, joints[1:]], axis=1)


def _handles(run: _Run, points: list[_Point], mirrored: tuple[float, ...]) -> _Arguments:
    """Both handles of every line or cubic of a run that goes through the points.

    The first handle of an S is the one `mirrored`, the second of the curve before, turned about
    the point where they meet.
    """
    if run.letter not in "CS":  # a line, with its handles at the thirds
        return [
            ((2 * x + p) / 3, (2 * y + q) / 3, (x + 2 * p) / 3, (y + 2 * q) / 3)
            for (x, y), (p, q) in pairwise(points)
        ]
    own: _Arguments = [arguments[:-2] for arguments in run.arguments]
    if run.relative:
        own = [
            tuple(value + origin[axis % 2] for axis, value in enumerate(values))
            for origin, values in zip(points[:-1], own, strict=True)
        ]
    if run.letter == "C":
        return own
    handles: _Arguments = []
    for (x, y), values in zip(points[:-1], own, strict=True):
        handles.append((x + x - mirrored[0], y + y - mirrored[1], *values))
        mirrored = values
    return handles


def _arcs(arguments: _Arguments, points: list[_Point]) -> Curves:
    """A run of arcs through the points.

    An arc that ends where it starts is left out, one without a radius is a line ([SVG2], B.2.5).
    """
    drawn = [np.zeros((0, 4, 2))]
    for values, start, end in zip(arguments, points[:-1], points[1:], strict=True):
        radius_x, radius_y, turn, large, sweep = values[:5]
        if start == end:
            continue
        if radius_x == 0 or radius_y == 0:
            drawn.append(_plain_curves(start, [_Run("L", False, [end])]))
            continue
        arc = Arc(
            complex(*start),
            complex(*end),
            complex(radius_x, radius_y),
            turn,
            large_arc=bool(large),
            sweep=bool(sweep),
        )
        with np.errstate(all="ignore"):  # far-fetched radii; the reader refuses what overflows
            drawn.append(arc_curves(arc))
    return np.concatenate(drawn)


def _quadratic_curves(start: _Point, runs: list[_Run]) -> Curves:
    """Quadratic curves as svgpathtools parses them, raised to cubics."""
    from svgpathtools import parse_path

    words = ["M", *map(repr, start)]
    for run in runs:
        words.append(run.letter.lower() if run.relative else run.letter)
        words += (repr(value) for values in run.arguments for value in values)
    bent = np.array([segment.bpoints() for segment in parse_path(" ".join(words))])
    first, handle, last = bent.T
    cubics = np.stack([first, (first + 2 * handle) / 3, (last + 2 * handle) / 3, last], axis=1)
    return np.stack([cubics.real, cubics.imag], axis=-1)
