"""Strips beside and under a bar that is drawn or undrawn: they go as it passes them."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from shapetween.base.arrays import Curves, Floats, Points
from shapetween.geometry.bezier import evaluate
from shapetween.model.outline import Outline
from shapetween.model.part import Leaf

__all__ = ["Strip"]

#: Steps of the time on which strips begin and end to go. More, and files are longer, for every such
#: moment is written down; fewer, and strips side by side are seen to end at different places.
STEPS = 24

#: The time in which what is left of a strip at last becomes a point. Longer, and crumbs are seen;
#: shorter, and it jumps.
LAST = 0.008

#: Share of a strip's width within which its sides are one line along it. Larger, and round ends are
#: taken for sides; smaller, and what rounding has turned a little is none.
ONE = 1e-3

#: Points of a curve that strips are measured by.
MEASURED = np.linspace(0.0, 1.0, 17)


@dataclass(frozen=True, eq=False)
class Strip(Leaf):
    """Rings that a bar shortens as it passes: every point goes straight along it to their far end.

    Attributes
    ----------
    rings : tuple of Outline
        Closed, as they are where they are whole.
    ahead : (2,) float64
        Direction in which the bar's end moves, of length 1.
    ends : (float, float)
        Where that is at times 0 and 1, along the direction.
    behind : bool
        Whether what is behind it is left, else what is before it.

    Notes
    -----
    All of it moves in one way, evenly, where cutting it by a line that moves would need a moment
    for each of its corners. A line that encloses nothing is a hair to renderers, so that what is
    left at last shrinks to a point.
    """

    rings: tuple[Outline, ...]
    ahead: Points
    ends: tuple[float, float]
    behind: bool

    @property
    def counts(self) -> tuple[int, ...]:
        """Number of curves in each ring."""
        return tuple(len(ring.curves) for ring in self.rings)

    @property
    def closed(self) -> tuple[bool, ...]:
        """All of them."""
        return (True,) * len(self.rings)

    @cached_property
    def _whole(self) -> Curves:
        return np.concatenate([ring.curves for ring in self.rings])

    @cached_property
    def _far(self) -> Curves:
        """Where each control point goes straight on to, (N, 4, 2)."""
        aside = np.array([-self.ahead[1], self.ahead[0]])
        outline = evaluate(self._whole, MEASURED)
        across, along = outline @ aside, outline @ self.ahead
        sign = -1.0 if self.behind else 1.0
        place = np.clip(self._whole @ aside, across.min(), across.max())[..., None, None]
        start, end = across[:, :-1], across[:, 1:]
        reach = ONE * float(np.ptp(across))
        low, high = np.minimum(start, end) - reach, np.maximum(start, end) + reach
        wide = np.where(high - low > 3 * reach, end - start, np.inf)
        share = np.clip((place - start) / wide, 0.0, 1.0)
        there = sign * (along[:, :-1] + share * np.diff(along, axis=1))
        # Of a chord along the direction its farther end.
        farther = np.maximum(sign * along[:, 1:], sign * along[:, :-1])
        there = np.where(np.isinf(wide), farther, there)
        met = (low <= place) & (place <= high)
        far = sign * np.where(met, there, -np.inf).max(axis=(-2, -1))
        return np.asarray(far[..., None] * self.ahead + place[..., 0] * aside)

    @cached_property
    def _window(self) -> tuple[float, float]:
        """When it begins and ends to move."""
        along = evaluate(self._whole, MEASURED) @ self.ahead
        first, last = self.ends
        low, high = sorted((np.array([along.min(), along.max()]) - first) / (last - first))
        start = min(max(round(float(low) * STEPS), 0), STEPS - 1)
        end = min(max(round(float(high) * STEPS), start + 1), STEPS)
        return start / STEPS, end / STEPS

    def curves(self, t: Floats) -> Curves:
        """Control points at the times (F,), (F, N, 4, 2)."""
        start, end = self._window
        size = np.clip((t - start) / (end - start), 0.0, 1.0)[:, None, None, None]
        if self.behind != (self.ends[0] < self.ends[1]):
            size = 1 - size
        least = LAST / (end - start)
        sliver = self._far + least * (self._whole - self._far)
        middle = self._far.reshape(-1, 2).mean(axis=0)
        shrunk = middle + size / least * (sliver - middle)
        shorter = self._far + size * (self._whole - self._far)
        return np.asarray(np.where(size < least, shrunk, shorter))
