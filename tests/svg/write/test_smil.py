"""The animated file as XML: what must hold in it whatever a browser makes of it."""

import re
import xml.etree.ElementTree as ET
from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise
from typing import Literal

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from shapetween.base.arrays import Floats
from shapetween.geometry.bezier import evaluate
from shapetween.model.drawing import Box
from shapetween.model.movement import Movement
from shapetween.model.paint import Colour, Gradient, Stop, Stroke, Style
from shapetween.model.part import shown_while
from shapetween.svg.write.sequence import frame_svg
from shapetween.svg.write.smil import smil_svg
from shapetween.timing.easing import easing_function
from shapetween.timing.timeline import Loop
from tests.movements import circle, formula_part, rest, sample_chain, sample_movement, spin
from tests.smil import SVG, commands_of, curves_of, path_at, value_at

STOPS = (Stop(0.0, Colour(1, 1, 0)), Stop(1.0, Colour(0, 0, 0.5)))
STRIPES = Gradient("linear", (10, 40, 60, 60), (1, 0, 0, 1, 0, 0), STOPS)


def moving_paths(root: ET.Element) -> list[ET.Element]:
    return root.findall(f"{SVG}g[@class='shapetween-moving']/{SVG}path")


def animation(path: ET.Element, attribute: str) -> tuple[Floats, list[str]]:
    """Times, and values, of an attribute's animation."""
    (element,) = path.findall(f"{SVG}animate[@attributeName='{attribute}']")
    return played(element, "keyTimes")[:, 0], element.attrib["values"].split(";")


def played(element: ET.Element, attribute: str) -> Floats:
    """A list of lists of numbers, such as keySplines."""
    rows = element.attrib[attribute].split(";")
    return np.array([[float(text) for text in row.split()] for row in rows])


@settings(max_examples=25)
@given(
    st.sampled_from([1e-3, 1.0, 24.0, 1e6]),
    st.floats(-0.5, 0.5),
    st.sampled_from(["linear", "ease-in-out", "cubic-bezier(.9,0,.1,1)"]),
    st.sampled_from(["once", "repeat", "alternate"]),
    st.sampled_from(["auto", 60]),
)
def test_the_browsers_in_betweens_stay_within_a_quarter_of_a_pixel(
    size: float, turns: float, easing: str, loop: Loop, keyframes: Literal["auto"] | int
) -> None:
    curves = circle(np.array([0.5, 0.4]), 0.3) * (size, size * 0.5)
    part = formula_part(curves, spin(turns, (0.2 * size, 0.1 * size)))
    movement = Movement((part,), Box(0, 0, size, size))
    text = smil_svg(movement, duration=1.0, easing=easing, loop=loop, keyframes=keyframes)
    (path,) = moving_paths(ET.fromstring(text))
    for u in np.linspace(0, 1, 60)[:-1]:
        exact = part.curves(easing_function(easing)(np.array([u])))[0]
        for second in (u, 2 - u) if loop == "alternate" else (u,):
            ((shown, closed),) = curves_of(path_at(path, second))
            assert closed
            away = evaluate(shown, BETWEEN) - evaluate(exact, BETWEEN)
            assert np.linalg.norm(away, axis=-1).max() <= 0.25 * size / 1000


#: Shares of a curve at which it is compared.
BETWEEN = np.linspace(0, 1, 9)


def test_what_is_not_seen_does_not_move() -> None:
    """Only where it is told: what has gone is still, and no easing is spent on it."""
    curves = circle(np.array([50.0, 40.0]), 30.0)

    class Going:
        def at(self, t: float) -> Style:
            return Style(Colour(0, 0, 0), opacity=float(t < 0.41))

    part = replace(formula_part(curves, spin(0.4, (300.0, 20.0))), paint=Going())
    first, last = shown_while(part)
    assert (first, round(last, 4)) == (0.0, 0.41)
    text = smil_svg(Movement((part,), Box(0, 0, 100, 100)), duration=1.0)
    (path,) = moving_paths(ET.fromstring(text))
    told = [each for each in path if each.get("attributeName") == "d"]
    assert told
    for each in told:
        until = float(each.get("begin", "0s")[:-1]) + float(each.attrib["dur"][:-1])
        assert until <= 0.411


