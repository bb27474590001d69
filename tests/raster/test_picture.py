from itertools import pairwise

import numpy as np
import pytest
from scipy.ndimage import map_coordinates

from shapetween.base.errors import ShapeError
from shapetween.raster.light import FULL, Bytes
from shapetween.raster.picture import Picture, colours_at

RNG = np.random.default_rng(7)


def noise(width: int, height: int, channels: int = 4) -> Bytes:
    return RNG.integers(0, 256, (height, width, channels), dtype=np.uint8)


@pytest.mark.parametrize("size", [(9, 7), (1, 5), (6, 1), (1, 1)])
def test_colours_are_on_straight_lines_between_pixels(size: tuple[int, int]) -> None:
    picture = Picture.of(noise(*size))
    x, y = RNG.uniform(-3, 12, 400), RNG.uniform(-3, 12, 400)
    found = colours_at(picture.levels[0], x, y)
    for channel in range(4):
        values = picture.light[..., channel].astype(np.float64)
        expected = map_coordinates(values, [y - 0.5, x - 0.5], order=1, mode="nearest")
        assert np.abs(found[:, channel] - expected).max() < 0.1


@pytest.mark.parametrize("size", [(8, 8), (5, 3), (1, 7)])
def test_halved_copies_go_down_to_one_pixel(size: tuple[int, int]) -> None:
    levels = Picture.of(noise(*size)).levels
    assert levels[-1].shape == (1, 1)
    for fine, coarse in pairwise(levels):
        assert coarse.shape == tuple((n + 1) // 2 for n in fine.shape)


def test_a_halved_copy_holds_as_much_light() -> None:
    picture = Picture.of(noise(16, 8))
    last = picture.levels[3][..., None].view(np.uint16).mean(axis=(0, 1))
    assert np.abs(last - picture.light.mean(axis=(0, 1))).max() < 2


def test_what_is_clear_adds_no_colour() -> None:
    """Green that nobody sees must not tint what is averaged with it."""
    pixels = np.array([[[255, 0, 0, 255], [0, 255, 0, 0]]], np.uint8)
    half = Picture.of(pixels).levels[1][..., None].view(np.uint16)[0, 0]
    assert half.tolist() == [(FULL + 1) // 2, 0, 0, (FULL + 1) // 2]


def test_opaque_is_known() -> None:
    assert Picture.of(noise(3, 3, 3)).opaque
    assert not Picture.of(noise(3, 3)).opaque


@pytest.mark.parametrize("shape", [(0, 3, 3), (3, 3), (3, 3, 2)])
def test_no_picture(shape: tuple[int, ...]) -> None:
    with pytest.raises(ShapeError, match="expected pixels of shape"):
        Picture.of(np.zeros(shape, np.uint8))
