"""Straight lines."""

import numpy as np

from shapetween.interpolate.linear import Linear
from shapetween.mesh.pair import MeshPair
from tests.strategies import grid


def test_every_vertex_goes_straight() -> None:
    vertices, quads = grid(2, 2)
    target = np.array([5.0, -1.0]) + vertices[::-1]
    frames = Linear(MeshPair(vertices, target, quads)).vertices([0.25, 0.5])
    np.testing.assert_allclose(frames[0], 0.75 * vertices + 0.25 * target, atol=1e-15)
    np.testing.assert_allclose(frames[1], np.full_like(vertices, [3.5, 0.5]), atol=1e-15)