class Shown:
    """Painted between some times, and transparent outside."""

    def __init__(self, *spans: tuple[float, float]) -> None:
        self.spans = spans

    def at(self, t: float) -> Style:
        return Style(Colour(0, 0, 0), opacity=float(any(a < t < b for a, b in self.spans)))


@pytest.mark.parametrize("loop", ["once", "repeat", "alternate"])
def test_what_comes_or_goes_at_once_does_so_to_the_moment(loop: Loop) -> None:
    curves = circle(np.array([50.0, 40.0]), 30.0)
    part = formula_part(curves, spin(0.4, (30.0, 20.0)))
    parts = tuple(replace(part, paint=Shown(span)) for span in ((-1, 0.4137), (0.4137, 2)))
    text = smil_svg(Movement(parts, Box(0, 0, 100, 100)), duration=1.0, loop=loop)
    for path, wanted in zip(moving_paths(ET.fromstring(text)), ("1 0", "0 1"), strict=True):
        for second in (0.4132, 0.4142):
            shown = value_at(path, "opacity", second) or "1"
            assert shown == wanted.split()[second > 0.4137]
        if loop == "alternate":
            assert (value_at(path, "opacity", 1.7) or "1") == wanted[0]


def test_what_is_seen_twice_moves_all_the_while() -> None:
    curves = circle(np.array([50.0, 40.0]), 30.0)
    part = formula_part(curves, spin(0.4, (30.0, 20.0)))
    part = replace(part, paint=Shown((-1, 0.3), (0.6, 0.9)))
    text = smil_svg(Movement((part,), Box(0, 0, 100, 100)), duration=1.0)
    (path,) = moving_paths(ET.fromstring(text))
    ((shown, _),) = curves_of(path_at(path, 0.75))
    assert np.abs(shown - part.curves(np.array([0.75]))[0]).max() < 0.05


def test_every_value_has_the_same_commands_and_the_file_rests_at_its_start() -> None:
    movement = sample_movement()
    root = ET.fromstring(smil_svg(movement))
    (still,) = root.findall(f"{SVG}path")
    (moving,) = moving_paths(root)
    assert not list(still), "a part at rest is not animated, and has no twin"
    assert commands_of(moving.attrib["d"]) == "mcz"
    for second, t in ((0.0, 0.0), (2.0, 1.0), (9.0, 1.0)):
        (frame,) = movement.at(np.array([t]))
        exact = curves_of(frame_svg(frame).rpartition(' d="')[2].partition('"')[0])
        for (shown, _), (curves, _) in zip(curves_of(path_at(moving, second)), exact, strict=True):
            np.testing.assert_allclose(shown, curves, atol=1e-9)
    resting = curves_of(moving.attrib["d"])
    np.testing.assert_allclose(resting[0][0], curves_of(path_at(moving, 0.0))[0][0], atol=1e-9)


def test_the_base_takes_no_part_in_the_movement() -> None:
    """Or an optimiser that writes it in other numbers would destroy the picture."""
    (moving,) = moving_paths(ET.fromstring(smil_svg(sample_movement(), loop="alternate")))
    before = [path_at(moving, second) for second in (0.0, 0.7, 3.1)]
    moving.set("d", moving.attrib["d"].replace("5", "7"))
    assert [path_at(moving, second) for second in (0.0, 0.7, 3.1)] == before


