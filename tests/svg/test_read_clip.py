"""Clip paths: what they leave alone, cut, and hide."""

import numpy as np
import pytest

from shapetween.base.errors import InputError
from shapetween.model.drawing import Drawing
from shapetween.svg.read.reader import read_svg

HALF = '<clipPath id="c"><rect width="50" height="100"/></clipPath>'


def read(body: str) -> Drawing:
    root = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100">'
    return read_svg(f"{root}{body}</svg>".encode(), "a.svg")


def area(drawing: Drawing) -> float:
    return abs(sum(ring.area for shape in drawing.shapes for ring in shape.rings))


def test_an_untouched_shape_keeps_its_curves() -> None:
    circle = '<circle cx="25" cy="50" r="25" {}/>'
    (plain,) = read(circle.format("")).shapes
    (clipped,) = read(HALF + circle.format('clip-path="url(#c)"')).shapes
    np.testing.assert_array_equal(clipped.rings[0].curves, plain.rings[0].curves)


def test_a_cut_circle_is_half_of_it_in_few_curves() -> None:
    drawing = read(HALF + '<circle cx="50" cy="50" r="30" clip-path="url(#c)"/>')
    (ring,) = drawing.shapes[0].rings
    assert len(ring.curves) <= 4
    assert area(drawing) == pytest.approx(np.pi * 30**2 / 2, rel=1e-3)


def test_corners_of_a_clip_are_each_as_round_as_is_said() -> None:
    body = '<rect width="100" height="50" style="clip-path:inset(0 round {})"/>'
    full = 100 * 50

    def missing(radii: str) -> float:
        return (full - area(read(body.format(radii)))) / (1 - np.pi / 4)

    assert missing("10px 0 20px 0") == pytest.approx(10**2 + 20**2, rel=1e-2)
    assert missing("10px / 20px") == pytest.approx(4 * 200, rel=1e-2)
    # Radii that meet are made smaller.
    assert missing("100px") == pytest.approx(4 * 25**2, rel=1e-2)


def test_a_hidden_shape_is_gone() -> None:
    with pytest.raises(InputError):
        read(HALF + '<circle cx="80" cy="50" r="20" clip-path="url(#c)"/>')


@pytest.mark.parametrize(
    ("rule", "expected"), [("nonzero", 40.0 * 40.0), ("evenodd", 40.0 * 40.0 - 20.0 * 20.0)]
)
def test_fill_rules_of_clips(rule: str, expected: float) -> None:
    path = f'<path clip-rule="{rule}" d="M10 10h40v40h-40zM20 20h20v20h-20z"/>'
    body = f'<clipPath id="c">{path}</clipPath><rect width="90" height="90" clip-path="url(#c)"/>'
    assert area(read(body)) == pytest.approx(expected)


def test_clips_of_groups_and_of_clips_meet() -> None:
    body = (
        '<clipPath id="d"><rect height="50" width="100"/></clipPath>'
        '<clipPath id="e" clip-path="url(#d)"><rect x="40" width="60" height="100"/></clipPath>'
        f'{HALF}<g clip-path="url(#c)"><rect width="90" height="90" clip-path="url(#e)"/></g>'
    )
    assert area(read(body)) == pytest.approx(10 * 50)


def test_a_cut_stroke_stays_a_stroke_under_a_clip() -> None:
    line = '<path id="{}" d="M0 50H100" stroke="red" stroke-width="10" clip-path="url(#c)"/>'
    one, two = read(
        HALF + f'<g clip-path="url(#c)">{line.format("a")}{line.format("b")}</g>'
    ).shapes
    assert one.style.stroke is not None
    assert one.rings[0].curves[-1, 3].tolist() == [100, 50]
    ((mask,),) = (group.masks for group in one.style.groups)
    assert mask.plain
    assert abs(mask.shapes[0].rings[0].area) == pytest.approx(50 * 100)
    assert one.style.groups == two.style.groups


def test_a_stroke_that_a_clip_leaves_alone_has_none() -> None:
    line = '<path d="M10 50H40" stroke="red" stroke-width="10" clip-path="url(#c)"/>'
    (shape,) = read(HALF + line).shapes
    assert shape.style.groups == ()


def test_fill_and_stroke_are_cut_each_in_its_way() -> None:
    shape = '<path d="M10 10H90V90z" fill="blue" stroke="red" clip-path="url(#c)"/>'
    fill, stroke = read(HALF + shape).shapes
    assert (fill.style.stroke, stroke.style.fill) == (None, None)
    assert fill.rings[0].box[1].tolist() == [50, pytest.approx(50)]
    assert (len(fill.style.groups), len(stroke.style.groups)) == (0, 1)


