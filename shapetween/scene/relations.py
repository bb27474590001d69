"""How the items of a drawing lie: in one another, on one another, and as mirror images."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, TypeAlias

import numpy as np
from numpy.typing import NDArray

from shapetween.base.arrays import Floats, Index, Mask, Points
from shapetween.base.ranking import comparable
from shapetween.scene.forms import Form, form_of
from shapetween.scene.items import Item

Shapes: TypeAlias = NDArray[np.object_]
"""Shapely's, (N,)."""

if TYPE_CHECKING:
    import shapely

__all__ = ["Axis", "Scene", "colours_apart", "in_common", "perceive", "picture"]

#: Share of an item that its parent covers at least.
COVERED = 0.8

#: Share of a line's samples that lie on a fill's border for it to be that fill's outline, and how
#: far off they may be, as a share of the line's width and of the drawing.
ALONG, ON_BORDER, ON_BORDER_DRAWN = 0.6, 0.9, 0.012

#: Share of the view that a box covers to be a sheet behind the drawing.
SHEET = 0.98

#: Cells along each side of the picture that an item's form is compared by. Fewer take a star for a
#: disc; more cost time with their square.
CELLS = 18

#: Greatest departure of two items from mirror images: way, as a share of the drawing, logarithm of
#: sizes, colours, and `UNLIKE` times the share that their pictures have not in common.
MATE, UNLIKE = 0.25, 0.4

#: Share that a drawing and its mirror image have in common, by the size of items with mates, for
#: the drawing to be symmetric.
SYMMETRIC = 0.7


@dataclass(frozen=True, slots=True, eq=False)
class Axis:
    """An axis about which a drawing is its own mirror image, or nearly.

    Attributes
    ----------
    flips : int
        0 where it is upright and x changes its sign, 1 where it is level.
    place : float
        Its x, or its y.
    mates : (N,) intp
        Of each item the one that is its mirror image, perhaps itself; -1 without one.
    """

    flips: int
    place: float
    mates: Index

    def mirrored(self, points: Points) -> Points:
        """The points' (..., 2) mirror images."""
        image = points.copy()
        image[..., self.flips] = 2 * self.place - image[..., self.flips]
        return image


@dataclass(frozen=True, eq=False)
class Scene:
    """Items and how they lie; how is found when it is asked for.

    Attributes
    ----------
    items : tuple of Item
        In paint order.
    scale : float
        Diagonal of what is drawn, a sheet apart.
    sheets : (N,) bool
        What is no part of the drawing but the page behind it.
    """

    items: tuple[Item, ...]
    scale: float
    sheets: Mask

    @cached_property
    def forms(self) -> tuple[Form, ...]:
        """What each item is."""
        return tuple(form_of(item) for item in self.items)

    @cached_property
    def drawn(self) -> Shapes:
        """What is painted of each, (N,)."""
        return np.array([item.drawn for item in self.items], dtype=object)

    @cached_property
    def parents(self) -> Index:
        """The smallest item that each lies in, -1 without one, (N,)."""
        return _parents(self.items, self.drawn, self.sheets, self.outlined)

    @cached_property
    def ancestors(self) -> Mask:
        """Whether each item lies in each, however deep, (N, N)."""
        count = len(self.items)
        found = np.zeros((count, count), dtype=bool)
        at = self.parents.copy()
        rows = np.arange(count)
        while (at >= 0).any():
            inside = (at >= 0) & ~found[rows, at]
            found[rows[inside], at[inside]] = True
            at = np.where(inside, self.parents[at], -1)
        return found

    @cached_property
    def outlined(self) -> Index:
        """The fill that a line is the outline of, -1 without one, (N,)."""
        return _outlined(self.items, self.drawn, self.scale)

    @cached_property
    def touching(self) -> Mask:
        """Which items touch or overlap, (N, N)."""
        import shapely

        first, second = shapely.STRtree(self.drawn).query(self.drawn, predicate="intersects")
        touching = np.zeros((len(self.items), len(self.items)), dtype=bool)
        touching[first, second] = True
        return touching

    def common(self, one: int, other: int) -> float:
        """Area that two items have in common."""
        if not (self.touching[one, other] or self.touching[other, one]):
            return 0.0
        first, second = sorted((one, other))
        return float(self.drawn[first].intersection(self.drawn[second]).area)

    @cached_property
    def axes(self) -> tuple[Axis, ...]:
        """About which the drawing is its own mirror image, or nearly."""
        return _axes(self)

    @cached_property
    def centres(self) -> Points:
        """Middle of each item, (N, 2)."""
        return np.array([item.centre for item in self.items]).reshape(-1, 2)

    @cached_property
    def sizes(self) -> Floats:
        """How large each is seen, (N,)."""
        return np.array([max(item.size, 1e-9 * self.scale) for item in self.items])

    @cached_property
    def colours(self) -> Floats:
        """What is seen of their paints, (N, 4)."""
        return np.array([item.colour for item in self.items]).reshape(-1, 4)

    @cached_property
    def pictures(self) -> Floats:
        """Each item in its own square, (N, CELLS, CELLS) of zeros and ones."""
        return pictures(self.items)

    @cached_property
    def box(self) -> Points:
        """Least and greatest corner of what is drawn, a sheet apart, (2, 2)."""
        return drawn_box(self.items, self.sheets)


