"""Figure 1: what two triangles make of a checkerboard that turns away, and what a plane does."""

from pathlib import Path

import numpy as np

from shapetween.gallery import Exhibit, Picture
from shapetween.gallery.canvas import FAINT, Canvas, Panel, checkerboard
from shapetween.interpolate import tween
from shapetween.interpolate.inside import Inside, Interior
from shapetween.mesh.pair import MeshPair

#: The same as warps of a picture, which ``image_board.py`` draws.
WARPED = Path(__file__).parent / "image_figure_1.webp"

SQUARE = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
SEEN = np.array([[0.1, 0.12], [1.12, 0.36], [1.12, 0.66], [0.1, 1.06]])

PANELS: tuple[tuple[str, str, Interior], ...] = (
    ("Piecewise affine", "two triangles, each by an affine map", "triangles"),
    ("Projective", "one quad, by a homography", "homography"),
)


def draw() -> list[Exhibit]:
    pair = MeshPair(SQUARE, SEEN, np.array([[0, 1, 2, 3]]))
    canvas = Canvas(760, 420, "A checkerboard by triangles and by a homography")
    vertices = tween(pair).vertices(canvas.times)
    window = Panel.onto(vertices, 20, 70, 350, 340)
    dark, _ = checkerboard(SQUARE[None], 8)
    for k, (name, note, interior) in enumerate(PANELS):
        panel = window.moved(370 * k, 0)
        places = dark.reshape(1, -1, 2)
        moved = Inside.of(pair, interior).points(vertices, places)
        cells = moved.reshape(len(vertices), -1, 4, 2)
        canvas.text(30 + 370 * k, 32, name, 19, font_weight="600")
        canvas.text(30 + 370 * k, 54, note, 13, fill=FAINT)
        outline = panel.place(vertices[:, None])
        canvas.faces(outline, fill="#fff", stroke="#22262e", stroke_width="1.5")
        canvas.faces(panel.place(cells), fill="#1f5fa8")
    text = (
        "A board turns away from us. Both halves have the same corners at every moment; only what "
        "lies between them differs. Cut into two triangles the lines of the board break along the "
        "diagonal; as one plane they stay straight, and its far cells become smaller."
    )
    shows = "A checkerboard moved by triangles and by a homography"
    pictures = (
        Picture("figure-1.svg", canvas.svg(), shows),
        Picture(WARPED.name, WARPED, "A picture of a lettered board warped in both ways"),
    )
    return [Exhibit("Figure 1: a plane is not two triangles", text, pictures)]
