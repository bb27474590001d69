from functools import cache
from itertools import combinations, pairwise

import numpy as np
import pytest

from shapetween.base.arrays import Floats, Index, Mask
from shapetween.mesh.dissection import dissect, joined_chains, linked_chains

Faces = tuple[Index, Floats]


def all_faces(links: Mask, lids: Mask) -> tuple[Index, Index]:
    chains = linked_chains(links)
    first, second = joined_chains(chains, lids)
    np.testing.assert_array_equal(chains[1:, first], chains[:2, second])
    quads = np.stack([*chains[:, first], chains[2, second]], axis=1)
    assert quads.tolist() == [
        [a, b, c, d]
        for a, b, c, d in combinations(range(len(links)), 4)
        if links[a, b] and links[b, c] and links[c, d] and lids[a, d]
    ]
    return quads, chains[:, lids[chains[0], chains[2]]].T


def random_problem(seed: int, count: int) -> tuple[Floats, Floats, Floats, Faces, Faces]:
    rng = np.random.default_rng(seed)

    def prices(chance: float, *shape: int) -> Floats:
        return np.where(rng.random(shape) < chance, rng.random(shape), np.inf)

    sides, chords, closing = (
        prices(0.5, count, count),
        prices(0.6, count, count),
        prices(0.6, count),
    )
    closing[-1] = np.inf
    links: Mask = np.isfinite(sides) | np.isfinite(chords)
    lids = np.isfinite(chords)
    lids[:, -1] |= np.isfinite(closing)
    quads, triangles = all_faces(links, lids)
    return (
        sides,
        chords,
        closing,
        (quads, rng.random(len(quads))),
        (
            triangles,
            0.8 + rng.random(len(triangles)),
        ),
    )


def least_cost(
    sides: Floats, chords: Floats, closing: Floats, quads: Faces, triangles: Faces
) -> float:
    """The recurrence as it is written, one face at a time."""
    count = len(sides)
    faces = [
        (tuple(face), cost)
        for group in (quads, triangles)
        for face, cost in zip(group[0].tolist(), group[1].tolist(), strict=True)
    ]

    @cache
    def link(i: int, j: int) -> float:
        return float(min(sides[i, j], chords[i, j] + inner(i, j)))

    @cache
    def inner(i: int, j: int) -> float:
        found = [np.inf]
        for face, cost in faces:
            if (face[0], face[-1]) == (i, j):
                pairs = pairwise(face)
                found.append(cost + sum(link(a, b) for a, b in pairs))
        return min(found)

    return float(min(closing[k] + inner(k, count - 1) for k in range(count - 1)))


@pytest.mark.parametrize("seed", range(12))
def test_the_dissection_is_the_cheapest(seed: int) -> None:
    sides, chords, closing, quads, triangles = random_problem(seed, 9)
    found = dissect(sides, chords, closing, quads, triangles)
    expected = least_cost(sides, chords, closing, quads, triangles)
    assert found.cost == pytest.approx(expected)
    if not np.isfinite(expected):
        return
    price = {
        tuple(face): cost
        for group in (quads, triangles)
        for face, cost in zip(group[0].tolist(), group[1].tolist(), strict=True)
    }
    faces = [tuple(face) for face in [*found.quads.tolist(), *found.triangles.tolist()]]
    lids = {(face[0], face[-1]) for face in faces}
    total = sum(price[face] for face in faces)
    root = next(
        lid for lid in lids if lid[1] == 8 and not any(a < lid[0] for a, b in lids if b == 8)
    )
    total += closing[root[0]] + sum(chords[lid] for lid in lids - {root})
    edges = {(a, b) for face in faces for a, b in pairwise(face)}
    total += sum(sides[edge] for edge in edges - lids)
    assert total == pytest.approx(expected)


def test_where_nothing_fits_there_are_no_faces() -> None:
    nothing = np.full((5, 5), np.inf)
    none = np.zeros((0, 4), np.intp), np.zeros(0)
    found = dissect(nothing, nothing, nothing[0], none, (np.zeros((0, 3), np.intp), np.zeros(0)))
    assert found.cost == np.inf
    assert len(found.quads) == len(found.triangles) == 0


def test_all_faces_of_a_complete_graph_are_found() -> None:
    everything = np.triu(np.ones((7, 7), dtype=bool), 1)
    quads, triangles = all_faces(everything, everything)
    assert len({tuple(t) for t in triangles.tolist()}) == len(triangles) == 35
    assert len({tuple(q) for q in quads.tolist()}) == len(quads) == 35
    assert (np.diff(quads) > 0).all()


def test_chains_that_are_left_out_begin_and_end_no_quad() -> None:
    everything = np.triu(np.ones((6, 6), dtype=bool), 1)
    chains = linked_chains(everything)[:, 1:]  # all but 0, 1, 2
    first, second = joined_chains(chains, everything)
    quads = np.stack([*chains[:, first], chains[2, second]], axis=1)
    assert sorted(map(tuple, quads.tolist())) == [
        quad for quad in combinations(range(6), 4) if quad[:3] != (0, 1, 2)
    ]
