"""Regions outside of which nothing is painted, and shapes cut by them.

A shape that its clips do not touch keeps its curves; one that they hide is gone; of one that they
cut its fill becomes what is left of it, and its stroke stays a stroke that is seen through them.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import sqrt
from typing import TYPE_CHECKING
from xml.etree.ElementTree import Element

import numpy as np

from shapetween.base.arrays import Points
from shapetween.boolean.area import filled_area
from shapetween.boolean.chords import Chords, chords_of, joined
from shapetween.boolean.trace import traced
from shapetween.geometry.affine import affine, compose
from shapetween.geometry.bezier import line_curves
from shapetween.model.drawing import Box, Shape
from shapetween.model.outline import Outline
from shapetween.model.paint import Colour, FillRule, Group, Mask, Style
from shapetween.svg.read.document import Document
from shapetween.svg.read.figure import rings_of
from shapetween.svg.read.frames import Frame, Layer, Placed
from shapetween.svg.read.painting import fill_rule
from shapetween.svg.read.pathdata import Subpath
from shapetween.svg.read.shapes import SHAPES
from shapetween.svg.read.subpaths import subpaths_of
from shapetween.svg.read.walk import entered, object_box, walk
from shapetween.svg.read.xml import label, local_name

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry

__all__ = ["CLIP_WORK", "Clipper", "Region"]

LOST_CROSSING = "a clip path that crosses itself too often was left out"

#: Share of a shape's area that a clip must hide to count as cutting it: edges that coincide, as
#: in drawings exported with their frame as a clip, differ by rounding.
LEAST_CUT = 1e-5

#: What cutting takes besides its points, as a number of points.
CLIP_WORK = 100

#: Elements that clip.
CLIPPING = frozenset({*SHAPES, "text"})

#: Clip paths that clip clip paths; more is taken for a circle.
MOST_NESTED = 8

WHITE = Colour(1.0, 1.0, 1.0)


@dataclass(frozen=True, slots=True, eq=False)
class Region:
    """What clips show, and the chords of all curves that bound it."""

    area: BaseGeometry
    edges: tuple[Chords, ...]

    def within(self, other: Region | None) -> Region:
        """What both show."""
        if other is None:
            return self
        return Region(self.area.intersection(other.area), self.edges + other.edges)


class Clipper:
    """Applies the clips of one document, each region being built once.

    Parameters
    ----------
    document : Document
    """

    def __init__(self, document: Document) -> None:
        self._document = document
        self._regions: dict[object, Region | None] = {}
        # By the ids of regions that stay alive: those above, and those of masks.
        self._commons: dict[tuple[int, ...], tuple[Region, Sequence[Region]]] = {}
        self._groups: dict[int, tuple[Group, Region]] = {}

    def clipped(self, shape: Shape, regions: Sequence[Region]) -> list[Shape]:
        """What regions leave of a shape: itself, nothing, its parts.

        Parameters
        ----------
        shape : Shape
            In the drawing's user units.
        regions : sequence of Region
        """
        region = self.common(regions)
        if region is None:
            return [shape]
        box = painted_box(shape)
        if region.area.contains(box):
            return [shape]
        if not region.area.intersects(box):
            return []
        chords = chords_of(shape.rings)
        self._document.spend("clip_points", len(chords.ends) + CLIP_WORK)
        fill = self._filled(shape, chords, region)
        stroke = self._stroked(shape, chords, region)
        if None not in (*fill, *stroke):
            return [part for part in (*fill, *stroke) if part is not None]
        if fill in ([], [None]) and stroke in ([], [None]):
            painted = [shape.style.fill is not None, shape.style.stroke is not None]
            if [bool(fill), bool(stroke)] == painted:
                return [shape]
        # One is whole, the other is cut or hidden.
        closed = tuple(ring.close() for ring in shape.rings)
        parts = [
            part
            if part is not None
            else replace(shape, rings=closed, style=replace(shape.style, stroke=None))
            for part in fill
        ]
        line = replace(shape, style=replace(shape.style, fill=None))
        return parts + [line if part is None else part for part in stroke]

    def _filled(self, shape: Shape, chords: Chords, region: Region) -> list[Shape | None]:
        """What is left of a shape's fill; None stands for all of it."""
        style = replace(shape.style, stroke=None)
        if style.fill is None:
            return []
        area = filled_area(chords.polylines, style.fill_rule)
        if area is None:  # it crosses itself too often to be cut
            closed = tuple(ring.close() for ring in shape.rings)
            return [self.under(replace(shape, rings=closed, style=style), region)]
        left = area.intersection(region.area)
        if left.area <= LEAST_CUT * area.area:
            return []
        if left.area >= (1 - LEAST_CUT) * area.area:
            return [None]
        edges = joined([chords, *region.edges])
        rings = tuple(ring for polygon in traced(left, edges) for ring in polygon)
        cut = replace(shape, rings=rings, style=replace(style, fill_rule="evenodd"))
        return [cut] if rings else []

    def _stroked(self, shape: Shape, chords: Chords, region: Region) -> list[Shape | None]:
        """What is left of a shape's stroke: all of it, under a clip where that cuts it."""
        from shapetween.svg.read.area import stroked_area

        stroke = shape.style.stroke
        if stroke is None:
            return []
        closed = [ring.closed for ring in shape.rings]
        area = stroked_area(chords.polylines, closed, stroke)
        if area is not None:
            left = area.intersection(region.area).area
            if left <= LEAST_CUT * area.area:
                return []
            if left >= (1 - LEAST_CUT) * area.area:
                return [None]
        return [self.under(replace(shape, style=replace(shape.style, fill=None)), region)]

    def under(self, shape: Shape, region: Region) -> Shape:
        """A shape as it is, seen through a region."""
        if id(region) not in self._groups:
            self._groups[id(region)] = Group(object(), masks=(self.mask(region),)), region
        group, _ = self._groups[id(region)]
        return replace(shape, style=replace(shape.style, groups=(*shape.style.groups, group)))

    @staticmethod
    def mask(region: Region) -> Mask:
        """A region as a mask; an empty one hides everything."""
        rings = [
            ring
            for polygon in (traced(region.area, joined(region.edges)) if region.edges else ())
            for ring in polygon
        ]
        shapes = (Shape(tuple(rings), Style(WHITE, fill_rule="evenodd")),) if rings else ()
        return Mask(shapes, plain=True)

    def common(self, regions: Sequence[Region]) -> Region | None:
        """What all regions show; None if there are none."""
        import shapely

        if not regions:
            return None
        key = tuple(map(id, regions))
        if key not in self._commons:
            common = shapely.intersection_all([region.area for region in regions])
            shapely.prepare(common)
            edges = tuple(chords for region in regions for chords in region.edges)
            self._commons[key] = Region(common, edges), regions
        return self._commons[key][0]

    def of(self, layers: Sequence[Layer], within: tuple[Element, ...] = ()) -> list[Region]:
        """The regions of those layers that have a clip."""
        return [region for layer in layers if (region := self.region(layer, within)) is not None]

    def region(self, layer: Layer, within: tuple[Element, ...] = ()) -> Region | None:
        """What a layer's clip shows; None if it has none, or one that was left out."""
        clip = layer.clip
        if clip is None:
            return None
        if isinstance(clip, str):
            key: object = (clip, layer.element, layer.frame.matrix.tobytes())
            if key not in self._regions:
                self._regions[key] = self._given(clip, layer)
            return self._regions[key]
        if isinstance(clip, np.ndarray):
            return self.inside(clip)
        base = self._base(clip, layer)
        key = (clip, base.matrix.tobytes())
        if key not in self._regions:
            if clip in within or len(within) >= MOST_NESTED:
                self._document.losses.add("a clip path that clips itself was left out")
                return None
            self._regions[key] = self._built(clip, base, (*within, clip))
        return self._regions[key]

    def inside(self, corners: Points) -> Region | None:
        """The region within four corners in the drawing's user units."""
        import shapely

        key = corners.tobytes()
        if key not in self._regions:
            area = shapely.Polygon(corners)
            if not area.is_valid or area.area == 0:
                self._regions[key] = Region(shapely.Polygon(), ())
            else:
                ring = Outline(line_curves(corners, np.roll(corners, -1, axis=0)))
                self._regions[key] = Region(area, (chords_of([ring]),))
        return self._regions[key]

    def _given(self, text: str, layer: Layer) -> Region | None:
        """A clip that is a shape written in style."""
        from shapetween.svg.read.cssshape import css_shape

        found = css_shape(self._document, text, layer)
        if found is None:
            self._document.losses.add("a clip path given as a CSS shape was left out", text[:40])
            return None
        subpaths, rule = found
        tag = local_name(layer.element)
        return self._area(Placed(layer.element, tag, layer.frame), subpaths, rule)

    def _base(self, clip: Element, layer: Layer) -> Frame:
        """The frame of a clip path's own coordinates."""
        frame = replace(layer.frame, properties={}, layers=(), uses=())
        if clip.get("clipPathUnits", "").strip() != "objectBoundingBox":
            return frame
        box = object_box(self._document, layer.element, layer.frame) or Box(0.0, 0.0, 0.0, 0.0)
        step = affine(box.width, 0, 0, box.height, box.x, box.y)
        viewport = replace(frame.viewport, width=1.0, height=1.0)
        return replace(frame, matrix=compose(frame.matrix, step), viewport=viewport)

    def _built(self, element: Element, base: Frame, within: tuple[Element, ...]) -> Region | None:
        import shapely

        properties = self._document.style(element)
        inner = entered(self._document, element, properties, base)
        parts: list[Region] = []
        for child in element if inner is not None else ():
            if inner is None or not self._clips(child):
                continue
            for placed in walk(self._document, child, replace(inner, layers=())):
                if placed.frame.properties.get("visibility", "visible") != "visible":
                    continue
                subpaths = subpaths_of(self._document, placed)
                rule = fill_rule(placed.frame.properties, "clip-rule")
                part = self._area(placed, subpaths, rule)
                if part is None:
                    return None
                parts.append(part.within(self.common(self.of(placed.frame.layers, within))))
        area = shapely.union_all([shapely.Polygon(), *(part.area for part in parts)])
        region = Region(area, tuple(chords for part in parts for chords in part.edges))
        own = self.of(inner.layers if inner is not None else (), within)
        return region.within(self.common(own))

    def _clips(self, child: Element) -> bool:
        """Whether a child of a clip path counts: a shape or text, or what uses one itself."""
        if local_name(child) == "use":
            used = self._document.target(child)
            if used is not None and local_name(used) not in CLIPPING:
                what = "a clip path that uses no shape itself shows nothing, as in browsers"
                self._document.losses.add(what, label(child))
                return False
            return used is not None
        return local_name(child) in CLIPPING

    def _area(self, placed: Placed, subpaths: Sequence[Subpath], rule: FillRule) -> Region | None:
        """What subpaths enclose; None, with a warning, if that would take too long to tell."""
        import shapely

        rings = rings_of(self._document, placed, subpaths, Style())
        if not rings:
            return Region(shapely.Polygon(), ())
        chords = chords_of(rings)
        self._document.spend("clip_points", len(chords.ends) + CLIP_WORK)
        area = filled_area(chords.polylines, rule)
        if area is None:
            self._document.losses.add(LOST_CROSSING)
            return None
        return Region(area, (chords,))


def painted_box(shape: Shape) -> BaseGeometry:
    """A box that holds all control points and the stroke around them."""
    import shapely

    points = np.concatenate([ring.curves.reshape(-1, 2) for ring in shape.rings])
    stroke = shape.style.stroke
    margin = 0.0
    if stroke is not None:
        corner = stroke.miter_limit if stroke.join == "miter" else 1.0
        margin = stroke.width / 2 * max(corner, sqrt(2))  # as a square cap reaches
    least, greatest = points.min(axis=0) - margin, points.max(axis=0) + margin
    return shapely.box(*least, *greatest)
