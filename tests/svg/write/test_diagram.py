"""The picture of matched meshes."""

import re
import xml.etree.ElementTree as ET

import numpy as np
import pytest

from shapetween.mesh.pair import MeshPair
from shapetween.model.outline import Outline
from shapetween.svg.write.diagram import diagram_svg
from shapetween.svg.write.mesh_panels import MeshView
from shapetween.svg.write.part_panels import MOST_LINES, Drawn, PartView
from tests.movements import circle, ellipse
from tests.strategies import grid

SVG = "{http://www.w3.org/2000/svg}"


def view(name: str = "", size: float = 1.0) -> MeshView:
    """A disc that becomes an upright ellipse in other units, over five quads and two triangles."""
    square, quads = grid(3, 3)
    square = square / 1.5 - 1
    round_off = np.sqrt(1 - square[:, ::-1] ** 2 / 2)  # the square mapped onto the disc
    disc = square * round_off
    source, target = 40 * disc + 50, size * (disc * (3, 8) + (5, 9))
    pair = MeshPair(source, target, quads[1:], np.array([quads[0][:3], quads[0][[0, 2, 3]]]))
    border = np.array([0, 1, 2, 3, 7, 11, 15, 14, 13, 12, 8, 4])
    return MeshView(
        name,
        Outline(circle(np.array([50.0, 50.0]), 40.0)),
        Outline(ellipse((5.0 * size, 9.0 * size), (3.0 * size, 8.0 * size))),
        pair,
        border,
    )


def test_every_face_is_drawn_twice_in_one_colour_and_numbered() -> None:
    root = ET.fromstring(diagram_svg([view()], ("a.svg", "b.svg")))
    faces = root.findall(f".//{SVG}path[@class='face']")
    assert len(faces) == 2 * 10
    fills = [face.attrib["fill"] for face in faces]
    assert fills[:10] == fills[10:]
    assert len(set(fills)) == 10
    groups = root.findall(f".//{SVG}g[@class='number']")
    numbers = [[text.text for text in group] for group in groups]
    assert numbers == 2 * [[*map(str, range(8)), "0", "1"]]
    hatched = root.findall(f".//{SVG}path[@fill='url(#hatching)']")
    assert len(hatched) == 2 * 2


@pytest.mark.parametrize("size", [1e-3, 1.0, 1e4])
def test_every_node_says_how_to_pin_it(size: float) -> None:
    meshes = view(size=size)
    root = ET.fromstring(diagram_svg([meshes], ("a.svg", "b.svg")))
    titles = [at.findtext(f"{SVG}title") or "" for at in root.findall(f".//{SVG}g[@class='at']")]
    assert len(titles) == 2 * 16
    assert sum(title.startswith("inner vertex") for title in titles) == 2 * 4
    pins = dict(re.findall(r"node (\d+)\n--pin (\S+)", "\n".join(titles[:16])))
    assert sorted(map(int, pins)) == sorted(meshes.nodes.tolist())
    for node, pin in pins.items():
        (ax, ay), (bx, by) = (map(float, half.split(",")) for half in pin.split(":"))
        np.testing.assert_allclose((ax, ay), meshes.pair.source[int(node)], atol=0.02)
        np.testing.assert_allclose((bx, by), meshes.pair.target[int(node)], atol=1e-3 * 16 * size)


def test_grid_lines_are_where_their_labels_say() -> None:
    """A label's place on its axis is the same map from units to pixels that the nodes take."""
    meshes = view()
    root = ET.fromstring(diagram_svg([meshes], ("a.svg", "b.svg")))
    nodes = root.findall(f".//{SVG}g[@class='at']/{SVG}circle")
    x = np.array([float(node.attrib["cx"]) for node in nodes])
    ticks = root.findall(f".//{SVG}text[@class='tick']")
    horizontal = [tick for tick in ticks if tick.attrib["text-anchor"] == "middle"]
    for units, pixels, left in (
        (meshes.pair.source, x[:16], True),
        (meshes.pair.target, x[16:], False),
    ):
        slope, shift = np.polyfit(units[:, 0], pixels, 1)
        near = [t for t in horizontal if (float(t.attrib["x"]) < x[16:].min() - 80) == left]
        assert len(near) >= 2
        for tick in near:
            value = float(tick.text or "nan")
            assert float(tick.attrib["x"]) == pytest.approx(slope * value + shift, abs=0.05)