@pytest.mark.parametrize("loop", ["once", "repeat", "alternate"])
def test_loops_say_when(loop: Loop) -> None:
    root = ET.fromstring(smil_svg(sample_movement(), duration=1.5, loop=loop, keyframes=3))
    for element in root.iter(f"{SVG}animate"):
        attributes = element.attrib
        values = attributes["values"].split(";")
        assert attributes["dur"] == ("3s" if loop == "alternate" else "1.5s")
        assert (attributes.get("fill") == "freeze") == (loop == "once")
        assert (attributes.get("repeatCount") == "indefinite") == (loop != "once")
        if loop == "alternate":
            assert attributes["keyTimes"] == "0;.25;.5;.75;1"
            assert values == values[::-1]
        else:
            assert attributes["keyTimes"] == "0;.5;1"


def test_the_way_back_eases_as_the_way_there_seen_backwards() -> None:
    text = smil_svg(sample_movement(), easing="ease-in", loop="alternate", keyframes=2)
    element = moving_paths(ET.fromstring(text))[0].find(f"{SVG}animate[@attributeName='d']")
    assert element is not None
    assert element.attrib["calcMode"] == "spline"
    assert element.attrib["keySplines"] == ".42 0 1 1;0 0 .58 1"


def test_a_twin_stands_still_for_those_who_ask() -> None:
    text = smil_svg(sample_movement(Style(STRIPES), Style(Colour(1, 0, 0))))
    root = ET.fromstring(text)
    twin = root.find(f"{SVG}g[@class='shapetween-still']")
    assert twin is not None
    assert twin.attrib["display"] == "none", "nothing shows it where style sheets are not read"
    assert not list(twin.iter(f"{SVG}animate"))
    moving = moving_paths(root)
    assert [path.attrib["d"] for path in twin] == [path.attrib["d"] for path in moving]
    animated = {
        g.attrib["id"] for g in root.iter(f"{SVG}linearGradient") if g.find(".//*/*") is not None
    }
    used = {path.attrib["fill"] for path in twin}
    assert animated
    assert not used & {f"url(#{name})" for name in animated}
    assert "prefers-reduced-motion" in text


@pytest.mark.parametrize("keyframes", ["auto", 3])
def test_a_rest_at_both_ends(keyframes: Literal["auto"] | int) -> None:
    """A plain movement too can stand still, and without a rest it is as it always was."""
    movement = sample_movement()
    loops: list[tuple[Loop, list[tuple[float, float]]]] = [
        ("once", [(0.4, 0), (1.5, 0.5), (2.5, 1), (9, 1)]),
        ("repeat", [(0.4, 0), (1.5, 0.5), (2.6, 1), (2.9, 1), (3.4, 0), (4.5, 0.5)]),
        ("alternate", [(0.4, 0), (1.5, 0.5), (2.6, 1), (2.9, 1), (4, 0.5), (5.4, 0), (9, 0.5)]),
    ]
    for loop, places in loops:
        text = smil_svg(movement, loop=loop, hold=0.5, keyframes=keyframes)
        (path,) = moving_paths(ET.fromstring(text))
        for second, t in places:
            ((shown, _),) = curves_of(path_at(path, second))
            exact = movement.parts[1].curves(np.array([t]))[0]
            np.testing.assert_allclose(shown, exact, atol=0.03, err_msg=f"{loop} {second}")
        assert smil_svg(movement, loop=loop, hold=0.0) == smil_svg(movement, loop=loop)


def shown_legs(root: ET.Element, share: float) -> list[int]:
    """The legs that are displayed at a share of the whole, as SMIL defines it."""
    legs = []
    for k, group in enumerate(root.findall(f"{SVG}g[@class='shapetween-moving']/{SVG}g")):
        times, values = animation(group, "display")
        if values[np.searchsorted(times, share, side="right") - 1] == "inline":
            legs.append(k)
    return legs


