"""A line round an area that the other drawing has without one keeps to the area's edge."""

import numpy as np
import pytest
import shapely

import shapetween as st
from shapetween.geometry.bezier import flatten
from shapetween.model.drawing import Drawing, Shape
from shapetween.model.outline import Outline
from shapetween.model.paint import Colour, Stroke, Style
from tests.drawings import area, drawing, ring
from tests.movements import circle, ellipse

RED, GREEN = Colour(0.8, 0.2, 0.2), Colour(0.2, 0.7, 0.2)


def round_it(outline: Outline) -> Shape:
    return Shape((outline,), Style(None, Stroke(Colour(), 3.0)))


def lined(*outlines: tuple[Outline, Colour], reverse: bool = False) -> Drawing:
    """Areas, and above all of them a line round each."""
    areas = [area(outline, colour=colour) for outline, colour in outlines]
    lines = [round_it(o.reversed() if reverse else o) for o, _ in outlines]
    return drawing(*areas, *lines)


def flat(*outlines: tuple[Outline, Colour]) -> Drawing:
    return drawing(*(area(outline, colour=colour) for outline, colour in outlines))


BODY = Outline(circle(np.array([40.0, 55.0]), 30.0))
WIDE = Outline(ellipse((45.0, 60.0), (40.0, 22.0)))
HOUSE = ring([(15.0, 45), (45, 12), (75, 45), (70, 90), (20, 90)])
DOT = Outline(circle(np.array([85.0, 15.0]), 8.0))


def edges(frame: Drawing) -> list[shapely.Geometry]:
    found = []
    for shape in frame.shapes:
        curves = shape.rings[0].curves
        points = np.concatenate([flatten(curves, 32).reshape(-1, 2), curves[-1:, 3]])
        found.append(shapely.LinearRing(points))
    return found


@pytest.mark.parametrize("reverse", [False, True])
@pytest.mark.parametrize(("one", "other"), [(BODY, WIDE), (BODY, HOUSE)])
def test_the_line_runs_along_the_edge_at_every_time(
    one: Outline, other: Outline, *, reverse: bool
) -> None:
    come = st.morph(
        flat((one, RED), (DOT, GREEN)), lined((other, RED), (DOT, GREEN), reverse=reverse)
    )
    go = st.morph(
        lined((other, RED), (DOT, GREEN), reverse=reverse), flat((one, RED), (DOT, GREEN))
    )
    for moved, times in ((come, (0.3, 0.5, 0.8, 1.0)), (go, (0.0, 0.2, 0.4))):
        for t in times:
            frame = moved.at(t)
            lines = [k for k, shape in enumerate(frame.shapes) if shape.style.stroke is not None]
            assert len(lines) == 2
            found = edges(frame)
            for line, fill in zip(lines, (0, 1), strict=True):
                assert frame.shapes[fill].style.fill is not None
                assert shapely.hausdorff_distance(found[line], found[fill]) < 0.02


def test_it_is_the_drawing_s_own_at_its_end() -> None:
    second = lined((HOUSE, RED), (DOT, GREEN), reverse=True)
    last = edges(st.morph(flat((BODY, RED), (DOT, GREEN)), second).at(1.0))
    for own, shown in zip(edges(second), last, strict=True):
        assert shapely.hausdorff_distance(own, shown) < 1e-9


def test_a_line_beside_the_edge_stays_as_far_from_it() -> None:
    inner = Outline(circle(np.array([40.0, 55.0]), 29.4))
    second = drawing(area(BODY, colour=RED), area(DOT, colour=GREEN), round_it(inner))
    frame = st.morph(flat((WIDE, RED), (DOT, GREEN)), second).at(0.6)
    found = edges(frame)
    line = next(k for k, shape in enumerate(frame.shapes) if shape.style.stroke is not None)
    assert shapely.hausdorff_distance(found[line], found[0]) == pytest.approx(0.6, abs=0.15)
