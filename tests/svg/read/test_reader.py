"""Whole documents: what each feature draws, written once with it and once in plain paths."""

from dataclasses import replace

import numpy as np
import pytest

from shapetween.base.errors import BudgetError, InputError
from shapetween.model.drawing import Drawing
from shapetween.model.paint import Colour, Gradient, Paint, Style
from shapetween.svg.read.limits import Limits
from shapetween.svg.read.reader import read_svg

NAMESPACES = 'xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"'


def read(
    body: str, attributes: str = 'viewBox="0 0 100 100"', limits: Limits | None = None
) -> Drawing:
    return read_svg(f"<svg {NAMESPACES} {attributes}>{body}</svg>".encode(), "a.svg", limits)


def square(
    fill: str = "black", x: float = 0, y: float = 0, size: float = 10, extra: str = ""
) -> str:
    return f'<path fill="{fill}" d="M{x} {y}h{size}v{size}h-{size}z" {extra}/>'


OUTLINE = 'd="M0 0h10v10h-10z"'
INITIAL = 'style="fill:initial"'
DEFINED = f'<defs><path id="a" {OUTLINE}/></defs>'


SAME = {
    "use moves": (
        DEFINED + '<use href="#a" x="5" y="6"/>',
        square(x=5, y=6),
    ),
    "use with xlink and transform": (
        DEFINED + '<use xlink:href="#a" x="1" transform="scale(2)"/>',
        square(x=2, size=20),
    ),
    "use gives its style": (
        DEFINED + '<use href="#a" fill="red"/>',
        square("red"),
    ),
    "a used element keeps its own style": (
        '<defs><path id="a" fill="red" d="M0 0h10v10h-10z"/></defs><use href="#a" fill="blue"/>',
        square("red"),
    ),
    "use of use": (
        '<defs><path id="a" d="M0 0h10v10h-10z"/><use id="b" href="#a" x="5"/></defs>'
        '<use href="#b" y="7"/><use href="#b" x="20"/>',
        square(x=5, y=7) + square(x=25),
    ),
    "symbol fits its view box": (
        '<symbol id="a" viewBox="0 0 20 10" overflow="visible"><path d="M0 0h10v10h-10z"/></symbol>'
        '<use href="#a" x="10" y="0" width="40" height="40"/>',
        square(x=10, y=10, size=20),
    ),
    "nested svg": (
        '<svg x="10" y="20" width="50" height="50" viewBox="0 0 10 10">'
        '<path d="M0 0h2v2h-2z"/></svg>',
        square(x=10, y=20),
    ),
    "nested svg of another aspect": (
        '<svg width="50" height="20" viewBox="0 0 10 10" preserveAspectRatio="xMaxYMin slice">'
        '<path d="M0 0h2v2h-2z"/></svg>',
        square(x=0, y=0),
    ),
    "nested svg stretched": (
        '<svg width="50" height="20" viewBox="0 0 10 10" preserveAspectRatio="none">'
        '<path d="M0 0h2v5h-2z"/></svg>',
        square(),
    ),
    "switch": (
        '<switch><foreignObject requiredExtensions="http://a/"/>'
        '<path systemLanguage="fr" d="M0 0h9v9z"/>'
        f"{square('red')}{square('blue')}</switch>",
        square("red"),
    ),
    "links are groups": (f'<a href="x">{square()}</a>', square()),
    "hidden": (
        f'<g display="none">{square()}</g><g visibility="hidden">{square()}'
        '<path visibility="visible" d="M0 0h10v10h-10z"/></g><defs>'
        f"{square()}</defs><g opacity='0'>{square()}</g>"
        '<path fill="none" d="M0 0h50v50h-50z"/><path fill="#fff0" d="M0 0h50v50h-50z"/>'
        '<path transform="scale(0)" d="M0 0h50v50h-50z"/><rect width="0" height="5"/>',
        square(),
    ),
    "currentColor": (
        '<g color="red"><g fill="currentColor" color="lime">'
        f'<path color="blue" {OUTLINE}/></g></g>',
        square("blue"),
    ),
    "class": (
        "<style>.a{fill:red}</style>" + square("blue", extra='class="b a"'),
        square("red"),
    ),
    "specificity over order": (
        "<style>#i{fill:red} .a{fill:lime} path{fill:blue}</style>"
        + square(extra='class="a" id="i"'),
        square("red"),
    ),
    "descendants, children, attributes": (
        "<style>g .a{fill:red} svg > path{fill:lime} [data-x='1']{fill:blue}</style>"
        "<g><g>"
        + square(extra='class="a"')
        + "</g></g>"
        + square(x=20)
        + square(x=40, extra='data-x="1"'),
        square("red") + square("lime", 20) + square("blue", 40),
    ),
    "style attribute over sheet": (
        "<style>path{fill:red}</style>" + square(extra='style="fill:lime"'),
        square("lime"),
    ),
    "important over style attribute": (
        "<style>path{fill:red!important}</style>" + square(extra='style="fill:lime"'),
        square("red"),
    ),
    "media": (
        "<style>@media print{path{fill:red}} @media screen{path{fill:lime}}"
        "@media (prefers-color-scheme:dark){path{fill:blue}}</style>" + square(),
        square("lime"),
    ),
    "CDATA and comments": (
        "<style><![CDATA[ /* a */ path{/*b*/fill:red} ]]></style>" + square(),
        square("red"),
    ),
    "variables": (
        "<style>svg{--a:red;--b:var(--a)}</style>"
        + square("var(--b)")
        + square(extra='style="fill:var(--c, lime)"'),
        square("red") + square("lime"),
    ),
    "inherit and initial": (
        f'<g fill="red">{square("inherit")}{square(extra=INITIAL)}</g>',
        square("red") + square("black"),
    ),
    "a colour that is none is passed over": (
        '<g fill="red"><path fill="no-colour" d="M0 0h10v10h-10z"/></g>',
        square("red"),
    ),
    "geometry by style": (
        "<style>rect{x:5px;y:6px;width:10px;height:10px}</style><rect/>",
        square(x=5, y=6),
    ),
    "d by style": ("<style>path{d:path('M0 0h10v10h-10z')}</style><path/>", square()),
    "transform by style": (
        '<path style="transform:translate(5px,6px)" d="M0 0h10v10h-10z"/>',
        square(x=5, y=6),
    ),
    "transform origin": (
        '<path transform="scale(2)" transform-origin="10 10" d="M10 10h5v5h-5z"/>',
        square(x=10, y=10),
    ),
    "nested transforms": (
        '<g transform="translate(10 0)"><g transform="scale(2)"><path d="M0 0h5v5h-5z"/></g></g>',
        square(x=10),
    ),
    "rect": ('<rect x="5" y="6" width="10" height="10"/>', square(x=5, y=6)),
    "polygon": ('<polygon points="0,0 10,0 10,10 0,10"/>', square()),
    "polyline is filled": ('<polyline points="0 0 10 0 10-0 10 10 0 10"/>', square()),
    "circle": ('<circle cx="50" cy="50" r="10"/>', '<ellipse cx="50" cy="50" rx="10" ry="10"/>'),
    "rect of round ends": (
        '<rect width="20" height="10" rx="50"/>',
        '<ellipse cx="10" cy="5" rx="10" ry="5"/>',
    ),
    "percentages": ('<rect x="20%" y="10%" width="10%" height="10%"/>', square(x=20, y=10)),
    "units": (
        '<rect x="1in" y="72pt" width="2.54cm" height="25.4mm" transform="scale(.1)"/>',
        square(x=9.6, y=9.6, size=9.6),
    ),
    "font units": ('<g font-size="5"><rect width="2em" height="4ex"/></g>', square()),
    "missing Z": ('<path d="M0 0h10v10h-10"/>', square()),
    "closed by its own last line": ('<path d="M0 0h10v10h-10L0 0z"/>', square()),
    "gap of rounding": ('<path d="M0 0h10v10h-10V1e-9z"/>', square()),
    "doubled points": ('<path d="M0 0L0 0h10h0v10v0h-10z"/>', square()),
    "single points": ('<path d="M50 50zM0 0h10v10h-10zM60 60M70 70l0 0"/>', square()),
    "lines enclose nothing": ('<path d="M0 0h10v10h-10zM20 20L30 30L25 25z"/>', square()),
    "other namespaces": ('<b:path xmlns:b="http://b/" d="M0 0h50v50z"/>' + square(), square()),
    "unknown elements": (f"<star>{square()}</star>" + square(), square()),
}


