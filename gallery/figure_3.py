"""Figure 3: quads that move alone come apart, and force equilibrium puts them together again."""

import numpy as np

from shapetween.base.arrays import Points
from shapetween.gallery import Exhibit, Picture
from shapetween.gallery.canvas import FAINT, Canvas, Panel
from shapetween.interpolate import tween
from shapetween.interpolate.align import Equilibrium
from shapetween.interpolate.projective import PaperProjective
from shapetween.mesh.pair import MeshPair

#: Three quads around a corner, as in the paper, and the same ones pulled about.
A = np.array([[0, 1.0], [0.95, 0.8], [1.0, 1.9], [0, 2.1], [2.0, 1.0], [2.1, 2.0], [1.2, 3.0]])
B = np.array(
    [[0.5, 1.9], [1.15, 1.0], [1.75, 2.05], [1.0, 2.7], [1.9, 0.1], [2.9, 1.3], [2.7, 2.8]]
)
QUADS = np.array([[0, 1, 2, 3], [1, 4, 5, 2], [3, 2, 5, 6]])

COLOURS = ("#5b8fd0", "#e0915f", "#6fb08a")
MIDDLE = 0.5


def draw() -> list[Exhibit]:
    pair = MeshPair(A, B, QUADS)
    moving = PaperProjective(pair)
    canvas = Canvas(900, 330, "Force equilibrium")
    loose = moving.loose_corners(canvas.times).reshape(-1, 3, 4, 2)
    whole = tween(pair, "projective-2007").vertices(canvas.times)[:, QUADS]
    at = int(np.abs(canvas.times - MIDDLE).argmin())
    window = Panel.onto(np.concatenate([loose, whole]), 10, 60, 290, 260)
    forces = Equilibrium.of([QUADS], len(A)).forces(loose[at].reshape(-1, 2))
    heads = (
        ("Loose", "every quad moved alone"),
        ("Forces", "half way: corners pull at each other"),
        ("Aligned", "moved to where all forces vanish"),
    )
    for k, (name, note) in enumerate(heads):
        panel = window.moved(300 * k, 0)
        canvas.text(24 + 300 * k, 30, name, 17, font_weight="600")
        canvas.text(24 + 300 * k, 50, note, 13, fill=FAINT)
        shown = (loose, loose[at], whole)[k]
        for quad, colour in enumerate(COLOURS):
            corners = shown[..., quad : quad + 1, :, :]
            canvas.faces(
                panel.place(corners),
                fill=colour, fill_opacity=".72", stroke="#22262e", stroke_width="1.2",
            )  # fmt: skip
    arrows(canvas, window.moved(300, 0), loose[at], forces)
    text = (
        "Left, each quad follows its own homography, and common corners come apart. Middle, half "
        "way: corners of the same vertex pull at each other (thin), which adds up to a force on "
        "each quad (arrows, enlarged). Right, the quads are moved, without turning, to where all "
        "forces are zero, and each vertex is put at the mean of its corners."
    )
    picture = Picture("figure-3.svg", canvas.svg(), "Loose quads, forces on them, aligned quads")
    return [Exhibit("Figure 3: force equilibrium", text, (picture,))]


def arrows(canvas: Canvas, panel: Panel, quads: Points, forces: Points) -> None:
    """Pulls between corners of one vertex, and the force on each quad."""
    vertices = QUADS.ravel()
    flat = quads.reshape(-1, 2)
    first, second = np.triu_indices(len(flat), 1)
    same = vertices[first] == vertices[second]
    pulls = np.stack([flat[first[same]], flat[second[same]]], axis=1)
    canvas.lines(panel.place(pulls), stroke="#c62f2f", stroke_width="1.4")
    canvas.dots(panel.place(flat), 2.2, fill="#c62f2f")
    starts = quads.mean(axis=1)
    size = 0.45 / np.abs(forces).max()
    for start, force in zip(starts, forces * size, strict=True):
        tip = start + force
        along = force / np.linalg.norm(force) * 0.13
        across = np.array([-along[1], along[0]]) * 0.55
        head = np.stack([tip, tip - along + across, tip - along - across])
        line = np.stack([start, tip - along * 0.8])
        canvas.lines(panel.place(line[None]), stroke="#22262e", stroke_width="3")
        canvas.faces(panel.place(head[None]), fill="#22262e")
