"""Mesh files: what is written reads back, and whatever is wrong is named with its place."""

import json
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from shapetween.base.arrays import Points
from shapetween.base.errors import MeshError
from shapetween.mesh.file import check_mesh, dump_meshes, load_meshes
from shapetween.mesh.pair import MeshPair
from tests.strategies import grid, rotation

#: What ids may hold, and JSON must escape.
NAMES = 'aZ0 _-"\\/\n\t\x00é☃🐎\ud800'
VERTICES, QUADS = grid(3, 2)
BORDER = np.array([0, 1, 2, 3, 7, 11, 10, 9, 8, 4])


def pair_of(source: Points, target: Points | None = None, **faces: Any) -> MeshPair:
    return MeshPair(source, source if target is None else target, **({"quads": QUADS} | faces))


def document(**changes: Any) -> dict[str, Any]:
    """A valid mesh as JSON holds it, with changes; None leaves a key out."""
    square = [[0, 0], [4, 0], [4, 4], [0, 4]]
    data = {"source": square, "target": square, "quads": [[0, 1, 2, 3]], **changes}
    return {key: value for key, value in data.items() if value is not None}


@settings(max_examples=40)
@given(
    st.integers(1, 4),
    st.integers(1, 3),
    st.floats(-3, 3),
    st.sampled_from([1e-3, 1.0, 1e6]),
    st.lists(st.text(NAMES, max_size=8), min_size=1, max_size=3, unique=True),
)
def test_meshes_read_back(
    columns: int, rows: int, turn: float, size: float, names: list[str]
) -> None:
    vertices, quads = grid(columns, rows)
    triangles = quads[:1, :3]
    pair = MeshPair(size * vertices, size * vertices @ rotation(turn).T, quads[1:], triangles)
    read = load_meshes(dump_meshes([(name, pair) for name in names]), "file")
    assert [name for name, _ in read] == names
    for _, again in read:
        np.testing.assert_allclose(again.source, pair.source, rtol=1e-11)
        np.testing.assert_allclose(again.target, pair.target, rtol=1e-11, atol=1e-11 * size)
        np.testing.assert_array_equal(again.quads, pair.quads)
        np.testing.assert_array_equal(again.triangles, pair.triangles)


def test_the_form_is_plain() -> None:
    text = dump_meshes([("", pair_of(VERTICES))])
    assert set(json.loads(text)) == {"source", "target", "quads"}
    assert text.splitlines()[:4] == ["{", ' "source": [', "  [0, 0],", "  [1, 0],"]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "line 1, column 1: not JSON"),
        ("[1]", "expected an object with source"),
        ('{"source": NaN}', "NaN is not a number"),
        ('{"source": [], "source": []}', "key 'source' stands twice"),
        ("[" * 100_000, "nested too deeply"),
        ('{"source": ' + "1" * 5000 + "}", "source: expected a list|digits"),
        (json.dumps({"meshes": []}), "meshes: expected a list of at least one"),
        (json.dumps({"meshes": [3]}), r"meshes\[0\]: expected an object"),
        (json.dumps({"meshes": [], "more": 1}), "unknown key 'more'; expected meshes"),
        (json.dumps(document(quad=[])), "unknown key 'quad'; expected id, quads"),
        (json.dumps(document(target=None)), "has no target"),
        (json.dumps(document(id=3)), "id: expected text"),
        (json.dumps(document(source=[[0, 0], [1]])), r"source\[1\]: expected \[x, y\]"),
        (json.dumps(document(source=[[0, "1"]])), r"source\[0\]\[1\]: expected a number"),
        (json.dumps(document(source=[[0, True]])), r"source\[0\]\[1\]: expected a number"),
        ('{"source": [[1e999, 0]], "target": []}', r"source\[0\]\[0\]: the number is too large"),
        (json.dumps(document(source=[[10**400, 0]])), r"source\[0\]\[0\]: the number is too"),
        (json.dumps(document(quads=[[0, 1, 2]])), r"quads\[0\]: expected 4 vertex numbers"),
        (json.dumps(document(quads=[[0, 1, 2, -1]])), r"quads\[0\]\[3\]: expected the number"),
        (json.dumps(document(quads=[[0, 1, 2, 2.0]])), r"quads\[0\]\[3\]: expected the number"),
        (json.dumps(document(quads=[[0, 1, 2, 9]])), "quads: an index names no vertex"),
        (json.dumps(document(quads=[[0, 1, 2, 2]])), "quads: face 0 names a vertex twice"),
        (json.dumps(document(quads=[])), "at least one quad or triangle"),
        (json.dumps(document(target=[[0, 0]])), "they must be as many"),
    ],
)
def test_what_is_wrong_is_named(text: str, message: str) -> None:
    with pytest.raises(MeshError, match=rf"^mine\.json: .*({message})") as caught:
        load_meshes(text, "mine.json")
    assert "\n" not in str(caught.value)