def sketch(drawing: Drawing) -> list[tuple[object, ...]]:
    """A drawing's shapes, by the points of their corners and their style."""
    return [
        (
            unasked(shape.style),
            [ring.closed for ring in shape.rings],
            [len(ring.curves) for ring in shape.rings],
        )
        for shape in drawing.shapes
    ]


def unasked(style: Style) -> Style:
    """The style as it is where the page says nothing."""
    return (
        replace(style, fill=replace(style.fill, reference=""))
        if isinstance(style.fill, Colour)
        else style
    )


def assert_same(one: Drawing, other: Drawing) -> None:
    assert sketch(one) == sketch(other)
    for a, b in zip(one.shapes, other.shapes, strict=True):
        for ring, twin in zip(a.rings, b.rings, strict=True):
            # The same ring may start elsewhere: a circle and a rounded rect do.
            rolled = [np.abs(np.roll(ring.curves, k, axis=0) - twin.curves).max() for k in range(8)]
            assert min(rolled) < 1e-6


@pytest.mark.parametrize("name", SAME)
def test_draws_the_same_as_in_plain_paths(name: str) -> None:
    body, plain = SAME[name]
    assert_same(read(body), read(plain))


def fill_of(body: str) -> Paint:
    return read(body).shapes[-1].style.fill


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("#f80", (1, 0x88 / 255, 0, 1)),
        ("#ff880080", (1, 0x88 / 255, 0, 128 / 255)),
        ("rgb(100%, 50%, 0%)", (1, 0.5, 0, 1)),
        ("rgb(255 128 0 / 50%)", (1, 128 / 255, 0, 0.5)),
        ("hsl(120, 100%, 50%)", (0, 1, 0, 1)),
        ("ReBeccaPurple", (0.4, 0.2, 0.6, 1)),
        ("rgb(300, -5, 0)", (1, 0, 0, 1)),
        ("oklch(1e300 1e300 0)", (0, 0, 0, 1)),
        ("#fff icc-color(a, 1)", (1, 1, 1, 1)),
        ("lab(54.29 80.8 69.89)", (1, 0, 0, 1)),
        ("oklch(0.628 0.2577 29.23)", (1, 0, 0, 1)),
        ("color(display-p3 0.9175 0.2003 0.1386)", (1, 0, 0, 1)),
    ],
)
def test_colours(text: str, expected: tuple[float, ...]) -> None:
    fill = fill_of(square(text))
    assert isinstance(fill, Colour)
    found = (fill.red, fill.green, fill.blue, fill.alpha)
    np.testing.assert_allclose(found, expected, atol=2e-3)


