"""What an animated file shows at a moment, worked out from its text as SMIL and SVG define it.

Written for the tests alone, from the recommendations: an answer independent of the writer's.

.. [Smil] *SMIL Animation*, W3C, 2001, sections 3.2 and 3.5.
.. [Svg2] *SVG 2*, section 9.3.
"""

import re
import xml.etree.ElementTree as ET
from collections.abc import Sequence

import numpy as np

from shapetween.base.arrays import Curves, Floats
from shapetween.timing.easing import easing_function

SVG = "{http://www.w3.org/2000/svg}"
_NUMBER = re.compile(r"-?(?:\d+\.?\d*|\.\d+)")
_TOKEN = re.compile(r"[a-df-zA-Z]|-?(?:\d+\.?\d*|\.\d+)(?:e-?\d+)?")


def numbers_of(d: str) -> Floats:
    """All numbers of path data."""
    return np.array([float(text) for text in _TOKEN.findall(d) if not text.isalpha()])


def commands_of(d: str) -> str:
    """All letters of path data."""
    return "".join(text for text in _TOKEN.findall(d) if text.isalpha())


def curves_of(d: str) -> list[tuple[Curves, bool]]:
    """The rings of path data as curves, (N, 4, 2) each, and whether they are closed ([Svg2]_)."""
    return _rings(commands_of_runs(d))


def commands_of_runs(d: str) -> list[tuple[str, list[float]]]:
    """Commands with the numbers after them."""
    runs: list[tuple[str, list[float]]] = []
    for text in _TOKEN.findall(d):
        if text.isalpha():
            runs.append((text, []))
        else:
            runs[-1][1].append(float(text))
    return runs


def _rings(runs: Sequence[tuple[str, list[float]]]) -> list[tuple[Curves, bool]]:
    rings: list[tuple[Curves, bool]] = []
    curves: list[Floats] = []
    here = start = np.zeros(2)

    def finish(*, closed: bool) -> None:
        nonlocal curves
        if curves:
            rings.append((np.array(curves), closed))
        curves = []

    for command, numbers in runs:
        values = np.array(numbers).reshape(-1, 2)
        origin = command.islower()
        if command in "mM":
            finish(closed=False)
            here = start = values[0] + (here if origin else 0)
            assert len(values) == 1, "lines after a move are none of ours"
        elif command in "lL":
            for step in values:
                end = step + (here if origin else 0)
                curves.append(_line(here, end))
                here = end
        elif command in "cC":
            for steps in values.reshape(-1, 3, 2):
                points = steps + (here if origin else 0)
                curves.append(np.array([here, *points]))
                here = points[2]
        else:
            assert command in "zZ", f"{command} is none of ours"
            if np.abs(here - start).max() > 1e-9:
                curves.append(_line(here, start))
            finish(closed=True)
            here = start
    finish(closed=False)
    return rings


def _line(start: Floats, end: Floats) -> Floats:
    third = (end - start) / 3
    return np.array([start, start + third, end - third, end])


def seconds_of(text: str) -> float:
    return float(text.removesuffix("s"))


def progress(element: ET.Element, seconds: float) -> tuple[int, float, int] | None:
    """Interval that is played, the eased share of it, and how many there are; None before it all.

    As [Smil]_ defines it, for the attributes that are written.
    """
    begin = seconds_of(element.get("begin", "0s"))
    duration = seconds_of(element.attrib["dur"])
    if seconds < begin:
        return None
    local = (seconds - begin) / duration
    if element.get("repeatCount") == "indefinite":
        local %= 1.0
    elif local >= 1:
        assert element.get("fill") == "freeze"
        local = 1.0
    count = element.attrib["values"].count(";") if "values" in element.attrib else 1
    discrete = element.get("calcMode") == "discrete"
    times = [float(t) for t in element.get("keyTimes", "").split(";") if t]
    if not times:
        times = np.linspace(0, 1, count + 1).tolist()
    assert len(times) == count + 1
    assert times == sorted(times)
    k = int(np.searchsorted(times, local, side="right")) - 1
    if discrete:
        return k, 0.0, count
    k = min(k, count - 1)
    share = (local - times[k]) / (times[k + 1] - times[k])
    if element.get("calcMode") == "spline":
        rows = element.attrib["keySplines"].split(";")
        assert len(rows) == count
        x1, y1, x2, y2 = (float(v) for v in rows[k].split())
        assert all(0 <= v <= 1 for v in (x1, y1, x2, y2))
        share = float(easing_function(f"cubic-bezier({x1},{y1},{x2},{y2})")(np.array([share]))[0])
    return k, share, count


def path_at(path: ET.Element, seconds: float) -> str:
    """The path data that a path has at a moment, all animations of it summed up."""
    letters, numbers = commands_of(path.attrib["d"]), numbers_of(path.attrib["d"])
    runs = [len(values) for _, values in commands_of_runs(path.attrib["d"])]
    for element in path.findall(f"{SVG}animate[@attributeName='d']"):
        now = progress(element, seconds)
        if now is None:
            continue
        k, share, _ = now
        if "by" in element.attrib:
            texts = [_NUMBER.sub(" 0", element.attrib["by"]), element.attrib["by"]]
            assert element.get("additive") == "sum"
        else:
            texts = element.attrib["values"].split(";")
        assert {commands_of(text) for text in texts} == {letters}
        first, second = numbers_of(texts[k]), numbers_of(texts[k + 1])
        value = (1 - share) * first + share * second
        numbers = numbers + value if element.get("additive") == "sum" else value
    places = np.cumsum([0, *runs])
    return "".join(
        letter + " ".join(repr(v) for v in numbers[start:end].tolist())
        for letter, start, end in zip(letters, places, places[1:], strict=False)
    )


def value_at(element: ET.Element, attribute: str, seconds: float) -> str:
    """The value that an attribute which only jumps has at a moment."""
    value = element.get(attribute, "")
    for jump in element.findall(f"{SVG}set[@attributeName='{attribute}']"):
        if seconds >= seconds_of(jump.get("begin", "0s")):
            assert jump.get("fill") == "freeze"
            value = jump.attrib["to"]
    for animation in element.findall(f"{SVG}animate[@attributeName='{attribute}']"):
        now = progress(animation, seconds)
        if now is not None:
            value = animation.attrib["values"].split(";")[now[0]]
    return value
