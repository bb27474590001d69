"""Straight bars, such as a slash through an icon."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from shapetween.base.arrays import Points
from shapetween.base.ranking import comparable
from shapetween.geometry.polygon import cross

if TYPE_CHECKING:
    import shapely

    from shapetween.scene.kept.pieces import Overlay, Piece

__all__ = ["Bar", "bar_of", "round_stroke", "slot_of"]

#: How far from the middle of a bar's end, along and aside, in halves of its width, nothing is drawn
#: if that is round: 0.71 is on a round end, 1 at the corner of a square one.
CORNER = 0.85

#: Least ratio of the sides of a bar, and share of its rectangle that it fills.
SLENDER, FILLED = 4.0, 0.75

#: Least ratio of the sides of a slot that is cut from one end to the other. Smaller, and a square
#: that becomes two halves is sawn in two; larger, and an eye's slash opens as a crack.
SLOT = 5.0

#: Least part of a slash's direction along either axis. With none, the gap under a lid is sawn from
#: one side, where both sides are alike; much more, and steep slashes are none.
OBLIQUE = 0.3

#: Least share of the strips beside a bar that counts as what an area had there. Smaller, and a bar
#: drawn over a corner is a slash.
THERE = 0.1

#: How far from a bar's middle line a piece may reach to be clipped with it, in halves of its width:
#: the gaps beside a slash are up to as wide as the slash.
BESIDE = 3.2


@dataclass(frozen=True, slots=True, eq=False)
class Bar:
    """A straight bar.

    Attributes
    ----------
    centre : (2,) float64
    ahead : (2,) float64
        Direction in which it is drawn, of length 1: downwards, or to the right.
    half : float
        Half its width.
    length : float
    comes : bool
        Whether the second area has it.
    """

    centre: Points
    ahead: Points
    half: float
    length: float
    comes: bool

    def holds(self, points: Points) -> bool:
        """Whether all points (N, 2) lie beside it."""
        aside = np.abs(cross(points - self.centre, self.ahead))
        along = np.abs((points - self.centre) @ self.ahead)
        reach = BESIDE * self.half
        return bool(aside.max() <= reach and along.max() <= self.length / 2 + reach)

    def touches(self, area: "shapely.Geometry") -> bool:
        """Whether an area comes as near to it as the gap beside a slash does."""
        import shapely

        ends = self.centre + np.array([[-0.5], [0.5]]) * self.length * self.ahead
        return bool(shapely.distance(shapely.LineString(ends), area) <= BESIDE * self.half)

    def clears(self, left: "shapely.Geometry", gone: "shapely.Geometry") -> float:
        """Share that is gone of what an area had in the strips along both its sides.

        They are as wide as half of it. What has little there had at least `THERE` of them.
        """
        import shapely

        ends = self.centre + np.array([[-0.5], [0.5]]) * self.length * self.ahead
        line = shapely.LineString(ends)
        wide, own = (line.buffer(k * self.half, cap_style="flat") for k in (2.0, 1.0))
        strips = wide.difference(own)
        cleared = float(strips.intersection(gone).area)
        had = cleared + float(strips.intersection(left).area)
        return cleared / max(had, THERE * float(strips.area))

    @property
    def around(self) -> "shapely.Geometry":
        """Its line with what may be cleared beside it."""
        import shapely

        ends = self.centre + np.array([[-0.5], [0.5]]) * self.length * self.ahead
        return shapely.LineString(ends).buffer(BESIDE * self.half)

    @property
    def ends(self) -> tuple[float, float]:
        """Where it starts and ends along its direction."""
        middle = float(self.centre @ self.ahead)
        return middle - self.length / 2, middle + self.length / 2


def bar_of(area: "shapely.Geometry", comes: bool = True, slender: float = SLENDER) -> Bar | None:
    """The bar that an area is, at least so many times longer than wide; None of others."""
    import shapely

    corners = shapely.get_coordinates(area.minimum_rotated_rectangle)
    if len(corners) < 5:
        return None
    sides = np.diff(corners[:3], axis=0)
    lengths = np.linalg.norm(sides, axis=1)
    long = int(comparable(lengths).argmax())
    if lengths[long] < slender * lengths[1 - long] or area.area < FILLED * lengths.prod():
        return None
    ahead = sides[long] / lengths[long]
    level = abs(ahead[1]) < 1e-6
    if (ahead[0] if level else ahead[1]) < 0:
        ahead = -ahead
    middle, half = corners[:4].mean(axis=0), float(lengths[1 - long] / 2)
    return Bar(middle, ahead, half, float(lengths[long]), comes)


def slot_of(areas: "shapely.Geometry") -> Bar | None:
    """The oblique slot that areas are parts of, on one line; None of others."""
    hull = areas.convex_hull
    if hull.geom_type != "Polygon" or hull.is_empty:
        return None
    bar = bar_of(hull, slender=SLOT)
    return bar if bar is not None and np.abs(bar.ahead).min() > OBLIQUE else None


def round_stroke(pieces: Sequence["Piece"], laid: "Overlay") -> Bar | None:
    """The bar that pieces are parts of together, if both its ends are round.

    Parameters
    ----------
    pieces : sequence of Piece
    laid : Overlay
        What they are of.
    """
    import shapely

    if not pieces:
        return None
    bar = bar_of(shapely.union_all([piece.area for piece in pieces]).convex_hull)
    if bar is None:
        return None
    whole = shapely.union_all([laid.kept, *(piece.area for piece in pieces)])
    normal = np.array([-bar.ahead[1], bar.ahead[0]])
    near = CORNER * bar.half
    corners = [
        bar.centre + along * (bar.length / 2 - bar.half + near) * bar.ahead + aside * near * normal
        for along in (-1, 1)
        for aside in (-1, 1)
    ]
    return None if whole.intersects(shapely.MultiPoint(corners)) else bar
