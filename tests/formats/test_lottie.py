"""Lottie is valid, and what it holds is the movement."""

import copy
import io
import json
import re
import zipfile
from collections.abc import Callable
from functools import cache
from itertools import pairwise
from pathlib import Path
from typing import Any

import jsonschema
import numpy as np
import pytest

import shapetween as st
from shapetween.formats.lottie.writer import dot_lottie, lottie, lottie_json
from shapetween.formats.options import WriteOptions
from shapetween.formats.table import Segments
from shapetween.model.drawing import Box
from shapetween.model.movement import Movement
from shapetween.model.paint import Style
from shapetween.svg.write.sequence import frame_svg
from tests.browser import difference
from tests.movements import circle, formula_part, rest, sample_chain, sample_movement, spin
from tests.paints import BLUE, DISC, EVERY, OVAL, OVALS, RED, THIN
from tests.players import resvg_pictures, thorvg_pictures

SCHEMA = Path(__file__).resolve().parents[1] / "data/lottie/lottie.schema.json"
INPUTS = Path(__file__).resolve().parents[2] / "gallery/inputs"

QUARTERS = (0.0, 0.25, 0.5, 0.75, 1.0)

#: Share of pixels that may differ by more than an edge does.
STRAY = 1e-3


def written(movement: Movement, **options: Any) -> dict[str, Any]:
    return lottie_json(Segments((movement,)), WriteOptions(**options))[0]


@cache
def validator() -> jsonschema.Draft202012Validator:
    """What checks an animation against the official schema (see SOURCES.md beside it)."""
    schema = json.loads(SCHEMA.read_text("utf-8"))
    jsonschema.Draft202012Validator.check_schema(schema)
    return jsonschema.Draft202012Validator(schema)


def assert_valid(animation: dict[str, Any]) -> None:
    """Check against the official schema, and what it does not see."""
    validator().validate(animation)
    assert isinstance(animation["w"], int)
    assert isinstance(animation["h"], int)
    compositions = [animation, *animation["assets"]]
    for layer in (layer for composition in compositions for layer in composition["layers"]):
        assert {"ty", "ip", "op", "st", "ks", "nm"} <= set(layer)
        assert layer["ip"] < layer["op"]
    for item in walk(animation):
        if item.get("a") == 1 and isinstance(item.get("k"), list):
            times = [key["t"] for key in item["k"]]
            assert all(b > a for a, b in pairwise(times))
            counts = {len(k["s"][0]["v"]) for k in item["k"] if isinstance(k["s"][0], dict)}
            assert len(counts) <= 1
        names = [dash["nm"] for dash in item.get("d", []) if isinstance(dash, dict)]
        assert len(set(names)) == len(names)


def walk(value: Any) -> list[dict[str, Any]]:
    if isinstance(value, dict):
        return [value, *(item for inner in value.values() for item in walk(inner))]
    if isinstance(value, list):
        return [item for inner in value for item in walk(inner)]
    return []


def assert_shows(animation: dict[str, Any], frames: list[float], svgs: list[str]) -> None:
    """Check that ThorVG shows at each frame what resvg shows of the SVG."""
    shots = thorvg_pictures(json.dumps(animation).encode(), frames)
    for shot, wanted, frame in zip(shots, resvg_pictures(svgs), frames, strict=True):
        assert difference(shot, wanted) <= STRAY, f"another picture at frame {frame}"
        assert np.abs(shot - wanted).mean() < 1, f"other colours at frame {frame}"


def frames_at(movement: Movement, times: tuple[float, ...]) -> list[str]:
    return [frame_svg(drawing) for drawing in movement.at(np.array(times))]


def test_the_schema_is_the_official_one_and_whole() -> None:
    schema = validator().schema
    assert schema["$id"] == "https://lottie.github.io/lottie-spec/1.0/specs/schema/"
    assert schema["$version"] == 10000
    assert sum(map(len, schema["$defs"].values())) == 74
    text = SCHEMA.read_text("utf-8")
    for reference in set(re.findall(r'"\$ref": "#/([^"]+)"', text)):
        found = schema
        for step in reference.split("/"):
            found = found[step]  # fails where something is left out
    assert len(text) == 90876


