"""What a browser makes of the animated file."""

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np
import pytest

from shapetween.drawing import Box
from shapetween.movement import Movement
from shapetween.paint import Colour, Gradient, Paint, Stop, Stroke, Style
from shapetween.svg.sequence import frame_svg
from shapetween.svg.smil import smil_svg
from shapetween.svg.timeline import Loop
from tests.browser import Browser, chromium, difference
from tests.movements import FormulaPart, circle, sample_movement, spin

pytestmark = pytest.mark.browser

QUARTERS = (0.0, 0.25, 0.5, 0.75, 1.0)


@pytest.fixture(scope="module")
def browser() -> Iterator[Browser]:
    with chromium() as opened:
        yield opened


#: Share of pixels, 4 of a picture's, that may differ where the browser's tiles meet.
STRAY = 1e-4


def assert_plays(
    browser: Browser,
    animated: str,
    seconds: Sequence[float],
    movement: Movement,
    t: Sequence[float],
) -> None:
    """Check that at each of the moments the animated file shows the movement at that time."""
    frames = [frame_svg(drawing) for drawing in movement.at(np.array(t, float))]
    shots = browser.pictures([animated] * len(seconds) + frames, [*seconds, *[0.0] * len(frames)])
    for played, frame, time in zip(shots, shots[len(seconds) :], t, strict=False):
        assert difference(played, frame) <= STRAY, f"another picture at t = {time}"
        assert np.abs(played - frame).mean() < 0.3, f"other colours at t = {time}"
    if len(set(t)) > 1:
        moved = max(difference(shots[0], shot) for shot in shots)
        assert moved > 10 * STRAY, "the check would not see a difference"


STOPS = (Stop(0.0, Colour(1, 1, 0)), Stop(0.4, Colour(0, 0.5, 0)), Stop(1.0, Colour(0, 0, 0.5)))
STRIPES = Gradient("linear", (10, 40, 60, 60), (1, 0, 0, 1, 0, 0), STOPS)
SLANTED = Gradient("linear", (0, 0, 1, 0), (50, 20, -30, 40, 40, 30), STOPS[:1] + STOPS[2:])
DISC = Gradient("radial", (60, 50, 30, 50, 45), (1, 0, 0, 1, 0, 0), STOPS)
OVAL = Gradient("radial", (0, 0, 1, 0.2, 0.3), (30, 10, -5, 12, 50, 50), STOPS)
TALL = Gradient("radial", (0, 0, 1, 0, 0), (8, 5, -5, 30, 50, 50), STOPS[:2])


@pytest.mark.parametrize(
    ("first", "last"),
    [
        pytest.param(Colour(1, 0, 0), Colour(0, 0, 1), id="colours"),
        pytest.param(Colour(1, 0, 0), Colour(0, 0, 1, 0.25), id="fading"),
        pytest.param(None, Colour(0, 0, 1), id="appearing"),
        pytest.param(Colour(0, 0, 1), None, id="vanishing"),
        pytest.param(Colour(1, 0, 0), STRIPES, id="colour-to-gradient"),
        pytest.param(STRIPES, SLANTED, id="linear"),
        pytest.param(replace(STRIPES, spread="reflect"), STRIPES, id="spread"),
        pytest.param(DISC, replace(DISC, points=(40, 50, 20, 45, 50)), id="radial"),
        pytest.param(OVAL, TALL, id="ellipses"),
        pytest.param(DISC, OVAL, id="circle-to-ellipse"),
        pytest.param(STRIPES, DISC, id="linear-to-radial"),
        pytest.param(STRIPES, None, id="vanishing-gradient"),
    ],
)
def test_paint_plays_as_the_frames_show_it(browser: Browser, first: Paint, last: Paint) -> None:
    movement = sample_movement(Style(first), Style(last))
    assert_plays(browser, smil_svg(movement, duration=1.0), QUARTERS, movement, QUARTERS)


def test_strokes_play_as_the_frames_show_them(browser: Browser) -> None:
    thin = Stroke(Colour(0, 0, 0), 2.0, dashes=(10.0, 4.0), dash_offset=3.0)
    thick = Stroke(STRIPES, 8.0, cap="round", join="bevel")
    part = FormulaPart(
        circle(np.array([50.0, 50.0]), 30.0),
        spin(0.25),
        Style(None, thin, opacity=0.3),
        Style(None, thick, fill_rule="evenodd"),
    )
    movement = Movement((part,), Box(0, 0, 100, 100))
    assert_plays(browser, smil_svg(movement, duration=1.0), QUARTERS, movement, QUARTERS)


@pytest.mark.parametrize(
    ("loop", "seconds", "shown"),
    [
        ("once", (0, 0.5, 1, 1.5, 2, 5), (0, 0.25, 0.5, 0.75, 1, 1)),
        ("repeat", (0, 0.5, 1.5, 2, 2.5, 5), (0, 0.25, 0.75, 0, 0.25, 0.5)),
        ("alternate", (0, 0.5, 1.5, 2, 3, 4, 5), (0, 0.25, 0.75, 1, 0.5, 0, 0.5)),
    ],
)
def test_loops(
    browser: Browser,
    loop: Loop,
    seconds: tuple[float, ...],
    shown: tuple[float, ...],
) -> None:
    # A change of kind makes the paint jump as well as run.
    movement = sample_movement(Style(STRIPES), Style(DISC))
    text = smil_svg(movement, duration=2.0, loop=loop)
    assert_plays(browser, text, seconds, movement, shown)


def test_easing_bends_time_on_both_ways(browser: Browser) -> None:
    movement = sample_movement()
    text = smil_svg(movement, duration=1.0, easing="ease-in", loop="alternate")
    # CSS's own ease-in is at 0.0935 after a quarter of its time, and at 0.6219 after three.
    early, late = 0.093465, 0.621862
    seconds = (0.25, 0.75, 1.25, 1.75)
    assert_plays(browser, text, seconds, movement, (early, late, late, early))


def test_without_motion_the_first_frame_stands_still(browser: Browser) -> None:
    movement = sample_movement(Style(OVAL, opacity=0.5), Style(TALL))
    text = smil_svg(movement, duration=2.0, loop="repeat")
    browser.reduce_motion(True)
    try:
        assert_plays(browser, text, (0.0, 1.0), movement, (0.0, 0.0))
    finally:
        browser.reduce_motion(False)
