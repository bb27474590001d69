"""Paces of their own: springs, overshoot, parts one after another, one easing over a chain."""

import json
import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

import shapetween as st
from shapetween.base.errors import OptionError
from shapetween.formats.options import WriteOptions
from shapetween.formats.paced import paced
from shapetween.formats.segments import Segments
from shapetween.model.drawing import Drawing
from shapetween.svg.read.reader import read_svg
from shapetween.timing.easing import easing_function
from tests.browser import chromium
from tests.drawings import area, drawing, square
from tests.formats.test_android import at
from tests.movements import sample_chain, sample_movement
from tests.players import module_pictures

BACK = "cubic-bezier(.34,1.56,.64,1)"


def place(found: Drawing, part: int = 0) -> float:
    """Where the left edge of a part is."""
    return float(found.shapes[part].rings[0].box[0, 0])


@pytest.fixture(scope="module")
def moved() -> st.Morph:
    return st.morph(drawing(area(square(10, 10, 20))), drawing(area(square(60, 10, 20))))


def test_past_the_end_it_goes_on_as_it_came(moved: st.Morph) -> None:
    for t in (-0.4, 0.0, 0.3, 1.0, 1.1, 1.9):
        assert place(moved.at(t)) == pytest.approx(10 + 50 * t, abs=1e-6)
    for t in (-1.1, 2.1, float("nan")):
        with pytest.raises(OptionError, match="is not from 0 to 1"):
            moved.at(t)


def test_past_the_end_there_is_no_corner() -> None:
    movement = sample_movement()
    steps = np.array([1 - 1e-4, 1.0, 1 + 1e-4])
    before, end, after = (d.shapes[1].rings[0].curves for d in movement.at(steps))
    np.testing.assert_allclose(after - end, end - before, atol=1e-9)
    assert (
        movement.at(np.array([1.5]))[0].shapes[1].style
        == movement.at(np.ones(1))[0].shapes[1].style
    )


def test_frames_overshoot(moved: st.Morph) -> None:
    places = [place(frame) for frame in moved.frames(41, BACK)]
    assert max(places) > 63
    assert (places[0], places[-1]) == pytest.approx((10, 60))
    bounces = [place(frame) for frame in moved.frames(41, "spring(1,200,8)")]
    assert max(bounces) > 70
    assert min(bounces[12:]) < 59


@pytest.mark.parametrize("easing", [BACK, "spring(1,100,10)", "linear(0, .9 30%, .4 60%, 1)"])
def test_the_movement_holds_the_pace_and_the_format_is_even(easing: str) -> None:
    segments = Segments((sample_movement(),))
    found, options = paced(segments, WriteOptions(easing=easing))
    assert options == WriteOptions()
    u = np.linspace(0, 1, 13)
    exact = segments.movements[0].at(easing_function(easing)(u))
    for one, other in zip(found.movements[0].at(u), exact, strict=True):
        np.testing.assert_allclose(one.shapes[1].rings[0].curves, other.shapes[1].rings[0].curves)


def test_what_is_plain_stays_as_it_is() -> None:
    segments, options = Segments((sample_movement(),)), WriteOptions(easing="ease-in")
    assert paced(segments, options) == (segments, options)


@pytest.fixture(scope="module")
def row() -> st.Morph:
    """Three squares in a row, painted in another order, moving down; a fourth rests."""
    places = [(80, 10), (40, 10), (5, 10)]
    first = [area(square(x, y, 10)) for x, y in places]
    last = [area(square(x, y + 60, 10)) for x, y in places]
    still = area(square(60, 90, 5))
    return st.morph(drawing(*first, still), drawing(*last, still), together=False)


@pytest.mark.parametrize(
    ("by", "order"), [("order", [0, 1, 2]), ("left", [2, 1, 0]), ("distance", [1, 0, 2])]
)
def test_parts_set_off_one_after_another(row: st.Morph, by: str, order: Sequence[int]) -> None:
    found, options = paced(
        Segments(row.movements),
        WriteOptions(duration=1.0, stagger=0.5, stagger_by=by, easing="ease-in"),  # type: ignore[arg-type]
    )
    assert options.duration == pytest.approx(2.0)
    assert options.stagger == 0
    seconds = np.linspace(0, 2, 81)
    drawings = found.movements[0].at(seconds / 2)
    for rank, part in enumerate(order):
        tops = np.array([d.shapes[part].rings[0].box[0, 1] for d in drawings])
        share = easing_function("ease-in")(np.clip(seconds - 0.5 * rank, 0, 1))
        np.testing.assert_allclose(tops, 10 + 60 * share, atol=1e-6)


