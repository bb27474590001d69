"""Groups leave their opacity to their shapes, and what else they do is told of."""

import json
import re
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import pytest

import shapetween as st
from shapetween.formats.plain import (
    AT_ONCE,
    PAINT_TIMES,
    colour_losses,
    group_losses,
    paint_times,
    plain_style,
)
from shapetween.model.drawing import Box, Shape
from shapetween.model.movement import Movement
from shapetween.model.outline import Outline
from shapetween.model.paint import Colour, Filter, Gradient, Group, Mask, Primitive, Stop, Style
from shapetween.model.part import shown_while
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


@pytest.fixture(scope="module")
def sun_to_moon() -> st.Morph:
    """Rays that go at once, each as a dot, in mid-way."""
    inputs = Path(__file__).resolve().parents[2] / "gallery/inputs"
    return st.morph(inputs / "icon-sun.svg", inputs / "icon-moon.svg")


def test_what_goes_at_once_is_not_seen_half_transparent(sun_to_moon: st.Morph) -> None:
    goes = [shown_while(part)[1] for part in sun_to_moon.prepared.movement.parts]
    ray = goes.index(min(goes))
    lottie = json.loads(sun_to_moon.lottie(duration=2.0))
    (layer,) = (each for each in lottie["layers"] if each["ind"] == len(goes) - ray)
    keys = [(key["t"], key["s"][0]) for key in layer["ks"]["o"]["k"]]
    (before, full), (after, none) = keys[1:3]
    assert (full, none) == (100, 0)
    assert before <= 120 * goes[ray] + 0.01 < after + 0.02
    assert after - before < 0.05
    steps = re.findall(r'"opacity":\["\$",(\[[^]]*\]),', sun_to_moon.module())
    assert len(steps) == sum(end < 1 for end in goes)
    for step in map(json.loads, steps):
        assert min(np.diff(step)) <= 2 * AT_ONCE


def test_what_fades_in_a_moment_is_looked_at_closely() -> None:
    part = replace(formula_part(RING, spin(0.2)), paint=Fading())
    times = paint_times(part)
    seen = np.array([part.style(t).opacity for t in times])
    dense = np.linspace(0.0, 1.0, 5001)
    wanted = np.array([part.style(t).opacity for t in dense])
    off = np.abs(np.interp(dense, times, seen) - wanted)
    assert off.mean() < 2e-3
    assert len(times) <= len(PAINT_TIMES) + 12


@dataclass(frozen=True)
class Fading:
    """Paint that fades in within a hundredth of the time."""

    def at(self, t: float) -> Style:
        return Style(opacity=float(np.clip((t - 0.21) / 0.01, 0.0, 1.0)))
