"""A leg as it may be seen while a pin is dragged, from the leg without any."""

from collections.abc import Sequence
from dataclasses import replace
from functools import lru_cache

import numpy as np

from shapetween.api import Morph, Pin
from shapetween.elastic.parts import FilledPart
from shapetween.model.fit import mapped
from shapetween.outline.preview import Level, Previews

__all__ = ["previewed"]


def previewed(base: Morph, pins: Sequence[Pin], level: Level = "plane") -> Morph | None:
    """The movement with pins, near enough to what the full result will be.

    Parameters
    ----------
    base : Morph
        Without pins.
    pins : sequence of (ax, ay, bx, by)
        Each in its own drawing's user units.
    level : {"line", "plane"}
        How rough the way may be.

    Returns
    -------
    Morph or None
        None where drawings are more than one area that becomes another.
    """
    prepared = base.prepared
    parts = prepared.movement.parts
    part = parts[0] if len(parts) == 1 else None
    if prepared.scene is not None or not isinstance(part, FilledPart):
        return None
    if part.passengers or part.specks:
        return None
    previews = _previews(part)
    if previews is None:
        return None
    rows = np.array(pins, dtype=np.float64).reshape(-1, 4)
    rows[:, 2:] = mapped(rows[:, 2:], prepared.fit)
    moved = replace(part, bodies=previews.moved(rows, level))
    movement = replace(prepared.movement, parts=(moved,))
    return replace(base, prepared=replace(prepared, movement=movement))


@lru_cache(maxsize=4)  # by identity; as many as legs are kept
def _previews(part: FilledPart) -> Previews | None:
    return Previews.of(part.bodies)