def test_one_easing_over_a_chain() -> None:
    legs = sample_chain()
    found, options = paced(
        Segments(legs), WriteOptions(duration=1.0, easing="ease-in", easing_over="chain")
    )
    assert options.easing == "linear"
    assert sum(found.ways) == pytest.approx(3.0)
    assert found.ways[0] > found.ways[1] > found.ways[2]
    ease = easing_function("ease-in")
    edges = np.concatenate([[0.0], np.cumsum(found.ways)])
    for k, (leg, movement) in enumerate(zip(legs, found.movements, strict=True)):
        u = np.linspace(0, 1, 7)
        whole = ease((edges[k] + u * found.ways[k]) / 3) * 3 - k
        for one, other in zip(movement.at(u), leg.at(np.clip(whole, 0, 1)), strict=True):
            np.testing.assert_allclose(
                one.shapes[0].rings[0].curves, other.shapes[0].rings[0].curves, atol=0.05
            )
    with pytest.raises(OptionError, match="easing_over: changes nothing"):
        paced(Segments(legs[:1]), WriteOptions(easing_over="chain"))


#: A leg as long as both others of a chain of three that takes three seconds, by its easing.
LATE = "linear(0, .33333333 50%, .66666667 75%, 1)"


@pytest.fixture(scope="module")
def chain() -> st.Chain:
    """A square that goes to the right, down, and back to the left."""
    places = [(10, 10), (60, 10), (60, 60), (10, 60)]
    return st.chain([drawing(area(square(x, y, 20))) for x, y in places])


def wanted(seconds: float) -> tuple[float, float]:
    """Where its corner is then."""
    way = np.interp(seconds, [0, 1.5, 2.25, 3], [0, 1, 2, 3])
    return float(np.interp(way, [0, 1, 2, 3], [10, 60, 60, 10])), float(
        np.interp(way, [0, 1, 2, 3], [10, 10, 60, 60])
    )


KEYFRAME = r'([\d.]+)%{clip-path:path\(evenodd,"m([\d.]+) ([\d.]+)'
ASKED: dict[str, Any] = {"duration": 1.0, "easing": LATE, "easing_over": "chain"}
MOMENTS = (0.0, 0.6, 1.4, 1.7, 2.1, 2.5, 2.9)


def test_one_easing_over_a_chain_in_lottie(chain: st.Chain) -> None:
    layers = json.loads(chain.lottie(**ASKED))["layers"]
    assert [round(layer["ip"]) for layer in layers] == [0, 90, 135]
    assert [key["t"] for layer in layers for key in layer["tm"]["k"]] == pytest.approx(
        [0, 90, 90, 135, 135, 180], abs=0.1
    )
    assert [key["s"][0] for layer in layers for key in layer["tm"]["k"]] == pytest.approx(
        [0, 1.5, 0, 0.75, 0, 0.75], abs=0.01
    )


def test_one_easing_over_a_chain_in_css(chain: st.Chain) -> None:
    text = chain.css(**ASKED)
    assert " 3s linear both" in text
    keys = {float(percent): (float(x), float(y)) for percent, x, y in re.findall(KEYFRAME, text)}
    assert {50.0, 75.0} <= {round(key, 1) for key in keys}
    for key, found in keys.items():
        assert found == pytest.approx(wanted(3 * key / 100), abs=0.2)


def test_one_easing_over_a_chain_in_android(chain: st.Chain) -> None:
    for second in MOMENTS:
        seen = read_svg(at(chain.vector_drawable(**ASKED), 1000 * second).encode(), "seen")
        scale = 100 / seen.box.width
        boxes = [shape.rings[0].box[0] * scale for shape in seen.shapes if shape.style.opacity > 0]
        assert any(tuple(box) == pytest.approx(wanted(second), abs=0.3) for box in boxes)


def test_one_easing_over_a_chain_in_pictures(chain: st.Chain, tmp_path: Path) -> None:
    chain.write(tmp_path / "seen.png", fps=20, size=(100,), background="#fff", **ASKED)
    with Image.open(tmp_path / "seen.png") as film:
        assert getattr(film, "n_frames", 1) == pytest.approx(60, abs=3)
        for second in MOMENTS:
            film.seek(round(second / 3 * (film.n_frames - 1)))  # type: ignore[attr-defined]
            dark = np.argwhere(np.asarray(film.convert("L")) < 100)
            assert dark.min(axis=0)[::-1] == pytest.approx(wanted(second), abs=3)


def test_a_module_knows_how_long_each_leg_of_a_chain_is(chain: st.Chain) -> None:
    (ways,) = re.findall(r"const ways=(.*?);", chain.module(**ASKED))
    assert json.loads(ways) == pytest.approx([1.5, 0.75, 0.75], abs=1e-3)
    assert "ways" not in chain.module(duration=1.0)


@pytest.mark.browser
def test_one_easing_over_a_chain_is_played(chain: st.Chain) -> None:
    options = {**ASKED, "hold": 0.5}
    shown = [0.2, 1.1, 1.9, 2.3, 2.7, 3.4, 3.9, 4.4]
    moved = [0.0, 0.6, 1.4, 1.5, 1.7, 2.25, 2.4, 2.9]
    with chromium() as browser:
        for text in (chain.module(**options),):
            for shot, second in zip(module_pictures(browser, text, shown), moved, strict=True):
                dark = np.argwhere(shot.mean(axis=-1) < 100)
                corner = dark.min(axis=0)[::-1] * 100 / shot.shape[0]
                assert corner == pytest.approx(wanted(second), abs=1.5)
