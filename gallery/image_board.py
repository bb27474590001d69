"""Figures 1 and 2 of the paper as warps of a picture: a lettered board on its way.

Writes ``image_figure_1.webp``, the board by two affine triangles and as a plane, and
``image_figure_2.webp``, with each normalisation left out. The movements are those of
``figure_1.py`` and ``figure_2.py``, which show them as drawings.
"""

import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike
from PIL import Image, ImageDraw, ImageFont

from shapetween.base.arrays import Floats, Index, Points, times
from shapetween.interpolate import tween
from shapetween.mesh.pair import MeshPair
from shapetween.photo.layers import Piece
from shapetween.photo.transition import Transition
from shapetween.raster.encode import Clock, writer_for
from shapetween.raster.light import Bytes
from shapetween.raster.picture import Picture
from shapetween.timing.easing import easing_function, even_times

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE))

import figure_1  # noqa: E402
import figure_2  # noqa: E402

#: Side of the board's picture, and cells along it.
SIDE, CELLS = 600, 6

#: Width and height of a panel, of which the last rows are for its caption.
PANEL, CAPTION = (300, 226), 30

PAPER, INK, BLUE = "#fbfaf7", "#22262e", "#1f5fa8"

#: The paper's colour as light.
BACKGROUND = (0.965, 0.955, 0.930, 1.0)

FRAMES, FPS, HELD = 24, 12.0, 8

#: Room in a panel around all of a movement, as a share of the panel.
ROOM = 0.06

CORNERS = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]) * SIDE

WHOLE, HALVES = np.array([[0, 1, 2, 3]]), np.array([[0, 1, 2], [0, 2, 3]])


@dataclass(frozen=True, slots=True, eq=False)
class Way:
    """Corners of the board at the frames' times, in the picture's pixels."""

    moments: Floats
    corners: Points

    def vertices(self, t: ArrayLike) -> Points:
        index = np.searchsorted(self.moments, times(t))
        return self.corners[index]


def board() -> Picture:
    """A checkerboard with a letter in each cell."""
    image = Image.new("RGB", (SIDE, SIDE), "white")
    draw = ImageDraw.Draw(image)
    cell = SIDE / CELLS
    font = ImageFont.load_default(round(cell * 0.66))
    for k in range(CELLS * CELLS):
        row, column = divmod(k, CELLS)
        x, y = column * cell, row * cell
        dark = (row + column) % 2 == 0
        if dark:
            draw.rectangle((x, y, x + cell - 1, y + cell - 1), fill=BLUE)
        letter = "PROJECTIVE TRANSFORMATIONS OF PLANES"[k]
        colour = "white" if dark else INK
        draw.text((x + cell / 2, y + cell / 2), letter, fill=colour, font=font, anchor="mm")
    draw.rectangle((0, 0, SIDE - 1, SIDE - 1), outline=INK, width=8)
    return Picture.of(np.array(image))


def panel(picture: Picture, corners: Points, faces: Index, moments: Floats) -> list[Bytes]:
    """Frames of the board with corners (F, 4, 2) that fit the panel."""
    quads, triangles = (faces, np.zeros((0, 3), np.intp))
    if faces.shape[1] == 3:
        quads, triangles = np.zeros((0, 4), np.intp), faces
    # A frame's pixels are the picture's, scaled and centred; the way is given in the latter.
    size = (PANEL[0], PANEL[1] - CAPTION)
    scale = min(size) / SIDE
    shift = (np.array(size) - scale * SIDE) / 2
    way = Way(moments, (corners - shift) / scale)
    pair = MeshPair(CORNERS, CORNERS, quads, triangles)
    transition = Transition.between(
        picture, picture, [Piece(pair, way)], moments, size=size, background=BACKGROUND
    )
    return list(transition.frames())


def fitted(ways: Sequence[Points]) -> list[Points]:
    """Movements (F, 4, 2) moved and scaled together into a panel."""
    flat = np.concatenate([way.reshape(-1, 2) for way in ways])
    low, high = flat.min(axis=0), flat.max(axis=0)
    size = np.array([PANEL[0], PANEL[1] - CAPTION])
    scale = ((1 - 2 * ROOM) * size / (high - low)).min()
    return [(way - (low + high) / 2) * scale + size / 2 for way in ways]


def captioned(frames: Sequence[Bytes], text: str) -> list[Bytes]:
    """Frames with a line of text below."""
    strip = Image.new("RGB", (PANEL[0], CAPTION), PAPER)
    place = (PANEL[0] / 2, CAPTION / 2)
    ImageDraw.Draw(strip).text(place, text, fill=INK, font=ImageFont.load_default(15), anchor="mm")
    below = np.array(strip)
    return [np.concatenate([frame, below]) for frame in frames]


def write(name: str, rows: Sequence[Sequence[list[Bytes]]]) -> None:
    """Panels side by side and below one another; the way back would only make the file larger."""
    whole = np.concatenate([np.concatenate(row, axis=2) for row in rows], axis=1)
    last = FRAMES - 1
    order = [*[0] * HELD, *range(FRAMES), *[last] * HELD]
    out = HERE / name
    writer_for(out)(out, (whole[k] for k in order), Clock(len(order), FPS, repeats=True))


def main() -> None:
    picture = board()
    moments = easing_function("ease-in-out")(even_times(FRAMES))
    pair = MeshPair(figure_1.SQUARE, figure_1.SEEN, WHOLE)
    (way,) = fitted([tween(pair).vertices(moments)])
    write(
        "image_figure_1.webp",
        [
            [
                captioned(panel(picture, way, HALVES, moments), "two triangles"),
                captioned(panel(picture, way, WHOLE, moments), "one plane"),
            ]
        ],
    )
    rows = figure_2.rows()
    nothing = figure_2.SOURCE[:, :0]
    ways = fitted([figure_2.carried(of, nothing, moments)[0][:, 0] for _, _, of in rows])
    panels = [
        captioned(panel(picture, way, WHOLE, moments), name.replace("  ", ": "))
        for (name, _, _), way in zip(rows, ways, strict=True)
    ]
    write("image_figure_2.webp", [panels[:2], panels[2:]])


if __name__ == "__main__":
    main()
