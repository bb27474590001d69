"""Shapes of every kind come back as the same kind, and are the given ones at both ends."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely

import shapetween as st
from shapetween.base.errors import InputError, OptionError, ShapetweenError
from shapetween.interop import between

INPUTS = Path(__file__).resolve().parents[2] / "gallery" / "inputs"

L = np.array([[0, 0], [9, 0], [9, 3], [3, 3], [3, 9], [0, 9]], dtype=np.float64)
T = np.array([[0, 6], [0, 9], [9, 9], [9, 6], [6, 6], [6, 0], [3, 0], [3, 6]], dtype=np.float64)
HOLED = shapely.Point(5, 5).buffer(4).difference(shapely.Point(5, 5).buffer(2))
SQUARE = shapely.box(0, 0, 10, 10).difference(shapely.box(3, 3, 7, 7))


def same(a: shapely.Geometry, b: shapely.Geometry) -> bool:
    return bool(a.symmetric_difference(b).area < 1e-9 * a.area)


def test_arrays() -> None:
    f = between(L, T)
    made = f([0.0, 0.25, 0.5, 1.0])
    assert len({len(points) for points in made}) == 1
    assert same(shapely.Polygon(made[0]), shapely.Polygon(L))
    assert same(shapely.Polygon(made[-1]), shapely.Polygon(T))
    assert all(shapely.Polygon(points).is_valid for points in made)
    np.testing.assert_array_equal(f(0.25), made[1])


def test_closed_arrays_stay_closed() -> None:
    made = between(np.vstack([L, L[:1]]), T)(0.5)
    np.testing.assert_array_equal(made[0], made[-1])


def test_lists_of_points_are_arrays() -> None:
    assert between(L.tolist(), T.tolist())(0.5).shape[1] == 2


def test_polygons_with_holes() -> None:
    f = between(HOLED, SQUARE)
    assert same(f(0.0), HOLED)
    assert same(f(1.0), SQUARE)
    for t in (0.2, 0.5, 0.8):
        made = f(t)
        assert made.geom_type == "Polygon"
        assert made.is_valid
        assert len(made.interiors) == 1


def test_what_is_in_several_pieces() -> None:
    several = shapely.MultiPolygon([shapely.box(0, 0, 3, 3), shapely.box(5, 5, 9, 9)])
    other = shapely.MultiPolygon([shapely.box(0, 6, 3, 9), shapely.box(5, 0, 9, 3)])
    f = between(several, other)
    assert same(f(0.0), several)
    assert same(f(1.0), other)
    assert f(0.5).is_valid
    assert f(0.5).geom_type == "MultiPolygon"


def test_areas_without_partner_grow_from_nothing() -> None:
    """At both ends nothing is there that was not given, and nothing snaps into place."""
    one = shapely.box(0, 0, 4, 4)
    several = shapely.MultiPolygon([one, shapely.box(6, 0, 7, 1), shapely.box(6, 3, 8, 4)])
    f = between(shapely.MultiPolygon([one]), several)
    assert same(f(0.0), one)
    assert same(f(1.0), several)
    areas = np.array([shape.area for shape in f(np.linspace(0, 1, 401))])
    assert np.abs(np.diff(areas)).max() < 0.02 * (several.area - one.area)
    path = between("M0 0H4V4H0Z", "M0 0H4V4H0ZM6 0H7V1H6Z")(0.0)
    assert path.split("M")[2].startswith("6.5.5C6.5.5 6.5.5 6.5.5")


STEPS = np.linspace(0, 3, 40)
WAVE = shapely.LineString(np.column_stack([STEPS, np.sin(3 * STEPS)]))
OTHER = shapely.LineString(np.column_stack([STEPS, 1.4 * np.cos(2 * STEPS)])[:25])


def near(a: shapely.Geometry, b: shapely.Geometry) -> bool:
    return bool(a.hausdorff_distance(b) < 1e-12 * a.length)


def test_lines() -> None:
    f = between(WAVE, OTHER)
    made = f(np.linspace(0, 1, 5))
    assert {line.geom_type for line in made} == {"LineString"}
    assert len({len(line.coords) for line in made}) == 1
    assert near(made[0], WAVE)
    assert near(made[-1], OTHER)
    ends = np.array([line.coords[0] for line in made])
    np.testing.assert_allclose(ends, np.linspace(ends[0], ends[-1], 5), atol=0.2)


def test_lines_in_several_pieces() -> None:
    """What has no partner is drawn; at both ends nothing is there that was not given."""
    several = shapely.MultiLineString([WAVE, shapely.LineString([(0, 3), (3, 3)])])
    other = shapely.MultiLineString(
        [OTHER, [(0, 2.5), (3, 3.5)], [(4, 0), (4, 1), (5, 2)]]  # one more
    )
    f = between(several, other)
    assert near(f(0.0), several)
    assert near(f(1.0), other)
    assert f(0.5).geom_type == "MultiLineString"
    assert len(f(0.0).geoms) == 2
    assert len(f(1.0).geoms) == 3
    assert f(0.5).length > 0.5 * several.length


def test_a_round_line_opens() -> None:
    ring = shapely.LinearRing([(0, 0), (1, 0), (1, 1), (0, 1)])
    f = between(shapely.LineString(ring.coords), WAVE)
    assert f(0.0).is_closed
    assert f(0.0).hausdorff_distance(ring) < 1e-12
    assert near(f(1.0), WAVE)
    still = between(ring, shapely.LinearRing([(2, 0), (3, 0), (3, 1), (2, 1)]))(0.5)
    assert still.is_closed


def test_lines_have_y_upwards_and_pins() -> None:
    pin = (
        float(STEPS[20]),
        float(np.sin(3 * STEPS[20])),
        float(STEPS[5]),
        1.4 * np.cos(2 * STEPS[5]),
    )
    up = between(WAVE, OTHER, pins=[pin])
    at = int(np.linalg.norm(np.array(up(0.0).coords) - pin[:2], axis=1).argmin())
    np.testing.assert_allclose(up(1.0).coords[at], pin[2:], atol=1e-6)
    flipped = [shapely.transform(line, lambda xy: xy * [1, -1]) for line in (WAVE, OTHER)]
    down = between(*flipped, y_up=False, pins=[(pin[0], -pin[1], pin[2], -pin[3])])
    np.testing.assert_allclose(
        np.array(up(0.4).coords), np.array(down(0.4).coords) * [1, -1], atol=1e-9
    )


def test_lines_of_any_unit_move_alike() -> None:
    """The width that a line is given is a share of its size."""
    middle = np.array(between(WAVE, OTHER)(0.5).coords)
    for unit in (1e-6, 1e6):
        scaled = [shapely.transform(line, lambda xy, u=unit: xy * u) for line in (WAVE, OTHER)]
        np.testing.assert_allclose(np.array(between(*scaled)(0.5).coords) / unit, middle, atol=1e-6)


def test_path_data() -> None:
    f = between("M0 0H9V9H0Z", "M4.5 0C9 0 9 9 4.5 9S0 0 4.5 0Z")
    assert f(0.0).startswith("M")
    assert f(0.0).count("C") == f(0.5).count("C")
    drawn = st.morph(*(between(f(t), f(t)).morph.at(0.0) for t in (0.0, 1.0)), fit="none")
    areas = [abs(drawn.at(t).shapes[0].rings[0].area) for t in (0.0, 1.0)]
    assert areas[0] == pytest.approx(81, rel=1e-3)  # as precise as it is written
    assert areas[1] == pytest.approx(48.6, rel=1e-3)


def test_matplotlib_paths() -> None:
    mpl = pytest.importorskip("matplotlib.path", reason="matplotlib is not installed")
    f = between(mpl.Path(L, closed=False), mpl.Path.unit_circle())
    assert isinstance(f(0.5), mpl.Path)
    ends = f(0.0).to_polygons()[0], f(1.0).to_polygons()[0]
    assert shapely.Polygon(ends[1]).area == pytest.approx(np.pi, abs=0.01)


class MplPath:
    """What matplotlib's Path has of what is looked at, curves and all."""

    def __init__(self, vertices: list[list[float]], codes: list[int] | None) -> None:
        self.vertices, self.codes = np.array(vertices), codes

    def to_polygons(self) -> None:
        raise NotImplementedError


