"""Single quads: the paper's sections 3 and 4."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from shapetween.base.arrays import Floats, Points
from shapetween.base.errors import DegenerateQuadError, OptionError, ShapeError
from shapetween.geometry.homography import apply_homography, quad_homographies
from shapetween.geometry.polygon import corner_sines, rms_radius
from shapetween.interpolate.quads import QuadMotion, interpolate_quads
from tests.strategies import convex_quads, rotation, times

SQUARE = np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]])
LINES: list[dict[str, object]] = [
    {},
    {"line": "slerp", "scale": 1.0},
    {"line": "slerp", "scale": 10.0},
]


def size_of(*quads: Points) -> float:
    return float(max(np.ptp(q, axis=0).max() + np.abs(q).max() for q in quads))


def paper_in_between(p: Points, q: Points, t: float, radius: float) -> Points:
    """The corrected equations (2) to (9), written out again for one quad, with 3 x 3 matrices."""
    centre = p.mean(axis=0)
    k = radius / float(rms_radius(p))
    a, b = (p - centre) * k, (q - centre) * k
    rows = []
    for (x, y), (u, v) in zip(a, b, strict=True):
        rows += [[x, y, 1, 0, 0, 0, -u * x, -u * y], [0, 0, 0, x, y, 1, -v * x, -v * y]]
    h = np.append(np.linalg.solve(np.array(rows), b.ravel()), 1.0).reshape(3, 3)
    eta = np.sign(h[2, 2]) / np.linalg.norm(h[2])
    line = eta * h[2]
    perspective = np.eye(3)
    perspective[2] = line
    affine = eta * h @ np.linalg.inv(perspective)
    u_, d, vt = np.linalg.svd(affine[:2, :2])
    turned = u_ @ vt
    angle = np.arctan2(turned[1, 0] - turned[0, 1], np.trace(turned))
    part = np.eye(3)
    part[:2, :2] = rotation(t * angle) @ ((1 - t) * np.eye(2) + t * vt.T @ np.diag(d) @ vt)
    part[:2, 2] = t * affine[:2, 2]
    r = np.hypot(line[0], line[1])
    gamma = np.arctan2(r, line[2])
    share = np.sin(t * gamma) / r if r > 1e-12 else t
    turning = np.eye(3)
    turning[2] = [share * line[0], share * line[1], np.cos(t * gamma)]
    y = np.column_stack([a, np.ones(4)]) @ (part @ turning).T
    return np.asarray(y[:, :2] / y[:, 2:] / k + centre)


@given(p=convex_quads(), q=convex_quads(), t=times, radius=st.sampled_from([0.5, 1.0, 10.0]))
def test_slerp_is_the_papers_corrected_form(p: Points, q: Points, t: float, radius: float) -> None:
    got = interpolate_quads(p[None], q[None], [t], line="slerp", scale=radius)[0, 0]
    tolerance = 1e-7 * size_of(p, q)
    np.testing.assert_allclose(got, paper_in_between(p, q, t, radius), atol=tolerance)


@given(p=convex_quads(), q=convex_quads(), t=times)
def test_limit_is_a_large_source_scale(p: Points, q: Points, t: float) -> None:
    limit = interpolate_quads(p[None], q[None], [t])
    large = interpolate_quads(p[None], q[None], [t], line="slerp", scale=1e6)
    np.testing.assert_allclose(limit, large, atol=1e-4 * size_of(p, q))


@given(p=convex_quads(), q=convex_quads())
@pytest.mark.parametrize("radius", [None, 1.0, 10.0])
def test_ends_are_met(radius: float | None, p: Points, q: Points) -> None:
    """Endpoints of equation (7), which its printed form misses by the size of the quad."""
    motion = QuadMotion.between(p[None], q[None], radius)
    ends = motion.corners(p[None], np.array([0.0, 1.0]))[:, 0]
    np.testing.assert_allclose(ends, [p, q], atol=1e-9 * size_of(p, q))


@given(p=convex_quads(), q=convex_quads(), ts=st.lists(times, min_size=1, max_size=5))
@pytest.mark.parametrize("line", LINES)
def test_convex_at_every_time(
    line: dict[str, object], p: Points, q: Points, ts: list[float]
) -> None:
    between = interpolate_quads(p[None], q[None], ts, **line)  # type: ignore[arg-type]
    assert (corner_sines(between) > 0).all()


@given(p=convex_quads(), t=times, angle=st.floats(-3.1, 3.1), size=st.floats(0.1, 10.0))
def test_similar_quads_turn_rigidly(p: Points, t: float, angle: float, size: float) -> None:
    q = size * p @ rotation(angle).T + [3.0, -5.0]
    got = interpolate_quads(p[None], q[None], [t])[0, 0]
    local = p - p.mean(axis=0)
    wanted = (1 - t + t * size) * local @ rotation(t * angle).T
    np.testing.assert_allclose(got - got.mean(axis=0), wanted, atol=1e-8 * size_of(p, q))


def test_source_scale_matters_and_translation_does_not() -> None:
    """Section 4: without normalisation a quad's place and size would change its path."""
    p = SQUARE
    q = np.array([[-1.0, -1.0], [2.0, -0.5], [1.5, 2.0], [-0.5, 1.0]])
    half = [0.5]
    base = interpolate_quads(p[None], q[None], half, line="slerp", scale=10.0)
    moved = interpolate_quads(p[None] + 100, q[None] + 100, half, line="slerp", scale=10.0)
    np.testing.assert_allclose(moved - 100, base, atol=1e-9)
    larger = interpolate_quads(50 * p[None], 50 * q[None], half, line="slerp", scale=10.0)
    np.testing.assert_allclose(larger / 50, base, atol=1e-9)
    small = interpolate_quads(p[None], q[None], half, line="slerp", scale=0.1)
    assert np.abs(small - base).max() > 0.05


