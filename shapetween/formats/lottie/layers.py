"""One movement as layers of Lottie, straight in its own time."""

from collections.abc import Sequence

import numpy as np

from shapetween.base.arrays import Floats
from shapetween.formats.grid import Grid
from shapetween.formats.keyed import Keyed, keyed
from shapetween.formats.lottie.groups import Compositions, Frame, frame_size, in_order
from shapetween.formats.lottie.paints import paint_losses, painted, visible
from shapetween.formats.lottie.properties import (
    SIDE,
    Json,
    moving,
    moving_values,
    short,
    transform,
)
from shapetween.formats.options import WriteOptions
from shapetween.model.movement import Movement
from shapetween.model.paint import Style
from shapetween.model.part import Part
from shapetween.model.tracks import style_tracks
from shapetween.svg.write.animate_style import COLOUR_TOLERANCE

__all__ = ["leg_layers"]


def leg_layers(
    movement: Movement, grid: Grid, options: WriteOptions, length: float, name: str
) -> tuple[list[Json], list[Json], list[str]]:
    """Layers from the top one down, the compositions that they show, and what they do not hold.

    Parameters
    ----------
    movement : Movement
    grid : Grid
    options : WriteOptions
    length : float
        Frames from its start to its end; a last frame, after those, still shows the end.
    name : str
        What names of its compositions begin with.
    """
    losses: list[str] = []

    def drawn(part: Part, title: str, styles: Sequence[Style], times: Floats) -> list[Json]:
        made, lost = _part_layers(part, styles, length * times, title, grid, options, length)
        losses.extend(f"{title}: {loss}" for loss in lost)
        return made

    groups = Compositions(movement, Frame(name, length, frame_size(grid.box)), drawn)
    layers: list[Json] = []
    for number, part in enumerate(movement.parts, start=1):
        groups.add(layers, number - 1, part.name or f"part {number}")
    return in_order(layers), groups.assets, [*losses, *groups.losses]


def _part_layers(
    part: Part,
    styles: Sequence[Style],
    frames: Floats,
    name: str,
    grid: Grid,
    options: WriteOptions,
    length: float,
) -> tuple[list[Json], list[str]]:
    """A layer for each kind of paint that a part has in its time, as it is at some frames."""
    if not visible(styles):
        return [], []
    keys = keyed(part, options, max(grid.box.width, grid.box.height))
    rings = _paths(keys, grid)
    shapes = [
        {"ty": "sh", "ks": moving_values(length * keys.clock, [[path] for path in ring])}
        for ring in rings
    ]
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
    return layers, [*paint_losses(styles), *keys.losses]


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
