"""Android's drawable compiles, and shows the movement at every time."""

import re
import shutil
import subprocess
import xml.etree.ElementTree as ET
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from shapetween.formats.android import vector_drawable
from shapetween.formats.options import WriteOptions
from shapetween.formats.table import Segments
from shapetween.model.drawing import Box
from shapetween.model.movement import Movement
from shapetween.model.paint import Colour, Stroke, Style
from shapetween.svg.write.sequence import frame_svg
from tests.browser import difference
from tests.movements import circle, formula_part, sample_chain, sample_movement, spin
from tests.paints import BLUE, DISC, EVERY, RED, STRIPES, THICK, THIN
from tests.players import resvg_pictures

A = "{http://schemas.android.com/apk/res/android}"
AAPT = "{http://schemas.android.com/aapt}"

FRAMEWORK = Path("/usr/share/android-framework-res/framework-res.apk")

NUMBER = re.compile(r"-?\d*\.?\d+")


def written(*movements: Movement, **options: Any) -> str:
    made = vector_drawable(Segments(movements), WriteOptions(**options))
    assert isinstance(made.content, str)
    return made.content


def blended(first: str, last: str, kind: str, share: float) -> str:
    """What Android makes of two values."""
    if kind == "colorType":
        ends = [[int(text[k : k + 2], 16) / 255 for k in (1, 3, 5)] for text in (first, last)]
        light = [(1 - share) * a**2.2 + share * b**2.2 for a, b in zip(*ends, strict=True)]
        return "#" + "".join(f"{round(255 * v ** (1 / 2.2)):02x}" for v in light)
    numbers = [[float(v) for v in NUMBER.findall(text)] for text in (first, last)]
    assert NUMBER.sub("", first).replace("-", "") == NUMBER.sub("", last).replace("-", "") or (
        kind == "pathType" and len(numbers[0]) == len(numbers[1])
    )
    values = iter((1 - share) * a + share * b for a, b in zip(*numbers, strict=True))
    return NUMBER.sub(lambda _: f" {next(values):.4f}", first)


def at(text: str, milliseconds: float) -> str:
    """The drawable at a moment, as SVG."""
    root = ET.fromstring(text)
    vector = next(root.iter("vector"))
    states = {}
    for path in vector.iter("path"):
        states[path.get(f"{A}name")] = {
            name.removeprefix(A): value for name, value in path.attrib.items()
        }
    for target in root.iter("target"):
        state = states[target.get(f"{A}name")]
        for run in target.iter("set"):
            if run.get(f"{A}ordering") != "sequentially":
                continue
            now = 0.0
            for piece in run:
                now += float(piece.get(f"{A}startOffset", 0))
                length = float(piece.get(f"{A}duration", 0))
                assert length >= 1
                if now <= milliseconds:
                    share = min((milliseconds - now) / length, 1.0)
                    first, last, kind, name = (
                        piece.get(f"{A}{key}") or ""
                        for key in ("valueFrom", "valueTo", "valueType", "propertyName")
                    )
                    state[name] = blended(first, last, kind, share)
                now += length
    defs: list[str] = []
    shapes = []
    for path, state in zip(vector.iter("path"), states.values(), strict=True):
        fill = state.get("fillColor", "none")
        for attribute in path.iter(f"{AAPT}attr"):
            gradient = attribute[0]
            defs.append(svg_gradient(gradient, f"g{len(defs)}"))
            if attribute.get("name") == "android:fillColor":
                fill = f"url(#g{len(defs) - 1})"
            else:
                state["strokeColor"] = f"url(#g{len(defs) - 1})"
        shapes.append(
            f'<path d="{state["pathData"]}" fill="{fill}"'
            f' fill-opacity="{state.get("fillAlpha", 1)}"'
            f' fill-rule="{state.get("fillType", "nonzero").lower()}"'
            f' stroke="{state.get("strokeColor", "none")}"'
            f' stroke-opacity="{state.get("strokeAlpha", 1)}"'
            f' stroke-width="{state.get("strokeWidth", 0)}"'
            f' stroke-linecap="{state.get("strokeLineCap", "butt")}"'
            f' stroke-linejoin="{state.get("strokeLineJoin", "miter")}"/>'
        )
    size = f"{vector.get(f'{A}viewportWidth')} {vector.get(f'{A}viewportHeight')}"
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {size}">'
        f"<defs>{''.join(defs)}</defs>{''.join(shapes)}</svg>"
    )


def svg_gradient(gradient: ET.Element, name: str) -> str:
    """A gradient as SVG has it."""
    names = {
        "startX": "x1",
        "startY": "y1",
        "endX": "x2",
        "endY": "y2",
        "centerX": "cx",
        "centerY": "cy",
        "gradientRadius": "r",
    }
    kind = gradient.get(f"{A}type")
    told = " ".join(
        f'{svg}="{gradient.get(A + own)}"' for own, svg in names.items() if gradient.get(A + own)
    )
    stops = "".join(
        f'<stop offset="{item.get(A + "offset")}" stop-color="#{(item.get(A + "color") or "")[3:]}"'
        f' stop-opacity="{int((item.get(A + "color") or "")[1:3], 16) / 255}"/>'
        for item in gradient
    )
    tag = f"{kind}Gradient"
    return f'<{tag} id="{name}" gradientUnits="userSpaceOnUse" {told}>{stops}</{tag}>'


