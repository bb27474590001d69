"""Paint between two paints, against OKLab worked out by hand and renderers' rules for gradients."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from shapetween.model.blend import CHANGES, blend, blend_colours, blend_paints, to_oklab
from shapetween.model.gradients import IDENTITY, in_normal_form, on_offsets
from shapetween.model.paint import Colour, Gradient, Paint, Stop, Stroke, Style

unit = st.floats(0, 1)
inside = st.floats(0.01, 0.99)
colours = st.builds(Colour, unit, unit, unit, unit)
reals = st.floats(-50, 50)


@st.composite
def gradients(draw: st.DrawFn, kind: str | None = None) -> Gradient:
    chosen = kind or draw(st.sampled_from(["linear", "radial"]))
    turn, low, high = draw(st.floats(-3, 3)), draw(st.floats(0.5, 5)), draw(st.floats(0.5, 5))
    skew = draw(st.floats(-1, 1))
    cos, sin = math.cos(turn), math.sin(turn)
    matrix = np.array([[cos, -sin], [sin, cos]]) @ [[low, skew], [0, high]]
    matrix *= draw(st.sampled_from([1, -1]))
    numbers = (*matrix.T.ravel().tolist(), draw(reals), draw(reals))
    offsets = sorted(
        draw(st.lists(st.sampled_from([0, 0.25, 0.3, 0.5, 1]), min_size=2, max_size=4))
    )
    stops = tuple(Stop(offset, draw(colours)) for offset in offsets)
    if chosen == "linear":
        points: tuple[float, ...] = (draw(reals), draw(reals), *(draw(st.floats(60, 90)),) * 2)
        return Gradient("linear", points, numbers, stops)
    cx, cy, r = draw(reals), draw(reals), draw(st.floats(1, 50))
    fx, fy = cx + r * draw(st.floats(-0.6, 0.6)), cy + r * draw(st.floats(-0.6, 0.6))
    return Gradient("radial", (cx, cy, r, fx, fy), numbers, stops)


strokes = st.builds(
    Stroke,
    colours | gradients(),
    st.floats(0.1, 9),
    st.sampled_from(["butt", "round", "square"]),
    st.sampled_from(["miter", "round", "bevel"]),
    st.floats(1, 9),
    st.sampled_from([(), (3.0,), (2.0, 1.0), (1.0, 2.0, 3.0), (5.0, 1.0, 2.0, 1.0)]),
)
paints = st.none() | colours | gradients()
styles = st.builds(
    Style, paints, st.none() | strokes, unit, st.sampled_from(["nonzero", "evenodd"])
)


def offset_at(gradient: Gradient, point: tuple[float, float]) -> float:
    """Where along a gradient a point of the plane is, from SVG's definition of either kind."""
    a, b, c, d, e, f = gradient.matrix
    x, y = np.linalg.solve([[a, c], [b, d]], np.array(point) - (e, f))
    if gradient.kind == "linear":
        x1, y1, x2, y2 = gradient.points
        along = np.array([x2 - x1, y2 - y1])
        return float(((x - x1, y - y1) @ along) / (along @ along))
    # The circle of offset s has its centre at f + s (c - f), its radius s r; the point is on it.
    cx, cy, r, fx, fy = gradient.points
    away, drift = np.array([x - fx, y - fy]), np.array([cx - fx, cy - fy])
    roots = np.roots([drift @ drift - r * r, -2 * away @ drift, away @ away])
    return float(max(roots.real))


@given(gradients(), reals, reals)
def test_normal_form_paints_the_same(gradient: Gradient, x: float, y: float) -> None:
    normal = in_normal_form(gradient)
    assert normal.stops == gradient.stops
    assert offset_at(normal, (x, y)) == pytest.approx(offset_at(gradient, (x, y)), abs=1e-6)
    if gradient.kind == "linear":
        assert normal.matrix == IDENTITY
    else:
        a, b, c, d, _, _ = normal.matrix
        assert b == pytest.approx(c, abs=1e-9 * (abs(a) + abs(d)))
        assert a > 0
        assert a * d - b * c > 0


