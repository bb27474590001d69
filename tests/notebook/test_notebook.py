"""The notebook's widget: what Python sees of it, and what it does in a page."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

import shapetween as st
from tests.browser import chromium

pytest.importorskip("anywidget", reason="anywidget is not installed")

from shapetween.notebook import Tween

INPUTS = Path(__file__).resolve().parents[2] / "gallery" / "inputs"
HORSE, KANGAROO = INPUTS / "horse.svg", INPUTS / "kangaroo.svg"
PIN = (22.0, 9.5, 22.0, 7.0)

#: A page with the widget in it, and a model as a notebook hands one over.
PAGE = """async ([esm, state]) => {
    const url = URL.createObjectURL(new Blob([esm], { type: "text/javascript" }));
    const { default: widget } = await import(url);
    const heard = {};
    window.model = {
        get: (name) => state[name],
        set: (name, value) => {
            state[name] = value;
            (heard[`change:${name}`] || []).forEach((listener) => listener());
        },
        save_changes: () => { window.saved = (window.saved || 0) + 1; },
        on: (name, f) => { (heard[name] = heard[name] || []).push(f); },
    };
    window.host = document.body.appendChild(document.createElement("div"));
    widget.render({ model: window.model, el: window.host });
}"""

#: Where the tenth stretch of an outline is.
PLACE = """(k) => {
    const svg = window.host.shadowRoot.querySelectorAll(".row svg")[k];
    const path = svg.querySelectorAll(".hue")[10];
    const p = path.getPointAtLength(path.getTotalLength() / 2).matrixTransform(svg.getScreenCTM());
    return [p.x, p.y];
}"""


@pytest.fixture
def widget() -> Tween:
    return Tween(HORSE, KANGAROO)


def test_pins_change_the_movement(widget: Tween) -> None:
    before = widget._view["svg"]
    widget.pins = [list(PIN)]
    assert widget._view["svg"] != before
    m = st.morph(HORSE, KANGAROO, pins=[PIN])
    assert widget.morph.svg() == m.svg()
    assert [tuple(pin) for pin in widget.pins] == [PIN]


def test_pins_may_be_given_at_first() -> None:
    assert Tween(HORSE, KANGAROO, pins=[PIN]).pins == [list(PIN)]


def test_a_pin_that_cannot_be_kept_is_told_of(widget: Tween) -> None:
    before = widget._view["svg"]
    for wrong in ([[900.0, 900.0, 0.0, 0.0]], [[1.0, 2.0]]):
        widget.pins = wrong
        assert len(widget.warnings) == 1
        assert "pin" in widget.warnings[0]
        assert widget._view["svg"] == before


def test_options_are_those_of_morph() -> None:
    assert Tween(HORSE, KANGAROO, method="linear").morph.method == "linear"


@pytest.fixture
def page() -> Iterator[Any]:
    with chromium() as browser:
        yield browser.page


@pytest.mark.browser
def test_it_is_dragged_in_a_page(widget: Tween, page: Any) -> None:
    problems: list[str] = []
    page.on("pageerror", lambda error: problems.append(str(error)))
    page.set_viewport_size({"width": 1000, "height": 600})
    state = {"pins": [], "t": 0.0, "warnings": ["one"], "_view": widget._view}
    page.evaluate(PAGE, [widget._esm, state])
    shadow = "window.host.shadowRoot"
    assert page.evaluate(f"{shadow}.querySelectorAll('.hue').length") == 48
    page.mouse.click(*page.evaluate(PLACE, 0))  # a pin is born on the match
    born = page.evaluate("window.model.get('pins')")
    assert len(born) == 1
    end = page.evaluate(PLACE, 1)
    page.mouse.move(*end)
    page.mouse.down()
    page.mouse.move(end[0] + 8, end[1] + 8)
    page.mouse.move(end[0] + 25, end[1] + 25)
    page.mouse.up()
    moved = page.evaluate("window.model.get('pins')")
    assert moved[0][:2] == born[0][:2]
    assert moved[0][2:] != born[0][2:]
    assert page.evaluate("window.saved") >= 2
    widget.pins = moved  # as the notebook would hand them over
    assert not widget.warnings
    page.evaluate(f"{shadow}.querySelector('.pin').focus()")
    page.keyboard.press("Delete")
    assert page.evaluate("window.model.get('pins')") == []
    page.evaluate(f"window.slider = {shadow}.querySelector('input')")
    page.evaluate("window.slider.value = .5; window.slider.dispatchEvent(new Event('input'))")
    assert page.evaluate("window.model.get('t')") == 0.5
    assert problems == []
