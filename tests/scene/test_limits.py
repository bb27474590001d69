"""Where the limits of scenes lie: each case is looked at over a range across its limit."""

from collections.abc import Mapping, Sequence
from itertools import pairwise

import numpy as np

from shapetween.base.arrays import Points
from shapetween.geometry.bezier import line_curves
from shapetween.model.outline import Outline
from shapetween.model.paint import Colour, Style
from shapetween.model.part import CurveTrack
from shapetween.scene.assign import Role, Roles, _cheapest, _nearly_same, alike_in_place
from shapetween.scene.backdrops import backdrops
from shapetween.scene.borders import Bordered, bordered_tracks
from shapetween.scene.items import Item
from shapetween.scene.motion.tracks import Blend
from shapetween.scene.relations import Scene, perceive
from tests.baseline import assert_known

VIEW = np.array([[0.0, 0.0], [100.0, 100.0]])


def item(points: Points, colour: Colour | None = None) -> Item:
    ring = Outline(line_curves(points, np.roll(points, -1, axis=0))).clockwise()
    return Item((ring,), Style(colour or Colour(0.2, 0.2, 0.2)))


def box(x: float, y: float, width: float, height: float) -> Points:
    return np.array([[x, y], [x + width, y], [x + width, y + height], [x, y + height]])


def scene(*shapes: Points, colours: tuple[Colour, ...] = ()) -> Scene:
    paints: Sequence[Colour | None] = colours or [None] * len(shapes)
    return perceive([item(p, c) for p, c in zip(shapes, paints, strict=True)], VIEW)


def paired(count: int) -> Roles:
    return Roles(tuple(Role(k, k, 0.0, "matched") for k in range(count)), (), ())


def strips(count: int, gap: float = 0.0) -> list[Points]:
    """Parts of a trapezium, one beside the other, so far apart."""
    edges = np.linspace(10, 90, count + 1)
    return [
        np.array(
            [[a + gap, 20 + 0.1 * a], [b, 20 + 0.1 * b], [b, 80 - 0.2 * b], [a + gap, 80 - 0.2 * a]]
        )
        for a, b in pairwise(edges)
    ]


def shared(
    one: Scene, other: Scene, tracks: Mapping[int, Sequence[CurveTrack]] | None = None
) -> int:
    """How many tracks of pairs, in order, share their borders."""
    count = min(len(one.items), len(other.items))
    every: Mapping[int, Sequence[CurveTrack]] = tracks or dict.fromkeys(range(count), ())
    return len(bordered_tracks(one, other, paired(count), every))


def test_which_areas_share_their_borders_is_known() -> None:
    gaps = [
        shared(scene(*strips(3, gap)), scene(*strips(3))) for gap in np.geomspace(5e-3, 0.5, 30)
    ]
    counts = [shared(scene(*strips(n)), scene(*strips(n))) for n in (12, 13, 24, 25, 48)]
    others = []
    for size in np.linspace(2.0, 60.0, 24):
        beside = box(0, 100, size, size)
        others.append(shared(scene(*strips(3), beside), scene(*strips(3))))
    turned = []
    centres = np.zeros((2, 2))
    one = scene(*strips(2))
    (ring,) = bordered_tracks(one, one, paired(2), {0: (), 1: ()})[0]
    assert isinstance(ring, Bordered)
    run = ring.runs[0][0]
    for turn in np.linspace(0.05, 0.9, 24):
        track = Blend(run.pieces, centres, turn)
        turned.append(shared(one, one, {0: (track,), 1: ()}))
    figures = [sum(map(bool, each)) for each in (gaps, others, turned)]
    assert_known("scene", "borders", [*map(float, figures), *map(float, counts)])


def test_what_is_the_same_in_both_drawings_is_known() -> None:
    still = box(70, 70, 25, 25)
    found = np.zeros(8)
    for step in np.geomspace(1e-3, 1.0, 60):
        first = scene(box(20, 20, 20, 20), still)
        for k, changed in enumerate(
            (
                box(20 + 30 * step, 20, 20, 20),
                box(20 - 5 * step, 20 - 5 * step, 20 + 10 * step, 20 + 10 * step),
                np.array([[20, 20], [40, 20], [40 + 9 * step, 40 - 9 * step], [20, 40]]),
            )
        ):
            second = scene(changed, still)
            never = np.zeros((2, 2), dtype=bool)
            found[k] += (0, 0) in alike_in_place(first, second, never, {})
            found[k + 3] += bool(_nearly_same(first, second)[0, 0])
        grey = Colour(0.2 + 0.3 * step, 0.2, 0.2)
        second = scene(box(20, 20, 20, 20), still, colours=(grey, Colour(0.2, 0.2, 0.2)))
        found[6] += (0, 0) in alike_in_place(first, second, np.zeros((2, 2), dtype=bool), {})
        found[7] += bool(_nearly_same(first, second)[0, 0])
    assert_known("scene", "the same", found.tolist())


def test_which_cards_stay_is_known() -> None:
    card, thing = box(30, 30, 40, 40), box(42, 42, 16, 16)
    ways, sizes = 0.0, 0.0
    for step in np.geomspace(1e-2, 1.0, 60):
        ways += len(backdrops(scene(card, thing), scene(card + 10 * step, thing), paired(2)))
        grown = box(30, 30, 40 * (1 + step), 40 * (1 + step)) - 20 * step
        sizes += len(backdrops(scene(card, thing), scene(grown, thing), paired(2)))
    assert_known("scene", "cards", [ways, sizes])


def test_which_costs_are_equal_is_known() -> None:
    """Two pairs of which each costs more by a little than in the other order."""
    crossed = 0
    for more in np.geomspace(1e-9, 1e-1, 60):
        costs = np.array([[0.3 + more, 0.3], [0.3, 0.3 + more]])
        found = _cheapest(costs, np.ones(2), np.ones(2))
        crossed += int(found.second[found.first == 0][0])
    assert_known("scene", "equal costs", [float(crossed)])
