"""Measures against closed forms, differences, rendered cubes and libigl."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from shapetween.base.arrays import Floats, Points
from shapetween.base.errors import MeshError, OptionError, ShapeError
from shapetween.compare.formulas import (
    arap_energy,
    boundary_edges,
    conformal_distortion,
    detour,
    epipolar_distance,
    excess_conformal,
    fundamental_matrix,
    isometric_distortion,
    measure_mesh,
    overshoot,
    reversibility,
    roughness,
    signed_stretches,
    straightness,
    symmetric_dirichlet,
    transfer_error,
    travel,
)
from shapetween.interpolate import METHODS
from shapetween.interpolate.inside import Inside
from shapetween.mesh.pair import MeshPair
from tests.strategies import grid, rotation

angle = st.floats(-np.pi, np.pi)


@given(first=angle, second=angle, a=st.floats(0.1, 10.0), b=st.floats(0.1, 10.0))
def test_stretches_are_those_put_in(first: float, second: float, a: float, b: float) -> None:
    large, small = max(a, b), min(a, b)
    for sign in (1.0, -1.0):
        matrix = rotation(first) @ np.diag([large, sign * small]) @ rotation(second)
        np.testing.assert_allclose(signed_stretches(matrix), (large, sign * small), atol=1e-12)
    matrix = (rotation(first) @ np.diag([a, b]) @ rotation(second))[None]
    areas = np.array([3.0])
    np.testing.assert_allclose(conformal_distortion(matrix), large / small)
    np.testing.assert_allclose(isometric_distortion(matrix), max(large, 1 / small))
    np.testing.assert_allclose(
        arap_energy(matrix, areas), 3 * ((a - 1) ** 2 + (b - 1) ** 2), atol=1e-9
    )
    np.testing.assert_allclose(
        symmetric_dirichlet(matrix, areas), (a**2 + b**2 + a**-2 + b**-2) / 4
    )


def test_folds_are_infinite() -> None:
    mirrored = np.array([np.eye(2), np.diag([1.0, -1.0])])
    assert conformal_distortion(mirrored).tolist() == [1.0, np.inf]
    assert isometric_distortion(mirrored).tolist() == [1.0, np.inf]
    assert symmetric_dirichlet(mirrored, np.ones(2)) == np.inf
    assert arap_energy(mirrored, np.ones(2)) == pytest.approx(4.0)


def test_excess_is_over_the_end() -> None:
    last = np.diag([2.0, 1.0])[None]
    frames = np.stack([np.eye(2)[None], np.diag([3.0, 1.0])[None], last])
    np.testing.assert_allclose(excess_conformal(frames, last)[:, 0], [0.0, 0.5, 0.0])


def test_paths_of_numbers() -> None:
    t = np.linspace(0, 1, 5)
    assert straightness(2 + 3 * t, t) == pytest.approx(0.0, abs=1e-15)
    assert straightness(np.array([1.0, 1.0, 4.0, 1.0, 2.0]), t) == pytest.approx(2.5 / 2)
    assert detour(2 + 3 * t**2) == pytest.approx(0.0, abs=1e-15)
    assert detour(np.array([1.0, 3.0, 2.0])) == pytest.approx(2 / 2)
    lengths = np.array([[1.0, 4.0], [2.2, 3.0], [2.0, 2.0]])
    assert overshoot(lengths) == pytest.approx(0.1)
    assert overshoot(np.array([[1.0], [0.5], [1.0]])) == pytest.approx(0.5)


def test_paths_of_points() -> None:
    t = np.linspace(0, 1, 201)
    circle = np.stack([np.cos(np.pi * t), np.sin(np.pi * t)], axis=-1)[:, None]
    assert travel(circle, 2.0) == pytest.approx(np.pi / 2, rel=1e-4)
    assert roughness(circle, t, 2.0) == pytest.approx(np.pi**2 / 2, rel=1e-3)
    assert roughness(t[:, None, None] * np.ones((1, 3, 2)), t, 1.0) < 1e-9
    assert reversibility(circle, np.array([0.3, 0.4]) + circle, 2.0) == pytest.approx(0.25)


def views(seed: int) -> Points:
    """A cube's points on a 3 x 3 x 3 grid, seen five times by a camera as it turns, (5, 27, 2)."""
    rng = np.random.default_rng(seed)
    step = [-0.5, 0.0, 0.5]
    cube = np.stack(np.meshgrid(step, step, step), axis=-1).reshape(-1, 3)
    axis, places = rng.normal(size=3), np.array([0, 0, 3]) + rng.uniform(-0.3, 0.3, (2, 3))
    axis /= np.linalg.norm(axis)
    frames = []
    for t in np.linspace(0, 1, 5):
        turn = Rotation.from_rotvec((0.4 + 0.8 * t) * axis)
        x, y, z = (turn.apply(cube) + (1 - t) * places[0] + t * places[1]).T
        frames.append(np.stack([x / z, y / z], axis=-1))
    return np.array(frames)


@pytest.mark.parametrize("seed", range(4))
def test_views_of_a_cube_are_views_of_a_cube(seed: int) -> None:
    frames = views(seed)
    for other in frames[1:]:
        assert epipolar_distance(frames[0], other) < 1e-9
    assert transfer_error(frames[0], frames[2], frames[4]) < 1e-6


@pytest.mark.parametrize("seed", range(4))
def test_what_is_no_view_is_seen(seed: int) -> None:
    """Straight lines between two views of a cube show no cube."""
    frames = views(seed)
    between = (frames[0] + frames[4]) / 2
    between += 0.02 * np.sin(40 * frames[0])
    assert epipolar_distance(frames[0], between) > 1e-3
    assert transfer_error(frames[0], between, frames[4]) > 1e-3


