"""When another matching than the best one is taken."""

from collections.abc import Iterator
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from shapetween.base.observe import unobserved
from shapetween.match import correspond
from shapetween.outline import alone
from shapetween.outline.alone import moved_alone
from shapetween.outline.body import Carried
from shapetween.outline.matching import match_outer, next_matches
from shapetween.outline.seen import NOT_SEEN, Seen
from shapetween.outline.unfold import unfolded
from tests.match.shapes import polygon, star

BROAD = Seen(0.1, 0.01)


@pytest.mark.parametrize(
    ("costs", "seen", "settled", "taken"),
    [
        ([1.0, 1.04], [BROAD, NOT_SEEN], False, 1),
        ([1.0, 1.06, 1.07], [BROAD, NOT_SEEN, NOT_SEEN], False, 0),
        ([1.0, 1.01, 1.02], [BROAD, BROAD, NOT_SEEN], False, 2),
        ([1.0, 1.01, 1.02, 1.03], [BROAD, BROAD, BROAD, NOT_SEEN], False, 0),
        ([1.0, 1.01], [Seen(1e-9, 1e-5), NOT_SEEN], False, 0),
        ([1.0, 1.01], [BROAD, NOT_SEEN], True, 0),
    ],
)
def test_a_matching_changes_only_for_what_is_seen_and_costs_little_more(
    monkeypatch: pytest.MonkeyPatch,
    costs: list[float],
    seen: list[Seen],
    settled: bool,
    taken: int,
) -> None:
    rings: list[Any] = [
        SimpleNamespace(matching=SimpleNamespace(cost=cost), coarse=False) for cost in costs
    ]
    tried: list[int] = []
    small = match_outer(
        polygon(star(1)), polygon(star(2)), quads=None, pins=np.zeros((0, 4)), mesh=None,
        upright=False, observe=unobserved,
    )  # fmt: skip
    body = unfolded([small], "projective")

    def moved(some: list[Any], *_: object) -> Carried:
        tried.append(rings.index(some[0]))
        return body

    def looked_at(_: Carried) -> Carried:
        return replace(body, seen=seen[tried[-1]], crossing=1 + tried[-1])

    def others(*_: object) -> Iterator[Any]:
        yield from rings[1:]

    monkeypatch.setattr(alone, "unfolded", moved)
    monkeypatch.setattr(alone, "looked_at", looked_at)
    monkeypatch.setattr(alone, "next_matches", others)
    found = moved_alone(rings[:1], "projective", None, unobserved, rough=False, decided=settled)
    assert found.crossing == 1 + taken
    assert found.other_matching == (taken > 0)


def test_others_are_matchings_of_the_whole_outlines() -> None:
    a, b = polygon(star(3)), polygon(star(4))
    first = match_outer(
        a, b, quads=None, pins=np.zeros((0, 4)), mesh=None, upright=False, observe=unobserved
    )
    second = next(next_matches(first, None, unobserved))
    assert second.matching.cost >= first.matching.cost
    assert len(second.matching.u) > len(correspond(a, b).others[0].u)
