import json
from collections.abc import Sequence
from typing import TypeAlias

import numpy as np
import pytest

from shapetween.base.errors import MeshError
from shapetween.photo.quads import PictureQuad, load_quads, meshes_of_quads, quads_of_drawings
from shapetween.svg.read.reader import read_svg

Corners: TypeAlias = Sequence[Sequence[float]]

SQUARE = [[0, 0], [10, 0], [10, 10], [0, 10]]


def shifted(x: float, y: float, size: float = 1.0) -> list[list[float]]:
    return [[x + size * a, y + size * b] for a, b in SQUARE]


def text(*quads: dict[str, object]) -> str:
    return json.dumps({"quads": list(quads)})


def test_quads_are_read() -> None:
    quads = load_quads(text({"id": "sign", "a": SQUARE, "b": shifted(3, 4), "depth": 2}), "q.json")
    assert [(quad.name, quad.depth) for quad in quads] == [("sign", 2.0)]
    assert quads[0].a.tolist() == SQUARE
    assert quads[0].b.tolist() == shifted(3, 4)


def test_id_and_depth_may_be_left_out() -> None:
    quads = load_quads(text({"a": SQUARE, "b": SQUARE}, {"a": SQUARE, "b": SQUARE}), "q.json")
    assert [(quad.name, quad.depth) for quad in quads] == [("0", 0.0), ("1", 0.0)]


@pytest.mark.parametrize(
    ("written", "complaint"),
    [
        ("{", "q.json: line 1, column 2: not JSON"),
        ("[]", 'q.json: expected {"quads": [...]}'),
        ('{"quads": []}', "q.json: quads: expected a list of at least one quad"),
        ('{"quads": [{"a": [], "a": []}]}', "q.json: key 'a' stands twice"),
        ('{"quads": [1], "x": 2}', "q.json: unknown key 'x'"),
        ('{"quads": [1]}', "q.json: quads[0]: expected an object with a and b"),
        (text({"a": SQUARE}), "q.json: quads[0]: has no b; expected four corners"),
        (text({"a": SQUARE, "b": SQUARE, "c": 1}), "q.json: quads[0]: unknown key 'c'"),
        (text({"a": SQUARE[:3], "b": SQUARE}), "q.json: quads[0].a: 3 corners; expected 4"),
        (text({"a": SQUARE, "b": [[0, 0], [1]]}), "q.json: quads[0].b[1]: expected [x, y]"),
        (text({"a": [["0", 0]], "b": SQUARE}), "q.json: quads[0].a[0][0]: expected a number"),
        (text({"a": [[10**400, 0]], "b": SQUARE}), "quads[0].a[0][0]: the number is too large"),
        ('{"quads": [{"a": [[NaN, 0]], "b": []}]}', "q.json: NaN is not a number"),
        (text({"id": 5, "a": SQUARE, "b": SQUARE}), "q.json: quads[0].id: expected text"),
        (text({"a": SQUARE, "b": SQUARE, "depth": "near"}), "quads[0].depth: expected a number"),
        (
            text({"id": "x", "a": SQUARE, "b": SQUARE}, {"id": "x", "a": SQUARE, "b": SQUARE}),
            "q.json: quads[1].id: 'x' is the id of an earlier quad",
        ),
        (
            text({"id": "x", "a": [SQUARE[k] for k in (0, 2, 1, 3)], "b": SQUARE}),
            "q.json: quads[0].a: quad 'x' crosses itself",
        ),
        (
            text({"id": "x", "a": SQUARE, "b": [[0, 0], [10, 0], [2, 2], [0, 10]]}),
            "q.json: quads[0].b: quad 'x' is not convex at corner 2",
        ),
        (
            text({"a": [[0, 0], [5, 0], [10, 0], [0, 10]], "b": SQUARE}),
            "quad '0' is not convex at corner 1",
        ),
        (text({"a": [[0, 0]] * 4, "b": SQUARE}), "quad '0' is not convex"),
        (text({"a": SQUARE, "b": SQUARE[::-1]}), "q.json: quads[0]: quad '0' is inverted"),
    ],
)
def test_what_is_wrong_is_named(written: str, complaint: str) -> None:
    with pytest.raises(MeshError) as caught:
        load_quads(written, "q.json")
    assert complaint in str(caught.value)
    assert "\n" not in str(caught.value)


