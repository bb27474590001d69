import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from shapetween.base.arrays import Floats, Points
from shapetween.match import correspond, costs, match, symmetry
from shapetween.match.correspondence import Correspondence
from shapetween.match.sampling import sample
from shapetween.match.symmetry import Axes, aligned_ends, mirror_axes, turns_onto
from shapetween.model.outline import Outline
from tests.match.labels import labelled
from tests.match.shapes import polygon, rotation, rounded, star, target_at

GRID = np.arange(200) / 200


def mirrored(half: Points) -> Points:
    """The polygon of points from top to bottom on the right and their mirror images."""
    return np.concatenate([half, half[::-1] * [-1, 1]])


def vase(seed: int, corners: int = 6) -> Points:
    """A symmetric polygon unlike those of other seeds, upright."""
    rng = np.random.default_rng(seed)
    heights = np.sort(rng.uniform(-2, 2, corners))
    return mirrored(np.column_stack([rng.uniform(0.3, 1.2, corners), heights]))


def unevenness(found: Correspondence, a: Outline, b: Outline) -> float:
    """How far the matching is from its mirror image, as a share of the second's length."""
    axes = [mirror_axes(sample(outline).points) for outline in (a, b)]
    starts = [sample(outline).start for outline in (a, b)]
    ends = [start + axis.ends[0] for start, axis in zip(starts, axes, strict=True)]
    there = target_at(found, ends[0] + GRID) - ends[1]
    back = target_at(found, ends[0] - GRID) - ends[1]
    gap = there + back
    return float(np.abs(gap - np.round(gap)).max())


@settings(max_examples=20)
@given(st.integers(0, 10**6), st.floats(-3, 3), st.booleans())
def test_the_axis_of_a_symmetric_outline_is_found_however_it_is_turned(
    seed: int, angle: float, smooth: bool
) -> None:
    points = vase(seed)
    outline = (rounded if smooth else polygon)(points)
    outline = outline if outline.area > 0 else outline.reversed()
    axes = mirror_axes(sample(outline.transformed(rotation(angle, 7.0))).points)
    along = np.exp(1j * (axes.directions - angle))
    # One that is nearly symmetric about another line as well has that for an axis too.
    assert len(axes.ends) in (2, 4)
    upright = np.sort(along.imag[np.abs(along.real) < 1e-3])
    np.testing.assert_allclose(upright, [-1, 1], atol=1e-3)


@pytest.mark.parametrize("sides", [3, 4, 5])
def test_a_regular_polygon_has_as_many_axes_as_sides(sides: int) -> None:
    angle = 2 * np.pi * np.arange(sides) / sides + 0.1
    axes = mirror_axes(sample(polygon(np.stack([np.cos(angle), np.sin(angle)], axis=1))).points)
    assert len(axes.ends) == 2 * sides
    gaps = np.diff(np.sort(axes.directions))
    np.testing.assert_allclose(gaps, np.pi / sides, atol=0.02)


@pytest.mark.parametrize("seed", range(10))
def test_a_lopsided_outline_has_no_axis(seed: int) -> None:
    assert len(mirror_axes(sample(polygon(star(seed))).points).ends) == 0


def test_a_small_tail_makes_an_outline_lopsided() -> None:
    points = vase(3)
    tailed = np.insert(points, 3, points[2] + [0.9, 0.1], axis=0)
    assert len(mirror_axes(sample(polygon(points)).points).ends) == 2
    assert len(mirror_axes(sample(polygon(tailed)).points).ends) == 0


def tufted(seed: int) -> tuple[Outline, Outline]:
    """A vase with a tuft on one side, and another vase."""
    points = vase(seed, 7)
    tuft = points[6] * [0, 1] + [0.5, 0.5]
    return polygon(np.insert(points, 7, tuft, axis=0)), polygon(vase(seed + 1, 5))


@pytest.mark.parametrize("seed", [34, 46])
def test_what_is_even_but_for_a_tuft_is_matched_so(
    monkeypatch: pytest.MonkeyPatch, seed: int
) -> None:
    a, b = tufted(seed)
    first, second = (mirror_axes(sample(outline).points) for outline in (a, b))
    assert not first.even
    assert len(first.beside(second).ends) == len(second.beside(first).ends) == 2
    assert len(first.beside(first).ends) == 0
    even = correspond(a, b)
    assert unevenness(even, a, b) < 1e-6
    for module, name, value in (
        (match, "NEARLY_RATIO", 0.5),
        (symmetry, "NEARLY", symmetry.MOST_DEVIATION),
        (symmetry, "TO_THE_EYE", -1.0),
    ):
        with monkeypatch.context() as patch:
            patch.setattr(module, name, value)
            costs.prepare.cache_clear()
            assert target_at(correspond(a, b), GRID) != pytest.approx(
                target_at(even, GRID), abs=1e-3
            )


def axes(*directions: float) -> Axes:
    angles = np.array([*directions, *(d + np.pi for d in directions)])
    ends: Floats = np.linspace(0, 1, len(angles), endpoint=False)
    return Axes(ends, angles)


def test_axes_are_paired_end_with_end_in_the_frame() -> None:
    assert aligned_ends(axes(0.3), axes(1.4), 0.0) == []
    (turned,) = aligned_ends(axes(0.3), axes(1.4), 1.0)
    np.testing.assert_array_equal(turned, [[0, 0], [0.5, 0.5]])
    (other_way,) = aligned_ends(axes(0.3), axes(0.3 + np.pi), 0.0)
    np.testing.assert_array_equal(other_way, [[0, 0.5], [0.5, 1]])


