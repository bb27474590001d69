"""Neighbours of one paint as a single path, where that takes fewer bytes.

The rays of a sun, the dots of a list and the waves beside a loudspeaker are parts that move alike
and never touch. As one path they share their paint, the moments at which they are seen, and the
easings that they have in common. What has a name keeps a path of its own.
"""

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from shapetween.base.arrays import Floats
from shapetween.model.movement import Movement
from shapetween.model.part import Part
from shapetween.model.united import united
from shapetween.svg.write.parts import PartWriter

__all__ = ["gathered"]

#: Rings of what may become one path. With more, looking for its easings takes seconds.
MOST_RINGS = 40

#: Bytes of a path and its paint, besides what moves it.
PATH = 60

#: Share of the whole time by which parts may come or go at other times than neighbours, with whom
#: they do then: less than a frame of any screen. Smaller, and what comes together stays apart.
TOGETHER = 1e-3


def gathered(movement: Movement, writer: PartWriter) -> Movement:
    """The same with neighbours of one paint as single parts, wherever that is shorter."""
    parts: list[Part] = []
    for run in _runs(movement.parts, writer):
        parts += _shorter(run, writer)
    return replace(movement, parts=tuple(parts))


def _shorter(run: Sequence[Part], writer: PartWriter) -> Sequence[Part]:
    """Parts by themselves, or as one."""
    if len(run) == 1 or not any(writer.motion(part).animations for part in run):
        return run
    one = united(run)
    return [one] if _bytes(one, writer) < sum(_bytes(part, writer) for part in run) else run


def _bytes(part: Part, writer: PartWriter) -> int:
    """About how many a part takes; what moves has a twin that does not."""
    motion = writer.motion(part)
    return PATH + motion.bytes + (len(motion.rest) if motion.animations else 0)


def _runs(parts: Sequence[Part], writer: PartWriter) -> Iterator[list[Part]]:
    """Neighbours that may be one path: painted alike at all times, and nowhere touching."""
    run: list[Part] = []
    boxes: list[Floats] = []
    for part in parts:
        fits = bool(run) and _alike(run[0], part, writer)
        fits = fits and sum(len(each.rings) for each in [*run, part]) <= MOST_RINGS
        if fits:
            boxes = boxes or [_boxes(run[0], writer)]
            own = _boxes(part, writer)
            fits = not any(_touch(own, box) for box in boxes)
        if fits:
            run.append(part)
            boxes.append(own)
        else:
            if run:
                yield run
            run, boxes = [part], []
    if run:
        yield run


def _alike(first: Part, other: Part, writer: PartWriter) -> bool:
    """Whether two parts may be one path as far as names and paint say."""
    styles = writer.styles(first)
    if first.name or other.name or styles != writer.styles(other):
        return False
    # A pattern goes along with one shape, and dashes start where a line does.
    if any(s.groups or s.pattern or (s.stroke is not None and s.stroke.dashes) for s in styles):
        return False
    spans = np.array([writer.seen(first), writer.seen(other)])
    return bool(np.abs(spans[0] - spans[1]).max() <= TOGETHER)


def _boxes(part: Part, writer: PartWriter) -> Floats:
    """The boxes of a part and its lines at the times that paint is looked at, (S, 2, 2)."""
    points = part.curves(writer.times).reshape(len(writer.times), -1, 2)
    strokes = [style.stroke for style in writer.styles(part)]
    reach = np.array([0.0 if s is None else s.width * max(s.miter_limit, 2) / 2 for s in strokes])
    boxes = np.zeros((len(points), 2, 2))
    for axis in (0, 1):  # both at once take twenty times as long
        boxes[:, 0, axis] = points[..., axis].min(axis=1) - reach
        boxes[:, 1, axis] = points[..., axis].max(axis=1) + reach
    return boxes


def _touch(one: Floats, other: Floats) -> bool:
    """Whether boxes touch at any time."""
    apart = (one[:, 1] < other[:, 0]) | (other[:, 1] < one[:, 0])
    return not bool(apart.any(axis=1).all())
