"""Figure 2: the three normalisations before a homography is taken apart, and each left out."""

from collections.abc import Callable
from pathlib import Path

import numpy as np

from shapetween.base.arrays import Floats, Points, Quads
from shapetween.gallery import Exhibit, Picture
from shapetween.gallery.canvas import FAINT, Canvas, Panel, checkerboard
from shapetween.geometry.homography import apply_homography, quad_homographies
from shapetween.geometry.polygon import rms_radius
from shapetween.geometry.rotation import polar
from shapetween.interpolate.quads import QuadMotion

#: The same as warps of a picture, which ``image_board.py`` draws.
WARPED = Path(__file__).parent / "image_figure_2.webp"

#: A board, and the same one turned by a right angle and seen from its side.
SOURCE = np.array([[[2.0, 0.0], [3.0, 0.0], [3.0, 1.0], [2.0, 1.0]]])
TARGET = np.array([[[5.1, 0.1], [5.1, 1.2], [4.3, 0.95], [4.3, 0.45]]])

#: Source radius at which the turning line hardly bends the way, and one that is too small.
GOOD_SCALE, POOR_SCALE = 10.0, 0.1

Homographies = Callable[[Floats], Floats]


def taken_apart(origin: Points, scale: float) -> Homographies:
    """In-between homographies about an origin of choice, the drawing's frame to itself."""
    matrix = quad_homographies(SOURCE - origin, TARGET - origin)
    matrix = matrix / matrix[:, 2:, 2:]
    lines, image = matrix[:, 2, :2], matrix[:, :2, 2]
    angles, stretches = polar(matrix[:, :2, :2] - image[:, :, None] * lines[:, None, :])
    motion = QuadMotion(origin, image, angles, stretches, lines, rms_radius(SOURCE), scale)
    back = np.eye(3)
    back[:2, 2] = -origin[0]
    return lambda t: np.asarray(motion.homographies(t) @ back)


def blended(t: Floats) -> Floats:
    """The nine numbers of the matrix, each on a straight way: nothing is taken apart."""
    matrix = quad_homographies(SOURCE, TARGET)
    time = t[:, None, None, None]
    return np.asarray((1 - time) * np.eye(3) + time * matrix / matrix[:, 2:, 2:])


def rows() -> tuple[tuple[str, str, Homographies], ...]:
    """Name, note and movement of each panel."""
    centre = SOURCE.mean(axis=1)
    return (
        (
            "a  All in place",
            "about the centroid, at a radius of 10",
            taken_apart(centre, GOOD_SCALE),
        ),
        ("b  Not centred", "about the drawing's origin", taken_apart(0 * centre, GOOD_SCALE)),
        ("c  Not scaled", "at a radius of 0.1", taken_apart(centre, POOR_SCALE)),
        ("d  Not taken apart", "each number of the matrix straight", blended),
    )


def draw() -> list[Exhibit]:
    canvas = Canvas(840, 560, "Normalisations of a homography, and what their absence does")
    dark, _ = checkerboard(SOURCE, 4)
    moments = np.array([0.0, 0.25, 0.5, 0.75, 1.0])
    frames = [carried(of, dark, canvas.times) for _, _, of in rows()]
    window = Panel.onto(np.concatenate([corners for corners, _ in frames]), 20, 70, 390, 190)
    for k, ((name, note, of), (corners, cells)) in enumerate(zip(rows(), frames, strict=True)):
        x, y = 410 * (k % 2), 275 * (k // 2)
        panel = window.moved(x, y)
        canvas.text(30 + x, 32 + y, name, 17, font_weight="600")
        canvas.text(30 + x, 52 + y, note, 13, fill=FAINT)
        still, _ = carried(of, dark, moments)
        canvas.faces(panel.place(still[:, 0]), fill="none", stroke="#b9b4a8", stroke_width="1")
        middle = panel.place(corners[:, 0].mean(axis=1))
        canvas.lines(middle[None], stroke="#d08a2e", stroke_width="1.5", stroke_dasharray="3 4")
        canvas.faces(panel.place(corners), fill="#fff", stroke="#22262e", stroke_width="1.3")
        canvas.faces(panel.place(cells), fill="#1f5fa8")
    text = (
        "One board on its way to one place, by the paper's own interpolation. (a) with all its "
        "normalisations. (b) about the drawing's origin instead of the board's centroid it swings "
        "out, and would do so differently wherever the drawing lies. (c) at a small source radius "
        "the perspective comes late and all at once, and the board shrinks on its way. (d) "
        "blending the matrix itself flattens the board where it should turn."
    )
    pictures = (
        Picture("figure-2.svg", canvas.svg(), "A board moved with and without normalisations"),
        Picture(WARPED.name, WARPED, "A picture of a board warped in each of the four ways"),
    )
    title = "Figure 2: why a homography is centred, scaled and taken apart"
    return [Exhibit(title, text, pictures)]


def carried(of: Homographies, dark: Points, t: Floats) -> tuple[Quads, Points]:
    """Corners (F, 1, 4, 2) and dark cells (F, N, 4, 2) at the times (F,)."""
    matrix = of(t)
    points = np.concatenate([SOURCE, dark.reshape(1, -1, 2)], axis=1)
    moved = apply_homography(matrix, np.broadcast_to(points, (len(t), *points.shape)))
    return moved[:, :, :4], moved[:, 0, 4:].reshape(len(t), -1, 4, 2)
