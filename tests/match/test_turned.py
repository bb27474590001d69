"""What is plainly the same but turned is turned, however far."""

import numpy as np
import pytest

from shapetween.base.arrays import Points
from shapetween.match import correspond
from shapetween.match.bends import bends_alike, plainly_the_same
from shapetween.match.candidate import Candidate
from shapetween.match.costs import prepare
from shapetween.match.frames import Frame, Standing, handicap
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
