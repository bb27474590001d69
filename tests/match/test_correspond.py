import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from shapetween.base.arrays import Floats, Points
from shapetween.base.errors import OptionError, OutlineError
from shapetween.match import Matcher, correspond
from shapetween.model.arclength import ArcLength
from shapetween.model.outline import Outline
from tests.match.shapes import (
    apart,
    bowed,
    dense,
    polygon,
    rewritten,
    rotation,
    rounded,
    source_at,
    star,
    swirled,
    target_at,
)

GRID = np.arange(200) / 200


def hand(turn: float = 0.0, fingers: int = 4) -> Points:
    """A palm on a wrist with fingers upwards; the first one is bent sideways by `turn`."""
    points = [[-0.3, 3.0], [-1.0, 1.5]]
    for k in range(fingers):
        x = -1.0 + 2.0 * k / (fingers - 1)
        finger = np.array([[-0.15, 0.0], [-0.15, -1.0], [-0.1, -2.0], [0.1, -2.0], [0.15, 0.0]])
        if k == 0:
            c, s = np.cos(turn), np.sin(turn)
            finger = finger @ np.array([[c, -s], [s, c]])
        root = np.array([x, -0.2 * np.sin(np.pi * k / (fingers - 1))])
        points += (finger + root).tolist()
    return np.array([*points, [1.0, 1.5], [0.3, 3.0]])


def vertex_places(points: Points) -> Floats:
    """Fractions of the length of a polygon's corners."""
    return ArcLength(polygon(points)).nearest(points)[0]


@settings(max_examples=8)
@given(st.integers(0, 10**6))
def test_the_way_back_is_the_inverse(seed: int) -> None:
    a, b = polygon(star(seed)), rounded(star(seed + 1, 7))
    there, back = correspond(a, b), correspond(b, a)
    assert apart(source_at(back, GRID), target_at(there, GRID)) < 1e-9
    assert apart(source_at(there, target_at(there, GRID)), GRID) < 1e-9


@settings(max_examples=8)
@given(st.integers(0, 10**6), st.sampled_from([1e-3, 1e6]))
def test_neither_start_nor_unit_nor_cuts_matter(seed: int, unit: float) -> None:
    a, b = polygon(star(seed)), rounded(star(seed + 1, 7))
    matrix = rotation(0.0, unit)
    moved = rewritten(a.transformed(matrix), 4, 0.3)
    other = rewritten(b, 2, 0.6)
    plain, same = correspond(a, b), correspond(moved, other)
    places, shifted = ArcLength(a), ArcLength(moved)
    origin = places.nearest((moved.curves[0, 0] - matrix[:, 2]) / unit)[0]
    landed = ArcLength(b).nearest(other.curves[0, 0])[0]
    assert shifted.length == pytest.approx(unit * places.length)
    assert apart(target_at(same, GRID - origin) + landed, target_at(plain, GRID)) < 1e-6


def test_a_shape_and_itself_stand_still() -> None:
    outline = rounded(star(5))
    found = correspond(outline, outline)
    assert found.confidence == "sure"
    assert apart(target_at(found, GRID), GRID) < 1e-12
    assert found.affine is not None
    np.testing.assert_allclose(found.affine, [[1, 0, 0], [0, 1, 0]], atol=1e-12)


@pytest.mark.parametrize("turn", [-0.7, 0.4, 0.9])
def test_a_bent_finger_is_the_same_finger(turn: float) -> None:
    a, b = hand(), hand(turn)
    found = correspond(polygon(a), polygon(b))
    assert apart(target_at(found, vertex_places(a)), vertex_places(b)) < 0.02


def test_a_turned_and_bent_shape_is_found() -> None:
    a, b = hand(), hand(0.5)
    turned = b @ rotation(2.0)[:, :2].T
    found = correspond(polygon(a), polygon(turned))
    assert apart(target_at(found, vertex_places(a)), vertex_places(turned)) < 0.03
    assert found.turn == pytest.approx(2.0, abs=0.3)


