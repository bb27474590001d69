"""Areas that are outlined strokes, seen and moved as the lines they are."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from shapetween.base.arrays import Curves, Floats
from shapetween.base.notices import Notice
from shapetween.fill.regions import Region
from shapetween.model.outline import Outline
from shapetween.model.paint import Stroke, Style
from shapetween.model.part import CurveTrack
from shapetween.scene.forms import RoundedBox, form_of
from shapetween.scene.items import Item, Painted
from shapetween.scene.motion.tracks import OfTrack
from shapetween.scene.strokes.contour import stroke_rings
from shapetween.scene.strokes.cuts import opened_ring, parted_ring
from shapetween.scene.strokes.outline import StrokeOutline, stroke_outline
from shapetween.scene.strokes.segmentation import OutlinedStroke, outlined_strokes
from shapetween.scene.unmatched.presence import LeavingTrack

__all__ = [
    "MOST_AREAS",
    "StrokedTrack",
    "as_lines",
    "as_painted",
    "line_of",
    "stroke_notice",
    "stroked_leaving",
    "too_many_areas",
]

#: Most curves of an area that is looked at for centre lines, and most areas of a drawing: icons
#: have a few dozen curves, letters up to a hundred. More would take longer than they are worth.
MOST_CURVES, MOST_AREAS = 160, 60

#: Least ratio of a box's sides from which on it is rather a line.
BAR = 5.0

#: Angle of a bar, radians, below which it is upright or level. A slash through an icon is not.
UPRIGHT = np.deg2rad(5.0)


def as_lines(
    first: Sequence[Item], second: Sequence[Item]
) -> tuple[tuple[Item, ...], tuple[Item, ...]]:
    """Both drawings' items, with areas that are outlined strokes as their centre lines.

    Parameters
    ----------
    first, second : sequence of Item
        In paint order.

    Notes
    -----
    Where the other drawing has no lines, upright and level bars stay boxes, and an area that is all
    there is stays one: they become areas.
    """
    sides = [list(first), list(second)]
    found = [_strokes(side) for side in sides]
    lined = [
        bool(own) or any(not item.filled for item in side)
        for own, side in zip(found, sides, strict=True)
    ]
    result = []
    for k, side in enumerate(sides):
        strokes = found[k]
        if not lined[1 - k]:
            bodies = any(item.filled and j not in strokes for j, item in enumerate(side))
            strokes = {j: s for j, s in strokes.items() if bodies and not _upright_bar(side[j])}
        items: list[Item] = []
        for j, item in enumerate(side):
            items += [line_of(stroke, item) for stroke in strokes.get(j, ())] or [item]
        result.append(tuple(items))
    return result[0], result[1]


def too_many_areas(items: Sequence[Item]) -> bool:
    """Whether some items have so many areas that none is looked for strokes."""
    return len(items) > MOST_AREAS and sum(map(_plain, items)) > MOST_AREAS


def _strokes(items: Sequence[Item]) -> dict[int, tuple[OutlinedStroke, ...]]:
    """The strokes of those items that consist of some."""
    areas = [k for k, item in enumerate(items) if _plain(item)]
    if len(areas) > MOST_AREAS:
        return {}
    found = {}
    for k in areas:
        item = items[k]
        strokes = outlined_strokes(Region(item.outer, item.holes))
        if strokes is not None:
            found[k] = strokes
    return found


def _upright_bar(item: Item) -> bool:
    """Whether an item is as well seen as a box, upright or level."""
    form = None if item.holes else form_of(item)
    return isinstance(form, RoundedBox) and abs(form.angle) < UPRIGHT


def too_long(item: Item) -> bool:
    """Whether an item is an opaque area of so many curves that it is not looked for strokes."""
    return item.plain and not item.cut and sum(len(r.curves) for r in item.rings) > MOST_CURVES


def _plain(item: Item) -> bool:
    """Whether an item is an opaque area without a border, of few curves, and not a box."""
    if item.cut or not item.plain or too_long(item):
        return False
    form = None if item.holes else form_of(item)
    if isinstance(form, RoundedBox):
        return bool(form.sides.max() >= BAR * form.sides.min())
    return True


def line_of(stroke: OutlinedStroke, item: Item) -> Item:
    """One stroke of an area as an item."""
    fill = item.style.fill
    assert fill is not None
    seen = Stroke(fill, stroke.width, cap="round", join="round")
    style = replace(item.style, fill=None, stroke=seen)
    painted = Painted(stroke.rings, replace(item.style, fill_rule="nonzero"))
    return Item((stroke.line.line,), style, item.shape, item.name, painted=painted)


@dataclass(frozen=True, eq=False)
class StrokedTrack(OfTrack):
    """The outlines of strokes whose lines a track moves.

    Attributes
    ----------
    outlines : tuple of StrokeOutline
        Of each line.
    constant : bool
        Whether they are the first end's all the time, else they become the second end's.
    """

    outlines: tuple[StrokeOutline, ...]
    constant: bool = False

    @property
    def counts(self) -> tuple[int, ...]:
        """Number of curves in each ring."""
        return tuple(n for outline in self.outlines for n in outline.counts)

    @property
    def closed(self) -> tuple[bool, ...]:
        """All of them."""
        return (True,) * len(self.counts)

    def curves(self, t: Floats) -> Curves:
        """Control points at the times (F,), (F, N, 4, 2)."""
        lines = np.split(self.track.curves(t), np.cumsum(self.track.counts)[:-1], axis=1)
        at = np.zeros(len(t)) if self.constant else t
        pairs = zip(self.outlines, lines, strict=True)
        return np.concatenate([outline.curves(line, at) for outline, line in pairs], axis=1)


def as_painted(
    first: Item, second: Item, tracks: tuple[CurveTrack, ...]
) -> tuple[Item, Item, tuple[CurveTrack, ...]]:
    """A pair of lines as the areas they are painted as, if one of them is, and what moves those.

    Parameters
    ----------
    first, second : Item
    tracks : tuple of CurveTrack
        Of the line. They stay as they are, and so do the items, where both are no lines or are
        painted as strokes, or an outline does not follow its line.
    """
    lines = not first.filled and not second.filled and len(tracks) == 1
    if not lines or (first.painted is None and second.painted is None):
        return first, second, tracks
    (line,) = tracks
    if len(line.counts) != 1:
        return first, second, tracks
    ends, closed = line.curves(np.array([0.0, 1.0])), line.closed[0]
    one, other = (
        _rings(Outline(end, closed), item) for end, item in zip(ends, (first, second), strict=True)
    )
    if one is None or other is None:
        return first, second, tracks
    bound = stroke_outline((ends[0], ends[1]), closed, (one, other))
    if bound is None:
        return first, second, tracks
    first, second = (replace(item, style=_painted_style(item)) for item in (first, second))
    return first, second, (StrokedTrack(line, (bound,)),)


def stroke_notice(name: str, instead: str) -> Notice:
    """What to tell where the area of a stroke is not moved along with its line."""
    return Notice("stroke-outline", "the area of a stroke cannot follow its line", name, instead)


def _rings(line: Outline, item: Item) -> tuple[Outline, ...] | None:
    """What is painted round a line at one end of its movement."""
    if item.painted is not None:
        rings = item.painted.rings
        if len(rings) == 1 or line.closed:
            return rings
        whole = opened_ring(line, rings)
        return None if whole is None else (whole,)
    stroke = item.style.stroke
    if stroke is None or stroke.dashes or stroke.width <= 0:
        return None
    return stroke_rings(line, stroke.width, stroke.cap, stroke.join)


def _painted_style(item: Item) -> Style:
    """The fill that an item seen as a line is painted with."""
    if item.painted is not None:
        return item.painted.style
    stroke = item.style.stroke
    assert stroke is not None
    return replace(item.style, fill=stroke.paint, stroke=None)


def stroked_leaving(lines: LeavingTrack, painted: Painted) -> StrokedTrack | None:
    """Lines without a partner as the area that they are painted as.

    Parameters
    ----------
    lines : LeavingTrack
        The item's line or the two halves of it.
    painted : Painted
        The item's.

    Returns
    -------
    StrokedTrack or None
        None if the area's outline does not follow the line.
    """
    home, rings = lines.whole, painted.rings
    areas: list[tuple[Outline, ...]] = [rings]
    if len(rings) == 2 and not lines.closed[0]:
        opened = opened_ring(Outline(home[0], closed=False), rings)
        if opened is None:
            return None
        areas = [(opened,)]
    if len(home) == 2:
        whole = np.concatenate(home)
        parts = parted_ring(Outline(whole, closed=False), rings[0], len(home[0]))
        if parts is None:
            return None
        areas = [(parts[0],), (parts[1],)]
    outlines = []
    for line, closed, area in zip(home, lines.closed, areas, strict=True):
        outline = stroke_outline((line, line), closed, (area, area))
        if outline is None:
            return None
        outlines.append(outline)
    return StrokedTrack(lines, tuple(outlines), constant=True)
