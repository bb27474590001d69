"""Whether strokes that are drawn as areas swell where those become each other as areas."""

from collections.abc import Sequence

import numpy as np

from shapetween.geometry.bezier import flatten
from shapetween.match.matcher import registered
from shapetween.model.part import CurveTrack
from shapetween.scene.items import Item
from shapetween.scene.motion.choose import corner_tracks

__all__ = ["swells"]

#: Distance from an area's border, in widths of its strokes, that no place in strokes has: where two
#: cross at right angles it is .71. Less, and every crossing swells; more, and only blots do.
DEEP = 0.8

#: Area that lies deeper, in squares of that width, from which on it is seen.
SEEN = 0.02

#: Times that are looked at.
LOOKED = np.array([0.25, 0.5, 0.75])


def swells(first: Item, second: Item, lines: Sequence[Sequence[Item]]) -> bool:
    """Whether one area that consists of strokes swells on its way to one other that does.

    Parameters
    ----------
    first, second : Item
        The areas.
    lines : pair of sequence of Item
        Both as the lines they are made of; an area that is not stays one.
    """
    if any(item.filled for side in lines for item in side):
        return False
    if registered(first.outer.clockwise(), second.outer.clockwise()) is not None:
        return False
    widths = [max(item.width for item in side) for side in lines]
    return any(
        _deep(tracks, time, (1 - time) * widths[0] + time * widths[1])
        for tracks in [corner_tracks(first, second)]
        for time in LOOKED.tolist()
    )


def _deep(tracks: Sequence[CurveTrack], time: float, width: float) -> bool:
    import shapely

    areas = []
    for track in tracks:
        (curves,) = track.curves(np.array([time]))
        areas.append(shapely.make_valid(shapely.Polygon(flatten(curves, 8))))
    rest = areas[0].difference(shapely.union_all(areas[1:])) if len(areas) > 1 else areas[0]
    return bool(rest.buffer(-DEEP * width).area > SEEN * width**2)
