"""Masks, filters, blending and opacities of groups, as they are read."""

import numpy as np
import pytest

from shapetween.model.drawing import Drawing, Shape
from shapetween.svg.read.reader import read_svg

RECT = '<rect x="10" y="10" width="80" height="80" fill="red" {}/>'


def read(body: str, root: str = "") -> Drawing:
    text = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100" {root}>{body}</svg>'
    return read_svg(text.encode(), "a.svg")


def area(shape: Shape) -> float:
    return abs(sum(ring.area for ring in shape.rings))


def masked(content: str, attributes: str = "", root: str = "") -> Drawing:
    body = f'<mask id="m" {attributes}>{content}</mask>' + RECT.format('mask="url(#m)"')
    return read(body, root)


@pytest.mark.parametrize(
    ("content", "attributes", "expected"),
    [
        # White shows, black hides, what is not covered is hidden.
        ('<rect width="50" height="100" fill="white"/>', "", 40 * 80),
        (
            '<rect width="100" height="100" fill="white"/><rect width="50" height="100"/>',
            "",
            40 * 80,
        ),
        ('<rect width="50" height="100" fill="#D9D9D9"/>', 'style="mask-type:alpha"', 40 * 80),
        ('<rect width="50" height="100"/>', 'mask-type="alpha"', 40 * 80),
        # What it inherits where it stands.
        ('<rect width="50" height="100"/>', 'fill="white"', 40 * 80),
        # Its own region, and units of the box.
        ('<rect width="100" height="100" fill="white"/>', 'width="60%"', 40 * 80),
        (
            '<rect width="100" height="100" fill="white"/>',
            'maskUnits="userSpaceOnUse" x="0" y="0" width="50" height="100"',
            40 * 80,
        ),
        (
            '<rect width=".5" height="1" fill="white"/>',
            'maskContentUnits="objectBoundingBox"',
            40 * 80,
        ),
        ('<use href="#r"/><defs><path id="r" fill="#fff" d="M0 0H50V100H0"/></defs>', "", 40 * 80),
    ],
)
def test_a_mask_of_white_and_black_cuts(content: str, attributes: str, expected: float) -> None:
    drawing = masked(content, attributes)
    assert drawing.warnings == ()
    (shape,) = drawing.shapes
    assert shape.style.groups == ()
    assert area(shape) == pytest.approx(expected)


def test_a_mask_that_hides_nothing_is_no_matter() -> None:
    drawing = masked('<rect width="100" height="100" fill="white"/>')
    assert drawing.warnings == ()
    np.testing.assert_array_equal(
        drawing.shapes[0].rings[0].curves, read(RECT.format("")).shapes[0].rings[0].curves
    )


@pytest.mark.parametrize(
    "content",
    [
        '<rect width="50" height="100" fill="#888"/>',
        '<rect width="50" height="100" fill="white" fill-opacity=".5"/>',
        '<path d="M0 50H90" stroke="white" stroke-width="9"/>',
        '<linearGradient id="g"><stop stop-color="#fff"/><stop offset="1"/></linearGradient>'
        '<rect width="90" height="90" fill="url(#g)"/>',
        '<g filter="blur(2px)"><rect width="50" height="100" fill="white"/></g>',
    ],
)
def test_any_other_mask_is_carried(content: str) -> None:
    drawing = masked(content)
    assert drawing.warnings == ()
    (group,) = drawing.shapes[0].style.groups
    (mask,) = group.masks
    assert mask.shapes
    assert not mask.plain


def test_one_mask_on_a_group_is_one_group() -> None:
    content = '<rect width="50" height="100" fill="#888"/>'
    body = f'<mask id="m">{content}</mask><g mask="url(#m)">{RECT.format("") * 2}</g>'
    one, two = read(body).shapes
    assert one.style.groups == two.style.groups != ()


@pytest.mark.parametrize("name", ["mask", "filter", "clip-path"])
def test_what_names_nothing_says_nothing(name: str) -> None:
    drawing = read(RECT.format(f'{name}="url(#none)"'))
    assert (drawing.warnings, drawing.shapes[0].style.groups) == ((), ())


def filtered(content: str, attributes: str = "", more: str = "") -> Drawing:
    body = f'<filter id="f" {attributes}>{content}</filter><g {more}>'
    return read(body + RECT.format('filter="url(#f)"') + "</g>")


