import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from shapetween.base.arrays import Affine
from shapetween.match import register as registering
from shapetween.match.register import register
from shapetween.model.arclength import ArcLength
from shapetween.model.outline import Outline
from tests.match.shapes import disc, polygon, rewritten, rotation, rounded, star


def check(source: Outline, matrix: Affine, first: int = 1) -> None:
    """The matching sends every point where the map sends it."""
    target = rewritten(source.transformed(matrix), first, 0.37)
    found = register(source, target)
    assert found is not None
    size = np.abs(matrix[:, :2]).max()
    np.testing.assert_allclose(found.matrix[:, :2], matrix[:, :2], atol=1e-8 * size)
    places = np.random.default_rng(0).random(50)
    wanted = ArcLength(source).point(places) @ matrix[:, :2].T + matrix[:, 2]
    turned = places - np.floor(places - found.u[0])
    arcs = ArcLength(target)
    away = np.linalg.norm(arcs.point(np.interp(turned, found.u, found.v)) - wanted, axis=1)
    assert away.max() < 1e-6 * arcs.length


@settings(max_examples=12)
@given(st.integers(0, 10**6), st.floats(-3.1, 3.1), st.sampled_from([1e-3, 1.0, 1e6]))
def test_similarities(seed: int, angle: float, scale: float) -> None:
    check(rounded(star(seed)), rotation(angle, scale), first=seed % 9)


@pytest.mark.parametrize("seed", range(4))
def test_affine_maps(seed: int) -> None:
    matrix = np.random.default_rng(seed).normal(size=(2, 3))
    matrix[0] *= np.sign(np.linalg.det(matrix[:, :2]))
    check(polygon(star(seed)) if seed % 2 else rounded(star(seed)), matrix)


def test_a_mirror_image_is_no_image() -> None:
    outline = polygon(star(1))
    mirrored = outline.transformed(np.array([[-1.0, 0, 0], [0, 1, 0]])).reversed()
    assert register(outline, mirrored) is None


def test_a_bump_is_no_image() -> None:
    points = star(2)
    moved = points.copy()
    moved[3] *= 1.02
    assert register(polygon(points), polygon(moved)) is None


@pytest.mark.parametrize(
    ("turn", "expected"), [(0.0, 0.0), (0.3, 0.3), (1.2, 1.2 - np.pi / 2), (np.pi, 0.0)]
)
def test_a_square_turns_no_more_than_it_must(turn: float, expected: float) -> None:
    square = polygon(np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]))
    found = register(square, square.transformed(rotation(turn)))
    assert found is not None
    assert found.turn == pytest.approx(expected, abs=1e-9)


@pytest.mark.parametrize("turn", [0.0, 0.4, 2.0])
def test_a_disc_never_turns(turn: float) -> None:
    found = register(disc(), disc().transformed(rotation(turn)))
    assert found is not None
    # Four cubics are not quite a disc, so some turn is seen: never more than an eighth.
    assert abs(found.turn) <= np.pi / 4 + 1e-9
    plain = register(disc(), rewritten(disc(), 2, 0.5))
    assert plain is not None
    assert plain.turn == pytest.approx(0.0, abs=1e-9)


def test_pins_choose_among_equal_maps_and_forbid_others() -> None:
    square = polygon(np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]))
    quarter = register(square, square, np.array([[0.0, 0.25]]))
    assert quarter is not None
    assert quarter.turn == pytest.approx(np.pi / 2, abs=1e-9)
    assert register(square, square, np.array([[0.0, 0.1]])) is None


def test_a_refinement_that_is_no_number_ends() -> None:
    white = registering._whiten(polygon(star(5)))
    (found,) = registering._refined(white, white, np.array([np.nan]), None)
    assert np.isnan(found.shift)


def test_shifts_are_refined_together_as_alone() -> None:
    white = registering._whiten(rounded(star(3)))
    shifts = np.array([0.01, 0.1, 0.27, 0.9])
    together = registering._refined(white, white, shifts, None)
    assert together == [registering._refined(white, white, k[None], None)[0] for k in shifts]
