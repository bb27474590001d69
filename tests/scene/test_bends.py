"""Outlines that become each other by their corners."""

import numpy as np
import pytest
import shapely

from shapetween.api import morph
from shapetween.base.arrays import Floats
from shapetween.geometry.bezier import flatten
from shapetween.model.drawing import Shape
from shapetween.scene.motion.bend_knots import along_knots, ring_knots
from shapetween.scene.motion.bends import bends_of
from shapetween.scene.motion.mirrored import even_knots
from shapetween.scene.places import Places, cut_alike
from shapetween.svg.read.reader import read_svg

T = np.linspace(0, 1, 9)

#: A heart and a star that lean on nothing but their upright axis.
HEART = "M50 30C50 15 20 5 10 30C0 55 40 80 50 92C60 80 100 55 90 30C80 5 50 15 50 30Z"
STAR = "M50 5L62 38L97 38L69 59L79 93L50 73L21 93L31 59L3 38L38 38Z"
SHEET = "M15 30L35 10H85V90H15Z"
MIRRORED_SHEET = "M15 10H65L85 30V90H15Z"
DROP = "M50 10C60 30 80 45 80 65A30 30 0 0 1 20 65C20 45 40 30 50 10Z"
FLAME = "M40 8C60 30 80 45 80 65A30 30 0 0 1 20 65C20 40 42 40 40 8Z"
DISC = "M90 50A40 40 0 0 1 10 50A40 40 0 0 1 90 50Z"
CAPSULE = "M20 40H80A10 10 0 0 1 80 60H20A10 10 0 0 1 20 40Z"
CARD = "M20 10H80A10 10 0 0 1 90 20V80A10 10 0 0 1 80 90H20A10 10 0 0 1 10 80V20A10 10 0 0 1 20 10Z"
ARROW = "M50 90L20 60H40V10H60V60H80Z"
HOUSE = "M50 10L90 45V90H10V45Z"
BOX = "M10 10H90V90H10Z"


def svg(*paths: str, paint: str = "") -> bytes:
    drawn = "".join(f'<path d="{path}" {paint}/>' for path in paths)
    view = 'xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100"'
    return f"<svg {view}>{drawn}</svg>".encode()


def places(path: str) -> Places:
    (shape,) = read_svg(svg(path), "a").shapes
    return Places(shape.rings[0].clockwise())


def moved(first: str, second: str, times: Floats = T, paint: str = "") -> list[Shape]:
    found = morph(read_svg(svg(first, paint=paint), "a"), read_svg(svg(second, paint=paint), "b"))
    return [frame.shapes[0] for frame in found.prepared.movement.at(times)]


def area(shape: Shape, pieces: int = 16) -> shapely.Polygon:
    return shapely.Polygon(flatten(shape.rings[0].curves, pieces))


def corners(shape: Shape) -> int:
    line = shapely.LineString(flatten(shape.rings[0].curves, 1)).simplify(1e-6)
    return len(line.coords) - 1


@pytest.mark.parametrize(
    ("path", "sharp", "round_", "facing"),
    [(BOX, 4, 0, 0), (CARD, 0, 4, 0), (CAPSULE, 0, 4, 0), (DISC, 0, 0, 4), (DROP, 1, 0, 3)],
)
def test_corners_are_told_from_round_runs(path: str, sharp: int, round_: int, facing: int) -> None:
    bends = bends_of(places(path))
    corner = bends.facing < 0
    long = bends.ends - bends.starts > 1e-6
    assert (corner & ~long).sum() == sharp
    assert (corner & long).sum() == round_
    assert (~corner).sum() == facing


def test_a_corner_that_runs_through_the_start_is_one() -> None:
    turned = "M87.07 12.93A10 10 0 0 1 90 20V80A10 10 0 0 1 80 90H20A10 10 0 0 1 10 80V20"
    bends = bends_of(places(turned + "A10 10 0 0 1 20 10H80A10 10 0 0 1 87.07 12.93Z"))
    assert (bends.facing < 0).sum() == 4


def test_straight_edges_stay_straight() -> None:
    for shape in moved(HOUSE, BOX):
        assert corners(shape) <= 6
    for shape in moved("M50 10L90 90H10Z", "M10 10H90V90H10Z"):
        assert corners(shape) <= 5


