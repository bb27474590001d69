"""Which lines are tied to which, seen by what stays together."""

import numpy as np
import pytest

from shapetween.attach.nearby import Parts
from shapetween.attach.planes import AffinePlane
from shapetween.attach.riders import riding
from shapetween.elastic import junctions as shape_junctions
from shapetween.elastic import tying
from shapetween.elastic.aboard import RidingPart
from shapetween.elastic.junctions import DrawnLine, junctions, with_hanging
from shapetween.elastic.pairing import Pairing
from shapetween.elastic.tying import tied
from shapetween.geometry.bezier import evaluate
from shapetween.geometry.rotation import rotations
from shapetween.model.drawing import Shape
from tests.drawings import drawing, line, square
from tests.elastic.whole import prepare_elastic

T = np.linspace(0, 1, 9)


def lines(*shapes: Shape) -> list[DrawnLine]:
    return [DrawnLine(s.rings[0].curves, s.rings[0].closed, 2.0) for s in shapes]


def gap(points: np.ndarray, curves: np.ndarray) -> float:
    dense = evaluate(curves, np.linspace(0, 1, 201)).reshape(len(curves), -1, 2)
    return float(np.linalg.norm(dense - points[:, None], axis=2).min(axis=1).max())


def test_ends_that_lie_on_other_lines_are_found() -> None:
    near = line((11, 50), (60, 50))
    found = junctions(lines(line((10, 0), (10, 100)), near, line((63, 0), (63, 90))))
    assert found.keys() == {(1, 0)}
    ((host, (away, spot)),) = found[1, 0].items()
    assert host == 0
    np.testing.assert_allclose([away, spot.place], [1, 0.5])
    np.testing.assert_allclose(spot.offset, [1, 0], atol=1e-9)


def test_lines_that_touch_nothing_and_closed_ones_are_no_guests() -> None:
    ring = Shape((square(20, 20, 20),), line((0, 0), (1, 1)).style)
    assert not junctions(lines(ring, line((60, 20), (60, 40))))
    assert junctions([*lines(ring, line((40, 30), (60, 30))), None]).keys() == {(1, 0)}


def test_many_ends_on_a_long_line_are_found_a_few_at_a_time(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    long = line(*((x, 10.0 * (x % 2)) for x in range(100)))
    twigs = [line((x + 0.5, 5), (x + 0.5, 90)) for x in range(0, 90, 9)]
    every = lines(long, *twigs)
    monkeypatch.setattr(shape_junctions, "CELLS_AT_ONCE", 1)
    found = junctions(every)
    assert found.keys() == {(k, 0) for k in range(1, len(twigs) + 1)}
    places = [found[k, 0][0][1].place for k in range(1, len(twigs) + 1)]
    np.testing.assert_allclose(places, np.arange(0, 90, 9) + 0.5, atol=0.01)
    monkeypatch.setattr(shape_junctions, "MOST_CURVES", 50)
    assert junctions(every) == {}


def test_bars_between_the_same_lines_become_each_other() -> None:
    left, right = line((10, 0), (10, 100)), line((90, 0), (90, 100))
    bar, other = line((10, 20), (90, 20)), line((10, 95), (90, 95))
    loose = line((30, 40), (40, 60))
    pairing = Pairing(((0, 0), (1, 1)), (2, 3), (2, 3))
    found = with_hanging([left, right, bar, loose], [left, right, loose, other], pairing)
    assert found == Pairing(((0, 0), (1, 1), (2, 3)), (3,), (2,))
    assert with_hanging([left, right, bar], [left, right], Pairing(((0, 0),), (2,), ())).pairs == (
        (0, 0),
    )


def test_the_bar_of_an_a_stays_on_its_legs() -> None:
    first = [line((20, 95), (20, 30), (50, 5), (80, 30), (80, 95)), line((20, 60), (80, 60))]
    second = [line((20, 95), (20, 5), (70, 25), (25, 50), (80, 75)), line((20, 50), (25, 50))]
    parts = prepare_elastic(drawing(*first), drawing(*second)).movement.parts
    leg, bar = (part.curves(T) for part in parts)
    assert gap(bar[:, 0, 0], leg) < 0.5
    assert gap(bar[:, -1, 3], leg) < 0.5


def test_a_twig_that_comes_grows_on_its_branch() -> None:
    stem = line((20, 95), (30, 50), (20, 5)), line((80, 95), (60, 50), (80, 5))
    twig = line((60, 50), (95, 40))
    parts = prepare_elastic(drawing(stem[0]), drawing(stem[1], twig)).movement.parts
    assert len(parts) == 2
    branch, grown = (part.curves(T) for part in parts)
    assert gap(grown[:, 0, 0], branch) < 0.5


@pytest.mark.parametrize("longest", [0, 2, 12])
def test_a_line_in_many_pieces_holds_together(
    longest: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """However short the chains are in which its pieces are tied to each other."""
    monkeypatch.setattr(tying, "LONGEST", longest)

    rests = AffinePlane(np.eye(2, 3), np.zeros(2))
    points = [(5.0 * k, 50.0 + 20 * np.sin(k / 2)) for k in range(21)]
    turn = np.column_stack([rotations(np.asarray(1.2)), [60.0, 0.0]])
    parts = []
    for k in range(20):
        piece = line(points[k], points[k + 1])
        ring = piece.rings[0]
        rider = riding(
            Parts(ring.curves, ring.transformed(turn).curves, False), rests, (100.0, 100.0)
        )
        parts.append(RidingPart.of("", (piece.style,) * 2, (rider,), (False,), rests))
    ends = np.array([part.curves(T)[:, [0, -1], [0, 3]] for part in tied(parts)])
    gaps = np.linalg.norm(ends[1:, :, 0] - ends[:-1, :, 1], axis=2)
    assert (gaps.max() < 1e-6) == (longest > 0)
