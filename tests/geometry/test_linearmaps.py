"""Linear maps as two complex numbers do as their matrices do."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from shapetween.base.arrays import Floats
from shapetween.geometry.linearmaps import LinearMaps, as_complex, as_points
from shapetween.geometry.rotation import linear_between, polar
from tests.strategies import affine_maps

VECTORS = np.array([[1.0, 0.0], [0.0, 1.0], [-2.0, 0.7]])


@given(affine_maps(), affine_maps())
def test_maps_do_as_their_matrices_do(first: Floats, second: Floats) -> None:
    p, q = first[:, :2], second[:, :2]
    maps = LinearMaps.of(np.stack([p, q]))
    scale = float(np.abs([p, q]).max())
    np.testing.assert_allclose(maps.matrices, [p, q], atol=1e-14 * scale)
    moved = as_points(maps[0](as_complex(VECTORS)))
    np.testing.assert_allclose(moved, VECTORS @ p.T, atol=1e-12 * scale)
    np.testing.assert_allclose(maps[1].after(maps[0]).matrices, q @ p, atol=1e-12 * scale**2)
    np.testing.assert_allclose(maps.determinants, np.linalg.det([p, q]), atol=1e-12 * scale**2)
    np.testing.assert_allclose(maps.squares, (np.stack([p, q]) ** 2).sum((1, 2)))
    back = maps[0].inverse().after(maps[0]).matrices
    np.testing.assert_allclose(back, np.eye(2), atol=1e-8)


@given(affine_maps(), st.floats(0, 1))
def test_the_way_there_is_that_of_the_polar_decomposition(affine: Floats, t: float) -> None:
    angles, stretches = polar(affine[None, :, :2])
    maps = LinearMaps.of(affine[None, :, :2])
    np.testing.assert_allclose(maps.angles, angles, atol=1e-9)
    moments = np.array([t])
    want = linear_between(angles, stretches, moments)
    scale = float(np.abs(affine).max()) + 1
    found = maps.between(maps.angles, moments).matrices
    np.testing.assert_allclose(found, want, atol=1e-9 * scale)
