"""Meshes of real drawings: few quads, valid ones, and little left out."""

import json
from pathlib import Path

import numpy as np
import pytest
import shapely

from shapetween.match import correspond
from shapetween.mesh import mesh_matched
from shapetween.mesh.quality import face_figures
from shapetween.model.arclength import ArcLength
from shapetween.model.outline import Outline
from shapetween.outline.matched import MatchedOutlines
from shapetween.svg.read.reader import read_svg
from tests.mesh.pairs import Pair, assert_valid

EVERY = 5  # of 43 pairs; all of them take half a minute


def outline(file: Path) -> Outline:
    ring = read_svg(file.read_bytes(), file.name).shapes[0].rings[0]
    return ring if ring.area > 0 else ring.reversed()


@pytest.fixture(scope="module")
def pairs(corpus: Path) -> list[Pair]:
    found = []
    records = json.loads((corpus / "pairs.json").read_text())
    single = [r for r in records if r["category"] in ("silhouette", "articulated")]
    for record in single[::EVERY]:
        a, b = outline(corpus / record["a"]), outline(corpus / record["b"])
        matching = correspond(a, b)
        samples = MatchedOutlines(ArcLength(a), ArcLength(b), matching.u, matching.v).samples(512)
        found.append((samples.source, samples.target, samples.joints))
    return found


def test_real_pairs_are_covered_by_few_quads_that_move_well(pairs: list[Pair]) -> None:
    usable, counts, covered = [], [], []
    for source, target, corners in pairs:
        mesh = mesh_matched(source, target, corners)
        assert_valid(mesh, source, target)
        both = np.stack([mesh.pair.source, mesh.pair.target])[:, mesh.pair.quads]
        good = face_figures(both).usable
        usable += good.tolist()
        counts.append(len(good))
        for quads, points in zip(both, (source, target), strict=True):
            shape = shapely.Polygon(points).buffer(0)
            inside = shapely.union_all(shapely.polygons(quads[good])).intersection(shape)
            covered.append(inside.area / shape.area)
    assert np.mean(usable) >= 0.95
    assert np.median(counts) <= 18
    assert np.median(covered) >= 0.9
    assert np.mean(covered) >= 0.85
