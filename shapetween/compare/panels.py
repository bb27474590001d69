"""Movements as SVG: one that plays, frames in a strip, and all side by side in one document."""

import xml.etree.ElementTree as ET
from collections.abc import Sequence
from textwrap import wrap

import numpy as np

from shapetween.base.arrays import Floats, Points
from shapetween.compare.measures import TIMES
from shapetween.compare.variants import Variant
from shapetween.model.drawing import Box
from shapetween.svg.write.animate import animate
from shapetween.svg.write.clock import Clock
from shapetween.svg.write.elements import GradientDefs, add_shape, document, text_of
from shapetween.svg.write.numbers import decimals_for, number
from shapetween.svg.write.parts import PartWriter
from shapetween.timing.keyframes import KEYFRAME_TOLERANCE
from shapetween.timing.schedule import Schedule
from shapetween.timing.timeline import Timeline

__all__ = ["film_strip", "playing", "seen_box", "side_by_side"]

#: Room around everything that is drawn at any time, as a share of its larger side.
ROOM = 0.05

#: How far outside the view box something may be and still be shown, as a share of its sides. More,
#: and one stray dot makes all the rest small.
FARTHEST = 0.2

#: How much coarser keyframes and numbers are than in an animation of its own: panels are small.
COARSER, FEWER_DECIMALS = 2.5, 1

#: Side of a panel of the side by side picture, room for its name, and room between two.
PANEL, HEAD, GAP = 240.0, 34.0, 14.0

#: Most panels in a row.
COLUMNS = 3

#: Room between two frames of a strip, as a share of their width.
STRIP_GAP = 0.06

PAPER, INK, FAINT = "#f6f4ee", "#22262e", "#6a6f7a"


def seen_box(variants: Sequence[Variant]) -> Box:
    """A box that holds the view box and what any variant draws at any time, if not too far off."""
    moving = [v.movement for v in variants if v.movement is not None]
    view = moving[0].box
    points = [np.array([[view.x, view.y], [view.x + view.width, view.y + view.height]])]
    points += [part.curves(TIMES).reshape(-1, 2) for m in moving for part in m.parts]
    margin = FARTHEST * (points[0][1] - points[0][0])
    everything = np.clip(np.concatenate(points), points[0][0] - margin, points[0][1] + margin)
    low, high = everything.min(axis=0), everything.max(axis=0)
    room = ROOM * float((high - low).max())
    x, y = (low - room).tolist()
    width, height = (high - low + 2 * room).tolist()
    return Box(x, y, width, height)


def playing(variant: Variant, box: Box) -> str:
    """A variant as an inline ``<svg>`` that moves from 0 to 1 in a second, its mesh on top."""
    root = document(box, "")
    clock = Clock(Schedule.of("linear"), True, Timeline((1.0,), "once"))
    gradients = _gradients(root, box)
    _add_movement(root, variant, box, clock, gradients)
    mesh = ET.SubElement(root, "g", {"class": "mesh"})
    _add_mesh(mesh, variant, box, clock)
    return _text_of(root, gradients)


def film_strip(variant: Variant, box: Box, t: Floats, crossing: Sequence[bool]) -> str:
    """Frames of a variant in a row; those in which an outline crosses itself are marked."""
    assert variant.movement is not None  # a variant that failed has no strip
    pitch = box.width * (1 + STRIP_GAP)
    whole = Box(0, 0, pitch * len(t) - box.width * STRIP_GAP, box.height)
    root = document(whole, "")
    gradients = _gradients(root, box)
    for k, (drawing, crosses) in enumerate(zip(variant.movement.at(t), crossing, strict=True)):
        frame = _nested(root, box, k * pitch, 0.0, box.width, box.height)
        shown = "paper crossing" if crosses else "paper"
        _add_paper(frame, box, {"class": shown, "fill": PAPER})
        for shape in drawing.shapes:
            add_shape(frame, shape, gradients, {})
    return _text_of(root, gradients)


