from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from shapetween.base.arrays import Floats, Points
from shapetween.deform.check import simple_frames
from shapetween.deform.jacobians import gradients, jacobians
from shapetween.deform.mesh import ambient_mesh
from shapetween.deform.motion import AmbientMotion, Stiffness
from shapetween.geometry.linearmaps import LinearMaps, as_complex
from shapetween.geometry.polygon import polygon_area
from shapetween.geometry.rotation import rotations
from tests.deform.shapes import blob, bowed_strip, comb, pairs, ring_with_hole, two_discs
from tests.strategies import affine_maps, rotation

T = np.linspace(0, 1, 9)


def _size(points: Points) -> float:
    return float(np.ptp(points, axis=0).max())


def _nodes(source: Points, target: Points, t: Floats = T) -> Points:
    motion = AmbientMotion.prepare(ambient_mesh(source, target))
    return motion.vertices(t)[:, : len(source)]


@settings(max_examples=15)
@given(pairs())
def test_ends_are_exact_and_reached_without_a_jump(pair: tuple[Points, Points]) -> None:
    source, target = pair
    moved = _nodes(source, target, np.array([0.0, 1e-7, 1 - 1e-7, 1.0]))
    np.testing.assert_allclose(moved[0], source, rtol=1e-12)
    np.testing.assert_allclose(moved[3], target, rtol=1e-12)
    scale = _size(np.concatenate([source, target]))
    np.testing.assert_allclose(moved[1], source, atol=1e-4 * scale)
    np.testing.assert_allclose(moved[2], target, atol=1e-4 * scale)


@settings(max_examples=15)
@given(affine_maps(), st.integers(0, 10**6))
def test_an_affine_image_moves_through_affine_images(affine: Floats, seed: int) -> None:
    source = blob(seed, 12)
    moved = _nodes(source, source @ affine[:, :2].T + affine[:, 2])
    known = np.column_stack([source - source.mean(axis=0), np.full(12, _size(source))])
    for frame in moved:
        fit = np.linalg.lstsq(known, frame, rcond=None)[0]
        np.testing.assert_allclose(known @ fit, frame, atol=1e-8 * _size(moved))


@settings(max_examples=10)
@given(st.integers(0, 10**6), st.floats(-3.0, 3.0), st.floats(0.1, 10.0), st.floats(-5.0, 5.0))
def test_a_similar_image_moves_through_similar_images(
    seed: int, angle: float, scale: float, shift: float
) -> None:
    source = blob(seed, 12)
    centre = source.mean(axis=0)
    local = source - centre
    moved = _nodes(source, centre + scale * local @ rotation(angle).T + shift * _size(source))
    for t, frame in zip(T, moved, strict=True):
        size = (1 - t) + t * scale
        want = centre + size * local @ rotation(t * angle).T + t * shift * _size(source)
        np.testing.assert_allclose(frame, want, atol=1e-8 * _size(moved))


@settings(max_examples=10)
@given(pairs())
def test_backwards_is_the_same_movement(pair: tuple[Points, Points]) -> None:
    forth, back = _nodes(*pair), _nodes(*pair[::-1])
    np.testing.assert_allclose(forth, back[::-1], atol=1e-6 * _size(forth))


@settings(max_examples=10)
@given(pairs(), st.floats(-3.0, 3.0), st.integers(1, 7))
def test_place_size_direction_and_start_do_not_matter(
    pair: tuple[Points, Points], angle: float, start: int
) -> None:
    source, target = pair
    plain = _nodes(source, target)
    scale = 1e3 / _size(plain)
    changed = [np.roll(scale * p @ rotation(angle).T + 7.0, start, axis=0) for p in pair]
    moved = np.roll(_nodes(*changed), -start, axis=1)
    want = scale * plain @ rotation(angle).T + 7.0
    np.testing.assert_allclose(moved, want, atol=1e-5 * 1e3)


def test_a_strip_bends_like_a_strip() -> None:
    moved = _nodes(bowed_strip(0.0), bowed_strip(3.0), np.array([0.5]))[0]
    middle = (moved[:8] + moved[8:][::-1]) / 2
    length = np.linalg.norm(np.diff(middle, axis=0), axis=1).sum()
    assert length == pytest.approx(1.0, abs=0.02)
    width = np.linalg.norm(moved[:8] - moved[8:][::-1], axis=1)
    np.testing.assert_allclose(width, 0.1, atol=0.015)
    heading = np.unwrap(np.arctan2(*np.diff(middle, axis=0).T[::-1]))
    assert heading[-1] - heading[0] == pytest.approx(1.5 * 6 / 7, abs=0.1)


def test_leaning_teeth_stay_apart() -> None:
    t = np.linspace(0, 1, 41)
    assert simple_frames(_nodes(comb(6, -2.0), comb(6, 2.0), t)).all()