def perceive(items: Sequence[Item], view: Points) -> Scene:
    """See how items lie.

    Parameters
    ----------
    items : sequence of Item
        In paint order, at least one.
    view : (2, 2) float64
        Least and greatest corner of what is shown.
    """
    sheets = _sheets(items, view)
    box = drawn_box(items, sheets)
    return Scene(tuple(items), float(np.hypot(*(box[1] - box[0]))) or 1.0, sheets)


def drawn_box(items: Sequence[Item], sheets: Mask) -> Points:
    """Box of all items but sheets, their strokes' widths included, (2, 2)."""
    boxes = []
    for item, sheet in zip(items, sheets, strict=True):
        if not sheet or sheets.all():
            half = item.width / 2
            boxes.append(item.box + np.array([[-half], [half]]))
    corners = np.array(boxes)
    return np.stack([corners[:, 0].min(axis=0), corners[:, 1].max(axis=0)])


def _sheets(items: Sequence[Item], view: Points) -> Mask:
    """Which items are pages behind the drawing: boxes as large as the view, painted first."""
    sheets = np.zeros(len(items), dtype=bool)
    area = float((view[1] - view[0]).prod())
    for k, item in enumerate(items):
        if not item.filled or item.holes:
            break
        low, high = np.maximum(item.box[0], view[0]), np.minimum(item.box[1], view[1])
        shown = float(np.maximum(high - low, 0.0).prod())
        whole = float((item.box[1] - item.box[0]).prod())
        if shown < SHEET * area or item.enclosed.area < SHEET * whole:
            break
        sheets[k] = True
    return np.zeros_like(sheets) if sheets.all() else sheets


def _outlined(items: Sequence[Item], drawn: Shapes, scale: float) -> Index:
    """Of each line the fill whose border it runs along, -1 without one."""
    import shapely

    outlined = np.full(len(items), -1, dtype=np.intp)
    fills = [k for k, item in enumerate(items) if item.filled]
    lines = [k for k, item in enumerate(items) if not item.filled]
    if not fills or not lines:
        return outlined
    borders = np.array([shapely.boundary(items[k].drawn) for k in fills], dtype=object)
    shapely.prepare(borders)
    boxes = shapely.STRtree([drawn[k] for k in fills])
    for k in lines:
        near = [int(i) for i in boxes.query(drawn[k]) if fills[int(i)] < k]
        if not near:
            continue
        points = shapely.points(items[k].points[::2])
        reach = max(ON_BORDER * items[k].width, ON_BORDER_DRAWN * scale)
        shares = [float((shapely.distance(borders[i], points) <= reach).mean()) for i in near]
        best = int(np.argmax(shares))
        if shares[best] >= ALONG and items[k].extent > 4 * reach:
            outlined[k] = fills[near[best]]
    return outlined


