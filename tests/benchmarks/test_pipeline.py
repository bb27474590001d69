"""Seconds of every stage on the pair of the gallery, and of the projective method by mesh size.

python -m pytest tests/benchmarks/test_pipeline.py --benchmark-enable

Each benchmark keeps a ratio in its extra information, so that figures of different machines
compare: how many times as long it takes as reading both drawings, or per quad as the smallest mesh.
"""

import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pytest
from pytest_benchmark.fixture import BenchmarkFixture

from shapetween.interpolate.projective import Projective
from shapetween.mesh.pair import MeshPair
from shapetween.model.drawing import Drawing
from shapetween.pipeline import Prepared, prepare
from shapetween.svg.read.reader import read_svg
from shapetween.svg.write.smil import smil_svg
from tests.strategies import grid

INPUTS = Path(__file__).resolve().parents[2] / "gallery/inputs"
FRAMES = np.linspace(0, 1, 60)
ROUNDS = 5


def read(name: str) -> Drawing:
    return read_svg((INPUTS / name).read_bytes(), name)


def read_both() -> tuple[Drawing, Drawing]:
    return read("horse.svg"), read("kangaroo.svg")


@pytest.fixture(scope="module")
def drawings() -> tuple[Drawing, Drawing]:
    return read_both()


@pytest.fixture(scope="module")
def prepared(drawings: tuple[Drawing, Drawing]) -> Prepared:
    return prepare(*drawings)


@pytest.fixture(scope="module")
def reading(drawings: tuple[Drawing, Drawing]) -> float:
    """Seconds to read both drawings, once all is imported."""
    assert drawings
    return min(seconds_of_reading() for _ in range(ROUNDS))


def seconds_of_reading() -> float:
    start = time.perf_counter()
    read_both()
    return time.perf_counter() - start


def note(benchmark: BenchmarkFixture, name: str, unit: float) -> None:
    if benchmark.stats is not None:  # None where benchmarks are off
        benchmark.extra_info[name] = round(benchmark.stats.stats.min / unit, 2)


class Watch:
    """An observer that adds up the seconds of one stage, nested ones included."""

    def __init__(self, stage: str) -> None:
        self.stage = stage
        self.seconds = 0.0

    @contextmanager
    def __call__(self, stage: str) -> Iterator[None]:
        start = time.perf_counter()
        yield
        if stage == self.stage:
            self.seconds += time.perf_counter() - start


def test_read(benchmark: BenchmarkFixture) -> None:
    assert all(drawing.shapes for drawing in benchmark(read_both))


@pytest.mark.parametrize("stage", ["fit", "regions", "match", "mesh", "move"])
def test_stage_of_preparation(
    benchmark: BenchmarkFixture, drawings: tuple[Drawing, Drawing], reading: float, stage: str
) -> None:
    """A round is a whole preparation; the stage's own seconds are in the extra information."""
    watches: list[Watch] = []

    def run() -> Prepared:
        watches.append(Watch(stage))
        return prepare(*drawings, observe=watches[-1])

    assert benchmark.pedantic(run, rounds=ROUNDS, warmup_rounds=1).filled  # type: ignore[no-untyped-call]
    seconds = min(watch.seconds for watch in watches)
    assert seconds > 0, "no such stage"
    benchmark.extra_info["seconds"] = round(seconds, 4)
    benchmark.extra_info["times_reading"] = round(seconds / reading, 2)


def test_carry(benchmark: BenchmarkFixture, prepared: Prepared, reading: float) -> None:
    """Outlines of all frames in one call."""
    drawn = benchmark(prepared.movement.at, FRAMES)
    assert len(drawn) == len(FRAMES)
    note(benchmark, "times_reading", reading)


def test_write(benchmark: BenchmarkFixture, prepared: Prepared, reading: float) -> None:
    """An animated file, with the frames that are looked at to choose the keyframes."""
    assert benchmark(smil_svg, prepared.movement).startswith("<svg")
    note(benchmark, "times_reading", reading)


#: Seconds a quad of the smallest mesh, once it has been measured.
SMALLEST: dict[str, float] = {}


def bent(side: int) -> MeshPair:
    """A square grid of quads that becomes an arch."""
    points, quads = grid(side, side)
    x, y = (points - points.min(axis=0)).T / np.ptp(points, axis=0).max()
    angle, radius = np.pi * (1 - x), 1.5 - y
    arch = np.stack([radius * np.cos(angle), -radius * np.sin(angle)], axis=1)
    return MeshPair(np.stack([x, y], axis=1), arch, quads)


@pytest.mark.parametrize("side", [10, 32, 100])
def test_projective_by_mesh_size(benchmark: BenchmarkFixture, side: int) -> None:
    """60 times of 100, 1,024 and 10,000 quads; the last in less than three seconds."""
    pair = bent(side)

    def run() -> int:
        return len(Projective(pair).vertices(FRAMES))

    assert benchmark.pedantic(run, rounds=3, warmup_rounds=1) == len(FRAMES)  # type: ignore[no-untyped-call]
    if benchmark.stats is not None:
        each = benchmark.stats.stats.min / side**2
        benchmark.extra_info["times_smallest_a_quad"] = round(
            each / SMALLEST.setdefault("seconds", each), 2
        )
