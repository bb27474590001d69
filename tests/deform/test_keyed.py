"""Motions by a few solved times: what they keep exactly, and how near they come to the rest."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from shapetween.base.arrays import Floats
from shapetween.deform.keyed import KeyedMotion
from shapetween.deform.mesh import ambient_mesh
from shapetween.deform.motion import AmbientMotion
from tests.deform.shapes import blob, bowed_strip
from tests.strategies import affine_maps

KEYS = np.linspace(0, 1, 21)


@settings(max_examples=10)
@given(affine_maps(), st.integers(0, 10**6))
def test_between_the_keys_of_an_affine_image_all_is_exact(affine: Floats, seed: int) -> None:
    source = blob(seed, 12)
    mesh = ambient_mesh(source, source @ affine[:, :2].T + affine[:, 2])
    t = np.array([0.0, 0.33, 0.512, 1.0])
    solver = AmbientMotion.prepare(mesh)
    moved = KeyedMotion.of(mesh, solver.posed(KEYS)).vertices(t)
    np.testing.assert_allclose(moved, solver.vertices(t), atol=1e-9 * np.ptp(moved))
    np.testing.assert_array_equal(moved[0], mesh.source)
    np.testing.assert_array_equal(moved[3], mesh.target)


def test_a_bending_strip_is_followed_between_the_keys() -> None:
    mesh = ambient_mesh(bowed_strip(-3.0), bowed_strip(3.0))
    solver = AmbientMotion.prepare(mesh)
    motion = KeyedMotion.of(mesh, solver.posed(KEYS))
    t = np.linspace(0, 1, 161)
    want = solver.vertices(t)[:, : mesh.nodes]
    np.testing.assert_allclose(motion.nodes(t), want, atol=1e-3)
    np.testing.assert_allclose(motion.nodes(KEYS), want[::8], atol=1e-12)


def test_the_first_vertices_are_the_nodes() -> None:
    mesh = ambient_mesh(bowed_strip(-1.0), bowed_strip(1.0))
    motion = KeyedMotion.of(mesh, AmbientMotion.prepare(mesh).posed(KEYS))
    t = np.linspace(0, 1, 7)
    np.testing.assert_allclose(motion.nodes(t), motion.vertices(t)[:, : mesh.nodes], atol=1e-15)
