"""The subpaths of basic shapes and paths, in their own coordinates."""

import re
from collections.abc import Iterable

import numpy as np

from shapetween.svg.read.document import Document
from shapetween.svg.read.frames import Placed
from shapetween.svg.read.pathdata import Subpath
from shapetween.svg.read.shapes import basic_shape
from shapetween.svg.read.units import GREATEST

__all__ = ["in_range", "path_of"]

LOST_TAIL = "a shape was drawn only as far as its data is sound"
LOST_RANGE = "a ring with numbers out of all range was left out"

_CSS_PATH = re.compile(r"""path\(\s*(?:(?:nonzero|evenodd)\s*,\s*)?(["'])(.*)\1\s*\)""", re.DOTALL)


def path_of(document: Document, placed: Placed) -> tuple[Subpath, ...]:
    """The subpaths of a basic shape or a path; what is unsound is counted.

    Raises
    ------
    BudgetError
    """
    viewport = placed.frame.viewport
    data = document.geometry.get((placed.element, viewport))
    if data is None:
        values = dict(placed.values)
        path = _CSS_PATH.fullmatch(values.get("d", "").strip())
        if path:
            values["d"] = path[2]
        tag = "rect" if placed.tag == "image" else placed.tag  # it has no corners to round
        data = basic_shape(tag, values, viewport, document.limits.path_commands)
        document.geometry[placed.element, viewport] = data
    document.spend("path_commands", data.commands)
    if data.problem:
        where = f"in {placed.name!r}, " if placed.name else ""
        document.losses.add(LOST_TAIL, where + data.problem)
    return in_range(document, data.subpaths)


def in_range(document: Document, subpaths: Iterable[Subpath]) -> tuple[Subpath, ...]:
    """Subpaths without those that overflowed, or hold what is not a number."""
    kept = []
    for subpath in subpaths:
        if np.abs(subpath.curves).max(initial=0.0) <= GREATEST:
            kept.append(subpath)
        else:
            document.losses.add(LOST_RANGE)
    return tuple(kept)
