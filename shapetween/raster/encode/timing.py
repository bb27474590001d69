"""How long frames are shown, and which part of each differs from the one before."""

from dataclasses import dataclass

import numpy as np

from shapetween.raster.light import Bytes

__all__ = ["Clock", "Patch", "patch_between"]


@dataclass(frozen=True, slots=True)
class Clock:
    """Even frames, played once or for ever.

    Attributes
    ----------
    count : int
        How many frames.
    fps : float
        Frames a second.
    repeats : bool
        Whether a player starts again at the end.
    """

    count: int
    fps: float
    repeats: bool

    def ticks(self, index: int, per_second: int) -> int:
        """How many ticks a frame is shown for, rounded so that errors do not add up; at least 1."""
        start, end = (round(k * per_second / self.fps) for k in (index, index + 1))
        return max(1, end - start)


@dataclass(frozen=True, slots=True)
class Patch:
    """A box in a frame, in pixels."""

    left: int
    top: int
    width: int
    height: int

    def of(self, frame: Bytes) -> Bytes:
        """The part of a frame inside it."""
        box = frame[self.top : self.top + self.height, self.left : self.left + self.width]
        return np.ascontiguousarray(box)


def patch_between(before: Bytes | None, after: Bytes, *, step: int = 1) -> Patch:
    """The least box outside which two frames are equal, at least a pixel wide and high.

    Parameters
    ----------
    before : Bytes or None
        None if there is no frame before: the box is then the whole frame.
    after : Bytes
    step : int
        What its left and top must be multiples of.
    """
    height, width = after.shape[:2]
    if before is None:
        return Patch(0, 0, width, height)
    changed = (before != after).any(axis=2)
    rows, columns = np.flatnonzero(changed.any(axis=1)), np.flatnonzero(changed.any(axis=0))
    if not len(rows):
        return Patch(0, 0, 1, 1)
    left, top = int(columns[0]) // step * step, int(rows[0]) // step * step
    return Patch(left, top, int(columns[-1]) + 1 - left, int(rows[-1]) + 1 - top)
