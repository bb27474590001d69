"""Draw an apple and a pear as pictures, and their outlines as drawings to lay over them.

Writes ``fruit-apple.jpg``, ``fruit-pear.jpg``, the table alone ``fruit-table.jpg``,
``fruit-apple.svg`` and ``fruit-pear.svg`` into ``inputs``.
"""

from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw

from shapetween.base.arrays import Curves, Floats, Points
from shapetween.geometry import bezier

INPUTS = Path(__file__).parent / "inputs"

SIZE = 420

#: How much finer the outlines are filled before they are made smaller.
FINE = 4

#: Handles and ends of the right half of each fruit, from its stalk down to its foot; the left
#: half mirrors it.
APPLE = [(210, 128), (245, 95), (350, 100), (352, 205), (354, 300), (285, 365), (210, 348)]
PEAR = [(210, 62), (262, 62), (262, 140), (286, 195), (330, 275), (300, 372), (210, 368)]

LIGHT = np.array([-0.45, -0.6, 0.66])


def outline(half: list[tuple[int, int]]) -> Curves:
    """Four cubic curves around a fruit, clockwise from its stalk."""
    right = np.array([half[0:4], half[3:7]], np.float64)
    left = (right * (-1, 1) + (SIZE, 0))[::-1, ::-1]
    return np.concatenate([right, left])


def flat(curves: Curves) -> Points:
    return np.asarray(bezier.flatten(curves, 60))


def skin(kind: str, height: Floats, x: Floats, y: Floats) -> Floats:
    """Colours of a fruit's skin, sRGB from 0 to 255."""
    if kind == "apple":
        stripes = 0.5 + 0.5 * np.sin((x - SIZE / 2) / (14 + 30 * np.sqrt(np.maximum(height, 0))))
        fading = np.clip((330 - y) / 150, 0, 1)
        red, yellow = np.array([186, 32, 38]), np.array([232, 150, 60])
        return np.asarray(red + (0.45 * stripes * fading)[..., None] * (yellow - red))
    rng = np.random.default_rng(8)
    green, brown = np.array([176, 186, 62]), np.array([150, 112, 50])
    freckles = np.zeros((SIZE, SIZE))
    for px, py, r in zip(*rng.uniform(60, 370, (2, 260)), rng.uniform(0.8, 2.2, 260), strict=True):
        freckles = np.maximum(freckles, np.clip(r + 0.5 - np.hypot(x - px, y - py), 0, 1))
    blush = np.clip((x - 230) / 120, 0, 1) * 0.5
    return np.asarray(green + np.maximum(freckles * 0.7, blush)[..., None] * (brown - green))


def table() -> Floats:
    """A table before a wall, without a fruit, sRGB from 0 to 255."""
    y, x = np.mgrid[:SIZE, :SIZE] + 0.5
    wall = np.array([205, 198, 186]) - 22 * (y / SIZE)[..., None]
    wood = np.array([136, 100, 70]) + 8 * np.sin(y * 1.7 + 3 * np.sin(x / 60))[..., None]
    shadow = np.exp(-(((x - 226) / 120) ** 2 + ((y - 362) / 20) ** 2))
    return np.asarray(np.where((y > 300)[..., None], wood * (1 - 0.55 * shadow)[..., None], wall))


def picture(kind: str, curves: Curves) -> Image.Image:
    """A fruit on the table."""
    from scipy.ndimage import distance_transform_edt, gaussian_filter

    y, x = np.mgrid[:SIZE, :SIZE] + 0.5
    large = Image.new("L", (FINE * SIZE, FINE * SIZE))
    ImageDraw.Draw(large).polygon([tuple(p) for p in (FINE * flat(curves)).tolist()], fill=255)
    mask = np.asarray(large.resize((SIZE, SIZE), Image.Resampling.BOX), np.float64) / 255
    inside = distance_transform_edt(mask > 0.5)
    round_ = np.minimum(inside / 130, 1)
    height = gaussian_filter(np.sqrt(1 - (1 - round_) ** 2) * 130, 16)
    down, across = np.gradient(height)
    normal = np.stack([-across, -down, np.ones_like(height)], axis=-1)
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
    shade = np.clip(normal @ LIGHT, 0, 1)
    half_way = LIGHT + np.array([0, 0, 1])
    glint = np.clip(normal @ half_way / np.linalg.norm(half_way), 0, 1) ** 60
    fruit = skin(kind, height / 130, x, y) * (0.35 + 0.75 * shade)[..., None]
    fruit += 170 * glint[..., None]
    scene = table() * (1 - mask[..., None]) + np.clip(fruit, 0, 255) * mask[..., None]
    return Image.fromarray(np.clip(scene, 0, 255).astype(np.uint8))


def main() -> None:
    Image.fromarray(table().astype(np.uint8)).save(INPUTS / "fruit-table.jpg", quality=88)
    for kind, half in (("apple", APPLE), ("pear", PEAR)):
        curves = outline(half)
        picture(kind, curves).save(INPUTS / f"fruit-{kind}.jpg", quality=88)
        d = f"M{half[0][0]} {half[0][1]}" + "".join(
            "C" + " ".join(f"{value:g}" for value in curve[1:].ravel().tolist()) for curve in curves
        )
        (INPUTS / f"fruit-{kind}.svg").write_text(
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {SIZE} {SIZE}">\n'
            f'  <path id="fruit" fill="none" stroke="#d33" d="{d}Z"/>\n</svg>\n',
            "utf-8",
        )


if __name__ == "__main__":
    main()
