"""How far shapes of two drawings cover each other once both drawings lie on each other."""

from typing import TYPE_CHECKING

import numpy as np

from shapetween.base.arrays import Floats
from shapetween.elastic.flow import Flow
from shapetween.elastic.silhouette import Areas

if TYPE_CHECKING:
    import shapely

__all__ = ["laid_on", "shared_areas"]

#: Margin about every shape, as a share of the drawing: lines and specks that lie side by side count
#: as near. Larger makes all small things alike.
MARGIN = 0.03

#: Distance, as a share of the drawing, within which corners of areas are straightened.
STRAIGHT = 0.004


def shared_areas(areas: tuple[Areas, Areas], flow: Flow) -> Floats:
    """Share of what either of two shapes covers that both cover, (N, M).

    Parameters
    ----------
    areas : ((N,), (M,)) of shapely.Geometry
        What the shapes of both drawings cover.
    flow : Flow
        Brings the first drawing's shapes onto the second's.
    """
    import shapely

    coarse = laid_on(areas, flow)
    scale = flow.lanes[0].extents[1]
    wide = [shapely.buffer(side, MARGIN * scale, quad_segs=2) for side in coarse]
    result = np.zeros((len(areas[0]), len(areas[1])))
    i, j = shapely.STRtree(wide[1]).query(wide[0], predicate="intersects")
    common = shapely.area(shapely.intersection(wide[0][i], wide[1][j]))
    either = shapely.area(wide[0])[i] + shapely.area(wide[1])[j] - common
    result[i, j] = common / np.where(either > 0, either, 1.0)
    return result


def laid_on(areas: tuple[Areas, Areas], flow: Flow) -> tuple[Areas, Areas]:
    """What shapes of two drawings cover where the first lies on the second, a little coarser."""
    import shapely

    brought = np.array([_brought(area, flow) for area in areas[0]], dtype=object)
    near = STRAIGHT * flow.lanes[0].extents[1]
    return shapely.simplify(brought, near), shapely.simplify(areas[1], near)


def _brought(area: "shapely.Geometry", flow: Flow) -> "shapely.Geometry":
    """An area where the flow takes it, without what is folded over."""
    import shapely

    if area.is_empty:
        return area
    middle = np.array(shapely.box(*area.bounds).centroid.coords[0])
    if not flow.carries(middle):
        return area
    plane = flow.lane(middle, None).plane
    moved = shapely.transform(area, lambda points: plane.hold(points, False).at(np.ones(1))[0])
    return shapely.make_valid(moved, method="structure", keep_collapsed=False)
