"""Groups leave their opacity to their shapes, and what else they do is told of."""

from dataclasses import replace

import numpy as np

from shapetween.formats.plain import colour_losses, group_losses, plain_style
from shapetween.model.drawing import Box, Shape
from shapetween.model.effects import Filter, Group, Mask, Primitive
from shapetween.model.movement import Movement
from shapetween.model.outline import Outline
from shapetween.model.paint import Colour, Gradient, Stop, Style
from tests.movements import circle, formula_part, spin

RING = circle(np.array([50.0, 50.0]), 30.0)


def movement(*styles: Style) -> Movement:
    parts = tuple(formula_part(RING, spin(0.2), style, style, "ring") for style in styles)
    return Movement(parts, Box(0, 0, 100, 100))


def test_opacities_multiply() -> None:
    groups = (Group(1, opacity=0.5), Group(2, opacity=0.5))
    assert plain_style(Style(opacity=0.8, groups=groups)) == Style(opacity=0.2)


def test_what_a_group_does_is_told_of_once() -> None:
    blur = Filter((Primitive("feGaussianBlur", ()),), (0, 0, 1, 1), True, True, (1, 0, 0, 1, 0, 0))
    mask = Mask((Shape((Outline(RING),), Style()),))
    whole = Group(1, blend="multiply", filter=blur, masks=(mask,))
    assert group_losses([movement(Style(groups=(whole,)))], ".css") == [
        "ring: its mask is left out in .css",
        "ring: its filter is left out in .css",
        "ring: its blend mode is left out in .css",
    ]
    fading = Style(groups=(Group(1, opacity=0.5),))
    assert group_losses([movement(fading)], ".css") == []
    told = ["shapes of one group fade each by itself in .css"]
    assert group_losses([movement(fading, fading)], ".css") == told
    assert group_losses([movement(fading, replace(fading, groups=()))], ".css") == []


def test_the_pages_own_colour_is_told_of_once() -> None:
    own = Colour(reference="currentColor")
    shade = Gradient("linear", (0, 0, 1, 0), (1, 0, 0, 1, 0, 0), (Stop(0, own), Stop(1, Colour())))
    told = ["the page's own colour, currentColor, is fixed in Lottie"]
    assert colour_losses([movement(Style(own), Style(own))], "Lottie") == told
    assert colour_losses([movement(Style(Colour()), Style(shade))], "Lottie") == told
    assert colour_losses([movement(Style(Colour()))], "Lottie") == []


def test_all_of_the_pages_own_colours_are_named() -> None:
    first, second = Colour(reference="var(--accent, #f00)"), Colour(reference="currentColor")
    told = ["the page's own colours, var(--accent, #f00), currentColor, are fixed in .xml"]
    moving = [movement(Style(first), Style(second), Style(first))]
    assert colour_losses(moving, ".xml") == told
