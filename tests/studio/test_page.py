"""The studio's page in a real browser: what a person does, and what they see of it."""

import errno
import json
import os
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import shapetween as st
from tests.browser import chromium
from tests.cli.commands import svg
from tests.studio.conftest import INPUTS, Client

pytestmark = pytest.mark.browser

HORSE, KANGAROO = INPUTS / "horse.svg", INPUTS / "kangaroo.svg"

#: Sizes a page is looked at: a desk, and half of one.
SIZES = {"wide": (1440, 900), "narrow": (800, 900)}


#: The first shape on the stage.
SHAPE = """document.getElementById('stage').shadowRoot
    .querySelector('.shapetween-moving path')"""

#: Numbers of all pins in the table.
#: Fields of the list of pins filled in one after the other; each change draws the list anew.
ENTER = """(values) => values.forEach((value, k) => {
  const field = document.querySelectorAll("#pin-list input")[k];
  field.value = value;
  field.dispatchEvent(new Event("change", {bubbles: true}));
})"""

PINS = """[...document.querySelectorAll("#pin-list tbody tr")].map(
    (row) => [...row.querySelectorAll("input")].map((input) => Number(input.value)))"""

#: Moves the slider of time, as a hand would.
SCRUB = """(share) => {
    const time = document.getElementById("time");
    time.value = share;
    time.dispatchEvent(new Event("input"));
}"""


def holds(text: str, data: Sequence[str]) -> bool:
    """Whether an SVG's text has these attributes, whose line breaks are spaces to a browser."""
    plain = " ".join(text.split())
    return all(f'"{" ".join(value.split())}"' in plain for value in data)


