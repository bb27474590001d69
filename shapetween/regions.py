"""What a filled shape's rings enclose: pieces, each an outer ring with its holes.

.. [SVG2] *Scalable Vector Graphics 2*, section 13.3, fill-rule.
"""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from shapetween.arrays import Floats, Index, Points
from shapetween.drawing import Shape
from shapetween.errors import OutlineError
from shapetween.geometry.bezier import flatten, line_curves
from shapetween.outline import Outline
from shapetween.paint import FillRule
from shapetween.tidy import tidy

if TYPE_CHECKING:
    import shapely

__all__ = ["Region", "regions_of"]

#: Chords of a curve when rings are first looked at, and when they seem to cross: a coarse polygon
#: may touch itself in a slit where the curve does not.
CHORDS, FINE_CHORDS = 12, 48

#: Points of a ring past which its curves have fewer chords.
MOST_POINTS = 20_000

#: Distance, as a share of the whole, by which the sides of an outline found anew may leave out its
#: corners: below the printed digits, and a curve's chords are many times fewer.
STRAIGHT = 3e-5

#: Curves of a shape past which its rings are overlaid as areas instead of cut by each other.
MOST_CUT = 4000

#: Share of its area by which a ring may overlap itself or another and still count as apart:
#: editors round coordinates and leave closing lines that step back by the last digit.
NEGLIGIBLE = 1e-4

#: Share of its length that a ring may run back along itself and keep its curves: what a closing
#: line that steps back does, but not a spike, nor a bridge to a hole.
RETRACED = 1e-3

#: Share of the whole area below which a ring shows nothing.
SPECK = 1e-9


@dataclass(frozen=True, slots=True, eq=False)
class Region:
    """One piece of a filled shape.

    Attributes
    ----------
    outer : Outline
    holes : tuple of Outline
        All rings clockwise as drawn, outer and holes alike, none crossing another.
    """

    outer: Outline
    holes: tuple[Outline, ...] = ()

    @property
    def area(self) -> float:
        """Area of the outer ring."""
        return self.outer.area

    @property
    def centre(self) -> Points:
        """Middle of the outer ring's box, (2,)."""
        return np.asarray(self.outer.box.mean(axis=0))


def regions_of(shape: Shape, name: str) -> tuple[tuple[Region, ...], tuple[str, ...]]:
    """Pieces of a filled shape, the largest first, and warnings.

    Parameters
    ----------
    shape : Shape
        With closed rings.
    name : str
        What warnings call it.

    Notes
    -----
    Rings that cross themselves or each other are replaced by polygons of what the fill rule
    [SVG2]_ shows of them; all others keep their curves.

    Raises
    ------
    OutlineError
        If nothing of the shape encloses an area, or its fill rule shows none.
    """
    rings = [ring for ring in shape.rings if _encloses(ring)]
    if not rings:
        raise OutlineError(f"{name}: the outline encloses no area")
    rule = shape.style.fill_rule
    polygons = _simple_polygons(rings)
    if polygons is None:
        place = _crossing_place(rings)
        found = _resolved(rings, rule)
        if not found:
            raise OutlineError(f"{name}: its fill rule shows nothing of it")
        warning = f"{name}: an outline crosses itself{place}; what it shows was outlined anew"
        return _largest_first(found), (warning,)
    return _largest_first(_nested(rings, polygons, rule)), ()


def _largest_first(found: list[Region]) -> tuple[Region, ...]:
    return tuple(sorted(found, key=lambda region: -region.area))


def _encloses(ring: Outline) -> bool:
    import shapely

    low, high = ring.box
    least = SPECK * float(np.max(high - low)) ** 2
    if abs(ring.area) > least:
        return True
    # Lobes that run opposite ways cancel out in the signed area.
    polygon = shapely.Polygon(_flat(ring, CHORDS))
    return bool(shapely.make_valid(polygon).area > least)


def _simple_polygons(rings: list[Outline]) -> "list[shapely.Polygon] | None":
    """Polygons of rings that cross neither themselves nor each other; None where some do."""
    import shapely

    polygons = []
    for ring in rings:
        for chords in (CHORDS, FINE_CHORDS):
            polygon = shapely.Polygon(_flat(ring, chords))
            if polygon.is_valid:
                break
            fixed = shapely.make_valid(polygon, method="structure", keep_collapsed=False)
            # Where it runs there and back along itself, the mended outline is shorter.
            retraced = float(polygon.length - fixed.length)
            same = abs(float(fixed.area) - abs(ring.area)) <= NEGLIGIBLE * abs(ring.area)
            if same and retraced <= RETRACED * polygon.length:
                polygon = max(shapely.get_parts(fixed), key=shapely.area)
                break
        else:
            return None
        polygons.append(polygon)
    tree = shapely.STRtree(polygons)
    first, second = tree.query(polygons, predicate="intersects")
    for i, j in zip(first.tolist(), second.tolist(), strict=True):
        if i >= j:
            continue
        least, most = sorted((polygons[i].area, polygons[j].area))
        alike = least > (1 - NEGLIGIBLE) * most
        if alike or polygons[i].overlaps(polygons[j]):
            common = polygons[i].intersection(polygons[j]).area
            # All of the smaller one within the larger is nesting with a touch.
            nested = common >= (1 - NEGLIGIBLE) * least and not alike
            if common > NEGLIGIBLE * least and not nested:
                return None
    return polygons