@pytest.mark.parametrize("paint", ["", 'fill="none" stroke="#000" stroke-width="4"'])
@pytest.mark.parametrize("pair", [(HEART, STAR), (HOUSE, BOX), (DROP, DISC), (STAR, DROP)])
def test_what_is_symmetric_stays_so(pair: tuple[str, str], paint: str) -> None:
    for shape in moved(*pair, paint=paint):
        seen = area(shape, 64)
        image = shapely.transform(seen, lambda xy: xy * [-1, 1] + [100, 0])
        assert seen.symmetric_difference(image).area < 1e-6 * 100 * seen.area


def test_a_sheet_does_not_turn_to_have_its_corner_cut_elsewhere() -> None:
    for shape in moved(SHEET, MIRRORED_SHEET):
        np.testing.assert_allclose(area(shape).bounds, (15, 10, 85, 90), atol=1e-6)


def test_a_tip_stays_one_tip() -> None:
    for shape in moved(FLAME, DROP):
        bends = bends_of(Places(shape.rings[0].clockwise()))
        assert (bends.facing < 0).sum() == 1


def test_smooth_outlines_go_evenly() -> None:
    ellipse = "M95 50A45 25 0 0 1 5 50A45 25 0 0 1 95 50Z"
    u, v = ring_knots(places(DISC), places(ellipse))
    np.testing.assert_allclose(np.diff(u), np.diff(v), atol=1e-3)


def test_a_bracket_may_turn_over_and_an_area_s_bay_not() -> None:
    lines = [
        Places(read_svg(svg(path, paint='fill="none" stroke="#000"'), "a").shapes[0].rings[0])
        for path in ("M20 20H60V80H20", "M60 20H20V80H60")
    ]
    u, v, _ = along_knots(*lines)
    at = [bends_of(line).middles for line in lines]
    np.testing.assert_allclose(np.interp(at[0], u, v), at[1], atol=1e-6)
    cape, bay = places("M10 10H50L90 50L50 90H10Z"), places("M10 10H90L50 50L90 90H10Z")
    u, v = ring_knots(cape, bay)
    notch = bay.nearest(np.array([[50.0, 50.0]]))
    there = cape.nearest(np.array([[90.0, 50.0]]))
    knots = np.stack([u % 1.0, v % 1.0], axis=1)
    assert not (np.abs(knots - np.concatenate([there, notch])) < 1e-6).all(axis=1).any()


def test_a_dot_becomes_a_bar_as_a_capsule() -> None:
    paint = (
        'fill="none" stroke="#000" stroke-width="10" stroke-linecap="round" stroke-linejoin="round"'
    )
    for shape in moved("M55 50A5 5 0 0 1 45 50A5 5 0 0 1 55 50Z", "M20 50H80", T[1:-1], paint):
        seen = area(shape)
        low, high = np.array(seen.bounds).reshape(2, 2)
        # A capsule: as high in its middle as it is on the whole, and half as far from its ends.
        assert seen.area >= np.prod(high - low) - (4 - np.pi) * ((high - low)[1] / 2) ** 2 - 0.2


@pytest.mark.parametrize("pair", [(ARROW, STAR), (HEART, HOUSE), (STAR, HOUSE)])
def test_a_part_stays_symmetric_whatever_it_lies_in(pair: tuple[str, str]) -> None:
    first, second = places(pair[0]), places(pair[1])
    knots = even_knots(first, second)
    assert knots is not None
    pieces = cut_alike(first, second, *knots)
    seen = shapely.Polygon(flatten((pieces.source + pieces.target) / 2, 64))
    image = shapely.transform(seen, lambda xy: xy * [-1, 1] + [100, 0])
    assert seen.symmetric_difference(image).area < 1e-6 * seen.area


@pytest.mark.parametrize("first", ["M30 20L90 50L30 80Z", "M70 20L10 50L70 80Z"])
@pytest.mark.parametrize("backwards", [False, True])
def test_a_tip_on_the_axis_becomes_both_corners_of_a_bar(first: str, backwards: bool) -> None:
    ends = first, "M40 10H60V90H40Z"
    frames = moved(*(ends[::-1] if backwards else ends))
    assert [corners(shape) for shape in frames[1:-1]] == [4] * 7


def test_a_round_tip_on_the_axis_parts_into_round_corners() -> None:
    source, target = places("M30 20L80 44Q90 50 80 56L30 80Z"), places("M40 10H60V90H40Z")
    knots = even_knots(source, target)
    assert knots is not None
    pieces = cut_alike(source, target, *knots)
    reached = pieces.target[(np.abs(pieces.source[:, 0, 0] - 80) < 1e-6)][:, 0]
    assert np.abs(reached[:, 0] - 60).max() < 2
    assert np.abs(np.abs(reached[:, 1] - 50) - 40).max() < 2
