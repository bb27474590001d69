"""Where the limits of meshes lie: each case is looked at over a range across its limit."""

import tracemalloc

import numpy as np

from shapetween.base.errors import MeshError
from shapetween.mesh.contour import outside_lengths
from shapetween.mesh.file import _check_boundary, check_mesh
from shapetween.mesh.pair import MeshPair
from tests.baseline import assert_known
from tests.mesh.pairs import comb, matched, star

SQUARE = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])


def test_how_far_from_its_outline_a_mesh_may_lie_is_known() -> None:
    refused = 0
    for off in np.geomspace(1e-3, 0.1, 60):
        try:
            _check_boundary("a", SQUARE + np.array([off, 0.0]), np.arange(4), SQUARE)
        except MeshError:
            refused += 1
    assert_known("mesh", "off its outline", [refused])


def test_how_sharp_a_corner_of_a_quad_may_be_is_known() -> None:
    refused = 0
    for height in np.geomspace(1e-8, 1e-4, 60):
        flat = SQUARE * [1.0, 1.0]
        flat[2] = [1.0 + height, height]
        flat[3] = [-1.0, 2 * height]
        try:
            check_mesh(MeshPair(flat, SQUARE, np.array([[0, 1, 2, 3]])), flat, SQUARE)
        except MeshError:
            refused += 1
    assert_known("mesh", "sharp corners", [refused])


def test_chords_are_tested_against_samples_in_parts() -> None:
    source, _, _ = matched(comb(9), star(30, 0.2), 600, 0.3)
    points = np.stack([source, source])
    nodes = np.arange(0, 600, 4)
    outside_lengths(points, nodes, 1.0)
    tracemalloc.start()
    found = outside_lengths(points, nodes, 1.0)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert_known("mesh", "chords", [round(peak / 1e6), float(found[np.isfinite(found)].sum())])
