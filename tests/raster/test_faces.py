import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from shapetween.base.arrays import Floats, Points, Quads
from shapetween.raster.faces import Bilinear, Footprint, Projection, projections
from tests.strategies import convex_quads, rotation


def bilinear(quad: Quads, s: Floats, r: Floats) -> Points:
    s, r = s[:, None], r[:, None]
    upper = (1 - s) * quad[0] + s * quad[1]
    lower = (1 - s) * quad[3] + s * quad[2]
    return np.asarray((1 - r) * upper + r * lower)


@given(convex_quads(), convex_quads(), st.integers(0, 2**32 - 1))
def test_the_bilinear_inverse_inverts(frame: Quads, picture: Quads, seed: int) -> None:
    s, r = np.random.default_rng(seed).uniform(0, 1, (2, 20))
    places = bilinear(frame, s, r)
    expected = bilinear(picture, s, r)
    u, v = Bilinear(frame, picture)(*places.T)
    assert np.abs(np.stack([u, v], axis=1) - expected).max() < 1e-5 * np.abs(picture).max()
    u, v = Bilinear(frame[::-1], picture[::-1])(*places.T)
    assert np.abs(np.stack([u, v], axis=1) - expected).max() < 1e-5 * np.abs(picture).max()


def test_bilinear_on_parallel_sides() -> None:
    square = np.array([[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]])
    u, v = Bilinear(square, 3 * square)(np.array([0.5, 2.0]), np.array([1.5, 0.0]))
    assert np.allclose([u, v], [[1.5, 6.0], [4.5, 0.0]])


@given(convex_quads(), convex_quads(), st.floats(0, 1), st.floats(0, 1))
def test_straight_lines_stay_straight(frame: Quads, picture: Quads, a: float, b: float) -> None:
    """A line across a quad of the frame shows a line of the picture."""
    start, end = frame[0] + a * (frame[1] - frame[0]), frame[3] + b * (frame[2] - frame[3])
    line = start + np.linspace(0, 1, 9)[:, None] * (end - start)
    matrix = projections(frame[None], picture[None])[0]
    shown = np.stack(Projection(matrix, 1e-9)(*line.T), axis=1)
    along = shown[-1] - shown[0]
    off = (shown - shown[0]) @ np.array([-along[1], along[0]]) / np.linalg.norm(along)
    assert np.abs(off).max() < 1e-6 * np.abs(picture).max()


def test_triangles_are_mapped_affinely() -> None:
    frame = np.array([[[0.0, 0.0], [4.0, 1.0], [1.0, 3.0]]])
    linear = rotation(0.4) * 1.7
    matrix = projections(frame, frame @ linear.T + (5, -2))[0]
    assert np.allclose(matrix, [[*linear[0], 5], [*linear[1], -2], [0, 0, 1]])


@pytest.mark.parametrize(
    ("stretch", "probes", "level"),
    [
        ((1, 1), 1, 0.0),
        ((4, 4), 1, 1.5),
        ((8, 2), 4, 0.5),
        ((0.5, 0.25), 1, 0.0),
        ((100, 1), 8, 3.14),
    ],
)
@pytest.mark.parametrize("angle", [0.0, 0.7])
def test_footprints(stretch: tuple[float, float], probes: int, level: float, angle: float) -> None:
    """How many samples a pixel takes, and from which halved copy."""
    matrix = np.eye(3)
    matrix[:2, :2] = np.diag(stretch) @ rotation(-angle)
    corners = np.array([[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]])
    footprint = Footprint.of(matrix, corners)
    assert footprint.probes == probes
    x = y = np.array([2.0])
    u, v = Projection(matrix, footprint.least)(x, y)
    assert abs(float(footprint.level(x, y, u, v)[0]) - level) < 0.05
    if probes > 1:
        assert abs(abs(footprint.direction @ [np.cos(angle), np.sin(angle)]) - 1) < 1e-6
