"""The JavaScript module draws what the movement is, at any time."""

import json
import re
from pathlib import Path

import numpy as np
import pytest

from shapetween.base.arrays import Floats
from shapetween.formats.module.writer import module, module_text
from shapetween.formats.options import STARTS, WriteOptions
from shapetween.formats.table import Segments
from shapetween.geometry.bezier import evaluate
from shapetween.model.drawing import Box
from shapetween.model.movement import Movement
from shapetween.model.paint import Colour, Stroke, Style
from tests.movements import circle, formula_part, rest, sample_chain, sample_movement, spin
from tests.node import run_node

TIMES = (0.0, 0.1, 1 / 4, 0.37, 1 / 2, 3 / 4, 0.999, 1.0)
"""Times at which modules are asked: ends, quarters, and some that are no knot."""


def paths(text: str, folder: Path, times: tuple[float, ...], parts: int) -> list[list[str]]:
    """What the module says of every part at every time."""
    (folder / "out.mjs").write_text(text, "utf-8")
    return list(
        run_node(
            'import d from "./out.mjs";\n'
            f"const times = {json.dumps(times)}, parts = [...Array({parts}).keys()];\n"
            "console.log(JSON.stringify(times.map(t => parts.map(part => d(t, part)))));",
            folder,
        )
    )


def drawn_curves(text: str) -> Floats:
    """Curves (N, 4, 2) of path data with absolute M, L, C and Z; lines have handles on them."""
    curves = []
    for ring in re.findall(r"M[^M]*", text):
        steps = re.findall(r"([MLC])([^MLCZ]*)", ring)
        start = at = np.array(steps[0][1].split(), float)
        for letter, numbers in steps[1:]:
            points = np.array(numbers.split(), float).reshape(-1, 2)
            curves.append([at, *(points if letter == "C" else [at, *points, *points])])
            at = points[-1]
        if ring.endswith("Z") and (at != start).any():
            curves.append([at, at, start, start])
    return np.array(curves)


def farthest(text: str, curves: Floats) -> float:
    """The greatest distance of path data from curves (N, 4, 2), where both are drawn."""
    drawn = drawn_curves(text)
    assert drawn.shape == curves.shape
    share = np.linspace(0, 1, 9)
    off = np.sqrt(((evaluate(drawn, share) - evaluate(curves, share)) ** 2).sum(-1))
    # A line that stands for a curve is drawn alike, but not at the same speed.
    lines = (drawn[:, 0] == drawn[:, 1]).all(-1) & (drawn[:, 2] == drawn[:, 3]).all(-1)
    off[lines, 1:-1] = 0
    return float(off.max())


def assert_draws(movement: Movement, text: str, folder: Path, allowed: float = 1.3) -> None:
    """Check the module against the movement, in shares of the error that it may have.

    The last grid step and the bound on handles add to it.
    """
    size = max(movement.box.width, movement.box.height)
    found = paths(text, folder, TIMES, len(movement.parts))
    for k, part in enumerate(movement.parts):
        curves = part.curves(np.array(TIMES))
        for here, row, t in zip(curves, found, TIMES, strict=True):
            bound = 1e-4 if t in (0, 1) else 2.5e-4 * allowed
            assert farthest(row[k], here) <= bound * size, f"part {k} at {t}"


def test_paths_are_those_of_the_movement(tmp_path: Path) -> None:
    movement = sample_movement()
    text = module_text(Segments((movement,)), WriteOptions())
    assert_draws(movement, text, tmp_path)


def test_what_stands_still_is_kept_once() -> None:
    ring = circle(np.array([50.0, 50.0]), 30.0)
    box = Box(0, 0, 100, 100)
    still, moving = (
        module_text(Segments((Movement((formula_part(ring, move),), box),)), WriteOptions())
        for move in (rest, spin(0.3))
    )
    legs = [re.search(r"^const legs=(.*);$", text, re.MULTILINE) for text in (still, moving)]
    sizes = [len(found[1]) for found in legs if found]
    assert sizes[0] < 0.5 * sizes[1]


def test_what_moves_straight_needs_no_terms(tmp_path: Path) -> None:
    part = formula_part(circle(np.array([40.0, 50.0]), 20.0), spin(0.0, (30.0, 10.0)))
    movement = Movement((part,), Box(0, 0, 100, 100))
    assert_draws(movement, module_text(Segments((movement,)), WriteOptions()), tmp_path)


