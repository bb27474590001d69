"""What two areas have in common, and the pieces that only one of them has."""

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from shapetween.base.arrays import Curves, Floats, Index, Points
from shapetween.boolean.chords import Chords
from shapetween.boolean.trace import traced
from shapetween.geometry.bezier import evaluate, sub_curves
from shapetween.model.outline import Outline
from shapetween.scene.items import Item
from shapetween.scene.kept.shared_arcs import Snapped

if TYPE_CHECKING:
    import shapely

__all__ = ["Overlay", "Piece", "areas_of", "drawn_rings", "overlay"]

#: Area, as a share of the square of the drawing's size, of a piece that rounding makes.
ROUNDING = 1e-7

#: Distance, as a share of the drawing, within which borders cut from one polygon are one.
ONE = 1e-6

#: Chords of a curve that others are looked for on.
CHORDS = 24

#: Distance, as a share of its size, within which a curve lies on another; and from an end of that,
#: as a parameter, within which it starts there.
PART, AT_END = 2e-3, 1e-3


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


@dataclass(frozen=True, eq=False)
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

    @cached_property
    def _rings(self) -> list[tuple[Outline, ...]]:
        import shapely

        together = shapely.GeometryCollection([piece.area for piece in self.pieces])
        return traced(together, self.chords)

    def rings_of(self, piece: Piece) -> tuple[Outline, ...]:
        """A piece's rings, as that area has them whose it is."""
        rings = self._rings[next(k for k, own in enumerate(self.pieces) if own is piece)]
        if not piece.comes:
            return rings
        return tuple(Outline(self.at_last(ring)) for ring in rings)

    @cached_property
    def _moved(self) -> tuple[Curves, Curves]:
        """The second area's curves that are not its own, and what they are in fact."""
        second = np.concatenate([r.curves for r in self.snapped.second])
        exact = np.concatenate([r.curves for r in self.snapped.exact])
        moved = (second != exact).any(axis=(1, 2))
        return second[moved], exact[moved]

    def at_last(self, ring: Outline) -> Curves:
        """A ring's curves where the second area has them, in that one's own curves."""
        second, exact = self._moved
        return _image(ring.curves, second, exact) if len(second) else ring.curves


def drawn_rings(items: Sequence[Item]) -> list[Outline]:
    """All rings of some areas, outer ones clockwise and holes against."""
    return [
        ring
        for item in items
        for ring in (
            item.outer.clockwise(),
            *(hole.clockwise().reversed() for hole in item.holes),
        )
    ]


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
    which, start, end = _parts(curves, second)
    found = which >= 0
    result[found] = sub_curves(exact[which[found]], start[found], end[found])
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


def _parts(curves: Curves, second: Curves) -> tuple[Index, Floats, Floats]:
    """Which of some curves each other one is a part of, -1 of none, and between what parameters."""
    looked = evaluate(curves, np.array([0.0, 0.5, 1.0]))  # (N, 3, 2)
    chords = evaluate(second, np.arange(CHORDS + 1) / CHORDS)
    steps = np.diff(chords, axis=1)
    square = (steps**2).sum(-1)
    away = looked[:, :, None, None] - chords[:, :-1]  # (N, 3, M, CHORDS, 2)
    part = (away * steps).sum(-1) / np.where(square > 0, square, 1.0)
    part = np.clip(part, 0.0, 1.0)
    off = np.linalg.norm(away - part[..., None] * steps, axis=-1)
    best = off.argmin(axis=-1)[..., None]
    t = (best + np.take_along_axis(part, best, axis=-1))[..., 0] / CHORDS
    near = np.take_along_axis(off, best, axis=-1)[..., 0].max(axis=1)  # (N, M)
    size = np.ptp(curves, axis=1).max(axis=1)
    between = (t[:, 1] - t[:, 0]) * (t[:, 2] - t[:, 1]) > 0
    near = np.where(between & (near < PART * size[:, None]), near, np.inf)
    which = near.argmin(axis=1)
    index = np.arange(len(curves))
    ends = [t[index, k, which] for k in (0, 2)]
    # An end next to a curve's own is that.
    ends = [np.where(np.abs(e - np.round(e)) < AT_END, np.round(e), e) for e in ends]
    return np.where(np.isfinite(near[index, which]), which, -1), ends[0], ends[1]
