"""The report's own measuring, on little; and flubber's times as a bound, where it is installed."""

import json
from pathlib import Path
from statistics import median

import numpy as np
import pytest

from tests.benchmarks.__main__ import plotted
from tests.benchmarks.categories import categories
from tests.benchmarks.measuring import (
    PAIRS,
    ROOT,
    RivalsMissingError,
    exponent,
    machine,
    peak_memory,
    peaks,
    read,
    rivals,
    scaling,
    speeds,
    startups,
)


def test_what_is_measured_is_there() -> None:
    found = speeds(read("hammer"), read("wrench"), rounds=1)
    assert {"match", "mesh", "move"} <= found.stages.keys()
    assert 0 < max(found.stages.values()) < found.whole
    assert found.frame > 0
    assert found.written > 0
    assert scaling(3)[0] == 9
    assert "Python" in machine()


def test_the_drawings_are_there() -> None:
    assert all(len(read(name).shapes) == 1 for pair in PAIRS for name in pair)


def test_an_exponent_is_the_power() -> None:
    sizes = np.array([10.0, 100.0, 1000.0])
    assert exponent(sizes, 3 * sizes**1.5) == pytest.approx(1.5)


def test_a_plot_has_a_line_for_each_size() -> None:
    rows = np.array([[100.0, 0.01, 0.001], [10_000.0, 1.0, 0.1]])
    assert plotted({"quads": rows, "points": rows}).count("<polyline") == 2


def test_categories_are_the_repositorys_or_a_folders(tmp_path: Path) -> None:
    found = categories(None, 3)
    assert found.keys() == {"silhouettes", "small drawings", "large, made"}
    assert len(found["small drawings"]) == 3
    file = ROOT / "gallery/inputs/hammer.svg"
    rows = [{"category": "tools", "a": str(file), "b": str(file)}] * 5
    (tmp_path / "pairs.json").write_text(json.dumps(rows), "utf-8")
    assert [len(pairs) for pairs in categories(tmp_path, 2).values()] == [2]


def test_memory_is_counted_by_stage() -> None:
    found = peaks(read("hammer"), read("wrench"))
    assert {"match", "mesh", "move", "write", "whole"} <= found.keys()
    assert max(found.values()) == found["whole"]
    assert found["write"] > 0


@pytest.mark.skipif("not config.getoption('benchmark_enable')", reason="takes some seconds")
def test_commands_start_quickly(tmp_path: Path) -> None:
    ratios = {name: mine / floor for name, (mine, floor) in startups(tmp_path, 3).items()}
    assert ratios["shapetween --help"] < 2.5
    assert max(ratios.values()) < 6
    assert peak_memory("import shapetween") < 200


@pytest.mark.skipif("not config.getoption('benchmark_enable')", reason="takes half a minute")
def test_beside_flubber() -> None:
    pairs = [(read(a), read(b)) for a, b in PAIRS]
    try:
        theirs = rivals(pairs)
    except RivalsMissingError as missing:
        pytest.skip(str(missing))
    ours = [speeds(*pair) for pair in pairs]
    both = [(mine, row["flubber"]) for mine, row in zip(ours, theirs, strict=True)]
    setups = median(mine.whole / setup for mine, (setup, _) in both)
    frames = median(mine.frame / frame for mine, (_, frame) in both)
    print(f"times flubber's: set-up {setups:.1f}, frame {frames:.2f}")
    assert setups < 60
    assert frames < 2
