"""What two areas have in common, and the pieces that only one of them has."""

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from shapetween.base.arrays import Curves, Points
from shapetween.boolean.chords import Chords
from shapetween.boolean.trace import traced
from shapetween.geometry.bezier import sub_curves
from shapetween.model.outline import Outline
from shapetween.scene.kept.stretches import Snapped
from shapetween.scene.places import Places

if TYPE_CHECKING:
    import shapely

__all__ = ["Overlay", "Piece", "areas_of", "overlay"]

#: Area, as a share of the square of the drawing's size, of a piece that rounding makes.
ROUNDING = 1e-7

#: Distance, as a share of the drawing, within which borders cut from one polygon are one.
ONE = 1e-6

#: Distance, as a share of its size, within which a curve lies on another.
PART = 1e-3


@dataclass(frozen=True, slots=True, eq=False)
class Piece:
    """What one of the areas has and the other has not, in one piece.

    Attributes
    ----------
    area : shapely.Polygon
    comes : bool
        Whether the second area has it.
    contact : shapely geometry
        Lines along which it meets what both have.
    free : shapely geometry
        The rest of its border.
    """

    area: "shapely.Polygon"
    comes: bool
    contact: "shapely.Geometry"
    free: "shapely.Geometry"


@dataclass(frozen=True, slots=True, eq=False)
class Overlay:
    """Two areas laid on each other.

    Attributes
    ----------
    snapped : Snapped
        Their rings.
    chords : Chords
        Of all rings.
    scale : float
        Size of the drawing.
    kept : shapely geometry
        What both have.
    pieces : tuple of Piece
    """

    snapped: Snapped
    chords: Chords
    scale: float
    kept: "shapely.Geometry"
    pieces: tuple[Piece, ...]

    def outlines(self, area: "shapely.Geometry") -> list[Outline]:
        """Rings of an area cut from both, outer ones clockwise and holes against."""
        return [ring for rings in traced(area, self.chords) for ring in rings]

    def at_last(self, ring: Outline) -> Curves:
        """A ring's curves where the second area has them, in that one's own curves."""
        second = np.concatenate([r.curves for r in self.snapped.second])
        exact = np.concatenate([r.curves for r in self.snapped.exact])
        moved = (second != exact).any(axis=(1, 2))
        if not moved.any():
            return ring.curves
        return _image(ring.curves, second[moved], exact[moved])


def areas_of(
    polylines: Sequence[Points],
    counts: tuple[Sequence[int], Sequence[int]],
    without: Collection[int],
) -> tuple["shapely.Geometry", "shapely.Geometry"]:
    """What both areas' rings enclose.

    Parameters
    ----------
    polylines : sequence of (N, 2) float64
        Of all rings, the first area's and then the second one's.
    counts : (sequence of int, sequence of int)
        How many rings each polygon of either area has, its outer ring first.
    without : collection of int
        Holes that are filled.
    """
    import shapely

    first = 0
    areas = []
    for side in counts:
        polygons = []
        for count in side:
            holes = [polylines[k] for k in range(first + 1, first + count) if k not in without]
            polygon = shapely.Polygon(polylines[first], holes)
            polygons.append(polygon if polygon.is_valid else shapely.make_valid(polygon))
            first += count
        areas.append(shapely.union_all(polygons))
    return areas[0], areas[1]


def overlay(
    areas: tuple["shapely.Geometry", "shapely.Geometry"],
    snapped: Snapped,
    chords: Chords,
    scale: float,
) -> Overlay:
    """Lay two areas on each other.

    Parameters
    ----------
    areas : (shapely geometry, shapely geometry)
    snapped : Snapped
        Their rings.
    chords : Chords
        Of those.
    scale : float
        Size of the drawing.
    """
    import shapely

    kept = _polygons(areas[0].intersection(areas[1]), scale)
    near = kept.boundary.buffer(ONE * scale)
    pieces = []
    for comes, area in enumerate((areas[0].difference(areas[1]), areas[1].difference(areas[0]))):
        for part in shapely.get_parts(_polygons(area, scale)).tolist():
            border = part.boundary
            contact = border.intersection(near)
            pieces.append(Piece(part, bool(comes), contact, border.difference(near)))
    return Overlay(snapped, chords, scale, kept, tuple(pieces))


def _polygons(area: "shapely.Geometry", scale: float) -> "shapely.Geometry":
    """The polygons of an area that are more than rounding."""
    import shapely

    parts = [
        part
        for part in shapely.get_parts(shapely.get_parts(area)).tolist()
        if part.geom_type == "Polygon" and part.area > ROUNDING * scale**2
    ]
    return shapely.MultiPolygon(parts)


def _image(curves: Curves, second: Curves, exact: Curves) -> Curves:
    """Curves, each that is part of one of `second` as the same part of its counterpart."""
    result = curves.copy()
    found = np.zeros(len(curves), dtype=bool)
    for k, curve in enumerate(curves):
        part = _part(curve, second)
        if part is not None:
            which, start, end = part
            result[k] = sub_curves(exact[which][None], np.array([start]), np.array([end]))[0]
            found[k] = True
    for k in range(len(curves)):
        after = (k + 1) % len(curves)
        goal = result[after, 0] if found[after] else result[k, 3]
        if not found[k]:
            result[k, 2] += goal - result[k, 3]
        result[k, 3] = goal
        if not found[after]:
            result[after, 1] += goal - result[after, 0]
        result[after, 0] = goal
    return result


def _part(curve: Points, second: Curves) -> tuple[int, float, float] | None:
    """Which of some curves another is a part of, and between which parameters."""
    same = (second[:, [0, 3]] == curve[[0, 3]]).all(axis=(1, 2))
    for k in np.flatnonzero(same).tolist():
        return k, 0.0, 1.0
    same = (second[:, [3, 0]] == curve[[0, 3]]).all(axis=(1, 2))
    for k in np.flatnonzero(same).tolist():
        return k, 1.0, 0.0
    size = float(np.ptp(curve, axis=0).max())
    points = np.stack([curve[0], (curve[0] + 3 * curve[1] + 3 * curve[2] + curve[3]) / 8, curve[3]])
    for k in range(len(second)):
        places = Places(Outline(second[k][None], closed=False))
        shares = places.nearest(points)
        away = np.linalg.norm(places.point(shares) - points, axis=1)
        if away.max() < PART * size and min(shares[0], shares[2]) < shares[1] < max(
            shares[0], shares[2]
        ):
            _, t = places.locate(shares)
            ends = np.where(shares >= 1.0, 1.0, t)
            return k, float(ends[0]), float(ends[2])
    return None
