"""Items: what a drawing is made of, one region of a fill or one line of a stroke each.

Whether several of them were written as one path or as several elements makes no difference from
here on.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from shapetween.base.arrays import Affine, Floats, Points
from shapetween.base.errors import OutlineError
from shapetween.base.notices import Notice
from shapetween.fill.regions import Region, regions_of
from shapetween.geometry.bezier import end_tangents, evaluate
from shapetween.model.blend import to_oklab
from shapetween.model.drawing import Shape
from shapetween.model.outline import Outline
from shapetween.model.paint import Colour, Gradient, Paint, Stroke, Style

if TYPE_CHECKING:
    import shapely

__all__ = [
    "SAMPLES",
    "Item",
    "Painted",
    "in_view",
    "intersection_over_union",
    "items_of",
    "seen_colour",
]

#: Even samples of an item's ring. Fewer cut small corners off what items are compared by; more
#: cost time with their square, where all items are compared with each other.
SAMPLES = 64

#: Chords of each curve that samples are taken from, and of a whole outline about, where it is of
#: so many curves that each has fewer. More take seconds on an outline like a coast; with fewer the
#: corners of what is seen are cut.
CHORDS, MOST_CHORDS = 12, 20_000

#: Cosine of the angle at which a line's end meets its start, from which on no join is seen there.
SMOOTH = 0.9999

#: Distance between a line's ends, as a share of its width, up to which they meet under round caps.
MEET = 0.1

#: Least product of opacities at which nothing is seen through a paint.
OPAQUE = 0.999

#: Size of a line beside that of its diagonal: a long line is seen as less than an area as large.
SLIM = 1.5

#: Share by which a ring may be wider than its stroke and still be a dot: icon sets draw dots as
#: rings exactly as wide. Without it, rounding decides.
ROUNDED = 1e-6


@dataclass(frozen=True, slots=True, eq=False)
class Painted:
    """The area that a line is painted as: a stroke that was turned into its outline.

    Attributes
    ----------
    rings : tuple of Outline
        One round an open line, two round a closed one; filled by the rule nonzero.
    style : Style
        A fill.
    """

    rings: tuple[Outline, ...]
    style: Style


@dataclass(frozen=True, eq=False)
class Item:
    """One region of a filled shape, or one line of a stroked one.

    Attributes
    ----------
    rings : tuple of Outline
        Of a region its outer ring and then its holes, all clockwise as drawn; or one line.
    style : Style
        A region's fill, and its stroke if it has one along the same rings; a line's has no fill.
    shape : int
        Which of the drawing's shapes, in paint order, it is part of.
    name : str
        That shape's.
    cut : bool
        Whether it is a piece of what was drawn as one.
    painted : Painted or None
        What a line is painted as, where that is no stroke.
    """

    rings: tuple[Outline, ...]
    style: Style
    shape: int = 0
    name: str = ""
    cut: bool = False
    painted: Painted | None = None

    @property
    def filled(self) -> bool:
        """Whether it is an area; else it is a line."""
        return self.style.fill is not None

    @property
    def plain(self) -> bool:
        """Whether it is an opaque area without a border, of one picture no more."""
        style = self.style
        if style.fill is None or style.stroke is not None or style.texture is not None:
            return False
        alpha = 1.0 if isinstance(style.fill, Gradient) else style.fill.alpha
        return alpha * style.opacity > OPAQUE

    @property
    def outer(self) -> Outline:
        """The line, or the region's outer ring."""
        return self.rings[0]

    @property
    def holes(self) -> tuple[Outline, ...]:
        """Rings inside the outer one."""
        return self.rings[1:]

    @property
    def closed(self) -> bool:
        """Whether its ring ends where it starts."""
        return self.outer.closed

    @property
    def width(self) -> float:
        """Width of its stroke; 0 without one."""
        return 0.0 if self.style.stroke is None else self.style.stroke.width

    @cached_property
    def chords(self) -> Points:
        """Chords of the outer ring with its last point, (N, 2)."""
        return _polyline(self.outer)

    @cached_property
    def points(self) -> Points:
        """Even samples along the outer ring, (SAMPLES, 2); of a line with both its ends."""
        return _even_points(self.chords, SAMPLES, closed=self.closed)

    @cached_property
    def length(self) -> float:
        """Length of the outer ring."""
        steps = np.diff(self.chords, axis=0)
        return float(np.hypot(steps[:, 0], steps[:, 1]).sum())

    @cached_property
    def drawn(self) -> "shapely.Geometry":
        """What is painted: the region, or the line in its width."""
        import shapely

        if not self.filled:
            return _painted_line(self.chords, self.closed, self.style.stroke)
        if self.closed and not self.holes:
            return self.enclosed
        return _area(shapely.Polygon(self.chords, [_polyline(ring) for ring in self.holes]))

    @cached_property
    def enclosed(self) -> "shapely.Geometry":
        """What the outer ring encloses; of an open line what is painted."""
        import shapely

        if not self.closed:
            return self.drawn
        return _area(shapely.Polygon(self.chords))

    @cached_property
    def area(self) -> float:
        """Area of what is painted."""
        return float(self.drawn.area)

    @cached_property
    def centre(self) -> Points:
        """Middle of the area that the outer ring encloses, or of the line, (2,)."""
        if self.closed:
            area = self.enclosed
            if area.area > 0:
                return np.array([area.centroid.x, area.centroid.y])
        return np.asarray(self.points.mean(axis=0))

    @cached_property
    def box(self) -> Points:
        """Least and greatest corner of the outer ring, (2, 2)."""
        return np.stack([self.chords.min(axis=0), self.chords.max(axis=0)])

    @cached_property
    def extent(self) -> float:
        """Diagonal of its box and its width together."""
        return float(np.hypot(*np.ptp(self.box, axis=0))) + (0.0 if self.filled else self.width)

    @cached_property
    def size(self) -> float:
        """How large it is seen, a length: the root of its area, or less than a line's diagonal."""
        if self.filled:
            return float(np.sqrt(self.enclosed.area))
        return float(np.hypot(*np.ptp(self.box, axis=0))) / SLIM + self.width / 3

    @cached_property
    def colour(self) -> Floats:
        """What is seen of its paint: OKLab, times how opaque it is, and that itself, (4,)."""
        style = self.style
        paint: Paint = style.fill
        if paint is None and style.stroke is not None:
            paint = style.stroke.paint
        return seen_colour(paint, style.opacity)

    @property
    def as_shape(self) -> Shape:
        """The item by itself; its holes run against its outer ring, so that any rule shows them."""
        holes = tuple(hole.reversed() for hole in self.holes)
        return Shape((self.outer, *holes), self.style, self.name)

    def replaced(self, rings: tuple[Outline, ...]) -> "Item":
        """The same item with other rings."""
        return replace(self, rings=rings)

    def transformed(self, matrix: Affine) -> "Item":
        """The item with all its outlines mapped by an affine map (2, 3), its styles as they are."""
        painted = self.painted
        if painted is not None:
            areas = tuple(ring.transformed(matrix) for ring in painted.rings)
            painted = replace(painted, rings=areas)
        rings = tuple(ring.transformed(matrix) for ring in self.rings)
        return replace(self, rings=rings, painted=painted)