STOPS = '<stop stop-color="red"/><stop offset="50%" style="stop-color:lime;stop-opacity:.5"/>'


def test_gradient_in_units_of_the_box_follows_shape_and_transforms() -> None:
    fill = fill_of(
        '<linearGradient id="a" x2="1" y2="1" gradientTransform="scale(.5)">'
        f"{STOPS}</linearGradient>"
        '<g transform="translate(5 5)"><rect x="10" width="40" height="20" fill="url(#a)"/></g>'
    )
    assert isinstance(fill, Gradient)
    assert fill.points == (0, 0, 1, 1)
    np.testing.assert_allclose(fill.matrix, (20, 0, 0, 10, 15, 5))
    assert [stop.offset for stop in fill.stops] == [0, 0.5]
    assert fill.stops[1].colour == Colour(0, 1, 0, 0.5)


def test_gradient_takes_what_it_lacks_from_the_one_it_names() -> None:
    fill = fill_of(
        '<linearGradient id="a" gradientUnits="userSpaceOnUse" spreadMethod="reflect">'
        f"{STOPS}</linearGradient>"
        '<radialGradient id="b" href="#a" cx="10%" cy="20" r="30" fx="11"/>' + square("url(#b)")
    )
    assert isinstance(fill, Gradient)
    assert (fill.kind, fill.spread, fill.points) == ("radial", "reflect", (10, 20, 30, 11, 20))
    assert len(fill.stops) == 2


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ('<linearGradient id="a"><stop stop-color="red"/></linearGradient>', Colour(1, 0, 0)),
        (f'<linearGradient id="a" x2="0">{STOPS}</linearGradient>', Colour(0, 1, 0, 0.5)),
        (f'<radialGradient id="a" r="0">{STOPS}</radialGradient>', Colour(0, 1, 0, 0.5)),
        ("", Colour(0, 0, 1)),
    ],
)
def test_gradients_that_are_one_colour(body: str, expected: Colour) -> None:
    assert fill_of(body + square("url(#a) blue")) == expected


