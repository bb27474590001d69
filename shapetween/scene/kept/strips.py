"""Strips beside and under a bar that is drawn or undrawn: they go as it passes them."""

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from shapetween.base.arrays import Curves, Floats, Points
from shapetween.geometry.bezier import evaluate, line_curves
from shapetween.model.outline import Outline
from shapetween.model.part import Leaf
from shapetween.scene.kept.appearing import OfRings, unit_circle

if TYPE_CHECKING:
    import shapely

__all__ = ["Strip", "Tip", "Under"]

#: Steps of the time on which strips begin and end to go. More, and files are longer, for every such
#: moment is written down; fewer, and strips side by side are seen to end at different places.
STEPS = 24

#: The time in which what is left of a strip at last becomes a point. Longer, and slivers are seen;
#: shorter, and it jumps.
LAST = 0.008

#: Size of a round tip, as a share of the bar's width: in the bar's own end nothing is seen of it.
#: Larger, and its quarters stick out of that; smaller, and the bar is seen to grow wider at last.
WITHIN = 0.995

#: Share of a strip's width within which its sides are one line along it. Larger, and round ends are
#: taken for sides; smaller, and what rounding has turned a little is none.
ONE = 1e-3

#: Sizes at which it is looked at whether a strip keeps to its area, and the share of that which may
#: be out of it. Larger, and what a slash cuts out of thin and thick parts falls to splinters;
#: smaller, and what it cuts from a ring is none.
SIZES, STRAY = (0.25, 0.5, 0.75), 0.02

#: Points of a curve that strips are measured by.
MEASURED = np.linspace(0.0, 1.0, 17)


@dataclass(frozen=True, eq=False)
class Strip(OfRings):
    """Rings that a bar shortens as it passes: every point goes straight along it to their far end.

    Attributes
    ----------
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

    ahead: Points
    ends: tuple[float, float]
    behind: bool

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

    def keeps_to(self, area: "shapely.Geometry") -> bool:
        """Whether it stays within an area: what is in its bays may come out of them."""
        import shapely

        for size in SIZES:
            shorter = self._far + size * (self._whole - self._far)
            rings = np.split(shorter, np.cumsum(self.counts)[:-1])
            polygons = [
                shapely.make_valid(shapely.Polygon(evaluate(r, MEASURED).reshape(-1, 2)))
                for r in rings
            ]
            if shapely.union_all(polygons).difference(area).area > STRAY * area.area:
                return False
        return True

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


@dataclass(frozen=True, eq=False)
class Tip(Leaf):
    """A bar with round ends that is drawn: it covers where the strips of it end on the way.

    Attributes
    ----------
    centres : (2, 2) float64
        Of the bar's two round ends.
    half : float
        Half the bar's width.
    ends : (float, float)
        Where those are, as shares of the way of the bar's end.
    comes : bool
        Whether the bar is drawn, else undrawn.
    """

    centres: Points
    half: float
    ends: tuple[float, float]
    comes: bool

    @property
    def counts(self) -> tuple[int, ...]:
        """It is one ring."""
        return (6,)

    @property
    def closed(self) -> tuple[bool, ...]:
        """It is closed."""
        return (True,)

    @cached_property
    def _window(self) -> tuple[float, float]:
        """When it sets off and arrives, of the time in which it is drawn; a step is left after."""
        begins = max(round(self.ends[0] * STEPS), 1)
        return begins / STEPS, max(min(round(self.ends[1] * STEPS), STEPS - 1), begins + 1) / STEPS

    def under(self, rings: tuple[Outline, ...]) -> "Under":
        """Rings of the bar that come as soon as it covers them, or go as long as it does."""
        return Under(rings, self._window[1], self.comes)

    def curves(self, t: Floats) -> Curves:
        """Control points at the times (F,), (F, 6, 4, 2)."""
        begins, stops = self._window
        drawn = t if self.comes else 1 - t
        way = np.clip((drawn - begins) / (stops - begins), 0.0, 1.0)[:, None]
        size = WITHIN * self.half * np.clip(drawn / begins, 0.0, 1.0)
        along = self.centres[1] - self.centres[0]
        ahead = along / np.hypot(*along)
        # Quarters of a circle, from straight ahead on; the second and third are round the start.
        quarters = unit_circle(4) @ np.stack([ahead, np.array([-ahead[1], ahead[0]])])
        ends = np.repeat(self.centres[None, 0], 4, axis=0)[None] + np.zeros((len(t), 1, 1))
        ends[:, [0, 3]] += (way * along)[:, None]
        arcs = ends[:, :, None] + size[:, None, None, None] * quarters
        sides = line_curves(arcs[:, [0, 2], 3], arcs[:, [1, 3], 0])
        return np.stack(
            [arcs[:, 0], sides[:, 0], arcs[:, 1], arcs[:, 2], sides[:, 1], arcs[:, 3]], axis=1
        )


@dataclass(frozen=True, eq=False)
class Under(OfRings):
    """Rings under a bar that covers them: all grow at once when it does, out of their middles.

    Attributes
    ----------
    since : float
        The time from which on the bar covers them, until 1.
    comes : bool
        Whether the bar is drawn, else undrawn, and time runs the other way.

    Notes
    -----
    A bar is convex, so that nothing sticks out of it on the way. Were they clipped as it is drawn,
    each would take moments of its own, for nothing that is seen.
    """

    since: float
    comes: bool

    def curves(self, t: Floats) -> Curves:
        """Control points at the times (F,), (F, N, 4, 2)."""
        drawn = t if self.comes else 1 - t
        size = np.clip((drawn - self.since) / (1 - self.since), 0.0, 1.0)[:, None, None, None]
        grown = []
        for ring in self.rings:
            corners = ring.curves.reshape(-1, 2)
            middle = (corners.min(axis=0) + corners.max(axis=0)) / 2
            grown.append(np.where(size < 1, middle + size * (ring.curves - middle), ring.curves))
        return np.concatenate(grown, axis=1)
