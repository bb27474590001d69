"""Icons of outlined strokes move like strokes: exact at both ends, of one width on the way."""

from itertools import pairwise

import numpy as np
import pytest
import shapely

from shapetween.model.drawing import Box, Drawing, Shape
from shapetween.model.outline import Outline
from shapetween.model.paint import Colour, Stroke, Style
from shapetween.pipeline import Options, prepare
from shapetween.scene.items import Item, items_of
from shapetween.scene.strokes.contour import stroke_rings
from shapetween.scene.strokes.cuts import opened_ring, parted_ring
from shapetween.scene.strokes.outlined import as_lines
from tests.scene.strokes import arc, flat, painted, polyline, region_of
from tests.scene.test_centrelines import ARROW, CHECK, CROSS, GLASS, PLUS, RING, SHACKLE

WIDTH = 1.6
INK = Style(fill=Colour(), fill_rule="evenodd")


def icon(*strokes: list[Outline]) -> Drawing:
    """Strokes with their own outlines as areas, one shape each."""
    shapes = []
    for lines in strokes:
        region = region_of(painted(lines, WIDTH, quarter=8))
        shapes.append(Shape((region.outer, *region.holes), INK))
    return Drawing(tuple(shapes), Box(0, 0, 24, 24))


def shown(drawing: Drawing) -> shapely.Geometry:
    """What is seen of a drawing of areas filled by the rule nonzero or even-odd."""
    areas = []
    for shape in drawing.shapes:
        if shape.style.opacity < 0.5:
            continue
        rings = [shapely.Polygon(flat(ring.curves, 12).round(7)) for ring in shape.rings]
        outers = [r for r, ring in zip(rings, shape.rings, strict=True) if ring.area > 0]
        holes = [r for r, ring in zip(rings, shape.rings, strict=True) if ring.area <= 0]
        if shape.style.fill_rule == "evenodd":
            outers, holes = rings[:1], rings[1:]
        valid = [
            [shapely.make_valid(p, method="structure") for p in row] for row in (outers, holes)
        ]
        areas.append(shapely.union_all(valid[0]).difference(shapely.union_all(valid[1])))
    return shapely.union_all(areas)


PAIRS = {
    "menu to cross": (icon(*[[polyline((4, y), (20, y))] for y in (6, 12, 18)]), icon(CROSS)),
    "check to cross": (icon(CHECK), icon(CROSS)),
    "plus to minus": (icon(PLUS), icon([polyline((4, 12), (20, 12))])),
    "magnifier to cross": (icon(GLASS), icon(CROSS)),
    "arrow to check": (icon(ARROW), icon(CHECK)),
    "ring to shackle": (icon(RING), icon(SHACKLE)),
}


@pytest.mark.parametrize("name", PAIRS)
def test_ends_are_drawn_exactly(name: str) -> None:
    pair = PAIRS[name]
    movement = prepare(*pair, Options()).movement
    for drawing, wanted in zip(movement.at(np.array([0.0, 1.0])), pair, strict=True):
        area = shown(wanted)
        assert shown(drawing).symmetric_difference(area).area < 2e-3 * area.area


@pytest.mark.parametrize("name", ["menu to cross", "check to cross", "arrow to check"])
def test_no_place_is_thinner_than_the_stroke(name: str) -> None:
    movement = prepare(*PAIRS[name], Options()).movement
    for drawing in movement.at(np.linspace(0.1, 0.9, 9)):
        area = shown(drawing)
        # What is thinner than half a stroke would vanish here: only caps may.
        opened = area.buffer(-WIDTH / 4).buffer(WIDTH / 4, quad_segs=16)
        assert opened.area > 0.97 * area.area