def test_gradients_that_name_one_another_end() -> None:
    body = '<linearGradient id="a" href="#b"/><linearGradient id="b" href="#a"/>'
    assert len(read(body + square("url(#a)") + square()).shapes) == 1


def test_opacities_multiply() -> None:
    (shape,) = read(f'<g opacity=".5"><g opacity="50%">{square()}</g></g>').shapes
    assert shape.style.opacity == 0.25


def test_a_group_opacity_is_given_to_its_shapes_unless_they_overlap() -> None:
    apart = read(f'<g opacity=".5">{square()}{square(x=50)}</g>')
    assert [(shape.style.opacity, shape.style.groups) for shape in apart.shapes] == [(0.5, ())] * 2
    one, two = read(f'<g opacity=".5">{square()}{square(x=5)}</g>').shapes
    assert one.style.opacity == two.style.opacity == 1
    assert one.style.groups == two.style.groups
    assert one.style.groups[0].opacity == 0.5


def test_strokes_scale_and_stay_open() -> None:
    (shape,) = read(
        '<g transform="rotate(30) scale(2)"><path d="M0 0h5v5M9 9h1v1z" fill="none" stroke="red"'
        ' stroke-width="3" stroke-linecap="round" stroke-linejoin="bevel" stroke-dasharray="1,2,3"'
        ' stroke-dashoffset="1" stroke-opacity=".5"/></g>'
    ).shapes
    stroke = shape.style.stroke
    assert stroke is not None
    assert shape.style.fill is None
    assert [ring.closed for ring in shape.rings] == [False, True]
    assert stroke.paint == Colour(1, 0, 0, 0.5)
    assert (stroke.cap, stroke.join) == ("round", "bevel")
    np.testing.assert_allclose([stroke.width, stroke.dash_offset], [6, 2])
    np.testing.assert_allclose(stroke.dashes, [2, 4, 6, 2, 4, 6])


def test_a_dot_of_round_caps_is_kept() -> None:
    dot = '<path d="M5 5h0" stroke="red" stroke-width="4" stroke-linecap="{}"/>'
    assert len(read(dot.format("round") + square()).shapes) == 2
    assert len(read(dot.format("butt") + square()).shapes) == 1


def test_a_stroke_painted_first_is_a_shape_of_its_own() -> None:
    below, above = read('<circle r="5" fill="red" stroke="blue" paint-order="stroke"/>').shapes
    assert below.style.fill is None
    assert above.style.stroke is None


def test_a_path_is_one_shape_of_several_rings() -> None:
    (shape,) = read('<path id="o" fill-rule="evenodd" d="M0 0h9v9h-9zM3 3h3v3h-3z"/>').shapes
    assert len(shape.rings) == 2
    assert shape.style.fill_rule == "evenodd"
    assert shape.name == "o"


@pytest.mark.parametrize(
    ("attributes", "box"),
    [
        ('viewBox="-5 -6 20 30" width="999" height="999"', (-5, -6, 20, 30)),
        ('viewBox="0,0,1e-6,1e-6"', (0, 0, 1e-6, 1e-6)),
        ('width="50" height="1in"', (0, 0, 50, 96)),
        ('width="100%" height="100%"', (5, 5, 10, 10)),
        ("", (5, 5, 10, 10)),
        ('viewBox="0 0 0 9"', (5, 5, 10, 10)),
        ('viewBox="0 0 9" width="7" height="8"', (0, 0, 7, 8)),
    ],
)
def test_the_box(attributes: str, box: tuple[float, ...]) -> None:
    found = read(square(x=5, y=5), attributes).box
    assert (found.x, found.y, found.width, found.height) == pytest.approx(box)


