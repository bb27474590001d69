"""What every method keeps, parametrised over all of them; what one lacks is said here."""

import numpy as np
import pytest
from hypothesis import given, settings

from shapetween.base.arrays import Floats, Points
from shapetween.base.errors import MeshError, OptionError, ShapeError
from shapetween.cli.options import METHOD_NAMES
from shapetween.interpolate import INTERIORS, METHODS, tween
from shapetween.mesh.pair import MeshPair
from tests.strategies import affine_maps, grid, rotation

T = np.array([0.0, 0.2, 0.5, 0.9, 1.0])
ALL = pytest.mark.parametrize("method", METHODS)


def bent(angle: float = 1.1) -> MeshPair:
    """A mesh of quads and two triangles, the target turned and bent."""
    vertices, quads = grid(4, 3)
    target = vertices @ rotation(angle).T + 0.25 * np.sin(1.3 * vertices[:, ::-1])
    return MeshPair(vertices, target, quads[:-1], quads[-1][[[0, 1, 2], [0, 2, 3]]])


def affine_fit(p: Floats, q: Floats) -> float:
    """Distance of q from the nearest affine image of p."""
    design = np.column_stack([p, np.ones(len(p))])
    return float(np.abs(design @ np.linalg.lstsq(design, q, rcond=None)[0] - q).max())


def test_the_command_line_offers_every_method() -> None:
    assert tuple(METHODS) == METHOD_NAMES
    assert tuple(INTERIORS) == METHOD_NAMES


def test_an_unknown_method_gets_the_nearest_name() -> None:
    with pytest.raises(OptionError, match=r"'arap2000'.*did you mean 'arap-2000'"):
        tween(bent(), "arap2000")


@ALL
def test_ends_are_the_meshes_own_to_the_last_bit(method: str) -> None:
    pair = bent()
    frames = tween(pair, method).vertices([1.0, 0.0, 0.5])
    np.testing.assert_array_equal(frames[0], pair.target)
    np.testing.assert_array_equal(frames[1], pair.source)


@ALL
def test_near_the_ends_is_near_the_ends(method: str) -> None:
    """The ends are met by the movement itself, not only because they are put there."""
    pair = bent()
    frames = tween(pair, method).vertices([1e-7, 1 - 1e-7])
    np.testing.assert_allclose(frames, [pair.source, pair.target], atol=1e-5)


@ALL
def test_many_times_at_once_are_the_same_one_by_one(method: str) -> None:
    movement = tween(bent(), method)
    together = movement.vertices(T)
    assert together.shape == (len(T), len(bent().source), 2)
    for t, frame in zip(T, together, strict=True):
        np.testing.assert_allclose(movement.vertices(t)[0], frame, atol=1e-12)


@ALL
@settings(max_examples=30)
@given(matrix=affine_maps())
def test_affine_image_gives_affine_frames(method: str, matrix: Floats) -> None:
    vertices, quads = grid(4, 2)
    target = vertices @ matrix[:, :2].T + matrix[:, 2]
    pair = MeshPair(vertices, target, quads[1:], np.array([[0, 1, 5]]))
    frames = tween(pair, method).vertices(T)
    assert max(affine_fit(vertices, frame) for frame in frames) < 1e-9 * np.abs(target).max()


@pytest.mark.parametrize("degrees", [30, 90, 170, 180])
@pytest.mark.parametrize("method", [m for m in METHODS if m != "linear"])
def test_turned_mesh_turns(method: str, degrees: float) -> None:
    """Not by straight lines, whose docstring says so."""
    vertices, quads = grid(5, 3)
    angle = np.deg2rad(degrees)
    target = 2 * vertices @ rotation(angle).T + [7.0, 1.0]
    frames = tween(MeshPair(vertices, target, quads), method).vertices(T)
    local = vertices - vertices.mean(axis=0)
    middle = vertices.mean(axis=0), target.mean(axis=0)
    for t, frame in zip(T, frames, strict=True):
        wanted = (1 + t) * local @ rotation(t * angle).T
        if degrees == 180 and method == "arap-2000":  # either way round, as rounding has it
            around = (1 + t) * local @ rotation(-t * angle).T
            if np.abs(frame - frame.mean(axis=0) - around).max() < 1e-9:
                wanted = around
        wanted += (1 - t) * middle[0] + t * middle[1]
        np.testing.assert_allclose(frame, wanted, atol=1e-9)


