"""Seconds to mesh a matched pair of 512 samples; run with ``--benchmark-enable``."""

import pytest
from pytest_benchmark.fixture import BenchmarkFixture

from shapetween.mesh import mesh_matched
from tests.mesh.pairs import comb, matched, regular, spiral, star

PAIRS = {
    "square-disc": (regular(4), regular(90)),
    "star-disc": (star(6, 0.5), regular(90)),
    "star-comb": (star(6, 0.5), comb(5)),
    "spiral-disc": (spiral(), regular(90)),
    "spiral-comb": (spiral(), comb(9)),
}


@pytest.mark.parametrize("name", PAIRS)
def test_mesh(benchmark: BenchmarkFixture, name: str) -> None:
    source, target, corners = matched(*PAIRS[name], 512, 0.05)
    mesh = benchmark(mesh_matched, source, target, corners)
    assert len(mesh.nodes) >= 4
