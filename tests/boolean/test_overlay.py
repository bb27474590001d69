"""What crossing rings show, in parts of their own curves, against resvg's own winding."""

import io

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from PIL import Image

from shapetween.base.arrays import Curves
from shapetween.boolean.area import filled_area, hidden_share, windings
from shapetween.boolean.chords import FLATNESS, chords_of, joined
from shapetween.boolean.trace import traced
from shapetween.geometry.bezier import evaluate, line_curves
from shapetween.model.outline import Outline
from shapetween.model.paint import FillRule
from tests.movements import circle

SIDE = 300


def shown(*rings: Outline, rule: FillRule = "nonzero") -> list[tuple[Outline, ...]]:
    chords = chords_of(rings)
    area = filled_area(chords.polylines, rule)
    assert area is not None
    return traced(area, chords)


def disc(x: float, y: float, radius: float) -> Outline:
    return Outline(circle(np.array([x, y]), radius))


def curves_of(found: list[tuple[Outline, ...]]) -> Curves:
    return np.concatenate([ring.curves for rings in found for ring in rings])


def picture(rings: list[Outline], rule: FillRule) -> NDArray[np.float64]:
    """Coverage of the pixels of the square from -3 to 16, by resvg."""
    resvg = pytest.importorskip("resvg_py", reason="resvg is not installed")
    data = " ".join(
        "M{} {}".format(*ring.curves[0, 0])
        + "".join("C{} {} {} {} {} {}".format(*c[1:].ravel()) for c in ring.curves)
        + "Z"
        for ring in rings
    )
    text = (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="-3 -3 19 19" width="{SIDE}" '
        f'height="{SIDE}"><path fill-rule="{rule}" d="{data}"/></svg>'
    )
    image = Image.open(
        io.BytesIO(bytes(resvg.svg_to_bytes(svg_string=text, skip_system_fonts=True)))
    )
    return np.asarray(image.convert("RGBA"), np.float64)[..., 3] / 255


numbers = st.one_of(st.integers(0, 12).map(float), st.floats(0, 12))
handles = st.one_of(st.integers(-2, 14).map(float), st.floats(-2, 14))


@st.composite
def crossing_rings(draw: st.DrawFn) -> Outline:
    """One ring of lines and cubics through anywhere, which as a rule crosses itself."""
    count = draw(st.integers(1, 5))
    corners = np.array([[draw(numbers), draw(numbers)] for _ in range(count)])
    curves = line_curves(corners, np.roll(corners, -1, axis=0))
    for curve in curves:
        if count == 1 or draw(st.integers(0, 3)):
            curve[1:3] = [[draw(handles), draw(handles)] for _ in range(2)]
    return Outline(curves)


@settings(max_examples=20)
@given(st.lists(crossing_rings(), min_size=1, max_size=3), st.sampled_from(["nonzero", "evenodd"]))
def test_crossing_rings_look_as_they_did(rings: list[Outline], rule: FillRule) -> None:
    found = shown(*rings, rule=rule)
    before = picture(rings, rule)
    after = picture([ring for group in found for ring in group], "nonzero")
    off = np.abs(before - after)
    # resvg rounds edges to a 16th of a pixel in its own way for every path.
    assert off.sum() <= 0.003 * before.sum() + 2
    assert off.max() <= 0.5


@settings(max_examples=20)
@given(st.lists(crossing_rings(), min_size=1, max_size=3), st.sampled_from(["nonzero", "evenodd"]))
def test_what_is_shown_lies_on_the_curves_that_were_drawn(
    rings: list[Outline], rule: FillRule
) -> None:
    found = shown(*rings, rule=rule)
    if not found:
        return
    drawn = np.concatenate([ring.curves for ring in rings])
    size = np.ptp(drawn.reshape(-1, 2), axis=0).max()
    points = evaluate(curves_of(found), np.linspace(0, 1, 5)).reshape(-1, 2)
    dense = shapely.MultiLineString(list(evaluate(drawn, np.linspace(0, 1, 1001))))
    shapely.prepare(dense)
    assert shapely.dwithin(dense, shapely.points(points), 5 * FLATNESS * size).all()


def test_a_ring_that_crosses_nothing_is_given_back() -> None:
    ring = disc(3, 4, 2)
    ((found,),) = shown(ring)
    first = int(np.flatnonzero((found.curves[:, 0] == ring.curves[0, 0]).all(axis=1))[0])
    np.testing.assert_array_equal(np.roll(found.curves, -first, axis=0), ring.curves)


