import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from shapetween.base.arrays import Points
from shapetween.base.errors import OutlineError, ShapeError
from shapetween.mesh import MatchedMesh, mesh_matched
from shapetween.mesh.quality import face_figures
from tests.mesh.pairs import (
    Pair,
    assert_valid,
    clockwise,
    comb,
    matched,
    regular,
    spiral,
    star,
    untangled,
)
from tests.strategies import rotation

SQUARE = np.array([[0.0, 0.0], [1, 0], [1, 1], [0, 1]])

SHAPES = {
    "spiral": spiral(),
    "comb": comb(5),
    "long-comb": comb(8, 5.0, 0.9),
    "disc": regular(80),
    "star": star(),
    "square": SQUARE,
    "triangle": regular(3),
}


def usable_share(mesh: MatchedMesh, source: Points, target: Points) -> float:
    """Mean share of the two shapes that lies in quads that move well."""
    shares = []
    usable = face_figures(np.stack([mesh.pair.source, mesh.pair.target])[:, mesh.pair.quads]).usable
    for points, outline in ((mesh.pair.source, source), (mesh.pair.target, target)):
        quads = shapely.union_all(shapely.polygons(points[mesh.pair.quads[usable]]))
        shape = shapely.Polygon(outline).buffer(0)
        shares.append(quads.intersection(shape).area / shape.area)
    return float(np.mean(shares))


@pytest.mark.parametrize("seed", range(30))
def test_random_polygons_always_have_a_valid_mesh(seed: int) -> None:
    rng = np.random.default_rng(seed)
    a, b = (untangled(rng, int(rng.integers(3, 26))) for _ in range(2))
    source, target, corners = matched(a, b, int(rng.choice([16, 64, 160])), rng.random())
    assert_valid(mesh_matched(source, target, corners), source, target)


@pytest.mark.parametrize(
    ("a", "b"),
    [
        ("spiral", "disc"),
        ("square", "spiral"),
        ("comb", "disc"),
        ("comb", "star"),
        ("long-comb", "comb"),
        ("long-comb", "square"),
        ("star", "star"),
        ("disc", "disc"),
        ("triangle", "long-comb"),
        ("triangle", "square"),
    ],
)
def test_unlike_shapes_have_a_valid_mesh(a: str, b: str) -> None:
    source, target, corners = matched(SHAPES[a], SHAPES[b], 256, 0.37)
    assert_valid(mesh_matched(source, target, corners), source, target)


@settings(max_examples=25)
@given(st.integers(0, 2**32 - 1), st.integers(3, 9), st.integers(3, 9), st.floats(0, 1))
def test_few_samples_have_a_valid_mesh(seed: int, n: int, m: int, offset: float) -> None:
    rng = np.random.default_rng(seed)
    source, target, corners = matched(untangled(rng, n), untangled(rng, m), 8, offset)
    assert_valid(mesh_matched(source, target, corners), source, target)


def test_squares_are_one_quad() -> None:
    source, target, corners = matched(SQUARE, SQUARE * [3.0, 3.0] + 5, 64)
    mesh = mesh_matched(source, target, corners)
    assert mesh.level == "search"
    assert len(mesh.pair.quads) == 1
    assert len(mesh.pair.triangles) == 0
    assert mesh.left_out == pytest.approx((0, 0), abs=1e-12)
    assert usable_share(mesh, source, target) == pytest.approx(1)
    assert mesh.perspective == pytest.approx(1)


def strip(bend: float, width: float = 0.12) -> Points:
    """A long limb, bent half-way."""
    s = np.linspace(0, 1, 120)
    angle = bend * np.clip((s - 0.4) / 0.2, 0, 1)
    heading = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    axis = np.cumsum(heading, axis=0) / len(s)
    normal = np.stack([-heading[:, 1], heading[:, 0]], axis=1) * width / 2
    return clockwise(np.concatenate([axis - normal, (axis + normal)[::-1]]))


def test_a_bending_limb_is_a_few_quads_across() -> None:
    source, target = strip(0.0), strip(1.6)
    mesh = mesh_matched(source, target)
    assert_valid(mesh, source, target)
    assert len(mesh.pair.triangles) == 0
    assert 2 <= len(mesh.pair.quads) <= 8
    assert len(mesh.nodes) == 2 * len(mesh.pair.quads) + 2
    assert usable_share(mesh, source, target) > 0.95
    assert max(mesh.left_out) < 0.06


def same(mesh: MatchedMesh, other: MatchedMesh) -> bool:
    return np.array_equal(mesh.pair.quads, other.pair.quads) and np.array_equal(
        mesh.pair.triangles, other.pair.triangles
    )