class Studio:
    """A page of the studio, and what a person can do with it."""

    def __init__(self, page: Any, client: Client) -> None:
        self.page = page
        self.client = client
        self.problems: list[str] = []
        page.on("console", self._heard)
        page.on("pageerror", lambda error: self.problems.append(str(error)))
        page.on("request", self._asked)

    def _heard(self, message: Any) -> None:
        if message.type in ("error", "warning") and "409" not in message.text:
            self.problems.append(message.text)

    def _asked(self, request: Any) -> None:
        own = f"http://127.0.0.1:{self.client.port}/"
        if not request.url.startswith((own, "blob:", "data:")):
            self.problems.append(f"asked for {request.url}")

    def open(self) -> None:
        self.page.goto(self.client.server.address)
        self.until(
            lambda: self.page.evaluate("document.querySelectorAll('#settings label').length > 3")
        )

    def take(self, *paths: Path) -> None:
        self.page.set_input_files("#files", [str(path) for path in paths])
        self.until(lambda: self.text("#status") != "Reading…")
        self.rest()

    def until(self, true: Callable[[], Any], seconds: float = 30) -> Any:
        """Wait; playwright's own waiting needs eval, which the page's rules forbid."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            found = true()
            if found:
                return found
            time.sleep(0.03)
        raise AssertionError("it did not happen")

    def rest(self) -> None:
        """Wait until the full result of what is set is shown."""
        time.sleep(0.25)
        self.until(
            lambda: self.page.evaluate(
                "document.getElementById('state').textContent === ''"
                " && Boolean(document.getElementById('stage').shadowRoot.firstChild)"
            )
        )
        time.sleep(0.05)

    def text(self, css: str) -> str:
        return str(self.page.evaluate(f"document.querySelector({json.dumps(css)}).textContent"))

    def shape(self) -> tuple[str, str]:
        """Path data of the first shape on the stage, at rest and of all keyframes."""
        return (
            str(self.page.evaluate(f"{SHAPE}.getAttribute('d')")),
            str(self.page.evaluate(f"{SHAPE}.querySelector('animate').getAttribute('values')")),
        )

    def shapes(self) -> str:
        """Path data of all shapes on the stage, at rest and on their way."""
        return str(
            self.page.evaluate("document.getElementById('stage').shadowRoot.firstChild.outerHTML")
        )

    def place(self, side: str, share: float, kind: str = ".hue") -> tuple[float, float]:
        """Where on the page a share of the first outline of a kind is."""
        x, y = self.page.evaluate(
            """([side, share, kind]) => {
                const svg = document.getElementById(side), paths = svg.querySelectorAll(kind);
                const path = paths[Math.floor(share * 24)];
                const p = path.getPointAtLength(path.getTotalLength() / 2);
                const q = p.matrixTransform(svg.getScreenCTM());
                return [q.x, q.y];
            }""",
            [side, share, kind],
        )
        return float(x), float(y)

    def click_outline(self, side: str, share: float) -> None:
        self.page.mouse.click(*self.place(side, share))

    def drag(
        self, side: str, start: tuple[float, float], end: tuple[float, float], steps: int = 12
    ) -> None:
        self.page.mouse.move(*start)
        self.page.mouse.down()
        for k in range(1, steps + 1):
            share = k / steps
            self.page.mouse.move(*(a + share * (b - a) for a, b in zip(start, end, strict=True)))
            time.sleep(0.02)

    def pins(self) -> list[tuple[float, float, float, float]]:
        rows = self.page.evaluate(PINS)
        return [(float(ax), float(ay), float(bx), float(by)) for ax, ay, bx, by in rows]


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    with chromium() as browser:
        yield browser.page.context.browser


@contextmanager
def opened(browser: Any, client: Client, size: str = "wide", **more: Any) -> Iterator[Studio]:
    width, height = SIZES[size]
    context = browser.new_context(
        viewport={"width": width, "height": height}, reduced_motion="reduce", **more
    )
    studio = Studio(context.new_page(), client)
    try:
        yield studio
        assert studio.problems == []
    finally:
        context.close()


@pytest.fixture(params=SIZES)
def studio(request: pytest.FixtureRequest, browser: Any, client: Client) -> Iterator[Studio]:
    """The horse and the kangaroo, as the command line opened them."""
    client.server.session.open_paths([HORSE, KANGAROO])
    with opened(browser, client, request.param) as studio:
        studio.open()
        studio.rest()
        yield studio


def test_both_outlines_are_shown_in_matched_hues(studio: Studio) -> None:
    for side in "ab":
        hues = studio.page.evaluate(
            f"[...document.querySelectorAll('#{side} .hue')].map(p => p.getAttribute('stroke'))"
        )
        assert len(set(hues)) == len(hues) == 24
    assert studio.text("#name-a") == "A: horse.svg"
    assert studio.page.evaluate("document.documentElement.scrollWidth <= innerWidth")


def test_time_is_scrubbed(studio: Studio) -> None:
    boxes = []
    for share in (0, 0.5, 1):
        studio.page.evaluate(SCRUB, share)
        box = studio.page.evaluate(f"(b => [b.x, b.width])({SHAPE}.getBBox())")
        boxes.append(box)
    assert boxes[0] != boxes[1] != boxes[2]
    m = st.morph(HORSE, KANGAROO)
    for box, t in zip(boxes, (0.0, 0.5, 1.0), strict=True):
        drawn = m.at(t).drawn
        assert box == pytest.approx([drawn.x, drawn.width], abs=0.02 * drawn.width)


def test_it_plays_and_stops(studio: Studio) -> None:
    studio.page.keyboard.press("Space")
    studio.until(lambda: float(studio.page.input_value("#time")) > 0.02)
    studio.page.keyboard.press("Space")
    assert studio.text("#play") == "Play"
    before = studio.page.input_value("#time")
    time.sleep(0.2)
    assert studio.page.input_value("#time") == before
    studio.page.keyboard.press("End")
    assert float(studio.page.input_value("#time")) == 1


def test_a_pin_is_born_on_the_match(studio: Studio) -> None:
    """Nothing is to move before an end is dragged: only the cut of the curves is another."""
    studio.click_outline("a", 0.3)
    studio.rest()
    pin = studio.pins()[0]
    free = st.morph(HORSE, KANGAROO)
    ring = free.correspondence[0]
    near = [
        np.linalg.norm(points - end, axis=1).argmin()
        for points, end in ((ring.source, pin[:2]), (ring.target, pin[2:]))
    ]
    assert abs(near[0] - near[1]) <= 2
    drawn = st.morph(HORSE, KANGAROO, pins=[pin]).at(0.5).shapes[0].rings[0]
    assert abs(drawn.area / free.at(0.5).shapes[0].rings[0].area - 1) < 0.03


def test_dragging_shows_the_movement_at_once_and_then_the_full_result(studio: Studio) -> None:
    before = studio.shape()
    start, end = studio.place("b", 0.3), studio.place("b", 0.36)
    studio.drag("b", start, end)
    studio.until(lambda: studio.shape() != before, 20)  # the button is still down
    assert studio.page.evaluate("document.querySelectorAll('.pin.held').length") == 2
    studio.page.mouse.up()
    studio.rest()
    pins = studio.pins()
    assert len(pins) == 1
    m = st.morph(HORSE, KANGAROO, pins=[pins[0]])
    shown = studio.client.call(
        "/api/full", {"drawings": ["horse.svg", "kangaroo.svg"], "legs": [{"pins": pins}]}
    ).json["svg"]
    assert shown == m.svg()
    assert holds(shown, studio.shape())
    line = studio.text("#command")
    assert "--pin" in line


def test_undo_and_redo(studio: Studio) -> None:
    assert studio.page.is_disabled("#undo")
    before = studio.shape()
    studio.drag("a", studio.place("a", 0.5), studio.place("a", 0.58))
    studio.page.mouse.up()
    studio.rest()
    pins, moved = studio.pins(), studio.shape()
    assert moved != before
    studio.page.keyboard.press("Control+z")  # the whole drag is one
    studio.rest()
    assert studio.pins() == []
    assert studio.shape() == before
    studio.page.keyboard.press("Control+Shift+Z")
    studio.rest()
    assert studio.pins() == pins
    assert studio.shape() == moved


def test_pins_are_moved_by_the_keyboard(studio: Studio) -> None:
    studio.page.keyboard.press("n")
    studio.rest()
    first = studio.pins()[0]
    assert studio.page.evaluate("document.activeElement.getAttribute('role')") == "slider"
    for _ in range(3):
        studio.page.keyboard.press("ArrowRight")
    studio.page.keyboard.press("Shift+ArrowRight")
    studio.rest()
    moved = studio.pins()[0]
    assert moved[:2] != first[:2]
    assert moved[2:] == first[2:]
    studio.page.keyboard.press("Delete")
    studio.rest()
    assert studio.pins() == []


def test_pins_are_typed(studio: Studio) -> None:
    studio.page.keyboard.press("n")
    studio.rest()
    values = ["22", "9.5", "22", "7"]
    for k, value in enumerate(values):
        field = studio.page.locator("#pin-list input").nth(k)
        field.fill(value)
        field.press("Tab")
    studio.rest()
    assert studio.pins() == [(22, 9.5, 22, 7)]
    assert "--pin 22,9.5:22,7" in studio.text("#command")


def test_swapped_pins_are_warned_of(studio: Studio) -> None:
    studio.click_outline("a", 0.3)
    studio.click_outline("a", 0.36)
    studio.rest()
    one, two = studio.pins()
    # All at once: pins on the way between, half moved, lie on no outline and would be refused.
    studio.page.evaluate(ENTER, [*one[:2], *two[2:], *two[:2], *one[2:]])
    studio.until(lambda: "order" in studio.text("#pin-list"))


def test_settings_change_the_result_and_the_line(studio: Studio) -> None:
    studio.page.fill("#set-duration", "0.8")
    studio.page.keyboard.press("Tab")
    studio.page.select_option("#set-loop", "alternate")
    studio.page.select_option("#set-method", "arap")
    studio.page.select_option("#set-easing", "own")
    studio.page.fill("[aria-label='Easing curve']", "cubic-bezier(.2,0,0,1)")
    studio.page.keyboard.press("Tab")
    studio.rest()
    line = studio.text("#command")
    assert "--method arap --duration 0.8 --easing 'cubic-bezier(.2,0,0,1)' --loop alternate" in line
    studio.page.click("h1")  # a field's keys are its own
    studio.page.keyboard.press("End")
    assert studio.text("#clock") == "1.60 s"


def test_every_setting_is_in_the_page_and_in_the_line(studio: Studio) -> None:
    for name, value in (
        ("pairing", "strict"), ("change", "grow"), ("fit", "geometry"), ("start", "click"),
        ("stagger", "0.25"), ("hold", "0.5"), ("quads", "20"),
    ):  # fmt: skip
        field = f"#set-{name}"
        if studio.page.evaluate("(css) => document.querySelector(css).localName", field) == "input":
            studio.page.fill(field, value)
            studio.page.keyboard.press("Tab")
        else:
            studio.page.select_option(field, value)
    studio.page.select_option("#set-stagger_by", "left")  # is there since something staggers
    studio.rest()
    line = studio.text("#command")
    assert "--quads 20 --fit geometry --strict --change grow --hold 0.5" in line
    assert "--stagger 0.25 --stagger-by left --start click" in line
    studio.page.select_option("#set-change", "")
    studio.page.fill("#set-stagger", "0")
    studio.page.keyboard.press("Tab")
    studio.rest()
    assert "--change" not in studio.text("#command")
    assert "--stagger" not in studio.text("#command")
    assert studio.page.is_hidden("#set-stagger_by")
    studio.page.select_option("#set-start", "scroll")
    studio.rest()
    assert studio.text("#command").endswith("--start scroll -o horse-to-kangaroo.html")


def test_a_wrong_setting_is_one_line_and_the_work_goes_on(studio: Studio) -> None:
    studio.page.select_option("#set-easing", "own")
    studio.page.fill("[aria-label='Easing curve']", "wobbly")
    studio.page.keyboard.press("Tab")
    studio.until(lambda: "wobbly" in studio.text("#status"))
    studio.page.keyboard.press("Control+z")
    studio.page.select_option("#set-easing", "ease")
    studio.rest()
    assert studio.text("#status") == ""
    studio.problems[:] = [p for p in studio.problems if "422" not in p]


def test_the_saved_file_is_what_is_shown(studio: Studio, tmp_path: Path) -> None:
    studio.drag("b", studio.place("b", 0.7), studio.place("b", 0.74))
    studio.page.mouse.up()
    studio.rest()
    studio.page.click("#export")
    with studio.page.expect_download() as download:
        studio.page.click("#export-go")
    assert download.value.suggested_filename == "horse-to-kangaroo.svg"
    download.value.save_as(tmp_path / "saved.svg")
    saved = (tmp_path / "saved.svg").read_text("utf-8")
    pin = studio.pins()[0]
    assert saved == st.morph(HORSE, KANGAROO, pins=[pin]).svg()
    studio.until(lambda: "Saved horse-to-kangaroo.svg" in studio.text("#export-state"))


def test_the_whole_job_takes_few_actions(browser: Any, client: Client, tmp_path: Path) -> None:
    """Two files, one pin, one export: a person's ten actions at most."""
    client.server.session.open_paths([HORSE, KANGAROO])
    client.server.session._last = {}
    with opened(browser, client) as studio:
        studio.open()
        actions = 0

        def act(do: Callable[[], Any]) -> None:
            nonlocal actions
            do()
            actions += 1

        act(lambda: studio.take(HORSE, KANGAROO))
        act(lambda: studio.drag("b", studio.place("b", 0.3), studio.place("b", 0.34)))
        act(studio.page.mouse.up)
        studio.rest()
        act(lambda: studio.page.click("#export"))
        with studio.page.expect_download() as download:
            act(lambda: studio.page.click("#export-go"))
        download.value.save_as(tmp_path / "saved.svg")
        assert (tmp_path / "saved.svg").stat().st_size > 1000
        assert actions <= 10


