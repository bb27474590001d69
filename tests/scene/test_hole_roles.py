"""Holes become each other by place, size and role."""

import numpy as np

from shapetween.model.outline import Outline
from shapetween.model.paint import Colour, Style
from shapetween.scene.items import Item
from shapetween.scene.motion.holes import hole_tracks
from shapetween.scene.motion.tracks import Blend
from shapetween.scene.places import Pieces
from tests.drawings import ring, square
from tests.scene.strokes import arc

INK = Style(fill=Colour())


def plate(*holes: Outline) -> Item:
    return Item((square(0, 0, 100), *holes), INK)


def disc(x: float, y: float, radius: float) -> Outline:
    return arc((x, y), radius, 0, 4)


def becomes(first: Item, second: Item) -> list[tuple[tuple[float, ...], tuple[float, ...]]]:
    """Middles of each hole at both ends."""
    outer = Blend(Pieces(first.outer.curves, second.outer.curves, True), np.zeros((2, 2)))
    found = []
    for track in hole_tracks(first, second, outer):
        ends = track.curves(np.array([0.0, 1.0]))[:, :, 0]
        middles = (ends.min(axis=1) + ends.max(axis=1)) / 2
        found.append(tuple(tuple(np.round(m, 3).tolist()) for m in middles))
    return sorted(found)  # type: ignore[arg-type]


def test_the_only_round_hole_is_the_eye_wherever_it_is() -> None:
    slot = ring([(60, 60), (90, 60), (90, 66), (60, 66)])
    first, second = plate(disc(20, 20, 5), slot), plate(disc(75, 35, 5))
    assert ((20.0, 20.0), (75.0, 35.0)) in becomes(first, second)


def test_large_holes_become_large_ones_where_both_are_near() -> None:
    small, large = square(35, 45, 4), square(55, 40, 18)
    swapped = square(38, 40, 18), square(60, 45, 4)
    pairs = becomes(plate(small, large), plate(*swapped))
    assert ((64.0, 49.0), (47.0, 49.0)) in pairs
    assert ((37.0, 47.0), (62.0, 47.0)) in pairs


def test_holes_far_apart_open_and_close() -> None:
    first, second = plate(square(5, 5, 8)), plate(square(85, 85, 8))
    assert len(becomes(first, second)) == 2