def test_epipolar_measures_have_no_unit_and_refuse_planes() -> None:
    frames = views(1)
    bent = frames[2] + 0.01 * np.cos(30 * frames[2])
    base = epipolar_distance(frames[0], bent)
    assert epipolar_distance(1e4 * frames[0] + 7, 1e4 * bent) == pytest.approx(base, rel=1e-6)
    matrix = fundamental_matrix(frames[0], frames[2])
    assert abs(np.linalg.det(matrix)) < 1e-12
    vertices, _ = grid(4, 4)
    for flat in (vertices, vertices[:7]):
        with pytest.raises(ShapeError):
            fundamental_matrix(flat, flat @ rotation(0.3).T)


def bent() -> MeshPair:
    vertices, quads = grid(4, 3)
    target = vertices @ rotation(1.1).T + 0.25 * np.sin(1.3 * vertices[:, ::-1])
    return MeshPair(vertices, target, quads)


@pytest.mark.parametrize("method", METHODS)
def test_identity_measures_nothing(method: str) -> None:
    vertices, quads = grid(3, 2)
    figures = measure_mesh(MeshPair(vertices, vertices, quads), method, 5).figures
    assert figures.conformal == pytest.approx(1)
    assert figures.isometric == pytest.approx(1)
    assert figures.symmetric_dirichlet == pytest.approx(1)
    still = (figures.travel, figures.roughness, figures.reversibility, figures.residual or 0.0)
    kept = (figures.rigidity, figures.area, figures.perimeter, figures.edge_overshoot)
    np.testing.assert_allclose([*still, *kept], 0, atol=1e-9)
    assert figures.folded == 0
    assert figures.least_sine == pytest.approx(1)


@pytest.mark.parametrize("size", [1e-3, 1e5])
def test_figures_have_no_unit(size: float) -> None:
    pair = bent()
    base = measure_mesh(pair, "projective", 9).figures.as_dict()
    larger = MeshPair(size * pair.source, size * pair.target, pair.quads)
    for name, value in measure_mesh(larger, "projective", 9).figures.as_dict().items():
        assert value == pytest.approx(base[name], abs=1e-8), name


def test_turning_rigidly_is_seen_and_shrinking_too() -> None:
    vertices, quads = grid(3, 2)
    turned = MeshPair(vertices, vertices @ rotation(2.0).T, quads)
    rigid, straight = measure_mesh(turned, "projective"), measure_mesh(turned, "linear")
    np.testing.assert_allclose(rigid.areas, 6.0)
    np.testing.assert_allclose(rigid.perimeters, 10.0)
    assert rigid.figures.rigidity < 1e-12
    # Half way a straight line shrinks by cos(1), areas by its square.
    assert straight.areas.min() == pytest.approx(6 * np.cos(1) ** 2)
    assert straight.figures.area == pytest.approx(1 - np.cos(1) ** 2)
    assert straight.figures.edge_overshoot == pytest.approx(1 - np.cos(1))
    assert straight.figures.isometric > rigid.figures.isometric + 0.1


@pytest.mark.parametrize("method", METHODS)
def test_rigidity_is_seen_from_the_nearer_key(method: str) -> None:
    """Twice as large at the end: (1 + t) from the source, (1 + t) / 2 from the target."""
    vertices, quads = grid(3, 2)
    found = measure_mesh(MeshPair(vertices, 2 * vertices, quads), method, 11)
    t = found.times
    wanted = np.minimum(2 * t**2, 2 * (1 - (1 + t) / 2) ** 2)
    np.testing.assert_allclose(found.rigidity, wanted, atol=1e-12)


def test_folded_frames_are_counted() -> None:
    vertices, quads = grid(3, 2)
    over = measure_mesh(MeshPair(vertices, vertices @ rotation(np.pi).T, quads), "linear", 41)
    # Straight lines go through one point half way, and only there.
    assert over.folded.tolist() == [k == 20 for k in range(41)]
    assert over.figures.as_dict()["conformal"] is None
    assert len(boundary_edges(bent())) == 14


def test_wrong_input_is_refused() -> None:
    with pytest.raises(OptionError):
        measure_mesh(bent(), "none")
    pair = bent()
    with pytest.raises(MeshError):
        measure_mesh(MeshPair(pair.source, pair.source * [-1, 1], pair.quads), "arap")


def test_arap_energy_is_what_libigl_makes_least() -> None:
    """Its as-rigid-as-possible solution with held vertices: any way off it costs more."""
    igl = pytest.importorskip("igl", reason="libigl is not installed")
    pair = bent()
    inside = Inside.of(pair, "triangles")
    held = np.array([0, 4, 15, 19])
    goal = pair.source[held] @ rotation(0.5).T * [1.3, 0.9]
    data = igl.ARAPData()
    data.energy, data.max_iter = igl.ARAP_ENERGY_TYPE_ELEMENTS, 2000
    faces = inside.triangles.astype(np.int64)
    igl.arap_precomputation(pair.source, faces, 2, held.astype(np.int32), data)
    found = igl.arap_solve(goal, data, pair.source.copy())

    def energy(points: Floats) -> float:
        return float(arap_energy(*inside.jacobians(points[None], 1))[0])

    least, rng = energy(found), np.random.default_rng(0)
    assert least > 1e-3
    for _ in range(20):
        off = rng.normal(size=found.shape)
        off[held] = 0
        slope = (energy(found + 1e-5 * off) - energy(found - 1e-5 * off)) / 2e-5
        assert abs(slope) < 1e-3 * np.linalg.norm(off)
        assert energy(found + 1e-2 * off) > least
