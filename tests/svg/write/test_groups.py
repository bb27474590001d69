"""Groups of shapes as they are written: at rest, and as they come, go and change."""

import xml.etree.ElementTree as ET

import numpy as np
import pytest

import shapetween as st
from shapetween.model.drawing import Drawing
from shapetween.svg.read.reader import read_svg
from shapetween.svg.write.sequence import frame_svg

SVG = "{http://www.w3.org/2000/svg}"
RECT = '<rect x="{}" y="10" width="40" height="40" fill="red" {}/>'
PLAIN = RECT.format(20, "")


def read(body: str) -> Drawing:
    text = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100">{body}</svg>'
    return read_svg(text.encode(), "a.svg")


def between(a: str, b: str) -> st.Morph:
    return st.morph(read(a), read(b))


def elements(text: str, tag: str) -> list[ET.Element]:
    return list(ET.fromstring(text).iter(f"{SVG}{tag}"))


def drop(blur: float) -> str:
    return f'style="filter:drop-shadow(0px 0px {blur}px #000)"'


def test_shapes_of_a_group_are_written_in_one() -> None:
    text = frame_svg(read(f'<g opacity=".5">{RECT.format(10, "")}{RECT.format(30, "")}</g>'))
    (group,) = elements(text, "g")
    assert group.get("opacity") == ".5"
    assert len(group.findall(f"{SVG}path")) == 2


def test_definitions_have_ids_of_their_own() -> None:
    first = frame_svg(read(RECT.format(10, drop(3))))
    second = frame_svg(read(RECT.format(10, drop(4))))
    ids = [{e.get("id") for e in elements(text, "filter")} for text in (first, second)]
    assert ids[0].isdisjoint(ids[1])
    (group,) = elements(first, "g")
    assert group.get("filter") == f"url(#{ids[0].pop()})"


def test_a_written_drawing_is_read_as_it_was() -> None:
    body = (
        f'<g style="mix-blend-mode:multiply">{RECT.format(10, drop(3))}</g>'
        '<mask id="m"><rect width="50" height="50" fill="#777"/></mask>'
        + RECT.format(10, 'mask="url(#m)"')
    )
    once = frame_svg(read(body))
    again = frame_svg(read_svg(once.encode(), "a.svg"))
    assert [[c.tag for c in e.iter()] for e in ET.fromstring(once)] == [
        [c.tag for c in e.iter()] for e in ET.fromstring(again)
    ]


def test_a_filter_of_one_side_is_mixed_with_what_it_is_made_of() -> None:
    moved = between(RECT.format(10, drop(4)), PLAIN)
    (group,) = moved.at(0.25).shapes[0].style.groups
    assert group.share == 0.75
    (mix,) = elements(frame_svg(moved.at(0.25)), "feComposite")
    assert (mix.get("k2"), mix.get("k3")) == (".75", ".25")
    assert moved.at(0).shapes[0].style.groups[0].share == 1
    assert moved.at(1).shapes[0].style.groups == ()
    (animated,) = elements(moved.svg(), "feComposite")
    assert {each.get("attributeName") for each in animated} == {"k2", "k3"}


def test_filters_alike_become_each_other() -> None:
    moved = between(RECT.format(10, drop(4)), RECT.format(30, drop(8)))
    (group,) = moved.at(0.5).shapes[0].style.groups
    assert group.filter is not None
    assert dict(group.filter.primitives[0].lengths)["stdDeviation"] == (6,)
    shadow, _still = elements(moved.svg(), "feDropShadow")
    assert "stdDeviation" in {each.get("attributeName") for each in shadow}


def test_an_opacity_of_one_side_fades() -> None:
    pair = f'<g opacity=".5">{RECT.format(10, "")}{RECT.format(30, "")}</g>'
    plain = RECT.format(10, "") + RECT.format(30, "")
    moved = between(pair, plain)
    (group,) = elements(frame_svg(moved.at(0.5)), "g")
    assert group.get("opacity") == ".75"


def test_a_mask_of_one_side_fades_to_all() -> None:
    mask = '<mask id="m"><rect width="100" height="100" fill="#888"/></mask>'
    moved = between(mask + RECT.format(10, 'mask="url(#m)"'), PLAIN)
    (element,) = elements(frame_svg(moved.at(0.5)), "mask")
    white, inner = element
    assert white.get("fill") == "#fff"
    assert inner.get("opacity") == ".5"
    assert not elements(frame_svg(moved.at(1)), "mask")


def test_a_mask_moves_with_its_shape() -> None:
    mask = '<mask id="m"><rect x="{}" y="20" width="20" height="20" fill="#888"/></mask>'
    body = mask + '<rect x="{}" y="10" width="40" height="40" mask="url(#m)"/>'
    moved = between(body.format(20, 10), body.format(60, 50))
    (group,) = moved.at(0.5).shapes[0].style.groups
    low, high = group.masks[0].shapes[0].rings[0].box
    assert [*low, *high] == pytest.approx([40, 20, 60, 40], abs=1e-6)
    written, _still = elements(moved.svg(), "mask")
    assert any(each.get("attributeName") == "d" for each in written.iter())


def test_a_drawing_with_groups_to_itself_stands_still() -> None:
    body = f'<g opacity=".5">{RECT.format(10, "")}{RECT.format(30, drop(3))}</g>'
    moved = between(body, body)
    texts = {frame_svg(moved.at(t)) for t in (0.0, 0.3, 0.7, 1.0)}
    assert len(texts) == 1


def test_groups_are_fitted_with_the_drawing() -> None:
    small = (
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 10 10">'
        '<filter id="f" filterUnits="userSpaceOnUse" x="1" y="1" width="5" height="5">'
        '<feGaussianBlur stdDeviation="1"/></filter>'
        '<rect width="5" height="5" filter="url(#f)"/></svg>'
    )
    moved = st.morph(read(PLAIN), read_svg(small.encode(), "b.svg"))
    found = moved.at(1).shapes[0].style.groups[0].filter
    assert found is not None
    assert np.allclose(found.region, (10, 10, 50, 50))
    assert dict(found.primitives[0].lengths)["stdDeviation"] == pytest.approx((10,))