@pytest.fixture
def unlike() -> Pair:
    return matched(star(5, 0.5), comb(3), 256, 0.1)


def test_roles_can_be_exchanged(unlike: Pair) -> None:
    source, target, corners = unlike
    there, back = mesh_matched(source, target, corners), mesh_matched(target, source, corners)
    assert same(there, back)
    np.testing.assert_array_equal(there.pair.source, back.pair.target)
    np.testing.assert_array_equal(there.pair.target, back.pair.source)
    assert there.left_out == back.left_out[::-1]


@pytest.mark.parametrize("shift", [1, 77, 200])
def test_the_start_of_the_samples_does_not_matter(unlike: Pair, shift: int) -> None:
    mesh = mesh_matched(*unlike)
    source, target = (np.roll(points, -shift, axis=0) for points in unlike[:2])
    turned = mesh_matched(source, target, np.roll(unlike[2], -shift))
    assert_valid(turned, source, target)
    np.testing.assert_array_equal(np.sort((turned.nodes + shift) % len(source)), mesh.nodes)


@pytest.mark.parametrize("scale", [1e-6, 1.0, 1e6])
def test_turn_place_and_unit_do_not_matter(unlike: Pair, scale: float) -> None:
    source, target, corners = unlike
    mesh = mesh_matched(source, target, corners)
    moved = mesh_matched(source, scale * (target @ rotation(1.3).T + [2.0, -5.0]), corners)
    np.testing.assert_array_equal(moved.nodes, mesh.nodes)
    assert same(moved, mesh)
    assert moved.left_out == pytest.approx(mesh.left_out)


@pytest.mark.parametrize("wanted", [4, 12, 20])
def test_about_as_many_quads_as_asked_for(wanted: int) -> None:
    source, target, corners = matched(star(6, 0.6), regular(80), 512, 0.0)
    mesh = mesh_matched(source, target, corners, quads=wanted)
    assert_valid(mesh, source, target)
    assert abs(len(mesh.pair.quads) - wanted) <= 0.2 * wanted


def test_many_quads_lie_across_a_limb() -> None:
    source, target = strip(0.3), strip(1.2)
    mesh = mesh_matched(source, target, quads=40)
    assert_valid(mesh, source, target)
    assert len(mesh.pair.quads) == 40
    assert len(mesh.pair.triangles) == 0
    size = shapely.area(shapely.polygons(mesh.pair.source[mesh.pair.quads]))
    assert size.max() < 4 * np.median(size)


def lost_shares(mesh: MatchedMesh, source: Points, target: Points) -> list[float]:
    shares = []
    for points, outline in ((mesh.pair.source, source), (mesh.pair.target, target)):
        shape, nodes = shapely.Polygon(outline), shapely.Polygon(points[: len(mesh.nodes)])
        shares.append(shape.symmetric_difference(nodes).area / shape.area)
    return shares


def test_what_is_left_out_is_measured() -> None:
    source, target, corners = matched(regular(90), SQUARE, 256, 0.03)
    mesh = mesh_matched(source, target, corners)
    assert mesh.left_out == pytest.approx(lost_shares(mesh, source, target))


def test_what_is_left_out_is_never_told_too_small() -> None:
    source, target, corners = matched(comb(4), star(), 256, 0.2)
    mesh = mesh_matched(source, target, corners)
    lost = lost_shares(mesh, source, target)
    assert all(told > share for told, share in zip(mesh.left_out, lost, strict=True))


@pytest.mark.parametrize(
    ("name", "ring"),
    [
        ("figure-eight", np.array([[0.0, 0.0], [3, 3], [3, 0], [0, 2]])),
        ("anticlockwise", SQUARE[::-1]),
        ("no-area", np.array([[0.0, 0.0], [1, 0], [2, 0], [1, 0]])),
    ],
)
def test_outlines_that_cannot_be_meshed_are_refused(name: str, ring: Points) -> None:
    with pytest.raises(OutlineError):
        mesh_matched(SQUARE, ring)
    with pytest.raises(OutlineError):
        mesh_matched(ring, SQUARE)


def test_arrays_that_do_not_fit_are_refused() -> None:
    with pytest.raises(ShapeError):
        mesh_matched(SQUARE, regular(5))
    with pytest.raises(ShapeError):
        mesh_matched(SQUARE, SQUARE, np.zeros(3, dtype=bool))
    with pytest.raises(ShapeError):
        mesh_matched(SQUARE[:2], SQUARE[:2])
