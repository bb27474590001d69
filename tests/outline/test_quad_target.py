import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from shapetween.base.arrays import Points
from shapetween.geometry.linearmaps import LinearMaps
from shapetween.interpolate import tween
from shapetween.mesh.pair import MeshPair
from shapetween.outline.quad_target import QuadJacobianTarget, usable_quads
from tests.strategies import grid

T = np.linspace(0, 1, 7)
seeds = st.integers(0, 10**6)


def shaken(seed: int) -> MeshPair:
    """A sheet of quads with its vertices moved about in two ways."""
    points, quads = grid(4, 3)
    random = np.random.default_rng(seed)
    ends = [points + random.uniform(-0.25, 0.25, points.shape) for _ in range(2)]
    return MeshPair(ends[0], ends[1], quads)


def triangles(seed: int) -> tuple[Points, Points]:
    """Small triangles about the sheet, and others near where they might go."""
    random = np.random.default_rng(seed)
    small = np.array([[0.0, 0.0], [0.3, 0.0], [0.0, 0.3]])
    places = random.uniform(-1, 5, (40, 1, 2))
    return places + small, places * [1.0, 1.1] + small


def test_backwards_the_same_quads_lead() -> None:
    """Seen from one end these two pass for valid on all of their way, from the other not."""
    ends = [
        [
            [[0.55, -0.19], [0.89, 2.31], [-0.15, -1.19], [0.21, -1.43]],
            [[-1.61, 0.54], [-1.19, -0.48], [0.4, -1.71], [0.29, -0.37]],
        ],
        [
            [[0.95, -0.16], [-2.22, 0.81], [-0.06, -0.5], [1.23, -0.97]],
            [[-0.78, 0.03], [1.11, 0.01], [1.97, 0.26], [-0.58, 0.25]],
        ],
    ]
    for pair in ends:
        for source, target in (pair, pair[::-1]):
            alone = MeshPair(np.array(source), np.array(target), np.arange(4)[None])
            assert not usable_quads(alone, tween(alone, "projective")).any()


@settings(max_examples=10)
@given(seeds)
def test_backwards_the_same_is_asked(seed: int) -> None:
    pair = shaken(seed)
    source, target = triangles(seed)
    back = MeshPair(pair.target, pair.source, pair.quads)
    forth = QuadJacobianTarget.of(pair, tween(pair, "projective"), source, target)
    other = QuadJacobianTarget.of(back, tween(back, "projective"), target, source)
    assert forth is not None
    assert other is not None
    np.testing.assert_array_equal(forth.follows, other.follows)
    still = LinearMaps(np.ones((len(T), 40), dtype=complex), np.zeros((len(T), 40), dtype=complex))
    whole = LinearMaps(
        *(part[-1:, forth.follows] for part in (forth(T, still).a, forth(T, still).b))
    )
    seen, reverse = forth(T, still), other(1 - T, still)
    there = LinearMaps(reverse.a[:, forth.follows], reverse.b[:, forth.follows]).after(whole)
    np.testing.assert_allclose(seen.a[:, forth.follows], there.a, atol=1e-9)
    np.testing.assert_allclose(seen.b[:, forth.follows], there.b, atol=1e-9)


def test_of_quads_that_share_the_nearest_corner_the_first_leads() -> None:
    """Rounding in where the quads stand must not choose between them."""
    points, quads = grid(2, 1)
    # Beyond the corner in the middle both quads are as near.
    points[1] = [1.0, -0.4]
    random = np.random.default_rng(3)
    corner = np.array([[1.0, -0.9], [1.1, -0.9], [1.05, -0.8]])[None]
    for _ in range(20):
        noisy = points + 1e-15 * random.normal(size=points.shape)
        pair = MeshPair(noisy, noisy, quads)
        target = QuadJacobianTarget.of(pair, tween(pair, "projective"), corner, corner)
        assert target is not None
        assert target._forth.followed.tolist() == [0]