@pytest.mark.parametrize("size", [1e-4, 1.0, 1e7])
@pytest.mark.parametrize(
    ("rule", "back", "counts"),
    [("nonzero", False, [8]), ("evenodd", False, [6, 6]), ("nonzero", True, [6, 6])],
)
def test_two_discs(size: float, rule: FillRule, back: bool, counts: list[int]) -> None:
    """United, or without what they share: cut where they meet, and nowhere else."""
    one, other = disc(0, 0, size), disc(size, 0, size)
    found = shown(one, other.reversed() if back else other, rule=rule)
    assert [len(ring.curves) for (ring,) in found] == counts
    # Where two unit discs meet that are one apart, to within a circle's cubics.
    meet = size * np.array([0.5, np.sqrt(0.75)])
    assert np.linalg.norm(curves_of(found)[:, 0] - meet, axis=1).min() < 3e-4 * size
    # The place is on both curves as exactly as numbers go.
    joint = curves_of(found)[:, 0]
    radii = np.linalg.norm(joint, axis=1), np.linalg.norm(joint - [size, 0], axis=1)
    corner = joint[(np.abs(radii[0] - radii[1]) < 1e-3 * size)]
    assert len(corner) >= 2
    np.testing.assert_allclose(corner[:, 0], size / 2, rtol=1e-9)


def test_one_curve_that_crosses_itself() -> None:
    loop = np.array([[[0, 0], [10, 10], [-7, 10], [3, 0]], [[3, 0], [3, -3], [0, -3], [0, 0.0]]])
    found = shown(Outline(loop))
    assert sorted(len(ring.curves) for (ring,) in found) == [1, 3]
    area = sum(ring.area for (ring,) in found)
    assert area == pytest.approx(7.804646 + 14.404646, rel=1e-5)


def test_a_curve_drawn_twice_with_other_cuts_counts_once() -> None:
    """The same disc from another start: their chords cross everywhere, and mean nothing."""
    turned = np.roll(circle(np.zeros(2), 1.0), 1, axis=0)
    angle = 0.3
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    turned = turned @ turn.T
    turned[:, 0] = np.roll(turned[:, 3], 1, axis=0)
    assert curves_of(shown(disc(0, 0, 1), disc(0, 0, 1))).shape[0] == 4
    # Cubics of a circle are off by 0.03 %, each in its own places.
    assert curves_of(shown(disc(0, 0, 1), Outline(turned))).shape[0] <= 24


def test_what_runs_there_and_back_on_a_curve_is_gone() -> None:
    arc = circle(np.zeros(2), 5.0)[:1]
    end = arc[0, 3]
    spike = np.concatenate([line_curves(end, 2 * end)[None], line_curves(2 * end, end)[None]])
    closing = line_curves(np.stack([end, 0 * end]), np.stack([0 * end, arc[0, 0]]))
    ((found,),) = shown(Outline(np.concatenate([arc, spike, closing])))
    assert len(found.curves) == 3
    assert np.abs(found.curves).max() <= 5.0


def test_a_scribble_is_given_up() -> None:
    points = np.random.default_rng(1).uniform(0, 1, (3000, 2))
    polyline = np.concatenate([points, points[:1]])
    assert filled_area([polyline], "nonzero") is None


def test_nothing_is_filled_by_lines() -> None:
    flat = np.array([[0, 0], [1, 0], [2, 0], [0, 0.0]])
    for polylines in ([], [flat], [flat[:1]], [np.zeros((4, 2))]):
        area = filled_area(polylines, "nonzero")
        assert area is not None
        assert area.is_empty


def test_windings_are_counted_with_their_direction() -> None:
    square = np.array([[0, 0], [4, 0], [4, 4], [0, 4], [0, 0.0]])
    starts = np.concatenate([square[:-1], square[:-1] / 2, square[:0:-1] / 4])
    ends = np.concatenate([square[1:], square[1:] / 2, square[-2::-1] / 4])
    spots = np.array([[0.5, 0.5], [1.5, 1.5], [3, 3], [5, 1], [-1, 1], [1.5, -1]])
    assert windings(spots, starts, ends).tolist() == [1, 2, 1, 0, 0, 0]


def test_parts_of_several_drawings_keep_their_own_curves() -> None:
    """A small disc cut by a far larger one, each with chords as fine as it needs."""
    small, large = chords_of([disc(100, 0, 1)]), chords_of([disc(0, 0, 100)])
    areas = [filled_area(chords.polylines, "nonzero") for chords in (small, large)]
    assert areas[0] is not None
    assert areas[1] is not None
    ((found,),) = traced(areas[0].intersection(areas[1]), joined([small, large]))
    assert len(found.curves) <= 4
    meeting = found.curves[np.abs(found.curves[:, 0, 1]) > 0.5, 0]
    np.testing.assert_allclose(np.linalg.norm(meeting, axis=1), 100, rtol=3e-4)
    np.testing.assert_allclose(np.linalg.norm(meeting - [100, 0], axis=1), 1, rtol=3e-4)


def test_what_a_stroke_shows_inside_is_measured() -> None:
    angle = np.arange(6) * 4 * np.pi / 5
    star = np.stack([np.sin(angle), -np.cos(angle)], axis=1)
    # The inner pentagon's sides are to the points' as 1 to the golden ratio.
    golden = (1 + np.sqrt(5)) / 2
    assert hidden_share([star], "nonzero") == pytest.approx(1 / (1 + 2 * golden), rel=1e-3)
    assert hidden_share([star], "evenodd") == pytest.approx(0, abs=1e-3)
    assert hidden_share([star[:3]], "nonzero") == 0
    assert hidden_share([], "nonzero") == 0
