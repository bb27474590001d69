import numpy as np
import pytest
from hypothesis import given

from shapetween.base.arrays import Points, Quads
from shapetween.geometry.homography import homogeneous_weights, quad_homographies
from shapetween.mesh.pair import MeshPair
from shapetween.photo.slip import bilinear_quads, corner_weights, greatest_slip
from shapetween.raster.faces import Bilinear, Projection, projections
from tests.strategies import convex_quads, grid


@given(convex_quads(), convex_quads())
def test_weights_at_corners(source: Quads, target: Quads) -> None:
    matrix = quad_homographies(source[None], target[None])
    weights = homogeneous_weights(matrix, source[None])[0]
    found = corner_weights(source, target)
    assert np.allclose(found / found[0], weights / weights[0], rtol=1e-6)


def two_quads(lean: float) -> tuple[MeshPair, Points]:
    """Two quads side by side in a picture, and a frame in which one of them leans."""
    vertices, quads = grid(2, 1)
    vertices = vertices * 50.0
    frame = vertices.copy()
    frame[0] += (lean, lean)
    return MeshPair(vertices, vertices, quads), frame


def parting(pair: MeshPair, frame: Points, bilinear: list[bool]) -> float:
    """Greatest distance in the picture between what the quads show along their common side."""
    line = frame[1] + np.linspace(0, 1, 201)[:, None] * (frame[4] - frame[1])
    shown = []
    for quad, chosen in zip(pair.quads, bilinear, strict=True):
        corners, end = frame[quad], pair.source[quad]
        matrix = projections(corners[None], end[None])[0]
        face = Bilinear(corners, end) if chosen else Projection(matrix, 1e-9)
        shown.append(np.stack(face(*line.T), axis=1))
    return float(np.linalg.norm(shown[0] - shown[1], axis=1).max())


@pytest.mark.parametrize("lean", [1.0, 7.5, 20.0])
def test_the_bound_is_what_is_seen(lean: float) -> None:
    pair, frame = two_quads(lean)
    ends = (pair.source, pair.source)
    slip = greatest_slip(pair, ends, frame[None], np.zeros(2, bool))
    assert abs(slip - parting(pair, frame, [False, False])) < 0.01 * slip


def test_slip_past_the_tolerance_is_resolved() -> None:
    pair, frame = two_quads(15.0)
    ends = (pair.source, pair.source)
    slip = greatest_slip(pair, ends, frame[None], np.zeros(2, bool))
    assert slip > 2
    assert not bilinear_quads(pair, ends, frame[None], slip + 0.1).any()
    chosen = bilinear_quads(pair, ends, frame[None], slip - 0.1)
    assert chosen.all()
    assert greatest_slip(pair, ends, frame[None], chosen) == 0
    assert parting(pair, frame, [True, True]) < 1e-9


def test_the_choice_spreads_until_nothing_parts() -> None:
    """A bilinear quad must not part from a neighbour that it agreed with before."""
    vertices, quads = grid(3, 1)
    vertices = vertices * 50.0
    pair = MeshPair(vertices, vertices, quads)
    frame = vertices.copy()
    # The first two quads disagree much; the last two lean alike, and agree.
    frame[0] += (16, 16)
    frame[3] += (6, 0)
    ends = (vertices, vertices)
    chosen = bilinear_quads(pair, ends, frame[None], 0.05)
    assert greatest_slip(pair, ends, frame[None], chosen) <= 0.05


def test_a_triangle_keeps_no_quad_waiting() -> None:
    vertices = np.array([[0.0, 0], [50, 0], [50, 50], [0, 50], [90, 20]])
    pair = MeshPair(vertices, vertices, np.array([[0, 1, 2, 3]]), np.array([[1, 4, 2]]))
    frame = vertices.copy()
    frame[0] += (12, 20)
    chosen = bilinear_quads(pair, (vertices, vertices), frame[None], 0.5)
    assert chosen.tolist() == [True]
    assert greatest_slip(pair, (vertices, vertices), frame[None], chosen) == 0