def _shape(kind: str) -> Callable[[dict[str, Any]], Any]:
    return lambda animation: next(i for i in walk(animation) if i.get("ty") == kind)


@pytest.mark.parametrize(
    ("place", "name", "value"),
    [
        (lambda a: a, "w", 100.5),
        (lambda a: a, "fr", None),
        (lambda a: a["layers"][0], "ip", "0"),
        (_shape("fl"), "r", 3),
        (_shape("fl"), "c", {"a": 0, "k": "red"}),
        (_shape("sh"), "ks", {"a": 0, "k": {"v": [[0, 0]]}}),
        (_shape("gr"), "it", {}),
    ],
)
def test_the_schema_sees_what_is_wrong(place: Any, name: str, value: Any) -> None:
    animation = copy.deepcopy(written(sample_movement()))
    assert_valid(animation)
    if value is None:
        del place(animation)[name]
    else:
        place(animation)[name] = value
    with pytest.raises(jsonschema.ValidationError):
        assert_valid(animation)


@pytest.mark.parametrize(("first", "last"), [*EVERY, *OVALS])
@pytest.mark.parametrize(
    "options",
    [
        {"loop": "repeat", "keyframes": 5},
        {"hold": 0.5, "loop": "alternate"},
        {"easing": "cubic-bezier(0.1,0.6,0.4,1)", "loop": "alternate"},
    ],
    ids=str,
)
def test_every_paint_is_valid_in_every_timing(
    first: Style, last: Style, options: dict[str, Any]
) -> None:
    """In a chain that closes, whose legs hold what a single movement holds."""
    there, back = sample_movement(first, last), sample_movement(last, first)
    assert_valid(lottie_json(Segments((there, back), closed=True), WriteOptions(**options))[0])


@pytest.mark.parametrize(
    ("names", "options"),
    [
        (("picture-rocket", "picture-airplane"), {"easing": "spring(1,100,10)"}),
        (("icon-play", "icon-pause", "icon-heart"), {"loop": "alternate", "hold": 0.3}),
        (("key", "lock"), {"easing": "linear(0, 1.2 60%, 1)", "loop": "repeat"}),
        (("emoji-cat-face", "emoji-dog-face"), {"stagger": 0.3}),
    ],
)
def test_what_is_written_of_drawings_is_valid(
    names: tuple[str, ...], options: dict[str, Any]
) -> None:
    files = [INPUTS / f"{name}.svg" for name in names]
    morph = st.morph(*files) if len(files) == 2 else st.chain(files)
    assert_valid(json.loads(morph.lottie(**options)))


@pytest.mark.parametrize(("first", "last"), EVERY)
def test_paint_is_as_the_frames_show_it(first: Style, last: Style) -> None:
    movement = sample_movement(first, last)
    animation = written(movement)
    assert_valid(animation)
    assert_shows(animation, [120 * t for t in QUARTERS], frames_at(movement, QUARTERS))


@pytest.mark.parametrize(
    ("options", "seconds", "shown"),
    [
        ({"loop": "repeat"}, (0, 1, 1.999, 2.005), (0, 0.5, 1, 1)),
        ({"loop": "alternate"}, (0, 1, 2, 3.5, 3.999), (0, 0.5, 1, 0.25, 0)),
        ({"hold": 0.5}, (0.3, 0.5, 1.5, 2.5), (0, 0, 0.5, 1)),
        (
            {"hold": 0.5, "loop": "alternate"},
            (0.3, 1.5, 2.6, 2.9, 4, 4.99),
            (0, 0.5, 1, 1, 0.5, 0),
        ),
    ],
)
def test_loops_and_rests(
    options: dict[str, Any], seconds: tuple[float, ...], shown: tuple[float, ...]
) -> None:
    movement = sample_movement()
    animation = written(movement, **options)
    assert_valid(animation)
    assert_shows(animation, [60 * s for s in seconds], frames_at(movement, shown))


def test_the_way_back_costs_next_to_nothing() -> None:
    movement = sample_movement()
    once, alternate = (
        len(json.dumps(written(movement, loop=loop))) for loop in ("once", "alternate")
    )
    assert alternate < once + 1800


