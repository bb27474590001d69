"""Letters that are one outline each move as one area."""

from shapetween.model.drawing import Box, Drawing, Shape
from shapetween.model.paint import Colour, Style
from shapetween.pipeline import prepare
from tests.scene.strokes import painted, polyline, region_of

E = (polyline((19, 4), (7, 4), (7, 20), (19, 20)), polyline((7, 12), (17, 12)))
K = (polyline((7, 4), (7, 20)), polyline((18, 4), (8, 14)), polyline((11, 11), (18, 20)))


def test_an_e_becomes_a_k_as_one_simple_area() -> None:
    """As lines its arms would come off, shrink and overlap, which the letters do nowhere."""
    first, second = (
        Drawing(
            (Shape((region_of(painted(list(letter), 3.0, quarter=8)).outer,), Style(Colour())),),
            Box(0, 0, 24, 24),
        )
        for letter in (E, K)
    )
    found = prepare(first, second)
    assert found.scene is None
    (part,) = found.filled
    (body,) = part.bodies
    assert not body.crossing
