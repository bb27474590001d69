"""Parts that ride: what they show of themselves in time."""

from dataclasses import replace

import numpy as np
import pytest

from shapetween import report
from shapetween.attach.nearby import Parts
from shapetween.attach.planes import AffinePlane
from shapetween.attach.riders import riding
from shapetween.elastic.aboard import LonePart, RidingPart, ShownPart
from shapetween.model.drawing import Drawing
from shapetween.model.paint import Colour
from shapetween.pipeline import Prepared
from shapetween.svg.write.smil import smil_svg
from tests.drawings import BOX, area, drawing, line, ring, square
from tests.elastic.whole import prepare_elastic

RED, BLUE, GREEN = Colour(1, 0, 0), Colour(0, 0, 1), Colour(0, 1, 0)
ENDS = np.array([0.0, 1.0])


@pytest.fixture(scope="module")
def swapped() -> Prepared:
    """A large and a small square; the small one goes from above to below the large one."""
    large, small = area(square(20, 20, 60), colour=RED), area(square(70, 70, 25), colour=BLUE)
    return prepare_elastic(drawing(large, small), Drawing((small, large), BOX))


def test_what_cannot_be_painted_in_one_place_takes_turns(swapped: Prepared) -> None:
    below, middle, above = swapped.movement.parts
    assert isinstance(below, ShownPart)
    assert isinstance(middle, RidingPart)
    assert isinstance(above, ShownPart)
    for t, (under, over) in ((0.0, (None, BLUE)), (0.4, (None, BLUE)), (0.6, (BLUE, None))):
        assert below.style(t).fill == under
        assert above.style(t).fill == over
    assert below.style(1.0).fill == BLUE
    np.testing.assert_array_equal(below.curves(ENDS), above.curves(ENDS))


def test_the_half_that_is_not_shown_is_written_without_paint(swapped: Prepared) -> None:
    text = smil_svg(swapped.movement)
    assert text.count("<path") >= 3
    for frame, colours in zip(swapped.movement.at(ENDS), ((RED, BLUE), (BLUE, RED)), strict=True):
        shown = [shape.style.fill for shape in frame.shapes if shape.style.fill is not None]
        assert tuple(shown) == colours


def test_a_small_patch_opens_and_a_large_one_fades() -> None:
    body = area(square(10, 10, 80), colour=RED)
    for side, fades in ((10, False), (60, True)):
        patch = area(square(20, 20, side), colour=GREEN)
        parts = prepare_elastic(drawing(body), drawing(body, patch)).movement.parts
        (lone,) = (part for part in parts if isinstance(part, LonePart))
        assert lone.fades == fades
        assert lone.style(0.5).opacity == (0.5 if fades else 1.0)
        (half,) = np.ptp(lone.curves(np.array([0.5])).reshape(1, -1, 2), axis=1)
        np.testing.assert_allclose(half, side if fades else side / 2, rtol=0.01)
        assert lone.style(1.0) == patch.style


def test_riders_that_cross_themselves_are_told() -> None:
    source = square(0, 0, 10)
    rests = AffinePlane(np.eye(2, 3), np.zeros(2))
    late, early = np.array([0.8]), np.array([0.2])
    for target, crosses in (
        (ring([(0, 0), (10, 0), (0, 10), (10, 10)]), True),
        (square(3, 4, 20), False),
    ):
        rider = riding(Parts(source.curves, target.curves, True), rests, (1.0, 1.0))
        part = RidingPart.of("", (area(source).style,) * 2, (rider,), (True,), rests)
        assert part.crossing(late).any() == crosses
        assert not part.crossing(early).any()
        drawn = replace(part, styles=(line((0, 0), (1, 1)).style,) * 2)
        assert not drawn.crossing(late).any()


def test_the_report_tells_of_riders(swapped: Prepared) -> None:
    found = report.build(swapped, "projective")["riding"]
    assert [(part["rings"], part["self_crossing"]["found"]) for part in found] == [(1, 0)] * 2