def test_a_matrix_that_flattens_is_left_alone() -> None:
    stops = (Stop(0, Colour()), Stop(1, Colour(1)))
    flat = Gradient("linear", (0, 0, 1, 1), (1, 2, 2, 4, 0, 0), stops)
    assert in_normal_form(flat) is flat


def colour_at(gradient: Gradient, offset: float) -> tuple[float, ...]:
    """Colour just after an offset, padded."""
    before = [stop for stop in gradient.stops if stop.offset <= offset]
    after = [stop for stop in gradient.stops if stop.offset > offset]
    p, q = (before or after)[-1 if before else 0], (after or before)[0 if after else -1]
    share = (offset - p.offset) / (q.offset - p.offset) if before and after else 0.0
    pairs = zip(
        (p.colour.red, p.colour.green, p.colour.blue, p.colour.alpha),
        (q.colour.red, q.colour.green, q.colour.blue, q.colour.alpha),
        strict=True,
    )
    return tuple((1 - share) * x + share * y for x, y in pairs)


@given(gradients(), st.lists(st.sampled_from([0.1, 0.3, 0.8, 0.9]), unique=True), unit)
def test_more_stops_paint_the_same(gradient: Gradient, more: list[float], offset: float) -> None:
    offsets = np.sort([stop.offset for stop in gradient.stops] + more)
    denser = on_offsets(gradient, offsets)
    assert [stop.offset for stop in denser.stops] == offsets.tolist()
    assert colour_at(denser, offset) == pytest.approx(colour_at(gradient, offset), abs=1e-12)


@given(styles, styles)
def test_ends_are_exact(a: Style, b: Style) -> None:
    assert blend(a, b, 0.0) == a
    assert blend(a, b, 1.0) == b
    assert blend(a, a, 0.3) == a


@given(styles, styles, inside)
def test_blends_are_sound(a: Style, b: Style, t: float) -> None:
    between = blend(a, b, t)
    assert (between.fill is None) == (a.fill is None and b.fill is None)
    assert (between.stroke is None) == (a.stroke is None and b.stroke is None)
    for paint in (between.fill, between.stroke and between.stroke.paint):
        stops = paint.stops if isinstance(paint, Gradient) else ()
        shades = [stop.colour for stop in stops] + ([paint] if isinstance(paint, Colour) else [])
        for shade in shades:
            values = (shade.red, shade.green, shade.blue, shade.alpha)
            assert all(0 <= value <= 1 + 1e-12 for value in values)
        offsets = [stop.offset for stop in stops]
        assert offsets == sorted(offsets)


@given(paints, paints, st.floats(0.02, 0.98))
def test_blends_do_not_jump(a: Paint, b: Paint, t: float) -> None:
    """What a point is painted moves a little when time does."""
    now, soon = blend_paints(a, b, t), blend_paints(a, b, t + 1e-6)
    for x, y in ((0.0, 0.0), (20.0, -10.0)):
        assert premultiplied(now, x, y) == pytest.approx(premultiplied(soon, x, y), abs=1e-3)


def premultiplied(paint: Paint, x: float, y: float) -> list[float]:
    if paint is None:
        return [0.0, 0.0, 0.0, 0.0]
    if isinstance(paint, Colour):
        values: tuple[float, ...] = (paint.red, paint.green, paint.blue, paint.alpha)
    else:
        # Stops at one offset are a jump in space, where a little way in time may cross it.
        offset = offset_at(paint, (x, y))
        if any(abs(stop.offset - offset) < 1e-3 for stop in paint.stops):
            return [0.0, 0.0, 0.0, 0.0]
        values = colour_at(paint, offset)
    return [value * values[3] for value in values[:3]] + [values[3]]


def test_halfway_is_halfway_in_oklab() -> None:
    # White and black meet at L = 1/2, where linear light is its cube: 0.3886 in sRGB.
    grey = blend_colours(Colour(1, 1, 1), Colour(0, 0, 0), 0.5)
    assert (grey.red, grey.green, grey.blue) == pytest.approx((0.388573,) * 3, abs=1e-4)
    # Of the hue of what Chromium paints for color-mix(in oklab, red, blue), and more of it.
    purple = to_oklab(blend_colours(Colour(1, 0, 0), Colour(0, 0, 1), 0.5))
    mixed = to_oklab(Colour(0.549, 0.325, 0.636))
    hues = [math.atan2(lab[2], lab[1]) for lab in (purple, mixed)]
    assert hues[0] == pytest.approx(hues[1], abs=0.05)
    chromas = [math.hypot(lab[1], lab[2]) for lab in (purple, mixed)]
    assert 1.2 * chromas[1] < chromas[0] < 0.286  # the mean of red's and blue's
    assert purple[0] > mixed[0]
    # Chromium's own where the hues are one.
    amber = blend_colours(Colour(1, 0.8, 0), Colour(0.4, 0.32, 0), 0.5)
    assert (amber.red, amber.green, amber.blue) == pytest.approx((0.69, 0.55, 0.0), abs=0.01)