def side_by_side(variants: Sequence[Variant], title: str, duration: float) -> str:
    """All variants in one document, back and forth in step; where one failed it says why."""
    box = seen_box(variants)
    columns = min(COLUMNS, len(variants))
    rows = -(-len(variants) // columns)
    high = PANEL * box.height / box.width
    pitch = PANEL + GAP, HEAD + high + GAP
    width, height = GAP + columns * pitch[0], GAP / 2 + rows * pitch[1]
    root = document(Box(0, 0, width, height), title)
    root.set("font-family", "system-ui,'Segoe UI','DejaVu Sans',sans-serif")
    ET.SubElement(root, "rect", {"width": "100%", "height": "100%", "fill": "#fff"})
    clock = Clock(Schedule.of("ease-in-out"), True, Timeline((duration,), "alternate"))
    gradients = _gradients(root, box)
    for k, variant in enumerate(variants):
        x, y = GAP + k % columns * pitch[0], GAP / 2 + k // columns * pitch[1]
        _text(root, x, y + HEAD - 11, variant.title, INK, "15", weight="600")
        frame = _nested(root, box, x, y + HEAD, PANEL, high)
        _add_paper(frame, box, {"fill": PAPER})
        if variant.movement is not None:
            _add_movement(frame, variant, box, clock, gradients)
            continue
        for line, words in enumerate(wrap(variant.failure, 34)):
            _text(root, x + 14, y + HEAD + 30 + 18 * line, words, FAINT, "13")
    return _text_of(root, gradients)


def _gradients(root: ET.Element, box: Box) -> GradientDefs:
    """Where a document keeps all its gradients: one place, or their names would clash."""
    gradients = GradientDefs(_decimals(box))
    root.append(gradients.element)
    return gradients


def _text_of(root: ET.Element, gradients: GradientDefs) -> str:
    if not len(gradients.element):
        root.remove(gradients.element)
    return text_of(root)


def _add_movement(
    parent: ET.Element, variant: Variant, box: Box, clock: Clock, gradients: GradientDefs
) -> None:
    assert variant.movement is not None  # asked for only where there is one
    tolerance = COARSER * KEYFRAME_TOLERANCE * max(box.width, box.height)
    writer = PartWriter(clock, gradients, tolerance)
    for part in variant.movement.parts:
        writer.add(parent, part, {})


def _add_mesh(parent: ET.Element, variant: Variant, box: Box, clock: Clock) -> None:
    """Sides of the faces that move each body."""
    tolerance = 2 * COARSER * KEYFRAME_TOLERANCE * max(box.width, box.height)
    for skeleton in variant.skeletons:
        ends = skeleton.path.vertices(clock.schedule.time)[:, skeleton.edges]  # (F, E, 2, 2)
        picks = clock.pick(ends.reshape(len(ends), -1, 2), tolerance)
        values = _line_data(ends[picks], _decimals(box))
        path = ET.SubElement(parent, "path", {"d": values[0]})
        animate(path, "d", clock, picks, values)


def _line_data(ends: Points, decimals: int) -> list[str]:
    """Path data of separate lines (F, E, 2, 2), one text a frame."""
    texts = []
    for frame in ends.tolist():
        lines = (
            "M" + "L".join(f"{number(x, decimals)} {number(y, decimals)}" for x, y in line)
            for line in frame
        )
        texts.append("".join(lines))
    return texts


def _nested(
    parent: ET.Element, box: Box, x: float, y: float, width: float, height: float
) -> ET.Element:
    """A window onto `box`."""
    inner = document(box, "")
    del inner.attrib["xmlns"]
    places = {"x": x, "y": y, "width": width, "height": height}
    decimals = decimals_for(Box(0, 0, width, height))
    inner.attrib.update({name: number(value, decimals) for name, value in places.items()})
    parent.append(inner)
    return inner


def _add_paper(parent: ET.Element, box: Box, attributes: dict[str, str]) -> None:
    decimals = decimals_for(box)
    sides = {"x": box.x, "y": box.y, "width": box.width, "height": box.height}
    numbers = {name: number(value, decimals) for name, value in sides.items()}
    ET.SubElement(parent, "rect", {**numbers, **attributes})


def _text(
    parent: ET.Element,
    x: float,
    y: float,
    text: str,
    fill: str,
    size: str,
    weight: str = "400",
) -> None:
    place = {"x": number(x, 1), "y": number(y, 1)}
    style = {"fill": fill, "font-size": size, "font-weight": weight}
    ET.SubElement(parent, "text", place | style).text = text


def _decimals(box: Box) -> int:
    return max(0, decimals_for(box) - FEWER_DECIMALS)
