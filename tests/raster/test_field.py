"""Which triangle each pixel lies in, against scipy's own search, and what is shown there."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial import Delaunay

from shapetween.raster.field import Field, triangles_at
from shapetween.raster.picture import Picture

SIZE = (40, 60)


@given(st.integers(0, 2**32 - 1))
def test_every_pixel_lies_in_one_triangle(seed: int) -> None:
    """Corners lie on halves of pixels too, where many sides meet pixels' middles."""
    rng = np.random.default_rng(seed)
    inner = np.round(rng.uniform(0, [SIZE[1], SIZE[0]], (30, 2)) * 2) / 2
    edge = np.array([[-5.0, -5], [70, -5], [70, 50], [-5, 50]])
    mesh = Delaunay(np.unique(np.concatenate([edge, inner]), axis=0))
    index = triangles_at(mesh.points[mesh.simplices], *SIZE)
    assert (index >= 0).all()
    rows, columns = np.indices(SIZE)
    middles = np.stack([columns + 0.5, rows + 0.5], axis=-1)
    # Each pixel's middle is in its triangle, or on its side.
    to = mesh.transform[index]
    first = np.einsum("hwij,hwj->hwi", to[:, :, :2], middles - to[:, :, 2])
    weights = np.concatenate([first, 1 - first.sum(axis=-1, keepdims=True)], axis=-1)
    assert weights.min() > -1e-9


def test_beyond_the_frame_and_without_area() -> None:
    corners = np.array([[[-9.0, -9], [-2, -9], [-2, -1]], [[3, 3], [8, 8], [5, 5]]])
    assert (triangles_at(corners, *SIZE) == -1).all()


@pytest.fixture
def picture() -> Picture:
    values = np.random.default_rng(3).integers(0, 256, (*SIZE, 4), np.uint8)
    values[..., 3] = 255
    return Picture.of(values)


def test_a_picture_that_stands_is_shown_as_it_is(picture: Picture) -> None:
    square = np.array([[0.0, 0], [60, 0], [60, 40], [0, 40]])
    corners = square[[[0, 1, 2], [0, 2, 3]]]
    field = Field.of(corners, np.ones(SIZE, bool))
    assert field.colours(picture, corners).reshape(*SIZE, 4) == pytest.approx(picture.light)


def test_pixels_in_no_triangle_go_with_their_neighbours(picture: Picture) -> None:
    """The triangle's map goes on beyond its sides, so a gap of a fold does not show."""
    corners = np.array([[[0.0, 0], [60, 0], [0, 40]]])
    field = Field.of(corners, np.ones(SIZE, bool))
    assert len(field.triangle) == 40 * 60
    assert field.colours(picture, corners).reshape(*SIZE, 4) == pytest.approx(picture.light)


def test_a_shrunken_picture_is_averaged(picture: Picture) -> None:
    corners = np.array([[[0.0, 0], [240, 0], [0, 160]]])
    small = np.array([[[0.0, 0], [60 / 4, 0], [0, 40 / 4]]])
    field = Field.of(small, np.ones((5, 5), bool))
    shown = field.colours(picture, corners / 4)
    spread = picture.light[..., :3].astype(float).std()
    assert shown[:, :3].std() < spread / 2


def test_nothing_to_see(picture: Picture) -> None:
    field = Field.of(np.zeros((1, 3, 2)), np.zeros(SIZE, bool))
    assert field.colours(picture, np.zeros((1, 3, 2))).shape == (0, 4)
