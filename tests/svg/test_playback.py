"""What a browser makes of the animated file."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest

from shapetween.model.drawing import Box
from shapetween.model.movement import Movement
from shapetween.model.paint import Colour, Gradient, Paint, Stop, Stroke, Style
from shapetween.svg.write.sequence import frame_svg
from shapetween.svg.write.smil import smil_svg
from shapetween.timing.timeline import Loop
from tests.browser import Browser, difference
from tests.movements import circle, formula_part, sample_chain, sample_movement, spin

pytestmark = pytest.mark.browser

QUARTERS = (0.0, 0.25, 0.5, 0.75, 1.0)


#: Share of pixels, 8 of a picture's, that may differ where the browser's tiles meet.
STRAY = 2e-4

#: Mean difference of a colour, of 255, edges included: where the kind of paint changes, and between
#: keyframes, a browser blends in another space.
TINT = 0.4


def assert_plays(
    browser: Browser,
    animated: str,
    seconds: Sequence[float],
    movement: Movement,
    t: Sequence[float],
) -> None:
    """Check that at each of the moments the animated file shows the movement at that time."""
    frames = [frame_svg(drawing) for drawing in movement.at(np.array(t, float))]
    assert_shows(browser, animated, seconds, frames)


def assert_shows(
    browser: Browser, animated: str, seconds: Sequence[float], frames: Sequence[str]
) -> None:
    """Check that at each of the moments the animated file shows the frame."""
    shots = browser.pictures(
        [animated] * len(seconds) + [*frames], [*seconds, *[0.0] * len(frames)]
    )
    for played, frame, second in zip(shots, shots[len(seconds) :], seconds, strict=False):
        assert difference(played, frame) <= STRAY, f"another picture at {second} s"
        assert np.abs(played - frame).mean() < TINT, f"other colours at {second} s"
    if len(set(frames)) > 1:
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
    part = formula_part(
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


#: Just before a joint, where nothing has moved yet that could be seen.
BLINK = 1e-4


@pytest.mark.parametrize(
    ("loop", "places"),
    [
        # Seconds, and the leg and its time that are shown; legs take 1 s, rests half of one.
        ("once", [(0.2, 0, 0), (1.2, 0, 0.7), (1.7, 1, 0), (4.5 - BLINK, 2, 1), (9.0, 2, 1)]),
        ("repeat", [(3.0 - BLINK, 1, 1), (3.0, 2, 0), (3.75, 2, 0.25), (4.5, 0, 0), (7.0, 1, 0.5)]),
        (
            "alternate",
            [(4.5, 2, 1), (5.3, 2, 0.7), (6.0 - BLINK, 2, 0), (6.0, 1, 1), (8.75, 0, 0.25)],
        ),
    ],
)
def test_a_chain_plays_without_a_gap(
    browser: Browser, loop: Loop, places: Sequence[tuple[float, int, float]]
) -> None:
    legs = sample_chain()
    text = smil_svg(*legs, duration=1.0, loop=loop, hold=0.5, closed=True)
    frames = [frame_svg(legs[leg].at(np.array([t]))[0]) for _, leg, t in places]
    assert_shows(browser, text, [second for second, _, _ in places], frames)


def test_a_chain_without_rests_goes_straight_on(browser: Browser) -> None:
    legs = sample_chain()
    text = smil_svg(*legs, duration=1.0, loop="repeat", closed=True)
    seconds = [1 - BLINK, 1.0, 1.5, 2 - BLINK, 2.0, 3 - BLINK, 3.0]
    places = [(0, 1), (1, 0), (1, 0.5), (1, 1), (2, 0), (2, 1), (0, 0)]
    frames = [frame_svg(legs[leg].at(np.array([float(t)]))[0]) for leg, t in places]
    assert_shows(browser, text, seconds, frames)


def test_a_chain_without_motion_is_its_first_drawing(browser: Browser) -> None:
    legs = sample_chain()
    text = smil_svg(*legs, duration=1.0, loop="repeat", hold=0.5)
    first = frame_svg(legs[0].at(np.zeros(1))[0])
    browser.reduce_motion(True)
    try:
        assert_shows(browser, text, (0.0, 2.2, 3.7), [first] * 3)
    finally:
        browser.reduce_motion(False)
