"""One movement as layers of Lottie, straight in its own time."""

import numpy as np

from shapetween.formats.grid import Grid
from shapetween.formats.keyed import Keyed, keyed
from shapetween.formats.lottie.paints import paint_losses, painted, visible
from shapetween.formats.lottie.properties import Json, fixed, moving, moving_values, short
from shapetween.formats.options import WriteOptions
from shapetween.formats.plain import plain_styles
from shapetween.model.movement import Movement
from shapetween.model.part import Part
from shapetween.model.tracks import style_tracks
from shapetween.svg.write.animate_style import COLOUR_TOLERANCE

__all__ = ["SIDE", "leg_layers", "transform"]

#: The larger side of the composition in pixels; a smaller one would be rounded to an odd shape,
#: for its sides must be whole numbers.
SIDE = 1000

#: Times at which paint is looked at: it changes evenly, and slower than shapes.
PAINT_TIMES = np.linspace(0.0, 1.0, 31)

#: A style's times are kept inside these, where it has all it needs on the way.
INSIDE = (1e-6, 1 - 1e-6)


def leg_layers(
    movement: Movement, grid: Grid, options: WriteOptions, length: float
) -> tuple[list[Json], list[str]]:
    """Layers from the top one down, and what they do not hold.

    Parameters
    ----------
    movement : Movement
    grid : Grid
    options : WriteOptions
    length : float
        Frames from its start to its end; a last frame, after those, still shows the end.
    """
    layers: list[Json] = []
    losses: list[str] = []
    for number, part in enumerate(movement.parts, start=1):
        name = part.name or f"part {number}"
        made, lost = _part_layers(part, name, grid, options, length)
        layers += made
        losses += [f"{name}: {loss}" for loss in lost]
    layers.reverse()
    for index, layer in enumerate(layers, start=1):
        layer["ind"] = index
    return layers, losses


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


def _part_layers(
    part: Part, name: str, grid: Grid, options: WriteOptions, length: float
) -> tuple[list[Json], list[str]]:
    """A layer for each kind of paint that a part has in its time."""
    styles = plain_styles(part, np.clip(PAINT_TIMES, *INSIDE).tolist())
    if not visible(styles):
        return [], []
    keys = keyed(part, options, max(grid.box.width, grid.box.height))
    rings = _paths(keys, grid)
    shapes = [
        {"ty": "sh", "ks": moving_values(length * keys.clock, [[path] for path in ring])}
        for ring in rings
    ]
    frames = length * PAINT_TIMES
    scale = 100 * SIDE * grid.step / max(grid.box.width, grid.box.height)
    layers = []
    for track in style_tracks(styles, by_words=True):
        paints = painted(track.styles, frames, grid)
        if not (paints and visible(track.styles)):
            continue
        opacities = 100 * np.array([style.opacity for style in track.styles])
        opacity = moving(opacities, frames, 100 * COLOUR_TOLERANCE, 2)
        group = {"ty": "tr"} | transform()
        last = track.end == len(styles)
        layers.append(
            {
                "ddd": 0,
                "ty": 4,
                "nm": name,
                "sr": 1,
                "ks": transform(scale, opacity),
                "ip": short(frames[track.start], 3),
                "op": short(length + 1 if last else frames[track.end], 3),
                "st": 0,
                "bm": 0,
                "shapes": [{"ty": "gr", "nm": name, "it": [*shapes, *paints, group]}],
            }
        )
    return layers, paint_losses(styles)


def _paths(keys: Keyed, grid: Grid) -> list[list[Json]]:
    """Of every ring, its path at every keyframe."""
    cells = grid.cells(keys.curves)
    rings = []
    first = 0
    for count, closed in zip(keys.shape.rings, keys.shape.closed, strict=True):
        own = cells[:, first : first + count]
        first += count
        leaving, arriving = own[:, :, 1] - own[:, :, 0], own[:, :, 2] - own[:, :, 3]
        vertices = own[:, :, 0]
        if closed:
            arriving = np.roll(arriving, 1, axis=1)
        else:
            none = np.zeros((len(own), 1, 2), own.dtype)
            vertices = np.concatenate([vertices, own[:, -1:, 3]], axis=1)
            leaving = np.concatenate([leaving, none], axis=1)
            arriving = np.concatenate([none, arriving], axis=1)
        rings.append(
            [
                {"c": closed, "v": v, "i": i, "o": o}
                for v, i, o in zip(
                    vertices.tolist(), arriving.tolist(), leaving.tolist(), strict=True
                )
            ]
        )
    return rings