def test_names_and_title() -> None:
    drawing = read(
        "<title> A\n drawing </title>"
        + square(extra='id="nose"')
        + '<g xmlns:i="http://www.inkscape.org/namespaces/inkscape">'
        + square(extra='i:label="ear"')
        + "</g>"
        + DEFINED
        + '<use id="u" href="#a"/>'
    )
    assert drawing.title == "A drawing"
    assert [shape.name for shape in drawing.shapes] == ["nose", "ear", "u"]


@pytest.mark.parametrize(
    ("body", "word"),
    [
        ("<text>Hello</text>", "text"),
        ('<image href="a.png"/>', "image"),
        ('<rect width="5" height="5" style="mask:linear-gradient(red,blue)"/>', "mask"),
        ('<rect width="5" height="5" style="filter:nonsense(3)"/>', "filter"),
        (
            '<mask id="m"><g mask="url(#m)">' + square() + "</g></mask>"
            '<rect width="5" height="5" mask="url(#m)"/>',
            "mask",
        ),
        (
            '<pattern id="p" width="1" height="1"><path d="M0 0h3v9"/></pattern>'
            + square("url(#p)"),
            "pattern",
        ),
        ('<use href="#none"/>', "use"),
        ('<g id="g"><use href="#g"/></g>', "use"),
        ('<path d="M0 0h5v5 oops"/>', "character 10"),
        ('<path d="M0 0h5v1e99"/>', "sound"),
        ('<polygon points="0 0 5 5 9"/>', "points"),
        ('<rect width="1e38" height="1" transform="scale(1e30)"/>', "range"),
        ('<g transform="scale(2"/>', "transform"),
        ("<style>@import 'a.css';</style>", "import"),
        ("<style>a:::b{fill:red}</style>", "selectors"),
        ('<rect width="5" height="5" style="clip-path:circus(5px)"/>', "clip"),
    ],
)
def test_what_is_lost_is_named_once(body: str, word: str) -> None:
    drawing = read(body + body + square("red"))
    assert drawing.shapes[-1].style.fill == Colour(1, 0, 0)
    (warning,) = drawing.warnings
    assert word in warning
    assert "\n" not in warning


@pytest.mark.parametrize(
    "body",
    [
        "",
        '<path d="M5 5z"/>',
        '<path d="M1 1L9 9L5 5z"/>',
        '<path d="M1 1L NaN 9L5 5z"/>',
        '<path d="MInf 1L 3 9L5 5z"/>',
        '<path d="nonsense"/>',
        square("none"),
        f'<g id="g" display="none">{square()}</g>',
    ],
)
def test_nothing_to_draw_is_an_error(body: str) -> None:
    with pytest.raises(InputError, match="nothing that can be drawn"):
        read(body)


def test_uses_that_multiply_meet_a_budget() -> None:
    levels = "".join(
        f'<g id="l{i}">{f"""<use href="#l{i - 1}"/>""" * 10}</g>' for i in range(1, 12)
    )
    with pytest.raises(BudgetError, match="use copies"):
        read(f'<defs><path id="l0" d="M0 0h5v5z"/>{levels}</defs><use href="#l11"/>')


def test_path_commands_meet_a_budget_across_shapes() -> None:
    with pytest.raises(BudgetError, match="path commands"):
        read(square() * 10, limits=Limits(path_commands=30))


def test_style_sheets_meet_a_budget() -> None:
    with pytest.raises(BudgetError, match="style steps"):
        read(
            f"<style>{'path{fill:red}' * 50}</style>{square() * 50}", limits=Limits(style_steps=99)
        )