def plane(nose: float, wing: float, sweep: float, lean: float) -> Points:
    """A plane that flies up, its right side wider by `lean`; corner 0 is the nose, 3 a wing."""
    right = [(0.15, 0.3 - nose), (0.15, -0.3), (wing, sweep), (wing, sweep + 0.25), (0.15, 0.25)]
    right += [(0.12, 1.0), (0.5, 1.25), (0.5, 1.45)]
    half = np.array(right)
    wide = half * [1 + lean, 1.0]
    return np.concatenate([[[0.0, -nose]], wide, [[0.0, 1.3]], half[::-1] * [-1.0, 1.0]])


@pytest.mark.parametrize("turn", [-np.pi / 2, 0.8, np.pi / 2])
@pytest.mark.parametrize("build", [(1.2, 1.1, 0.6, 0.15), (1.4, 1.5, -0.2, 0.2)])
def test_a_like_thing_drawn_another_way_is_turned(
    turn: float, build: tuple[float, float, float, float]
) -> None:
    a, b = plane(1.6, 1.3, 0.1, 0.0), plane(*build) @ rotation(turn)[:, :2].T
    found = correspond(polygon(a), polygon(b))
    assert found.turn == pytest.approx(turn, abs=0.2)
    corners = [0, 3, 7, 11, 15]  # nose, tips of wings and tail
    reached = target_at(found, vertex_places(a)[corners])
    assert apart(reached, vertex_places(b)[corners]) < 0.04


def test_outlines_warped_by_known_maps_are_found_again() -> None:
    """Bent, bowed, turned, scaled and started elsewhere: points are met where they went."""
    rng = np.random.default_rng(11)
    errors = []
    for case in range(12):
        shape = hand() if case % 2 else 2 * star(case)
        points = dense(shape)
        centre = 0.7 * shape[rng.integers(len(shape))]
        image = swirled(points, centre, rng.uniform(-0.7, 0.7), 1.5)
        image = bowed(image, rng.uniform(-0.08, 0.08))
        if case % 4 > 1:
            image = image @ rotation(rng.uniform(-3.0, 3.0))[:, :2].T
        truth = vertex_places(image)
        start = int(rng.integers(len(image)))
        outline = polygon(np.roll(image, -start, axis=0) * rng.uniform(0.1, 50.0))
        found = target_at(correspond(polygon(points), outline), vertex_places(points))
        gap = found - (truth - truth[start])
        errors.append(np.abs(gap - np.round(gap)).mean())
    assert np.mean(errors) < 0.007
    assert np.max(errors) < 0.03


def test_others_are_other_matchings_in_order_of_cost() -> None:
    found = correspond(polygon(hand()), polygon(star(3)))
    costs = [found.cost, *(other.cost for other in found.others)]
    assert len(costs) >= 3
    assert costs == sorted(costs)
    assert found.runner_up == costs[1]
    for other in found.others:
        assert np.abs(target_at(other, GRID) - target_at(found, GRID)).max() > 0.01


def test_a_pin_is_met_and_brings_its_finger() -> None:
    """Pinned to the tip of the finger beside it, a finger goes there from root to root."""
    a, b = hand(), hand(fingers=5)
    tips = np.array([[-1.0, -2.0]])
    goal = b[(b[:, 1] < -2.0) & (np.abs(b[:, 0] + 0.5) < 0.2)].mean(axis=0, keepdims=True)
    found = correspond(polygon(a), polygon(b), np.concatenate([tips, goal], axis=1))
    here, there = ArcLength(polygon(a)), ArcLength(polygon(b))
    assert apart(target_at(found, here.nearest(tips)[0]), there.nearest(goal)[0]) < 1e-9
    sides = np.array([[-1.12, -1.5], [-0.88, -1.5]])
    reached = there.point(target_at(found, here.nearest(sides)[0]))
    np.testing.assert_allclose(reached - sides, [[0.5, 0.0]] * 2, atol=0.35)


def test_several_pins_are_all_met() -> None:
    a, b = polygon(star(8)), polygon(star(9))
    here, there = ArcLength(a), ArcLength(b)
    u, v = np.array([0.1, 0.35, 0.8]), np.array([0.7, 0.9, 0.4])
    pins = np.concatenate([here.point(u), there.point(v)], axis=1)
    forward = correspond(a, b, pins)
    assert apart(target_at(forward, u), v) < 1e-9
    backward = correspond(b, a, pins[:, [2, 3, 0, 1]])
    assert apart(source_at(backward, GRID), target_at(forward, GRID)) < 1e-9