def test_several_meshes_and_odd_names() -> None:
    views = [view("one"), view("two <&>")]
    text = diagram_svg(views, ("a <&> long name that does not fit.svg" * 4, "b.svg"))
    root = ET.fromstring(text)
    assert len(root.findall(f".//{SVG}path[@class='face']")) == 4 * 10
    assert "20 quads" not in text
    assert "16 quads · 4 triangles · 24 matched nodes" in text


def test_the_same_meshes_are_the_same_text() -> None:
    assert diagram_svg([view()], ("a", "b")) == diagram_svg([view()], ("a", "b"))


def drawn(order: int, x: float, *, width: float = 0.0, name: str = "") -> Drawn:
    """A disc of a drawing, or a ring as a line."""
    middle = np.array([x, 10.0])
    rings = (Outline(circle(middle, 4.0)),)
    return Drawn(order, order + 1, name, rings, width, middle)


def test_parts_that_become_each_other_have_one_colour_and_what_is_alone_is_grey() -> None:
    parts = [
        PartView(drawn(1, 10.0, name="eye"), drawn(0, 30.0), 0.25, "matched"),
        PartView(drawn(0, 20.0, width=2.0), drawn(1, 10.0, width=1.0), -2.0, "alike"),
        PartView(drawn(2, 30.0), None, 1.5, "alone"),
        PartView(None, drawn(2, 20.0), np.inf, "alone"),
    ]
    text = diagram_svg([], ("a.svg", "b.svg"), parts)
    root = ET.fromstring(text)
    groups = root.findall(f".//{SVG}g[@class='of']")
    titles = [group.findtext(f"{SVG}title") for group in groups]
    assert titles == [
        "#1 becomes #2: alike, cost -2.00\n--match #1:#2",
        "#2 eye becomes #1: matched, cost 0.25\n--match #2:#1",
        "#3 goes alone: its best partner would cost 1.50 more\n--match #3:",
        "#2 eye becomes #1: matched, cost 0.25\n--match #2:#1",
        "#1 becomes #2: alike, cost -2.00\n--match #1:#2",
        "#3 comes alone\n--match :#3",
    ]
    last = [group.findall(f"{SVG}path")[-1].attrib for group in groups]
    colours = [one["stroke"] if one["class"] == "line" else one["fill"] for one in last]
    assert colours[0] == colours[4] != colours[1] == colours[3]
    assert colours[2] == colours[5] == "#eceef1"
    listed = [one.text for one in root.findall(f".//{SVG}text[@class='list']")]
    assert listed == [(title or "").split("\n")[0] for title in (*titles[1::-1], *titles[2::3])]


def test_a_long_list_says_how_much_it_leaves_out() -> None:
    parts = [PartView(drawn(k, 9.0 * k), drawn(k, 9.0 * k), 0.0, "alike") for k in range(100)]
    root = ET.fromstring(diagram_svg([], ("a.svg", "b.svg"), parts))
    listed = [one.text for one in root.findall(f".//{SVG}text[@class='list']")]
    assert len(listed) == 2 * MOST_LINES
    assert listed[-1] == f"and {100 - 2 * MOST_LINES + 1} more; see --report"
    few = diagram_svg([], ("a.svg", "b.svg"), parts[: 2 * MOST_LINES])
    assert "more; see" not in few


def test_parts_stand_above_the_meshes() -> None:
    both = diagram_svg([view()], ("a", "b"), [PartView(drawn(0, 5.0), drawn(0, 5.0), 1.0, "alike")])
    assert "Point at a node" in both
    alone = [float(y) for y in re.findall(r'<text x="[^"]*" y="([^"]*)" class="list"', both)]
    nodes = [float(y) for y in re.findall(r'<circle class="node" cx="[^"]*" cy="([^"]*)"', both)]
    assert max(alone) < min(nodes)
