"""The projective method on whole meshes."""

import numpy as np
import pytest

from shapetween.errors import DegenerateQuadError
from shapetween.interpolate.projective import Projective
from shapetween.mesh import MeshPair
from tests.strategies import grid, rotation

T = np.array([0.0, 0.2, 0.5, 0.9, 1.0])


@pytest.mark.parametrize("degrees", [30, 90, 120, 170, 180, -170])
def test_turned_mesh_turns(degrees: float) -> None:
    vertices, quads = grid(5, 3)
    angle = np.deg2rad(degrees)
    target = 2 * vertices @ rotation(angle).T + [7.0, 1.0]
    frames = Projective(MeshPair(vertices, target, quads)).vertices(T)
    local = vertices - vertices.mean(axis=0)
    way = angle if degrees != -180 else np.pi
    for t, frame in zip(T, frames, strict=True):
        wanted = (1 + t) * local @ rotation(t * way).T
        np.testing.assert_allclose(frame - frame.mean(axis=0), wanted, atol=1e-9)


def test_spiral_past_half_a_turn_unrolls_without_a_jump() -> None:
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
    frames = Projective(MeshPair(vertices, bent, quads)).vertices(np.linspace(0, 1, 21))
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
