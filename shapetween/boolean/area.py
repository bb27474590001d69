"""The area that rings fill together, as polygons.

.. [SVG2] *Scalable Vector Graphics 2*, section 13.3, fill-rule.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from shapetween.base.arrays import Index, Points
from shapetween.boolean.chords import FLATNESS
from shapetween.geometry.polygon import cross
from shapetween.model.paint import FillRule

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry

__all__ = ["filled_area", "hidden_share", "meetings", "windings"]

#: Distance, as a share of the extent of all rings, between the places that crossings may have.
#: Sides that run there and back on one curve, but for the last digit, fall together. It must stay
#: well below the flatness of chords.
GRID = FLATNESS / 20

#: Mean width, as a share of the extent, below which a face is a gap between two rings' chords that
#: stand for one curve, and belongs to what is around it.
SLIVER = 2 * FLATNESS

#: Pairs of sides whose boxes meet up to which rings are cut by each other. Drawn shapes have a few
#: a side; a scribble with more would take minutes.
MOST_MEETINGS = 400_000

#: Sides of which the meetings are counted.
SAMPLED_SIDES = 500


def filled_area(polylines: Sequence[Points], rule: FillRule) -> BaseGeometry | None:
    """The area that rings fill together.

    Parameters
    ----------
    polylines : sequence of (N, 2) float64
        An open one is closed by a line, as a fill is.
    rule : {"nonzero", "evenodd"}
        As in [SVG2]_.

    Returns
    -------
    geometry or None
        Polygons that meet in points at most; None if the rings cross so often that cutting them
        would take too long.
    """
    import shapely

    closed = [np.concatenate([line, line[:1]]) for line in polylines if len(line) > 2]
    if not closed:
        return shapely.Polygon()
    starts = np.concatenate([line[:-1] for line in closed])
    ends = np.concatenate([line[1:] for line in closed])
    if meetings(starts, ends) > MOST_MEETINGS:
        return None
    size = float(np.ptp(starts, axis=0).max())
    if size == 0:
        return shapely.Polygon()
    net = shapely.union_all([shapely.LineString(line) for line in closed], grid_size=GRID * size)
    faces = shapely.get_parts(shapely.polygonize(shapely.get_parts(net)))
    if not len(faces):
        return shapely.Polygon()
    turns = windings(shapely.get_coordinates(shapely.point_on_surface(faces)), starts, ends)
    kept = turns % 2 == 1 if rule == "evenodd" else turns != 0
    around = shapely.length(faces)
    thin = 2 * shapely.area(faces) < SLIVER * size * around
    valid, gaps = faces[kept & ~thin], faces[thin]
    # A gap between filled faces is filled, and a shred that stands alone is none.
    gap, beside = shapely.STRtree(valid).query(gaps, predicate="intersects")
    shared = shapely.length(
        shapely.intersection(shapely.boundary(gaps[gap]), shapely.boundary(valid[beside]))
    )
    enclosed = np.bincount(gap, weights=shared, minlength=len(gaps)) > around[thin] / 2
    return shapely.coverage_union_all([*valid, *gaps[enclosed]])


def hidden_share(polylines: Sequence[Points], rule: FillRule) -> float:
    """Share of closed rings' length that lies inside of what they fill together.

    A stroke is seen there, though the area's own outline does not run there. It is 0 where that
    would take too long to tell.

    Parameters
    ----------
    polylines : sequence of (N, 2) float64
    rule : {"nonzero", "evenodd"}
    """
    import shapely

    if len(polylines) == 1 and shapely.Polygon(polylines[0]).is_valid:
        return 0.0
    area = filled_area(polylines, rule)
    if area is None:
        return 0.0
    length = sum(float(np.linalg.norm(np.diff(line, axis=0), axis=1).sum()) for line in polylines)
    return max(0.0, 1.0 - float(area.length) / length) if length > 0 else 0.0


def meetings(starts: Points, ends: Points) -> float:
    """About how many pairs of sides' boxes meet, beyond those of neighbours."""
    import shapely

    boxes = shapely.box(*np.minimum(starts, ends).T, *np.maximum(starts, ends).T)
    sample = boxes[:: max(1, len(boxes) // SAMPLED_SIDES)]
    found = shapely.STRtree(boxes).query(sample).shape[1]
    return float(max(0.0, found / len(sample) - 3) * len(boxes) / 2)


def windings(points: Points, starts: Points, ends: Points) -> Index:
    """How often sides run around each point, clockwise as drawn counted positive.

    Parameters
    ----------
    points : (P, 2) float64
        On none of the sides.
    starts, ends : (N, 2) float64
        Of closed rings' sides.

    Returns
    -------
    (P,) intp
        Crossings of the ray to the right.
    """
    import shapely

    right = np.maximum(starts[:, 0], ends[:, 0]).max()
    far = np.maximum(points[:, 0], right)
    rays = shapely.linestrings(
        np.stack([points, np.stack([far, points[:, 1]], axis=1)], axis=1),
    )
    sides = shapely.STRtree(shapely.linestrings(np.stack([starts, ends], axis=1)))
    ray, side = sides.query(rays)
    y = points[ray, 1]
    above, below = starts[side, 1] <= y, ends[side, 1] <= y
    turn = cross(ends[side] - starts[side], points[ray] - starts[side])
    down, up = above & ~below & (turn > 0), ~above & below & (turn < 0)
    signed = down.astype(np.float64) - up
    return np.bincount(ray, weights=signed, minlength=len(points)).astype(np.intp)