def test_every_axis_of_the_one_with_fewer_is_paired() -> None:
    many = axes(*(np.pi * np.arange(7) / 7))
    for pairs in (aligned_ends(many, axes(0.5), 0.0), aligned_ends(axes(0.5), many, 0.0)):
        assert len(pairs) == 1


def test_axes_that_lean_are_tried_only_where_none_is_drawn_alike(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    ends = np.array([0.0, 0.1, 0.5, 0.6])  # not regular, so that each axis is by itself
    first, second = (Axes(ends, axes(0.0, lean).directions) for lean in (0.5, 0.55))
    assert len(aligned_ends(first, second, 0.001)) == 1
    monkeypatch.setattr(symmetry, "ALIGNED", 0.0)
    assert len(aligned_ends(first, second, 0.001)) == 2


@settings(max_examples=10)
@given(st.integers(0, 10**6), st.floats(-0.2, 0.2))
def test_symmetric_outlines_are_matched_symmetrically(seed: int, lean: float) -> None:
    a, b = polygon(vase(seed)), polygon(vase(seed + 1, 8)).transformed(rotation(lean))
    found = correspond(a, b)
    # Unlike ones may be turned or matched side to end where that is far cheaper.
    if abs(found.turn) < 0.5:
        assert unevenness(found, a, b) < 2e-3


def test_a_creature_of_eight_legs_keeps_its_sides() -> None:
    """The second one's lowest pair of legs is small: none of them may go to a jaw."""
    ends = []
    for lowest in (1.8, 0.5):
        half = [[0.1, -1.0]]
        for height, reach in ((-0.6, 1.6), (-0.2, 1.8), (0.2, 1.8), (0.6, lowest)):
            half += [[0.4, height - 0.1], [reach, height - 0.1 + height / 2]]
            half += [[reach, height + 0.1 + height / 2], [0.4, height + 0.1]]
        ends.append(polygon(mirrored(np.array([*half, [0.1, 1.0]]))))
    a, b = ends
    assert unevenness(correspond(a, b), a, b) < 2e-3


def test_symmetric_outlines_that_stand_are_not_turned() -> None:
    """Trousers would fit a vest better upside down."""
    trousers = mirrored(np.array([[1.0, -2.0], [1.3, 2.0], [0.3, 2.2], [0.1, -0.5]]))
    vest = mirrored(np.array([[0.3, -1.0], [0.6, -2.0], [1.0, -2.0], [0.9, -1.2], [1.1, 1.8]]))
    assert correspond(polygon(trousers), polygon(vest)).turn == 0.0


def test_an_arrow_up_turns_to_become_another_that_points_down() -> None:
    up = mirrored(np.array([[0.02, -2.0], [1.2, -0.6], [0.4, -0.6], [0.4, 2.0]]))
    slim = mirrored(np.array([[0.02, -2.0], [1.0, -0.3], [0.2, -0.5], [0.15, 1.8]]))
    assert abs(correspond(polygon(up), polygon(-slim)).turn) == pytest.approx(np.pi, abs=0.1)


def test_one_axis_is_laid_onto_another_the_way_that_turns_less_first() -> None:
    one = Axes(np.array([0.1, 0.6]), np.array([0.2, 0.2 - np.pi]))
    other = Axes(np.array([0.3, 0.8]), np.array([1.2, 1.2 - np.pi]))
    np.testing.assert_allclose(turns_onto(one, other), [1.0, 1.0 - np.pi])
    square = Axes(np.arange(4) / 4, np.arange(4) * np.pi / 2)
    assert turns_onto(one, square) == turns_onto(square, one) == []


def test_what_leans_is_stood_up_where_that_alone_lays_axis_onto_axis() -> None:
    leaning = {"lab-375", "lab-390", "lab-498"}  # a brush, a rocket, a shovel
    pairs = [pair for pair in labelled("tune", "test", "new") if pair.name in leaning]
    assert len(pairs) == len(leaning)
    for pair in pairs:
        found = correspond(pair.source, pair.target)
        assert pair.wrong(found) == 0, pair.name
        assert abs(found.turn) > 0.5
    # Letters stand, though an L is even about its diagonal.
    ell = np.array([[0.0, 0], [1, 0], [1, 3], [4, 3], [4, 4], [0, 4]])
    arms = [[3.0, 0], [3, 1], [1, 1], [1, 2], [3, 2], [3, 3], [1, 3], [1, 4], [3, 4], [3, 5]]
    e = np.array([[0.0, 0], *arms, [0, 5]])
    assert correspond(polygon(ell), polygon(e)).turn == 0


def test_a_pin_outweighs_symmetry() -> None:
    a, b = polygon(vase(5)), polygon(vase(6))
    apart = np.array([[*a.curves[2, 0], *b.curves[4, 0]]])
    assert unevenness(correspond(a, b, apart), a, b) > 0.02


def test_what_stands_wide_is_not_laid_on_its_side_to_become_what_stands_tall() -> None:
    bridge = np.array([[2.6, -1.0], [2.6, 0.4], [3.3, 0.4], [3.3, 0.8], [2.6, 0.8], [2.6, 1.3]])
    deck = np.array([[2.0, 1.3], [2.0, 0.8]])
    arch = np.array([[0.4, -0.1], [1.4, -0.3], [2.0, -1.0]])
    medal = np.array([[0.25, -2.4], [1.6, -2.8], [0.8, -1.0], [1.3, 0.0], [1.3, 1.0], [0.6, 1.8]])
    wide = polygon(mirrored(np.concatenate([arch, bridge, deck])))
    tall = polygon(mirrored(medal))
    for pair in ((wide, tall), (tall, wide)):
        assert correspond(*pair).turn == 0