def _parents(items: Sequence[Item], drawn: Shapes, sheets: Mask, outlined: Index) -> Index:
    """The smallest item that covers most of each, -1 without one."""
    import shapely

    parents = np.full(len(items), -1, dtype=np.intp)
    outer = [k for k, item in enumerate(items) if item.closed and not sheets[k] and outlined[k] < 0]
    if not outer:
        return parents
    enclosed = np.array([item.enclosed for item in items], dtype=object)
    around, inner = enclosed[outer], drawn
    # What an outline encloses tells where a closed line lies.
    child, holder = shapely.STRtree(around).query(inner, predicate="intersects")
    areas = shapely.area(around)
    own = shapely.area(inner)
    place = np.array(outer)[holder]
    filled = np.array([item.filled for item in items])
    fine = (place != child) & (areas[holder] > 1.02 * shapely.area(enclosed)[child])
    # Only what is painted before it can be a fill's ground; a ring may be drawn after.
    fine &= (place < child) | ~filled[place]
    child, holder, place = child[fine], holder[fine], place[fine]
    covered = shapely.area(shapely.intersection(inner[child], around[holder]))
    inside = covered >= COVERED * own[child]
    order = np.lexsort((place[inside], -comparable(areas)[holder[inside]]))
    for c, p in zip(child[inside][order], place[inside][order], strict=True):
        parents[c] = p
    return parents


def pictures(items: Sequence[Item]) -> Floats:
    """Each item in its own square, about the middle of its box, (N, CELLS, CELLS)."""
    found = np.zeros((len(items), CELLS, CELLS))
    for k, item in enumerate(items):
        half = 0.0 if item.filled else item.width / 2
        found[k] = picture(item.drawn, item.box + np.array([[-half], [half]]))
    return found


def picture(area: "shapely.Geometry", box: Points) -> Floats:
    """An area in the square about the middle of a box (2, 2), (CELLS, CELLS) of zeros and ones."""
    import shapely

    steps = (np.arange(CELLS) + 0.5) / CELLS - 0.5
    grid = np.stack(np.meshgrid(steps, steps), axis=-1).reshape(-1, 2)
    side = float((box[1] - box[0]).max()) or 1.0
    places = box.mean(axis=0) + side * grid
    shapely.prepare(area)
    seen = shapely.contains_xy(area, places[:, 0], places[:, 1])
    return np.asarray(seen, dtype=np.float64).reshape(CELLS, CELLS)


def in_common(first: Floats, second: Floats) -> Floats:
    """Share that pictures (N, C, C) and (M, C, C) have in common, (N, M)."""
    one, other = first.reshape(len(first), -1), second.reshape(len(second), -1)
    both = one @ other.T
    either = one.sum(axis=1)[:, None] + other.sum(axis=1) - both
    return np.asarray(both / np.where(either > 0, either, 1.0))


def colours_apart(first: Floats, second: Floats) -> Floats:
    """Sums of differences of what is seen of paints, (N, 4) and (M, 4) to (N, M)."""
    total = np.zeros((len(first), len(second)))
    for one, other in zip(first.T, second.T, strict=True):
        total += np.abs(one[:, None] - other)
    return total


def _axes(scene: Scene) -> tuple[Axis, ...]:
    """Axes about which most of a drawing is its own mirror image."""
    found = []
    middle = scene.box.mean(axis=0)
    weights = np.where(scene.sheets, 0.0, scene.sizes)
    for flips in (0, 1):
        axis = Axis(flips, float(middle[flips]), np.zeros(0, dtype=np.intp))
        flipped = np.flip(scene.pictures, axis=2 - flips)
        away = axis.mirrored(scene.centres)[:, None] - scene.centres
        unlike = np.hypot(away[..., 0], away[..., 1]) / scene.scale
        unlike += np.abs(np.log(scene.sizes[:, None] / scene.sizes))
        unlike += colours_apart(scene.colours, scene.colours)
        unlike += UNLIKE * (1 - in_common(flipped, scene.pictures))
        unlike = (unlike + unlike.T) / 2
        kinds = np.array([item.filled for item in scene.items])
        unlike[kinds[:, None] != kinds] = np.inf
        unlike[scene.sheets] = np.inf
        best = unlike.argmin(axis=1)
        mutual = (best[best] == np.arange(len(best))) & (unlike.min(axis=1) < MATE)
        mates = np.where(mutual, best, -1)
        if weights[mutual].sum() >= SYMMETRIC * weights.sum():
            found.append(Axis(flips, axis.place, mates))
    return tuple(found)
