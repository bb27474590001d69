"""Properties of Lottie: one value, or keyframes of them with straight ways between."""

from typing import Any, TypeAlias

import numpy as np

from shapetween.base.arrays import Floats
from shapetween.timing.keyframes import keyframes

__all__ = ["SIDE", "Json", "fixed", "moving", "moving_values", "short", "transform"]

Json: TypeAlias = dict[str, Any]

#: The larger side of the composition in pixels; a smaller one would be rounded to an odd shape,
#: for its sides must be whole numbers.
SIDE = 1000

#: Handles of a straight way between two keyframes.
STRAIGHT: Json = {"o": {"x": 0, "y": 0}, "i": {"x": 1, "y": 1}}

#: Decimals of a keyframe's time in frames: at 60 frames a second finer than any screen.
FRAME_DECIMALS = 3


def short(value: float, decimals: int) -> float:
    """A number with so many decimals at most, whole if it is."""
    rounded = round(float(value), decimals)
    return int(rounded) if rounded == int(rounded) else rounded


def fixed(value: Any) -> Json:
    """A property that never changes."""
    return {"a": 0, "k": value}


def moving_values(frames: Floats, values: list[Any]) -> Json:
    """A property that runs straight from value to value; one alone stays."""
    if len(values) == 1 or all(value == values[0] for value in values):
        value = values[0]
        return fixed(value[0] if isinstance(value, list) and len(value) == 1 else value)
    end = short(frames[-1], FRAME_DECIMALS)
    # In a very short movement several may fall on one time; of those at the end the last counts.
    keys: dict[float, Any] = {}
    for frame, value in zip(frames[:-1].tolist(), values[:-1], strict=True):
        keys.setdefault(short(frame, FRAME_DECIMALS), value)
    keys.pop(end, None)
    straight = [{"t": time, "s": value, **STRAIGHT} for time, value in keys.items()]
    return {"a": 1, "k": [*straight, {"t": end, "s": values[-1]}]}


def moving(track: Floats, frames: Floats, tolerance: float, decimals: int) -> Json:
    """A property of numbers (S,) or (S, D) at as many frames (S,).

    `tolerance` is how far a number may be off between two keyframes.
    """
    rows = track.reshape(len(track), -1)
    picks = keyframes(rows[:, :, None], frames, tolerance)
    values = [[short(v, decimals) for v in row] for row in np.asarray(rows[picks]).tolist()]
    return moving_values(frames[picks], values)


def transform(scale: float = 100.0, opacity: Json | None = None) -> Json:
    """A transform that only scales, in percent."""
    size = short(scale, 7)
    return {
        "o": opacity or fixed(100),
        "r": fixed(0),
        "p": fixed([0, 0]),
        "a": fixed([0, 0]),
        "s": fixed([size, size]),
    }