@pytest.mark.parametrize("hold", [0.0, 0.7])
@pytest.mark.parametrize("loop", ["once", "repeat", "alternate"])
def test_one_leg_of_a_chain_is_shown_at_any_time(loop: Loop, hold: float) -> None:
    text = smil_svg(*sample_chain(), loop=loop, hold=hold, easing="ease")
    root = ET.fromstring(text)
    groups = root.findall(f"{SVG}g[@class='shapetween-moving']/{SVG}g")
    assert [group.get("display") for group in groups] == [None, "none", "none"]
    edges = [time for group in groups for time in animation(group, "display")[0]]
    shares = np.union1d(np.linspace(0, 1, 301), edges)
    order = [shown_legs(root, share) for share in shares]
    assert all(len(legs) == 1 for legs in order)
    turns = [before for before, after in pairwise([*order, [-1]]) if before != after]
    assert turns == [[0], [1], [2], *([[1], [0]] if loop == "alternate" else [])]


@pytest.mark.parametrize("loop", ["once", "repeat", "alternate"])
def test_legs_have_a_structure_and_ids_of_their_own(loop: Loop) -> None:
    legs = sample_chain()
    root = ET.fromstring(smil_svg(*legs, loop=loop, hold=0.3, duration=1.0))
    structures = []
    for k, group in enumerate(root.findall(f"{SVG}g[@class='shapetween-moving']/{SVG}g")):
        commands: set[str] = set()
        for path, part in zip(group.findall(f"{SVG}path"), legs[k].parts, strict=True):
            for t in (0.0, 0.25, 0.5, 0.999):
                shown = curves_of(path_at(path, k * 1.3 + 0.3 + t))
                exact = part.curves(np.array([t]))[0]
                found = np.concatenate([curves for curves, _ in shown]) if shown else exact
                np.testing.assert_allclose(found, exact, atol=0.03)
            commands.add(commands_of(path.attrib["d"]))
        structures.append(commands)
    assert structures == [{"mcz"}, {"mcz", "mczmcz"}, {"mcz"}]
    ids = [element.attrib["id"] for element in root.iter() if "id" in element.attrib]
    assert len(ids) == len(set(ids))
    twin = root.find(f"{SVG}g[@class='shapetween-still']")
    assert twin is not None
    assert [path.attrib["d"] for path in twin] == [path.attrib["d"] for path in legs_paths(root, 0)]


def legs_paths(root: ET.Element, leg: int) -> Sequence[ET.Element]:
    groups = root.findall(f"{SVG}g[@class='shapetween-moving']/{SVG}g")
    return groups[leg].findall(f"{SVG}path")


def test_many_legs_have_finer_times() -> None:
    """Or the moments of each would be rounded to coarse steps."""
    leg = sample_movement()
    root = ET.fromstring(smil_svg(*[leg] * 40, keyframes=121, loop="repeat"))
    for k in (0, 20, 39):
        element = legs_paths(root, k)[1].find(f"{SVG}animate[@attributeName='d']")
        assert element is not None
        steps = np.diff(played(element, "keyTimes")[:, 0]) * 40
        moving = steps[(steps > 0) & (steps < 0.5)]
        assert len(moving) == 120
        np.testing.assert_allclose(moving, 1 / 120, rtol=0.01)


def test_names_are_escaped_and_ids_unique() -> None:
    curves = circle(np.array([5.0, 5.0]), 3.0)
    names = ["a", "a", 'x"<&>y', "two words", "", "g\0\x01é", "a"]
    styles = (Style(STRIPES), Style(replace(STRIPES, points=(0, 0, 9, 9))))
    parts = tuple(formula_part(curves, rest, *styles, name) for name in names)
    movement = Movement(parts, Box(0, 0, 10, 10), '1 < 2 & "3" \0')
    for text in (smil_svg(movement), frame_svg(movement.at(np.array([0.5]))[0])):
        root = ET.fromstring(text)
        ids = [e.attrib["id"] for e in root.iter() if "id" in e.attrib]
        assert len(ids) == len(set(ids))
        assert ids.count("a") == 1
        assert {'x"<&>y', "gé"} <= set(ids)
        assert root.findtext(f"{SVG}title") == '1 < 2 & "3" '
        for reference in re.findall(r"url\(#([^)]*)\)", text):
            assert reference in ids