@pytest.mark.parametrize(
    "sheet",
    [
        "path{fill:" + "(" * 5000,
        ":not(" * 3000 + "a",
        "@media screen{" * 3000,
        "a{--a:var(--a)}*{fill:var(--a)}",
    ],
)
def test_absurd_style_sheets_are_survived(sheet: str) -> None:
    assert len(read(f"<style>{sheet}</style>{square()}").shapes) == 1


def test_a_stroke_seen_inside_of_its_fill_is_a_shape_of_its_own() -> None:
    star = '<path id="s" d="M50 5L79 95L2 38H98L21 95Z" stroke="red" fill-rule="{}"/>'
    for rule, count in (("nonzero", 2), ("evenodd", 1)):
        shapes = read(star.format(rule)).shapes
        assert len(shapes) == count
        assert shapes[0].style.fill is not None
        assert shapes[-1].style.stroke is not None
        assert {shape.name for shape in shapes} == {"s"}


def test_what_encloses_nothing_has_no_fill() -> None:
    (line,) = read('<path d="M5 5H50" stroke="red"/>').shapes
    assert line.style.fill is None
    (dot,) = read('<path d="M5 5h0" stroke="red" stroke-linecap="round"/>').shapes
    assert dot.style.fill is None
    assert 0 < np.ptp(dot.rings[0].curves[:, :, 0]) < 0.01
    assert not read('<path d="M5 5H50"/>' + square()).shapes[0].style.stroke


def test_a_flat_ring_is_a_line_without_caps() -> None:
    flat = '<polygon points="20,50 80,50 60,50" fill="none" stroke="red" {}/>'
    for join, cap in (("miter", "butt"), ("bevel", "butt"), ("round", "round")):
        (shape,) = read(flat.format(f'stroke-linecap="square" stroke-linejoin="{join}"')).shapes
        assert shape.style.stroke is not None
        assert shape.style.stroke.cap == cap
        (ring,) = shape.rings
        assert not ring.closed
        assert ring.curves[0, [0, 3]].tolist() == [[20, 50], [80, 50]]


def test_a_dashed_line_around_a_fill_starts_where_it_did() -> None:
    fill, line = read(
        '<rect x="5" y="5" width="30" height="20" fill="blue" stroke="red" stroke-dasharray="3"/>'
    ).shapes
    assert (fill.style.stroke, line.style.fill) == (None, None)
    assert not line.rings[0].closed
    assert line.rings[0].curves[0, 0].tolist() == [5, 5]


ARROW = '<path d="M0 0L4 2L0 4z" fill="context-stroke"/>'


@pytest.mark.parametrize(
    ("marker", "line", "boxes"),
    [
        # As wide as the line is, at its end.
        ('refX="0" refY="2" markerWidth="4" markerHeight="4"', "M10 50H50", [(50, 46, 58, 54)]),
        # In user units.
        (
            'markerUnits="userSpaceOnUse" refY="2" markerWidth="4" markerHeight="4"',
            "M10 50H50",
            [(50, 48, 54, 52)],
        ),
        # Turned as the line runs.
        (
            'orient="auto" refY="2" markerWidth="4" markerHeight="4"',
            "M10 10V50",
            [(6, 50, 14, 58)],
        ),
        ('orient="90" refY="2" markerWidth="4" markerHeight="4"', "M10 50H50", [(46, 50, 54, 58)]),
        # Through its view box.
        (
            'viewBox="0 0 4 4" refX="center" refY="center" markerWidth="2" markerHeight="2"',
            "M10 50H50",
            [(48, 48, 52, 52)],
        ),
    ],
)
def test_markers_are_shapes(
    marker: str, line: str, boxes: list[tuple[float, float, float, float]]
) -> None:
    drawing = read(
        f'<marker id="m" {marker}>{ARROW}</marker><path d="{line}" stroke="red" fill="none" '
        'stroke-width="2" marker-end="url(#m)"/>'
    )
    drawn = drawing.shapes[1:]
    assert drawing.warnings == ()
    assert [shape.style.fill for shape in drawn] == [Colour(1, 0, 0)] * len(boxes)
    found = np.array([shape.rings[0].box.ravel() for shape in drawn])
    np.testing.assert_allclose(found, np.array(boxes), atol=1e-9)