def test_another_matching_is_one_click(studio: Studio) -> None:
    first = "#alternatives button"
    studio.until(lambda: studio.page.locator(first).count() >= 2)
    before = studio.shape()
    studio.page.click(f"{first}:nth-child(2)")
    studio.rest()
    assert "--matching 2" in studio.text("#command")
    assert studio.shape() != before
    shown = st.morph(HORSE, KANGAROO, matching=2).svg()
    assert holds(shown, studio.shape())
    studio.page.click("h1")
    studio.page.keyboard.press("1")
    studio.rest()
    assert studio.shape() == before
    # A pin on another matching than the best is held there by more of them.
    studio.page.keyboard.press("2")
    studio.rest()
    studio.click_outline("a", 0.3)
    studio.rest()
    assert len(studio.pins()) == 4
    assert "--matching" not in studio.text("#command")


def test_holes_take_pins_too(studio: Studio) -> None:
    paths = INPUTS / "cog.svg", INPUTS / "nut.svg"
    studio.client.server.session.open_paths(list(paths))
    studio.page.evaluate("sessionStorage.removeItem('shapetween-work')")
    studio.page.reload()
    studio.rest()
    free = st.morph(*paths)
    hole = next(ring for ring in free.correspondence if ring.hole)
    before = studio.shape()
    start, end = studio.place("b", 0.3, ".hole"), studio.place("b", 0.36, ".hole")
    studio.drag("b", start, end)
    studio.until(lambda: studio.shape() != before, 20)  # the button is still down
    studio.page.mouse.up()
    studio.rest()
    (pin,) = studio.pins()
    near = np.linalg.norm(hole.source - pin[:2], axis=1).min()
    assert near < 0.02 * np.ptp(hole.source, axis=0).max()
    shown = st.morph(*paths, pins=[pin])
    assert holds(shown.svg(), studio.shape())


