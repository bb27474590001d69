"""Where the limits of meshes lie: each case is looked at over a range across its limit."""

import tracemalloc
from types import SimpleNamespace
from typing import Any

import numpy as np

from shapetween.base.errors import MeshError
from shapetween.mesh.candidates import simplified
from shapetween.mesh.contour import Contours, outside_lengths
from shapetween.mesh.file import _check_boundary, check_mesh
from shapetween.mesh.inner import smoothed
from shapetween.mesh.matched import _with_about
from shapetween.mesh.pair import MeshPair
from shapetween.mesh.repair import _dissected, mesh_polygon
from shapetween.mesh.simple import _strict, inner_diagonals
from shapetween.mesh.slide import slid
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


def test_which_faces_a_polygon_is_cut_into_is_known() -> None:
    """By their prices: quads, triangles and how sharp the triangles are."""
    figures = np.zeros(3)
    for seed in range(24):
        rng = np.random.default_rng(seed)
        angle = 2 * np.pi * (np.arange(9) + rng.uniform(-0.3, 0.3, (2, 9))) / 9
        around = np.stack([np.cos(angle), np.sin(angle)], axis=-1)
        found = mesh_polygon(around * rng.uniform(0.55, 1.3, (2, 9))[..., None])
        places = found.triangles.sum() + 1.7 * found.quads.sum()
        figures += [len(found.quads), len(found.triangles), (seed + 1) * places]
    assert_known("mesh", "faces of polygons", figures.tolist())


def test_how_many_quads_are_tried_on_one_polygon_is_known() -> None:
    whole = []
    for count in range(20, 64, 2):
        angle = 2 * np.pi * np.arange(count) / count
        disc = np.stack([np.cos(angle), np.sin(angle)], axis=-1)
        rings = np.stack([disc, 2 * disc])
        whole.append(_dissected(rings, inner_diagonals(rings[0])) is not None)
    assert_known("mesh", "quads on a polygon", [sum(whole)])


def test_between_which_prices_a_number_of_quads_is_sought_is_known() -> None:
    tried: list[float] = []

    class Search:
        """Fewer quads the more each costs."""

        def cheapest(self, price: float) -> Any:
            tried.append(price)
            return SimpleNamespace(quads=range(int(200 / (1 + price))))

    counts = [len(_with_about(Search(), quads).quads) for quads in (1, 4, 5, 7, 60, 199)]  # type: ignore[arg-type]
    assert_known("mesh", "prices of quads", [*map(float, counts), float(len(tried)), sum(tried)])


def test_how_large_a_mesh_is_smoothed_is_known() -> None:
    smooth = []
    for rows in (10, 20, 23, 24, 28, 34, 35, 40):
        width = 25
        places = np.stack(np.meshgrid(np.arange(width), np.arange(rows)), axis=-1).reshape(-1, 2)
        points = np.stack([places + 0.3 * np.sin(7.0 * places[:, ::-1])] * 2)
        corner = np.arange(rows * width).reshape(rows, width)[:-1, :-1].ravel()
        quads = corner[:, None] + [0, 1, width + 1, width]
        smooth.append(smoothed(points, 2, [quads.astype(np.intp)]) is not points)
    assert_known("mesh", "smoothed", [sum(smooth)])


def test_what_is_in_line_is_known() -> None:
    turns = np.geomspace(1e-13, 1e-11, 60)
    assert_known("mesh", "in line", [float((_strict(turns, SQUARE) == 0).sum())])


def test_how_far_nodes_slide_is_known() -> None:
    """A limb, the longer the more sweeps it takes, with one rung across from end to end."""
    figures: list[float] = []
    for long in (6.0, 40.0, 200.0):
        limb = np.array([[0.0, 0.0], [long, 0], [long, 1], [0, 1]])
        source, target, corners = matched(limb, limb, 900)
        points = np.stack([source, target]) / np.sqrt(long)
        ends = np.flatnonzero(corners)
        side = int(ends[1] - ends[0])
        for first, second in ((0.05, 0.05), (0.3, 0.1), (0.45, 0.4)):
            rung = [int(ends[0]) + int(first * side), int(ends[2]) + int(second * side)]
            nodes = np.sort(np.append(ends, rung))
            quads = np.array([[0, 1, 4, 5], [1, 2, 3, 4]])
            triangles = np.zeros((0, 3), np.intp)
            moved = slid(Contours.of(points), np.where(corners, 0.5, 0.0), nodes, quads, triangles)
            figures += [float(moved.sum()), float((moved * np.arange(6)).sum())]
    assert_known("mesh", "slid", figures)


def test_how_much_further_corners_count_is_known() -> None:
    figures = []
    for seed in range(12):
        rng = np.random.default_rng(seed)
        angle = 2 * np.pi * np.arange(120) / 120
        size = 1 + (np.cos(np.outer(angle, np.arange(1, 7))) @ rng.normal(size=(6, 2)) * 0.12).T
        around = np.stack([np.cos(angle), np.sin(angle)], axis=-1)
        corners = rng.random(120) < 0.3
        found = simplified(around * size[..., None], corners, 14)
        figures += [float(corners[found].sum()), float(found.sum())]
    assert_known("mesh", "corners", figures)
