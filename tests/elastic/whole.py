"""Whole drawings moved as one elastic body, as those are that are one body cut into areas."""

import numpy as np

from shapetween.base.arrays import Points
from shapetween.base.observe import unobserved
from shapetween.elastic.fill import FillSettings
from shapetween.elastic.paths import plain_shapes
from shapetween.elastic.together import move_together
from shapetween.model.drawing import Box, Drawing
from shapetween.model.movement import Movement
from shapetween.pipeline import Prepared

__all__ = ["prepare_elastic"]


def _corners(box: Box) -> Points:
    return np.array([[box.x, box.y], [box.x + box.width, box.y + box.height]])


def prepare_elastic(source: Drawing, target: Drawing) -> Prepared:
    """The movement of two drawings in one frame."""
    shapes = plain_shapes(source.shapes, target.shapes)
    boxes = _corners(source.box), _corners(target.box)
    settings = FillSettings("projective", "prevent", None, np.zeros((0, 4)), [], unobserved)
    parts, carrier, said = move_together(
        *shapes, boxes, [], settings, ("source", "target"), together=True
    )
    return Prepared(Movement(parts, source.box), np.eye(2, 3), said, carrier=carrier)