def items_of(shapes: Sequence[Shape], name: str) -> tuple[tuple[Item, ...], tuple[Notice, ...]]:
    """All that can be seen of some shapes, in paint order, and what there is to tell.

    Parameters
    ----------
    shapes : sequence of Shape
        In paint order.
    name : str
        What notices call the drawing.

    Raises
    ------
    OutlineError
        If nothing of it encloses an area or is stroked.
    """
    items: list[Item] = []
    notices: list[Notice] = []
    failure: OutlineError | None = None
    for k, shape in enumerate(shapes):
        called = f"{name}: shape {shape.name!r}" if shape.name else name
        stroke = shape.style.stroke if shape.style.stroke and shape.style.stroke.width else None
        style = replace(shape.style, stroke=stroke)
        outline_apart = stroke is not None and not all(
            joined(ring, stroke).closed for ring in shape.rings
        )
        if style.fill is not None:
            closed = Shape(tuple(ring.close() for ring in shape.rings), style, shape.name)
            try:
                regions, more = regions_of(closed, called)
            except OutlineError as error:
                failure = failure or error
                outline_apart = stroke is not None
            else:
                own = replace(style, stroke=None) if outline_apart else style
                items += [_region_item(region, own, k, shape.name) for region in regions]
                notices += more
        if stroke is not None and (style.fill is None or outline_apart):
            line = replace(style, fill=None, texture=None)
            items += [Item((joined(r, stroke),), line, k, shape.name) for r in shape.rings]
    if not items and failure is not None:
        raise failure
    return tuple(items), tuple(notices)


def in_view(
    items: Sequence[Item], view: Points, name: str
) -> tuple[tuple[Item, ...], tuple[Notice, ...]]:
    """Those items that lie in the view (2, 2), its least and greatest corner, at least in part.

    What is outside of it is never seen at rest, and would come into view as the others move. All of
    them, where none is inside; without them, a note says so.
    """
    seen = tuple(item for item in items if not _outside(item, view))
    if not seen or len(seen) == len(items):
        return tuple(items), ()
    count = len(items) - len(seen)
    message = f"{count} shape{'s lie' if count > 1 else ' lies'} outside of the view"
    return seen, (Notice("outside", message, name, "not moved", severity="note"),)


