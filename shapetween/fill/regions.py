"""What a filled shape's rings enclose: pieces, each an outer ring with its holes.

.. [SVG2] *Scalable Vector Graphics 2*, section 13.3, fill-rule.
"""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from shapetween.base.arrays import Points
from shapetween.base.errors import OutlineError
from shapetween.base.notices import Notice
from shapetween.base.ranking import comparable
from shapetween.boolean.area import filled_area
from shapetween.boolean.chords import chords_of
from shapetween.boolean.trace import traced
from shapetween.model.drawing import Shape
from shapetween.model.outline import Outline
from shapetween.model.paint import FillRule
from shapetween.model.tidy import tidy

if TYPE_CHECKING:
    import shapely

__all__ = ["Region", "regions_of"]

#: Share of its area by which a ring may overlap itself or another and still count as apart:
#: editors round coordinates and leave closing lines that step back by the last digit.
NEGLIGIBLE = 1e-4

#: Share of its length that a ring may run back along itself and keep its curves: what a closing
#: line that steps back does, but not a spike, nor a bridge to a hole.
RETRACED = 1e-3

#: Share of the whole area below which a ring shows nothing.
SLIVER = 1e-9

#: Steps of the largest ring's size to which rings are rounded before they are cut by each other.
#: Finer, and units are seen; coarser, and what is shown is moved.
GRID = 2.0**38


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


def regions_of(shape: Shape, name: str) -> tuple[tuple[Region, ...], tuple[Notice, ...]]:
    """Pieces of a filled shape, the largest first, and what there is to tell.

    Parameters
    ----------
    shape : Shape
        With closed rings.
    name : str
        What notices call it.

    Notes
    -----
    Rings that cross themselves or each other are replaced by the outlines of what the fill rule
    [SVG2]_ shows of them, in parts of their own curves; all others stay as they are drawn.

    Raises
    ------
    OutlineError
        If nothing of the shape encloses an area, its fill rule shows none, or it crosses itself
        too often to be told apart.
    """
    rings = [ring for ring in shape.rings if _encloses(ring)]
    if not rings:
        raise OutlineError(f"{name}: the outline encloses no area")
    rule = shape.style.fill_rule
    chords = chords_of(rings)
    polygons = [_simple(line, ring) for line, ring in zip(chords.polylines, rings, strict=True)]
    crossing = _crossing(polygons, chords.polylines)
    if crossing is None:
        return _largest_first(_nested(rings, [p for p in polygons if p], rule)), ()
    found = _resolved(rings, rule, name)
    if not found:
        raise OutlineError(f"{name}: its fill rule shows nothing of it")
    x, y = crossing
    notice = Notice(
        "outlined-anew",
        f"an outline crosses itself near {x:.6g}, {y:.6g}",
        name,
        "what it shows was outlined anew",
    )
    return _largest_first(found), (notice,)


def _largest_first(found: list[Region]) -> tuple[Region, ...]:
    order = np.argsort(-comparable([region.area for region in found]), kind="stable")
    return tuple(found[k] for k in order)


def _encloses(ring: Outline) -> bool:
    import shapely

    low, high = ring.box
    least = SLIVER * float(np.max(high - low)) ** 2
    if len(ring.curves) > 2 and abs(ring.area) > least:
        return True
    line = chords_of([ring]).polylines[0]
    if len(line) < 4:  # there and back
        return False
    # Lobes that run opposite ways cancel out in the signed area.
    return bool(shapely.make_valid(shapely.Polygon(line)).area > least)


def _simple(points: Points, ring: Outline) -> "shapely.Polygon | None":
    """The polygon of a ring's chords; None if it crosses itself."""
    import shapely

    polygon = shapely.Polygon(points) if len(points) > 3 else None
    if polygon is None or not polygon.is_valid:  # or so it seems: curves may pass by each other
        polygon = shapely.Polygon(chords_of([ring]).polylines[0])
    if polygon.is_valid:
        return polygon
    fixed = shapely.make_valid(polygon, method="structure", keep_collapsed=False)
    # Where it runs there and back along itself, the repaired outline is shorter.
    retraced = float(polygon.length - fixed.length)
    same = abs(fixed.area - polygon.area) <= NEGLIGIBLE * polygon.area
    if same and retraced <= RETRACED * polygon.length:
        return max(shapely.get_parts(fixed), key=shapely.area)
    return None


def _crossing(
    polygons: "list[shapely.Polygon | None]", polylines: tuple[Points, ...]
) -> tuple[float, float] | None:
    """Where rings cross themselves or each other first; None where none does."""
    import shapely

    for polygon, points in zip(polygons, polylines, strict=True):
        if polygon is None:
            reason = shapely.is_valid_reason(shapely.Polygon(points))
            x, y = reason[reason.find("[") + 1 : -1].split()[:2]
            return float(x), float(y)
    if len(polygons) < 2:
        return None
    every = np.array(polygons)
    pairs = shapely.STRtree(every).query(every, predicate="intersects")
    one, other = every[pairs[:, pairs[0] < pairs[1]]]
    areas = np.sort([shapely.area(one), shapely.area(other)], axis=0)
    alike = areas[0] > (1 - NEGLIGIBLE) * areas[1]
    unsure = alike | shapely.overlaps(one, other)
    one, other, (least, _), alike = one[unsure], other[unsure], areas[:, unsure], alike[unsure]
    common = shapely.area(shapely.intersection(one, other))
    # All of the smaller one within the larger is nesting with a touch.
    nested = (common >= (1 - NEGLIGIBLE) * least) & ~alike
    cross = np.flatnonzero((common > NEGLIGIBLE * least) & ~nested)
    if not len(cross):
        return None
    borders = one[cross[0]].exterior, other[cross[0]].exterior
    # One that is drawn twice may meet itself nowhere, but lie just beside itself.
    meeting = shapely.shortest_line(*borders)
    crossing = shapely.intersection(*borders)
    x, y = shapely.get_coordinates(meeting if crossing.is_empty else crossing)[0].tolist()
    return x, y


def _nested(
    rings: list[Outline], polygons: "list[shapely.Polygon]", rule: FillRule
) -> list[Region]:
    """Regions of rings that do not cross, by how deep each lies and which way it runs."""
    import shapely

    if len(rings) == 1:
        (ring,) = rings
        return [Region(tidy(ring if ring.area > 0 else ring.reversed()))]
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


def _resolved(rings: list[Outline], rule: FillRule, name: str) -> list[Region]:
    """Regions that crossing rings show.

    They are found in a frame of their own, on a grid: where curves all but touch the last digit
    decides where they meet, which a unit must not.
    """
    size = max(float(np.max(ring.box[1] - ring.box[0])) for ring in rings)
    own = [Outline(np.round(ring.curves / size * GRID) / GRID, ring.closed) for ring in rings]
    chords = chords_of(own)
    area = filled_area(chords.polylines, rule)
    if area is None:
        raise OutlineError(f"{name}: its outline crosses itself too often to be told apart")
    low, high = np.reshape(area.bounds, (2, 2))
    least = SLIVER * float(np.max(high - low)) ** 2
    back = np.array([[size, 0.0, 0.0], [0.0, size, 0.0]])
    return [
        Region(
            outer.transformed(back),
            tuple(hole.reversed().transformed(back) for hole in holes if -hole.area > least),
        )
        for outer, *holes in traced(area, chords)
        if outer.area > least
    ]
