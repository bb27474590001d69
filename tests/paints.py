"""Pairs of styles that every format has to bring from the one to the other."""

from dataclasses import replace

import pytest

from shapetween.model.paint import Colour, Gradient, Stop, Stroke, Style

STOPS = (Stop(0.0, Colour(1, 1, 0)), Stop(0.4, Colour(0, 0.5, 0)), Stop(1.0, Colour(0, 0, 0.5)))
STRIPES = Gradient("linear", (10, 40, 60, 60), (1, 0, 0, 1, 0, 0), STOPS)
SLANTED = Gradient("linear", (0, 0, 1, 0), (50, 20, -30, 40, 40, 30), STOPS[:1] + STOPS[2:])
DISC = Gradient("radial", (60, 50, 30, 50, 45), (1, 0, 0, 1, 0, 0), STOPS)
OVAL = Gradient("radial", (0, 0, 1, 0.2, 0.3), (30, 10, -5, 12, 50, 50), STOPS)

THIN = Stroke(Colour(0, 0, 0), 2.0, dashes=(10.0, 4.0), dash_offset=3.0)
THICK = Stroke(STRIPES, 8.0, cap="round", join="bevel")
RED, BLUE = Colour(1, 0, 0), Colour(0, 0, 1)

#: Pairs that a format with all of SVG's paints shows as it does.
EVERY = [
    pytest.param(Style(RED), Style(BLUE), id="colours"),
    pytest.param(Style(RED), Style(replace(BLUE, alpha=0.25)), id="fading"),
    pytest.param(Style(None), Style(BLUE), id="appearing"),
    pytest.param(Style(RED), Style(STRIPES), id="colour-to-gradient"),
    pytest.param(Style(STRIPES), Style(SLANTED), id="linear"),
    pytest.param(Style(DISC), Style(replace(DISC, points=(40, 50, 20, 45, 50))), id="radial"),
    pytest.param(Style(STRIPES), Style(DISC), id="linear-to-radial"),
    pytest.param(
        Style(None, THIN, opacity=0.3), Style(None, THICK, fill_rule="evenodd"), id="strokes"
    ),
    pytest.param(Style(RED, replace(THIN, dashes=())), Style(BLUE, THIN), id="both"),
]

#: Those that need ovals.
OVALS = [
    pytest.param(Style(OVAL), Style(DISC), id="oval"),
]
