"""A piece that becomes several is cut in as many, as a cell divides.

The cuts are those of a power diagram [Aur87]_ of where the several lie, with weights by which each
cell holds its share of the area.

.. [Aur87] F. Aurenhammer, *Power diagrams: properties, algorithms and applications*, SIAM Journal
   on Computing 16(1), 1987.
"""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from shapetween.base.arrays import Floats, Points
from shapetween.boolean.chords import chords_of, joined
from shapetween.boolean.trace import traced
from shapetween.fill.regions import Region
from shapetween.geometry.bezier import line_curves
from shapetween.model.outline import Outline

if TYPE_CHECKING:
    import shapely

__all__ = ["split_alike"]

#: Most pieces that one is seen to divide into; of more, a crowd, one becomes the piece and the
#: others open beside it.
MOST_PARTS = 4

#: Least area of a piece beside the largest, to be a part of the whole and no island of it.
LEAST_PART = 0.25

#: Least share that the box of the whole and the box of its parts have of both together. Below it
#: the parts are elsewhere, or spread too far to have been one.
LEAST_COMMON = 0.3

#: Greatest error of a cell's area, as a share of the whole; and rounds in which it is reached.
UNEVEN, ROUNDS = 0.02, 60


def split_alike(whole: Region, parts: Sequence[Region]) -> tuple[Region, ...] | None:
    """Cut a piece into one for each of some parts, in their order.

    Parameters
    ----------
    whole : Region
    parts : sequence of Region
        What it becomes, in the same frame.

    Returns
    -------
    tuple of Region or None
        None if it is not seen to divide: the parts are too many, too unlike in size or elsewhere,
        or a cut leaves more pieces than there are parts.
    """
    sizes = np.array([abs(part.area) for part in parts])
    if not 2 <= len(parts) <= MOST_PARTS or sizes.min() < LEAST_PART * sizes.max():
        return None
    if _common(whole, parts) < LEAST_COMMON:
        return None
    chords = chords_of([whole.outer, *whole.holes])
    area = _area(chords.polylines)
    cells = _cells(area, _sites(whole, parts), sizes / sizes.sum())
    if any(cell.is_empty or cell.geom_type != "Polygon" for cell in cells):
        return None  # a part whose place is all its neighbours'
    pieces = []
    for cell in cells:
        edge = np.array(cell.exterior.coords)[:-1]
        border = Outline(line_curves(edge, np.roll(edge, -1, axis=0)))
        found = traced(area.intersection(cell), joined([chords, chords_of([border])]))
        if len(found) != 1:
            return None
        outer, *holes = found[0]
        pieces.append(Region(outer, tuple(hole.reversed() for hole in holes)))
    return tuple(pieces)


def _common(whole: Region, parts: Sequence[Region]) -> float:
    """Area of two boxes' intersection over that of their union."""
    boxes = np.array([part.outer.box for part in parts])
    one, other = whole.outer.box, np.stack([boxes[:, 0].min(axis=0), boxes[:, 1].max(axis=0)])
    both = np.minimum(one[1], other[1]) - np.maximum(one[0], other[0])
    shared = float(np.prod(np.maximum(both, 0)))
    return shared / float(np.prod(one[1] - one[0]) + np.prod(other[1] - other[0]) - shared)


def _area(polylines: Sequence[Points]) -> "shapely.Polygon":
    import shapely

    polygon = shapely.Polygon(polylines[0], list(polylines[1:]))
    return polygon if polygon.is_valid else polygon.buffer(0)


def _sites(whole: Region, parts: Sequence[Region]) -> Points:
    """Where the parts lie, mapped onto the whole, (N, 2)."""
    boxes = np.array([part.outer.box for part in parts])
    low, high = boxes[:, 0].min(axis=0), boxes[:, 1].max(axis=0)
    one = whole.outer.box
    share = (boxes.mean(axis=1) - low) / (high - low)
    return np.asarray(one[0] + share * (one[1] - one[0]))


def _cells(area: "shapely.Polygon", sites: Points, shares: Floats) -> list["shapely.Polygon"]:
    """Cells of the power diagram that hold their shares of an area."""
    import shapely

    low, high = np.array(area.bounds).reshape(2, 2)
    reach = float(np.linalg.norm(high - low))
    weights = np.zeros(len(sites))
    step = reach**2
    cells: list[shapely.Polygon] = []
    last = np.zeros(len(sites))
    for _ in range(ROUNDS):
        cells = [_cell(sites, weights, k, low, high, reach) for k in range(len(sites))]
        held = shapely.area(shapely.intersection(area, np.array(cells, dtype=object)))
        missing = shares - held / area.area
        if np.abs(missing).max() <= UNEVEN:
            break
        # Too far is seen by what is missing turning over.
        step *= 0.5 if (missing * last).sum() < 0 else 1.2
        last = missing
        weights = weights + step * missing
    return cells


def _cell(
    sites: Points, weights: Floats, k: int, low: Points, high: Points, reach: float
) -> "shapely.Polygon":
    """The part of a wide box nearer to one site than to all others, by power distance."""
    import shapely

    left, top = low - reach
    right, bottom = high + reach
    cell = shapely.box(left, top, right, bottom)
    for j in range(len(sites)):
        away = sites[j] - sites[k]
        length = float(np.linalg.norm(away))
        if j == k or length == 0:
            continue
        normal = away / length
        middle = float((sites[j] @ sites[j] - sites[k] @ sites[k] + weights[k] - weights[j]) / 2)
        foot = sites[k] + normal * (middle / length - sites[k] @ normal)
        along = np.array([-normal[1], normal[0]]) * 4 * reach
        back = normal * 8 * reach
        corners = np.stack([foot - along, foot + along, foot + along - back, foot - along - back])
        cell = cell.intersection(shapely.Polygon(corners))
    return cell
