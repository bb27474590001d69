"""Path data against svgpathtools' own curves, the grammar's corners, and arcs on their ellipses."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from svgpathtools import Arc, parse_path

from shapetween.base.arrays import Points
from shapetween.geometry.bezier import evaluate
from shapetween.svg.read.arcs import arc_curves
from shapetween.svg.read.pathdata import parse_path_data

MANY = 10**6


def ends(text: str) -> list[list[list[float]]]:
    """The corner points of every subpath, its start first."""
    return [
        [path.start.tolist(), *path.curves[:, 3].round(9).tolist()]
        for path in parse_path_data(text, MANY).subpaths
    ]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("M1 2 3 4 5 6", [[[1, 2], [3, 4], [5, 6]]]),
        ("m1 2 3 4 5 6", [[[1, 2], [4, 6], [9, 12]]]),
        ("M1,2L3-4.5.5-.5e1", [[[1, 2], [3, -4.5], [0.5, -5]]]),
        ("M1 1h2v3H0V0", [[[1, 1], [3, 1], [3, 4], [0, 4], [0, 0]]]),
        ("M1 1h2 3v4 5", [[[1, 1], [3, 1], [6, 1], [6, 5], [6, 10]]]),
        ("M1 1H5zl1 1", [[[1, 1], [5, 1]], [[1, 1], [2, 2]]]),
        ("M1 1h1m1 1h1", [[[1, 1], [2, 1]], [[3, 2], [4, 2]]]),
        ("M1 1h4v4h-4zm2 2h1", [[[1, 1], [5, 1], [5, 5], [1, 5]], [[3, 3], [4, 3]]]),
        ("M0 0a20 20 0 0130 0", [[[0, 0], [15, -6.77124344], [30, 0]]]),
        ("M5 5Z", [[[5, 5]]]),
        ("M5 5", []),
        ("M5 5M6 6", []),
        ("", []),
        ("M0 0L1 2L", [[[0, 0], [1, 2]]]),
        ("M0 0L1 2 3", [[[0, 0], [1, 2]]]),
        ("M0 0L1 2X4 5", [[[0, 0], [1, 2]]]),
        ("M0 0L1 2L NaN 4L5 6", [[[0, 0], [1, 2]]]),
        ("M0 0L1 2L1e99 4L5 6", [[[0, 0], [1, 2]]]),
        ("M0 0L1 2A1 1 0 2 1 5 5L6 6", [[[0, 0], [1, 2]]]),
        ("L1 2M0 0L1 1", []),
        ("M0 0L1 2L3e10", [[[0, 0], [1, 2]]]),
        ("M0 0L1 2L34", [[[0, 0], [1, 2]]]),
        ("M0 0A0 5 0 0 1 3 4", [[[0, 0], [3, 4]]]),
        ("M3 4A5 5 0 1 1 3 4L5 5", [[[3, 4], [5, 5]]]),
        ("M3 4a5 5 0 1 1 0 0l2 1", [[[3, 4], [5, 5]]]),
    ],
)
def test_corners_of_subpaths(text: str, expected: list[list[list[float]]]) -> None:
    found = ends(text)
    assert len(found) == len(expected)
    for one, other in zip(found, expected, strict=True):
        np.testing.assert_allclose(one, other, atol=1e-7)


@pytest.mark.parametrize(
    ("text", "place"),
    [
        ("M0 0L1 2L", "character 10"),
        ("M0 0L1 2 3", "character 10"),
        ("L1 2", "moveto"),
        ("M0 0L1e99 4", "sound size"),
    ],
)
def test_what_stops_reading_is_named(text: str, place: str) -> None:
    assert place in parse_path_data(text, MANY).problem


def test_whether_a_subpath_is_closed() -> None:
    closed = [
        path.closed for path in parse_path_data("M0 0h1v1zM5 5h1v1h-1v-1M9 9z", MANY).subpaths
    ]
    assert closed == [True, False, True]


def test_the_budget_stops_reading() -> None:
    assert 10 < parse_path_data("M0 0" + "L1 1" * 1000, 10).commands <= 12


coordinates = st.floats(-1e3, 1e3).map(lambda value: round(value, 3))
_COUNTS = {"L": 2, "H": 1, "V": 1, "C": 6, "S": 4, "Q": 4, "T": 2}


@st.composite
def path_texts(draw: st.DrawFn, letters: str) -> str:
    """One subpath of commands, absolute and relative, with repeated argument sets."""
    words = ["M", *(repr(draw(coordinates)) for _ in range(2))]
    for _ in range(draw(st.integers(1, 6))):
        letter = draw(st.sampled_from(letters))
        words.append(letter if draw(st.booleans()) else letter.lower())
        sets = draw(st.integers(1, 3))
        words += [repr(draw(coordinates)) for _ in range(sets * _COUNTS[letter])]
    return " ".join(words)


def oracle(text: str, t: Points) -> Points:
    points = np.array([[segment.point(s) for s in t] for segment in parse_path(text)])
    return np.stack([points.real, points.imag], axis=-1)


@given(path_texts("LHVCS") | path_texts("LHVCSQT"))
def test_same_curves_as_svgpathtools(text: str) -> None:
    (path,) = parse_path_data(text, MANY).subpaths
    t = np.linspace(0, 1, 5)
    np.testing.assert_allclose(evaluate(path.curves, t), oracle(text, t), atol=1e-8)


@given(path_texts("LHVCS"))
def test_curves_follow_one_another_exactly(text: str) -> None:
    (path,) = parse_path_data(text, MANY).subpaths
    assert (path.curves[1:, 0] == path.curves[:-1, 3]).all()
    assert (path.curves[0, 0] == path.start).all()


@given(
    st.floats(0.1, 100),
    st.floats(0.1, 100),
    st.floats(-400, 400),
    st.booleans(),
    st.booleans(),
    st.floats(0.01, 100),
    st.floats(-4, 4),
)
def test_arcs_lie_on_their_ellipse(
    rx: float, ry: float, turn: float, large: bool, sweep: bool, reach: float, angle: float
) -> None:
    end = reach * np.exp(1j * angle)
    arc = Arc(0j, complex(rx, ry), turn, large, sweep, end)
    curves = arc_curves(arc)
    drawn = evaluate(curves, np.linspace(0, 1, 9))
    points = drawn[..., 0] + 1j * drawn[..., 1]
    local = (points - arc.center) * np.exp(-1j * np.radians(turn))
    distance = np.hypot(local.real / arc.radius.real, local.imag / arc.radius.imag)
    np.testing.assert_allclose(distance, 1, atol=1e-3)
    np.testing.assert_allclose(curves[0, 0], [0, 0], atol=0)
    np.testing.assert_allclose(curves[-1, 3], [end.real, end.imag], atol=0)
    # Half way is half way: the right one of the four arcs.
    middle = evaluate(curves, np.array([0.0, 0.5]))[len(curves) // 2, len(curves) % 2]
    expected = arc.point(0.5)
    size = max(arc.radius.real, arc.radius.imag)
    np.testing.assert_allclose(middle, [expected.real, expected.imag], atol=1e-3 * size)


def test_a_short_arc_of_a_huge_circle_is_short() -> None:
    (path,) = parse_path_data("M0 0A1e9 1e9 0 0 0 1 0", MANY).subpaths
    assert np.abs(path.curves).max() <= 1


def test_arcs_among_other_curves() -> None:
    text = "M0 0C1 2 3 4 5 5S6 7 8 8A2 2 0 0 1 12 8s2 1 3 0q1 1 2 0t2 0l1 1"
    (path,) = parse_path_data(text, MANY).subpaths
    assert len(path.curves) == 2 + 2 + 1 + 2 + 1  # half a circle is two quarters
    np.testing.assert_allclose(path.curves[1, 1], [7, 6])
    np.testing.assert_allclose(path.curves[4, 1], [12, 8])  # nothing to mirror after an arc
    np.testing.assert_allclose(path.curves[6, 1] + path.curves[5, 2], 2 * path.curves[6, 0])
    assert (path.curves[1:, 0] == path.curves[:-1, 3]).all()
