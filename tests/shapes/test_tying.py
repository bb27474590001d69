"""Which lines are tied to which, seen by what stays together."""

import numpy as np

from shapetween.drawing import Shape
from shapetween.geometry.bezier import evaluate
from shapetween.pipeline import prepare
from shapetween.shapes.junctions import DrawnLine, junctions, with_hanging
from shapetween.shapes.pairing import Pairing
from tests.drawings import drawing, line, square

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
    parts = prepare(drawing(*first), drawing(*second)).movement.parts
    leg, bar = (part.curves(T) for part in parts)
    assert gap(bar[:, 0, 0], leg) < 0.5
    assert gap(bar[:, -1, 3], leg) < 0.5


def test_a_twig_that_comes_grows_on_its_branch() -> None:
    stem = line((20, 95), (30, 50), (20, 5)), line((80, 95), (60, 50), (80, 5))
    twig = line((60, 50), (95, 40))
    parts = prepare(drawing(stem[0]), drawing(stem[1], twig)).movement.parts
    assert len(parts) == 2
    branch, grown = (part.curves(T) for part in parts)
    assert gap(grown[:, 0, 0], branch) < 0.5
