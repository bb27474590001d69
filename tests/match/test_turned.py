"""What is plainly the same but turned is turned, however far."""

import numpy as np
import pytest

from shapetween.base.arrays import Points
from shapetween.match import correspond
from shapetween.match.bends import bends_alike, plainly_the_same
from shapetween.match.candidate import Candidate
from shapetween.match.costs import prepare
from shapetween.match.frames import (
    MOST_TILTED,
    Frame,
    Standing,
    handicap,
    margin_over,
    other_way_round,
    tilted_sides,
)
from tests.match.labels import labelled
from tests.match.shapes import polygon, rotation, star
from tests.match.warps import warped

#: Outlines warped, and every how many-th of them here: all take a minute.
COUNT, EVERY = 100, 4


def test_warped_and_turned_outlines_are_found_again() -> None:
    failed = [
        pair.name
        for pair in warped(COUNT, EVERY)
        if pair.failed(correspond(pair.source, pair.target))
    ]
    assert len(failed) <= 1, failed


def test_bends_are_alike_where_the_outline_is_the_same_and_nowhere_else() -> None:
    side = prepare(polygon(star(3)))
    for turn in (0.0, 2.5):
        turned = prepare(polygon(star(3)).transformed(rotation(turn)))
        away = side.samples.arcs.fraction(0, 0.0) - side.samples.start
        back = turned.samples.arcs.fraction(0, 0.0) - turned.samples.start
        even = np.linspace(0, 1, 65)
        same = Candidate(even + away, even + back, 0.0, turn)
        other = Candidate(even + away, even + back + 0.3, 0.0, turn)
        assert bends_alike(side, turned, same) == pytest.approx(1, abs=0.02)
        assert bends_alike(side, turned, other) < 0.5


@pytest.mark.parametrize(
    ("alike", "otherwise", "low", "high"),
    [
        (0.85, 0.42, 1.0, 1.0),  # bent copies on their head
        (0.67, 0.27, 0.5, 0.9),
        (0.75, 0.66, 0.0, 0.0),  # pairs of labelled drawings that stand
        (0.58, 0.23, 0.0, 0.0),
        (0.66, 0.37, 0.0, 0.3),
    ],
)
def test_copies_are_told_from_things_of_one_kind(
    alike: float, otherwise: float, low: float, high: float
) -> None:
    assert low <= plainly_the_same(alike, otherwise) <= high


def test_what_is_plainly_the_same_need_not_stand() -> None:
    upright, turned = Frame(0.0, 0.5), Frame(2.9, 0.3)
    a, b = Standing(0.5, 1.5, 0.4), Standing(0.6, 1.4, 0.5)
    plain, half, other = (
        [handicap(upright, turned, a, b, even=(stand, stand), plain=p) for stand in (False, True)]
        for p in (1.0, 0.5, 0.0)
    )
    assert plain[0] == plain[1] < 1.3
    assert plain[0] < half[0] < other[0] < other[1]
    assert plain[1] < half[1] < other[1]


def bolt(lean: float) -> Points:
    """A flash of lightning, much the same on its head, the lower end longer by `lean`."""
    upper = np.array([[0.4, -2.0], [-0.9, 0.2], [-0.1, 0.2]])
    return np.concatenate([upper, -upper * [1, 1 + lean]])


@pytest.mark.parametrize(
    ("lean", "turn"),
    [(0.0, 1.0), (0.0, 2.2), (0.02, 2.2), (0.05, 2.2), (0.15, 2.2), (0.4, 2.2)],
)
def test_what_is_much_the_same_both_ways_round_turns_less(lean: float, turn: float) -> None:
    a = polygon(bolt(lean))
    b = polygon(bolt(0.8 * lean) * [1.15, 1.0]).transformed(rotation(turn))
    found = correspond(a, b)
    assert abs(abs(found.turn) - (turn if turn < np.pi / 2 or lean > 0.08 else np.pi - turn)) < 0.25


@pytest.mark.parametrize(
    ("less", "ratio", "more"),
    [
        (0.78, 1.028, False),  # a guitar onto a hydrant: its neck comes up, not its body
        (0.79, 1.13, False),  # a tooth onto a receiver
        (0.79, 1.134, False),  # a beetle onto a spoon
        (0.80, 1.421, True),  # two brushes, one on its head
        (1.05, 1.425, True),  # two keys
        (1.45, 1.015, False),  # about a quarter either way, and hardly a difference
        (1.48, 1.027, True),  # two spanners, a quarter turn apart
        (1.57, 1.1, True),
    ],
)
def test_what_turns_on_its_head_is_to_match_clearly_better(
    less: float, ratio: float, more: bool
) -> None:
    """Cost of the lesser turn over that of the one that is half a turn from it."""
    for turn in (less, -less):
        over = other_way_round(turn)
        assert abs(over - turn) == pytest.approx(np.pi)
        assert (ratio > margin_over(over, 0.0)) == more


def test_what_is_plainly_the_same_turns_on_its_head_for_less() -> None:
    assert margin_over(2.4, 0.0) > margin_over(2.4, 0.5) > margin_over(2.4, 1.0)
    assert margin_over(2.4, 1.0) == margin_over(1.6, 0.0)


def letter(width: float, bar: float) -> Points:
    """The outline of an E, ten tall."""
    low, high, short = 5 - bar / 2, 5 + bar / 2, width - 1
    rows = (0, 0), (width, 0), (width, bar), (bar, bar), (bar, low), (short, low), (short, high)
    return np.array(
        [*rows, (bar, high), (bar, 10 - bar), (width, 10 - bar), (width, 10), (0, 10)], dtype=float
    )


def test_a_triangle_that_stands_on_its_leg_stands_while_it_becomes_a_letter() -> None:
    """It is even about its diagonal and the letter about a level line."""
    square = np.array([[0, 0], [10, 0], [10, 10], [0, 10]], dtype=float)
    for corner in range(4):
        triangle = polygon(np.delete(square, corner, axis=0))
        for width, bar in ((5, 1.2), (6, 1.6), (8, 1.2), (9, 2.0)):
            assert correspond(triangle, polygon(letter(width, bar))).turn == 0


def test_a_key_that_is_drawn_with_level_sides_is_turned_all_the_same() -> None:
    (keys,) = (pair for pair in labelled("tune") if pair.name == "lab-267")
    assert abs(correspond(keys.source, keys.target).turn) > 1.5


def test_sides_are_upright_or_level_by_a_few_degrees() -> None:
    plus = letter(7, 2.0)
    tilted = [
        tilted_sides(prepare(polygon(plus)), prepare(polygon(plus @ rotation(lean)[:, :2].T)), 0.8)
        for lean in (0.0, 0.04, 0.09, 0.11)
    ]
    assert tilted == pytest.approx([0.4, 0.4, 0.2, 0], abs=0.05)


def test_what_one_outline_loses_by_a_turn_counts_only_if_the_other_does_too() -> None:
    level = prepare(polygon(letter(7, 2.0)))
    leaning = prepare(polygon(letter(7, 2.0) @ rotation(0.8)[:, :2].T))
    assert tilted_sides(level, leaning, 0.8) == 0
    assert tilted_sides(level, level, 0.8) == MOST_TILTED
    assert tilted_sides(level, level, np.pi / 2) == pytest.approx(0, abs=0.02)