def test_parts_are_paired_by_clicking(studio: Studio, tmp_path: Path) -> None:
    for name, shift in (("one.svg", 0), ("two.svg", 2)):
        left, right = f"M{1 + shift} 1h6v6h-6Z", f"M{11 + shift} 9l5 8h-5Z"
        text = svg(f'<path d="{left}"/><path fill="#f00" d="{right}"/>', "0 0 20 20")
        (tmp_path / name).write_text(text, "utf-8")
    studio.client.server.session.open_paths([tmp_path / "one.svg", tmp_path / "two.svg"])
    studio.page.evaluate("sessionStorage.removeItem('shapetween-work')")
    studio.page.reload()
    studio.rest()
    studio.page.click("#mode-parts")
    labels = studio.page.evaluate(
        "[...document.querySelectorAll('#a .part')].map((p) => p.getAttribute('aria-label'))"
    )
    assert len(labels) == 2
    assert all("becomes #" in label for label in labels)
    own = labels[0].rsplit("#", 1)[1]
    other = "2" if own == "1" else "1"
    studio.page.focus("[data-part='a1']")
    studio.page.keyboard.press("Enter")
    studio.page.focus(f"[data-part='b{other}']")
    studio.page.keyboard.press("Enter")
    studio.rest()
    assert f"--match '#1:#{other}'" in studio.text("#command")
    assert studio.page.locator("#part-list tbody tr").count() == 1
    studio.page.click("[aria-label='Remove pair 1']")
    studio.rest()
    assert "--match" not in studio.text("#command")