@pytest.mark.parametrize(
    ("shape", "expected"),
    [
        ("circle(20px at 50px 50px)", np.pi * 400),
        ("circle()", np.pi * 40**2),
        ("circle(farthest-side at 10px 50px)", None),
        ("ellipse(10px 20px)", np.pi * 200),
        ("ellipse()", np.pi * 40**2),
        ("inset(10px)", 60 * 60),
        ("inset(25% 0)", 40 * 80),
        ("inset(0 round 40px)", np.pi * 40**2),
        ("polygon(0 0, 100% 0, 100% 100%)", 80 * 80 / 2),
        ("polygon(evenodd, 0 0, 100% 0, 100% 100%)", 80 * 80 / 2),
        ("path('M0 0H10V10H0z')", 100),
        ("rect(10px 30px 50px 10px)", 20 * 40),
        ("xywh(0 0 10px 20px)", 200),
        ("circle(20px) view-box", np.pi * 400),
        ("fill-box", 80 * 80),
    ],
)
def test_clips_that_style_gives_as_shapes(shape: str, expected: float | None) -> None:
    body = f'<rect x="10" y="10" width="80" height="80" style="clip-path:{shape}"/>'
    drawing = read(body)
    assert drawing.warnings == ()
    if expected is not None:
        assert area(drawing) == pytest.approx(expected, rel=2e-3)


def test_a_clip_in_units_of_a_groups_box() -> None:
    body = (
        '<clipPath id="c" clipPathUnits="objectBoundingBox">'
        '<rect width=".5" height="1"/></clipPath><g clip-path="url(#c)">'
        '<rect x="10" y="20" width="40" height="60"/>'
        '<rect x="50" y="20" width="40" height="60"/></g>'
    )
    assert area(read(body)) == pytest.approx(40 * 60)


def test_a_nested_viewport_hides_what_is_outside() -> None:
    body = '<svg x="10" y="10" width="20" height="30" {}><rect width="90" height="90"/></svg>'
    assert area(read(body.format(""))) == pytest.approx(600)
    assert area(read(body.format('overflow="visible"'))) == pytest.approx(8100)


def test_a_clip_in_units_of_the_box() -> None:
    body = (
        '<clipPath id="c" clipPathUnits="objectBoundingBox">'
        '<rect width=".5" height=".5"/></clipPath>'
        '<rect x="10" y="20" width="40" height="60" clip-path="url(#c)"/>'
    )
    assert area(read(body)) == pytest.approx(20 * 30)


def test_a_round_clip_gives_its_own_curves() -> None:
    body = (
        '<clipPath id="r"><circle cx="50" cy="50" r="30"/><rect y="45" width="50" height="10"/>'
        '</clipPath><rect x="20" y="10" width="80" height="80" clip-path="url(#r)"/>'
    )
    (ring,) = read(body).shapes[0].rings
    # Four quarters; the bar's part within the page is a notch of the disc's left side only.
    assert len(ring.curves) <= 8
    assert area(read(body)) == pytest.approx(np.pi * 30**2, rel=3e-3)


def test_a_clip_within_a_clip_cuts_curves_by_curves() -> None:
    body = (
        '<clipPath id="d"><circle cx="60" cy="50" r="30"/></clipPath>'
        '<clipPath id="e" clip-path="url(#d)"><circle cx="40" cy="50" r="30"/></clipPath>'
        '<rect width="100" height="100" clip-path="url(#e)"/>'
    )
    (ring,) = read(body).shapes[0].rings
    assert len(ring.curves) == 4
    lens = 2 * 30**2 * np.arccos(1 / 3) - 20 / 2 * np.sqrt(4 * 30**2 - 20**2)
    assert area(read(body)) == pytest.approx(lens, rel=1e-3)


def test_a_clip_that_uses_a_group_shows_nothing_and_it_is_told() -> None:
    body = '<g id="g"><rect width="9" height="9"/></g><clipPath id="c"><use href="#g"/></clipPath>'
    drawing = read(body + '<rect width="90" height="90" clip-path="url(#c)"/>')
    assert area(drawing) == pytest.approx(9 * 9)
    (warning,) = drawing.warnings
    assert "as in browsers" in warning


def test_strokes_of_a_mask_are_areas_too() -> None:
    """A sheet behind a mask of white and black strokes is the icon that is seen."""
    text = (
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 48 48"><mask id="m">'
        '<g fill="none" stroke-width="4"><path fill="#fff" stroke="#fff" d="M12 12h24v24H12z"/>'
        '<path stroke="#000" d="M18 24h12"/></g></mask>'
        '<path d="M0 0h48v48H0z" mask="url(#m)"/></svg>'
    )
    drawing = read_svg(text.encode(), "a.svg")
    (shape,) = drawing.shapes
    assert not drawing.warnings
    assert not shape.style.groups
    assert sorted(abs(ring.area) for ring in shape.rings) == pytest.approx([48, 28 * 28])
