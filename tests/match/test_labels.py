"""The matcher against landmarks set by hand, on outlines of many icon sets."""

import numpy as np

from shapetween.match import Matcher, correspond
from shapetween.model.drawing import Shape
from shapetween.model.outline import Outline
from shapetween.model.paint import Colour, Style
from shapetween.scene.items import Item, items_of
from shapetween.scene.motion.choose import corners_suffice
from tests.match.labels import labelled

#: Every how many-th pair is matched here; all of them take a minute.
EVERY = 5


def test_few_landmarks_are_wrong_either_way() -> None:
    wrong = count = turned = 0
    for pair in labelled("tune", "test", every=EVERY):
        if not len(pair.u):
            continue
        found = correspond(pair.source, pair.target)
        back = correspond(pair.target, pair.source).inverse()
        assert pair.wrong(found) == pair.wrong(back), pair.name
        count += len(pair.u)
        wrong += pair.wrong(found)
        turned += abs(pair.turn) > 40 and abs(found.turn) > 0.5
    assert count >= 200
    assert wrong <= 0.1 * count
    assert turned >= 10


def test_one_of_six_alternatives_is_nearly_always_right() -> None:
    best = count = 0
    for pair in labelled("tune", "test", every=2 * EVERY):
        if len(pair.u):
            known = Matcher(pair.source, pair.target).alternatives()
            best += min(pair.wrong(found) for found in known)
            count += len(pair.u)
    assert best <= 0.07 * count


def test_who_faces_the_other_way_and_what_is_doubtful_is_told_and_hardly_anything_else() -> None:
    told = {True: 0, False: 0}
    warned = {True: 0, False: 0}
    pairs = labelled("tune", "test", every=2)
    for pair in pairs:
        if pair.faces_other_way or len(pair.u):
            matcher = Matcher(pair.source, pair.target)
            found = matcher.match()
            told[pair.faces_other_way] += matcher.faces_other_way(found)
            if len(pair.u):
                warned[pair.wrong(found) > 0] += found.confidence == "unsure"
    opposite = np.sum([pair.faces_other_way for pair in pairs])
    assert told[True] >= 0.3 * opposite
    assert told[False] <= 0.03 * len(pairs)
    assert warned[True] > warned[False]
    assert sum(warned.values()) <= len(pairs) / 5


def item(outline: Outline) -> Item:
    ((found,), _) = items_of((Shape((outline,), Style(Colour())),), "labels")
    return found


def test_what_is_meant_turned_is_not_left_to_its_corners_which_never_turn() -> None:
    for pair in labelled("tune", "test", every=2):
        if abs(pair.turn) > 40 and not pair.wrong(correspond(pair.source, pair.target)):
            assert not corners_suffice(item(pair.source), item(pair.target)), pair.name
