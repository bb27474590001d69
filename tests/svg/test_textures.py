"""Patterns and pictures as textures: what they hold, and what they must not."""

import pytest

from shapetween.model.paint import Colour, Texture
from shapetween.svg.read.reader import read_svg
from shapetween.svg.textures import LOST_IN_PATTERN

SQUARE = '<path id="s" fill="url(#p)" d="M0 0H9V9H0Z"/>'


def read(body: str, **found: str) -> list[Texture | None]:
    text = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 10 10">{body}</svg>'
    drawing = read_svg(text.encode(), "it", pictures=found.get)
    return [shape.style.texture for shape in drawing.shapes]


def test_only_shapes_with_patterns_have_textures() -> None:
    plain, patterned = read('<path d="M0 0H9V9Z"/>' + SQUARE + '<pattern id="p"/>')
    assert plain is None
    assert patterned is not None
    assert patterned.name == "it"


def test_nothing_outside_the_file_is_named() -> None:
    (texture,) = read(
        SQUARE + '<pattern id="p"><image href="near.png"/><image href="far.png"/>'
        '<use href="other.svg#x"/><use href="#y"/>'
        '<image xmlns:x="http://www.w3.org/1999/xlink" x:href="/etc/passwd"/></pattern>',
        **{"near.png": "data:image/png;base64,AAAA"},
    )
    assert texture is not None
    assert "base64,AAAA" in texture.definitions
    assert "#y" in texture.definitions
    for address in ("far.png", "other.svg", "passwd"):
        assert address not in texture.definitions


def test_without_pictures_a_grey_stands_for_a_pattern_that_holds_one() -> None:
    tile = '<pattern id="p" width="1" height="1"><image href="a.png"/></pattern>'
    text = f'<svg xmlns="http://www.w3.org/2000/svg">{SQUARE}{tile}</svg>'
    drawing = read_svg(text.encode(), "it")
    assert drawing.shapes[0].style.texture is None
    assert drawing.shapes[0].style.fill == Colour(0.5, 0.5, 0.5)
    assert drawing.warnings == (
        "a pattern was replaced by a plain colour; written as .webp, .png, .gif or .mp4 it is kept",
    )


@pytest.mark.parametrize("size", ['width="4"', 'width="0" height="3"', ""])
def test_pictures_without_a_size_are_not_drawn(size: str) -> None:
    assert read(f'<image href="a.png" {size}/><path d="M0 0H9V9Z"/>', **{"a.png": "data:x"}) == [
        None
    ]


def test_an_image_that_a_pattern_lacks_is_told() -> None:
    tile = '<pattern id="p"><image href="near.png"/><image href="far.png"/></pattern>'
    text = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 10 10">{SQUARE}{tile}</svg>'
    found = {"near.png": "data:image/png;base64,AAAA"}
    (told,) = read_svg(text.encode(), "it", pictures=found.get).warnings
    assert told.startswith(LOST_IN_PATTERN)
    assert "far.png" in told
