"""How fills of several pieces and holes move, in figures that are known."""

import numpy as np
import pytest

from shapetween.base.arrays import Points
from shapetween.base.ends import End
from shapetween.base.errors import OptionError, OutlineError
from shapetween.base.observe import unobserved
from shapetween.fill.appearing import AppearingRegion
from shapetween.fill.morph import morph_fill
from shapetween.fill.pairing import Thing, pair_things
from shapetween.fill.pinned import pinned_rings
from shapetween.fill.regions import Region, regions_of
from shapetween.fill.settings import FillSettings
from shapetween.fill.small import blend_small
from shapetween.fill.splitting import split_alike
from shapetween.fill.stroking import outlined
from shapetween.model.drawing import Shape
from shapetween.model.outline import Outline
from shapetween.model.paint import Colour, Stroke, Style
from tests.baseline import assert_known
from tests.drawings import area, ring, square
from tests.match.shapes import polygon, rounded, star

TIMES = np.array([0.2, 0.5, 0.8])


def placed(points: Points, x: float, y: float, size: float) -> Outline:
    return rounded(size * points + [x, y])


def block(x: float, y: float, size: float) -> Outline:
    """No two alike: where one is another's image, matchings are equally good."""
    return polygon(size / 2 * star(int(997 * x + 89 * y + 7 * size) % 1000, 5) + [x, y])


def specks(count: int, size: float, seed: int) -> list[Outline]:
    """Blocks beside a body, ever smaller."""
    places = np.random.default_rng(seed).uniform(0, 100, (count, 2))
    return [block(x, 130 + y, size * 0.7**k) for k, (x, y) in enumerate(places.tolist())]


BODY, OTHER = placed(star(3), 50, 50, 40), placed(star(5), 52, 50, 40)

CASES = {
    "a body and islands": (
        area(BODY, *specks(7, 9.0, 1)),
        area(OTHER, *specks(7, 8.0, 2)),
    ),
    "a crowd": (
        area(*(block(12 * k, 9 * (k % 3), 8 - 0.3 * k) for k in range(8))),
        area(*(block(11 * k, 12 * (k % 2), 5 + 0.3 * k) for k in range(7))),
    ),
    "one that divides": (
        area(block(0, 0, 60)),
        area(ring([(0, 0), (26, 0), (30, 60), (0, 60)]), ring([(36, 0), (60, 0), (60, 55)])),
    ),
}


def settings(pins: Points | None = None) -> FillSettings:
    own = np.zeros((0, 4)) if pins is None else pins
    return FillSettings("projective", "prevent", None, own, (), unobserved, meshed=True)


@pytest.mark.parametrize("case", CASES)
def test_the_fill_is_known(case: str) -> None:
    track, notices = morph_fill(*CASES[case], settings(), ("a", "b"), alone=True)
    curves = track.curves(TIMES)
    weights = 1.5 + np.cos(np.arange(curves.shape[1]))
    figures = [
        float(len(track.counts)),
        float(len(notices)),
        *(curves[:, :, 1] * weights[:, None]).mean(axis=1).ravel().tolist(),
    ]
    assert_known("fill", case, figures)


def test_what_things_cost_is_known() -> None:
    """Which pieces pair, at ever other sizes, places and prices."""
    rng = np.random.default_rng(4)
    figures = []
    for _ in range(40):
        sides = [
            [Thing(rng.uniform(0, 60, 2), 12 * rng.random() + 1, rng.normal()) for _ in range(4)]
            for _ in range(2)
        ]
        found = pair_things(sides[0], sides[1], 85.0)
        figures.append(float(sum((k + 1) * (3 * i + j) for k, (i, j) in enumerate(found.pairs))))
    for low, high in (((0, 0), (9, 0.5)), ((0, 0), (9, 0.1)), ((0, 0), (2, 30))):
        figures.append(Thing.of(np.array([low, high], dtype=float)).aspect)
    assert_known("fill", "things", figures)


def test_small_contours_are_known() -> None:
    figures = []
    for seed in range(6):
        one = star(seed, 6) * [1.0, 0.3 + 0.12 * seed]
        found = blend_small(polygon(one), polygon(one[:, ::-1] * [1.2, -0.8]))
        figures += [found.angle, float(found.curves(TIMES)[1, :, 1, 0].mean())]
    assert_known("fill", "small", figures)


def test_cells_are_known() -> None:
    """A square that becomes two or more, ever more unlike, farther off and bent."""
    whole = Region(square(0, 0, 60))
    figures: list[float] = []
    for size, gap, count in ((20, 4, 2), (20, 60, 2), (9, 4, 2), (14, 3, 4), (10, 3, 5)):
        beside = [square(26 + (size + gap) * k, 5, size) for k in range(count - 1)]
        parts = [Region(ring) for ring in (square(0, 0, 24), *beside)]
        found = split_alike(whole, parts)
        figures += [0.0] if found is None else [cell.area for cell in found]
    assert_known("fill", "cells", figures)


def test_outlined_strokes_are_known() -> None:
    style = Style(None, Stroke(Colour(), 4.0, cap="round", join="round"))
    found = outlined(Shape((rounded(30 * star(2, 7)),), style))
    figures = [float(sum(len(ring.curves) for ring in found.rings)), found.rings[0].area]
    assert_known("fill", "strokes", figures)


def test_what_counts_as_a_ring_is_known() -> None:
    """Rings that overlap, run back along themselves, or are ever smaller."""
    figures: list[float] = []
    for step in (1e-5, 4e-4, 7e-4, 1.5e-3, 3e-3, 0.02):
        beside = square(100 - 100 * step, 0, 10)
        spiked = ring([(0, 0), (50, 0), (50, 50), (50 + 100 * step, 50), (50, 50), (0, 50)])
        tiny = square(20, 20, 10 * step)
        for rings in ((square(0, 0, 100), beside), (spiked,), (square(0, 0, 100), tiny)):
            try:
                regions, notices = regions_of(Shape(rings, Style(fill_rule="evenodd")), "it")
            except OutlineError:
                figures.append(-1.0)
                continue
            figures += [float(len(regions)), float(len(notices)), float(len(regions[0].holes))]
    assert_known("fill", "rings", figures)


def test_where_pins_hold_is_known() -> None:
    first = BODY, square(40, 44, 10).reversed()
    second = OTHER, square(42, 46, 12).reversed()
    figures: list[float] = []
    for off in (0.2, 1.5, 4.0, 6.0, 9.0):
        pins = np.array([[45.0, 44.0 - off, 48.0, 46.0 - off]])
        try:
            found = pinned_rings(first, second, pins)
        except OptionError:
            figures.append(-1.0)
            continue
        figures += [float(len(found.outer)), float(len(found.holes))]
    assert_known("fill", "pins", figures)


def test_where_regions_close_is_known() -> None:
    """To the centroid, or where a crescent has room."""
    figures: list[float] = []
    angle = np.linspace(0, 1.5 * np.pi, 12)
    ways = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    for inner in (0.1, 0.35, 0.5, 0.65, 0.85):
        crescent = polygon(np.concatenate([ways, inner * ways[::-1]]))
        figures += AppearingRegion.of(crescent, (), End.SOURCE, None).centre.tolist()
    for arm in (0.9, 0.8, 0.7, 0.6, 0.5, 0.4):
        corner = ring([(0, 0), (1, 0), (1, 1 - arm), (1 - arm, 1 - arm), (1 - arm, 1), (0, 1)])
        figures += AppearingRegion.of(corner, (), End.SOURCE, None).centre.tolist()
    assert_known("fill", "closing", figures)
