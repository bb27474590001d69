"""Placed elements to shapes, with all that their ancestors do to them.

What can be said of a shape itself is: an opacity that no overlap shows, a clip or a mask that cuts
its outline. The rest becomes groups that the shape is in.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from shapetween.base.arrays import Floats
from shapetween.model.drawing import Shape
from shapetween.model.paint import Group, Mask
from shapetween.svg.read.clip import Clipper, Region
from shapetween.svg.read.document import Document
from shapetween.svg.read.figure import shapes_of
from shapetween.svg.read.frames import Layer, Placed
from shapetween.svg.read.markers import markers_of
from shapetween.svg.read.masks import Masker

__all__ = ["Painter", "shape_box"]

#: Shapes in a translucent group up to which overlaps are looked for; in larger groups some
#: overlap is taken for granted.
MOST_COMPARED = 500


class Painter:
    """Paints what a document holds, as shapes.

    Parameters
    ----------
    document : Document
    """

    def __init__(self, document: Document) -> None:
        self._document = document
        document.painted = self.painted
        self._clipper = Clipper(document)
        self._masker = Masker(document, self._clipper, self.painted)
        # By the ids of layers, which live as long as the values that hold them.
        self._groups: dict[tuple[int, int, bool, bool], tuple[Layer, tuple[Group, ...]]] = {}

    def painted(self, placed: Iterable[Placed]) -> list[Shape]:
        """The shapes that elements paint, in paint order."""
        whole = [
            (shape, each.frame.layers)
            for marked in placed
            for each in (marked, *markers_of(self._document, marked))
            for shape in shapes_of(self._document, each)
        ]
        veils, blended = self._veils(whole), _Blended.of(whole)
        return [
            part
            for shape, layers in whole
            for part in self._finished(shape, layers, veils, blended)
        ]

    @staticmethod
    def _veils(whole: Sequence[tuple[Shape, tuple[Layer, ...]]]) -> set[int]:
        """Layers, by their ids, whose opacity shows where shapes in them overlap."""
        boxes: dict[int, list[Floats]] = {}
        for shape, layers in whole:
            for layer in layers:
                if layer.opacity < 1:
                    boxes.setdefault(id(layer), []).append(shape_box(shape))
        return {key for key, found in boxes.items() if _overlapping(found)}

    def _finished(
        self, shape: Shape, layers: Sequence[Layer], veils: set[int], blended: _Blended
    ) -> list[Shape]:
        """A shape with all that its layers do to it."""
        regions: list[Region] = []
        groups: list[Group] = []  # the innermost first
        opacity = 1.0
        for layer in reversed(layers):
            groups += self._filtered(layer)
            cut = [self._clipper.region(layer)]
            mask = self._masker.of(layer)
            soft: tuple[Mask, ...] = ()
            if isinstance(mask, Mask):
                soft = (mask,)
            else:
                cut.append(mask)
            found = [region for region in cut if region is not None]
            isolated = id(layer) in blended.layers
            filtered = any(group.filter is not None for group in groups)
            if filtered or (isolated and id(layer) in blended.filtered):  # may reach beyond it
                soft += tuple(self._clipper.mask(region) for region in found)
            else:
                regions += found
            veiled = layer.opacity < 1 and (
                id(layer) in veils or isolated or bool(groups) or bool(soft)
            )
            if layer.opacity < 1 and not veiled:
                opacity *= layer.opacity
            if soft or veiled or layer.blend != "normal" or isolated:
                groups += self._grouped(layer, soft, veiled, isolated)
        groups.reverse()
        style = replace(shape.style, opacity=shape.style.opacity * opacity, groups=tuple(groups))
        return self._clipper.clipped(replace(shape, style=style), regions)

    def _filtered(self, layer: Layer) -> tuple[Group, ...]:
        """The groups that a layer's filters make, the first applied first."""
        if layer.filters == "none":
            return ()
        key = (id(layer), -1, False, False)
        if key not in self._groups:
            from shapetween.svg.read.filters import filters_of

            made = tuple(Group(object(), filter=each) for each in filters_of(self._document, layer))
            self._groups[key] = layer, made
        return self._groups[key][1]

    def _grouped(
        self, layer: Layer, masks: tuple[Mask, ...], veiled: bool, isolated: bool
    ) -> tuple[Group, ...]:
        """The group of a layer, the same one for all shapes in it that it treats alike."""
        key = (id(layer), len(masks), veiled, isolated)
        if key not in self._groups:
            opacity = layer.opacity if veiled else 1.0
            group = Group(object(), opacity, layer.blend, isolated, None, masks)
            self._groups[key] = layer, (group,)
        return self._groups[key][1]


def shape_box(shape: Shape) -> Floats:
    """Least and greatest corner of what a shape paints, (2, 2)."""
    boxes = np.stack([ring.box for ring in shape.rings])
    margin = shape.style.stroke.width / 2 if shape.style.stroke else 0.0
    return np.stack([boxes[:, 0].min(axis=0) - margin, boxes[:, 1].max(axis=0) + margin])


@dataclass(frozen=True, slots=True)
class _Blended:
    """Layers, by their ids, that are one group as a whole.

    Attributes
    ----------
    layers : set of int
        Those within which something blends: it sees only what is in it.
    filtered : set of int
        Those within which there is a filter.
    """

    layers: set[int]
    filtered: set[int]

    @classmethod
    def of(cls, whole: Sequence[tuple[Shape, tuple[Layer, ...]]]) -> _Blended:
        """Those that some shapes are in."""
        layers: set[int] = set()
        filtered: set[int] = set()
        for _, row in whole:
            for outer, inner in pairwise(row):
                if inner.blend != "normal":
                    layers.add(id(outer))
            last = max((k for k, layer in enumerate(row) if layer.filters != "none"), default=0)
            filtered.update(id(layer) for layer in row[:last])
        return cls(layers, filtered)


def _overlapping(boxes: list[Floats]) -> bool:
    if len(boxes) > MOST_COMPARED:
        return True
    least, greatest = np.moveaxis(np.stack(boxes), 1, 0)
    meet = (least[:, None] < greatest[None]).all(axis=-1)
    return bool((meet & meet.T).sum() > len(boxes))
