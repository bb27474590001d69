"""Strokes under transforms that are uneven, outlined."""

import numpy as np
import pytest

from shapetween.model.drawing import Drawing
from shapetween.model.outline import Outline
from shapetween.model.paint import Colour, Stroke
from shapetween.svg.read.reader import read_svg
from shapetween.svg.read.stroked import MOST_PIECES, stroke_rings

STROKE = Stroke(Colour(), 2.0)


def read(body: str) -> Drawing:
    root = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100">'
    return read_svg(f"{root}{body}</svg>".encode(), "a.svg")


def area(rings: tuple[Outline, ...]) -> float:
    return abs(sum(ring.area for ring in rings))


def line(*points: tuple[float, float], closed: bool = False) -> Outline:
    corners = np.array(points, float)
    after = np.roll(corners, -1, axis=0) if closed else corners[1:]
    before = corners if closed else corners[:-1]
    thirds = np.linspace(0, 1, 4)[:, None]
    return Outline((1 - thirds) * before[:, None] + thirds * after[:, None], closed)


def test_a_stretched_stroke_is_an_area_and_nothing_is_said() -> None:
    drawing = read(
        '<path d="M5 20H25V80" transform="scale(3 1)" fill="none" stroke="#06c" stroke-width="8"/>'
    )
    assert drawing.warnings == ()
    (shape,) = drawing.shapes
    assert shape.style.stroke is None
    # Lying, as far as the corner's tip, and standing below that, three times as wide.
    assert area(shape.rings) == pytest.approx(3 * (24 * 8 + 56 * 8), rel=1e-6)
    assert len(shape.rings[0].curves) == 6


def test_a_stretched_ring_keeps_its_curves() -> None:
    drawing = read(
        '<circle cx="50" cy="25" r="15" transform="scale(1 2)" fill="#fc0" stroke="#06c"/>'
    )
    fill, ring = drawing.shapes
    assert fill.style.stroke is None
    assert len(ring.rings) == 2
    assert sum(len(each.curves) for each in ring.rings) <= 24
    assert area(ring.rings) == pytest.approx(2 * np.pi * (15.5**2 - 14.5**2), rel=2e-3)


@pytest.mark.parametrize(
    ("stroke", "expected"),
    [
        # Two arms of 10 by 2, less what they share, and what the join adds.
        ({"join": "miter"}, 40.0),
        ({"join": "bevel"}, 39.5),
        ({"join": "round"}, 39 + np.pi / 4),
        ({"join": "miter", "miter_limit": 1.2}, 39.5),
        ({"cap": "square"}, 44.0),
        ({"cap": "round"}, 40 + np.pi),
        # Dashes of 4 at 0, 6, 12 and 18, the last cut off; the corner lies in a gap.
        ({"dashes": (4.0, 2.0)}, 28.0),
        # At 2, 8 and 14; one runs round the corner.
        ({"dashes": (4.0, 2.0), "dash_offset": 4.0}, 24.0),
    ],
)
def test_joins_caps_and_dashes(stroke: dict[str, object], expected: float) -> None:
    corner = line((0, 0), (10, 0), (10, 10))
    rings = stroke_rings([corner], Stroke(Colour(), 2.0, **stroke))  # type: ignore[arg-type]
    assert rings is not None
    assert area(rings) == pytest.approx(expected, rel=2e-3)


def test_dots_are_painted_by_their_caps_alone() -> None:
    dot = Outline(np.zeros((1, 4, 2)), closed=False)
    found = {cap: stroke_rings([dot], Stroke(Colour(), 2.0, cap=cap)) for cap in ("butt", "round")}
    assert found["butt"] == ()
    assert found["round"] is not None
    assert area(found["round"]) == pytest.approx(np.pi, rel=1e-3)


def test_what_takes_seconds_keeps_its_mean_width_and_is_told() -> None:
    points = [(float(k), float(k % 2)) for k in range(MOST_PIECES)]
    assert stroke_rings([line(*points)], STROKE) is None
    text = "L".join(f"{x / 50} {y}" for x, y in points)
    drawing = read(f'<path d="M{text}" transform="scale(1 50)" fill="none" stroke="#06c"/>')
    assert any("uneven scale" in warning for warning in drawing.warnings)
    assert drawing.shapes[0].style.stroke is not None
