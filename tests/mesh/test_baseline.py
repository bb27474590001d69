"""Meshes of matched outlines, in figures that are known."""

import numpy as np
import pytest

from shapetween.geometry.polygon import polygon_area
from shapetween.mesh import mesh_matched
from tests.baseline import assert_known
from tests.mesh.pairs import Pair, comb, matched, regular, spiral, star, untangled

CASES: dict[str, Pair] = {
    "a star and a comb": matched(star(5, 0.5), comb(3), 256, 0.1),
    "a spiral and a disc": matched(spiral(1.5), regular(40), 256),
    "a comb and a star": matched(comb(5), star(9, 0.4), 256, 0.3),
    "random and random": matched(
        untangled(np.random.default_rng(1), 12), untangled(np.random.default_rng(4), 15), 200
    ),
    "random and star": matched(untangled(np.random.default_rng(7), 20), star(6, 0.6), 300, 0.2),
    "a long spiral and a disc": matched(spiral(3), regular(40), 512),
    "a spiral and a slender star": matched(spiral(4), star(9, 0.2), 600, 0.3),
    "a star of many tips": matched(star(40, 0.1), regular(9), 512),
    "many teeth and many tips": matched(comb(12), star(30, 0.2), 600, 0.3),
    "random and random, of many corners": matched(
        untangled(np.random.default_rng(5), 45), untangled(np.random.default_rng(6), 50), 512, 0.2
    ),
}


@pytest.mark.parametrize("quads", [None, 14])
@pytest.mark.parametrize("case", CASES)
def test_the_mesh_is_known(case: str, quads: int | None) -> None:
    mesh = mesh_matched(*CASES[case], quads=quads)
    pair = mesh.pair
    areas = [polygon_area(p[pair.quads]) for p in (pair.source, pair.target)]
    figures = [
        len(mesh.nodes),
        len(pair.quads),
        len(pair.triangles),
        ("search", "repaired", "overlay").index(mesh.level),
        mesh.sine,
        mesh.perspective,
        *mesh.left_out,
        *(float((own**2).sum()) for own in areas),
        *pair.source.mean(axis=0).tolist(),
        *pair.target.mean(axis=0).tolist(),
    ]
    assert_known("mesh", f"{case}, {quads or 'few'} quads", figures)