def bend(points: Points) -> Points:
    """A smooth map that folds nothing."""
    x, y = points.T
    return np.stack([x + 0.2 * np.sin(y), y + 0.2 * np.sin(x)], axis=1)


def test_a_valid_mesh_tells_its_boundary() -> None:
    target = bend(VERTICES)
    cycle = check_mesh(pair_of(VERTICES, target), VERTICES[BORDER], target[BORDER])
    first = int(np.flatnonzero(cycle == 0)[0])
    assert np.roll(cycle, -first).tolist() == BORDER.tolist()


def test_triangles_belong_to_the_mesh() -> None:
    triangles = np.array([QUADS[0][[0, 1, 2]], QUADS[0][[0, 2, 3]]])
    pair = pair_of(VERTICES, quads=QUADS[1:], triangles=triangles)
    assert sorted(check_mesh(pair, VERTICES[BORDER], VERTICES[BORDER])) == sorted(BORDER)


def squares(*corners: tuple[float, float], joined: bool = False) -> MeshPair:
    """Unit squares with their first corners at these places, one vertex shared if `joined`."""
    unit = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
    points = np.concatenate([unit + corner for corner in corners])
    quads = np.arange(len(points)).reshape(-1, 4)
    if joined:
        quads[1] = 2, 4, 5, 6
        points = np.delete(points, 4, axis=0)
    return pair_of(points, quads=quads)


def moved(vertex: int, x: float, y: float) -> Points:
    points = VERTICES.copy()
    points[vertex] = x, y
    return points


@pytest.mark.parametrize(
    ("make", "message"),
    [
        pytest.param(
            lambda: pair_of(VERTICES, quads=QUADS[:, ::-1]),
            "source: quad 0 has no area or runs counter-clockwise",
            id="reversed-winding",
        ),
        pytest.param(
            lambda: pair_of(VERTICES, VERTICES * (-1, 1)),
            "target: quad 0 has no area or runs counter-clockwise",
            id="mirrored",
        ),
        pytest.param(
            lambda: pair_of(moved(5, 0.4, 0.4)),
            "source: quad 0 is not convex at vertex 5",
            id="dart",
        ),
        pytest.param(
            lambda: pair_of(VERTICES, quads=QUADS[[0, 1, 2, 3, 4, 5, 5]]),
            "edge 6-7: more than one face",
            id="face-twice",
        ),
        pytest.param(
            lambda: pair_of(VERTICES, quads=QUADS[[0, 1, 3, 4]]),
            "vertex 3 belongs to no face",
            id="loose-vertex",
        ),
        pytest.param(
            lambda: squares((0.0, 0.0), (1.0, 1.0), joined=True),
            "vertex 2: the boundary touches itself",
            id="touching",
        ),
        pytest.param(
            lambda: squares((0.0, 0.0), (5.0, 0.0)),
            "the boundary is more than one cycle: one passes vertex 0, another vertex 4",
            id="far-apart",
        ),
        pytest.param(
            lambda: pair_of(grid(3, 3)[0], quads=np.delete(grid(3, 3)[1], 4, axis=0)),
            "the boundary is more than one cycle",
            id="hole",
        ),
    ],
)
def test_what_is_unsound_is_named(make: Callable[[], MeshPair], message: str) -> None:
    pair = make()
    with pytest.raises(MeshError, match=message):
        check_mesh(pair, pair.source, pair.target)


def test_a_boundary_that_crosses_itself_is_refused() -> None:
    """A strip of valid quads that runs around and over its own start."""
    angles = np.linspace(0, 2.3 * np.pi, 17)
    inner, outer = (r * np.stack([np.cos(angles), np.sin(angles)], axis=1) for r in (1.0, 2.0))
    k = np.arange(16)
    quads = np.stack([k, k + 17, k + 18, k + 1], axis=1)
    pair = pair_of(np.concatenate([inner, outer]), quads=quads)
    with pytest.raises(MeshError, match="source: the mesh's boundary crosses itself"):
        check_mesh(pair, pair.source, pair.target)


@pytest.mark.parametrize("size", [1e-3, 1.0, 1e6])
def test_the_boundary_must_lie_on_the_outline(size: float) -> None:
    outline = size * VERTICES[BORDER]
    for away, valid in ((0.03, True), (0.05, False)):  # 1 % of the diagonal is 0.036
        pair = pair_of(size * moved(8, 0.0, 2.0 + away))
        if valid:
            check_mesh(pair, outline, outline)
        else:
            with pytest.raises(MeshError, match=r"source: vertex 8 at .* from the outline"):
                check_mesh(pair, outline, outline)


def test_inner_vertices_need_not_lie_on_the_outline() -> None:
    pair = pair_of(moved(5, 1.2, 0.9))
    assert len(check_mesh(pair, VERTICES[BORDER], VERTICES[BORDER])) == len(BORDER)