def test_codes_of_matplotlib_are_understood() -> None:
    from shapetween.interop.kinds import kind_of

    path = MplPath([[0, 0], [4, 0], [6, 2], [4, 4], [2, 6], [0, 4], [0, 2], [0, 0]],
                   [1, 2, 3, 3, 4, 4, 4, 79])  # fmt: skip
    ring = kind_of(path, "first").drawing(path).shapes[0].rings[0]
    assert ring.closed
    assert len(ring.curves) == 4
    np.testing.assert_allclose(ring.curves[1, 1], [4 + 4 / 3, 4 / 3])


def test_drawings_and_files() -> None:
    f = between(INPUTS / "horse.svg", INPUTS / "kangaroo.svg")
    assert isinstance(f(0.5), st.Drawing)
    text = (INPUTS / "horse.svg").read_text("utf-8")
    made: Any = between(text, str(INPUTS / "kangaroo.svg"))(0.0)
    assert made.shapes


def test_y_upwards_is_no_other_movement() -> None:
    flip = np.array([1.0, -1.0])
    up = between(L, T, pins=[(0, 0, 3, 0)])([0.3, 0.6])
    down = between(L * flip, T * flip, y_up=False, pins=[(0, 0, 3, 0)])([0.3, 0.6])
    for one, other in zip(up, down, strict=True):
        np.testing.assert_allclose(one, other * flip, atol=1e-6)


