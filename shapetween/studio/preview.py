"""A leg as it may be seen while a pin is dragged, from how it was seen with the pin elsewhere."""

from collections.abc import Sequence
from dataclasses import replace
from functools import lru_cache
from typing import Any

import numpy as np

from shapetween.api import Morph, Pin
from shapetween.base.arrays import Points
from shapetween.fill.parts import FilledPart
from shapetween.geometry.affine import mapped
from shapetween.outline.preview import Effort, Previews
from shapetween.pipeline import Prepared
from shapetween.scene.motion.tracks import Elastic, Mirrored, Shared, Track
from shapetween.scene.parts import PairPart

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
    fresh = {
        id(part): replace(part, bodies=tuple(next(found) for _ in part.bodies))
        for part in prepared.filled
    }
    parts = tuple(_renewed(part, fresh) for part in prepared.movement.parts)
    movement = replace(prepared.movement, parts=parts)
    renewed = replace(prepared, movement=movement, filled=tuple(fresh.values()))
    return replace(base, prepared=renewed)


def _renewed(part: Any, fresh: dict[int, FilledPart]) -> Any:
    """A part of the movement with its outlines as they are now."""
    if isinstance(part, PairPart):
        return replace(part, tracks=tuple(_followed(track, fresh) for track in part.tracks))
    return fresh.get(id(part), part)


def _followed(track: Track, fresh: dict[int, FilledPart]) -> Track:
    """A track with the outlines that it follows as they are now."""
    if isinstance(track, Shared):
        return Shared(_followed(track.track, fresh))
    if isinstance(track, Mirrored):
        return replace(track, track=_followed(track.track, fresh))
    if isinstance(track, Elastic):
        return Elastic(fresh.get(id(track.part), track.part))
    return track


@lru_cache(maxsize=4)  # by identity; as many as legs are kept
def _previews(prepared: Prepared, pins: tuple[Pin, ...]) -> Previews | None:
    bodies = [body for part in prepared.filled for body in part.bodies]
    return Previews.of(bodies, _in_frame(pins, prepared)) if bodies else None


def _in_frame(pins: Sequence[Pin], prepared: Prepared) -> Points:
    """Pins (K, 4), both ends in the movement's frame."""
    rows = np.array(pins, dtype=np.float64).reshape(-1, 4)
    rows[:, 2:] = mapped(rows[:, 2:], prepared.fit)
    return rows