def test_a_chain_has_legs_with_pins_of_their_own(studio: Studio) -> None:
    studio.take(INPUTS / "camel.svg")
    assert studio.page.locator("#chain .leg").count() == 2
    studio.page.click("#chain-close")
    studio.rest()
    assert studio.page.locator("#chain .leg").count() == 3
    studio.page.click("#chain-leg-1")
    studio.rest()
    assert studio.text("#name-b") == "B: camel.svg"
    studio.click_outline("a", 0.2)
    studio.rest()
    assert "--pin 2/" in studio.text("#command")
    assert "1 pin" in studio.text("#chain-leg-1")
    studio.page.click("#chain-leg-0")
    studio.rest()
    assert studio.pins() == []
    studio.page.click("#chain-move-1")
    studio.rest()
    assert studio.text("#name-a") == "A: kangaroo.svg"


def test_parts_and_matchings_are_of_a_leg(studio: Studio, tmp_path: Path) -> None:
    for k in range(3):
        left, right = f"M{1 + k} 1h6v6h-6Z", f"M{10 + k} 9l5 8h-5Z"
        text = svg(f'<path d="{left}"/><path fill="#f00" d="{right}"/>', "0 0 20 20")
        (tmp_path / f"{'abc'[k]}.svg").write_text(text, "utf-8")
    paths = [tmp_path / f"{name}.svg" for name in "abc"]
    studio.client.server.session.open_paths(paths)
    studio.page.evaluate("sessionStorage.removeItem('shapetween-work')")
    studio.page.reload()
    studio.rest()
    studio.page.click("#chain-leg-1")
    studio.rest()
    studio.page.click("#mode-parts")
    for key in ("a1", "b2"):
        studio.page.focus(f"[data-part='{key}']")
        studio.page.keyboard.press("Enter")
    studio.rest()
    assert "--match '2/#1:#2'" in studio.text("#command")
    assert "1 pair" in studio.text("#chain-leg-1")
    shown = studio.client.call(
        "/api/full", {"drawings": ["a.svg", "b.svg", "c.svg"], "legs": [{}, {"matches": ["#1:#2"]}]}
    )
    assert shown.json["svg"] == st.chain(paths, matches={2: [("#1", "#2")]}).svg()
    studio.page.click("#chain-leg-0")
    studio.rest()
    assert studio.page.locator("#part-list tbody tr").count() == 0


def test_another_matching_of_a_leg_is_one_click(studio: Studio) -> None:
    studio.take(INPUTS / "camel.svg")
    studio.page.click("#chain-leg-1")
    studio.rest()
    studio.until(lambda: studio.page.locator("#alternatives button").count() > 1)
    studio.page.click("#alternatives button:nth-child(2)")
    studio.rest()
    assert "--matching 2/2" in studio.text("#command")


