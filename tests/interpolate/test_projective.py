"""The projective method on whole meshes."""

import numpy as np
import pytest

from shapetween.base.arrays import Floats, Points
from shapetween.base.errors import DegenerateQuadError
from shapetween.geometry.polygon import corner_sines, rms_radius
from shapetween.interpolate import projective
from shapetween.interpolate.projective import PaperProjective, Projective
from shapetween.interpolate.quads import interpolate_quads
from shapetween.mesh.pair import MeshPair
from tests.benchmarks.measuring import bent_grid
from tests.strategies import grid, rotation

T = np.array([0.0, 0.2, 0.5, 0.9, 1.0])


METHODS = pytest.mark.parametrize("method", [Projective, PaperProjective])


@METHODS
@pytest.mark.parametrize("degrees", [30, 90, 120, 170, 180, -170])
def test_turned_mesh_turns(method: type[Projective | PaperProjective], degrees: float) -> None:
    vertices, quads = grid(5, 3)
    angle = np.deg2rad(degrees)
    target = 2 * vertices @ rotation(angle).T + [7.0, 1.0]
    frames = method(MeshPair(vertices, target, quads)).vertices(T)
    local = vertices - vertices.mean(axis=0)
    way = angle if degrees != -180 else np.pi
    for t, frame in zip(T, frames, strict=True):
        wanted = (1 + t) * local @ rotation(t * way).T
        np.testing.assert_allclose(frame - frame.mean(axis=0), wanted, atol=1e-9)


@METHODS
def test_spiral_past_half_a_turn_unrolls_without_a_jump(
    method: type[Projective | PaperProjective],
) -> None:
    """Neighbours turn by less than half a turn, the whole by more: angles must be coherent."""
    count = 24
    x = np.linspace(0, 12, count + 1)
    vertices = np.concatenate([np.stack([x, 0 * x], axis=1), np.stack([x, 0 * x + 1], axis=1)])
    first = np.arange(count)
    quads = np.stack([first, first + 1, first + count + 2, first + count + 1], axis=1)
    angle = np.linspace(0, np.deg2rad(300), count + 1)
    radius = 3 - np.array([0.0, 1.0])[:, None] + 0.1 * angle
    bent = np.concatenate(
        [np.stack([r * np.sin(angle), 3 - r * np.cos(angle)], axis=1) for r in radius]
    )
    frames = method(MeshPair(vertices, bent, quads)).vertices(np.linspace(0, 1, 21))
    lengths = np.linalg.norm(np.diff(frames[:, : count + 1], axis=1), axis=-1)
    ends = np.maximum(lengths[0], lengths[-1]), np.minimum(lengths[0], lengths[-1])
    assert (lengths < 1.05 * ends[0]).all()
    assert (lengths > 0.9 * ends[1]).all()


def test_a_bad_quad_is_named() -> None:
    vertices, quads = grid(3, 1)
    target = vertices.copy()
    target[6] = target[1] + [-0.2, 0.1]
    with pytest.raises(DegenerateQuadError, match="quad"):
        Projective(MeshPair(vertices, target, quads))


def extreme(rng: np.random.Generator) -> Points:
    """A convex quad of any shape."""
    while True:
        angle = np.sort(rng.uniform(0, 2 * np.pi, 4))
        quad = rng.uniform(0.3, 1, (4, 1)) * np.stack([np.cos(angle), np.sin(angle)], axis=1)
        if corner_sines(quad).min() > 0.02:
            return np.asarray(quad)


def test_no_quad_alone_loses_its_convexity() -> None:
    """Rigidly moved some of these do, by which they are found; backwards is the same for all."""
    rng, t = np.random.default_rng(5), np.linspace(0, 1, 41)
    count = 1500
    source = np.concatenate([extreme(rng) for _ in range(count)])
    target = np.concatenate([np.roll(extreme(rng), rng.integers(4), axis=0) for _ in range(count)])
    pair = MeshPair(source, target, np.arange(4 * count).reshape(-1, 4))
    movement, back = Projective(pair), Projective(pair.reversed())
    others = sum(len(chosen) for chosen, _, _ in movement._others)
    assert 3 <= others < count / 20
    frames = movement.vertices(t)
    assert corner_sines(frames[:, pair.quads]).min() > 0
    assert np.abs(frames - back.vertices(1 - t)).max() < 1e-9


def test_the_papers_form_is_the_papers_on_one_quad() -> None:
    rng = np.random.default_rng(2)
    p, q = extreme(rng), extreme(rng)
    pair = MeshPair(p, q, np.arange(4)[None])
    for scale in (None, 1.0, 10.0):
        line = "limit" if scale is None else "slerp"
        wanted = interpolate_quads(p[None], q[None], T, line=line, scale=scale)[:, 0]  # type: ignore[arg-type]
        np.testing.assert_allclose(PaperProjective(pair, scale).vertices(T), wanted, atol=1e-12)
    np.testing.assert_array_equal(
        PaperProjective(pair).vertices(T), PaperProjective(pair, 10.0).vertices(T)
    )


def test_residual_is_how_far_faces_are_from_their_vertices() -> None:
    vertices, quads = grid(3, 2)
    movement = Projective(MeshPair(vertices, vertices @ rotation(1.0).T, quads))
    assert (movement.residual(T) < 1e-12 * rms_radius(vertices)).all()
    bent = vertices + 0.3 * np.sin(2 * vertices[:, ::-1])
    half = Projective(MeshPair(vertices, bent, quads))
    assert half.residual([0.5])[0] > 1e-3


def test_many_quads_are_moved_few_times_at_once_and_alike(monkeypatch: pytest.MonkeyPatch) -> None:
    """The memory that it takes is bounded, however many times are asked for."""
    pair, t = bent_grid(6), np.linspace(0, 1, 41)
    whole = Projective(pair).vertices(t)
    monkeypatch.setattr(projective, "AT_ONCE", 3 * pair.quads.size)
    tween = Projective(pair)
    asked: list[int] = []
    moved = tween.loose_corners

    def counted(t: Floats) -> Points:
        asked.append(len(t))
        return moved(t)

    monkeypatch.setattr(tween, "loose_corners", counted)
    np.testing.assert_array_equal(tween.vertices(t), whole)
    assert max(asked) == 3
    assert sum(asked) == len(t)