def test_pins_are_kept() -> None:
    made = between(L, T, pins=[(9, 0, 9, 9)])([0.0, 1.0])
    at = int(np.linalg.norm(made[0] - [9, 0], axis=1).argmin())
    np.testing.assert_allclose(made[1][at], [9, 9], atol=1e-9)


@pytest.mark.parametrize(
    ("a", "b", "said"),
    [
        (L, "M0 0H9V9Z", "the first shape is an array, and the second path data"),
        (3, L, "the first shape is a int"),
        (L, [[0, 0], [1, 1]], "the second shape is a list"),
        ("M0 0H9V9Z", "M0 0Hx", "path data"),
        (shapely.LineString([(0, 0), (1, 1)]), SQUARE, "is a line, and the second a geometry"),
        (shapely.Point(1, 1), SQUARE, "a Point: expected"),
        (shapely.LineString(), WAVE, "empty, or a single point"),
        (shapely.MultiLineString(), WAVE, "has none"),
        (shapely.LineString([(0, 0), (np.inf, 1)]), WAVE, "finite"),
        (shapely.Polygon(), SQUARE, "empty"),
        (np.full((4, 2), np.nan), L, "finite"),
        (L, np.zeros((5, 2)), "encloses no"),
    ],
)
def test_what_is_no_shape_is_said(a: object, b: object, said: str) -> None:
    with pytest.raises(ShapetweenError, match=said) as caught:
        between(a, b)
    assert "\n" not in str(caught.value)


def test_times_are_checked() -> None:
    f = between(L, T)
    for wrong in (-0.1, 1.1, np.nan, [0.5, 2]):
        with pytest.raises(OptionError, match="not from 0 to 1"):
            f(wrong)


def test_a_missing_file_is_said() -> None:
    with pytest.raises(InputError, match="no such file"):
        between("nothing.svg", "nothing.svg")