@pytest.mark.parametrize("name", ["check to cross", "arrow to check"])
def test_strokes_that_would_swell_as_areas_move_as_lines(name: str) -> None:
    movement = prepare(*PAIRS[name]).movement
    for frame in movement.at(np.linspace(0, 1, 9)):
        # Lines that meet at an acute angle on the way are a little deeper than any crossing.
        assert shown(frame).buffer(-0.8 * WIDTH).area < 0.2 * WIDTH**2


def test_strokes_that_keep_their_width_as_areas_stay_areas() -> None:
    tee = [polyline((4, 5), (20, 5)), polyline((12, 5), (12, 20))]
    why = [polyline((4, 5), (12, 12), (20, 5)), polyline((12, 12), (12, 20))]
    assert len(prepare(icon(tee), icon(why)).movement.parts) == 1


def test_a_plus_keeps_its_level_bar() -> None:
    movement = prepare(*PAIRS["plus to minus"], Options()).movement
    bar = painted([polyline((4, 12), (20, 12))], WIDTH)
    for drawing in movement.at(np.linspace(0, 1, 7)):
        assert bar.difference(shown(drawing)).area < 2e-3 * bar.area


def test_areas_become_areas() -> None:
    heart = region_of(shapely.Point(12, 12).buffer(9))
    other = Drawing((Shape((heart.outer,), INK),), Box(0, 0, 24, 24))
    items = [items_of(drawing.shapes, "")[0] for drawing in (icon(PLUS), other)]
    assert [len(side) for side in as_lines(*items)] == [1, 1]
    strokes = items_of((Shape((polyline((0, 0), (9, 9)),), Style(None, Stroke(Colour(), 1))),), "")[
        0
    ]
    assert len(as_lines(items[0], strokes)[0]) == 2


def test_translucent_areas_stay_whole() -> None:
    item = items_of(icon(CROSS).shapes, "")[0][0]
    thin = Item(item.rings, Style(fill=Colour(0, 0, 0, 0.5)))
    assert as_lines((thin,), (item,))[0] == (thin,)


def test_a_ring_is_cut_open_where_its_line_starts() -> None:
    ring = arc((12, 12), 8, 0, 4)
    rings = stroke_rings(ring, WIDTH, "butt", "round")
    opened = opened_ring(Outline(ring.curves, closed=False), rings)
    assert opened is not None
    assert opened.area == pytest.approx(abs(rings[0].area + rings[1].area))
    assert len(opened.curves) == len(rings[0].curves) + len(rings[1].curves) + 2


@pytest.mark.parametrize("node", [1, 2])
def test_a_stroke_is_cut_with_its_line(node: int) -> None:
    line = polyline((0, 0), (10, 0), (10, 8), (2, 9))
    (ring,) = stroke_rings(line, WIDTH, "round", "round")
    parts = parted_ring(line, ring, node)
    assert parts is not None
    assert sum(part.area for part in parts) == pytest.approx(ring.area, rel=1e-6)
    for part, half in zip(parts, (line.curves[:node], line.curves[node:]), strict=True):
        body = shapely.LineString([half[0, 0], *half[:, 3]]).buffer(WIDTH / 2 * 1.5)
        assert shapely.Polygon(flat(part.curves)).buffer(0).difference(body).area < 1e-9
        assert all((one[3] == other[0]).all() for one, other in pairwise(part.curves))


@pytest.mark.parametrize("other", [CROSS, CHECK])
def test_a_letter_that_runs_into_itself_is_drawn_whole(other: list[Outline]) -> None:
    bowls = [polyline((5, 12), (14, 12), (18, 15), (18, 18), (14, 21), (5, 21), (5, 3), (13, 3))]
    upper = [polyline((13, 3), (17, 6), (17, 9), (14, 12))]
    pair = icon(bowls + upper), icon(other)
    movement = prepare(*pair, Options()).movement
    for drawing, wanted in zip(movement.at(np.array([0.0, 1.0])), pair, strict=True):
        area = shown(wanted)
        assert shown(drawing).symmetric_difference(area).area < 2e-3 * area.area
