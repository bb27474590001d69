"""The page for those who come from flubber: its pieces of code run as they stand there."""

import re
import sys
import types
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import shapetween as st

ROOT = Path(__file__).resolve().parents[1]
PAGE = (ROOT / "gallery/coming-from-flubber.md").read_text("utf-8")
CODE = re.findall(r"^```python\n(.*?)^```", PAGE, re.MULTILINE | re.DOTALL)


def run(word: str) -> dict[str, Any]:
    """Run the one piece that has a word in it."""
    (code,) = (code for code in CODE if word in code)
    found: dict[str, Any] = {"__name__": "recipe"}
    exec(compile(code, word, "exec"), found)
    return found


def test_paths_and_polygons(capsys: pytest.CaptureFixture[str]) -> None:
    half = run("half = ")["half"]
    assert half(0.5).startswith("M")
    run("import shapely")
    *_, area, whole = capsys.readouterr().out.split()
    assert 8 < float(area) < 16
    assert whole == "True"


def test_matplotlib(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    matplotlib = pytest.importorskip("matplotlib", reason="matplotlib is not installed")
    matplotlib.use("Agg")
    monkeypatch.chdir(tmp_path)
    found = run("FuncAnimation(")
    assert (tmp_path / "star.gif").stat().st_size > 10_000
    assert len(found["patch"].get_path().vertices) > 20


class Mobject:
    """What the recipe uses of Manim's VMobject, by its documentation."""

    def __init__(self, **style: Any) -> None:
        self.points: list[Any] = []

    def clear_points(self) -> None:
        self.points = []

    def start_new_path(self, point: Any) -> None:
        assert len(self.points) % 4 == 0
        self.points.append(point)

    def add_cubic_bezier_curve_to(self, *points: Any) -> None:
        if len(self.points) % 4 == 0:
            self.points.append(self.points[-1])
        self.points += points


class Scene:
    def play(self, animation: Any, run_time: float) -> None:
        mobject, shown = animation
        for t in (0.0, 0.5, 1.0):
            shown(mobject, t)


def test_manim(monkeypatch: pytest.MonkeyPatch) -> None:
    """With Manim itself where it is installed, else with what is used of it."""
    try:
        import manim  # type: ignore[import-not-found]  # noqa: F401
    except ImportError:
        stand_in = types.ModuleType("manim")
        stand_in.__dict__.update(
            Scene=Scene, VMobject=Mobject, UpdateFromAlphaFunc=lambda *both: both
        )
        monkeypatch.setitem(sys.modules, "manim", stand_in)
    monkeypatch.chdir(ROOT)
    found = run("VMobject(")
    if found["Scene"] is Scene:
        found["Animals"]().construct()
    mobject = found["VMobject"]()
    found["shown"](mobject, 0.5)
    points = np.asarray(mobject.points)[:, :2]
    assert len(points) % 4 == 0
    low, high = points.min(axis=0), points.max(axis=0)
    assert -3 < low[1] < high[1] < 3
    wanted = sum(len(ring.curves) for s in found["morph"].at(0.5).shapes for ring in s.rings)
    assert len(points) == 4 * wanted


def test_the_table_names_what_there_is() -> None:
    for name in set(re.findall(r"st\.(\w+)", PAGE)):
        assert hasattr(st, name)
