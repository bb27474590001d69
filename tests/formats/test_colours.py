"""Between its keyframes every format shows the colours that the movement has there."""

import re
import xml.etree.ElementTree as ET

import numpy as np
import pytest

from shapetween.base.arrays import Floats
from shapetween.formats.css import css
from shapetween.formats.lottie.writer import lottie_json
from shapetween.formats.options import WriteOptions
from shapetween.formats.table import Segments
from shapetween.model.movement import Movement
from shapetween.model.paint import Colour, Style
from shapetween.svg.write.smil import smil_svg
from tests.movements import sample_movement
from tests.smil import SVG

#: Moments, none of them a sample's.
T = np.linspace(0.003, 0.997, 211)

#: Steps of 255 by which a colour may be off: what keyframes leave out, and half a step of rounding.
OFF = 2.0

COLOURS = [
    (Colour(0.13, 0.38, 1), Colour(1, 0.56, 0.13)),
    (Colour(0.9, 0.2, 0.1), Colour(0.1, 0.7, 0.8)),
    (Colour(0.24, 0.26, 0.28), Colour(1, 0.87, 0.4)),
    (Colour(), Colour(1, 1, 1)),
]


def one(first: Colour, last: Colour) -> Movement:
    whole = sample_movement(Style(first), Style(last))
    return Movement(whole.parts[1:], whole.box)


def smil_colours(movement: Movement) -> tuple[Floats, Floats]:
    root = ET.fromstring(smil_svg(movement, easing="linear"))
    (element,) = root.findall(f".//{SVG}animate[@attributeName='fill']")
    times = [float(t) for t in element.attrib["keyTimes"].split(";")]
    texts = element.attrib["values"].split(";")
    wide = [t if len(t) == 7 else "#" + "".join(2 * c for c in t[1:]) for t in texts]
    return np.array(times), np.array([[int(t[k : k + 2], 16) for k in (1, 3, 5)] for t in wide])


def css_colours(movement: Movement) -> tuple[Floats, Floats]:
    made = css(Segments((movement,), False), WriteOptions(easing="linear")).content
    assert isinstance(made, str)
    rule = re.compile(r"^ ([\d.]+)%\{.*background-color:rgb\((\d+) (\d+) (\d+)\)", re.M)
    rows = np.array([[float(v) for v in found] for found in rule.findall(made)])
    return rows[:, 0] / 100, rows[:, 1:]


def lottie_colours(movement: Movement) -> tuple[Floats, Floats]:
    made = lottie_json(Segments((movement,)), WriteOptions(easing="linear"))[0]
    (keys,) = {id(f): f["c"]["k"] for f in fills(made)}.values()
    times = np.array([key["t"] for key in keys])
    return times / times[-1], 255 * np.array([key["s"][:3] for key in keys])


def fills(value: object) -> list[dict[str, dict[str, list[dict[str, list[float]]]]]]:
    if isinstance(value, dict):
        own = [value] if value.get("ty") == "fl" else []
        return own + [found for inner in value.values() for found in fills(inner)]
    if isinstance(value, list):
        return [found for inner in value for found in fills(inner)]
    return []


@pytest.mark.parametrize("colours", COLOURS)
@pytest.mark.parametrize("read", [smil_colours, css_colours, lottie_colours])
def test_a_format_shows_the_movements_colours(read, colours) -> None:  # type: ignore[no-untyped-def]
    movement = one(*colours)
    times, values = read(movement)
    shown = np.stack([np.interp(T, times, values[:, k]) for k in range(3)], axis=1)
    fills_there = [movement.parts[0].style(float(t)).fill for t in T]
    there = 255 * np.array([(c.red, c.green, c.blue) for c in fills_there])  # type: ignore[union-attr]
    assert np.abs(shown - there).max() <= OFF
