"""Warped pictures beside OpenCV's, where it is installed."""

import numpy as np
import pytest

from shapetween.base.arrays import Mask, Points
from shapetween.geometry.homography import quad_homographies
from shapetween.raster.light import FULL, Shares, encode
from shapetween.raster.picture import Picture
from tests.photo.scenes import psnr, shown

cv2 = pytest.importorskip("cv2")

WIDTH, HEIGHT = 320, 240
BOX = np.array([[0.0, 0.0], [WIDTH, 0.0], [WIDTH, HEIGHT], [0.0, HEIGHT]])


def scene() -> Picture:
    """Waves that grow finer towards the right."""
    y, x = np.mgrid[:HEIGHT, :WIDTH] / WIDTH
    waves = [np.sin(60 * x * x + 20 * y + k) for k in range(3)]
    return Picture.of(np.rint(127.5 + 120 * np.stack(waves, axis=-1)).astype(np.uint8))


def light_of(picture: Picture) -> Shares:
    return np.asarray(picture.light.astype(np.float32) * np.float32(1 / FULL))


def core(places: Points) -> Mask:
    """Pixels inside a quad by four pixels."""
    mask = np.zeros((HEIGHT, WIDTH), np.uint8)
    cv2.fillConvexPoly(mask, np.rint(places).astype(np.int32), 1)
    return np.asarray(cv2.erode(mask, np.ones((9, 9))) > 0)


def test_values_are_opencvs_where_nothing_shrinks() -> None:
    picture = scene()
    places = np.array([[10.0, 5.0], [314.0, 14.0], [309.0, 233.0], [4.0, 220.0]])
    matrix = quad_homographies(BOX[None], places[None])[0]
    # OpenCV counts from the middle of the first pixel.
    half = np.array([[1.0, 0, -0.5], [0, 1, -0.5], [0, 0, 1]])
    warped = cv2.warpPerspective(
        light_of(picture), half @ matrix @ np.linalg.inv(half), (WIDTH, HEIGHT)
    )
    inside = core(places)
    ours, theirs = shown(picture, BOX, places), encode(warped, opaque=True)
    assert np.abs(ours[inside].astype(int) - theirs[inside]).max() <= 1


def test_nearer_to_the_mean_over_each_pixel_where_it_shrinks() -> None:
    """OpenCV takes one sample a pixel; the truth is the mean over the pixel."""
    picture = scene()
    places = np.array([[60.0, 50.0], [190.0, 80.0], [180.0, 160.0], [70.0, 190.0]])
    back = quad_homographies(places[None], BOX[None])[0]
    y, x = np.mgrid[:HEIGHT, :WIDTH].astype(np.float64)
    light, total = light_of(picture), np.zeros((HEIGHT, WIDTH, 4), np.float32)
    steps = (np.arange(8) + 0.5) / 8
    for dx in steps:
        for dy in steps:
            u, v, w = np.moveaxis(np.stack([x + dx, y + dy, np.ones_like(x)], -1) @ back.T, -1, 0)
            maps = ((part / w - 0.5).astype(np.float32) for part in (u, v))
            total += cv2.remap(light, *maps, cv2.INTER_LINEAR) / 64
            if dx == dy == steps[4]:
                once = cv2.remap(
                    light,
                    (u / w - 0.5).astype(np.float32),
                    (v / w - 0.5).astype(np.float32),
                    cv2.INTER_LINEAR,
                )
    truth, inside = encode(total, opaque=True), core(places)
    ours = psnr(shown(picture, BOX, places), truth, inside)
    assert ours > 44
    assert ours > psnr(encode(once, opaque=True), truth, inside) + 5
