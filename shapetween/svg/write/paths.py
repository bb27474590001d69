"""Path data for movement: relative commands, straight curves as lines, whole steps of a grid.

Path data that only differs in its numbers can be blended number by number, and added where all of
it is relative: then every number is a difference of two points, and sums of differences are the
differences of sums. So a path is laid out once, in a `PathForm`, for all of its times and all of
the displacements that are added to it.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from shapetween.base.arrays import Curves, Floats, Index, Mask
from shapetween.svg.write.numbers import characters, check_digits

__all__ = ["Grid", "PathForm", "on_grid", "straight_curves"]

Grid = NDArray[np.int64]
"""Coordinates in steps of the last decimal that is written."""

#: Places of curves, each at each time, that are looked at together, but that both ends of all are.
#: More take memory, some twenty numbers each; with fewer most of the time goes to calls.
AT_ONCE = 100_000

_NONE = -1


@dataclass(frozen=True, slots=True, eq=False)
class PathForm:
    """What is the same in a path at every time.

    Attributes
    ----------
    kept : (K,) intp
        The control points that are written, in their order, among those of all curves (N * 4). A
        line has no handles, and the last line of a closed ring is drawn by ``z``.
    base : (K,) intp
        For each of them the number, among them, of the point that it is written relative to; -1 for
        the origin.
    letters, ends : (2 K,) uint8
        Before and after each coordinate, 0 for none.
    """

    kept: Index
    base: Index
    letters: NDArray[np.uint8]
    ends: NDArray[np.uint8]

    @classmethod
    def of(cls, rings: Sequence[int], closed: Sequence[bool], straight: Mask) -> "PathForm":
        """The form of a path.

        Parameters
        ----------
        rings : sequence of int
            Number of curves in each ring, N together.
        closed : sequence of bool
            Which rings end with ``z``.
        straight : (N,) bool
            Which curves are written as lines.
        """
        kept: list[int] = []
        base: list[int] = []
        letters: list[bytes] = []
        ends: list[bytes] = []
        first, current = 0, _NONE
        for count, is_closed in zip(rings, closed, strict=True):
            start = len(kept)
            kept.append(first * 4)
            base.append(current)
            letters.append(b"m\0")
            ends.append(b"\0\0")
            current, command = start, ""
            drawn = count - 1 if is_closed and count > 1 and straight[first + count - 1] else count
            for k in range(first, first + drawn):
                line = bool(straight[k])
                points = [3] if line else [1, 2, 3]
                kept += [k * 4 + point for point in points]
                base += [current] * len(points)
                wanted = "l" if line else "c"
                fresh = wanted.encode() if wanted != command else b"\0"
                letters.append(fresh + b"\0" * (2 * len(points) - 1))
                ends.append(b"\0" * (2 * len(points)))
                current, command = len(kept) - 1, wanted
            if is_closed:
                ends[-1] = ends[-1][:-1] + b"z"
                current = start
            first += count
        return cls(
            np.array(kept, np.intp),
            np.array(base, np.intp),
            np.frombuffer(b"".join(letters), np.uint8),
            np.frombuffer(b"".join(ends), np.uint8),
        )

    @property
    def handles(self) -> Mask:
        """Which of the points written are handles, (K,)."""
        return np.asarray((self.kept % 4 != 0) & (self.kept % 4 != 3))

    def points(self, curves: Curves) -> Floats:
        """The points that are written of curves (F, N, 4, 2), (F, K, 2)."""
        return np.asarray(curves.reshape(len(curves), -1, 2)[:, self.kept])

    def texts(self, points: Grid, decimals: int) -> tuple[str, ...]:
        """Path data of points (F, K, 2) in steps of the last of some decimals, one text each."""
        if not points.size:
            return ("",) * len(points)
        before = np.where((self.base == _NONE)[:, None], 0, points[:, self.base])
        values = (points - before).reshape(len(points), -1)
        table = characters(values, decimals, self.letters, self.ends)
        return tuple(frame.tobytes().translate(None, b"\0").decode("ascii") for frame in table)

    def zero(self) -> str:
        """Path data that adds nothing."""
        return self.texts(np.zeros((1, len(self.kept), 2), np.int64), 0)[0]


def on_grid(points: Floats, decimals: int) -> Grid:
    """Points rounded to whole steps of the last decimal.

    Raises
    ------
    OptionError
        If a coordinate has more digits than a double carries.
    """
    check_digits(points, decimals)
    return np.rint(points * 10.0**decimals).astype(np.int64)


def straight_curves(curves: Curves, between: float, ends: float) -> Mask:
    """Which curves are lines at all times.

    Parameters
    ----------
    curves : (F, N, 4, 2) float64
        At times of which the first and the last are the ends.
    between, ends : float
        How far a handle may be from the chord, on the way and at the ends.

    Returns
    -------
    (N,) bool
    """
    most = min(between, ends)
    result = np.asarray(_from_chords(curves[[0, -1]]).max(axis=0, initial=0.0) <= most)
    left = np.flatnonzero(result)
    step = max(1, AT_ONCE // max(len(curves), 1))
    for k in range(0, len(left), step):
        own = left[k : k + step]
        few = curves if len(own) == curves.shape[1] else curves[:, own]
        result[own] = _from_chords(few).max(axis=0, initial=0.0) <= between
    return result


def _from_chords(curves: Curves) -> Floats:
    """How far the handles of curves (F, N, 4, 2) are from their chords at most, (F, N)."""
    # Coordinate by coordinate: sums over pairs of numbers take three times as long.
    x, y = (np.ascontiguousarray(np.moveaxis(curves[..., k], 2, 0)) for k in (0, 1))
    along, across = x[3] - x[0], y[3] - y[0]
    length = along * along + across * across
    length[length == 0] = 1.0
    away = np.zeros(curves.shape[:2])
    for handle in (1, 2):
        u, v = x[handle] - x[0], y[handle] - y[0]
        share = np.clip((u * along + v * across) / length, 0.0, 1.0)
        u -= share * along
        v -= share * across
        away = np.maximum(away, np.sqrt(u * u + v * v))
    return away
