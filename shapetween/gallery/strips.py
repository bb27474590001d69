"""Film strips of textured meshes: one row for each method, stills and then the movement."""

from collections.abc import Sequence

import numpy as np

from shapetween.base.arrays import Floats, Points
from shapetween.gallery.canvas import FAINT, Canvas, Panel, checkerboard
from shapetween.interpolate import INTERIORS, Tween, tween
from shapetween.interpolate.inside import Inside
from shapetween.mesh.pair import MeshPair

__all__ = ["STILLS", "method_strips"]

#: Times of the stills.
STILLS = np.array([0.0, 0.25, 0.5, 0.75, 1.0])

#: Width of a row's label, side of a cell, height of the head, all in pixels.
LABEL, CELL, HEAD = 150.0, 142.0, 36.0

#: Colours of a board's dark cells, quad after quad, and of its light ones.
DARK, LIGHT = ("#1f5fa8", "#a8481f", "#2a7a4b", "#7a3f8f", "#8a6a12"), "#ffffff"


def method_strips(
    title: str, pair: MeshPair, rows: Sequence[tuple[str, str, str | Tween]], cells: int
) -> str:
    """Draw a pair's movement by several methods.

    Parameters
    ----------
    title : str
    pair : MeshPair
        Of quads.
    rows : sequence of (str, str, str or Tween)
        What a row is called, what more is said of it, and its method; or another movement, by
        which quads move as planes.
    cells : int
        Of the checkerboard along each side of a quad.
    """
    width, height = LABEL + CELL * (len(STILLS) + 1) + 12, HEAD + CELL * len(rows) + 10
    canvas = Canvas(width, height, title)
    tweens = [tween(pair, how) if isinstance(how, str) else how for _, _, how in rows]
    everything = np.concatenate([t.vertices(canvas.times) for t in tweens])
    window = Panel.onto(everything, LABEL, HEAD, CELL, CELL)
    for k, t in enumerate(STILLS.tolist()):
        x = LABEL + CELL * (k + 0.5)
        canvas.text(x, 24, f"t = {t:g}", 13, text_anchor="middle", fill=FAINT)
    canvas.text(LABEL + CELL * 5.5, 24, "moving", 13, text_anchor="middle", fill=FAINT)
    for row, ((name, note, how), moving) in enumerate(zip(rows, tweens, strict=True)):
        y = CELL * row
        canvas.text(14, HEAD + y + CELL / 2 - 4, name, 15, font_weight="600")
        canvas.text(14, HEAD + y + CELL / 2 + 15, note, 12, fill=FAINT)
        inside = Inside.of(pair, INTERIORS[how] if isinstance(how, str) else "homography")
        boards = [
            _carried(inside, moving.vertices(times), cells) for times in (STILLS, canvas.times)
        ]
        for column in range(len(STILLS) + 1):
            panel = window.moved(CELL * column, y)
            still = column < len(STILLS)
            for quad, (outline, dark) in enumerate(zip(*boards[not still], strict=True)):
                shown = (outline, dark) if not still else (outline[column], dark[column])
                canvas.faces(panel.place(shown[0]), fill=LIGHT, stroke="#22262e", stroke_width="1")
                canvas.faces(panel.place(shown[1]), fill=DARK[quad % len(DARK)])
    return canvas.svg()


def _carried(inside: Inside, vertices: Points, cells: int) -> tuple[Floats, Floats]:
    """Outline (Q, F, 1, 4, 2) and dark cells (Q, F, N, 4, 2) of every quad's board."""
    pair = inside.pair
    dark, _ = checkerboard(pair.source[pair.quads], cells)
    moved = inside.points(vertices, dark.reshape(len(dark), -1, 2))
    boards = moved.reshape(len(vertices), *dark.shape)
    outlines = vertices[:, pair.quads][:, :, None]
    return np.moveaxis(outlines, 1, 0), np.moveaxis(boards, 1, 0)
