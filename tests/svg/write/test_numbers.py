"""Numbers and path data: short, exact to the decimals asked for, and readable by others."""

import re

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays
from svgpathtools import CubicBezier, parse_path

from shapetween.base.arrays import Curves
from shapetween.base.errors import OptionError
from shapetween.geometry.bezier import line_curves
from shapetween.model.drawing import Box, Drawing, Shape
from shapetween.model.outline import Outline
from shapetween.model.paint import Style
from shapetween.svg.write.numbers import decimals_for, decimals_of, number, path_data, written

NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")

reals = st.floats(-1e6, 1e6, allow_subnormal=False)


@st.composite
def rings_of_curves(draw: st.DrawFn) -> tuple[Curves, list[int], list[bool]]:
    """Frames of closed and open rings: (F, N, 4, 2), curves in each ring, which are closed."""
    counts = draw(st.lists(st.integers(1, 4), min_size=1, max_size=3))
    closed = [draw(st.booleans()) for _ in counts]
    frames = draw(st.integers(1, 3))
    stacks = []
    for count, is_closed in zip(counts, closed, strict=True):
        shape = (frames, count, 4, 2)
        curves = draw(arrays.arrays(np.float64, shape, elements=st.floats(-300, 300, width=32)))
        curves[:, 1:, 0] = curves[:, :-1, 3]
        if is_closed:
            curves[:, -1, 3] = curves[:, 0, 0]
        stacks.append(curves)
    return np.concatenate(stacks, axis=1), counts, closed


def parsed(d: str) -> Curves:
    """Control points as svgpathtools reads them; the lines that close rings are left out."""
    curves = [segment for segment in parse_path(d) if isinstance(segment, CubicBezier)]
    points = np.array([segment.bpoints() for segment in curves])
    return np.stack([points.real, points.imag], axis=-1)


@given(rings_of_curves(), st.integers(0, 5))
def test_another_parser_reads_what_was_written(
    rings: tuple[Curves, list[int], list[bool]], decimals: int
) -> None:
    curves, _, closed = rings
    for frame, d in zip(curves, path_data(*rings, decimals), strict=True):
        read = parsed(d)
        assert read.shape == frame.shape
        assert np.abs(read - frame).max() <= 0.5000001 * 10.0**-decimals
        np.testing.assert_array_equal(read, written(frame, decimals) + 0.0)
        commands = re.sub("[^A-Za-z]", "", d)
        assert commands == "".join("MCZ" if is_closed else "MC" for is_closed in closed)


@given(rings_of_curves(), st.integers(0, 4))
def test_every_number_is_as_short_as_it_can_be(
    rings: tuple[Curves, list[int], list[bool]], decimals: int
) -> None:
    for d in path_data(*rings, decimals):
        assert not re.search(r"\.\d*0(?!\d)", d), "a zero ends a fraction"
        assert not re.search(r"(?<![\d.])-?0[\d.]", d), "a zero leads a number"
        assert not re.search(r"-0(?![.\d])|\.(?!\d)", d)
        assert not re.search(r" [-A-Z]|[A-Z] |  ", d), "a space parts nothing"
        # A space before a point is needed only where the number before has no point of its own.
        for before, after in re.findall(r"([-\d.]+) (?=([-\d.]+))", d):
            assert "." not in before or not after.startswith(".")


def test_numbers_are_parted_by_what_they_are_made_of() -> None:
    points = [[0.5, 0.25], [-0.5, 10.0], [0.75, 100.0], [-0.001, 12.75]]
    curve = np.array(points).reshape(1, 1, 4, 2)
    assert path_data(curve, [1], [False], 2) == ("M.5.25C-.5 10 .75 100 0 12.75",)


def test_open_and_closed_rings_side_by_side() -> None:
    curves = np.arange(16.0).reshape(1, 2, 4, 2)
    curves[0, 1, 3] = curves[0, 1, 0]
    (d,) = path_data(curves, [1, 1], [False, True], 0)
    assert d == "M0 1C2 3 4 5 6 7M8 9C10 11 12 13 8 9Z"


def test_no_rings_are_an_empty_path() -> None:
    assert path_data(np.zeros((2, 0, 4, 2)), [], [], 2) == ("", "")


def test_points_that_are_equal_stay_so() -> None:
    curves = np.full((1, 2, 4, 2), 1 / 3)
    (d,) = path_data(curves, [2], [True], 3)
    assert set(NUMBER.findall(d)) == {".333"}


@given(reals, st.integers(0, 6))
def test_single_numbers_read_back(value: float, decimals: int) -> None:
    text = number(value, decimals)
    assert abs(float(text) - value) <= 0.5000001 * 10.0**-decimals + 1e-9
    assert text == "0" or not re.match(r"-?0", text)
    assert "." not in text or not text.endswith(("0", "."))


@pytest.mark.parametrize("size", [1e-3, 1.0, 24.0, 100.0, 512.0, 1e4, 1e6])
def test_default_decimals_suit_the_size(size: float) -> None:
    decimals = decimals_for(Box(0, 0, size, size / 2))
    step = 10.0**-decimals
    assert step <= 1.3e-4 * size or decimals == 0
    assert step >= 1.2e-5 * size or decimals == 0


@pytest.mark.parametrize(("share", "more"), [(1.0, 0), (0.01, 2), (1e-9, 3)])
def test_a_small_drawing_on_a_large_page_has_decimals_of_its_own(share: float, more: int) -> None:
    corners = share * np.array([[0.0, 0.0], [100.0, 0.0], [100.0, 100.0]])
    ring = Outline(line_curves(corners, np.roll(corners, -1, axis=0)))
    drawing = Drawing((Shape((ring,), Style()),), Box(0, 0, 100, 100))
    assert decimals_of(drawing) == decimals_for(drawing.box) + more
    assert decimals_of(drawing, 1) == 1


def test_precision_overrides_the_size() -> None:
    assert decimals_for(Box(0, 0, 24, 24), 6) == 6
    for precision in (-1, 16):
        with pytest.raises(OptionError, match=f"precision {precision}: expected"):
            decimals_for(Box(0, 0, 24, 24), precision)


def test_digits_that_no_double_has_are_refused() -> None:
    with pytest.raises(OptionError, match="lower precision"):
        path_data(np.full((1, 1, 4, 2), 1e6), [1], [True], 12)