def test_jumps_are_followed(tmp_path: Path) -> None:
    def jump(t: Floats, start: Floats) -> Floats:
        far = np.where(t > 0.437, 25.0, 0.0)[:, None, None, None]
        return np.asarray(spin(0.1)(t, start) + far)

    part = formula_part(circle(np.array([40.0, 50.0]), 20.0), jump)
    movement = Movement((part,), Box(0, 0, 100, 100))
    assert_draws(movement, module_text(Segments((movement,)), WriteOptions()), tmp_path)


def test_a_chain_is_one_time_from_0_to_1(tmp_path: Path) -> None:
    legs = sample_chain()
    text = module_text(Segments(legs, closed=True), WriteOptions())
    times = (0.0, 1 / 6, 1 / 3, 1 / 2, 2 / 3, 0.9, 1.0)
    found = paths(text, tmp_path, times, 2)
    for t, row in zip(times, found, strict=True):
        leg = max(int(np.ceil(3 * t)) - 1, 0)
        parts = legs[leg].parts
        for k, part in enumerate(parts):
            assert farthest(row[k], part.curves(np.array([3 * t - leg]))[0]) < 0.04
        assert row[len(parts) :] == [""] * (2 - len(parts))


def test_styles_are_those_of_the_movement(tmp_path: Path) -> None:
    thick = Stroke(Colour(0, 0, 0), 8.0, cap="round", dashes=(10.0, 4.0))
    first = Style(Colour(1, 0, 0), Stroke(Colour(0, 0, 0), 2.0, dashes=(4.0, 6.0)), opacity=0.3)
    movement = sample_movement(first, Style(Colour(0, 0, 1), thick))
    (tmp_path / "out.mjs").write_text(module_text(Segments((movement,)), WriteOptions()), "utf-8")
    start, end, still = run_node(
        'import { style } from "./out.mjs";\n'
        "console.log(JSON.stringify([style(0, 1), style(1, 1), style(0.3)]))",
        tmp_path,
    )
    assert start["fill"] == "rgb(255,0,0)"
    assert end["fill"] == "rgb(0,0,255)"
    assert (start["opacity"], end["opacity"]) == ("0.3", "1")
    assert (start["stroke-width"], end["stroke-width"]) == ("2", "8")
    assert (start["stroke-dasharray"], end["stroke-dasharray"]) == ("4 6", "10 4")
    assert (start["stroke-linecap"], end["stroke-linecap"]) == ("butt", "round")
    assert still == {"fill": "#396"}


def test_names_cannot_break_out_of_a_page(tmp_path: Path) -> None:
    part = formula_part(circle(np.zeros(2), 1.0), spin(0.2), name='</script><!-- "x"')
    movement = Movement((part,), Box(-2, -2, 4, 4))
    text = module_text(Segments((movement,)), WriteOptions())
    assert "</script" not in text
    assert "<!--" not in text
    (tmp_path / "out.mjs").write_text(text, "utf-8")
    script = 'import { parts } from "./out.mjs"; console.log(JSON.stringify(parts))'
    assert run_node(script, tmp_path) == [part.name]


def test_the_same_bytes_twice() -> None:
    segments = Segments((sample_movement(),))
    assert module_text(segments, WriteOptions()) == module_text(segments, WriteOptions())


def test_precision_is_decimals_of_the_drawing(tmp_path: Path) -> None:
    movement = sample_movement()
    text = module_text(Segments((movement,)), WriteOptions(precision=5))
    start = paths(text, tmp_path, (0.0,), 2)[0][1]
    assert farthest(start, movement.parts[1].curves(np.zeros(1))[0]) < 1e-5


def test_types_stand_beside_it(tmp_path: Path) -> None:
    made = module(Segments((sample_movement(),)), WriteOptions())
    assert isinstance(made.content, str)
    exported = set(
        re.findall(r"^export (?:const|function|default function) (\w+)", made.content, re.MULTILINE)
    )
    declared = re.findall(
        r"^export (?:default )?(?:declare )?(?:function|const) (\w+)",
        made.beside[".d.mts"],
        re.MULTILINE,
    )
    assert exported == set(declared)


@pytest.mark.parametrize("start", STARTS)
def test_every_start_has_its_code_and_no_other(tmp_path: Path, start: str) -> None:
    segments = Segments((sample_movement(),))
    text = module_text(segments, WriteOptions(start=start))  # type: ignore[arg-type]
    assert text.count("const begin=") == 1
    (tmp_path / "out.mjs").write_text(text, "utf-8")
    assert run_node(
        'import * as m from "./out.mjs"; console.log(typeof m.play == "function")', tmp_path
    )