@pytest.mark.parametrize(
    ("one", "other"),
    [
        (Colour(0.13, 0.38, 1), Colour(1, 0.56, 0.13)),
        (Colour(0.48, 0.25, 0.75), Colour(1, 0.86, 0.19)),
        (Colour(0, 0.72, 0.83), Colour(1, 0.34, 0.13)),
        (Colour(0.88, 0.12, 0.12), Colour(0.12, 0.63, 0.25)),
    ],
)
def test_between_hues_lies_no_mud(one: Colour, other: Colour) -> None:
    """What even mixing would make grey has more chroma than that, and is lighter."""
    ends = [to_oklab(one), to_oklab(other)]
    for t in (0.45, 0.5, 0.55):
        time = (t - CHANGES[0]) / (CHANGES[1] - CHANGES[0])
        share = time * time * (3 - 2 * time)
        even = (1 - share) * ends[0] + share * ends[1]
        lab = to_oklab(blend_colours(one, other, t))
        assert math.hypot(lab[1], lab[2]) > 1.25 * math.hypot(even[1], even[2])
        assert even[0] + 0.035 < lab[0] < even[0] + 0.1


def test_colours_change_in_the_middle_of_the_time() -> None:
    red, blue = Colour(1, 0, 0), Colour(0, 0, 1)
    for t in (0.05, 0.14):
        assert max(abs(to_oklab(blend_colours(red, blue, t)) - to_oklab(red))) < 1e-9
        assert max(abs(to_oklab(blend_colours(red, blue, 1 - t)) - to_oklab(blue))) < 1e-9
    early = to_oklab(blend_colours(red, blue, 0.3)) - to_oklab(red)
    assert 0.01 < math.hypot(*early) < 0.5 * math.hypot(*(to_oklab(blue) - to_oklab(red)))


def test_what_cannot_be_seen_does_not_tint() -> None:
    between = blend_colours(Colour(1, 0, 0, 1), Colour(0, 1, 0, 0), 0.5)
    assert (between.red, between.green, between.blue) == pytest.approx((1, 0, 0), abs=1e-6)
    assert between.alpha == 0.5


def test_nothing_is_the_other_paint_transparent() -> None:
    assert blend_paints(None, Colour(1, 0, 0, 0.5), 0.25) == Colour(1, 0, 0, 0.125)
    stroke = Stroke(Colour(0, 0, 1), 3.0)
    assert blend(Style(stroke=stroke), Style(), 0.25).stroke == replace(
        stroke, paint=Colour(0, 0, 1, 0.75)
    )


def test_a_border_of_the_colour_of_what_it_goes_round_grows_and_others_fade() -> None:
    black, red = Colour(0, 0, 0), Colour(1, 0, 0)
    plain = Style(fill=black)
    for paint, width, alpha in ((black, 0.5, 1.0), (red, 2.0, 0.25)):
        bordered = Style(fill=black, stroke=Stroke(paint, 2.0))
        for one, other, t in ((plain, bordered, 0.25), (bordered, plain, 0.75)):
            found = blend(one, other, t).stroke
            assert found is not None
            assert isinstance(found.paint, Colour)
            assert (found.width, found.paint.alpha) == (width, alpha)


def test_an_unbroken_line_is_dashes_that_meet() -> None:
    dashed, solid = Stroke(Colour(), dashes=(4.0, 2.0)), Stroke(Colour())
    near_end = blend(Style(stroke=dashed), Style(stroke=solid), 0.75).stroke
    assert near_end is not None
    assert near_end.dashes == (5.5, 0.5)