def test_a_matcher_is_asked_for_any_pins_as_places_or_points() -> None:
    a, b = polygon(star(8)), rounded(star(9))
    here, there = ArcLength(a), ArcLength(b)
    matcher = Matcher(a, b)
    for places in ([[0.3, 0.4]], [[0.1, 0.7], [1.35, 0.9], [0.8, -0.6]]):
        rows = np.array(places)
        pins = np.concatenate([here.point(rows[:, 0] % 1), there.point(rows[:, 1] % 1)], axis=1)
        by_places, by_points = matcher.match(rows), matcher.match(pins)
        alone = correspond(a, b, pins)
        assert apart(target_at(by_places, rows[:, 0]), rows[:, 1]) < 1e-9
        assert apart(target_at(by_places, GRID), target_at(by_points, GRID)) < 1e-6
        assert (alone.u == by_points.u).all()
        assert (alone.v == by_points.v).all()


def test_alternatives_are_distinct_and_hold_what_a_tip_may_become() -> None:
    """Any of the fingers may become any other: one of few alternatives takes each where it goes."""
    a, b = polygon(hand()), polygon(hand(fingers=5))
    found = Matcher(a, b).alternatives(8)
    assert len(found) == 8
    best = correspond(a, b)
    assert (found[0].u == best.u).all()
    assert (found[0].v == best.v).all()
    costs = [matching.cost for matching in found]
    assert costs == sorted(costs)
    reached = np.array([target_at(matching, GRID) for matching in found])
    for k, one in enumerate(reached):
        for other in reached[:k]:
            gap = one - other
            assert np.abs(gap - np.round(gap)).mean() > 0.02
    backward = Matcher(b, a).alternatives(8)
    for there, back in zip(found, backward, strict=True):
        assert apart(source_at(back, GRID), target_at(there, GRID)) < 1e-9


def test_an_affine_image_has_alternatives_too() -> None:
    outline = rounded(star(5))
    found = Matcher(outline, outline.transformed(rotation(0.4))).alternatives()
    assert found[0].affine is not None
    assert all(other.affine is None for other in found[1:])
    assert len(found) > 1


def test_pins_choose_among_affine_maps_and_may_rule_all_out() -> None:
    square = polygon(np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]))
    matcher = Matcher(square, square)
    for pins, turn in ((np.zeros((0, 2)), 0.0), (np.array([[0.0, 0.25]]), np.pi / 2)):
        found = matcher.match(pins)
        assert found.affine is not None
        assert found.turn == pytest.approx(turn, abs=1e-9)
    assert matcher.match(np.array([[0.0, 0.1]])).affine is None
    with pytest.raises(OptionError, match=r"pin 0.5:0.1 is out of order"):
        matcher.match(np.array([[0.0, 0.1], [0.5, 0.1]]))


@pytest.mark.parametrize(
    ("pins", "message"),
    [
        ([[5.0, 5.0, 0.0, 0.0]], "pin 5,5:0,0 is .* off the source"),
        ([[0.0, 0.0, 1.0, 1.0], [1.0, 0.0, 1.0, 1.0]], "out of order"),
        ([[0, 0, 0, 0], [1, 0, 0, 1], [1, 1, 1, 0]], "pin 1,1:1,0 is out of order"),
        ([[0.0, 0.0, 1.0]], "four numbers"),
    ],
)
def test_pins_that_cannot_be(pins: list[list[float]], message: str) -> None:
    square = polygon(np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]))
    with pytest.raises(OptionError, match=message):
        correspond(square, square, np.array(pins))


def test_outlines_that_cannot_be() -> None:
    good = polygon(star(1))
    flat = polygon(np.array([[0.0, 0.0], [1.0, 1.0], [2.0, 2.0]]))
    with pytest.raises(OutlineError, match="target outline encloses no area"):
        correspond(good, flat)
    with pytest.raises(OutlineError, match="source outline is open"):
        correspond(Outline(good.curves[:-1], closed=False), good)
