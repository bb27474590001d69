"""The area that a stroke paints, as polygons."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from shapetween.base.arrays import Points
from shapetween.boolean.area import MOST_MEETINGS, meetings
from shapetween.model.paint import Stroke

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry

__all__ = ["stroked_area"]

#: Chords of a quarter turn of a round cap or join: off by 0.1 % of the stroke's half width.
QUARTER = 16


def stroked_area(
    polylines: Sequence[Points], closed: Sequence[bool], stroke: Stroke
) -> BaseGeometry | None:
    """The area that a stroke paints, its dashes left aside.

    Parameters
    ----------
    polylines : sequence of (N, 2) float64
    closed : sequence of bool
        Whether each of them is a ring.
    stroke : Stroke

    Returns
    -------
    geometry or None
        None if the lines cross so often that it would take too long.
    """
    import shapely

    starts = np.concatenate([line[:-1] for line in polylines])
    ends = np.concatenate([line[1:] for line in polylines])
    if meetings(starts, ends) > MOST_MEETINGS:
        return None
    lines = []
    for points, ring in zip(polylines, closed, strict=True):
        if (points == points[0]).all():
            lines.append(shapely.Point(points[0]))
        elif ring and len(points) > 3:
            lines.append(shapely.LinearRing(points))
        else:
            lines.append(shapely.LineString(points))
    painted = shapely.buffer(
        np.array(lines),
        stroke.width / 2,
        quad_segs=QUARTER,
        cap_style={"butt": "flat"}.get(stroke.cap, stroke.cap),
        join_style={"miter": "mitre"}.get(stroke.join, stroke.join),
        mitre_limit=stroke.miter_limit,
    )
    return shapely.union_all(painted)