def test_files_of_other_contents_have_other_gradients() -> None:
    stripes = Style(STRIPES)
    frames = sample_movement(stripes, stripes).at(np.array([0.0, 0.5]))
    names = [re.findall(r"url\(#([^)]*)\)", frame_svg(frame)) for frame in frames]
    assert names[0]
    assert not set(names[0]) & set(names[1])


def test_the_same_movement_is_the_same_text() -> None:
    assert smil_svg(sample_movement()) == smil_svg(sample_movement())


def test_fixed_keyframes_are_even() -> None:
    times, values = animation(
        moving_paths(ET.fromstring(smil_svg(sample_movement(), keyframes=5)))[0], "d"
    )
    assert times.tolist() == [0, 0.25, 0.5, 0.75, 1]
    assert len(values) == 5


def test_styles_that_change_kind_take_turns() -> None:
    radial = Gradient("radial", (60, 50, 30, 50, 45), (1, 0, 0, 1, 0, 0), STOPS)
    root = ET.fromstring(smil_svg(sample_movement(Style(STRIPES), Style(radial)), loop="alternate"))
    first, second = moving_paths(root)
    assert first.attrib["d"] == second.attrib["d"]
    assert "visibility" not in first.attrib
    assert second.attrib["visibility"] == "hidden"
    times, values = animation(first, "visibility")
    assert times.tolist() == [0, 0.25, 0.75]
    assert values == ["visible", "hidden", "visible"]


def test_an_empty_movement_is_an_empty_drawing() -> None:
    root = ET.fromstring(smil_svg(Movement((), Box(0, 0, 10, 10))))
    assert root.attrib["viewBox"] == "0 0 10 10"
    assert not list(root.iter(f"{SVG}path"))


def test_frames_hold_paths_only() -> None:
    """Filled and stroked, with holes; no transform, no command but M, C and Z."""
    (drawing,) = sample_movement(Style(STRIPES, opacity=0.5, fill_rule="evenodd")).at(np.zeros(1))
    root = ET.fromstring(frame_svg(drawing))
    kinds = {element.tag.removeprefix(SVG) for element in root.iter()}
    assert kinds == {"svg", "title", "defs", "linearGradient", "stop", "path"}
    ring, front = root.findall(f"{SVG}path")
    assert ring.attrib["id"] == "ring"
    assert ring.attrib["fill"] == "#396"
    assert re.sub("[^A-Za-z]", "", ring.attrib["d"]) == "MCZMCZ"
    assert front.attrib["fill"].startswith("url(#")
    assert (front.attrib["opacity"], front.attrib["fill-rule"]) == (".5", "evenodd")


def test_precision_is_that_of_the_file() -> None:
    curves = circle(np.array([1 / 3, 1 / 3]), 0.1)
    movement = Movement((formula_part(curves, spin(0.1)),), Box(0, 0, 1, 1))
    for precision in (2, 6):
        text = smil_svg(movement, precision=precision)
        d = moving_paths(ET.fromstring(text))[0].attrib["d"]
        assert max(len(part) for part in re.findall(r"\.(\d+)", d)) == precision


def test_the_twin_says_once_what_is_painted_alike() -> None:
    stroke = Style(None, Stroke(Colour(1, 0, 0), 2.0, cap="round"))
    parts = tuple(
        formula_part(circle(np.array([x, 50.0]), 9.0), spin(0.3, (5, 0)), stroke, stroke, name)
        for x, name in ((30.0, "one"), (60.0, "other"))
    )
    text = smil_svg(Movement(parts, Box(0, 0, 100, 100)))
    (twin,) = (
        each
        for each in ET.fromstring(text).iter(f"{SVG}g")
        if each.get("class") == "shapetween-still"
    )
    assert (twin.get("stroke"), twin.get("stroke-linecap")) == ("#f00", "round")
    assert [sorted(path.attrib) for path in twin] == [["d"]] * 2
