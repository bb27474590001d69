import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from shapetween.model.srgb import srgb_to_linear
from shapetween.raster.light import FULL, decode, encode


def test_every_opaque_value_comes_back() -> None:
    values = np.arange(256, dtype=np.uint8).reshape(16, 16, 1)
    pixels = np.concatenate([values, 255 - values, values, np.full_like(values, 255)], axis=2)
    light = decode(pixels)
    assert (
        encode(light.astype(np.float32) * np.float32(1 / FULL), opaque=True) == pixels[..., :3]
    ).all()


@given(st.integers(8, 255), st.integers(0, 255))
def test_colour_survives_alpha(alpha: int, value: int) -> None:
    pixel = np.array([[[value, 255, 0, alpha]]], np.uint8)
    back = encode(decode(pixel).astype(np.float32) * np.float32(1 / FULL), opaque=False)
    assert back[0, 0, 3] == alpha
    # The fainter a pixel, the fewer of its 16 bits are left for its colour.
    found, wanted = srgb_to_linear(np.array([back[0, 0, 0], value]) / 255)
    assert abs(found - wanted) <= 0.003 + 1 / alpha / 255


def test_mixing_is_of_light() -> None:
    black_and_white = np.array([[[0, 0, 0, 255], [255, 255, 255, 255]]], np.uint8)
    mean = decode(black_and_white).astype(np.float32).mean(axis=1, keepdims=True) / FULL
    # Half the light is 188 of 255, not 128.
    assert encode(mean.astype(np.float32), opaque=True).tolist() == [[[188, 188, 188]]]


def test_a_gamma_of_its_own() -> None:
    grey = np.full((1, 1, 4), (128, 128, 128, 255), np.uint8)
    assert abs(decode(grey, gamma=1.0)[0, 0, 0] / FULL - 128 / 255) < 1e-4


def test_nothing_is_clear() -> None:
    assert encode(np.zeros((2, 3, 4), np.float32), opaque=False).tolist() == [[[0] * 4] * 3] * 2
