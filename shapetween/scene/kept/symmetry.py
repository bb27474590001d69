"""Axes about which both of two areas that are laid on each other are their own mirror images."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from shapetween.base.arrays import Points
from shapetween.scene.items import intersection_over_union
from shapetween.scene.kept.pieces import Overlay, Piece

__all__ = ["Reflection", "reflections"]

#: Least share that what is mirrored has in common with itself. Smaller, and a badge at one side is
#: overlooked; larger, and rounding makes an envelope lopsided.
EVEN = 0.93

#: Least share that two pieces have in common once one is mirrored, for them to be mates.
MATES = 0.85


@dataclass(frozen=True, slots=True)
class Reflection:
    """Mirroring about an upright or a level axis.

    Attributes
    ----------
    flips : int
        0 where the axis is upright and x changes its sign, 1 where it is level.
    place : float
        Its x, or its y.
    """

    flips: int
    place: float

    def of_points(self, points: Points) -> Points:
        """Points (..., 2) mirrored."""
        result = np.array(points)
        result[..., self.flips] = 2 * self.place - result[..., self.flips]
        return result

    def of_way(self, way: Points) -> Points:
        """A direction (2,) mirrored."""
        result = np.array(way)
        result[self.flips] = -result[self.flips]
        return result

    def along(self, way: Points) -> Points:
        """What of a direction (2,) is along the axis."""
        result = np.array(way)
        result[self.flips] = 0.0
        return result

    def mate(self, piece: Piece, pieces: Sequence[Piece]) -> Piece | None:
        """Which of some pieces is another one's mirror image, perhaps itself."""
        import shapely

        image = shapely.transform(piece.area, self.of_points)
        for other in pieces:
            alike = intersection_over_union(image, other.area) > MATES
            if other.comes == piece.comes and alike:
                return other
        return None


def reflections(laid: Overlay) -> tuple[Reflection, ...]:
    """About which axes what is kept, what goes and what comes are their own mirror images."""
    import shapely

    x0, y0, x1, y1 = laid.kept.bounds
    found = []
    for own in (Reflection(0, (x0 + x1) / 2), Reflection(1, (y0 + y1) / 2)):
        sides = [shapely.union_all([p.area for p in laid.pieces if p.comes == c]) for c in (0, 1)]
        areas = [laid.kept, *(side for side in sides if not side.is_empty)]
        if all(
            intersection_over_union(area, shapely.transform(area, own.of_points)) > EVEN
            for area in areas
        ):
            found.append(own)
    return tuple(found)