def _outside(item: Item, view: Points) -> bool:
    """Whether nothing of an item, its stroke and all, lies in a view."""
    stroke = item.style.stroke
    wide = stroke.width * max(1.0, stroke.miter_limit) / 2 if stroke is not None else 0.0
    return bool((item.box[1] + wide < view[0]).any() or (item.box[0] - wide > view[1]).any())


def _region_item(region: Region, style: Style, shape: int, name: str) -> Item:
    return Item((region.outer, *region.holes), style, shape, name)


def joined(ring: Outline, stroke: Stroke) -> Outline:
    """A line as a ring if its ends meet, unless its caps look other there than a join."""
    start, end = ring.curves[0, 0], ring.curves[-1, 3]
    gap = float(np.linalg.norm(end - start))
    if ring.closed or stroke.dashes or gap > MEET * stroke.width:
        return ring
    extent = float(np.ptp(ring.curves.reshape(-1, 2), axis=0).max())
    if extent <= (1 + ROUNDED) * stroke.width:
        return ring  # a dot is no ring
    leaving, reaching = end_tangents(ring.curves[[0, -1]])
    smooth = gap == 0 and float(leaving[0] @ reaching[1]) > SMOOTH
    return ring.close() if smooth or stroke.cap == stroke.join == "round" else ring


def seen_colour(paint: Paint, opacity: float) -> Floats:
    """OKLab of a paint, times how opaque it is, and that itself, (4,)."""
    if paint is None:
        return np.zeros(4)
    colours = [stop.colour for stop in paint.stops] if isinstance(paint, Gradient) else [paint]
    rows = [_premultiplied(colour, opacity) for colour in colours] or [np.zeros(4)]
    return np.asarray(np.mean(rows, axis=0))


def _premultiplied(colour: Colour, opacity: float) -> Floats:
    alpha = colour.alpha * opacity
    return np.append(to_oklab(colour) * alpha, alpha)


def intersection_over_union(one: "shapely.Geometry", other: "shapely.Geometry") -> float:
    """Area that two regions both cover, as a share of what either does; 0 of two without any."""
    both = one.intersection(other).area
    either = one.area + other.area - both
    return float(both / either) if either > 0 else 0.0


def _even_points(line: Points, count: int, *, closed: bool) -> Points:
    """Points at even distances along chords, (count, 2), of open ones from end to end."""
    steps = np.diff(line, axis=0)
    along = np.concatenate([[0.0], np.cumsum(np.hypot(steps[:, 0], steps[:, 1]))])
    if along[-1] == 0:
        return np.repeat(line[:1], count, axis=0)
    shares = np.arange(count) / count if closed else np.linspace(0.0, 1.0, count)
    wanted = shares * along[-1]
    x, y = (np.interp(wanted, along, line[:, k]) for k in (0, 1))
    return np.stack([x, y], axis=1)


def _area(polygon: "shapely.Polygon") -> "shapely.Geometry":
    """What a polygon whose rings may cross encloses, without its hairs: they have no border."""
    import shapely

    if polygon.is_valid:
        return polygon
    found = shapely.make_valid(polygon)
    parts = shapely.get_parts(found)
    areas = shapely.get_dimensions(parts) == 2
    return found if areas.all() or not areas.any() else shapely.union_all(parts[areas])


def _polyline(outline: Outline) -> Points:
    """Chords of an outline with its last point, (N, 2)."""
    each = min(CHORDS, -(-MOST_CHORDS // len(outline.curves)))
    points = evaluate(outline.curves, np.arange(each) / each).reshape(-1, 2)
    return np.concatenate([points, outline.curves[-1:, 3]])


def _painted_line(line: Points, closed: bool, stroke: Stroke | None) -> "shapely.Geometry":
    import shapely

    half = 0.0 if stroke is None else stroke.width / 2
    cap = "round" if stroke is None or stroke.cap == "round" else "flat"
    if float(np.ptp(line, axis=0).max()) <= 1e-9 * half:
        return shapely.Point(line[0]).buffer(half, quad_segs=6)
    ring = closed and len(line) > 3
    geometry = shapely.LinearRing(line[:-1]) if ring else shapely.LineString(line)
    style = "flat" if cap == "flat" else "round"
    return geometry.buffer(half, quad_segs=6, cap_style=style)