def test_markers_stand_at_every_vertex() -> None:
    drawing = read(
        f'<marker id="m" orient="auto-start-reverse" overflow="visible">{ARROW}</marker>'
        '<polyline points="10 10 30 10 30 30" fill="none" stroke="red" style="marker:url(#m)"/>'
    )
    places = [shape.rings[0].curves[0, 0].round(9).tolist() for shape in drawing.shapes[1:]]
    assert places == [[10, 10], [30, 10], [30, 30]]
    tips = [shape.rings[0].curves[0, 3] for shape in drawing.shapes[1:]]
    assert tips[0][0] < 10
    assert tips[2][1] > 30


def test_markers_in_markers_end() -> None:
    body = '<marker id="m"><path d="M0 0H5" stroke="red" marker-end="url(#m)"/></marker>'
    assert read(body + '<path d="M0 0H50" stroke="red" marker-end="url(#m)"/>').shapes


@pytest.mark.parametrize(
    ("style", "colour"),
    [
        ("background-color: rgb(30,30,60)", (30, 30, 60)),
        ("background:#1e1e3c", (30, 30, 60)),
        ("background:none", None),
        ("background:transparent", None),
        ("color:#1e1e3c;background:currentColor", (30, 30, 60)),
    ],
)
def test_the_background_of_the_root_is_a_sheet(
    style: str, colour: tuple[int, int, int] | None
) -> None:
    text = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="5 6 70 80" style="{style}">'
    drawing = read_svg((text + square() + "</svg>").encode(), "a.svg")
    assert drawing.warnings == ()
    if colour is None:
        assert len(drawing.shapes) == 1
        return
    sheet, _ = drawing.shapes
    red, green, blue = (part / 255 for part in colour)
    assert sheet.style.fill == Colour(red, green, blue)
    assert sheet.rings[0].box.tolist() == [[5, 6], [75, 86]]


def test_what_runs_far_out_is_brought_near() -> None:
    (shape,) = read('<path d="M10 90A1e-9 5 0 0 0 50 90" fill="none" stroke="red"/>').shapes
    assert np.abs(shape.rings[0].curves).max() < 1e7
    assert shape.rings[0].curves[0, 0].tolist() == [10, 90]
    assert shape.rings[0].curves[-1, 3].tolist() == [50, 90]


def test_a_radial_gradient_from_a_circle_on_is_a_cone_from_its_apex() -> None:
    stops = '<stop stop-color="red"/><stop offset="1" stop-color="blue"/>'
    body = (
        f'<radialGradient id="g" gradientUnits="userSpaceOnUse" cx="50" cy="50" r="40" fr="{{}}">'
        f'{stops}</radialGradient><rect width="100" height="100" fill="url(#g)"/>'
    )
    paint = read(body.format(10)).shapes[0].style.fill
    assert isinstance(paint, Gradient)
    assert paint.points == pytest.approx((50, 50, 40, 50, 50))
    assert [stop.offset for stop in paint.stops] == pytest.approx([0.25, 1.0])
    with pytest.raises(InputError):
        read(body.format(40))


def test_a_gradient_in_linear_light_has_stops_on_its_way() -> None:
    stops = '<stop stop-color="red"/><stop offset="1" stop-color="blue"/>'
    body = '<linearGradient id="g" color-interpolation="linearRGB">{}</linearGradient>{}'
    rect = '<rect width="100" height="100" fill="url(#g)"/>'
    paint = read(body.format(stops, rect)).shapes[0].style.fill
    assert isinstance(paint, Gradient)
    (middle,) = (stop for stop in paint.stops if stop.offset == 0.5)
    assert middle.colour.red == pytest.approx(0.735, abs=1e-3)


def test_a_gradient_without_a_box_gives_way_to_the_colour_beside_it() -> None:
    body = (
        '<linearGradient id="g"><stop stop-color="red"/><stop offset="1"/></linearGradient>'
        '<path d="M10 50H90" stroke="url(#g) #0a0"/><path d="M10 60H90" stroke="url(#g)"/>'
    )
    (shape,) = read(body).shapes
    assert shape.style.stroke is not None
    assert isinstance(shape.style.stroke.paint, Colour)