def quad(name: str, a: Corners, b: Corners, depth: float = 0) -> PictureQuad:
    return PictureQuad(name, np.array(a, np.float64), np.array(b, np.float64), depth)


def test_quads_that_share_corners_are_one_mesh() -> None:
    side = shifted(10, 0)
    side[0] = [10.2, 0.1]  # drawn by hand
    meshes = meshes_of_quads([quad("l", SQUARE, SQUARE), quad("r", side, shifted(10, 0))])
    assert [(len(mesh.source), len(mesh.quads)) for mesh in meshes] == [(6, 2)]


def test_quads_that_part_are_two() -> None:
    meshes = meshes_of_quads([quad("l", SQUARE, SQUARE), quad("r", shifted(10, 0), shifted(30, 0))])
    assert [len(mesh.quads) for mesh in meshes] == [1, 1]


def test_quads_of_different_depth_are_two() -> None:
    meshes = meshes_of_quads(
        [quad("l", SQUARE, SQUARE), quad("r", shifted(10, 0), shifted(10, 0), depth=-1)]
    )
    assert [mesh.source[0].tolist() for mesh in meshes] == [[10, 0], [0, 0]]


def test_nearer_ones_are_painted_later() -> None:
    """By depth first, then by size, then as they come."""
    quads = [
        quad("near", shifted(100, 0), SQUARE, depth=1),
        quad("large", shifted(200, 0, 3), SQUARE),
        quad("small", shifted(300, 0), SQUARE),
        quad("later", shifted(400, 0), SQUARE),
        quad("far", shifted(500, 0, 9), SQUARE, depth=-1),
    ]
    order = [mesh.source[0, 0] for mesh in meshes_of_quads(quads)]
    assert order == [500, 300, 400, 200, 100]


def svg(*shapes: str) -> bytes:
    head = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 50">'
    return (head + "".join(shapes) + "</svg>").encode()


POLYGON = '<polygon id="{}" points="0,0 10,0 10,10 0,10"/>'
EYE = np.eye(2, 3)


def test_quads_are_drawn_in_an_editor() -> None:
    """A polygon, a rectangle and a closed path, each under its id."""
    drawing = read_svg(
        svg(
            POLYGON.format("p"),
            '<rect id="r" x="20" width="5" height="4"/>',
            '<path id="s" d="M30 0h4v4h-4v-4z"/>',
        ),
        "a.svg",
    )
    fits = (EYE, 2 * EYE)
    quads = quads_of_drawings((drawing, drawing), fits, ("a.svg", "b.svg"))
    assert [found.name for found in quads] == ["p", "r", "s"]
    assert quads[0].a.tolist() == SQUARE
    assert quads[1].b.tolist() == [[40, 0], [50, 0], [50, 8], [40, 8]]
    assert [found.depth for found in quads] == [0, 1, 2]


@pytest.mark.parametrize(
    ("a", "b", "complaint"),
    [
        ('<circle id="p" r="4"/>', POLYGON.format("p"), "a.svg: 'p' is no quad"),
        ('<polygon points="0,0 1,0 1,1"/>', POLYGON.format("p"), "a.svg: shape 1 has no id"),
        (
            POLYGON.format("p") + POLYGON.format("q"),
            POLYGON.format("p"),
            "a.svg: 'q' has no namesake in b.svg",
        ),
        (POLYGON.format("p"), POLYGON.format("p") * 2, "b.svg: two shapes are called 'p'"),
        (
            POLYGON.format("p"),
            '<polygon id="p" points="0,0 0,10 10,10 10,0"/>',
            "'p' is inverted",
        ),
    ],
)
def test_drawings_that_are_no_quads(a: str, b: str, complaint: str) -> None:
    drawings = (read_svg(svg(a), "a.svg"), read_svg(svg(b), "b.svg"))
    with pytest.raises(MeshError) as caught:
        quads_of_drawings(drawings, (EYE, EYE), ("a.svg", "b.svg"))
    assert complaint in str(caught.value)