def test_work_is_saved_and_opened_and_survives_a_reload(studio: Studio, tmp_path: Path) -> None:
    studio.click_outline("a", 0.3)
    studio.rest()
    pins = studio.pins()
    with studio.page.expect_download() as download:
        studio.page.keyboard.press("Control+s")
    download.value.save_as(tmp_path / "work.json")
    studio.page.reload()
    studio.rest()
    assert studio.pins() == pins
    studio.page.click("[aria-label='Remove pin 1']")
    studio.rest()
    studio.take(tmp_path / "work.json")
    assert studio.pins() == pins


def test_a_closed_tab_loses_nothing(studio: Studio, browser: Any, client: Client) -> None:
    studio.click_outline("a", 0.3)
    studio.rest()
    pins = studio.pins()
    studio.page.close()
    with opened(browser, client) as again:
        again.open()
        again.rest()
        assert again.pins() == pins


def many(shift: float) -> str:
    """A drawing of thirty parts, odd ones, each where it is and a little other than before."""
    steps = np.arange(14)
    parts = []
    for k in range(30):
        radius = 3 + np.cos(steps * (2 + k % 3) + shift) + 0.5 * np.sin(5 * steps + k)
        angle = 2 * np.pi * steps / len(steps)
        x, y = 10 * (k % 6) + 5 + shift, 10 * (k // 6) + 5 + shift
        points = np.column_stack([x + radius * np.cos(angle), y + radius * np.sin(angle)])
        d = "M" + "L".join(f"{a:.3f} {b:.3f}" for a, b in points) + "Z"
        parts.append(f'<path id="p{k}" fill="hsl({12 * k} 70% 50%)" d="{d}"/>')
    return svg("".join(parts), "0 0 62 52")


def test_thirty_parts_stay_live(studio: Studio, tmp_path: Path) -> None:
    """While the hand goes on, one movement after another is shown."""
    paths = [tmp_path / "one.svg", tmp_path / "two.svg"]
    for k, path in enumerate(paths):
        path.write_text(many(0.6 * k), "utf-8")
    studio.client.server.session.open_paths(paths)
    studio.page.evaluate("sessionStorage.removeItem('shapetween-work')")
    studio.page.reload()
    studio.rest()
    seen = {studio.shapes()}
    start, end = studio.place("b", 0.3), studio.place("b", 0.5)
    studio.page.mouse.move(*start)
    studio.page.mouse.down()
    share = iter(np.tile(np.linspace(0.1, 1, 40), 100))

    def on() -> bool:
        part = float(next(share))
        studio.page.mouse.move(*(a + part * (b - a) for a, b in zip(start, end, strict=True)))
        seen.add(studio.shapes())
        return len(seen) > 4

    studio.until(on, 90)
    studio.page.mouse.up()
    studio.rest()
    (pin,) = studio.pins()
    assert holds(st.morph(*paths, pins=[pin]).svg(), studio.shape())


def test_two_tabs_have_work_of_their_own(studio: Studio, browser: Any, client: Client) -> None:
    with opened(browser, client) as other:
        other.open()
        other.rest()
        before = other.shape()
        studio.drag("b", studio.place("b", 0.3), studio.place("b", 0.36))
        studio.page.mouse.up()
        other.page.select_option("#set-method", "arap")
        for tab in (studio, other):
            tab.rest()
        assert len(studio.pins()) == 1
        assert other.pins() == []
        assert other.shape() != before
        assert "--method" not in studio.text("#command")


def test_killed_workers_lose_nothing(studio: Studio) -> None:
    studio.drag("b", studio.place("b", 0.3), studio.place("b", 0.34))
    workers = studio.client.server.session.workers
    workers._live.stop()
    for worker in [*workers._idle, *workers._busy.values()]:
        worker.stop()
    studio.page.mouse.up()
    studio.rest()
    pins = studio.pins()
    assert len(pins) == 1
    before = studio.shape()
    studio.drag("b", studio.place("b", 0.6), studio.place("b", 0.64))
    studio.until(lambda: studio.shape() != before)
    studio.page.mouse.up()
    studio.rest()
    assert studio.pins()[:1] == pins
    studio.problems[:] = [p for p in studio.problems if "422" not in p]  # what was cut off


def test_a_full_disk_at_export_is_one_line(studio: Studio, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(*_: Any, **__: Any) -> None:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    studio.click_outline("a", 0.3)
    studio.rest()
    monkeypatch.setattr("shapetween.studio.exports.tempfile.TemporaryDirectory", full)
    studio.page.click("#export")
    studio.page.click("#export-go")
    studio.until(lambda: "no space left" in studio.text("#export-state"))
    studio.page.keyboard.press("Escape")
    assert len(studio.pins()) == 1
    studio.problems[:] = [p for p in studio.problems if "422" not in p]


def test_lines_take_pins(studio: Studio, tmp_path: Path) -> None:
    stroke = '<path fill="none" stroke="#000" stroke-width="2" stroke-linecap="round" d="{}"/>'
    shapes = "M4 20L12 6L20 20", "M4 8Q12 24 20 8"
    paths = [tmp_path / "peak.svg", tmp_path / "bowl.svg"]
    for path, d in zip(paths, shapes, strict=True):
        path.write_text(svg(stroke.format(d), "0 0 24 24"), "utf-8")
    studio.client.server.session.open_paths(paths)
    studio.page.evaluate("sessionStorage.removeItem('shapetween-work')")
    studio.page.reload()
    studio.rest()
    studio.drag("b", studio.place("b", 0.4), studio.place("b", 0.6))
    studio.page.mouse.up()
    studio.rest()
    (pin,) = studio.pins()
    assert holds(st.morph(*paths, pins=[pin]).svg(), studio.shape())


def test_a_file_as_large_as_is_taken(studio: Studio, tmp_path: Path) -> None:
    large = tmp_path / "large.svg"
    text = svg('<path d="M1 1H9V9H1Z"/>')
    padding = 8 * 1024 * 1024 - len(text) - len("<!---->")
    large.write_text(f"{text}<!--{'x' * padding}-->", "utf-8")
    studio.take(large)
    assert studio.page.locator("#chain .item").count() == 3


def test_broken_files_are_one_line(studio: Studio, tmp_path: Path) -> None:
    (tmp_path / "broken.svg").write_text("<svg", "utf-8")
    studio.page.set_input_files("#files", [str(tmp_path / "broken.svg")])
    line = studio.until(lambda: studio.text("#status") != "Reading…" and studio.text("#status"))
    assert "broken.svg" in line
    assert studio.page.locator("#chain .item").count() == 2
    big = tmp_path / "big.svg"
    big.write_bytes(b" " * (8 * 1024 * 1024 + 1))
    studio.page.set_input_files("#files", [str(big)])
    studio.until(lambda: "8 MB" in studio.text("#status"))
    studio.problems[:] = [p for p in studio.problems if "422" not in p and "413" not in p]


def test_an_end_of_the_program_is_said(browser: Any, client: Client) -> None:
    client.server.session.open_paths([HORSE, KANGAROO])
    with opened(browser, client) as studio:
        studio.open()
        studio.rest()
        studio.page.route("**/api/**", lambda route: route.abort())
        studio.page.select_option("#set-loop", "repeat")
        studio.until(lambda: "does not answer" in studio.text("#status"))
        studio.problems.clear()


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("size", SIZES)
def test_nothing_is_in_the_way_of_anybody(
    browser: Any, client: Client, scheme: Any, size: str, axe: str
) -> None:
    """No serious fault of accessibility, on any face of the page."""
    client.server.session.open_paths([HORSE, KANGAROO])
    with opened(browser, client, size, color_scheme=scheme, bypass_csp=True) as studio:
        studio.open()
        studio.rest()
        studio.click_outline("a", 0.3)
        studio.rest()
        studio.page.add_script_tag(content=axe)
        for show in ("", "#help", "#export", "#mode-parts"):
            if show:
                studio.page.click(show)
            found = studio.page.evaluate("axe.run()")
            serious = [
                f"{fault['id']}: {node['html'][:120]} {node['failureSummary'][:200]}"
                for fault in found["violations"]
                if fault["impact"] in ("serious", "critical")
                for node in fault["nodes"]
            ]
            assert serious == []
            if show:
                studio.page.keyboard.press("Escape")
    with opened(browser, client, size, color_scheme=scheme, bypass_csp=True) as studio:
        client.server.session._last = {}  # with nothing opened yet
        studio.open()
        studio.page.add_script_tag(content=axe)
        found = studio.page.evaluate("axe.run()")
        assert [f for f in found["violations"] if f["impact"] in ("serious", "critical")] == []