def _nested(
    rings: list[Outline], polygons: "list[shapely.Polygon]", rule: FillRule
) -> list[Region]:
    """Regions of rings that do not cross, by how deep each lies and which way it runs."""
    import shapely

    inner = [shapely.point_on_surface(p) for p in polygons]
    areas = np.array([p.area for p in polygons])
    tree = shapely.STRtree(polygons)
    point, holder = tree.query(inner, predicate="within")
    larger = areas[holder] > areas[point] * (1 + NEGLIGIBLE)
    pairs = list(zip(point[larger].tolist(), holder[larger].tolist(), strict=True))
    around: list[list[int]] = [[] for _ in rings]
    for child, parent in pairs:
        around[child].append(parent)
    if rule == "evenodd":
        outside = np.array([len(held) % 2 for held in around])
        inside = 1 - outside
    else:
        turn = np.array([1 if ring.area > 0 else -1 for ring in rings])
        outside = np.array([int(turn[held].sum()) for held in around])
        inside = outside + turn
    shows = (outside != 0) != (inside != 0)
    is_outer = shows & (inside != 0)
    clockwise = [tidy(ring if ring.area > 0 else ring.reversed()) for ring in rings]
    holes: dict[int, list[Outline]] = {int(k): [] for k in np.flatnonzero(is_outer)}
    for k in np.flatnonzero(shows & ~is_outer).tolist():
        owners = [p for p in around[k] if is_outer[p]]
        if owners:
            holes[min(owners, key=lambda p: areas[p])].append(clockwise[k])
    return [Region(clockwise[k], tuple(found)) for k, found in holes.items()]


def _resolved(rings: list[Outline], rule: FillRule) -> list[Region]:
    """Regions that crossing rings show, as polygons."""
    import shapely

    if sum(len(ring.curves) for ring in rings) > MOST_CUT:
        return _overlaid(rings, rule)
    points = [_flat(ring, FINE_CHORDS) for ring in rings]
    loops = [shapely.LineString(np.concatenate([p, p[:1]])) for p in points]
    lines = shapely.node(shapely.MultiLineString(loops))
    faces = list(shapely.get_parts(shapely.polygonize(list(shapely.get_parts(lines)))))
    total = sum(face.area for face in faces)
    kept = []
    for face in faces:
        if face.area <= SPECK * total:
            continue
        # Well inside: a point beside the boundary may be judged to lie on either side of it.
        circle = shapely.maximum_inscribed_circle(face, tolerance=face.area / face.length / 4)
        spot = np.array(circle.coords[0])
        winding = sum(_winding(p, spot) for p in points)
        if winding % 2 if rule == "evenodd" else winding != 0:
            kept.append(face)
    return _of_area(shapely.union_all(kept), total) if kept else []


def _overlaid(rings: list[Outline], rule: FillRule) -> list[Region]:
    """Regions of so many rings that they cannot all be cut by each other.

    Under the nonzero rule, rings that run against the largest one are taken for holes.
    """
    import shapely

    polygons = [shapely.make_valid(shapely.Polygon(_flat(ring, FINE_CHORDS))) for ring in rings]
    if rule == "evenodd":
        area = shapely.symmetric_difference_all(polygons)
    else:
        largest = max(rings, key=lambda ring: abs(ring.area))
        along = [ring.area * largest.area > 0 for ring in rings]
        area = shapely.union_all([p for p, same in zip(polygons, along, strict=True) if same])
        cut = [p for p, same in zip(polygons, along, strict=True) if not same]
        area = shapely.difference(area, shapely.union_all(cut)) if cut else area
    return _of_area(area, float(area.area))


def _of_area(area: "shapely.Geometry", total: float) -> list[Region]:
    import shapely

    left, top, right, bottom = shapely.bounds(area).tolist()
    area = shapely.simplify(area, STRAIGHT * max(right - left, bottom - top))
    return [
        Region(_of_polygon(p.exterior.coords), tuple(_of_polygon(h.coords) for h in p.interiors))
        for p in shapely.get_parts(shapely.get_parts(area))
        if p.geom_type == "Polygon" and p.area > SPECK * total
    ]


def _flat(ring: Outline, chords: int) -> Points:
    """A ring as a polygon; of many curves, which are short, each has fewer chords."""
    return flatten(ring.curves, max(1, min(chords, MOST_POINTS // len(ring.curves))))


def _winding(points: Points, spot: Points) -> int:
    if (spot < points.min(axis=0)).any() or (spot > points.max(axis=0)).any():
        return 0
    a = points - spot
    b = np.roll(a, -1, axis=0)
    turns = np.arctan2(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0], (a * b).sum(axis=1)).sum()
    return round(float(turns) / (2 * np.pi))


def _of_polygon(coordinates: "Index | Floats | object") -> Outline:
    points = np.array(coordinates, dtype=np.float64)[:-1]
    ring = Outline(line_curves(points, np.roll(points, -1, axis=0)))
    return tidy(ring if ring.area > 0 else ring.reversed())


def _crossing_place(rings: list[Outline]) -> str:
    """Where rings cross first, for messages."""
    import shapely

    polygons = [shapely.Polygon(_flat(ring, FINE_CHORDS)) for ring in rings]
    for polygon in polygons:
        reason = shapely.is_valid_reason(polygon)
        if "[" in reason:
            x, y = (float(value) for value in reason[reason.find("[") + 1 : -1].split()[:2])
            return f" near {x:.6g}, {y:.6g}"
    lines = [polygon.exterior for polygon in polygons]
    for k, line in enumerate(lines):
        for other in lines[:k]:
            common = line.intersection(other)
            if not common.is_empty:
                x, y = common.representative_point().coords[0]
                return f" near {x:.6g}, {y:.6g}"
    return ""