@ALL
def test_identity_stands_still(method: str) -> None:
    vertices, quads = grid(3, 2)
    frames = tween(MeshPair(vertices, vertices, quads), method).vertices(T)
    np.testing.assert_allclose(frames, np.broadcast_to(vertices, frames.shape), atol=1e-12)


@ALL
@pytest.mark.parametrize("size", [1e-3, 1e6])
def test_no_units(method: str, size: float) -> None:
    pair = bent()
    base = tween(pair, method).vertices(T)
    larger = MeshPair(size * pair.source, size * pair.target, pair.quads, pair.triangles)
    np.testing.assert_allclose(tween(larger, method).vertices(T) / size, base, atol=1e-9)


@ALL
def test_turning_both_shapes_turns_every_frame(method: str) -> None:
    pair, turn = bent(), rotation(0.7)
    turned = MeshPair(pair.source @ turn.T, pair.target @ turn.T, pair.quads, pair.triangles)
    base = tween(pair, method).vertices(T)
    np.testing.assert_allclose(tween(turned, method).vertices(T), base @ turn.T, atol=1e-9)


@ALL
def test_two_parts_move_by_themselves(method: str) -> None:
    one = bent()
    count = len(one.source)
    other = (one.target + 20.0, one.source @ rotation(2.0).T + 30.0)
    both = MeshPair(
        np.concatenate([one.source, other[0]]),
        np.concatenate([one.target, other[1]]),
        np.concatenate([one.quads, one.quads + count]),
        np.concatenate([one.triangles, one.triangles + count]),
    )
    frames = tween(both, method).vertices(T)
    alone = tween(one, method).vertices(T)
    np.testing.assert_allclose(frames[:, :count], alone, atol=1e-9)


@ALL
def test_a_mesh_drawn_anticlockwise_moves_as_well(method: str) -> None:
    pair = bent()
    reverse = MeshPair(pair.source, pair.target, pair.quads[:, ::-1], pair.triangles[:, ::-1])
    base = tween(pair, method).vertices(T)
    np.testing.assert_allclose(tween(reverse, method).vertices(T), base, atol=1e-9)


def far_back(method: str) -> float:
    """How far the way back is from the way there, as a share of the source's radius."""
    pair = bent()
    there = tween(pair, method).vertices(T)
    back = tween(pair.reversed(), method).vertices(1 - T)
    radius = np.sqrt(pair.source.var(axis=0).sum())
    return float(np.sqrt(((there - back) ** 2).sum(-1).mean(-1)).max() / radius)


@pytest.mark.parametrize("method", ["projective", "arap", "linear"])
def test_the_way_back_is_the_same(method: str) -> None:
    assert far_back(method) < 1e-9


def folded_quad() -> MeshPair:
    vertices, quads = grid(3, 1)
    target = vertices.copy()
    target[6] = target[1] + [-0.2, -1.0]
    return MeshPair(vertices, target, quads)


def one_triangle(target: list[list[float]]) -> MeshPair:
    corners = np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])
    return MeshPair(corners, np.array(target), np.zeros((0, 4), np.intp), np.array([[0, 1, 2]]))


BAD: dict[str, MeshPair] = {
    "folded quad": folded_quad(),
    "turned-over triangle": one_triangle([[0, 0], [0, 1], [1, 0]]),
    "triangle without area": one_triangle([[0, 0], [1, 0], [2, 0]]),
    "turned-over quad": MeshPair(grid(1, 1)[0], grid(1, 1)[0] * [-1, 1], grid(1, 1)[1]),
    "quad without area": MeshPair(grid(1, 1)[0] * [1, 0], grid(1, 1)[0], grid(1, 1)[1]),
}


@pytest.mark.parametrize("name", BAD)
@ALL
def test_faces_without_an_in_between_are_named(method: str, name: str) -> None:
    """All but straight lines, which move anything and say so."""
    if method == "linear":
        assert np.isfinite(tween(BAD[name], method).vertices(T)).all()
        return
    with pytest.raises(MeshError, match=r"(quad|triangle) [01]"):
        tween(BAD[name], method)


@ALL
@pytest.mark.parametrize("t", [[-0.1], [1.1], [np.nan], [[0.5]]])
def test_times_outside_are_refused(method: str, t: Points) -> None:
    with pytest.raises(ShapeError):
        tween(bent(), method).vertices(t)
