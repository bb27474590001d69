"""A leg as it may be seen while a pin is dragged, from how it was seen with the pin elsewhere."""

from collections.abc import Sequence
from dataclasses import replace
from functools import lru_cache

import numpy as np

from shapetween.api import Morph, Pin
from shapetween.base.arrays import Points
from shapetween.geometry.affine import mapped
from shapetween.model.part import CurveTrack
from shapetween.outline.preview import Effort, Previews
from shapetween.pipeline import Prepared

__all__ = ["previewed"]


def previewed(
    base: Morph, before: Sequence[Pin], pins: Sequence[Pin], level: Effort = "plane"
) -> Morph | None:
    """The movement with pins, near enough to what the full result will be.

    Parameters
    ----------
    base : Morph
        Prepared with other pins on the same outlines.
    before : sequence of (ax, ay, bx, by)
        Those pins.
    pins : sequence of (ax, ay, bx, by)
        Each in its own drawing's user units.
    level : {"line", "plane"}
        How rough the way may be.

    Returns
    -------
    Morph or None
        None where no outline is moved by itself, one has so many curves that another stands for
        it, or the pins are not on the outlines that they were on.
    """
    prepared = base.prepared
    previews = _previews(prepared, tuple(map(tuple, before)))
    moved = None if previews is None else previews.moved(_in_frame(pins, prepared), level)
    if moved is None:
        return None
    found = iter(moved)
    tracks = tuple(
        replace(track, bodies=tuple(next(found) for _ in track.bodies)) for track in prepared.filled
    )
    fresh: dict[int, CurveTrack] = {
        id(old): new for old, new in zip(prepared.filled, tracks, strict=True)
    }
    parts = tuple(
        part.following(lambda track: fresh.get(id(track), track))
        for part in prepared.movement.parts
    )
    movement = replace(prepared.movement, parts=parts)
    renewed = replace(prepared, movement=movement, filled=tracks)
    return replace(base, prepared=renewed)


@lru_cache(maxsize=4)  # by identity; as many as legs are kept
def _previews(prepared: Prepared, pins: tuple[Pin, ...]) -> Previews | None:
    bodies = [body for part in prepared.filled for body in part.bodies]
    return Previews.of(bodies, _in_frame(pins, prepared)) if bodies else None


def _in_frame(pins: Sequence[Pin], prepared: Prepared) -> Points:
    """Pins (K, 4), both ends in the movement's frame."""
    rows = np.array(pins, dtype=np.float64).reshape(-1, 4)
    rows[:, 2:] = mapped(rows[:, 2:], prepared.fit)
    return rows