def assert_shows(text: str, movement: Movement, times: tuple[float, ...], colours: float) -> None:
    """Check a movement of two seconds."""
    shots = resvg_pictures([at(text, 2000 * t) for t in times])
    frames = [frame_svg(drawing) for drawing in movement.at(np.array(times, float))]
    for shot, frame, t in zip(shots, resvg_pictures(frames), times, strict=True):
        assert difference(shot, frame) <= 5e-4, f"another picture at {t}"
        assert np.abs(shot - frame).mean() < colours, f"other colours at {t}"


QUARTERS = (0.0, 0.25, 0.5, 0.75, 1.0)

PLAIN = [
    EVERY[0],
    EVERY[1],
    EVERY[2],
    pytest.param(Style(None, Stroke(RED, 2.0)), Style(None, Stroke(BLUE, 8.0)), id="lines"),
    pytest.param(Style(STRIPES), Style(STRIPES, fill_rule="evenodd"), id="gradient"),
]


@pytest.mark.parametrize(("first", "last"), PLAIN)
def test_it_shows_what_the_frames_show(first: Style, last: Style) -> None:
    ring = circle(np.array([50.0, 50.0]), 30.0)
    movement = Movement((formula_part(ring, spin(0.3), first, last),), Box(0, 0, 100, 100))
    assert_shows(written(movement), movement, QUARTERS, 0.5)


def test_a_gradient_that_changes_is_exact_at_both_ends() -> None:
    movement = sample_movement(Style(STRIPES), Style(Colour(0, 0.5, 0)))
    made = vector_drawable(Segments((movement,)), WriteOptions())
    assert made.warnings == (
        "front: its gradient fades from first to last where it stands in .xml",
    )
    assert isinstance(made.content, str)
    assert_shows(made.content, movement, (0.0, 1.0), 0.5)


def test_an_easing_is_in_the_times() -> None:
    from shapetween.timing.easing import easing_function

    movement = sample_movement()
    text = written(movement, easing="ease-in")
    time = float(easing_function("ease-in")(np.array([0.4]))[0])
    shots = resvg_pictures([at(text, 800), frame_svg(movement.at(np.array([time]))[0])])
    assert difference(*shots) <= 5e-4


def test_chains_show_one_leg_at_a_time() -> None:
    legs = sample_chain()
    text = written(*legs, duration=1.0, hold=0.5)
    moments = (200, 1000, 1700, 2500, 4000, 4500, 9000)
    shown = ((0, 0.0), (0, 0.5), (1, 0.0), (1, 0.5), (2, 0.5), (2, 1.0), (2, 1.0))
    shots = resvg_pictures([at(text, moment) for moment in moments])
    frames = [frame_svg(legs[leg].at(np.array([t]))[0]) for leg, t in shown]
    for shot, frame, moment in zip(shots, resvg_pictures(frames), moments, strict=True):
        assert difference(shot, frame) <= 5e-4, moment


def test_what_android_has_not_is_told_of() -> None:
    movement = sample_movement(Style(RED, THIN), Style(DISC, THICK))
    told = vector_drawable(Segments((movement,)), WriteOptions()).warnings
    assert "front: dashes become a whole line in .xml" in told
    assert "front: a radial gradient has its focus at its centre in .xml" in told


@pytest.mark.parametrize(("first", "last"), [*EVERY, *PLAIN[3:]])
def test_android_compiles_it(tmp_path: Path, first: Style, last: Style) -> None:
    program = shutil.which("aapt2")
    if program is None or not FRAMEWORK.is_file():
        pytest.skip("Android's compiler or its framework is not installed")
    place = tmp_path / "res" / "drawable" / "morph.xml"
    place.parent.mkdir(parents=True)
    place.write_text(written(sample_movement(first, last)), "utf-8")
    manifest = tmp_path / "AndroidManifest.xml"
    manifest.write_text(
        '<manifest xmlns:android="http://schemas.android.com/apk/res/android" package="a.b">'
        '<uses-sdk android:minSdkVersion="24"/><application/></manifest>'
    )
    packed, linked = tmp_path / "packed.zip", tmp_path / "linked.apk"
    commands: tuple[list[str | Path], ...] = (
        [program, "compile", "-o", packed, "--dir", tmp_path / "res"],
        [program, "link", "-o", linked, "-I", FRAMEWORK, "--manifest", manifest, packed],
    )
    for command in commands:
        run = subprocess.run(command, capture_output=True, text=True, timeout=60, check=False)
        assert run.returncode == 0, run.stderr
        assert "TOO_LARGE" not in run.stderr