def test_a_filter_is_carried_in_user_units() -> None:
    drawing = filtered(
        '<feDropShadow dx="1" stdDeviation="2 3" flood-color="blue" style="flood-opacity:.5"/>',
        'filterUnits="userSpaceOnUse" x="5" y="5" width="90" height="90" '
        'color-interpolation-filters="sRGB"',
        'transform="translate(3 4) scale(2)"',
    )
    (group,) = drawing.shapes[0].style.groups
    found = group.filter
    assert found is not None
    assert found.region == (13, 14, 180, 180)
    (step,) = found.primitives
    assert dict(step.lengths) == {"dx": (2,), "dy": (4,), "stdDeviation": (4, 6)}
    assert dict(step.attributes) == {
        "flood-color": "#0000ff",
        "flood-opacity": "0.5",
        "color-interpolation-filters": "sRGB",
    }


def test_a_filter_under_a_turn_keeps_its_own_units() -> None:
    drawing = filtered('<feOffset dx="5"/>', more='transform="rotate(30)"')
    found = drawing.shapes[0].style.groups[0].filter
    assert found is not None
    assert found.matrix[:2] == pytest.approx((np.cos(np.pi / 6), 0.5))


@pytest.mark.parametrize(
    ("text", "tag"),
    [
        ("blur(2px)", "feGaussianBlur"),
        ("drop-shadow(1px 2px 3px rgb(0 0 0 / .5))", "feDropShadow"),
        ("drop-shadow(red 1px 2px)", "feDropShadow"),
        ("brightness(50%)", "feComponentTransfer"),
        ("invert()", "feComponentTransfer"),
        ("opacity(.5)", "feComponentTransfer"),
        ("grayscale(1)", "feColorMatrix"),
        ("hue-rotate(90deg)", "feColorMatrix"),
        ("sepia(1)", "feColorMatrix"),
    ],
)
def test_filter_functions(text: str, tag: str) -> None:
    drawing = read(RECT.format(f'style="filter:{text}"'))
    assert drawing.warnings == ()
    found = drawing.shapes[0].style.groups[0].filter
    assert found is not None
    assert [step.tag for step in found.primitives] == [tag]


def test_what_a_filter_needs_from_outside_is_told() -> None:
    drawing = filtered('<feImage href="a.png"/>')
    assert drawing.shapes[0].style.groups == ()
    (warning,) = drawing.warnings
    assert "feImage" in warning


def test_blending_is_carried() -> None:
    drawing = read(RECT.format("") + RECT.format('style="mix-blend-mode:multiply"'))
    assert [len(shape.style.groups) for shape in drawing.shapes] == [0, 1]
    assert drawing.shapes[1].style.groups[0].blend == "multiply"


def test_a_clip_around_a_filter_is_not_cut_before_it() -> None:
    body = '<clipPath id="c"><rect width="50" height="100"/></clipPath>'
    inner = RECT.format('style="filter:blur(9px)"')
    (shape,) = read(f'{body}<g clip-path="url(#c)">{inner}</g>').shapes
    clip, blur = shape.style.groups
    assert clip.masks[0].plain
    assert blur.filter is not None
    assert area(shape) == pytest.approx(6400)


def test_masks_within_masks_end() -> None:
    content = '<mask id="n"><g mask="url(#m)"><rect width="9" height="9" fill="#fff"/></g></mask>'
    drawing = read(
        f'{content}<mask id="m"><g mask="url(#n)"><rect width="9" height="9" fill="#fff"/></g>'
        "</mask>" + RECT.format('mask="url(#m)"') + RECT.format("")
    )
    assert any("masks itself" in warning for warning in drawing.warnings)


def test_what_blends_within_a_clip_or_a_group_sees_only_what_is_in_it() -> None:
    clip = '<clipPath id="c"><rect width="60" height="100"/></clipPath>'
    blended = RECT.format('style="mix-blend-mode:multiply"')
    plain = read(clip + blended).shapes[0].style.groups
    assert [group.isolated for group in plain] == [False]
    for attributes in ('clip-path="url(#c)"', 'style="isolation:isolate"', 'opacity=".5"'):
        drawing = read(f"{clip}<g {attributes}>{RECT.format('')}{blended}</g>")
        below, above = (shape.style.groups for shape in drawing.shapes)
        # The one group holds both of them.
        assert below[0] is above[0]
        assert below[0].isolated
        assert [group.blend for group in above] == ["normal", "multiply"]


def test_style_says_how_a_mask_is_taken() -> None:
    black = '<mask id="m"><rect width="50" height="100"/></mask>'
    for style in ("mask:url(#m) alpha", "mask-image:url(#m);mask-mode:alpha"):
        drawing = read(black + RECT.format(f'style="{style}"'))
        assert area(drawing.shapes[0]) == pytest.approx(40 * 80)


def test_a_mask_in_linear_light_is_told() -> None:
    grey = '<rect width="100" height="100" fill="#888"/>'
    (warning,) = masked(grey, 'color-interpolation="linearRGB"').warnings
    assert "linearRGB" in warning
