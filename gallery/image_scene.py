"""Draw a sign post of five boards as two cameras see it, and say where each board is.

Writes ``signpost-a.png``, ``signpost-b.png``, the post without boards ``signpost-bare.png`` and
the boards' corners ``signpost.json`` into ``inputs``. Every board is a plane that is turned about
the post; from the first picture to the second the camera goes round and the boards change places.
"""

import json
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from shapetween.base.arrays import Points
from shapetween.geometry.homography import quad_homographies

INPUTS = Path(__file__).parent / "inputs"

WIDTH, HEIGHT = 800, 600

#: How much finer everything is drawn before it is made smaller, which smooths its edges.
FINE = 3

#: Boards in metres, 1.5 by 0.3, as flat pictures of so many pixels a metre.
BOARD = (1.5, 0.3)
FLAT = 900

#: Focal length of both cameras, in pixels.
FOCAL = 640

NAMES = ("HARBOUR", "OLD MILL", "MUSEUM", "STATION", "CASTLE")
COLOURS = ("#b3261e", "#1b6e53", "#1f4e8c", "#8a5a12", "#5b3a86")

#: Turn about the post in degrees, height in metres and side of the post for each board.
PLACES_A = ((-38, 2.66, 1), (30, 2.28, -1), (-12, 1.9, 1), (36, 1.54, -1), (-44, 1.08, 1))
PLACES_B = ((-40, 1.85, -1), (14, 2.72, 1), (-26, 1.02, -1), (36, 2.28, 1), (8, 1.44, 1))

#: Where the eyes are: metres to the side, up, and away from the post.
EYE_A, EYE_B = (0.35, 1.75, 2.7), (-0.55, 1.95, 2.75)


def seen(points: Points, eye: tuple[float, float, float]) -> Points:
    """Pixels of points in space, (N, 3): x right, y up, z towards the eye."""
    away = eye[2] - points[:, 2]
    x = WIDTH / 2 + FOCAL * (points[:, 0] - eye[0]) / away + FOCAL * eye[0] / eye[2]
    y = HEIGHT / 2 - FOCAL * (points[:, 1] - 1.85) / away
    return np.stack([x, y], axis=1)


def corners(place: tuple[float, float, int], eye: tuple[float, float, float]) -> Points:
    """Corners of a board in pixels, from its upper left one clockwise."""
    turn, height, side = np.radians(place[0]), place[1], place[2]
    start, end = (-0.25, BOARD[0] - 0.25) if side > 0 else (0.25 - BOARD[0], 0.25)
    along = np.array([start, end, end, start])
    up = height + np.array([0.5, 0.5, -0.5, -0.5]) * BOARD[1]
    # Boards on the near side of the post, so that it hides none of them.
    return seen(np.stack([along * np.cos(turn), up, along * np.sin(turn) + 0.08], axis=1), eye)


def board(name: str, colour: str) -> Image.Image:
    """A board seen from the front."""
    width, height = (round(FLAT * part) for part in BOARD)
    flat = Image.new("RGBA", (width, height), "#f4efe2")
    draw = ImageDraw.Draw(flat)
    draw.rectangle((12, 12, width - 13, height - 13), fill=colour)
    draw.rectangle((26, 26, width - 27, height - 27), outline="#f4efe2", width=4)
    font = ImageFont.load_default(150)
    draw.text((60, height / 2), name, fill="white", font=font, anchor="lm")
    for k in range(6):  # a ladder of bars, whose spacing shows the perspective
        x = width - 330 + 48 * k
        draw.rectangle((x, 70, x + 18, height - 71), fill="#f4efe2")
    return flat


def backdrop(eye: tuple[float, float, float]) -> Image.Image:
    """Sky, hills and the post."""
    size = (FINE * WIDTH, FINE * HEIGHT)
    rows = np.linspace(0, 1, size[1])[:, None]
    sky = (1 - rows) * np.array([133, 178, 214]) + rows * np.array([226, 232, 222])
    scene = Image.fromarray(np.repeat(sky[:, None], size[0], axis=1).astype(np.uint8))
    draw = ImageDraw.Draw(scene)
    x = np.arange(size[0] + 1)
    shift = 260 * eye[0]
    for level, wave, height, colour in (
        (430, 210.0, 36, "#9db3a2"),
        (480, 150.0, 26, "#7f9d80"),
        (530, 310.0, 30, "#6b8b62"),
    ):
        y = FINE * (level + height * np.sin((x / FINE + shift * level / 500) / wave * 2))
        hill = [(0, size[1]), *zip(x.tolist(), y.tolist(), strict=True), (size[0], size[1])]
        draw.polygon(hill, fill=colour)
    post = seen(np.array([[-0.055, 3.2, 0], [0.055, 3.2, 0], [0.055, 0, 0], [-0.055, 0, 0]]), eye)
    draw.polygon([tuple(point) for point in (FINE * post).tolist()], fill="#5c4632")
    light = post[[0, 1, 2, 3]] * [[1, 1]] + np.array([[0, 0], [-12, 0], [-12, 0], [0, 0]])
    draw.polygon([tuple(point) for point in (FINE * light).tolist()], fill="#6f563f")
    return scene


def draw_boards(scene: Image.Image, quads: list[Points]) -> None:
    """Every board in its place."""
    for name, colour, quad in zip(NAMES, COLOURS, quads, strict=True):
        flat = board(name, colour)
        box = np.array([[0, 0], [flat.width, 0], [flat.width, flat.height], [0, flat.height]])
        back = quad_homographies(FINE * quad[None], box[None].astype(np.float64))[0]
        back = (back / back[2, 2]).ravel()[:8]
        warped = flat.transform(
            scene.size, Image.Transform.PERSPECTIVE, back.tolist(), Image.Resampling.BICUBIC
        )
        mask = Image.new("L", scene.size)
        ImageDraw.Draw(mask).polygon([tuple(p) for p in (FINE * quad).tolist()], fill=255)
        scene.paste(warped, (0, 0), mask)


def main() -> None:
    small = (WIDTH, HEIGHT)
    quads = {}
    for side, places, eye in (("a", PLACES_A, EYE_A), ("b", PLACES_B, EYE_B)):
        scene = backdrop(eye)
        if side == "a":
            scene.resize(small, Image.Resampling.BOX).save(
                INPUTS / "signpost-bare.png", optimize=True
            )
        quads[side] = [corners(place, eye) for place in places]
        draw_boards(scene, quads[side])
        scene.resize(small, Image.Resampling.BOX).save(
            INPUTS / f"signpost-{side}.png", optimize=True
        )
    boards = [
        {"id": name.lower().replace(" ", "-"), "a": a.round(2).tolist(), "b": b.round(2).tolist()}
        for name, a, b in zip(NAMES, quads["a"], quads["b"], strict=True)
    ]
    lines = ",\n  ".join(json.dumps(item) for item in boards)
    (INPUTS / "signpost.json").write_text(f'{{"quads": [\n  {lines}\n]}}\n', "utf-8")


if __name__ == "__main__":
    main()
