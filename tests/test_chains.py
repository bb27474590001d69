"""Several drawings, each moved to the next: one frame for all, and nothing jumps between."""

import json
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
import shapely

import shapetween as st
from shapetween.base.errors import InputError, OptionError
from shapetween.geometry.bezier import evaluate
from shapetween.model.drawing import Box, Drawing
from shapetween.svg.write.sequence import frame_svg
from tests.cli.commands import SQUARE, TRIANGLE, svg
from tests.drawings import area, drawing, line, square

INPUTS = Path(__file__).resolve().parents[1] / "gallery" / "inputs"

WIDE = '<path d="M10 40H190V60H10Z"/>'
TALL = '<path d="M8 1H12V39H8Z"/>'

#: Width and height of the tall one where its drawn box is fitted into the wide one's.
TALL_IN_WIDE = [20 * 4 / 38, 20.0]


@pytest.fixture(scope="module")
def files(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    """Drawings of different view boxes; one holds what cannot be carried."""
    folder = tmp_path_factory.mktemp("chain")
    contents = {
        "a": svg(f"<title>one</title>{SQUARE}"),
        "b": svg(f"<title>two</title><foreignObject/>{TRIANGLE}", "0 0 20 20"),
        "c": svg(WIDE, "0 0 200 100"),
        "d": svg(TALL, "0 0 20 40"),
    }
    for name, content in contents.items():
        (folder / f"{name}.svg").write_text(content, "utf-8")
    return {name: folder / f"{name}.svg" for name in contents}


@pytest.fixture(scope="module")
def closed(files: dict[str, Path]) -> st.Chain:
    return st.chain([files[name] for name in "abca"], folds="allow")


@pytest.fixture(scope="module")
def animals() -> st.Chain:
    return st.chain([INPUTS / f"{name}.svg" for name in ("horse", "kangaroo", "horse")])


def seen(found: Drawing) -> shapely.Geometry:
    """What is filled and seen, flattened."""
    shapes = []
    for shape in (s for s in found.shapes if s.style.opacity > 0):
        rings = [evaluate(r.curves, np.arange(256) / 256).reshape(-1, 2) for r in shape.rings]
        whole = shapely.Polygon()
        for polygon in map(shapely.Polygon, rings):
            whole = whole.symmetric_difference(polygon.buffer(0))
        shapes.append(whole)
    return shapely.union_all(shapes)


def difference(first: Drawing, second: Drawing) -> float:
    """Area where two drawings differ, as a share of what is drawn."""
    a, b = seen(first), seen(second)
    return float(a.symmetric_difference(b).area / a.union(b).area)


def test_every_drawing_is_in_the_frame_of_the_first(closed: st.Chain) -> None:
    assert closed.closed
    assert len(closed.legs) == 3
    boxes = [leg.at(t).box for leg in closed.legs for t in (0, 1)]
    assert set(boxes) == {Box(0, 0, 10, 10)}
    # xMidYMid meet: 200 by 100 becomes 10 by 5, in the middle.
    (wide,) = closed.at(2 / 3).shapes
    np.testing.assert_allclose(wide.rings[0].box, [[0.5, 4.5], [9.5, 5.5]], atol=1e-9)


def test_boxes_that_are_fitted_are_fitted_to_the_first(files: dict[str, Path]) -> None:
    """Each fitted to the one before it would shrink at every change from wide to tall."""
    found = st.chain([files[name] for name in "cdcdc"], fit="geometry", folds="allow")
    for leg in found.legs:
        sizes = [np.ptp(leg.at(t).shapes[0].rings[0].box, axis=0).tolist() for t in (0, 1)]
        np.testing.assert_allclose(sorted(sizes), [TALL_IN_WIDE, [180.0, 20.0]])


def test_nothing_jumps_where_legs_meet(animals: st.Chain, closed: st.Chain) -> None:
    holes = st.chain([INPUTS / f"{name}.svg" for name in ("key", "umbrella", "letter-o")])
    for found in (animals, closed, holes):
        for before, after in pairwise([*found.legs, *found.legs[: found.closed]]):
            assert difference(before.at(1), after.at(0)) < 1e-5


def test_times_run_through_all_legs(closed: st.Chain) -> None:
    for k, leg in enumerate(closed.legs):
        for t in (0.25, 0.5, 1.0):
            assert difference(closed.at((k + t) / 3), leg.at(t)) < 1e-9
    assert difference(closed.at(0), closed.at(1)) < 1e-9
    for t in (-0.4, 1.4, float("nan")):
        with pytest.raises(OptionError, match="not from 0 to 1"):
            closed.at(t)


@pytest.mark.parametrize("count", [1, 2, 5])
def test_frames_of_every_leg_and_each_drawing_once(closed: st.Chain, count: int) -> None:
    frames = closed.frames(count, "ease-in")
    assert len(frames) == 3 * (count - 1) + 1
    first = closed.legs[0].frames(count, "ease-in")
    assert [frame_svg(f) for f in frames[:count]] == [frame_svg(f) for f in first]
    for k in range(3 if count > 1 else 0):
        assert difference(frames[k * (count - 1)], closed.legs[k].at(0)) < 1e-9
    assert difference(frames[-1], closed.legs[0].at(0)) < 1e-9


def test_two_drawings_are_a_morph(files: dict[str, Path]) -> None:
    pair = files["a"], files["b"]
    written = [
        found.svg(duration=1.5, loop="alternate", hold=0.25)
        for found in (st.chain(pair, folds="allow"), st.morph(*pair, folds="allow"))
    ]
    assert written[0] == written[1]


def test_what_is_told(closed: st.Chain, files: dict[str, Path]) -> None:
    lost, *doubtful = closed.warnings
    assert lost.startswith(f"{files['b']}: a foreign object was left out")
    a, b, c = (files[name] for name in "abc")
    legs = tuple(f"{first} to {second}: " for first, second in ((a, b), (b, c), (c, a)))
    assert all(warning.startswith(legs) for warning in doubtful)
    told = json.loads(json.dumps(closed.report()))
    assert set(told) == {"version", "method", "legs", "warnings", "notices"}
    names = [str(files[name]) for name in "abca"]
    assert [leg["from"] for leg in told["legs"]] == names[:-1]
    assert [leg["to"] for leg in told["legs"]] == names[1:]
    assert all(len(leg["rings"]) == 1 for leg in told["legs"])
    assert closed.at(0.5).title == "one to two to one"


def test_a_round_is_closed_where_a_drawing_comes_again(files: dict[str, Path]) -> None:
    lines = [drawing(line((0, 0), (50, y))) for y in (10, 20, 30)]
    assert st.chain([lines[0], lines[1], lines[0]]).closed
    assert not st.chain(lines).closed
    assert not st.chain([files["a"], files["b"], files["c"]], folds="allow").closed
    assert st.chain(lines).names == ("drawing 1", "drawing 2", "drawing 3")


def test_a_closed_round_rests_once_at_its_first_drawing(closed: st.Chain) -> None:
    text = closed.svg(duration=1.0, hold=0.5, loop="repeat")
    assert 'dur="4.5s"' in text
    opened = replace(closed, closed=False).svg(duration=1.0, hold=0.5, loop="repeat")
    assert 'dur="5s"' in opened


def test_writing(closed: st.Chain, tmp_path: Path) -> None:
    with pytest.raises(OptionError, match=r"is written as \.svg, "):
        closed.write(tmp_path / "out.doc")
    closed.write(tmp_path / "out.svg", hold=0.5, loop="repeat")
    text = (tmp_path / "out.svg").read_text("utf-8")
    assert text == closed.svg(hold=0.5, loop="repeat")
    assert closed._repr_html_() == closed.svg(loop="repeat")
    assert "alternate" not in text


def test_a_viewer_without_animation_shows_the_first_drawing(closed: st.Chain) -> None:
    resvg = pytest.importorskip("resvg_py", reason="resvg-py is not installed")
    texts = (
        closed.svg(loop="repeat", hold=0.5),
        frame_svg(closed.at(0)),
        frame_svg(closed.at(1 / 3)),
    )
    first, frame, other = (bytes(resvg.svg_to_bytes(svg_string=t, width=100)) for t in texts)
    assert first == frame
    assert first != other


def test_a_chain_grows_like_its_legs(animals: st.Chain) -> None:
    """What stands for the time a leg is not shown costs little."""
    alone = sum(len(leg.svg()) for leg in animals.legs)
    assert len(animals.svg(hold=0.5)) < 1.1 * alone


def test_what_cannot_be_done_is_said(files: dict[str, Path]) -> None:
    for few in ([], [files["a"]]):
        with pytest.raises(OptionError, match=f"{len(few)} drawings; expected two or more"):
            st.chain(few)
    with pytest.raises(OptionError, match="expected a list of drawings"):
        st.chain(str(files["a"]))
    with pytest.raises(InputError, match=r"none\.svg: there is no such file"):
        st.chain([files["a"], files["b"], files["a"].with_name("none.svg")])


def test_options_serve_every_leg() -> None:
    squares = [drawing(area(square(x, 10, 40))) for x in (10, 30, 10)]
    found = st.chain(squares, method="linear", folds="allow")
    middle = found.at(0.75).shapes[0].rings[0].box
    np.testing.assert_allclose(middle, [[20, 10], [60, 50]], atol=1e-6)
    assert found.report()["method"] == "linear"


def test_pins_of_a_leg_are_kept_in_each_drawings_own_units(files: dict[str, Path]) -> None:
    paths = [files["a"], files["b"], files["c"]]
    pins = {1: [(1, 1, 18, 2)], 2: [(18, 2, 190, 60)]}
    c = st.chain(paths, pins=pins)
    for k, ((ax, ay, bx, by),) in pins.items():
        rings = c.correspondence[k - 1]
        gaps = np.hypot(rings[0].source[:, 0] - ax, rings[0].source[:, 1] - ay)
        at = int(gaps.argmin())
        assert gaps[at] < 1e-6
        np.testing.assert_allclose(rings[0].target[at], [bx, by], atol=1e-6)
    free = st.chain(paths)
    assert c.legs[0].at(0.5).drawn != free.legs[0].at(0.5).drawn


def test_pins_of_a_leg_that_is_not_there(files: dict[str, Path]) -> None:
    for leg in (0, 2, "1"):
        with pytest.raises(OptionError, match=r"there is no leg"):
            st.chain([files["a"], files["b"]], pins={leg: [(1, 1, 2, 2)]})  # type: ignore[dict-item]
