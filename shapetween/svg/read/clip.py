"""Clip paths and the edges of nested viewports, applied to shapes.

A shape that its clips do not touch keeps its curves; one that they hide is gone; one that they cut
becomes what is left of it, its stroke a shape of its own.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import sqrt
from typing import TYPE_CHECKING
from xml.etree.ElementTree import Element

import numpy as np

from shapetween.boolean.area import filled_area
from shapetween.boolean.chords import Chords, chords_of, joined
from shapetween.boolean.trace import traced
from shapetween.geometry.bezier import line_curves
from shapetween.model.drawing import Box, Shape
from shapetween.model.outline import Outline
from shapetween.model.paint import Style
from shapetween.svg.read.area import stroked_area
from shapetween.svg.read.document import Document
from shapetween.svg.read.figure import rings_of
from shapetween.svg.read.frames import Clip, Frame, Placed
from shapetween.svg.read.painting import fill_rule
from shapetween.svg.read.shapes import SHAPES
from shapetween.svg.read.subpaths import subpaths_of
from shapetween.svg.read.transform import affine, compose
from shapetween.svg.read.walk import entered, object_box, walk
from shapetween.svg.read.xml import local_name

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry

__all__ = ["Clipper"]

LOST_CROSSING = "a shape that crosses itself too often was not clipped, or did not clip"

#: Share of a shape's area that a clip must hide to count as cutting it: edges that coincide, as
#: in drawings exported with their frame as a clip, differ by rounding.
LEAST_CUT = 1e-5

#: What cutting takes besides its points, as a number of points.
CLIP_WORK = 100

#: Clip paths that clip clip paths; more is taken for a circle.
MOST_NESTED = 8


@dataclass(frozen=True, slots=True, eq=False)
class _Region:
    """What clips show, and the chords of all curves that bound it."""

    area: BaseGeometry
    edges: tuple[Chords, ...]

    def within(self, other: _Region | None) -> _Region:
        """What both show."""
        if other is None:
            return self
        return _Region(self.area.intersection(other.area), self.edges + other.edges)


class Clipper:
    """Applies the clips of one document, each region being built once.

    Parameters
    ----------
    document : Document
    """

    def __init__(self, document: Document) -> None:
        self._document = document
        self._regions: dict[object, _Region | None] = {}
        # By the ids of the regions, which the dictionary above keeps alive.
        self._commons: dict[tuple[int, ...], _Region] = {}

    def clipped(self, shape: Shape, clips: Sequence[Clip]) -> list[Shape]:
        """What clips leave of a shape: itself, nothing, its parts.

        Parameters
        ----------
        shape : Shape
            In the drawing's user units.
        clips : sequence of Clip
        """
        region = self._common(clips)
        if region is None:
            return [shape]
        box = self._painted_box(shape)
        if region.area.contains(box):
            return [shape]
        if not region.area.intersects(box):
            return []
        stroke = shape.style.stroke
        chords = chords_of(shape.rings)
        self._document.spend("clip_points", len(chords.ends) + CLIP_WORK)
        edges = joined([chords, *region.edges])
        layers = []
        if shape.style.fill is not None:
            filled = replace(shape, style=replace(shape.style, stroke=None))
            layers.append((filled_area(chords.polylines, shape.style.fill_rule), filled))
        if stroke is not None:
            closed = [ring.closed for ring in shape.rings]
            drawn = replace(shape, style=replace(shape.style, fill=stroke.paint, stroke=None))
            layers.append((stroked_area(chords.polylines, closed, stroke), drawn))
        parts = []
        whole = shown = 0.0
        for area, part in layers:
            if area is None:
                self._document.losses.add(LOST_CROSSING)
                return [shape]
            left = area.intersection(region.area)
            whole += area.area
            shown += left.area
            if left.area > LEAST_CUT * area.area:
                style = replace(part.style, fill_rule="evenodd")
                rings = tuple(ring for polygon in traced(left, edges) for ring in polygon)
                parts.append(replace(part, rings=rings, style=style))
        if shown >= (1 - LEAST_CUT) * whole:
            return [shape]
        if stroke is not None and stroke.dashes:
            self._document.losses.add("a dashed stroke was clipped as a solid one")
        return [part for part in parts if part.rings]

    @staticmethod
    def _painted_box(shape: Shape) -> BaseGeometry:
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

    def _common(self, clips: Sequence[Clip], within: tuple[Element, ...] = ()) -> _Region | None:
        """What all clips show; None if they hide nothing."""
        import shapely

        regions = [region for clip in clips if (region := self._region(clip, within)) is not None]
        if not regions:
            return None
        key = tuple(map(id, regions))
        if key not in self._commons:
            common = shapely.intersection_all([region.area for region in regions])
            shapely.prepare(common)
            edges = tuple(chords for region in regions for chords in region.edges)
            self._commons[key] = _Region(common, edges)
        return self._commons[key]

    def _region(self, clip: Clip, within: tuple[Element, ...]) -> _Region | None:
        import shapely

        if clip.corners is not None:
            corners = clip.corners.tobytes()
            if corners not in self._regions:
                ring = Outline(line_curves(clip.corners, np.roll(clip.corners, -1, axis=0)))
                area = shapely.Polygon(clip.corners)
                self._regions[corners] = _Region(area, (chords_of([ring]),))
            return self._regions[corners]
        assert clip.element is not None  # a clip has either
        base = self._base(clip)
        if base is None:
            return None
        key = (clip.element, base.matrix.tobytes())
        if key not in self._regions:
            if clip.element in within or len(within) >= MOST_NESTED:
                self._document.losses.add("a clip path that clips itself was left out")
                return None
            self._regions[key] = self._built(clip.element, base, (*within, clip.element))
        return self._regions[key]

    def _base(self, clip: Clip) -> Frame | None:
        """The frame of a clip path's own coordinates; None if it cannot be known."""
        frame = replace(clip.frame, properties={}, clips=(), uses=(), translucent=())
        assert clip.element is not None
        if clip.element.get("clipPathUnits", "").strip() != "objectBoundingBox":
            return frame
        box = object_box(self._document, clip.clipped, clip.frame) or Box(0.0, 0.0, 0.0, 0.0)
        step = affine(box.width, 0, 0, box.height, box.x, box.y)
        viewport = replace(frame.viewport, width=1.0, height=1.0)
        return replace(frame, matrix=compose(frame.matrix, step), viewport=viewport)

    def _built(self, element: Element, base: Frame, within: tuple[Element, ...]) -> _Region | None:
        import shapely

        if any(local_name(child) == "text" for child in element):
            self._document.losses.add("a clip path with text was left out")
            return None
        properties = self._document.cascade.properties(element, {})
        inner = entered(self._document, element, properties, base)
        parts: list[_Region] = []
        for child in element if inner is not None else ():
            if inner is None or local_name(child) not in SHAPES.keys() | {"use"}:
                continue
            for placed in walk(self._document, child, replace(inner, clips=())):
                if placed.frame.properties.get("visibility", "visible") != "visible":
                    continue
                rings = self._rings(placed)
                if not rings:
                    continue
                chords = chords_of(rings)
                self._document.spend("clip_points", len(chords.ends) + CLIP_WORK)
                rule = fill_rule(placed.frame.properties, "clip-rule")
                area = filled_area(chords.polylines, rule)
                if area is None:
                    self._document.losses.add(LOST_CROSSING)
                    return None
                own = self._common(placed.frame.clips, within)
                parts.append(_Region(area, (chords,)).within(own))
        area = shapely.union_all([shapely.Polygon(), *(part.area for part in parts)])
        region = _Region(area, tuple(chords for part in parts for chords in part.edges))
        return region.within(self._common(inner.clips if inner is not None else (), within))

    def _rings(self, placed: Placed) -> tuple[Outline, ...]:
        """What one element of a clip path draws."""
        subpaths = subpaths_of(self._document, placed)
        return rings_of(self._document, placed, subpaths, Style())