def test_an_easing_is_mirrored_on_the_way_back() -> None:
    from shapetween.timing.easing import easing_function

    movement = sample_movement()
    easing = "cubic-bezier(0.1,0.6,0.4,1)"
    animation = written(movement, easing=easing, loop="alternate")
    assert_valid(animation)
    times = easing_function(easing)(np.array([0.25, 0.5]))
    shown = (float(times[0]), float(times[1]), float(times[1]), float(times[0]))
    assert_shows(animation, [30, 60, 180, 210], frames_at(movement, shown))


def test_chains_show_every_leg_in_its_time() -> None:
    legs = sample_chain()
    options = WriteOptions(duration=1.0, hold=0.5, loop="repeat")
    animation, _ = lottie_json(Segments(legs, closed=True), options)
    assert_valid(animation)
    shown = ((0, 0.0), (0, 0.5), (0, 1.0), (1, 0.5), (2, 0.5), (2, 1.0))
    svgs = [frame_svg(legs[leg].at(np.array([t]))[0]) for leg, t in shown]
    assert_shows(animation, [12, 60, 105, 150, 240, 269.9], svgs)
    names = [marker["cm"] for marker in animation["markers"]]
    assert names == ["A to B", "B to C", "C to D", "reduced motion"]


def test_what_stands_still_has_no_keyframes() -> None:
    part = formula_part(circle(np.array([5.0, 5.0]), 3.0), rest)
    animation = written(Movement((part,), Box(0, 0, 10, 10)))
    assert_valid(animation)
    assert all(item.get("a") != 1 for item in walk(animation["layers"]))


def test_what_is_never_seen_is_left_out() -> None:
    ring = circle(np.array([5.0, 5.0]), 3.0)
    parts = (
        formula_part(ring, spin(0.3), Style(None), Style(None)),
        formula_part(ring, spin(0.3), Style(RED, opacity=0), Style(BLUE, opacity=0)),
        formula_part(ring, spin(0.3), Style(RED), Style(BLUE)),
    )
    assert len(written(Movement(parts, Box(0, 0, 10, 10)))["layers"]) == 1


def test_open_lines_stay_open() -> None:
    ring = circle(np.array([50.0, 50.0]), 30.0)[:3]
    style = Style(None, THIN)
    part = formula_part(ring, spin(0.3), style, style, "arc", (3,), (False,))
    movement = Movement((part,), Box(0, 0, 100, 100))
    animation = written(movement)
    assert_valid(animation)
    assert_shows(animation, [0, 60, 120], frames_at(movement, (0.0, 0.5, 1.0)))


@pytest.mark.parametrize("box", [Box(0, 0, 30, 20), Box(-5, 10, 7, 20), Box(0, 0, 24, 24)])
def test_any_view_box_becomes_whole_pixels(box: Box) -> None:
    centre = np.array([box.x + box.width / 2, box.y + box.height / 2])
    part = formula_part(circle(centre, 3.0), spin(0.2))
    animation = written(Movement((part,), box))
    assert_valid(animation)
    assert max(animation["w"], animation["h"]) == 1000


def test_ovals_and_repeating_gradients_are_told_of() -> None:
    movement = sample_movement(Style(OVAL), Style(DISC))
    made = lottie(Segments((movement,)), WriteOptions())
    assert made.warnings == ("front: an oval gradient becomes a round one in Lottie",)


def test_keyframes_are_counted() -> None:
    animation = written(sample_movement(), keyframes=7)
    paths = [
        item["ks"] for item in walk(animation) if item.get("ty") == "sh" and item["ks"]["a"] == 1
    ]
    assert {len(path["k"]) for path in paths} == {7}


def test_a_packed_animation_holds_the_same() -> None:
    segments = Segments((sample_movement(),))
    made = dot_lottie(segments, WriteOptions())
    assert isinstance(made.content, bytes)
    assert made.content == dot_lottie(segments, WriteOptions()).content
    with zipfile.ZipFile(io.BytesIO(made.content)) as archive:
        manifest = json.loads(archive.read("manifest.json"))
        assert [entry["id"] for entry in manifest["animations"]] == ["morph"]
        text = archive.read("a/morph.json").decode()
    assert text == lottie(segments, WriteOptions()).content


def test_the_shortest_movement_is_valid() -> None:
    assert_valid(written(sample_movement(Style(RED), Style(BLUE)), duration=0.001))
