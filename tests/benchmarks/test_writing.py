"""How long writing takes, by the size of the drawing."""

import numpy as np
import pytest
from pytest_benchmark.fixture import BenchmarkFixture

from shapetween.base.arrays import Curves
from shapetween.model.drawing import Box
from shapetween.model.movement import Movement
from shapetween.model.paint import Colour, Style
from shapetween.model.part import Part
from shapetween.svg.write.numbers import path_data
from shapetween.svg.write.sequence import frame_svg
from shapetween.svg.write.smil import smil_svg
from shapetween.timing.keyframes import KEYFRAME_TOLERANCE, keyframes
from shapetween.timing.schedule import Schedule
from tests.movements import formula_part, spin

BOX = Box(0, 0, 100, 100)


def flower(curves: int) -> Curves:
    """A closed ring of as many curves, (N, 4, 2)."""
    angle = np.linspace(0, 2 * np.pi, 3 * curves, endpoint=False)
    radius = 30 + 8 * np.cos(7 * angle)
    points = 50 + radius[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    index = (3 * np.arange(curves)[:, None] + np.arange(4)) % len(points)
    return np.asarray(points[index])


def turning(curves: int) -> Part:
    style = Style(Colour(1.0)), Style(Colour(0.0, 0.0, 1.0))
    return formula_part(flower(curves), spin(0.3, (9.0, 4.0)), *style, rings=(curves,))


@pytest.mark.parametrize("curves", [20, 80, 320])
def test_path_data_of_60_frames(benchmark: BenchmarkFixture, curves: int) -> None:
    stack = turning(curves).curves(np.linspace(0, 1, 60))
    texts = benchmark(path_data, stack, [curves], [True], 2)
    assert len(texts) == 60


@pytest.mark.parametrize("curves", [20, 80, 320])
def test_keyframes(benchmark: BenchmarkFixture, curves: int) -> None:
    schedule = Schedule.of("ease-in-out")
    samples = turning(curves).curves(schedule.time).reshape(len(schedule.time), -1, 2)
    picks = benchmark(keyframes, samples, schedule.time, 100 * KEYFRAME_TOLERANCE)
    assert 2 < len(picks) < len(samples)


@pytest.mark.parametrize("curves", [20, 80, 320])
def test_animated_file(benchmark: BenchmarkFixture, curves: int) -> None:
    movement = Movement((turning(curves),), BOX)
    assert benchmark(smil_svg, movement).startswith("<svg")


@pytest.mark.parametrize("curves", [20, 80, 320])
def test_frame_file(benchmark: BenchmarkFixture, curves: int) -> None:
    (drawing,) = Movement((turning(curves),), BOX).at(np.array([0.5]))
    assert benchmark(frame_svg, drawing).startswith("<svg")
