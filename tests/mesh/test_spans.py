import numpy as np
import pytest

from shapetween.mesh.dissection import joined_chains, linked_chains
from shapetween.mesh.quality import FaceFigures, face_figures
from shapetween.mesh.spans import Chains, Spans

NODES = 16


def chains_of_random_nodes(seed: int, least: float) -> Chains:
    points = np.random.default_rng(seed).normal(size=(2, NODES, 2))
    points[:, 5] = points[:, 4]  # two nodes on one place
    links = np.triu(np.ones((NODES, NODES), dtype=bool), 1)
    return Chains.of(Spans.of(points), linked_chains(links), least)


def assert_alike(figures: FaceFigures, expected: FaceFigures) -> None:
    np.testing.assert_allclose(figures.sine, expected.sine, atol=1e-12)
    np.testing.assert_allclose(figures.area, expected.area, atol=1e-12)
    np.testing.assert_allclose(figures.misfit, expected.misfit, atol=1e-12)
    np.testing.assert_allclose(figures.perspective, expected.perspective, rtol=1e-6)


@pytest.mark.parametrize("least", [-np.inf, 0.05])
@pytest.mark.parametrize("seed", range(3))
def test_figures_are_those_of_the_faces_alone(seed: int, least: float) -> None:
    points = np.random.default_rng(seed).normal(size=(2, NODES, 2))
    points[:, 5] = points[:, 4]
    chains = chains_of_random_nodes(seed, least)
    first, second = joined_chains(chains.nodes, np.ones((NODES, NODES), dtype=bool))
    quads = np.stack([*chains.nodes[:, first], chains.nodes[2, second]])
    expected = face_figures(points[:, quads.T])
    assert len(first) > 20
    assert (expected.sine > 0).any()
    assert_alike(chains.quad_figures(first, second), expected)
    triangles = np.arange(0, chains.nodes.shape[1], 2)
    expected = face_figures(points[:, chains.nodes[:, triangles].T])
    assert_alike(chains.triangle_figures(triangles), expected)


def test_chains_that_bend_too_little_are_left_out() -> None:
    everything, bent = (chains_of_random_nodes(0, least) for least in (-np.inf, 0.3))
    assert everything.nodes.shape[1] == NODES * (NODES - 1) * (NODES - 2) // 6
    np.testing.assert_array_equal(bent.nodes, everything.nodes[:, everything.sine >= 0.3])
    assert 0 < bent.nodes.shape[1] < everything.nodes.shape[1]


def test_chains_among_some_nodes_are_those_measured_there() -> None:
    points = np.random.default_rng(0).normal(size=(2, NODES, 2))
    kept = np.random.default_rng(1).random(NODES) < 0.6
    links = np.triu(np.ones((NODES, NODES), dtype=bool), 1)
    thinned = Chains.of(Spans.of(points), linked_chains(links), 0.05).among(kept)
    few = links[np.ix_(kept, kept)]
    alone = Chains.of(Spans.of(points[:, kept]), linked_chains(few), 0.05)
    np.testing.assert_array_equal(thinned.nodes, alone.nodes)
    chains = joined_chains(alone.nodes, few)
    assert len(chains[0]) > 0
    assert_alike(thinned.quad_figures(*chains), alone.quad_figures(*chains))