def test_area_and_length_go_straight() -> None:
    t = np.linspace(0, 1, 21)
    moved = _nodes(bowed_strip(-3.0), 2 * bowed_strip(2.0), t)
    root = np.sqrt(polygon_area(moved))
    np.testing.assert_allclose(root, (1 - t) * root[0] + t * root[-1], rtol=0.02)
    length = np.linalg.norm(np.roll(moved, -1, axis=1) - moved, axis=2).sum(axis=1)
    np.testing.assert_allclose(length, (1 - t) * length[0] + t * length[-1], rtol=0.02)


@pytest.mark.parametrize("seed", [1, 5])
def test_area_goes_straight_between_unlike_shapes(seed: int) -> None:
    t = np.linspace(0, 1, 21)
    root = np.sqrt(polygon_area(_nodes(blob(seed, 24), blob(seed + 1, 24), t)))
    np.testing.assert_allclose(root, (1 - t) * root[0] + t * root[-1], rtol=0.04)


def test_a_hole_stays_in_its_shape_and_parts_stay_apart() -> None:
    t = np.linspace(0, 1, 41)
    for nodes, target, rings in (
        (ring_with_hole(-0.55)[0], ring_with_hole(0.55)[0], ring_with_hole(0.0)[1]),
        (two_discs(0.0)[0], two_discs(2.5)[0], two_discs(0.0)[1]),
    ):
        mesh = ambient_mesh(nodes, target, rings)
        moved = AmbientMotion.prepare(mesh).vertices(t)[:, : len(nodes)]
        assert simple_frames(moved, tuple(len(ring) for ring in rings)).all()


def test_the_inside_follows_a_target() -> None:
    source = np.array([[-2.0, -1.0], [2.0, -1.0], [2.0, 1.0], [-2.0, 1.0]])
    mesh = ambient_mesh(source, 3 * source)
    count = int(mesh.inside.sum())

    def swing(t: Floats, own: LinearMaps) -> LinearMaps:
        assert own.a.shape == (len(t), count)
        return own.turned(np.exp(0.8j * np.sin(np.pi * t))[:, None])

    weak = Stiffness(outside=1e-6, length=1e-6)
    moved = AmbientMotion.prepare(mesh, weak, swing).vertices(T)
    shape_gradients, _ = gradients(as_complex(mesh.source[mesh.triangles[mesh.inside]]))
    got = jacobians(shape_gradients, as_complex(moved[:, mesh.triangles[mesh.inside]])).matrices
    want = (1 + 2 * T)[:, None, None] * rotations(0.8 * np.sin(np.pi * T))
    np.testing.assert_allclose(got, np.broadcast_to(want[:, None], got.shape), atol=0.02)


def test_a_motion_is_smooth() -> None:
    t = np.linspace(0, 1, 161)
    moved = _nodes(bowed_strip(-3.0), bowed_strip(3.0), t)
    speed = np.linalg.norm(np.diff(moved, axis=0), axis=2).max(axis=1) * 160
    assert np.abs(np.diff(speed)).max() < 0.05 * speed.max()


def test_edges_turn_at_a_steady_pace_and_keep_near_their_length() -> None:
    """Between what was wanted first and what fits: less of it, and edges wander; more is stiff."""
    t = np.linspace(0, 1, 41)
    moved = _nodes(bowed_strip(-3.0), bowed_strip(3.0), t)
    edges = np.roll(moved, -1, axis=1) - moved
    angle = np.unwrap(np.arctan2(edges[..., 1], edges[..., 0]), axis=0)
    steady = (1 - t)[:, None] * angle[0] + t[:, None] * angle[-1]
    assert 0.0637 < np.abs(angle - steady).max() < 0.0658
    length = np.linalg.norm(edges, axis=2).sum(axis=1)
    straight = (1 - t) * length[0] + t * length[-1]
    assert 0.0352 < np.abs(length / straight - 1).max() < 0.0372


def test_what_only_inverted_triangles_hold_is_carried_by_a_blend() -> None:
    """Left out of the energy altogether, the system would not be regular."""
    source, target = comb(3, -0.1), comb(3, 0.35)
    mesh = ambient_mesh(source, target)
    free = int(np.flatnonzero(~np.isin(np.arange(len(mesh.source)), mesh.frame))[-1])
    alone = replace(mesh)
    object.__setattr__(alone, "inverted", (mesh.triangles == free).any(axis=1))
    moved = AmbientMotion.prepare(alone).vertices(T)
    assert np.isfinite(moved).all()
    low, high = moved.min(axis=1) - 1e-9, moved.max(axis=1) + 1e-9
    assert ((low <= moved[:, free]) & (moved[:, free] <= high)).all()
