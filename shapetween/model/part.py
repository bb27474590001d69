"""One drawn path through the movement: its curves, its paint, and the time it is shown at."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Protocol, TypeAlias

import numpy as np

from shapetween.base.arrays import Curves, Floats, side_by_side
from shapetween.base.ends import End
from shapetween.base.errors import OptionError
from shapetween.deform.deformation import Deformation
from shapetween.model.blend import blend
from shapetween.model.paint import Style
from shapetween.model.whole import WholeMotion

__all__ = [
    "Area",
    "BlendedPaint",
    "Change",
    "CurveTrack",
    "Leaf",
    "PaintTrack",
    "Part",
    "shown_while",
]

#: First and last time at which a movement answers: one way past either end.
BEYOND = (-1.0, 2.0)

#: Halvings that tell when a part that is hidden at one end is first or last seen: to a millionth.
HALVINGS = 20


class CurveTrack(Protocol):
    """Rings and lines through time."""

    @property
    def counts(self) -> tuple[int, ...]:
        """Number of curves in each ring, the same at every time."""

    @property
    def closed(self) -> tuple[bool, ...]:
        """Which of the rings are closed."""

    @property
    def areas(self) -> tuple["Area", ...]:
        """What of it meshes move."""

    def curves(self, t: Floats) -> Curves:
        """Control points at the times (F,), 0 to 1, ring after ring, (F, N, 4, 2)."""

    def following(self, change: "Change") -> "CurveTrack":
        """The same with every track that it is made of, and then itself, changed."""


class Area(CurveTrack, Protocol):
    """Rings that meshes move."""

    @property
    def deformations(self) -> tuple[Deformation, ...]:
        """What moves them, body after body."""


Change: TypeAlias = Callable[[CurveTrack], CurveTrack]
"""From a track to what stands for it, itself if nothing else."""


class Leaf:
    """A track that no mesh moves, and that is made of no other."""

    __slots__ = ()

    @property
    def areas(self) -> tuple[Area, ...]:
        """Nothing of it has a mesh."""
        return ()

    def following(self, change: Change) -> CurveTrack:
        """Itself, changed."""
        return change(self)  # type: ignore[arg-type]  # its kinds are tracks


class PaintTrack(Protocol):
    """Paint through time."""

    def at(self, t: float) -> Style:
        """How something is painted at one time, 0 to 1."""


@dataclass(frozen=True, slots=True, eq=False)
class BlendedPaint:
    """A style that becomes another one.

    Attributes
    ----------
    styles : (Style, Style)
    motion : WholeMotion or None
        What gradients follow.
    """

    styles: tuple[Style, Style]
    motion: WholeMotion | None = None

    def at(self, t: float) -> Style:
        """How it is painted at one time."""
        return blend(*self.styles, t, self.motion)


@dataclass(frozen=True, slots=True, eq=False)
class Part:
    """One drawn path through the whole movement.

    Attributes
    ----------
    name : str
        Name of the path, empty if it has none.
    tracks : tuple of CurveTrack
        Its rings and lines, in the order that they are drawn in.
    paint : PaintTrack
    only : End or None
        The end at which alone it exists; None if it does at both.
    clock : callable or None
        From times that are asked for (F,) to those that are shown, which may be past the ends;
        None for the same.
    """

    name: str
    tracks: tuple[CurveTrack, ...]
    paint: PaintTrack
    only: End | None = None
    clock: Callable[[Floats], Floats] | None = None

    @property
    def rings(self) -> tuple[int, ...]:
        """Number of curves in each of its rings, the same at every time."""
        return tuple(n for track in self.tracks for n in track.counts)

    @property
    def closed(self) -> tuple[bool, ...]:
        """Which of the rings are closed."""
        return tuple(c for track in self.tracks for c in track.closed)

    @property
    def areas(self) -> tuple[Area, ...]:
        """What of it meshes move."""
        return tuple(area for track in self.tracks for area in track.areas)

    def curves(self, t: Floats) -> Curves:
        """Control points at the times (F,), ring after ring, (F, N, 4, 2).

        Times may be past the ends: there every point goes on as it came, mirrored at the point
        where it is then.

        Raises
        ------
        OptionError
            If a time is farther past an end than one whole way.
        """
        t = self.shown(t)
        if not t.size or (t.min() >= 0 and t.max() <= 1):
            return self._between(t)
        low, high = BEYOND
        if not (t.min() >= low and t.max() <= high):
            raise OptionError(
                f"t: expected from {low:g} to {high:g}, past the ends by a way at most"
            )
        inside = self._between(np.where(t < 0, -t, np.where(t > 1, 2 - t, t)))
        ends = self._between(np.array([0.0, 1.0]))
        for outside, end in ((t < 0, ends[0]), (t > 1, ends[1])):
            inside = np.where(outside[:, None, None, None], 2 * end - inside, inside)
        return np.asarray(inside)

    def style(self, t: float) -> Style:
        """How it is painted at one time; past an end as it is there."""
        shown = t if self.clock is None else float(self.shown(np.array([t]))[0])
        return self.paint.at(min(max(shown, 0.0), 1.0))

    def shown(self, t: Floats) -> Floats:
        """The movement's own times at the times (F,) that are asked for."""
        at = np.asarray(t, np.float64)
        return at if self.clock is None else np.asarray(self.clock(at))

    def retimed(self, clock: Callable[[Floats], Floats]) -> "Part":
        """The same, shown at other times than it is asked for."""
        inner = self.clock
        return replace(self, clock=clock if inner is None else lambda t: inner(clock(t)))

    def following(self, change: Change) -> "Part":
        """The same with its tracks changed."""
        return replace(self, tracks=tuple(track.following(change) for track in self.tracks))

    def _between(self, t: Floats) -> Curves:
        return side_by_side([track.curves(t) for track in self.tracks])


def shown_while(part: Part) -> tuple[float, float]:
    """From when until when anything is seen of a part that is transparent at an end or at neither.

    Where it goes before and after need not be told.
    """
    low, high = (_turn(part, end) for end in (0.0, 1.0))
    return (low, high) if low < high else (0.0, 1.0)


def _turn(part: Part, end: float) -> float:
    """The time next to an end at which a part that is transparent there is not."""
    if part.style(end).opacity > 0:
        return end
    hidden, seen = end, 1 - end
    if part.style(seen).opacity <= 0:
        return end
    for _ in range(HALVINGS):
        middle = (hidden + seen) / 2
        if part.style(middle).opacity > 0:
            seen = middle
        else:
            hidden = middle
    return seen