def test_interior_follows_the_homography() -> None:
    p = SQUARE[None]
    q = np.array([[[0.0, 0.0], [4.0, 0.0], [3.0, 2.0], [1.0, 2.0]]])
    motion = QuadMotion.between(p, q)
    middle = np.zeros((1, 1, 2)) - motion.centres
    end = apply_homography(motion.homographies(np.array([1.0])), middle)[0, 0, 0]
    want = apply_homography(quad_homographies(p, q), np.zeros((1, 1, 2)))[0, 0]
    np.testing.assert_allclose(end, want, atol=1e-12)


@pytest.mark.parametrize(
    ("quad", "why"),
    [
        ([[0, 0], [1, 0], [2, 0], [0, 2]], "straight-corner"),
        ([[0, 0], [1, 1], [1, 0], [0, 1]], "bow-tie"),
        ([[0, 0], [4, 0], [1, 1], [0, 4]], "dart"),
        ([[0, 0], [0, 0], [1, 0], [1, 1]], "doubled-corner"),
        ([[0, 0], [0, 0], [0, 0], [0, 0]], "zero-area"),
    ],
)
def test_degenerate_quads_are_named(quad: list[list[float]], why: str) -> None:
    bad = np.array([SQUARE, np.array(quad, dtype=float), SQUARE])
    with pytest.raises(DegenerateQuadError, match=r"quad 1: .*convex") as caught:
        interpolate_quads(bad, np.array([SQUARE] * 3), [0.5])
    assert caught.value.indices == (1,), why


def test_a_mirrored_quad_is_named() -> None:
    with pytest.raises(DegenerateQuadError, match="quad 0: inverted"):
        interpolate_quads(SQUARE[None], SQUARE[None, ::-1], [0.5])


def test_wrong_arguments_are_refused() -> None:
    with pytest.raises(ShapeError):
        interpolate_quads(SQUARE[None], np.array([SQUARE, SQUARE]), [0.5])
    with pytest.raises(ShapeError):
        interpolate_quads(SQUARE[None], SQUARE[None], [1.5])
    with pytest.raises(ShapeError):
        interpolate_quads(SQUARE[None] * np.nan, SQUARE[None], [0.5])
    with pytest.raises(OptionError):
        interpolate_quads(SQUARE[None], SQUARE[None], [0.5], scale=3.0)
    with pytest.raises(OptionError):
        interpolate_quads(SQUARE[None], SQUARE[None], [0.5], line="slerp", scale=-1.0)


def test_many_quads_and_times_at_once_equal_one_by_one() -> None:
    rng = np.random.default_rng(3)
    p = SQUARE + rng.uniform(-0.3, 0.3, (5, 4, 2))
    q = SQUARE @ rotation(2.0).T + rng.uniform(-0.3, 0.3, (5, 4, 2))
    t: Floats = np.array([0.1, 0.9])
    stacked = interpolate_quads(p, q, t)
    for k in range(5):
        np.testing.assert_allclose(stacked[:, k : k + 1], interpolate_quads(p[[k]], q[[k]], t))
