"""Patterns: their tiles as shapes, whatever units they are in, and what they are on the whole."""

import numpy as np
import pytest

from shapetween.model.drawing import Drawing
from shapetween.model.paint import Colour, Pattern
from shapetween.svg.read.reader import read_svg

HALF = '<path d="M0 0H5V10H0Z" fill="#f00"/>'
SQUARE = '<path fill="url(#p)" d="M20 20H60V60H20Z"/>'


def read(pattern: str, body: str = SQUARE) -> Drawing:
    text = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100">{pattern}{body}</svg>'
    return read_svg(text.encode(), "it")


def pattern_in(pattern: str, body: str = SQUARE) -> Pattern:
    found = read(pattern, body).shapes[0].style.pattern
    assert found is not None
    return found


def test_a_tile_is_read_in_user_units() -> None:
    found = pattern_in(
        f'<pattern id="p" x="1" width="10" height="10" patternUnits="userSpaceOnUse" '
        f'patternTransform="translate(3 4)">{HALF}</pattern>'
    )
    assert found.tile == (10.0, 10.0)
    assert found.matrix == (1.0, 0.0, 0.0, 1.0, 4.0, 4.0)
    (shape,) = found.shapes
    np.testing.assert_allclose(shape.rings[0].box, [[0, 0], [5, 10]])


def test_a_tile_is_a_share_of_the_box() -> None:
    found = pattern_in(
        '<pattern id="p" x="10%" y=".5" width=".25" height="50%" '
        'patternContentUnits="objectBoundingBox"><path d="M0 0H.1V.2"/></pattern>'
    )
    np.testing.assert_allclose(found.tile, (0.25, 0.5))
    np.testing.assert_allclose(found.matrix, (40, 0, 0, 40, 24, 40))
    np.testing.assert_allclose(found.shapes[0].rings[0].box, np.array([[0, 0], [0.1, 0.2]]))


def test_a_view_box_is_fitted_into_the_tile_and_parts_are_taken_from_others() -> None:
    found = pattern_in(
        f'<pattern id="q" viewBox="0 0 10 20">{HALF}</pattern>'
        '<pattern id="p" href="#q" width="20" height="20" patternUnits="userSpaceOnUse"/>'
    )
    assert found.tile == (20.0, 20.0)
    assert found.matrix == (1.0, 0.0, 0.0, 1.0, 0.0, 0.0)
    # In the middle of the tile, which is twice as wide.
    np.testing.assert_allclose(found.shapes[0].rings[0].box, [[5, 0], [10, 10]])


def test_the_fill_is_the_mean_of_the_tile() -> None:
    tile = '<pattern id="p" width="10" height="10" patternUnits="userSpaceOnUse">{}</pattern>'
    fill = read(tile.format(HALF)).shapes[0].style.fill
    assert fill == Colour(1.0, 0.0, 0.0, 0.5)
    white = '<path d="M0 0H10V10H0Z" fill="#fff"/>'
    fill = read(tile.format(white + HALF)).shapes[0].style.fill
    assert isinstance(fill, Colour)
    # Half of the light of white is seen as a brighter grey than the half of its number.
    assert fill.green == pytest.approx(0.735, abs=0.01)
    assert fill.alpha == 1.0


@pytest.mark.parametrize(
    "pattern",
    [
        '<pattern id="p" width="10" height="10"/>',
        f'<pattern id="p" width="0" height="10">{HALF}</pattern>',
        f'<pattern id="p" width="1" height="1" patternTransform="scale(0)">{HALF}</pattern>',
        '<pattern id="p" width="1" height="1"><path fill="url(#p)" d="M0 0H9V9"/></pattern>',
    ],
)
def test_a_pattern_that_shows_nothing_is_no_paint(pattern: str) -> None:
    shapes = read(pattern, SQUARE + '<path d="M0 0H9V9"/>').shapes
    assert len(shapes) == 1
    assert shapes[0].style.pattern is None


def test_what_cannot_be_written_again_is_its_mean_and_told() -> None:
    soft = '<filter id="f"><feGaussianBlur stdDeviation="1"/></filter>'
    tile = f'<pattern id="p" width="1" height="1"><g filter="url(#f)">{HALF}</g></pattern>'
    drawing = read(soft + tile)
    assert drawing.shapes[0].style.pattern is None
    assert isinstance(drawing.shapes[0].style.fill, Colour)
    assert any("pattern was replaced" in warning for warning in drawing.warnings)
